"""This is the system pencil P(q) = [[qI - A, -F], [C, G]] as a matrix of polynomials, and what its minors say.

PolynomialMatrix(height, width, rows)   entries as in `polynomials`
pencil(system)                   P(q), (n+p) x (n+m)
reversed_pencil(system)          [[I - tA, -tF], [tC, tG]]
minors(a)                        for each order k = 0, 1, ..., the minors of order k by Laplace's expansion
determinantal_divisors(a)        d_0 = 1, d_1, ..., d_rank: monic gcd of all minors of each order
polynomial_rank(a)               rank over the rational functions, by elimination without fractions
normal_rank(system)              rank P(q) - n
invariant_zero_polynomial(s)     product of the invariant polynomials of P(q): the last d_k
infinite_zero_orders_of_pencil   from the powers of t in the determinantal divisors of the reversed pencil
left_minimal_indices_of_pencil   from the dimensions of { y(q) : deg y <= d, y(q) P(q) = 0 }, d = 0, 1, ...
right_minimal_indices_of_pencil  the same of the transposed pencil
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations, pairwise
from typing import NamedTuple

from . import polynomials
from .fields import Element, Field
from .linear import identity, matrix, null_space
from .polynomials import Polynomial
from .systems import System, transposed

Choice = tuple[int, ...]


class PolynomialMatrix(NamedTuple):
    """This is height x width polynomials over `field`."""

    field: Field
    height: int
    width: int
    rows: list[list[Polynomial]]


def pencil(system: System) -> PolynomialMatrix:
    """The result is P(q) = [[qI - A, -F], [C, G]]."""
    one = identity(system.field, system.n).rows
    top = [
        [polynomials.trimmed([-a, i]) for a, i in zip(row_a, row_i, strict=True)] + [polynomials.trimmed([-f]) for f in row_f]
        for row_a, row_i, row_f in zip(system.A.rows, one, system.F.rows, strict=True)
    ]
    bottom = [[polynomials.trimmed([x]) for x in (*c, *g)] for c, g in zip(system.C.rows, system.G.rows, strict=True)]
    return PolynomialMatrix(system.field, system.n + system.p, system.n + system.m, top + bottom)


def reversed_pencil(system: System) -> PolynomialMatrix:
    """The result is [[I - tA, -tF], [tC, tG]]: t P(1/t) with the signs kept, whose zeros at t = 0 are those of P at infinity."""
    zero = system.field.zero
    one = identity(system.field, system.n).rows
    top = [
        [polynomials.trimmed([i, -a]) for a, i in zip(row_a, row_i, strict=True)] + [polynomials.trimmed([zero, -f]) for f in row_f]
        for row_a, row_i, row_f in zip(system.A.rows, one, system.F.rows, strict=True)
    ]
    bottom = [[polynomials.trimmed([zero, x]) for x in (*c, *g)] for c, g in zip(system.C.rows, system.G.rows, strict=True)]
    return PolynomialMatrix(system.field, system.n + system.p, system.n + system.m, top + bottom)


def minors(a: PolynomialMatrix) -> Iterator[dict[tuple[Choice, Choice], Polynomial]]:
    """For k = 0, 1, ..., min(height, width) these are all minors of order k, by the rows and columns chosen."""
    order: dict[tuple[Choice, Choice], Polynomial] = {((), ()): [a.field.one]}
    yield order
    for k in range(1, min(a.height, a.width) + 1):
        smaller, order = order, {}
        for rows in combinations(range(a.height), k):
            for columns in combinations(range(a.width), k):
                minor: Polynomial = []
                for position, column in enumerate(columns):
                    cofactor = smaller[rows[:-1], columns[:position] + columns[position + 1 :]]
                    term = polynomials.multiply(a.rows[rows[-1]][column], cofactor)
                    if (k - 1 + position) % 2:
                        term = polynomials.negate(term)
                    minor = polynomials.add(minor, term)
                order[rows, columns] = minor
        yield order


def determinantal_divisors(a: PolynomialMatrix) -> list[Polynomial]:
    """The result is d_0 = 1, ..., d_rank: d_k is the monic greatest common divisor of all minors of order k."""
    divisors = []
    for order in minors(a):
        divisor: Polynomial = []
        for minor in order.values():
            divisor = polynomials.gcd(divisor, minor)
        if not divisor:
            break
        divisors.append(divisor)
    return divisors


def polynomial_rank(a: PolynomialMatrix) -> int:
    """The result is the rank over the field of rational functions.

    Rows are eliminated crosswise, row_i := pivot row_i - entry pivot_row, and then freed of the common factor of their entries; neither
    changes the rank. Evaluation at points would not do: a small field has too few of them.
    """
    rows = [list(row) for row in a.rows]
    found = 0
    for j in range(a.width):
        candidate = next((i for i in range(found, a.height) if rows[i][j]), None)
        if candidate is None:
            continue
        rows[found], rows[candidate] = rows[candidate], rows[found]
        pivot_row = rows[found]
        for i in range(found + 1, a.height):
            if rows[i][j]:
                factor = rows[i][j]
                crossed = [
                    polynomials.subtract(polynomials.multiply(pivot_row[j], x), polynomials.multiply(factor, y))
                    for x, y in zip(rows[i], pivot_row, strict=True)
                ]
                rows[i] = _without_common_factor(crossed)
        found += 1
    return found


def normal_rank(system: System) -> int:
    """The result is the normal rank of C (qI - A)^-1 F + G, as that of the pencil less n."""
    return polynomial_rank(pencil(system)) - system.n


def invariant_zero_polynomial(system: System) -> Polynomial:
    """The result is the monic gcd of the minors of order n + r, r the normal rank: the product of all invariant polynomials."""
    return determinantal_divisors(pencil(system))[-1]


def infinite_zero_orders_of_pencil(system: System) -> list[int]:
    """These are the infinite zero orders, ascending: d - 1 for each elementary divisor t^d, d >= 1, of the reversed pencil.

    The powers of t in consecutive determinantal divisors differ by the d's; the power in a gcd is the least among the minors.
    """
    powers = []
    for order in minors(reversed_pencil(system)):
        valuations = [polynomials.valuation(minor) for minor in order.values() if minor]
        if not valuations:
            break
        powers.append(min(valuations))
    degrees = [b - a for a, b in pairwise(powers)]
    return sorted(d - 1 for d in degrees if d)


def left_minimal_indices_of_pencil(system: System) -> list[int]:
    """These are the left minimal indices, ascending, from the rows y(q) that annihilate the pencil.

    With minimal indices eta_i these rows of degree at most d make up a space of dimension sum max(0, d + 1 - eta_i), whose second
    difference in d counts the indices equal to d. No index exceeds n, since they and more sum up to n.
    """
    a = pencil(system)
    dimensions = [0, 0] + [_annihilator_dimension(a, d) for d in range(system.n + 1)]
    indices = []
    for d in range(system.n + 1):
        indices += [d] * (dimensions[d + 2] - 2 * dimensions[d + 1] + dimensions[d])
    return indices


def right_minimal_indices_of_pencil(system: System) -> list[int]:
    """These are the right minimal indices, ascending."""
    return left_minimal_indices_of_pencil(transposed(system))


def _annihilator_dimension(a: PolynomialMatrix, d: int) -> int:
    """The result is the dimension of { y(q) of degree at most d : y(q) a(q) = 0 }, by comparing coefficients of all powers of q."""
    zero = a.field.zero
    highest = max((len(x) for row in a.rows for x in row), default=0)
    unknowns = [(k, i) for k in range(d + 1) for i in range(a.height)]

    def coefficient(i: int, j: int, k: int) -> Element:
        return a.rows[i][j][k] if 0 <= k < len(a.rows[i][j]) else zero

    equations = [[coefficient(i, j, total - k) for k, i in unknowns] for total in range(d + highest) for j in range(a.width)]
    return null_space(matrix(a.field, len(equations), len(unknowns), equations)).height


def _without_common_factor(row: list[Polynomial]) -> list[Polynomial]:
    factor: Polynomial = []
    for x in row:
        factor = polynomials.gcd(factor, x)
    return [polynomials.exact_quotient(x, factor) for x in row] if factor else row
