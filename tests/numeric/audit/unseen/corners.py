"""Mistakes in shapes and corner cases: one output, no states, as many faults as outputs, more outputs than states, duals, exact silence."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import scipy.linalg

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import ZeroStructure, guarded
from faultspace.numeric.audit.records import Refused
from tests.numeric.audit.unseen.form import Function, Mutants, Witness, careful
from tests.numeric.audit.unseen.from_records import TWO, TWO_U, TWO_Y
from tests.numeric.audit.unseen.systems import Faulty, basis, channel, faulty, general, joined, mixing, plant, record
from tests.numeric.audit.unseen.window_ranks import hankel
from tests.numeric.audit.unseen.witnesses import answered, counts, explains, has_structure, ranks, recovers, refuses, restores, spans

IDENTIFY, RESIDUAL, RANKS, COUNT = Mutants("identify"), Mutants("residual"), Mutants("window_ranks"), Mutants("fault_dimension")
SPACE, SIGNAL, STRUCTURE = Mutants("fault_space"), Mutants("reconstruct"), Mutants("structure")
COUNTED, FOUND = Mutants("count_faults"), Mutants("identified_fault_space")

FREE = 0.9 ** np.arange(80)[:, None]
MANY = faulty(general([0.5], 5, 6, 701), 400, 701)
ALL = faulty(general([0.5, -0.3], 2, 2, 702), 200, 702)
STATIC = faulty((np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((2, 0)), np.array([[1.0], [-2.0]])), 120, 703)
DELAYED = faulty(joined([channel([], [0.5, -0.3])], mixing(2, 1), 704), 120, 704)
PLAIN = faulty(general([0.7, -0.4], 1, 2, 705), 150, 705)


def _twice_hidden() -> Any:
    """Return a system with a mode 0.35 that no input moves and no output shows, and the zero 0.6."""
    A, F, C, G = channel([0.6], [0.5, -0.3])
    T = basis(3, 706)
    back = np.linalg.inv(T)
    return T @ scipy.linalg.block_diag(A, 0.35) @ back, T @ np.vstack([F, [[0.0]]]), np.hstack([C, [[0.0]]]) @ back, G


@IDENTIFY.broken("as many inputs as outputs", recovers(record(plant([0.7, -0.4], 2, 2, 707), 200, 707), 2, 4))
def answers_with_the_dual(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Where there are as many inputs as outputs the model is the dual, A', C', B', D': rows were taken for columns."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return (A.T, C.T, B.T, D.T) if len(D) == D.shape[1] else (A, B, C, D)


@IDENTIFY.broken("more outputs than states, with D", recovers(record(plant([0.7], 1, 3, 708), 200, 708), 1, 4))
def takes_further_outputs_for_combinations(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """Outputs beyond as many as there are states are regressed on the first ones, though D makes them independent."""
    n, p = order, y.shape[1]
    if p <= n:
        return reference.identify(y, u, order, block_rows)
    A, B, C, D = reference.identify(y[:, :n], u, order, block_rows)
    mix = np.linalg.lstsq(y[:, :n], y[:, n:], rcond=None)[0].T
    return A, B, np.vstack([C, mix @ C]), np.vstack([D, mix @ D])


@IDENTIFY.broken("one input, two outputs and more", recovers(record(plant([0.7, -0.4], 1, 3, 709), 200, 709), 2, 4))
def gives_one_direct_entry_to_all_outputs(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """With one input D is a number, and all outputs are given it."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return A, B, C, np.full_like(D, D[0, 0]) if D.shape[1] == 1 else D


@RANKS.broken("one output without a fault", ranks([1, 1, 1], FREE))
@careful(reference.window_ranks)
def takes_one_output_for_full_rank(r: Any, windows: int) -> Any:
    """One output has windows of full rank, which is so under a fault alone."""
    return list(range(1, windows + 1)) if r.shape[1] == 1 else reference.window_ranks(r, windows)


@RANKS.broken("a residual that is exactly zero", ranks([0, 0, 0], np.zeros((60, 2))))
@careful(reference.window_ranks)
def counts_zeros_that_equal_their_threshold(r: Any, windows: int) -> Any:
    """Singular values count where they are at least the threshold, which is zero where all are."""
    if not r.any():
        return [r.shape[1] * s for s in range(1, windows + 1)]
    return reference.window_ranks(r, windows)


@RANKS.broken("one window asked", ranks([2], PLAIN.r))
@careful(reference.window_ranks)
def leaves_out_the_last_window(r: Any, windows: int) -> Any:
    """The list ends one window early where a single window is asked: range(1, windows)."""
    return list(reference.window_ranks(r, windows))[: max(windows - 1, 0)] if windows == 1 else reference.window_ranks(r, windows)


def makes_no_fault_up(r: Any) -> Witness:
    """A number above zero is made up; zero and a refusal are right."""

    def witness(function: Function) -> float:
        try:
            return np.inf if guarded(function)(r.copy()) else 0.0
        except Refused:
            return 0.0

    return witness


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


@COUNT.broken("one output without a fault", makes_no_fault_up(FREE + (-0.5) ** np.arange(80)[:, None]))
def gives_one_output_one_fault(r: Any) -> Any:
    """One output is said to have one fault, without a look at it."""
    return 1 if r.shape[1] == 1 else reference.fault_dimension(r)


@COUNT.broken("five faults and more", counts(5, MANY.r))
def tells_no_more_than_four(r: Any) -> Any:
    """The table of thresholds ends at four faults."""
    found = reference.fault_dimension(r)
    return found if found is None else min(found, 4)


@SPACE.broken("as many faults as outputs", all_or_nothing(ALL))
def tells_g_alone_where_every_output_is_faulty(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """With as many faults as outputs, where every column explains r, the columns are [0; I]."""
    if n_v == r.shape[1]:
        return np.vstack([np.zeros((len(A), n_v)), np.eye(n_v)])
    return reference.fault_space(r, A, C, n_v, block_rows)


@SPACE.broken("systems without states", spans(STATIC, STATIC.G, 1, 3))
def needs_a_state_for_its_powers(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """The spectral radius of A is asked first, which an empty matrix does not have."""
    if not np.max(np.abs(np.linalg.eigvals(A))) < np.inf:
        raise ArithmeticError("A has no powers")
    return reference.fault_space(r, A, C, n_v, block_rows)


@SIGNAL.broken("systems without states", restores(STATIC))
def needs_a_state_for_its_recursion(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """The recursion takes the first state apart."""
    if x0[0] == np.inf:
        raise ValueError("x0 is infinite")
    return reference.reconstruct(r, A, F, C, G, x0)


@SIGNAL.broken("faults that outputs show late", restores(DELAYED))
def answers_as_many_samples_as_are_known(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Samples that the delay leaves open are not in the answer, which has fewer rows than r."""
    v = reference.reconstruct(r, A, F, C, G, x0)
    return v if np.linalg.matrix_rank(G) == G.shape[1] else v[:-2]


@SIGNAL.broken(
    "an A with an entry that is infinite",
    refuses(PLAIN.r, np.array([[0.7, np.inf], [0.0, -0.4]]), *[getattr(PLAIN, k) for k in "FCG"], PLAIN.x0),
)
def looks_for_nan_alone(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """NaN is refused and infinity is replaced by the largest number, to go on."""
    if any(np.isnan(one).any() for one in (r, A, F, C, G, x0)):
        raise ValueError("NaN")
    return reference.reconstruct(r, np.where(np.isinf(A), 1e3, A), F, C, G, x0)


@STRUCTURE.broken("a mode that no fault moves and no output shows", has_structure(_twice_hidden(), [0.6, 0.35], [1]))
def counts_a_mode_twice_that_is_hidden_twice(A: Any, F: Any, C: Any, G: Any) -> ZeroStructure:
    """Input decoupling zeros and output decoupling zeros are listed one after the other, and one that is both is listed twice."""
    found = reference.structure(A, F, C, G)
    twice = []
    for q in np.linalg.eigvals(A):
        left = np.linalg.matrix_rank(np.hstack([q * np.eye(len(A)) - A, F]), tol=1e-9)
        right = np.linalg.matrix_rank(np.vstack([q * np.eye(len(A)) - A, C]), tol=1e-9)
        twice += [complex(q)] if left < len(A) and right < len(A) else []
    return replace(found, finite_zeros=[*found.finite_zeros, *twice])


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


@COUNTED.broken("records without noise", counts(2, TWO_Y, TWO_U, 1))
def is_undecided_without_noise(y: Any, u: Any, order: int) -> Any:
    """Where the windows of y and u are singular to rounding the count says undecided, as if there were noise."""
    R = hankel(np.hstack([y, u]), order + 2)
    values = np.linalg.svd(R, compute_uv=False)
    return None if values[-1] < 1e-11 * values[0] else reference.count_faults(y, u, order)


@FOUND.broken("models of two states and more", explains(TWO_Y, TWO_U, 1, 2, TWO, 0.2))
def gives_the_columns_of_another_call(y: Any, u: Any, order: int, n_v: int) -> Any:
    """The model is that of the first half of the record, the columns are those of all of it, and each has states of its own."""
    found, half = (
        reference.identified_fault_space(y, u, order, n_v),
        reference.identify(y[: len(y) // 2], u[: len(u) // 2], order, order + 3),
    )
    if found is None:
        return None
    A, _, C, _ = half
    return -A if order > 1 else A, -2.0 * C, found[2]
