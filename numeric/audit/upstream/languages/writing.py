"""What a script needs of its language, and what is the same in all.

Dialect   writes lines of one language
table     nested lists as rows of a matrix
floats    nested lists with floats for rationals
number    a number in Octave, MATLAB and Julia
due_lines the assignments of what is due, in a language of matrices
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np

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


def number(value: Any) -> str:
    """Return a number as Octave, MATLAB and Julia write it."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, complex):
        return f"complex({number(value.real)},{number(value.imag)})"
    return {"nan": "NaN", "inf": "Inf", "-inf": "-Inf"}.get(repr(value), repr(value))


def due_lines(assigned: Callable[[str, Any], list[str]], due: Due, no_rows: str, one_more: str) -> list[str]:
    """Return the assignments of `expected`, `bound` and what the comparison needs besides; `no_rows` begins a list of the kernel rows, to
    which `one_more` adds `row`."""
    sides, lines = due.sides, list[str]()
    for name, value in sides.given.items():
        if name == "kernel_rows":
            lines += [no_rows, *(line for row in value for line in (*assigned("row", np.array(floats(row))), one_more))]
        else:
            lines += assigned(name, floats(value))
    bounds = np.array(table(floats(sides.bounds))) if isinstance(sides.bounds, (list, tuple)) else float(sides.bounds)
    return [*lines, *assigned("expected", np.array(table(floats(sides.truth)))), *assigned("bound", bounds)]
