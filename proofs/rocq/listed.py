"""Systems over Q as the theory of theory/checks lists them: integers over one common denominator, signals as rows, bounds modulo a prime.

    Listed        a system over Q: its term, its words modulo a prime, the conditions of its kernel rows, the hints that Rocq asks of them
    NotCovered    raised where the checks in Rocq do not speak of a kind or a field

Two things in the terms are not in a certificate: words whose outputs are independent modulo its prime, which show the lower bounds that
`checker.py` finds by elimination, or three minors, where it does so at a point; and combinations of conditions likewise. What is computed
here is believed by nobody: Rocq sees whether it serves.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cached_property
from operator import mul
from typing import Any

from flint import nmod_mat

from ...exact.structure.kernel_rows import kernel_representation
from ...exact.system.systems import read_system
from ..trust import checker
from ..trust.kernel_witnesses import kernel_witness
from .terms import Definition, Kernel, Listing, Terms, call, index, naturals, sequence, whole

Json = Any
Integers = list[list[int]]


class NotCovered(Exception):
    """Raised where the checks in Rocq do not speak of this kind or this field."""


class Listed(Listing):
    """A SYSTEM over Q is listed with matrices multiplied by their common denominator."""

    kind, meaning, vector_of, matrix_of = "listed", "meant", "recorded d", "fraction d"
    signal_of = "fun k => recorded d {m} (nth [::] vs k)"
    number = staticmethod(whole)

    def __init__(self, data: Json, witness: Json) -> None:
        system = checker.SUBJECTS["system"](data)
        if system.field.key != "Q":
            raise NotCovered("the checks in Rocq are over the rational numbers only")
        super().__init__((system.n, system.m, system.p), witness)
        self.data, blocks = data, (system.A, system.F, system.C, system.G)
        self.den = checker.common_denominator(block.den for block in blocks)
        self.A, self.F, self.C, self.G = (
            [[row[j] * (self.den // block.den) for row in block.rows] for j in range(block.nc)] for block in blocks
        )

    @cached_property
    def prime(self) -> int:
        """The prime of the witness. Raises checker.Rejected where it is none."""
        prime = index(self.witness["prime"], checker.MAX_PRIME)
        checker.require(checker.is_prime(prime), f"{prime} is not a prime")
        return prime

    def terms(self, check: str, numbers: Sequence[int | str], definitions: Sequence[Definition], statement: str) -> Terms:
        """Return the terms of a statement: its check is given the numbers, and then what is defined."""
        given = (name for name, *_ in definitions)
        return Terms((*definitions,), call(f"check_{check}", *numbers, *given), statement, f"{check}_sound")

    @property
    def term(self) -> str:
        """The system as a term."""
        return f"Listed {whole(self.den)} {' '.join(map(self.table, (self.A, self.F, self.C, self.G)))}"

    def unit(self, size: int, i: int) -> list[int]:
        """Return a row of the identity, or zeros where i < 0."""
        return unit(size, i)

    def modulus(self) -> list[Definition]:
        """Return the prime that lower bounds are shown modulo."""
        return [("l", "Z", whole(self.prime))]

    def bounded(self, samples: int) -> None:
        """Charges for simulating all states and faults on so many samples, and for eliminating in the windows that they make."""
        height, width = self.n + self.m * samples, self.p * samples
        checker.charge((self.n + self.m) * samples * (self.n + self.p + 1) * (self.n + self.m + 1) * 60)
        checker.charge(height * (width + height) * (100 + 2 * min(height, width)), 100 * height * (width + height))

    def kernel(self, rows: Json) -> Kernel:
        """Return pivots and coefficients of kernel rows."""
        return [(index(row["pivot"]), [_integers(c) for c in row["coefficients"]]) for row in rows]

    def rows(self, kernel: Kernel, window: int | None = None) -> list[Definition]:
        """Return the kernel rows as they are."""
        return [self.kernel_rows(kernel)]

    def lower(self, mark: str, kernel: Kernel, window: int | None = None) -> Definition:
        """Return what shows a lower bound: the hints of the witness, or words, of one more sample than there are states or of a window."""
        if "point" in self.witness:
            return f"lower{mark}", "evidence", f"inr ({self.hints(kernel)})"
        return f"lower{mark}", "evidence", f"inl {self.words(self.n + 1 if window is None else window)}"

    def of_all_windows(self) -> tuple[str, list[Definition]]:
        """Return the check of window ranks, and what it is shown. Of "nulling" Rocq knows nothing: exact rows prove the same, and whoever
        finds them is not believed."""
        if "nulling" in self.witness:
            self.witness = kernel_witness(kernel_representation(read_system(self.data)))
        if "kernel" in self.witness:
            kernel = self.kernel(self.witness["kernel"])
            return "window_ranks", [self.kernel_rows(kernel), self.lower("", kernel)]
        kernel = self.kernel(self.witness["kernel_modulo"])
        return "window_ranks_modulo", [self.kernel_rows(kernel), ("lower", "hints", self.hints(kernel))]

    def of_full_rank(self) -> tuple[str, list[Definition]]:
        """Return the check of left-invertibility, and what it is shown: a minor at the point of a witness that has one, else words."""
        if "point" in self.witness:
            parts = zip(("q", "rows", "columns", "minor"), ("option Z", "seq nat", "seq nat", "Z"), self.pencil_minor(), strict=True)
            return "left_invertible_at", [*parts]
        return "left_invertible", [("ws", "seq sampled_word", self.words(self.n + 1))]

    def hinted(self) -> None:
        """Do nothing: what hints show Rocq is told, too."""

    def scaled(self, rows: Json, width: int) -> tuple[list[Definition], Integers]:
        """Return rows of RATIONALs as integers, and their common denominator d as a definition."""
        found, d = _cleared(rows)
        return [("d", "Z", whole(d))], found

    def signal(self, state: Json, faults: Json) -> tuple[list[Definition], list[int], Integers]:
        """Return a state and faults as `scaled` does."""
        d, (x, *vs) = self.scaled([state, *faults], 0)
        return d, x, vs

    def word(self, state: Json, faults: Json) -> tuple[list[int], Integers]:
        """Return a word of the integer system: v(k) times the k-th power of its denominator, all times what clears fractions."""
        _, scale = _cleared([state, *faults])
        checker.charge((len(faults) ** 3 + 1) * self.den.bit_length() ** 2 // 2000)
        return _scaled(state, scale), [_scaled(v, scale * self.den**k) for k, v in enumerate(faults)]

    def silent(self) -> tuple[Integers, Integers]:
        """Return states and faults of a witness that no output shows, from the last on."""
        both = self.witness["state"], self.witness["fault"]
        scale = checker.common_denominator(checker.rational(x, "witness")[1] for part in both for one in part for x in one)
        xs, vs = ([_scaled(one, scale * self.den**k) for k, one in enumerate(reversed(part))] for part in both)
        return xs, vs

    def multiple(self, rows: Json, width: int) -> Integers:
        """Return rows without fractions."""
        return _cleared(rows)[0]

    def inverses(self, rows: Json, delay: int) -> Definition:
        """Return the rows of a left inverse, by samples, each with its denominator."""
        written = []
        for given in rows:
            (row,), scale = _cleared([given])
            written.append(f"({whole(scale)}, {self.table(row[k * self.p : (k + 1) * self.p] for k in range(delay + 1))})")
        return "rows", "seq (Z * seq vector)", sequence(written)

    def nulls(self, rows: Json, before: int, samples: int, wide: int) -> list[tuple[int, list[int]]]:
        """Return what annihilates a matrix with `before` columns and then some for each sample, weighed as these are."""
        e, width = self.den, before + samples * wide
        checker.charge(width * (samples * e.bit_length()) ** 2 // 1000, width * samples * e.bit_length() // 8)
        weights = [e ** max(samples - 1, 0)] * before + [e ** (samples - 1 - k) for k in range(samples) for _ in range(wide)]
        return [(index(row["pivot"]), list(map(mul, _integers(row["row"]), weights))) for row in rows]

    def independent(self, rows: Integers, width: int) -> list[tuple[int, list[int]]]:
        """Reduce rows modulo the prime, in their first `width` columns; returns pivots, and the combinations that lead there."""
        return independent(rows, width, self.prime)

    def reached(self) -> Integers:
        """Return F, A F, ..., A^(n-1) F modulo the prime, transposed."""
        blocks = [self.F]
        while len(blocks) < self.n:
            blocks.append([added(times(row, self.A, self.n), [0] * self.n, self.prime) for row in blocks[-1]])
        return [row for block in blocks[: self.n] for row in block]

    def hankel_bounded(self, count: int, samples: int) -> None:
        """Charge for a trajectory, and for eliminating in a Hankel matrix of so many rows of it."""
        n, m, p = self.sizes
        length = count + samples - 1
        checker.charge(length * ((n + m + p + 1) ** 2 * 100 + length * self.den.bit_length() ** 2 // 100))
        width = n + samples * (m + p) + count
        checker.charge(count * width * (200 + 2 * count), 100 * count * width)

    def trajectory(self, state: list[int], faults: Integers) -> tuple[Integers, Integers, Integers]:
        """Return states, faults and outputs of the integer system modulo the prime, fault k times the k-th power of the denominator."""
        states, weighted, outputs = [state], Integers(), Integers()
        for k, fault in enumerate(faults):
            weighted.append([self.den**k * x for x in fault])
            outputs.append(added(times(states[-1], self.C, self.p), times(weighted[-1], self.G, self.p), self.prime))
            states.append(added(times(states[-1], self.A, self.n), times(weighted[-1], self.F, self.n), self.prime))
        return states, weighted, outputs

    def demands(self, row: Integers, prime: int = 0) -> Integers:
        """Return the condition rows [X_(k+1), c_k] of a kernel row, times powers of the denominator; modulo a prime where there is one."""
        state, found, weight = [0] * self.n, Integers(), 1
        for c in reversed(row):
            scaled = _reduced([weight * x for x in c], prime)
            found.append(state + scaled)
            state = [sum(a * x for a, x in zip(rc + ra, scaled + state, strict=True)) for rc, ra in zip(self.C, self.A, strict=True)]
            state, weight = _reduced(state, prime), weight * self.den
        return found[::-1]

    def conditions(self, kernel: Kernel, samples: int) -> Integers:
        """Return the condition rows of kernel rows, of so many samples."""
        width, terms = self.n + self.p, sum(len(row) for _, row in kernel)
        checker.charge(200 * terms * (width + 1) ** 2 * (1 + samples * self.den.bit_length() // 60))
        found = [demand for _, row in kernel for demand in self.demands(row)]
        checker.charge(len(found) * (width + len(found)) * (100 + 2 * width), 100 * len(found) * (width + len(found)))
        return found

    def minor(self, point: int | None) -> tuple[list[int], list[int], int]:
        """Return rows, columns and value modulo the prime of a largest minor that is not zero, of the pencil at a point, times the
        denominator, as the theory has the pencil, [q - A, C; - F, G]; or of G, where the point is infinity, None.
        """
        (n, m, p), prime = self.sizes, self.prime
        height, width = (m, p) if point is None else (n + m, n + p)
        checker.charge(height * width * (100 + 4 * min(height, width)), 100 * height * width)
        if point is None:
            table = [[x % prime for x in row] for row in self.G]
        else:
            above = [[self.den * point * (i == j) - x for j, x in enumerate(row)] + self.C[i] for i, row in enumerate(self.A)]
            table = [[x % prime for x in row] for row in above + [[-x for x in f] + g for f, g in zip(self.F, self.G, strict=True)]]
        columns = _pivots(table, width, prime)
        rows = _pivots([[row[j] for row in table] for j in columns], height, prime)
        return rows, columns, determinant([[table[i][j] for j in columns] for i in rows], prime)

    def pencil_minor(self) -> tuple[str, str, str, str]:
        """Return the point of a witness, or none for infinity, and that minor there, as terms: its rows, columns and value."""
        given = self.witness["point"]
        point = None if given == "infinity" else checker.index(given, "point", self.prime - 1)
        rows, columns, value = self.minor(point)
        return "None" if point is None else f"(Some {whole(point)})", naturals(rows), naturals(columns), whole(value)

    def hints(self, rows: Kernel) -> str:
        """Return hints that prove kernel rows minimal where they are, as a term: a minor of the pencil at a point, that of the leading
        coefficients at the pivots, and as many columns as the rows have states, with their minor there, 0 where there are too few.
        """
        width, terms, prime = self.n + self.p, sum(len(row) for _, row in rows), self.prime
        minor = " ".join(self.pencil_minor())
        checker.charge(terms * (width * (300 + 100 * (self.n + len(rows))) + self.n * (100 + 4 * min(self.n, terms))), 100 * terms * width)
        states = [demand[: self.n] for _, row in rows for demand in self.demands(row, prime)[:-1]]
        columns = _pivots(states, self.n, prime)
        of_states = determinant([[x[j] for j in columns] for x in states], prime) if len(columns) == len(states) else 0
        leading = determinant([[row[-1][pivot] % prime for pivot, _ in rows] for _, row in rows], prime)
        return f"Hints {minor} {whole(leading)} {naturals(columns)} {whole(of_states)}"


def determinant(table: Integers, prime: int) -> int:
    """Return the determinant of a square table of residues modulo the prime."""
    size = len(table)
    checker.charge(size**2 * (100 + 4 * size), 100 * size**2)
    return int(nmod_mat(size, size, [x for row in table for x in row], prime).det()) if size else 1


def independent(rows: Integers, width: int, prime: int) -> list[tuple[int, list[int]]]:
    """Reduce rows modulo a prime, in their first `width` columns; returns pivots, and the combinations that lead there."""
    if not rows or not width:
        return []
    height = len(rows)
    augmented = nmod_mat(height, width + height, [x % prime for i, row in enumerate(rows) for x in row + unit(height, i)], prime)
    form, _ = augmented.rref()
    found = []
    for i in range(height):
        line = [int(form[i, j]) for j in range(width + height)]
        pivot = next((j for j in range(width) if line[j]), None)
        if pivot is not None:
            found.append((pivot, line[width:]))
    return found


def _reduced(u: list[int], prime: int) -> list[int]:
    return [x % prime for x in u] if prime else u


def _pivots(rows: Integers, width: int, prime: int) -> list[int]:
    """Return the pivots of rows of residues."""
    return [pivot for pivot, _ in checker.echelon(rows, prime)] if width else []


def unit(size: int, i: int) -> list[int]:
    """Return a row of the identity."""
    return [int(i == j) for j in range(size)]


def times(x: list[int], M: Integers, width: int) -> list[int]:
    """Return a row times a matrix."""
    return [sum(a * row[j] for a, row in zip(x, M, strict=True)) for j in range(width)]


def added(u: Iterable[int], v: Iterable[int], prime: int) -> list[int]:
    """Return the sum modulo the prime."""
    return [(a + b) % prime for a, b in zip(u, v, strict=True)]


def _integers(values: Json) -> list[int]:
    return [checker.rational(value, "a number", integral=True)[0] for value in values]


def _scaled(values: Json, factor: int) -> list[int]:
    """Return RATIONALs times a factor that all denominators divide."""
    checker.charge(len(values) * (200 + factor.bit_length() ** 2 // 500), len(values) * factor.bit_length() // 4)
    return [top * factor // bottom for top, bottom in (checker.rational(x, "a number") for x in values)]


def _cleared(rows: Json) -> tuple[Integers, int]:
    """Return rows of RATIONALs as integers over their common denominator."""
    den = checker.common_denominator(checker.rational(x, "a number")[1] for row in rows for x in row)
    return [_scaled(row, den) for row in rows], den
