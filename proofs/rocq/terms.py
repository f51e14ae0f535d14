"""What a file of Rocq says about one certificate, and the numbers that it is made of.

Terms       definitions, check (a boolean), statement (a proposition), lemma (that the one implies the other)
determines  that outputs determine a fault, as a proposition; AT_FIRST: a fault at time 0 alone
index       a natural number of a certificate, through the checker's own parser; indices, window_of: several, a number of samples
"""

from __future__ import annotations

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
