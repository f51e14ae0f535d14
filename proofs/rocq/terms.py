"""What a file of Rocq says about one certificate, and the integers and lists of them that it is made of.

Terms             definitions, check (a boolean), statement (a proposition), lemma (that the one implies the other)
determines        that outputs determine a fault, as a proposition; AT_FIRST: a fault at time 0 alone
index             a natural number of a certificate, through the checker's own parser; indices, window_of: several, a number of samples
whole, natural    an integer, a natural number as a term of Rocq
sequence          a list of terms
vector, table     a list of integers, a list of such lists
naturals, pivoted natural numbers; pairs of a pivot and a vector
call              a function and its arguments

Rocq executes what it reads: it opens and writes files where they say so. So nothing becomes text here but what has the type of an integer;
whatever else is in a file for Rocq stands in export.py, word for word.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from ..trust import checker

Json = Any


@dataclass(frozen=True)
class Terms:
    """A file of Rocq says this about one certificate. `definitions`: (name, type, term), numbers in them are integers."""

    definitions: tuple[tuple[str, str, str], ...]
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


def vector(entries: Iterable[int]) -> str:
    """Write a list of integers as a term."""
    return sequence(map(whole, entries))


def table(rows: Iterable[Iterable[int]]) -> str:
    """Write a list of lists of integers as a term."""
    return sequence(map(vector, rows))


def call(function: str, *arguments: int | str) -> str:
    """Write a function and its arguments, numbers being natural ones."""
    return " ".join([function, *(one if isinstance(one, str) else f"{natural(one)}%N" for one in arguments)])


def pivoted(vectors: Iterable[tuple[int, list[int]]]) -> str:
    """Write a list of pivots with their vectors as a term."""
    return sequence(f"({natural(pivot)}%N, {vector(u)})" for pivot, u in vectors)


def naturals(numbers: Iterable[int]) -> str:
    """Write a list of natural numbers as a term."""
    return sequence(f"{natural(number)}%N" for number in numbers)
