"""This decides left-invertibility along the line of faults a F + b F', a G + b G', for every (a : b) over every extension of the field.

determinant(field, rows)    of polynomials in q and b (a = 1), by Leibniz
maximal_minors(one, two)    those of [[qI - A, -(aF + bF')], [C, aG + bG']], as {(power of q, power of b): element}
binary_forms(one, two)      the coefficients of the powers of q in them, forms of degree m in (a, b), by powers of b
holds(one, two)             whether the forms have no common zero

For a fixed (a : b) the normal rank is n + m iff some maximal minor is not the zero polynomial in q, so the exceptions are the common zeros
of the forms. Their gcd over K is one over every extension.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations, permutations

from . import polynomials
from .fields import Element, Field
from .systems import System

Bivariate = dict[tuple[int, int], Element]


def multiply(a: Bivariate, b: Bivariate) -> Bivariate:
    """The result is a b."""
    product: Bivariate = {}
    for (i, k), x in a.items():
        for (j, h), y in b.items():
            product[i + j, k + h] = product[i + j, k + h] + x * y if (i + j, k + h) in product else x * y
    return product


def determinant(field: Field, rows: list[list[Bivariate]]) -> Bivariate:
    """The result is the sum over all permutations, which is 1 for no rows."""
    total: Bivariate = {}
    for order in permutations(range(len(rows))):
        inversions = sum(1 for i, j in combinations(range(len(order)), 2) if order[i] > order[j])
        term: Bivariate = {(0, 0): field.integer((-1) ** inversions)}
        for row, j in zip(rows, order, strict=True):
            term = multiply(term, row[j])
        for powers, x in term.items():
            total[powers] = total[powers] + x if powers in total else x
    return {powers: x for powers, x in total.items() if x}


def maximal_minors(first: System, second: System) -> Iterator[Bivariate]:
    """These choose n + m of the n + p rows at a time; there are none when there are too few."""
    field, n, m, p = first.field, first.n, first.m, first.p

    def entry(**terms: Element) -> Bivariate:
        powers = {"constant": (0, 0), "q": (1, 0), "b": (0, 1)}
        return {powers[name]: x for name, x in terms.items() if x}

    rows = [
        [entry(constant=-first.A.rows[i][j], q=field.integer(int(i == j))) for j in range(n)]
        + [entry(constant=-first.F.rows[i][j], b=-second.F.rows[i][j]) for j in range(m)]
        for i in range(n)
    ]
    rows += [
        [entry(constant=first.C.rows[i][j]) for j in range(n)]
        + [entry(constant=first.G.rows[i][j], b=second.G.rows[i][j]) for j in range(m)]
        for i in range(p)
    ]
    for chosen in combinations(rows, n + m):
        yield determinant(field, list(chosen))


def binary_forms(first: System, second: System) -> list[list[Element]]:
    """Each form is given by its coefficients of a^m, a^(m-1) b, ..., b^m."""
    field = first.field
    return [
        [minor.get((i, k), field.zero) for k in range(first.m + 1)] for minor in maximal_minors(first, second) for i in range(first.n + 1)
    ]


def holds(first: System, second: System) -> bool:
    """This tells whether no (a : b) is a zero of all forms: not (0 : 1), and no (1 : b), of which a gcd would tell."""
    forms = binary_forms(first, second)
    common: polynomials.Polynomial = []
    for form in forms:
        common = polynomials.gcd(common, polynomials.trimmed(form))
    return any(form[-1] for form in forms) and polynomials.degree(common) == 0
