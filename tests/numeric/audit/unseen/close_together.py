"""Mistakes in numbers: near coincidences, units that are unlike, weak parts beside strong ones, offsets, forms that lose digits."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import ZeroStructure
from faultspace.numeric.method.model.models import StateSpaceModel
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.systems import Record, channel, faulty, general, joined, jordan, plant, record
from tests.numeric.audit.unseen.witnesses import has_structure, recovers, restores

IDENTIFY, RESIDUAL, SIGNAL, STRUCTURE = Mutants("identify"), Mutants("residual"), Mutants("reconstruct"), Mutants("structure")


def _weak() -> Record:
    """Return a record of a system with one state that the input moves a ten-millionth as much as the other, from rest."""
    model = plant([0.8, -0.5], 1, 2, 901)
    poles, V = np.linalg.eig(model.A)
    modes = np.linalg.solve(V, model.B) * np.array([[1.0], [1e-7]])[np.argsort(-poles)]
    return record(StateSpaceModel(model.A, (V @ modes).real, model.C, model.D), 300, 901, x0=0.0)


WEAK = _weak()
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
DEFECTIVE = record(plant(jordan(0.9, 3), 1, 2, 909), 200, 909, fault=0.3 * np.random.default_rng(909).standard_normal((200, 2)))


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
