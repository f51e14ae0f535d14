"""Checks of residuals, window ranks, the number of faults, the fault space and the fault signal.

residual_checks, rank_checks, count_checks, space_checks, signal_checks     the generators
with_input                                                                  data whose residual is known
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from faultspace.exact.kernel_representation import kernel_representation
from faultspace.exact.matrices import Matrix, stacked
from faultspace.exact.signals import simulate
from faultspace.exact.systems import ResidualSystem

from ..distances import compare_subspaces
from ..input_checks import InvalidData
from .exact_comparison import lifted
from .records import Broken, Check, Function, Kind, Measurement, Severity
from .vectors import FaultVector, floats, matrix, scaled, shipped

Array = NDArray[np.float64]
SCALES = (-12, -6, 6)  # powers of ten


def checks() -> Iterator[Check]:
    """All of this module."""
    for vector in shipped("faults"):
        yield from residual_checks(vector)
        yield from rank_checks(vector)
        yield from count_checks(vector)
        yield from space_checks(vector)
        yield from signal_checks(vector)


def with_input(r: Matrix, system: ResidualSystem) -> tuple[Matrix, Matrix]:
    """(y, u): r plus the response from rest to u = 1, -1, 1, ... in every channel, for the model B = F, D = G."""
    u = matrix([[(-1) ** k] * system.m for k in range(r.nrows)], system.m)
    return r + simulate(system, Matrix.zero(system.field, system.n, 1), u).residuals, u


def residual_checks(vector: FaultVector) -> Iterator[Check]:
    """What the free response of the model cannot touch, M(q) r with M(q) C A^k = 0, against the exact one: any initial state will do."""

    def measure(function: Function) -> Iterator[Measurement]:
        system = vector.system
        y, u = with_input(vector.r, system)
        got = function(floats(y), floats(u), *(floats(M) for M in (system.A, system.F, system.C, system.G)))
        off = lifted(got, "r", vector.r.shape) - vector.r
        free = ResidualSystem.of(system.A, _no_columns(system.n), system.C, _no_columns(system.p), n=system.n, m=0, p=system.p)
        bound = vector.bounds["residual"]
        assert bound is not None
        for number, row in enumerate(kernel_representation(free).rows):
            coefficients = row.coefficients
            degree = coefficients.nrows - 1
            seen = stacked(*(_applied(coefficients, off, k) for k in range(off.nrows - degree)))
            # |M(q) d| <= sum_k |c_k| |d|
            size = float(np.sum(np.linalg.norm(floats(coefficients), axis=1)))
            yield Measurement(f"kernel row {number} of r", float(np.linalg.norm(floats(seen))), size * bound)

    effect = "the residual still holds the response to the input: input and fault cannot be told apart"
    yield Check("residual-free-of-input", "residual", vector.slug, "proposition-1", effect, Severity.SILENT, measure)


def _no_columns(rows: int) -> Matrix:
    """A matrix without columns."""
    return matrix([[] for _ in range(rows)], 0)


def _applied(coefficients: Matrix, signal: Matrix, first: int) -> Matrix:
    """sum_k c_k signal(first + k), 1 x 1."""
    total = Matrix.zero(signal.field, 1, 1)
    for k in range(coefficients.nrows):
        total = total + coefficients.rows([k]) @ signal.rows([first + k]).transposed()
    return total


def rank_checks(vector: FaultVector) -> Iterator[Check]:
    """rank R_s for s = 1, 2, ..., as given and in other units."""

    def at(power: int) -> Check:
        def measure(function: Function) -> Iterator[Measurement]:
            ranks = list(function(scaled_record(vector, power), len(vector.ranks)))
            if len(ranks) != len(vector.ranks):
                raise Broken(f"{len(ranks)} ranks for {len(vector.ranks)} windows")
            for s, (got, due) in enumerate(zip(ranks, vector.ranks, strict=True), start=1):
                yield Measurement(f"rank R_{s}", abs(float(got) - due), 0.0)

        slug = "window-ranks" + (f"-1e{power}" if power else "")
        effect = "wrong ranks of windows: wrong number of faults, wrong lag" + (" whenever the units change" if power else "")
        return Check(slug, "window_ranks", vector.slug, "window-ranks", effect, Severity.SILENT, measure)

    yield from (at(power) for power in (0, *SCALES))


def scaled_record(vector: FaultVector, power: int) -> Array:
    """The floats of 10^power r, rounded once."""
    return floats(scaled(vector.r, [Fraction(10) ** power] * vector.system.p))


def count_checks(vector: FaultVector) -> Iterator[Check]:
    """n_v, as given and in other units."""

    def at(power: int) -> Check:
        def measure(function: Function) -> Iterator[Measurement]:
            got = function(scaled_record(vector, power))
            yield Measurement("n_v", abs(_number(got) - vector.n_v), 0.0)

        slug = "fault-dimension" + (f"-1e{power}" if power else "")
        effect = "a wrong number of faults" + (" whenever the units change" if power else "")
        return Check(slug, "fault_dimension", vector.slug, "proposition-3", effect, Severity.SILENT, measure)

    yield from (at(power) for power in (0, *SCALES))
    yield _as_many_as_outputs(vector)


def _as_many_as_outputs(vector: FaultVector) -> Check:
    """The first m outputs alone: m faults leave no relation between them, nor would noise. Free: whatever is said is told."""

    def measure(function: Function) -> Iterator[Measurement]:
        got = function(floats(vector.r.columns(range(vector.n_v))))
        yield Measurement("n_v, as many as outputs", abs(_number(got) - vector.n_v), 0.0)

    effect = "noise is taken for faults, or faults for noise"
    slug, severity = "as-many-faults-as-outputs", Severity.SOMETIMES
    return Check(slug, "fault_dimension", vector.slug, "proposition-3", effect, severity, measure, Kind.FREE)


def _number(value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise Broken(f"n_v is {value!r}, no number") from None


def space_checks(vector: FaultVector) -> Iterator[Check]:
    """The fault space by the two-sided distance: neither too small nor too large."""

    def at(power: int) -> Check:
        def measure(function: Function) -> Iterator[Measurement]:
            # A scaled residual is that of a scaled fault signal: the columns stay what they are.
            system = vector.system
            got = function(scaled_record(vector, power), floats(system.A), floats(system.C), vector.n_v)
            bound = vector.bounds["space"]
            assert bound is not None
            yield from _spaces_off(got, vector.space, bound)

        slug = "fault-space" + (f"-1e{power}" if power else "")
        effect = "fault matrices that do not explain the data, or true ones left out" + (", whenever the units change" if power else "")
        return Check(slug, "fault_space", vector.slug, "problem-11", effect, Severity.SILENT, measure)

    yield from (at(power) for power in (0, *SCALES))
    yield _other_basis(vector)


def _other_basis(vector: FaultVector) -> Check:
    """With T A T^-1 and C T^-1, T upper triangular of ones. The map diag(T, I) stretches no angle by more than its condition, and neither
    does it the errors that rounding makes in the new basis: the bound grows by its square.
    """

    def measure(function: Function) -> Iterator[Measurement]:
        system = vector.system
        n = system.n
        T = matrix([[int(j >= i) for j in range(n)] for i in range(n)], n)
        inverse = matrix([[int(j == i) - int(j == i + 1) for j in range(n)] for i in range(n)], n)
        A, C = T @ system.A @ inverse, system.C @ inverse
        truth = stacked(T @ vector.space.rows(range(n)), vector.space.rows(range(n, n + system.p)))
        got = function(floats(vector.r), floats(A), floats(C), vector.n_v)
        values = np.append(np.linalg.svd(floats(T), compute_uv=False), 1.0)
        bound = vector.bounds["space"]
        assert bound is not None
        yield from _spaces_off(got, truth, bound * float(values.max() / values.min()) ** 2)

    effect = "fault matrices that depend on the basis of the states, which nobody sees"
    return Check("fault-space-other-basis", "fault_space", vector.slug, "problem-11", effect, Severity.SILENT, measure)


def _spaces_off(got: Any, truth: Matrix, bound: float) -> Iterator[Measurement]:
    """Dimension and two-sided distance of the columns `got` from those of `truth`."""
    try:
        compared = compare_subspaces(np.asarray(got, dtype=float), floats(truth))
    except (InvalidData, ValueError, TypeError) as error:
        raise Broken(f"no basis of columns [f; g]: {error}") from None
    yield Measurement("dimension of the fault space", float(abs(compared.dimensions[0] - compared.dimensions[1])), 0.0)
    yield Measurement("sine of the largest angle, two-sided", compared.two_sided, bound)


def signal_checks(vector: FaultVector) -> Iterator[Check]:
    """v from the known initial state, up to the delay at the end of the record."""
    bound = vector.bounds["signal"]
    if bound is None:
        return

    def measure(function: Function) -> Iterator[Measurement]:
        system = vector.system
        start = floats(vector.x0).ravel()
        got = function(floats(vector.r), *(floats(M) for M in (system.A, system.F, system.C, system.G)), start)
        off = floats(lifted(got, "v", vector.v.shape) - vector.v)[: vector.trusted]
        yield Measurement("v", float(np.linalg.norm(off)), bound)

    effect = "a wrong fault signal: wrong size or time of a fault"
    yield Check("fault-signal", "reconstruct", vector.slug, "trajectory-recovered", effect, Severity.SILENT, measure)
