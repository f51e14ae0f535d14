"""What an expression of the language is once it has been read.

Node          an operation with its parts, its kind and its place in the text
walk          a node and all below it
reads         the quantities and matrices that an expression reads
Undefined     an expression has no value on some system: the fifth entry of a list of two, a division by zero
LIMITS        bounds on the length of a text, the number of its parts, its depth, its integers, a range of windows
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ..quantities.registry import Kind

LONGEST, MOST_PARTS, DEEPEST, LARGEST_INTEGER, MOST_WINDOWS, LARGEST_POWER, LARGEST_SIDE = 2000, 400, 40, 10**6, 10**4, 64, 128


@dataclass(frozen=True, eq=False)
class Node:
    """`op` is the operation, `args` its parts; `value` what else it needs (a number, a name); `text` is it as it was written.

    A quantity has the value (subject, name), the subject being "" where the claim is about one system.
    """

    op: str
    kind: Kind
    args: tuple[Node, ...]
    value: Any
    text: str
    column: int


class Undefined(ValueError):
    """The expression has no value here; the message says why, and what guards against it."""


def walk(node: Node) -> Iterator[Node]:
    """Yield the node and all below it."""
    yield node
    for part in node.args:
        yield from walk(part)


def variables(node: Node) -> set[str]:
    """Return the window variables that stand in the node; one that a quantifier below binds is not free, and is not counted."""
    if node.op == "variable":
        return {node.value}
    found = set[str]().union(*(variables(part) for part in node.args))
    if node.op in ("all", "any", "least"):
        lower_and_upper = set[str]().union(*(variables(part) for part in node.args[:-1]))
        return lower_and_upper | (variables(node.args[-1]) - {node.value})
    return found


def reads(*nodes: Node) -> set[tuple[str, str]]:
    """Return (subject, name) of the quantities and matrices that the expressions read."""
    return {one.value for node in nodes for one in walk(node) if one.op in ("quantity", "windowed", "matrix")}
