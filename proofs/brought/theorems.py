"""What Rocq has proved, in the language of claims, and what of a claim follows from it.

    Proof        the theorems that a claim follows from, with the locks of their statements
    theorems     those of theorems.toml
    proof_of     the Proof of a conclusion under hypotheses, or None

`faultspace verify` has Rocq check the theorems, where Rocq is installed. Here they are believed, as long as the statements in the sources
are those that are locked; the locks tell which statements these are (proofs/theory/locks.json).
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources

from ..language.grammar import read
from ..language.nodes import Node
from ..rocq.locks import held
from ..rocq.sources import sources
from .deriving import Theorem, derived

FILE = "theorems.toml"


@dataclass(frozen=True)
class Proof:
    """`theorems`: name -> SHA-256 of its statement and of every word of ours in it."""

    theorems: Mapping[str, str]

    @property
    def words(self) -> str:
        """This says what the proof is."""
        return f"follows from {', '.join(self.theorems)} (proofs/theory), which faultspace verify has Rocq check"


@cache
def theorems() -> tuple[Theorem, ...]:
    """Return the theorems of the file, each of which names at least one of Rocq's."""
    entries = tomllib.loads(resources.files(__package__).joinpath(FILE).read_text("utf-8"))["theorem"]
    return tuple(
        Theorem(tuple(one["names"]), tuple(read(text) for text in one.get("hypotheses", ())), read(one["conclusion"]))
        for one in entries.values()
    )


def proof_of(hypotheses: Sequence[Node], conclusion: Node) -> Proof | None:
    """Return the proof; None where none is found, and where no theorem is needed. Raises NotProved where a statement is not as locked."""
    if derived(hypotheses, conclusion, ()) is not None:  # by what the words mean alone: Rocq has no part in it
        return None
    names = derived(hypotheses, conclusion, theorems())
    if not names:
        return None
    locks = _locks()
    return Proof({name: locks[name] for name in _fewer(hypotheses, conclusion, names)})


def _fewer(hypotheses: Sequence[Node], conclusion: Node, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return the names of one theorem that is enough, where one is; else of those left when no single one can be left out."""
    for one in theorems():
        if derived(hypotheses, conclusion, [one]):
            return one.names
    left = [one for one in theorems() if set(one.names) <= set(names)]
    for one in list(left):
        rest = [other for other in left if other is not one]
        if derived(hypotheses, conclusion, rest):
            left = rest
    return derived(hypotheses, conclusion, left) or names


@cache
def _locks() -> dict[str, str]:
    return {name: lock.sha256 for name, lock in held(sources()).theorems.items()}
