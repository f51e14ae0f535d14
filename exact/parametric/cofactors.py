"""This is the exceptional polynomial with every entry of A, C, F, G and of P an indeterminate: genericity as an identity, not a sample.

    generic_exceptional                       all entries indeterminate
    generic_exceptional_without_feedthrough   G = 0, the others indeterminate; m < p, m <= n
    GenericExceptional                        normal rank, n_z, zeta, a basis of Z over Q(entries), b, a, D and the minors of the pencil
    Cofactor                                  a row set I and c_I with minor_I(pencil of the pair) = c_I D

Over the field Q(entries): the ranks of [O_s T_s], s = n and n + 1, are as large as the numbers of rows and of nonzero columns allow,
since they are so at one integer point; that gives r, n_z and zeta. Three bases of Z:

    m < p              [F; G]              zeta = 0,  D = +- det P
    m < p, G = 0       [F, AF; 0, CF]      zeta = m,  D = +- det(P1 + q P2)
    m >= p             the unit columns    zeta = n,  D = +- the pencil determinant of (A, P1, C, P2)

In each, every maximal minor of the pencil of (A, Fhat P, C, Ghat P) is c_I D, multiplied out in sympy's ring and again by FLINT, and the
c_I have no common factor in Q(entries)[q]: at the point they have none, and one of them keeps its degree there. They may share a
polynomial in the entries alone, a unit of that ring: with G = 0 and n = m it is det F. So D is the greatest
common divisor of the minors over Q(entries)(P)[q], and what is bad generically is D = 0. Source: [G25] Theorem 3.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from ...base.errors import InvalidInput
from ..algebra import polynomials
from ..algebra.fields import QQ
from ..algebra.matrices import Matrix
from ..algebra.validation import natural
from ..pairs.polynomial import exceptional
from ..structure.kernel_rows import kernel_representation
from ..system.systems import ResidualSystem
from .case_tree import Polynomial, coefficients, evaluate
from .identities import IdentityFailure, SecondRoute, flint_determinant
from .pencil import determinant, indeterminate_pencil
from .stratification import Indeterminates, indeterminates, times

LARGEST = (2, 3, 2)

Rows = tuple[tuple[Polynomial, ...], ...]


@dataclass(frozen=True)
class Cofactor:
    """The minor of the pair's pencil on these rows is `cofactor` times D."""

    rows: tuple[int, ...]
    cofactor: Polynomial


@dataclass(frozen=True)
class GenericExceptional:
    """Polynomials are elements of `entries.ring`, whose last generators p11, p12, ... are the entries of P, n_z x r.

    `basis` is (n + p) x n_z, `b` and `a` n_z x zeta, `polynomial` = det [P | q b - a]; `point` holds integer values
    of A, C, F, G at which the ranks are attained; `expanded` counts what FLINT multiplied out.
    """

    entries: Indeterminates
    normal_rank: int
    zeta: int
    basis: Rows
    b: Rows
    a: Rows
    polynomial: Polynomial
    cofactors: tuple[Cofactor, ...]
    point: tuple[int, ...]
    expanded: int

    @property
    def n_z(self) -> int:
        """n_z is r + zeta."""
        return self.normal_rank + self.zeta


def generic_exceptional(n: int, p: int, m: int) -> GenericExceptional:
    """All entries of A (n x n), C (p x n), F (n x m), G (p x m) are indeterminate. Raises InvalidInput beyond n = 2, p = 3, m = 2."""
    return _generic(n, p, m, zero_feedthrough=False)


def generic_exceptional_without_feedthrough(n: int, p: int, m: int) -> GenericExceptional:
    """G is 0, all other entries are indeterminate. Raises InvalidInput unless m < p and m <= n, and beyond n = 2, p = 3, m = 2."""
    if not (m < p and m <= n):
        raise InvalidInput(f"m: got {m} with n = {n}, p = {p}; without feedthrough expected m < p and m <= n")
    return _generic(n, p, m, zero_feedthrough=True)


def _generic(n: int, p: int, m: int, *, zero_feedthrough: bool) -> GenericExceptional:
    for name, value, largest in zip("npm", (n, p, m), LARGEST, strict=True):
        natural(value, name, most=largest)
    r = min(p, m)
    zeta = n if m >= p else m if zero_feedthrough else 0
    names = [f"p{i + 1}{j + 1}" for i in range(r + zeta) for j in range(r)]
    entries = indeterminates(n, p, m, names)
    ring = entries.ring
    P = _table(list(ring.gens[entries.parameters + 1 :]), r + zeta, r)
    basis, b, a = _space(entries, zero_feedthrough)
    columns = [times(row, P, r, ring) for row in basis]
    matrix = indeterminate_pencil(entries, columns[:n], columns[n:])
    inner = [[*line, *(entries.q * x - y for x, y in zip(left, right, strict=True))] for line, left, right in zip(P, b, a, strict=True)]
    D = determinant(entries, inner, _full(r + zeta))
    route = SecondRoute(ring)
    images = [[route(f) for f in line] for line in matrix]
    route.equal(flint_determinant(route, [[route(f) for f in line] for line in inner]), route(D), "D")
    cofactors = []
    for rows in combinations(range(n + p), n + r):
        minor = determinant(entries, matrix, (rows, tuple(range(n + r))))
        cofactor, rest = minor.div(D)
        if rest:
            raise IdentityFailure(f"D does not divide the minor of the rows {rows}")
        route.equal(flint_determinant(route, [images[i] for i in rows]), route(cofactor) * route(D), f"minor of the rows {rows}")
        cofactors.append(Cofactor(rows, cofactor))
    point = _point(entries, zero_feedthrough, zeta, [c.cofactor for c in cofactors])
    return GenericExceptional(entries, r, zeta, basis, b, a, D, tuple(cofactors), point, route.expanded)


def _space(entries: Indeterminates, zero_feedthrough: bool) -> tuple[Rows, Rows, Rows]:
    """Return a basis of Z as (n + p) x n_z, with b and a."""
    n, p, m, ring = entries.n, entries.p, entries.m, entries.ring

    def unit(size: int) -> list[list[Polynomial]]:
        return [[ring.one if i == j else ring.zero for j in range(size)] for i in range(size)]

    if m >= p:
        return _frozen(unit(n + p)), _frozen([line[:n] for line in unit(n + p)]), _frozen([*entries.A, *entries.C])
    if not zero_feedthrough:
        return _frozen([*entries.F, *entries.G]), _frozen([[]] * m), _frozen([[]] * m)
    states = [[*line, *times(row, entries.F, m, ring)] for line, row in zip(entries.F, entries.A, strict=True)]
    outputs = [[*[ring.zero] * m, *times(row, entries.F, m, ring)] for row in entries.C]
    nothing = [[ring.zero] * m for _ in range(m)]
    return _frozen([*states, *outputs]), _frozen([*unit(m), *nothing]), _frozen([*nothing, *unit(m)])


def _point(entries: Indeterminates, zero_feedthrough: bool, zeta: int, cofactors: Sequence[Polynomial]) -> tuple[int, ...]:
    """Return integer values where the ranks are the largest possible and the cofactors have no common factor, one of them of full
    degree.
    """
    n, p, m = entries.n, entries.p, entries.m
    silent = p * m if zero_feedthrough else 0
    rng = random.Random(0)
    for _ in range(1000):
        values = [rng.randint(-9, 9) for _ in range(entries.parameters - silent)] + [0] * silent
        kernel = kernel_representation(_system(entries, values))
        most = [min(s * p, n + max(0, s - zero_feedthrough) * m) for s in (n, n + 1)]
        if [kernel.rank(n), kernel.rank(n + 1)] != most or exceptional(kernel).zeta != zeta:
            continue
        if _coprime(entries, values, cofactors):
            return tuple(values)
    raise ArithmeticError("no generic point was found among a thousand")


def _coprime(entries: Indeterminates, values: Sequence[int], cofactors: Sequence[Polynomial]) -> bool:
    common: polynomials.Poly = ()
    kept = False
    for cofactor in cofactors:
        at_values = [QQ.element(int(evaluate(c, values))) for c in coefficients(cofactor, entries.parameters)]
        kept = kept or bool(at_values and at_values[-1] != 0)
        common = polynomials.gcd(common, polynomials.trimmed(at_values))
    return kept and len(common) == 1


def _system(entries: Indeterminates, values: Sequence[int]) -> ResidualSystem:
    n, p, m = entries.n, entries.p, entries.m
    rest = iter(values)
    shapes = {"A": (n, n), "C": (p, n), "F": (n, m), "G": (p, m)}
    parts = {k: Matrix.of([[next(rest) for _ in range(w)] for _ in range(h)], QQ, shape=(h, w)) for k, (h, w) in shapes.items()}
    return ResidualSystem(parts["A"], parts["F"], parts["C"], parts["G"])


def _table(items: Sequence[Polynomial], height: int, width: int) -> list[list[Polynomial]]:
    return [list(items[i * width : (i + 1) * width]) for i in range(height)]


def _full(size: int) -> tuple[tuple[int, ...], tuple[int, ...]]:
    return tuple(range(size)), tuple(range(size))


def _frozen(rows: Sequence[Sequence[Polynomial]]) -> Rows:
    return tuple(tuple(row) for row in rows)
