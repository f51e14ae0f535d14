"""FLINT expands again what `parametric_pencil` states about a branch.

Minors are expanded along rows here and found by a characteristic polynomial there; P(q) and T_s are built from their
definitions a second time. Each function raises IdentityFailure at the first statement that does not hold.

    verify_normal_rank      minors of size rank + 1 are 0, one of size rank is not
    verify_finite_zeros     the divisor is a combination of the maximal minors and divides each of them
    verify_echelon_rows     the reduced rows of T_s are triangular; every row of T_s is one of them or depends on earlier ones
"""

from __future__ import annotations

from .case_tree import Branch
from .identities import FlintPolynomial, FlintWindow, IdentityFailure, SecondRoute, flint_determinant
from .pencil import Echelon, FiniteZeros, Minor, NormalRank, minors_of_size
from .stratification import Indeterminates


def flint_pencil(window: FlintWindow, q: FlintPolynomial) -> list[list[FlintPolynomial]]:
    """Return [[q I - A, -F], [C, G]]."""
    upper = [[q - f if i == j else -f for j, f in enumerate(row)] + [-f for f in window.F[i]] for i, row in enumerate(window.A)]
    return upper + [[*c, *g] for c, g in zip(window.C, window.G, strict=True)]


def verify_normal_rank(window: FlintWindow, entries: Indeterminates, branch: Branch, found: NormalRank) -> None:
    """The pencil has normal rank found.rank at every value on the branch."""
    route = window.route
    matrix = flint_pencil(window, route.generator("q"))
    height, width = entries.n + entries.p, entries.n + entries.m
    larger = minors_of_size(height, width, found.rank + 1) if found.rank < min(height, width) else []
    if [minor for minor, _ in found.vanishing] != larger:
        raise IdentityFailure("the minors shown to vanish are not all of their size")
    for minor, congruence in found.vanishing:
        if congruence.remainder:
            raise IdentityFailure("a minor of the pencil does not vanish")
        route.congruent(branch, _minor(route, matrix, minor), congruence, "minor of the pencil")
    if found.witness not in minors_of_size(height, width, found.rank):
        raise IdentityFailure("the witness is no minor of the stated size")
    coefficient = _coefficient(route, _minor(route, matrix, found.witness), found.power)
    route.congruent(branch, coefficient, found.congruence, "nonzero minor of the pencil")
    route.equal(route(found.congruence.remainder), route.unit(branch, found.unit), "unit")


def verify_finite_zeros(window: FlintWindow, entries: Indeterminates, branch: Branch, found: FiniteZeros) -> None:
    """found.divisor, of degree found.degree in q at every value on the branch, is the gcd of the maximal minors."""
    route = window.route
    matrix = flint_pencil(window, route.generator("q"))
    minors = minors_of_size(entries.n + entries.p, entries.n + entries.m, entries.n + entries.m)
    if list(found.minors) != minors:
        raise IdentityFailure("the minors divided are not all maximal ones")
    divisor = route(found.divisor)
    degrees = [exponents[_place(route)] for exponents in divisor.to_dict()]
    if not degrees or max(degrees) != found.degree:
        raise IdentityFailure("the divisor has not the stated degree")
    route.equal(_coefficient(route, divisor, found.degree), route.unit(branch, found.leading), "leading coefficient")
    values = [_minor(route, matrix, minor) for minor in minors]
    total = -divisor
    for factor, value in zip(found.bezout, values, strict=True):
        total += route(factor) * value
    statements = [(total, found.combination)]
    for scale, value, quotient, congruence in zip(found.scales, values, found.quotients, found.multiples, strict=True):
        statements.append((route.unit(branch, scale) * value - route(quotient) * divisor, congruence))
    for left, congruence in statements:
        if congruence.remainder:
            raise IdentityFailure("the divisor is not the greatest common divisor of the minors")
        route.congruent(branch, left, congruence, "greatest common divisor of the minors")


def verify_echelon_rows(window: FlintWindow, entries: Indeterminates, branch: Branch, found: Echelon) -> None:
    """This checks that the ranks of found.rank are those of T_s at every value on the branch."""
    route, n = window.route, entries.n
    if [row.row for row in found.rows] != [(k, i) for k in range(found.samples) for i in range(entries.p)]:
        raise IdentityFailure("the rows are not those of T_s in the order of time")
    pivots: list[int] = []
    for row in found.rows:
        top, leading = max(row.coefficients, key=lambda pair: pair[0])
        if top != row.row:
            raise IdentityFailure(f"row {row.row} is combined with later rows")
        route.equal(route(leading), route.unit(branch, row.leading), "leading coefficient")
        if any(congruence.remainder for congruence in row.congruences):
            raise IdentityFailure(f"row {row.row} differs from what it was reduced to")
        lines = [(window.rows[key], route(f)) for key, f in row.coefficients]
        for column, (stated, congruence) in enumerate(zip(row.residual, row.congruences, strict=True)):
            left = -route(stated)
            for line, f in lines:
                left += f * line[n + column]
            route.congruent(branch, left, congruence, f"row {row.row} of T_s, column {column}")
        if len(row.residual) != found.samples * entries.m:
            raise IdentityFailure(f"row {row.row} has not the width of T_s")
        if row.pivot is None:
            if any(row.residual):
                raise IdentityFailure(f"row {row.row} is not 0")
            continue
        if row.pivot_value is None or any(row.residual[c] for c in pivots):
            raise IdentityFailure(f"row {row.row} is not reduced by the rows before it")
        route.equal(route(row.residual[row.pivot]), route.unit(branch, row.pivot_value), "pivot")
        pivots.append(row.pivot)


def _minor(route: SecondRoute, matrix: list[list[FlintPolynomial]], minor: Minor) -> FlintPolynomial:
    rows, columns = minor
    return flint_determinant(route, [[matrix[i][j] for j in columns] for i in rows])


def _place(route: SecondRoute) -> int:
    return route.names.index("q")


def _coefficient(route: SecondRoute, f: FlintPolynomial, power: int) -> FlintPolynomial:
    """Return the coefficient of q**power."""
    q = _place(route)
    terms = {
        tuple(0 if place == q else exponent for place, exponent in enumerate(exponents)): coefficient
        for exponents, coefficient in f.to_dict().items()
        if exponents[q] == power
    }
    return route.context.from_dict(terms)
