"""Whether an expression stays as it is when states, outputs or faults are renumbered or change their signs.

    invariant      every matrix in the expressions is moved along by such a change, so that what is asked of it stays as it is

Quantities stay as they are. A matrix is followed by what its rows and columns stand for: A has states by states ("x", "x"), F states by
faults, C outputs by states, G outputs by faults, I(n) states by states; the states of two systems are not
the same. Sums need equal sides and products a common one; `.T` exchanges
them, since these changes are orthogonal. Where that fails, G + F with n = p say, the expression may depend on how things are numbered, and
every system of a box is looked at.
"""

from __future__ import annotations

from .grammar import OF_A_MATRIX
from .nodes import Node, walk
from .vocabularies import ABOUT_A_SYSTEM, Sides, Vocabulary


def invariant(*nodes: Node, vocabulary: Vocabulary = ABOUT_A_SYSTEM) -> bool:
    """Return whether that is so for all of them."""
    return all(_stays(one, vocabulary) for node in nodes for one in walk(node) if one.op in OF_A_MATRIX)


def _stays(node: Node, vocabulary: Vocabulary) -> bool:
    found = _sides(node.args[0], vocabulary)
    return found is not None and (node.op not in ("nilpotent", "schur_stable") or found[0] == found[1])


def _sides(node: Node, vocabulary: Vocabulary) -> Sides | None:
    """Return what rows and columns stand for; None where the matrix is not moved along."""
    match node.op:
        case "matrix":
            return vocabulary.sides[node.value]
        case "I":
            side = _counted(node.args[0], vocabulary)
            return None if side is None else (side, side)
        case "zeros":
            rows, columns = (_counted(one, vocabulary) for one in node.args)
            return None if rows is None or columns is None else (rows, columns)
    parts = [_sides(part, vocabulary) for part in node.args if part.kind == node.kind]
    known = [part for part in parts if part is not None]
    if len(known) < len(parts):
        return None
    first = known[0]
    match node.op:
        case "transpose":
            return first[1], first[0]
        case "negative":
            return first
        case "power":
            return first if first[0] == first[1] else None
        case "matrix @":
            return (first[0], known[1][1]) if first[1] == known[1][0] else None
        case "hstack":
            return (first[0], sum((part[1] for part in known), ())) if all(part[0] == first[0] for part in known) else None
        case "vstack":
            return (sum((part[0] for part in known), ()), first[1]) if all(part[1] == first[1] for part in known) else None
    return first if known[1] == first else None


def _counted(node: Node, vocabulary: Vocabulary) -> tuple[str, ...] | None:
    return vocabulary.counted(*node.value) if node.op == "quantity" else None
