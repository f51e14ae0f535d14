"""What a script needs of its language, and what is the same in all.

Dialect   writes lines of one language
table     nested lists as rows of a matrix
floats    nested lists with floats for rationals
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

from ..questions import Due


class Dialect(Protocol):
    """It writes lines of one language. Arguments are variables of the names that the audit gives them."""

    def heading(self, words: Sequence[str]) -> list[str]:
        """Return the words as a comment, and what the rest of the script uses."""

    def value(self, name: str, value: Any) -> list[str]:
        """Return the assignment of a number or an array."""

    def asked(self, function: str, arguments: Sequence[str], *, refusal: bool) -> list[str]:
        """Return the call, and what follows where there is no answer: whether that is right."""

    def compared(self, due: Due) -> list[str]:
        """Return the comparison of one thing that is due."""

    def twice(self, function: str, arguments: Sequence[str]) -> list[str]:
        """Return two calls and their comparison."""

    def untouched(self, function: str, arguments: Sequence[str]) -> list[str]:
        """Return the call, and a look at the arguments after it."""

    def refused(self) -> list[str]:
        """Return what an answer means where a refusal is due."""

    def ending(self) -> list[str]:
        """Return the exit code: 1 where something was wrong."""


def table(value: Any) -> list[list[Any]]:
    """Return rows of numbers: a number is one row of one, a list one column, and three levels one block of rows below the other."""
    if not isinstance(value, (list, tuple)):
        return [[value]]
    if not value or not isinstance(value[0], (list, tuple)):
        return [[one] for one in value]
    if value[0] and isinstance(value[0][0], (list, tuple)):
        return [list(row) for block in value for row in block]
    return [list(row) for row in value]


def floats(value: Any) -> Any:
    """Return nested lists with floats for Fractions; complex numbers and integers stay."""
    if isinstance(value, (list, tuple)):
        return [floats(one) for one in value]
    return value if isinstance(value, (bool, int, complex)) else float(value)
