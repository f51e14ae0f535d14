"""Systems over GF(p) and Q(a) as the theory lists them: tables of numbers, signals as rows, and what Rocq is shown about them.

    Numbers         the arithmetic of one field: how its numbers are written, and what Rocq's theorem is said of
    Numbered        a system over such a field: its term, its words, the conditions of its kernel rows
    system_of       a system of a statement, once the checker has looked at the prime
    terms_over      the terms of a statement over every field in which the numbers mean something
    numbers_of      the arithmetic of a field as the checker reads it
    independent     a basis of the rows of a matrix, reduced: pivots, and the combinations that lead there
    inverse_at      pivots at which rows are independent, and what makes the table there diagonal

The theorem about a system over GF(p) is said of every field in which p is zero, that about one over Q(a) of every root of the minimal
polynomial in every field of characteristic 0: neither needs that p is a prime or that the polynomial is irreducible, which the checker
sees. There are no primes and hints in the terms. The lower bounds are words and combinations over the field itself, computed here,
whatever shows them in the certificate: the hints, the prime and the root are looked at by the checker alone. What is computed here is
believed by nobody: Rocq sees whether it serves.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import fmpq_mat, fmpz, fmpz_mat, nmod_mat

from ...base.errors import InvalidInput
from ...exact.algebra.fields import NumberField, PrimeField
from ...exact.algebra.matrices import Matrix, beside, row_echelon
from ...exact.structure.kernel_rows import kernel_representation
from ...exact.system.systems import ResidualSystem
from ..trust import checker
from .listed import NotCovered
from .terms import Definition, Kernel, Listing, Row, Rows, Terms, Written, call, index, sequence, whole

Json = Any
ROOT = "(K : fieldType) (a : K)"
FAITHFUL = "forall z, number K z = 0 -> z = Z0"
# What the checks and types over Q are called here; that of a rank of a matrix is NAME_has_rank.
CHECKS = {
    "window_ranks": "has_window_ranks", "left_invertible": "is_left_invertible", "not_left_invertible": "is_not_left_invertible",
    "inclusion": "is_included", "equality": "are_equal", "window_equality": "are_equal_on", "difference": "differ",
    "solutions": "are_solutions", "limit": "are_solutions_beyond", "first_column": "first_column_alone",
    "delay": "has_delay", "no_delay": "has_no_delay",
}  # fmt: skip
TYPES = {"kernel_row": "(nat * seq (seq V))", "sampled_word": "(seq V * seq (seq V) * (nat * nat))", "vector": "(seq V)"}


@dataclass(frozen=True)
class Numbers(Written):
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

    def of(self, kind: str) -> str:
        """Write a type in which V stands for the numbers, and that of a vector, a kernel row or a word is named as over Q."""
        for name, meant in TYPES.items():
            kind = kind.replace(name, meant)
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


class Numbered(Listing):
    """A SYSTEM over GF(p) or Q(a) is listed. `read`: as the checker reads it."""

    meaning, vector_of, matrix_of, signal_of = "system_of value", "vector_of value", "matrix_of value", "signal_of value {m} vs"

    def __init__(self, data: Json, witness: Json) -> None:
        self.read = checker.SUBJECTS["system"](data)
        self.numbers = numbers_of(self.read.field)
        self.kind = f"listing ({self.numbers.name})"
        super().__init__((self.read.n, self.read.m, self.read.p), witness)
        parts = (self.read.A, self.n, self.n), (self.read.F, self.n, self.m), (self.read.C, self.p, self.n), (self.read.G, self.p, self.m)
        self.A, self.F, self.C, self.G = (transposed(self.numbers.lifted(*part)) for part in parts)

    @property
    def term(self) -> str:
        """As a term of type listing."""
        return f"Listing (R := {self.numbers.name}) {' '.join(self.table(part.elements()) for part in (self.A, self.F, self.C, self.G))}"

    def terms(self, check: str, numbers: Sequence[int | str], definitions: Sequence[Definition], statement: str) -> Terms:
        """Return the terms of a statement: its check is given the numbers, and then what is defined."""
        ours = CHECKS.get(check, f"{check}_has_rank")
        asked = call(ours, *numbers, *(name for name, *_ in definitions))
        return terms_over(self.numbers, definitions, asked, statement, f"{ours}_sound" if check in CHECKS else f"{check}_rank")

    def number(self, number: Any) -> str:
        """Write a number as a term."""
        return self.numbers.number(number)

    def unit(self, size: int, i: int) -> Row:
        """Return a row of the identity, or zeros where i < 0."""
        return self.numbers.unit(size, i)

    def modulus(self) -> list[Definition]:
        """Return nothing: lower bounds are over the field itself."""
        return []

    def kernel(self, rows: Json) -> Kernel:
        """Return pivots and coefficients of kernel rows."""
        return [(index(row["pivot"]), [self.numbers.integral(c, self.p) for c in row["coefficients"]]) for row in rows]

    def rows(self, kernel: Kernel, window: int | None = None) -> list[Definition]:
        """Return the kernel rows that count and, where they come with hints, other pivots and what makes the leading coefficients there
        diagonal: then they need not be triangular by those that they have."""
        inverse, kernel = "None", self.counted(kernel, window)
        self.hinted(window)
        if "point" in self.witness and "kernel" in self.witness:
            found = inverse_at(self.numbers, [row[-1] if row else [] for _, row in kernel], self.p)
            if found is not None:
                kernel = [(pivot, row) for pivot, (_, row) in zip(found[0], kernel, strict=True)]
                inverse = f"Some {self.table(found[1])}"
        return [self.kernel_rows(kernel), ("Q", "option (seq vector)", inverse)]

    def lower(self, mark: str, kernel: Kernel, window: int | None = None) -> Definition:
        """Return what shows a lower bound: words, of one more sample than there are states or of a window."""
        return f"ws{mark}", "seq sampled_word", self.words(self.n + 1 if window is None else window)

    def of_all_windows(self) -> tuple[str, list[Definition]]:
        """Return the check of window ranks, and what it is shown: exact kernel rows, in the place of those that a certificate has modulo
        its prime alone, which the checker looks at."""
        if "kernel" in self.witness:
            kernel = self.kernel(self.witness["kernel"])
        else:
            pivots, rows = self.read.field.kernel_rows(self.witness["kernel_modulo"], self.p)
            self.read.spanned_modulo(pivots, rows, self.witness)
            self.bounded(self.n + 1)
            found = kernel_representation(ResidualSystem(*map(transposed, (self.A, self.F, self.C, self.G))))
            kernel = [(row.pivot, row.coefficients.elements()) for row in found.rows]
        return "window_ranks", [*self.rows(kernel), self.lower("", kernel)]

    def of_full_rank(self) -> tuple[str, list[Definition]]:
        """Return the check of left-invertibility, and what it is shown; the checker looks at the point of a witness that has one."""
        if "point" in self.witness:
            checker.require(self.read.pencil_rank(self.witness) >= self.n + self.m, "the pencil has a smaller rank at that point")
        return "left_invertible", [self.lower("", [])]

    def hinted(self, window: int | None = None) -> None:
        """Have the checker look at hints, where rows annihilate the system modulo its prime: where they do not, Rocq sees it, but of the
        rows that are not counted."""
        w, field = self.witness, self.read.field
        checker.expect("point" in w or "mix" not in w, "mix goes with a point")
        if "point" in w and "kernel" in w:
            pivots, rows = field.kernel_rows(w["kernel"], self.p)
            residues = [field.residues(row) for row in rows]
            _, left = self.read.conditions(residues)
            if not left:
                self.read.minimal(pivots, residues, w)
            self.read.annihilated_by([row for row in rows if window is not None and len(row) > window])

    def scaled(self, rows: Json, width: int) -> tuple[list[Definition], Rows]:
        """Return rows of numbers."""
        return [], self.numbers.vectors(rows, width)

    def signal(self, state: Json, faults: Json) -> tuple[list[Definition], Row, Rows]:
        """Return a state and faults."""
        return [], *self.word(state, faults)

    def word(self, state: Json, faults: Json) -> tuple[Row, Rows]:
        """Return a state and faults."""
        (x,), vs = self.numbers.vectors([state], self.n), self.numbers.vectors(faults, self.m)
        return x, vs

    def silent(self) -> tuple[Rows, Rows]:
        """Return states and faults of a witness that no output shows, from the last on."""
        return self.numbers.vectors(self.witness["state"][::-1], self.n), self.numbers.vectors(self.witness["fault"][::-1], self.m)

    def multiple(self, rows: Json, width: int) -> Rows:
        """Return rows as they are."""
        return self.numbers.vectors(rows, width)

    def inverses(self, rows: Json, delay: int) -> Definition:
        """Return the rows of a left inverse, by samples."""
        found = self.numbers.vectors(rows, self.p * (delay + 1))
        samples = ([row[k * self.p : (k + 1) * self.p] for k in range(delay + 1)] for row in found)
        return "rows", "seq (seq vector)", sequence(map(self.table, samples))

    def nulls(self, rows: Json, before: int, samples: int, wide: int) -> list[tuple[int, Row]]:
        """Return what annihilates a matrix with `before` columns and then some for each sample."""
        return [(index(row["pivot"]), self.numbers.integral(row["row"], before + samples * wide)) for row in rows]

    def independent(self, rows: Rows, width: int) -> list[tuple[int, Row]]:
        """Reduce rows in their first `width` columns; returns pivots, and the combinations that lead there."""
        return independent(self.numbers, rows, width)

    def reached(self) -> Rows:
        """Return F, A F, ..., A^(n-1) F, transposed."""
        rows, block = Rows(), self.F
        for _ in range(self.n):
            rows, block = rows + block.elements(), block @ self.A
        return rows

    def hankel_bounded(self, count: int, samples: int) -> None:
        """Charge for a trajectory, and for eliminating in a Hankel matrix of so many rows of it."""
        checker.charge(count * (self.n + samples * (self.m + self.p) + count) * 2000)

    def bounded(self, samples: int) -> None:
        """Charges for simulating all states and faults on so many samples, and for eliminating in the windows that they make."""
        height, width, d = self.n + self.m * samples, self.p * samples, self.numbers.field.degree
        checker.charge((self.n + self.m) * samples * (self.n + self.p + 1) * (self.n + self.m + 1) * 2000 * d * d)
        work = height * (width + height) * (1000 + 20 * min(height, width)) * d**3
        checker.charge(work, 200 * height * (width + height) * d * d)

    def trajectory(self, state: Row, faults: Sequence[Row]) -> tuple[Rows, Rows, Rows]:
        """Return states, faults and outputs."""
        numbers, states, outputs = self.numbers, [state], Rows()
        for fault in faults:
            x, v = numbers.joined([states[-1]], self.n), numbers.joined([fault], self.m)
            outputs.append((x @ self.C + v @ self.G).elements()[0] if self.p else [])
            states.append((x @ self.A + v @ self.F).elements()[0] if self.n else [])
        return states, [*faults], outputs

    def demands(self, row: Rows) -> Rows:
        """Return the condition rows [X_(k+1), c_k] of a kernel row."""
        state, found = self.numbers.joined([[self.numbers.field.element(0)] * self.n], self.n), Rows()
        for c in reversed(row):
            coefficient = self.numbers.joined([c], self.p)
            found.append([*(state.elements()[0] if self.n else []), *c])
            state = coefficient @ transposed(self.C) + state @ transposed(self.A)
        return found[::-1]

    def conditions(self, kernel: Kernel, samples: int) -> Rows:
        """Return the condition rows of kernel rows."""
        checker.charge(sum(len(row) for _, row in kernel) * (self.n + self.p + 1) ** 2 * 2000 * self.numbers.field.degree**2)
        return [demand for _, row in kernel for demand in self.demands(row)]


def system_of(data: Json, w: Json) -> Numbered:
    """Return a system of the statement. Raises what the checker says of the prime, its root, and of why the polynomial is irreducible."""
    system = Numbered(data, w)
    system.read.field.irreducible(w)
    if "prime" in w or "root" in w or system.read.field.prime:
        system.read.field.reduce(w)
    return system


def terms_over(numbers: Numbers, definitions: Sequence[Definition], check: str, statement: str, lemma: str) -> Terms:
    """Return the terms of a statement over every field that the numbers mean something in."""
    named = tuple((name, numbers.of(kind), term) for name, kind, term in definitions)
    return Terms((numbers.definition, *named), check, f"{numbers.given} {statement}", numbers.proof.format(lemma=lemma))


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
