"""Certificates of lines of faults as terms of Rocq: recomputed by the check of theory/field_checks/FieldLines.v, over Q, Q(a) and GF(p).

    left_invertible_line   writes left-invertible-line
    Shown                  what Rocq is told of the pencil at one point
    shown_at               the same, from the point and the rows of a minor

The theorem is about all a and b, but (0, 0), of every field in which the numbers of the systems mean something. Q is Q(a) where a is the
root 0 of q, as for zeros. The certificate tells points and rows: at a point its minor as a polynomial in t, for (a : b) = (1 : t), is
computed here exactly, by elimination of the states and a diagonal form of what is left, with what shows that the pencil has full rank where
it is not zero; and a combination of the minors that is 1. For (0 : 1) one of the minors is told with the two systems exchanged. They are
believed by nobody. The prime of a certificate is looked at by the checker, and here, since Rocq's ranks are over the field.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any

from ...exact.algebra.matrices import Matrix, beside, row_echelon
from ...exact.algebra.polynomials import Poly, PolyMatrix, add, divide, multiply, smith_diagonal, trimmed
from ..trust import checker, checker_structure
from .numbered import Numbered, Numbers, independent, system_of, terms_over
from .terms import Rows, Terms, call, index, indices, sequence

Json = Any


@dataclass(frozen=True)
class Shown:
    """[c - A, C] times `undoing` is 1 at the point c, times `unseen` 0; the faults times `unseen` times `adjoint` are `part` times 1.

    Shapes as the theory has them, signals being rows: (n + p) x n, (n + p) x m, m x m; `adjoint` and `part` are polynomials in t.
    """

    point: Any
    undoing: Rows
    unseen: Rows
    adjoint: PolyMatrix
    part: Poly

    def times(self, f: Poly) -> Shown:
        """Return the same with another part: f times this one."""
        return Shown(self.point, self.undoing, self.unseen, [[multiply(f, g) for g in row] for row in self.adjoint], multiply(f, self.part))

    def term(self, numbers: Numbers) -> str:
        """Write it as a term of type line_point."""
        adjoint = sequence(map(numbers.table, self.adjoint))
        tables = f"{numbers.table(self.undoing)} {numbers.table(self.unseen)} {adjoint} {numbers.vector(self.part)}"
        return f"LinePoint (R := {numbers.name}) {numbers.number(self.point)} {tables}"


def left_invertible_line(s: Json, w: Json) -> Terms:
    """Write left-invertible-line. Rejected where the minors have a common zero modulo the prime alone."""
    first, second = system_of(s["first"], w), system_of(s["second"], w)
    checker.expect(first.sizes == second.sizes, "the two systems differ in their dimensions")
    numbers, size = first.numbers, first.n + first.m
    shown, exchanged = list[Shown](), list[Shown]()
    for minor in checker.items(w["minors"], "minors"):
        point, rows = index(minor["point"], first.read.field.modulus - 1), indices(minor["rows"])
        checker.expect(rows == sorted({*rows}) and len(rows) == size and rows[-1:] < [first.n + first.p], "rows: expected n + m, ascending")
        shown += shown_at(first, second, point, rows)
        if not exchanged:
            exchanged += [one for one in shown_at(second, first, point, rows) if one.part[0] != 0]
    told = _with_sum_one(numbers, shown, first.m)
    if told or not first.m:  # else Rocq is told nothing, and sees that this does not serve
        checker_structure.KINDS["left-invertible-line"].check(first.read, s, w, second.read)
    a, b = first.named("first"), second.named("second")
    return terms_over(
        numbers,
        [
            first.definition("first"), second.definition("second"),
            *((name, f"seq (line_point ({numbers.name}))", sequence(one.term(numbers) for one in some))
              for name, some in (("points", told), ("others", exchanged if told else []))),
        ],
        call("is_left_invertible_line", *first.sizes, "first second points others"),
        f"forall x y : K, (x != 0) || (y != 0) -> "
        f"left_invertible (with_faults {a} (x *: sysF {a} + y *: sysF {b}) (x *: sysG {a} + y *: sysG {b}))",
        "is_left_invertible_line_sound",
    )  # fmt: skip


def shown_at(first: Numbered, second: Numbered, point: int, rows: Sequence[int]) -> list[Shown]:
    """Return what shows that the pencil has full rank at a point where the minor with these rows is not zero, or nothing where it is."""
    numbers, (n, m, p) = first.numbers, first.sizes
    field, d = numbers.field, numbers.field.degree
    checker.charge(100000 + (n + m) * (2 * n + p) * (n + m + p) * 4000 * d**3 + 8000 * m**5 * d**2, 400 * (n + p) * (n + m) * d**2)
    zero, one, c = field.element(0), field.element(1), field.element(point)
    N = beside(numbers.joined([[c * e for e in numbers.unit(n, i)] for i in range(n)], n) - first.A, first.C)
    form = row_echelon(beside(N.columns(rows), Matrix.identity(field, n)))
    if any(pivot >= n + m for pivot in form.pivots):
        return []
    bound, free = [rows[j] for j in form.pivots], [j for j in range(n + m) if j not in form.pivots]
    reached = dict(zip(bound, form.matrix.elements(), strict=True))  # by the columns of the theory, which are rows of the certificate
    undoing = [reached[i][n + m :] if i in reached else [zero] * n for i in range(n + p)]
    unseen = [[-reached[i][j] for j in free] if i in reached else [one if rows[j] == i else zero for j in free] for i in range(n + p)]
    left = numbers.joined(unseen, m)
    constant, slope = ((beside(-one.F, one.G) @ left).elements() if m else [] for one in (first, second))
    diagonal = smith_diagonal([[trimmed(f) for f in zip(x, y, strict=True)] for x, y in zip(constant, slope, strict=True)], m, m, one)
    if not all(diagonal.diagonal):
        return []
    part = reduce(multiply, diagonal.diagonal, (one,))
    scaled = [[multiply(divide(part, f)[0], g) for g in row] for f, row in zip(diagonal.diagonal, diagonal.left, strict=True)]
    return [Shown(c, undoing, unseen, _product(diagonal.right, scaled), part)]


def _with_sum_one(numbers: Numbers, shown: Sequence[Shown], m: int) -> list[Shown]:
    """Return multiples, by polynomials of degree below m, of which the parts have the sum 1; none where such multiples do not span the
    polynomials of degree below 2 m, as they do where the minors, as forms in a and b, have no common zero."""
    field = numbers.field
    zero, rows = field.element(0), Rows()
    for one in shown:
        rows += [[*[zero] * j, *one.part, *[zero] * (2 * m - j - len(one.part))] for j in range(m)]
    found = independent(numbers, rows, 2 * m)
    if len(found) < 2 * m or not m:
        return []
    factors = [trimmed(found[0][1][i : i + m]) for i in range(0, len(rows), m)]
    total: Poly = ()
    for f, one in zip(factors, shown, strict=True):
        total = add(total, multiply(f, one.part))
    return [one.times(tuple(x / total[0] for x in f)) for f, one in zip(factors, shown, strict=True) if f]


def _product(left: PolyMatrix, right: PolyMatrix) -> PolyMatrix:
    """Return the product of two square matrices of polynomials."""
    return [[reduce(add, map(multiply, row, column), ()) for column in zip(*right, strict=True)] for row in left]
