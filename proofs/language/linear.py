"""Integer expressions as sums of multiples of parts that are no sums.

Linear         the multiples, by the text of the part, and the constant
linear         that of an expression; an expression that is no sum is a multiple of itself
words          it as a text of the language
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import isinf

from .nodes import Node


@dataclass(frozen=True)
class Linear:
    """The sum of the multiples of the parts, of which none is 0, and the constant."""

    multiples: Mapping[str, int]
    constant: int

    def plus(self, other: Linear, times: int = 1) -> Linear:
        """Return this and so many times the other."""
        found = dict(self.multiples)
        for text, multiple in other.multiples.items():
            found[text] = found.get(text, 0) + times * multiple
        return Linear({text: multiple for text, multiple in found.items() if multiple}, self.constant + times * other.constant)

    def expanded(self, meanings: Mapping[str, Linear]) -> Linear:
        """Return the same with the parts that have a meaning replaced by it."""
        found = Linear({}, self.constant)
        for text, multiple in self.multiples.items():
            found = found.plus(meanings.get(text, Linear({text: 1}, 0)), multiple)
        return found


def linear(node: Node) -> Linear:
    """Return the expression as a sum; a part is named by its text, spaced as Python does."""
    match node.op:
        case "constant" if not isinf(node.value):
            return Linear({}, node.value)
        case "negative":
            return Linear({}, 0).plus(linear(node.args[0]), -1)
        case "+" | "-":
            left, right = map(linear, node.args)
            return left.plus(right, 1 if node.op == "+" else -1)
        case "*":
            left, right = map(linear, node.args)
            for number, other in ((left, right), (right, left)):
                if not number.multiples:
                    return Linear({}, 0).plus(other, number.constant)
    return Linear({ast.unparse(ast.parse(node.text, mode="eval")): 1}, 0)


def words(multiples: Iterable[tuple[str, int]], constant: int) -> str:
    """Return the sum in the language, what is added before what is taken away."""
    ordered = sorted(((text, multiple) for text, multiple in multiples if multiple), key=lambda one: one[1] < 0)
    parts = [(multiple < 0, text if abs(multiple) == 1 else f"{abs(multiple)} * {text}") for text, multiple in ordered]
    parts += [(constant < 0, str(abs(constant)))] if constant or not parts else []
    (negative, first), *rest = parts
    return ("-" if negative else "") + first + "".join(f" {'-' if minus else '+'} {text}" for minus, text in rest)
