"""Expressions about a system whose quantities accepted certificates tell.

Certified     a system of which accepted certificates tell the quantities: `evaluate` reads them as it reads exact functions
asked_by      the questions whose answers tell all that some expressions read
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..evidence.corpus import Evidence, Questions
from ..evidence.questions import QUESTIONS
from ..quantities.registry import Quantity, Told, quantities
from .evaluating import Bound
from .nodes import Node, Undefined, reads


@dataclass(frozen=True)
class Certified:
    """What accepted certificates say of a system."""

    evidence: Evidence

    @property
    def horizon(self) -> int:
        """The number of states."""
        return self.evidence.system.n

    @property
    def own(self) -> Mapping[str, Quantity]:
        """A claim about a system has no quantities of a whole."""
        return {}

    @property
    def names(self) -> tuple[str, ...]:
        """The one system has no name."""
        return ("",)

    def quantity(self, subject: str, name: str) -> Any:
        """Return the value of a quantity. Raises KeyError where no question tells it."""
        return _told(name).read(self.evidence)

    def windowed(self, subject: str, name: str, s: int) -> Any:
        """Return the value of a quantity at s samples."""
        return _told(name).read(self.evidence, s)

    def of_matrix(self, node: Node, bound: Bound) -> Any:
        """Raise Undefined: no question is about a matrix."""
        raise Undefined(f"got {node.text}, of which no question of the corpus tells anything")


def asked_by(*nodes: Node) -> Questions:
    """Return the questions whose answers tell all that the expressions read. Raises KeyError for what none tells."""
    wanted = {question for _, name in sorted(reads(*nodes)) for question in _told(name).asks}
    return tuple(question for question in QUESTIONS if question in wanted)


def _told(name: str) -> Told:
    found = quantities()[name].told
    if found is None:
        raise KeyError(name)
    return found
