"""What a file of Rocq says about one certificate, and the numbers that it is made of.

Terms       definitions, check (a boolean), statement (a proposition), lemma (that the one implies the other)
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
        """Returns the definitions as text."""
        lines = [f"Definition {name} : {kind} := {term}." for name, kind, term in self.definitions]
        return "\n".join(["Local Open Scope Z_scope.", *lines, "Local Close Scope Z_scope."])

    def theorem(self) -> str:
        """Returns the definitions, and the theorem that is proved from them by computation."""
        return f"""{self.opening()}
Lemma checked : {self.check} = true.
Proof. vm_cast_no_check (erefl true). Qed.
Theorem certified : {self.statement}.
Proof. exact: ({self.lemma} checked). Qed.
"""


def index(value: Json, largest: int = checker.MAX_DIMENSION * checker.MAX_WINDOW) -> int:
    """Returns an INDEX. Raises checker.Malformed."""
    return checker.index(value, "an index", largest)


def indices(values: Json) -> list[int]:
    """Returns a list of INDEXes. Raises checker.Malformed."""
    return [index(value) for value in checker.items(values, "indices")]


def window_of(value: Json) -> int:
    """Returns a number of samples. Raises checker.Malformed."""
    return index(value, checker.MAX_WINDOW)
