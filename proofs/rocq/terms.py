"""What a file of Rocq says about one certificate, and the integers and lists of them that it is made of.

Terms             definitions, check (a boolean), statement (a proposition), lemma (that the one implies the other)
determines        that outputs determine a fault, as a proposition; AT_FIRST: a fault at time 0 alone
index             a natural number of a certificate, through the checker's own parser; indices, window_of: several, a number of samples
whole, natural    an integer, a natural number as a term of Rocq
sequence          a list of terms
naturals          natural numbers
Written           what has numbers, which it writes, and vectors of them
call              a function and its arguments
Listing           a system as a check is told it, over Q or over any field, and what both are written with

Rocq executes what it reads: it opens and writes files where they say so. So nothing becomes text here but what has the type of an integer;
whatever else is in a file for Rocq stands in export.py, word for word.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from ..trust import checker

Json = Any
Row = list[Any]
Rows = list[Row]
Kernel = list[tuple[int, Rows]]
Definition = tuple[str, str, str]


@dataclass(frozen=True)
class Terms:
    """A file of Rocq says this about one certificate. `definitions`: (name, type, term), numbers in them are integers."""

    definitions: tuple[Definition, ...]
    check: str
    statement: str
    lemma: str

    def opening(self) -> str:
        """Return the definitions as text."""
        lines = [f"Definition {name} : {kind} := {term}." for name, kind, term in self.definitions]
        return "\n".join(["Local Open Scope Z_scope.", *lines, "Local Close Scope Z_scope."])

    def claimed(self) -> str:
        """Return the definitions, and what is stated of them, under the name `said`."""
        return f"{self.opening()}\nDefinition said : Prop := {self.statement}.\n"

    def proof(self) -> str:
        """Return the theorem that it is so, which is proved by computation."""
        return f"""Lemma checked : {self.check} = true.
Proof. vm_cast_no_check (erefl true). Qed.
Theorem certified : said.
Proof. unfold said; exact: ({self.lemma} checked). Qed.
"""


# A fault at time 0 alone, of one channel. What is stated is in words of the vocabularies; what they have no word for is spelled out.
AT_FIRST = "(fun k => if k is 0%N then 1%:M else 0)"


def determines(system: str, known: str, delay: str) -> str:
    """Return that the outputs up to a delay determine v(0), from rest (known) or from any state, as a proposition."""
    zero = f"(forall k, (k <= {delay})%N -> output {system} x v k = 0)"
    return f"(forall x v, ({known} -> x = 0) -> {zero} -> v 0%N = 0)"


def index(value: Json, largest: int = checker.MAX_DIMENSION * checker.MAX_WINDOW) -> int:
    """Return an INDEX. Raises checker.Malformed."""
    return checker.index(value, "an index", largest)


def indices(values: Json) -> list[int]:
    """Return a list of INDEXes. Raises checker.Malformed."""
    return [index(value) for value in checker.items(values, "indices")]


def window_of(value: Json) -> int:
    """Return a number of samples. Raises checker.Malformed."""
    return index(value, checker.MAX_WINDOW)


def whole(number: int) -> str:
    """Return an integer as a term, where integers are expected. Nothing but integers: what becomes text here is read by Rocq."""
    if type(number) is not int:
        raise TypeError(f"got a {type(number).__name__}, expected an integer")
    checker.charge(500 + (number.bit_length() ** 2 >> 9))
    return str(number) if number >= 0 else f"({number})"


def natural(number: int) -> str:
    """Write a natural number as a term, likewise."""
    if type(number) is not int or number < 0:
        raise TypeError(f"got a {type(number).__name__}, expected a natural number")
    return str(number)


def sequence(terms: Iterable[str]) -> str:
    """Write a list of terms as a term."""
    inside = "; ".join(terms)
    return f"[:: {inside}]" if inside else "[::]"


def call(function: str, *arguments: int | str) -> str:
    """Write a function and its arguments, numbers being natural ones."""
    return " ".join([function, *(one if isinstance(one, str) else f"{natural(one)}%N" for one in arguments)])


def naturals(numbers: Iterable[int]) -> str:
    """Write a list of natural numbers as a term."""
    return sequence(f"{natural(number)}%N" for number in numbers)


class Written:
    """What its numbers are written with: a number, a vector of them, a list of vectors, vectors with their pivots."""

    number: Any

    def vector(self, row: Iterable[Any]) -> str:
        """Write a vector as a term."""
        return sequence(map(self.number, row))

    def table(self, rows: Iterable[Iterable[Any]]) -> str:
        """Write a list of vectors as a term."""
        return sequence(map(self.vector, rows))

    def pivoted(self, rows: Iterable[tuple[int, Row]]) -> str:
        """Write pivots with their vectors as a term."""
        return sequence(f"({natural(pivot)}%N, {self.vector(row)})" for pivot, row in rows)


class Listing(Written):
    """A SYSTEM as the theory lists it, its matrices transposed: `Listed` or `Numbered`. `witness` is that of the certificate.

    Kinds are written of either alike, `export.py`: the types of what is defined, and the checks, are named as over Q. Of the theory are
    the type of a list (`kind`), the system that it means (`meaning`), and how vectors, matrices and faults that are called vs are read.
    """

    kind: str
    meaning: str
    vector_of: str
    matrix_of: str
    signal_of: str
    term: Any
    unit: Any
    trajectory: Any
    bounded: Any
    independent: Any

    def __init__(self, sizes: tuple[int, int, int], witness: Json) -> None:
        self.sizes = self.n, self.m, self.p = sizes
        self.witness = witness

    def definition(self, name: str) -> Definition:
        """Return the list under a name."""
        return name, self.kind, self.term

    def named(self, name: str) -> str:
        """Return the system in the theory that the list of that name means."""
        return f"({self.meaning} {natural(self.n)} {natural(self.m)} {natural(self.p)} {name})"

    def kernel_rows(self, kernel: Kernel) -> Definition:
        """Return the definition of kernel rows."""
        return "rows", "seq kernel_row", sequence(f"({natural(pivot)}%N, {self.table(row)})" for pivot, row in kernel)

    def counted(self, kernel: Kernel, window: int | None) -> Kernel:
        """Return the rows that speak of a window: where there are hints, those of lower degree."""
        return [row for row in kernel if window is None or "point" not in self.witness or len(row[1]) <= window]

    def response(self, state: Row, fault: Row, samples: int) -> Row:
        """Return the outputs, one after the other, of a state and a fault at time 0."""
        _, _, outputs = self.trajectory(state, [fault, *[self.unit(self.m, -1)] * samples][:samples])
        return [x for output in outputs for x in output]

    def free(self, samples: int) -> Rows:
        """Return the outputs of the unit states."""
        return [self.response(self.unit(self.n, i), self.unit(self.m, -1), samples) for i in range(self.n)]

    def forced(self, samples: int) -> Rows:
        """Return the outputs of the unit faults from rest, at one time after the other."""
        first = [self.response(self.unit(self.n, -1), self.unit(self.m, i), samples) for i in range(self.m)]
        return [self.unit(self.p * k, -1) + row[: self.p * (samples - k)] for k in range(samples) for row in first]

    def words(self, samples: int) -> str:
        """Return a basis of the words, reduced: initial state, faults, sample and output of the leading one."""
        self.bounded(samples)
        found, n, m = [], self.n, self.m
        for pivot, u in self.independent(self.free(samples) + self.forced(samples), self.p * samples):
            faults = [u[n + k * m : n + k * m + m] for k in range(samples)]
            found.append(f"(({self.vector(u[:n])}, {self.table(faults)}), ({pivot // self.p}%N, {pivot % self.p}%N))")
        return sequence(found)
