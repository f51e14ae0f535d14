"""Checks of what is asked of outputs and inputs together, without a residual: how many faults act, and the space of their columns.

The records are two noisy vectors with LOUD times their noise, 30 dB below the faults, and the response from rest to an input of signs,
as loud as the faults, beside them; for the count also without noise, and without noise in other sizes. Truth is exact: the number of
faults, and the columns [f; g] that explain them. A space stands in the states of the model that comes with it, so that the responses of
its columns are compared, which no basis changes.

Contract. Without noise there is a number, and it is due. Under noise "undecided" is an answer, too: to refuse is no failure there, a wrong
answer is. The space is asked with n_v given, and under noise alone: the error of a model from so many samples is in it, faults or not.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cache, partial
from random import Random
from typing import Any

import numpy as np

from faultspace.exact.algebra.matrices import beside as columns_beside
from faultspace.exact.structure.fault_columns import fault_space
from faultspace.exact.structure.signals import simulate
from faultspace.exact.system.systems import ResidualSystem, System

from ....base.arrays import Array
from ....base.errors import InvalidData
from ...method.model.models import StateSpaceModel
from ...method.space.distances import compare_subspaces
from ..making.planting import digits
from ..records import Broken, Check, Function, Measurement, Refused, Severity, Sides
from ..vectors.rationals import floats, matrix, signs
from ..vectors.recipe_vectors import NoisyVector
from ..vectors.shipped_vectors import shipped
from .faults import compared_count
from .refusals import refuses

LEVEL = 0.35
"""The sine of the angle by which a space may be off under noise and the error of a model from so many samples: the largest of our own on
60 records of the kind, drawn anew by `benchmarks/audit_space.py`, rounded up to a twentieth."""
LOUD = 300.0
ASKED = ("one-fault-in-noise", "two-faults-in-noise")
SEED = 1000  # added to that of the record for the signs of the input
SAME, UNITS, SMALL = (1.0,), (1e-3, 1.0, 1e3), (1e-12,)  # of outputs: as they are; as milli and kilo are; all small
WINDOW = 10  # samples of a response
OTHER_SAMPLES = 300
# Other sizes, without noise: A, F, C, G, B, D. Two faults on one state, and two inputs.
OTHERS: dict[str, tuple[list[list[str]], ...]] = {
    "more-faults-than-states": (
        [["1/2"]],
        [["1", "-2"]],
        [["1"], ["2"], ["-1"], ["1/2"]],
        [["1", "0"], ["0", "1"], ["1", "1"], ["2", "-1"]],
        [["1"]],
        [["1"], ["0"], ["-1"], ["2"]],
    ),
    "two-inputs": (
        [["1/2", "1/4"], ["0", "-1/2"]],
        [["1"], ["-1"]],
        [["1", "0"], ["2", "1"], ["-1", "1"], ["1/2", "2"]],
        [["1"], ["0"], ["1"], ["2"]],
        [["1", "2"], ["1", "-1"]],
        [["1", "0"], ["0", "1"], ["-1", "1"], ["2", "1"]],
    ),
}


def checks() -> Iterator[Check]:
    """Yield all checks of the module."""
    for vector in shipped("noisy"):
        if vector.slug not in ASKED:
            continue
        for slug, noise, units, when in (
            ("", 0.0, SAME, ""),
            ("-noisy", LOUD, SAME, ""),
            ("-noisy-other-units", LOUD, UNITS, " whenever outputs have unlike units"),
            ("-small-units", 0.0, SMALL, " whenever outputs are small"),
        ):
            if units == SMALL and vector.slug != ASKED[0]:
                continue
            counted, found = partial(_count, vector, noise, units), partial(space_errors, vector, units)
            effect = f"a wrong number of faults{when}"
            yield Check(f"faults-of-record{slug}", "count_faults", vector.slug, "proposition-3", effect, Severity.SILENT, counted)
            if not noise:
                continue
            effect = f"fault matrices that do not explain the data, or true ones left out{when}"
            yield Check(
                f"space-of-record{slug}", "identified_fault_space", vector.slug, "problem-11", effect, Severity.SILENT, found, nearness=1.0
            )
    for slug in OTHERS:
        effect = "a wrong number of faults wherever faults are more than states, or inputs more than one"
        yield Check("faults-of-record-sizes", "count_faults", slug, "proposition-3", effect, Severity.SILENT, partial(_count_other, slug))
    yield from _refusals(shipped("noisy")[0])


@cache
def other_record(slug: str) -> tuple[Array, Array, System]:
    """Return y, u and the system of a record without noise: faults and inputs are digits, the state begins at 1, -2, ...."""
    A, F, C, G, B, D = (matrix(rows, len(rows[0])) for rows in OTHERS[slug])
    rng = Random(f"{SEED} {slug}")
    v, u = digits(rng, OTHER_SAMPLES, F.ncols), digits(rng, OTHER_SAMPLES, B.ncols)
    start = matrix([[(-2) ** k] for k in range(A.nrows)], 1)
    moved = ResidualSystem(A, columns_beside(F, B), C, columns_beside(G, D))
    y = simulate(moved, start, columns_beside(v, u)).residuals
    return np.ascontiguousarray(floats(y)), np.ascontiguousarray(floats(u)), System(A, F, C, G)


def _count_other(slug: str, function: Function) -> Iterator[Measurement]:
    y, u, system = other_record(slug)
    yield compared_count("n_v", function(y.copy(), u.copy(), system.n), system.m)


def record(vector: NoisyVector, noise: float, units: Sequence[float] = SAME, acting: float = 1.0) -> tuple[Array, Array]:
    """Return y (N, p) and u (N, 1): faults, the input, and `noise` times the noise of the vector; outputs times `units`, taken in turn, and
    the faults times `acting`."""
    system = vector.system
    A, C, F, G = (floats(M) for M in (system.A, system.C, system.F, system.G))
    B, D = _input_matrices(F, G)
    u = signs(vector.seed + SEED, vector.samples).reshape(-1, 1)
    v, w = vector.drawn()
    model = StateSpaceModel(A, np.hstack([F, B]), C, np.hstack([G, D]))
    y = model.simulate(np.hstack([acting * v, u])) + noise * float(vector.noise) * w
    return y * np.resize(units, len(C)), np.ascontiguousarray(u)


def nothing_acts(vector: NoisyVector, noise: float) -> tuple[Array, Array, int]:
    """Return y and u with no fault in them, and the order."""
    return *record(vector, noise, acting=0.0), vector.system.n


def _input_matrices(F: Array, G: Array) -> tuple[Array, Array]:
    turned = np.where(np.arange(len(F)) % 2, -1.0, 1.0)[:, None]
    return F[:, :1] * turned, 0.5 * G[::-1, :1]


def _count(vector: NoisyVector, noise: float, units: Sequence[float], function: Function) -> Iterator[Measurement]:
    y, u = record(vector, noise, units)
    try:
        got = function(y, u, vector.system.n)
    except Refused:
        if not noise:
            raise
        yield Measurement("undecided, as it may be", 0.0, 0.0)
        return
    yield compared_count("n_v", got, vector.system.m)


def space_errors(vector: NoisyVector, units: Sequence[float], function: Function) -> Iterator[Measurement]:
    system = vector.system
    y, u = record(vector, LOUD, units)
    try:
        answer = function(y, u, system.n, system.m)
    except Refused:
        yield Measurement("undecided, as it may be", 0.0, 0.0)
        return
    true = floats(fault_space(System(system.A, system.F, system.C, system.G)).basis).T
    scale = np.resize(units, system.p)
    wanted = _responses(floats(system.A), floats(system.C), true, np.ones(system.p))
    try:
        A, C, columns = (np.atleast_2d(np.asarray(part, dtype=float)) for part in answer)
        answered = _responses(A, C, columns, scale)
        compared = compare_subspaces(answered, wanted)
    except (InvalidData, ValueError, TypeError) as error:
        raise Broken(f"no A, C and basis of columns [f; g]: {error}") from None
    sides = Sides("responses", answered.tolist(), wanted.tolist(), LEVEL, {"units": scale.tolist(), "window": WINDOW})
    dimensions = Sides("dimension", *compared.dimensions)
    yield Measurement("dimension of the fault space", float(abs(compared.dimensions[0] - compared.dimensions[1])), 0.0, dimensions)
    yield Measurement("sine of the largest angle, two-sided", compared.two_sided, LEVEL, sides)


def _responses(A: Array, C: Array, columns: Array, scale: Array) -> Array:
    """Return what unit pulses through the columns [f; g] (n + p, k) do to the outputs, over `scale`, in WINDOW samples (WINDOW p, k)."""
    n = len(A)
    states, parts = columns[:n], [columns[n:] / scale[:, None]]
    for _ in range(WINDOW - 1):
        parts.append(C @ states / scale[:, None])
        states = A @ states
    return np.vstack(parts)


def _refusals(vector: NoisyVector) -> Iterator[Check]:
    """Yield what must be refused: a missing sample, unequal lengths, fewer samples than unknowns."""

    def missing(y: Array, u: Array) -> tuple[Array, Array]:
        y[len(y) // 2, 0] = np.nan
        return y, u

    def changed(change: Callable[[Array, Array], tuple[Array, Array]], rest: tuple[int, ...]) -> tuple[Any, ...]:
        return *change(*record(vector, LOUD)), vector.system.n, *rest

    for slug, effect, change in (
        ("refuses-nan-output", "a missing sample goes into the estimate unnoticed", missing),
        ("refuses-unequal-lengths", "inputs paired with the wrong outputs", lambda y, u: (y, u[:-5])),
        ("refuses-short-data", "an answer from fewer equations than unknowns", lambda y, u: (y[:6], u[:6])),
    ):
        yield refuses(slug, "count_faults", vector.slug, effect, partial(changed, change, ()))
        yield refuses(slug, "identified_fault_space", vector.slug, effect, partial(changed, change, (vector.system.m,)))
