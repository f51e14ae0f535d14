"""Check residuals, window ranks, the number of faults, the fault space and the fault signal, on each record in all views.

checks           what is asked of every function, as given and in the views of SUFFIXES, each against the exact answer of its view
with_input       data whose residual is known
spaces_off       dimension and two-sided distance of a fault space
as_number        n_v as a number
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from faultspace.exact.algebra.matrices import Matrix, beside
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.structure.signals import hankel, simulate
from faultspace.exact.system.systems import ResidualSystem

from ....base.errors import InvalidData
from ....base.sheets import counted
from ...space.distances import compare_subspaces
from ..records import Broken, Check, Demand, Function, Measurement, Severity
from ..vectors.exact_comparison import lifted
from ..vectors.fault_vectors import FaultVector, channel_units
from ..vectors.rationals import floats, matrix, scaled
from ..vectors.shipped_vectors import shipped

LONG_WINDOW = 10
# Suffix of the slug, what the answer then depends on, the views compared.
SUFFIXES: dict[str, tuple[str, tuple[str, ...]]] = {
    "": ("", ("as-given",)),
    "-1e-12": (" whenever the units change", ("1e-12",)),
    "-1e-6": (" whenever the units change", ("1e-6",)),
    "-1e6": (" whenever the units change", ("1e6",)),
    "-other-units": (" whenever outputs have unlike units", ("other-units",)),
    "-permuted-outputs": (", depending on the order of the outputs", ("permuted-outputs",)),
    "-other-basis": (", depending on the basis of the states, which nobody sees", ("other-basis",)),
    "-time-shift": (", depending on where the record begins", ("time-shift",)),
    "-split-data": (", depending on which half of the record is read", ("first-half", "second-half")),
}
Measure = Callable[[FaultVector, Function], Iterator[Measurement]]


def checks() -> Iterator[Check]:
    """Yield all checks of the module."""
    for vector in shipped("faults"):
        effect = "the residual still holds the response to the input: input and fault cannot be told apart"
        yield from _in_views("residual-free-of-input", "residual", vector, "proposition-1", effect, _residual_off)
        effect = "wrong ranks of windows: wrong number of faults, wrong lag"
        yield from _in_views("window-ranks", "window_ranks", vector, "window-ranks", effect, _ranks_off)
        yield from _in_views("fault-dimension", "fault_dimension", vector, "proposition-3", "a wrong number of faults", _count_off)
        yield _as_many_as_outputs(vector)
        effect = "fault matrices that do not explain the data, or true ones left out"
        yield from _in_views("fault-space", "fault_space", vector, "problem-11", effect, space_off)
        yield _window("fault-space-long-window", vector, LONG_WINDOW)
        yield _window("fault-space-shortest-window", vector, vector.lag + 1)
        effect = "a wrong fault signal: wrong size or time of a fault"
        yield from _in_views("fault-signal", "reconstruct", vector, "trajectory-recovered", effect, _signal_off)


def _in_views(slug: str, function: str, vector: FaultVector, claim: str, effect: str, compare: Measure) -> Iterator[Check]:
    """Yield the check of the record as given and in every view that changes the question."""

    def measure(views: tuple[str, ...], called: Function) -> Iterator[Measurement]:
        for view in views:
            yield from compare(vector.seen(view), called)

    for suffix, (when, views) in SUFFIXES.items():
        if suffix == "-other-basis" and function in ("window_ranks", "fault_dimension"):
            continue  # they see the residual alone
        if function == "window_ranks" and not all(vector.seen(view).clear for view in views):
            continue
        if function == "reconstruct" and any(vector.seen(view).bounds["signal"] is None for view in views):
            continue
        yield Check(slug + suffix, function, vector.slug, claim, effect + when, Severity.SILENT, partial(measure, views))


def with_input(r: Matrix, system: ResidualSystem, size: Fraction) -> tuple[Matrix, Matrix]:
    """Return (y, u), where y is r plus the response from rest to u for the model B = F, D = G.

    Channel j of u is size at every (j + 2)nd sample and -size between.
    """
    u = matrix([[size if k % (j + 2) == 0 else -size for j in range(system.m)] for k in range(r.nrows)], system.m)
    return r + simulate(system, Matrix.zero(system.field, system.n, 1), u).residuals, u


def _residual_off(vector: FaultVector, function: Function) -> Iterator[Measurement]:
    """Compare what the model's free response cannot touch, M(q) r with M(q) C A^k = 0, with the exact one: any initial state will do."""
    system = vector.system
    y, u = with_input(vector.r, system, vector.view.scale)
    got = function(floats(y), floats(u), *(floats(M) for M in (system.A, system.F, system.C, system.G)))
    off = lifted(got, "r", vector.r.shape) - vector.r
    free = ResidualSystem.of(system.A, _no_columns(system.n), system.C, _no_columns(system.p), n=system.n, m=0, p=system.p)
    bound = vector.bounds["residual"]
    assert bound is not None
    units = channel_units(vector.r)
    for number, row in enumerate(kernel_representation(free).rows):
        coefficients = row.coefficients
        seen = beside(*(coefficients.rows([k]) for k in range(coefficients.nrows))) @ hankel(off, coefficients.nrows)
        # |M(q) d| <= sum_k |c_k U| |U^-1 d| for the channels' units U
        size = float(np.sum(np.linalg.norm(floats(scaled(coefficients, units)), axis=1)))
        yield Measurement(f"kernel row {number} of r", float(np.linalg.norm(floats(seen))), size * bound)


def _no_columns(rows: int) -> Matrix:
    """Return the matrix with so many rows and no columns."""
    return matrix([[] for _ in range(rows)], 0)


def _ranks_off(vector: FaultVector, function: Function) -> Iterator[Measurement]:
    """Ask for the ranks R_s for s = 1, 2, ... and compare them."""
    yield from ranks_off(function(floats(vector.r), len(vector.ranks)), vector.ranks)


def ranks_off(answer: Any, due: tuple[int, ...]) -> Iterator[Measurement]:
    """Yield one measurement for each window."""
    ranks = list(answer)
    if len(ranks) != len(due):
        raise Broken(f"{counted(len(ranks), 'rank')} for {counted(len(due), 'window')}")
    for s, (got, exact) in enumerate(zip(ranks, due, strict=True), start=1):
        yield Measurement(f"rank R_{s}", abs(float(got) - exact), 0.0)


def _count_off(vector: FaultVector, function: Function) -> Iterator[Measurement]:
    yield Measurement("n_v", abs(as_number(function(floats(vector.r))) - vector.n_v), 0.0)


def _as_many_as_outputs(vector: FaultVector) -> Check:
    """Ask about the first m outputs alone, between which m faults leave no relation, nor would noise. Any answer is free and is shown."""

    def measure(function: Function) -> Iterator[Measurement]:
        got = function(floats(vector.r.columns(range(vector.n_v))))
        yield Measurement("n_v, as many as outputs", abs(as_number(got) - vector.n_v), 0.0)

    effect = "noise is taken for faults, or faults for noise"
    slug, severity = "as-many-faults-as-outputs", Severity.SOMETIMES
    return Check(slug, "fault_dimension", vector.slug, "proposition-3", effect, severity, measure, Demand.FREE)


def as_number(value: Any) -> float:
    """Return the answer as a number. Raises Broken for what is no number."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise Broken(f"n_v is {value!r}, no number") from None


def space_off(vector: FaultVector, function: Function, block_rows: int | None = None) -> Iterator[Measurement]:
    """Compare the fault space from windows of so many block rows, n + 1 by default, by the two-sided distance: too large is wrong as well.

    Who takes n + 1 all the same may: the bound is that of the worse window (n + 1 alone where the window is too short to have one).
    """
    system = vector.system
    windows = block_rows or system.n + 1, system.n + 1
    got = function(floats(vector.r), floats(system.A), floats(system.C), vector.n_v, windows[0])
    yield from spaces_off(got, vector.space, max(vector.space_bounds[s] for s in windows if s in vector.space_bounds))


def _window(slug: str, vector: FaultVector, block_rows: int) -> Check:
    effect = "fault matrices that change with the length of the window"
    measure = partial(space_off, vector, block_rows=block_rows)
    return Check(slug, "fault_space", vector.slug, "sharp-windows", effect, Severity.SILENT, measure)


def spaces_off(got: Any, truth: Matrix, bound: float) -> Iterator[Measurement]:
    """Measure the dimension and the two-sided distance of the columns `got` from those of `truth`."""
    try:
        compared = compare_subspaces(np.asarray(got, dtype=float), floats(truth))
    except (InvalidData, ValueError, TypeError) as error:
        raise Broken(f"no basis of columns [f; g]: {error}") from None
    yield Measurement("dimension of the fault space", float(abs(compared.dimensions[0] - compared.dimensions[1])), 0.0)
    yield Measurement("sine of the largest angle, two-sided", compared.two_sided, bound)


def _signal_off(vector: FaultVector, function: Function) -> Iterator[Measurement]:
    """Compare v from the known initial state, up to the delay at the end of the record."""
    system, bound = vector.system, vector.bounds["signal"]
    assert bound is not None
    start = floats(vector.x0).ravel()
    got = function(floats(vector.r), *(floats(M) for M in (system.A, system.F, system.C, system.G)), start)
    off = floats(lifted(got, "v", vector.v.shape) - vector.v)[: vector.trusted]
    yield Measurement("v", float(np.linalg.norm(off)), bound)
