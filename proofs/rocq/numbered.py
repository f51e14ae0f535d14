"""Systems over GF(p) and Q(a) as the theory lists them: tables of numbers, signals as rows, and what Rocq is shown about them.

    Numbers         the arithmetic of one field: how its numbers are written, and what Rocq's theorem is said of
    Numbered        a system over such a field: its term, its words, the conditions of its kernel rows
    numbers_of      the arithmetic of a field as the checker reads it
    independent     a basis of the rows of a matrix, reduced: pivots, and the combinations that lead there
    inverse_at      pivots at which rows are independent, and what makes the table there diagonal
    Row, Rows       a vector over the field, and a list of them

What is computed here is believed by nobody: Rocq sees whether it serves.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from flint import fmpq_mat, fmpz, fmpz_mat, nmod_mat

from ...base.errors import InvalidInput
from ...exact.algebra.fields import NumberField, PrimeField
from ...exact.algebra.matrices import Matrix, beside, row_echelon
from ..trust import checker
from .listed import NotCovered
from .terms import natural, sequence, whole

Json = Any
Row = list[Any]
Rows = list[Row]
ROOT = "(K : fieldType) (a : K)"
FAITHFUL = "forall z, number K z = 0 -> z = Z0"


@dataclass(frozen=True)
class Numbers:
    """The numbers of a field. `own`: the field as the checker reads it; `name`, `definition`: the arithmetic of the theory and
    the parameter that it has; `given`: what is said of the field K, and `proof` of an argument `ok`, with `{lemma}` in it."""

    own: checker.Field
    field: PrimeField | NumberField
    name: str
    definition: tuple[str, str, str]
    given: str
    proof: str

    def lifted(self, table: checker.Table, height: int, width: int) -> Matrix:
        """Return a table of the checker, height x width over the field, as a matrix."""
        d = self.field.degree
        checker.charge(1000 + 300 * height * width * d * d, 100 * height * width * d * d)
        entries = [x for row in table.rows for x in row]
        if isinstance(self.field, PrimeField):
            return Matrix(self.field, height, width, nmod_mat(height, width, entries, self.field.p))
        return Matrix(self.field, height, width, fmpq_mat(fmpz_mat(height * d, width * d, entries)) / fmpz(table.den))

    def matrix(self, value: Json, height: int, width: int) -> Matrix:
        """Return a MATRIX of that shape. Raises checker.Malformed."""
        return self.lifted(self.own.matrix(value, height, width, "a matrix"), height, width)

    def vectors(self, value: Json, width: int, most: int = checker.MAX_WINDOW) -> Rows:
        """Return a list of VECTORs. Raises checker.Malformed."""
        rows = checker.items(value, "vectors", most)
        return self.matrix(rows, len(rows), width).elements() if rows and width else [[] for _ in rows]

    def integral(self, value: Json, width: int) -> Row:
        """Return a VECTOR of integers. Raises checker.Malformed."""
        field, found = self.field, self.own.integers(value, width, "a vector")
        if isinstance(field, PrimeField):
            return [field.element(x) for x in found]
        return [field.element(found[j : j + field.degree]) for j in range(0, len(found), field.degree)]

    def joined(self, rows: Sequence[Row], width: int) -> Matrix:
        """Return rows as a matrix."""
        checker.charge(1000 + 500 * len(rows) * width * self.field.degree**2, 100 * len(rows) * width * self.field.degree**2)
        return Matrix.from_elements(self.field, len(rows), width, rows)

    def unit(self, size: int, i: int) -> Row:
        """Return a row of the identity."""
        return [self.field.element(int(i == j)) for j in range(size)]

    def cleared(self, row: Row) -> Row:
        """Return a row times the common denominator of its coordinates, with which Rocq has less to reduce."""
        if isinstance(self.field, PrimeField):
            return row
        den = checker.common_denominator(int(c.q) for x in row for c in self.field.coordinates(x))
        return [x * den for x in row]

    def number(self, element: Any) -> str:
        """Write a number as a term: a residue, or coordinates as pairs of integers, without zeros at the end."""
        if isinstance(self.field, PrimeField):
            return whole(int(element))
        coordinates = self.field.coordinates(element)
        while coordinates and not coordinates[-1]:
            coordinates.pop()
        return sequence(f"({whole(int(c.p))}, {whole(int(c.q))})" for c in coordinates)

    def vector(self, row: Iterable[Any]) -> str:
        """Write a vector as a term."""
        return sequence(map(self.number, row))

    def table(self, rows: Iterable[Iterable[Any]]) -> str:
        """Write a list of vectors as a term."""
        return sequence(map(self.vector, rows))

    def pivoted(self, rows: Iterable[tuple[int, Row]]) -> str:
        """Write pivots with their vectors as a term."""
        return sequence(f"({natural(pivot)}%N, {self.vector(row)})" for pivot, row in rows)

    def of(self, kind: str) -> str:
        """Write a type in which V stands for the numbers."""
        return kind.replace("V", f"(numeral ({self.name}))")


def numbers_of(own: checker.Field) -> Numbers:
    """Return the arithmetic of GF(p) or Q(a), or of Q, where a is the root 0 of q. Raises NotCovered where a polynomial is reducible."""
    if own.prime:
        return Numbers(
            own, PrimeField(own.prime), "residues l", ("l", "Z", whole(own.prime)),
            "forall K : fieldType, number K l = 0 -> let value : numeral (residues l) -> K := number K in",
            "(fun ok (K : fieldType) (zero : number K l = 0) => {lemma} (residues_mean zero) ok)",
        )  # fmt: skip
    *low, lead = polynomial = [0, 1] if own.key == "Q" else own.key
    try:
        field = NumberField(tuple(map(Fraction, polynomial)))
    except InvalidInput:
        raise NotCovered("the minimal polynomial is reducible, so that there is no such field") from None
    monic = sequence(f"({whole(c)}, {whole(lead)})" for c in low)
    return Numbers(
        own, field, "algebraic f", ("f", "seq (Z * Z)", f"{monic} ++ [:: (1, 1)]"),
        f"forall {ROOT}, ({FAITHFUL}) -> value_at a f = 0 -> let value : numeral (algebraic f) -> K := value_at a in",
        f"(fun ok {ROOT} (faithful : {FAITHFUL}) (zero : value_at a f = 0) => {{lemma}} (algebraic_mean faithful zero) ok)",
    )  # fmt: skip


class Numbered:
    """A SYSTEM over GF(p) or Q(a) is listed with matrices transposed. `read`: as the checker reads it."""

    def __init__(self, data: Json) -> None:
        self.read = checker.SUBJECTS["system"](data)
        self.numbers = numbers_of(self.read.field)
        self.sizes = self.n, self.m, self.p = self.read.n, self.read.m, self.read.p
        parts = (self.read.A, self.n, self.n), (self.read.F, self.n, self.m), (self.read.C, self.p, self.n), (self.read.G, self.p, self.m)
        self.A, self.F, self.C, self.G = (transposed(self.numbers.lifted(*part)) for part in parts)

    @cached_property
    def term(self) -> str:
        """As a term of type listing."""
        tables = (self.numbers.table(part.elements()) for part in (self.A, self.F, self.C, self.G))
        return f"Listing (R := {self.numbers.name}) {' '.join(tables)}"

    def named(self, name: str) -> str:
        """Return the system in the theory that the list of that name means."""
        return f"(system_of value {natural(self.n)} {natural(self.m)} {natural(self.p)} {name})"

    def bounded(self, samples: int) -> None:
        """Charges for simulating all states and faults on so many samples, and for eliminating in the windows that they make."""
        height, width, d = self.n + self.m * samples, self.p * samples, self.numbers.field.degree
        checker.charge((self.n + self.m) * samples * (self.n + self.p + 1) * (self.n + self.m + 1) * 2000 * d * d)
        work = height * (width + height) * (1000 + 20 * min(height, width)) * d**3
        checker.charge(work, 200 * height * (width + height) * d * d)

    def trajectory(self, state: Row, faults: Sequence[Row]) -> tuple[Rows, Rows]:
        """Return states and outputs."""
        numbers, states, outputs = self.numbers, [state], Rows()
        for fault in faults:
            x, v = numbers.joined([states[-1]], self.n), numbers.joined([fault], self.m)
            outputs.append((x @ self.C + v @ self.G).elements()[0] if self.p else [])
            states.append((x @ self.A + v @ self.F).elements()[0] if self.n else [])
        return states, outputs

    def response(self, state: Row, fault: Row, samples: int) -> Row:
        """Return the outputs, one after the other, of a state and a fault at time 0."""
        rest = [self.numbers.field.element(0)] * self.m
        _, outputs = self.trajectory(state, [fault, *[rest] * samples][:samples])
        return [x for output in outputs for x in output]

    def free(self, samples: int) -> Rows:
        """Return the outputs of the unit states."""
        rest = [self.numbers.field.element(0)] * self.m
        return [self.response(self.numbers.unit(self.n, i), rest, samples) for i in range(self.n)]

    def forced(self, samples: int) -> Rows:
        """Return the outputs of the unit faults from rest, at one time after the other."""
        zero = self.numbers.field.element(0)
        first = [self.response([zero] * self.n, self.numbers.unit(self.m, i), samples) for i in range(self.m)]
        return [[zero] * (self.p * k) + row[: self.p * (samples - k)] for k in range(samples) for row in first]

    def words(self, samples: int) -> str:
        """Return a basis of the words, reduced: initial state, faults, sample and output of the leading one."""
        self.bounded(samples)
        found, n, m = [], self.n, self.m
        for pivot, u in independent(self.numbers, self.free(samples) + self.forced(samples), self.p * samples):
            faults = [u[n + k * m : n + k * m + m] for k in range(samples)]
            word = f"({self.numbers.vector(u[:n])}, {self.numbers.table(faults)})"
            found.append(f"({word}, ({pivot // self.p}%N, {pivot % self.p}%N))")
        return sequence(found)

    def conditions(self, row: Rows) -> Rows:
        """Return the condition rows [X_(k+1), c_k] of a kernel row."""
        state, found = self.numbers.joined([[self.numbers.field.element(0)] * self.n], self.n), Rows()
        for c in reversed(row):
            coefficient = self.numbers.joined([c], self.p)
            found.append([*(state.elements()[0] if self.n else []), *c])
            state = coefficient @ transposed(self.C) + state @ transposed(self.A)
        return found[::-1]


def transposed(matrix: Matrix) -> Matrix:
    """Return the transpose, also over Q(a), where blocks stay what they are."""
    return Matrix.from_elements(matrix.field, matrix.ncols, matrix.nrows, [list(row) for row in zip(*matrix.elements(), strict=True)])


def independent(numbers: Numbers, rows: Rows, width: int) -> list[tuple[int, Row]]:
    """Reduce rows in their first `width` columns; returns pivots, and the combinations that lead there, over Q(a) without denominators."""
    if not rows or not width:
        return []
    height, d = len(rows), numbers.field.degree
    checker.charge(height * (width + height) * (500 + 20 * min(height, width)) * d**3, 200 * height * (width + height) * d * d)
    form = row_echelon(beside(numbers.joined(rows, width), Matrix.identity(numbers.field, height)))
    lines = form.matrix.elements()
    return [(pivot, numbers.cleared(line[width:])) for pivot, line in zip(form.pivots, lines, strict=True) if pivot < width]


def inverse_at(numbers: Numbers, rows: Rows, width: int) -> tuple[list[int], Rows] | None:
    """Return pivots at which the rows are an invertible matrix, and its inverse, each row times a number; None for dependent rows."""
    if not rows:
        return [], []
    form = row_echelon(numbers.joined(rows, width)).pivots if width else ()
    if len(form) < len(rows):
        return None
    found = independent(numbers, [[row[j] for j in form] for row in rows], len(rows))
    return list(form), [combination for _, combination in found]
