"""Check residuals, window ranks, the number of faults, the fault space and the fault signal, on each record in all views.

checks           what is asked of every function, as given and in the views of SUFFIXES, each against the exact answer of its view; the
                 number of faults under white noise whose Hankel matrices are, certified, far smaller than the least singular value of the
                 exact ones: it is there to be seen, and no threshold of rounding shows it
spaces_off       dimension and two-sided distance of a fault space
PLAIN            what is asked of every record of faults, of whatever kind
compared_count   a number of faults against the one that is due
as_number        n_v as a number
residual_off, window_ranks_off, count_off, signal_off    the measurements of each function on one vector
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from faultspace.exact.algebra.matrices import Matrix, beside, rank
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.structure.signals import hankel
from faultspace.exact.system.systems import ResidualSystem

from ....base.errors import InvalidData
from ....base.sheets import counted
from ...method.space.distances import compare_subspaces
from ..records import Broken, Check, Demand, Function, Measurement, Severity, Sides
from ..vectors.exact_comparison import lifted
from ..vectors.fault_vectors import LONG_WINDOW, FaultVector, UnexcitingVector, channel_units, with_input
from ..vectors.rationals import floats, fractions, matrix, scaled
from ..vectors.recipe_vectors import NoisyVector
from ..vectors.shipped_vectors import shipped

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
MANY = 16  # windows
ROUNDED = 1e-12  # of orthonormal columns of all of a space, to its unit vectors
MANY_OF = ("one-fault", "two-faults")  # exact ranks of long windows take a second
Measure = Callable[[FaultVector, Function], Iterator[Measurement]]


def checks() -> Iterator[Check]:
    """Yield all checks of the module."""
    for noisy in shipped("noisy"):
        yield _noisy(noisy)
    for vector in shipped("faults"):
        yield from _in_views("residual-free-of-input", vector)
        yield from _in_views("window-ranks", vector)
        if vector.slug in MANY_OF:
            _, claim, effect, _ = PLAIN["window-ranks"]
            measure = partial(_many_windows, vector)
            yield Check("window-ranks-many-windows", "window_ranks", vector.slug, claim, effect, Severity.SILENT, measure)
        yield from _in_views("fault-dimension", vector)
        yield _as_many_as_outputs(vector)
        yield from _in_views("fault-space", vector)
        yield _window("fault-space-long-window", vector, LONG_WINDOW)
        yield _window("fault-space-shortest-window", vector, vector.lag + 1)
        yield from _in_views("fault-signal", vector)


def _in_views(slug: str, vector: FaultVector) -> Iterator[Check]:
    """Yield the check of PLAIN of the record as given and in every view that changes the question."""
    function, claim, effect, compare = PLAIN[slug]

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


def residual_off(vector: FaultVector, function: Function) -> Iterator[Measurement]:
    """Compare what the model's free response cannot touch, M(q) r with M(q) C A^k = 0, with the exact one: any initial state will do."""
    system = vector.system
    y, u = with_input(vector.r, system, vector.view.scale)
    got = function(floats(y), floats(u), *(floats(M) for M in (system.A, system.F, system.C, system.G)))
    answer = lifted(got, "r", vector.r.shape)
    off = answer - vector.r
    free = ResidualSystem.of(system.A, _no_columns(system.n), system.C, _no_columns(system.p), n=system.n, m=0, p=system.p)
    bound = vector.bounds["residual"]
    assert bound is not None
    units = channel_units(vector.r)
    for number, row in enumerate(kernel_representation(free).rows):
        coefficients = row.coefficients
        seen = beside(*(coefficients.rows([k]) for k in range(coefficients.nrows))) @ hankel(off, coefficients.nrows)
        # |M(q) d| <= sum_k |c_k U| |U^-1 d| for the channels' units U
        size = float(np.sum(np.linalg.norm(floats(scaled(coefficients, units)), axis=1)))
        given = {"kernel_row": fractions(coefficients)}
        sides = Sides("residual", fractions(answer), fractions(vector.r), size * bound, given)
        yield Measurement(f"kernel row {number} of r", float(np.linalg.norm(floats(seen))), size * bound, sides)


def _no_columns(rows: int) -> Matrix:
    """Return the matrix with so many rows and no columns."""
    return matrix([[] for _ in range(rows)], 0)


def window_ranks_off(vector: FaultVector | UnexcitingVector, function: Function) -> Iterator[Measurement]:
    """Ask for the ranks R_s for s = 1, 2, ... and compare them."""
    yield from ranks_off(function(floats(vector.r), len(vector.ranks)), vector.ranks)


def _many_windows(vector: FaultVector, function: Function) -> Iterator[Measurement]:
    due = many_ranks(vector)
    yield from ranks_off(function(floats(vector.r), len(due)), due)


def many_ranks(vector: FaultVector) -> tuple[int, ...]:
    """Return the ranks of all windows that are wider than high, MANY at most, which are clear in those of MANY_OF."""
    N, p = vector.r.nrows, vector.system.p
    return tuple(rank(hankel(vector.r, s)) for s in range(1, min(MANY, N // (p + 1)) + 1))


def ranks_off(answer: Any, due: tuple[int, ...]) -> Iterator[Measurement]:
    """Yield one measurement for each window. A number is a list of one, since some languages have no other."""
    ranks = [answer] if isinstance(answer, (int, float)) else list(answer)
    if len(ranks) != len(due):
        raise Broken(f"{counted(len(ranks), 'rank')} for {counted(len(due), 'window')}")
    for s, (got, exact) in enumerate(zip(ranks, due, strict=True), start=1):
        yield Measurement(f"rank R_{s}", abs(float(got) - exact), 0.0, Sides("ranks", [float(one) for one in ranks], list(due)))


def count_off(vector: FaultVector, function: Function) -> Iterator[Measurement]:
    yield compared_count("n_v", function(floats(vector.r)), vector.n_v)


def compared_count(quantity: str, answer: Any, due: int) -> Measurement:
    """Measure a number of faults against the one that is due."""
    got = as_number(answer)
    return Measurement(quantity, abs(got - due), 0.0, Sides("count", got, due))


def _as_many_as_outputs(vector: FaultVector) -> Check:
    """Ask about the first m outputs alone, between which m faults leave no relation, nor would noise."""
    slug, effect, first = "as-many-faults-as-outputs", "noise is taken for faults, or faults for noise", vector.r.columns(range(vector.n_v))
    return free_count(slug, vector.slug, effect, "n_v, as many as outputs", first, vector.n_v)


def free_count(slug: str, vector: str, effect: str, quantity: str, r: Matrix, due: int, claim: str = "proposition-3") -> Check:
    """Return the check that shows how many faults are counted in r; any answer is free."""

    def measure(function: Function) -> Iterator[Measurement]:
        yield compared_count(quantity, function(floats(r)), due)

    return Check(slug, "fault_dimension", vector, claim, effect, Severity.SOMETIMES, measure, Demand.FREE)


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
    measure = partial(space_off, vector, block_rows=block_rows)
    return Check(slug, "fault_space", vector.slug, "sharp-windows", WINDOW, Severity.SILENT, measure)


def spaces_off(got: Any, truth: Matrix, bound: float) -> Iterator[Measurement]:
    """Measure the dimension and the two-sided distance of the columns `got` from those of `truth`."""
    try:
        compared = compare_subspaces(np.asarray(got, dtype=float), floats(truth))
    except (InvalidData, ValueError, TypeError) as error:
        raise Broken(f"no basis of columns [f; g]: {error}") from None
    sides = Sides("space", np.asarray(got, dtype=float).tolist(), fractions(truth), bound)
    dimensions = replace(sides, of="dimension", answer=compared.dimensions[0], truth=compared.dimensions[1], bounds=0.0)
    yield Measurement("dimension of the fault space", float(abs(compared.dimensions[0] - compared.dimensions[1])), 0.0, dimensions)
    yield Measurement("sine of the largest angle, two-sided", compared.two_sided, bound, sides)


def signal_off(vector: FaultVector, function: Function) -> Iterator[Measurement]:
    """Compare v from the known initial state, up to the delay at the end of the record."""
    system, bound = vector.system, vector.bounds["signal"]
    assert bound is not None
    start = floats(vector.x0).ravel()
    got = function(floats(vector.r), *(floats(M) for M in (system.A, system.F, system.C, system.G)), start)
    answer = lifted(got, "v", vector.v.shape)
    off = floats(answer - vector.v)[: vector.trusted]
    sides = Sides("signal", fractions(answer)[: vector.trusted], fractions(vector.v)[: vector.trusted], bound)
    yield Measurement("v", float(np.linalg.norm(off)), bound, sides)


WINDOW = "fault matrices that change with the length of the window"
# What is asked of every record: slug -> function, claim, effect, what compares.
PLAIN: dict[str, tuple[str, str, str, Measure]] = {
    "residual-free-of-input": (
        "residual",
        "proposition-1",
        "the residual still holds the response to the input: input and fault cannot be told apart",
        residual_off,
    ),
    "window-ranks": ("window_ranks", "window-ranks", "wrong ranks of windows: wrong number of faults, wrong lag", window_ranks_off),
    "fault-dimension": ("fault_dimension", "proposition-3", "a wrong number of faults", count_off),
    "fault-space": ("fault_space", "problem-11", "fault matrices that do not explain the data, or true ones left out", space_off),
    "fault-signal": ("reconstruct", "trajectory-recovered", "a wrong fault signal: wrong size or time of a fault", signal_off),
}


def _noisy(vector: NoisyVector) -> Check:
    def measure(function: Function) -> Iterator[Measurement]:
        yield compared_count("n_v", function(vector.record()), vector.system.m)

    effect = "a wrong number of faults wherever there is any noise, were it a thousandth"
    return Check("fault-dimension-noisy", "fault_dimension", vector.slug, "proposition-3", effect, Severity.SILENT, measure)
