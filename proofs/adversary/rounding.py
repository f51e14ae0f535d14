"""This goes from a float close to the zero set to a rational point on it.

    simple             the points of few digits around a float
    rational_roots     the rational zeros of a rational function of one parameter, known by exact values: reconstructed, then factored
    solve_affine       equations that are affine in some parameters, solved for them
    bracket            two exact points on a line whose quantities have opposite signs, as near as asked

A rational function N/D with deg N + deg D <= count - 3 is found from `count` values by interpolation and the Euclidean algorithm, and the
last values check it: Cauchy's interpolation.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from math import ceil, floor

from flint import fmpq, fmpq_poly

from ...exact.algebra.fields import QQ
from ...exact.algebra.matrices import Matrix, solve_left
from ..evidence.attacks import Floats, Point

HALVINGS = 12
DENOMINATORS = (1, 2, 3, 4, 6, 8, 12, 20, 32)


def simple(point: Floats, box: Sequence[tuple[float, float]], denominators: Sequence[int] = DENOMINATORS) -> Iterator[Point]:
    """Yield the nearest points with small denominators inside the box, each once."""
    seen = set()
    for bottom in denominators:
        rounded = tuple(
            Fraction(min(max(round(x * bottom), ceil(low * bottom)), floor(high * bottom)), bottom)
            for x, (low, high) in zip(point, box, strict=True)
        )
        if rounded not in seen and all(low <= x <= high for x, (low, high) in zip(rounded, box, strict=True)):
            seen.add(rounded)
            yield rounded


def moved(point: Point, place: int, value: Fraction) -> Point:
    """Return the point with one coordinate replaced."""
    return (*point[:place], value, *point[place + 1 :])


def rational_roots(value: Callable[[Fraction], Fraction], low: Fraction, high: Fraction, *, most: int = 16) -> tuple[Fraction, ...] | None:
    """Return the rational zeros in (low, high) of a rational function; None where its degrees are too large for `most` values."""
    xs: list[fmpq] = []
    ys: list[fmpq] = []
    for count in (6, 10, most):
        while len(xs) < count:
            x = low + (high - low) * Fraction(len(xs) + 1, most + 2)
            y = value(x)
            xs.append(fmpq(x.numerator, x.denominator))
            ys.append(fmpq(y.numerator, y.denominator))
        numerator = _numerator(xs, ys)
        if numerator is not None:
            return tuple(r for r in _roots(numerator) if low < r < high)
    return None


def _numerator(xs: Sequence[fmpq], ys: Sequence[fmpq]) -> fmpq_poly | None:
    """Return the numerator of the rational function of least degree with these values; None where it uses up all of them."""
    modulus, interpolant = fmpq_poly([1]), fmpq_poly([0])
    for x, y in zip(xs, ys, strict=True):
        interpolant += modulus * ((y - interpolant(x)) / modulus(x))
        modulus *= fmpq_poly([-x, 1])
    before, now, factor_before, factor = modulus, interpolant, fmpq_poly([0]), fmpq_poly([1])
    best: tuple[int, fmpq_poly] | None = None
    while now.degree() >= 0:
        size = now.degree() + factor.degree()
        if (best is None or size < best[0]) and all(factor(x) != 0 for x in xs):
            best = size, now
        quotient, rest = divmod(before, now)
        before, now = now, rest
        factor_before, factor = factor, factor_before - quotient * factor
    return best[1] if best is not None and best[0] <= len(xs) - 3 else None


def _roots(polynomial: fmpq_poly) -> list[Fraction]:
    _, factors = polynomial.factor()
    found = []
    for one, _ in factors:
        if one.degree() == 1:
            constant, slope = one.coeffs()
            root = -constant / slope
            found.append(Fraction(int(root.p), int(root.q)))
    return sorted(found)


def solve_affine(equations: Callable[[Point], Sequence[Fraction]], point: Point, places: Sequence[int]) -> Point | None:
    """Return the nearest point with only these coordinates changed where the equations vanish; None where they are not affine, or
    contradict."""
    constant = list(equations(point))
    slopes = [[a - b for a, b in zip(equations(moved(point, i, point[i] + 1)), constant, strict=True)] for i in places]
    S = Matrix.of([[str(x) for x in row] for row in slopes], QQ, shape=(len(places), len(constant)))
    weights = solve_left(S.transposed() @ S, Matrix.of([[str(-x) for x in constant]], QQ, shape=(1, len(constant))))
    if weights is None:
        return None
    result = point
    for i, x in zip(places, (weights @ S.transposed()).elements()[0], strict=True):
        result = moved(result, i, point[i] + Fraction(int(x.p), int(x.q)))
    return result if all(x == 0 for x in equations(result)) else None


def bracket(value: Callable[[Fraction], Fraction], low: Fraction, high: Fraction) -> tuple[Fraction, Fraction] | None:
    """Return two points between which the sign changes, from two such points by bisection; None where the signs agree."""
    at_low, at_high = value(low), value(high)
    if at_low * at_high >= 0:
        return None
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        at_middle = value(middle)
        if at_middle == 0:
            return middle, middle
        low, high = (middle, high) if at_low * at_middle > 0 else (low, middle)
    return low, high
