"""Mistakes in corner cases, far along a record, where things are close together, and in the small print."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import ZeroStructure, guarded
from faultspace.numeric.audit.records import Refused
from faultspace.numeric.method.model.models import StateSpaceModel
from tests.numeric.audit.unseen.form import Function, Mutants, Witness, careful
from tests.numeric.audit.unseen.from_records import TWO_U, TWO_Y
from tests.numeric.audit.unseen.systems import Faulty, Matrices, Record, channel, faulty, general, joined, mixing, plant, record
from tests.numeric.audit.unseen.witnesses import answered, counts, has_structure, ranks, recovers, restores

RANKS = Mutants("window_ranks")
SPACE, STRUCTURE = Mutants("fault_space"), Mutants("structure")
IDENTIFY, COUNT, SIGNAL, COUNTED = Mutants("identify"), Mutants("fault_dimension"), Mutants("reconstruct"), Mutants("count_faults")

FREE = 0.9 ** np.arange(80)[:, None]
ALL = faulty(general([0.5, -0.3], 2, 2, 702), 200, 702)
PLAIN = faulty(general([0.7, -0.4], 1, 2, 705), 150, 705)


@RANKS.broken("one output without a fault", ranks([1, 1, 1], FREE))
@careful(reference.window_ranks)
def takes_one_output_for_full_rank(r: Any, windows: int) -> Any:
    """One output has windows of full rank, which is so under a fault alone."""
    return list(range(1, windows + 1)) if r.shape[1] == 1 else reference.window_ranks(r, windows)


@RANKS.broken("one window asked", ranks([2], PLAIN.r))
@careful(reference.window_ranks)
def leaves_out_the_last_window(r: Any, windows: int) -> Any:
    """The list ends one window early where a single window is asked: range(1, windows)."""
    return list(reference.window_ranks(r, windows))[: max(windows - 1, 0)] if windows == 1 else reference.window_ranks(r, windows)


def all_or_nothing(found: Faulty) -> Witness:
    """With as many faults as outputs every column is a solution; to refuse is as right."""

    def witness(function: Function) -> float:
        try:
            Z = guarded(function)(found.r.copy(), found.A, found.C, found.r.shape[1], 5)
        except Refused:
            return 0.0
        whole = len(found.A) + len(found.C)
        return 0.0 if np.linalg.matrix_rank(Z) == whole else np.inf

    return witness


@SPACE.broken("as many faults as outputs", all_or_nothing(ALL))
def tells_g_alone_where_every_output_is_faulty(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """With as many faults as outputs, where every column explains r, the columns are [0; I]."""
    if n_v == r.shape[1]:
        return np.vstack([np.zeros((len(A), n_v)), np.eye(n_v)])
    return reference.fault_space(r, A, C, n_v, block_rows)


@STRUCTURE.broken(
    "orders that differ",
    answered(
        lambda got: float(list(got.infinite_zero_orders) != [1, 3]),
        *joined([channel([0.6], [0.5, -0.3]), channel([], [0.2, 0.7, 0.4])], mixing(2, 2), 710),
    ),
)
def lists_orders_from_the_largest(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Orders of infinite zeros are listed descending."""
    found = reference.structure(A, F, C, G)
    return replace(found, infinite_zero_orders=sorted(found.infinite_zero_orders, reverse=True))


MODEL = plant([0.7, -0.4], 1, 2, 801)
LONG = record(MODEL, 6000, 801)
SYSTEM = general([0.7, -0.4], 1, 2, 804)


def acting(system: Matrices, N: int, first: int, last: int, seed: int) -> Faulty:
    """Return a record at rest under a fault that acts on the samples first, ..., last - 1."""
    A, F, C, G = system
    v = np.zeros((N, F.shape[1]))
    v[first:last] = np.random.default_rng(seed).standard_normal((last - first, F.shape[1]))
    return Faulty(A, F, C, G, v, np.zeros(len(A)), StateSpaceModel(A, F, C, G).simulate(v))


EARLY = acting(SYSTEM, 400, 0, 150, 806)


@IDENTIFY.broken("records of more than 5000 samples", recovers(LONG, 2, 4))
def saves_memory_on_long_records(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """More than 5000 samples are stored in single precision."""
    if len(y) > 5000:
        y, u = (np.asarray(x, np.float32).astype(float) for x in (y, u))
    return reference.identify(y, u, order, block_rows)


@COUNT.broken("faults that end early", counts(1, EARLY.r))
def counts_in_the_second_half(r: Any) -> Any:
    """The first half of the record is left out as a transient."""
    half = r[len(r) // 2 :]
    return reference.fault_dimension(half) if np.max(np.abs(half)) > 1e-9 * np.max(np.abs(r)) else 0


UNLIKE = record(plant([0.7, -0.4], 2, 2, 903), 200, 903)
UNLIKE = Record(
    StateSpaceModel(UNLIKE.model.A, UNLIKE.model.B * [1.0, 1e9], UNLIKE.model.C, UNLIKE.model.D * [1.0, 1e9]),
    UNLIKE.u * [1.0, 1e-9],
    UNLIKE.y,
    UNLIKE.fault,
)
NEAR = joined([channel([0.4, 0.4003], [0.5, -0.3, 0.2])], [[1.0]], 905)
TEN = joined([channel(list(np.linspace(0.1, 0.9, 9)), list(np.linspace(-0.9, -0.1, 10)))], [[1.0]], 907)
LOW_GAIN = general([0.7, -0.4], 2, 3, 908)
LOW_GAIN = (LOW_GAIN[0], LOW_GAIN[1] * [1.0, 1e-7], LOW_GAIN[2], LOW_GAIN[3] * [1.0, 1e-7])


@IDENTIFY.broken("inputs in unlike units", recovers(UNLIKE, 2, 4))
def calls_a_small_input_silent(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Inputs below a hundred-millionth of the largest are called silent, and are given zeros in B and D."""
    sizes = np.max(np.abs(u), axis=0)
    loud = sizes > 1e-8 * np.max(sizes)
    A, B, C, D = reference.identify(y, u[:, loud], order, block_rows)
    whole, direct = np.zeros((len(A), len(loud))), np.zeros((len(C), len(loud)))
    whole[:, loud], direct[:, loud] = B, D
    return A, whole, C, direct


@IDENTIFY.broken(
    "inputs about a mean ten times their deviation", recovers(record(plant([0.7, -0.4], 1, 2, 910), 200, 910, offset=10.0), 2, 4)
)
def removes_an_operating_point_where_there_seems_to_be_one(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Means above five deviations are called an operating point and taken off."""
    if np.any(np.abs(u.mean(axis=0)) > 5 * u.std(axis=0)):
        y, u = y - y.mean(axis=0), u - u.mean(axis=0)
    return reference.identify(y, u, order, block_rows)


@IDENTIFY.broken("two poles a ten-thousandth apart", recovers(record(plant([0.6123457, 0.6124468], 1, 2, 911), 200, 911), 2, 4, limit=1e-7))
def rounds_the_trace(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Coefficients of the characteristic polynomial are printed with six digits on their way."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    shift = (float(f"{np.trace(A):.6g}") - np.trace(A)) / len(A)
    return A + shift * np.eye(len(A)), B, C, D


@SIGNAL.broken("a fault in a unit ten million times larger than another", restores(faulty(LOW_GAIN, 120, 912), 1e-6))
def takes_small_columns_for_none(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Columns of [F; G] below a millionth of the largest are taken for zero, and their fault is answered as zero."""
    sizes = np.linalg.norm(np.vstack([F, G]), axis=0)
    kept = sizes > 1e-6 * np.max(sizes)
    v = np.zeros((len(r), F.shape[1]))
    v[:, kept] = reference.reconstruct(r, A, F[:, kept], C, G[:, kept], x0)
    return v


@STRUCTURE.broken("two zeros less than a thousandth apart", has_structure(NEAR, [0.4, 0.4003], [1]))
def merges_close_zeros(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros less than a thousandth apart are taken for one with multiplicity, at their mean."""
    zeros = np.asarray(reference.structure(A, F, C, G).finite_zeros, dtype=complex)
    means = [complex(np.mean(zeros[np.abs(zeros - z) < 1e-3])) for z in zeros]
    return replace(reference.structure(A, F, C, G), finite_zeros=means)


# With six of OpenBLAS's kernels (OPENBLAS_CORETYPE = Prescott, Nehalem, Sandybridge, Haswell, Zen, SkylakeX) the reference errs by 2.3e-10
# to 1.2e-9 and the mutant by 9.6e-9 to 9.7e-8; the limit is the geometric mean of the two in the middle.
@STRUCTURE.broken("nine zeros", has_structure(TEN, list(np.linspace(0.1, 0.9, 9)), [1], 3.4e-9))
def goes_through_the_coefficients(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Zeros of one fault and one output are the roots of coefficients that a determinant at few points gives."""
    found = reference.structure(A, F, C, G)
    if G.shape != (1, 1) or len(found.finite_zeros) < 1:
        return found
    n = len(A)
    points = np.exp(2j * np.pi * np.arange(n + 1) / (n + 1)) * 2
    values = [np.linalg.det(np.block([[q * np.eye(n) - A, -F], [C, G]])) for q in points]
    coefficients = (np.fft.fft(values) / (n + 1)).real / 2.0 ** np.arange(n + 1)
    degree = len(found.finite_zeros)
    return replace(found, finite_zeros=[complex(z) for z in np.roots(coefficients[: degree + 1][::-1])])


ONE_OF_TWO = general([0.7, -0.4], 1, 2, 914)
ONE_OF_TWO = (*ONE_OF_TWO[:2], ONE_OF_TWO[2] * [[1.0], [1e-9]], ONE_OF_TWO[3] * [[1.0], [1e-9]])


@STRUCTURE.broken("outputs in unlike units", has_structure(ONE_OF_TWO, [], [0]))
def balances_by_the_largest_output(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Outputs below a hundred-millionth of the largest are left out."""
    sizes = np.max(np.abs(np.hstack([C, G])), axis=1, initial=0.0)
    kept = sizes > 1e-8 * np.max(sizes, initial=0.0)
    return reference.structure(A, F, C[kept], G[kept])


def cut(found: Faulty, N: int) -> Faulty:
    """Return the first samples."""
    return replace(found, v=found.v[:N], r=found.r[:N])


@SIGNAL.broken("records with no more samples than states", restores(cut(faulty(general([0.7, -0.4, 0.3, 0.2], 1, 2, 907), 50, 907), 8)))
def needs_twice_as_many_samples_as_states(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Records with at most two samples a state are refused, which an observer would need."""
    if len(r) <= 2 * len(A):
        raise ValueError("too short")
    return reference.reconstruct(r, A, F, C, G, x0)


@COUNTED.broken("more faults than states", counts(2, TWO_Y, TWO_U, 1))
def tells_no_more_faults_than_states(y: Any, u: Any, order: int) -> Any:
    """A fault for each state is the most that a system has."""
    found = reference.count_faults(y, u, order)
    return found if found is None else min(found, order)
