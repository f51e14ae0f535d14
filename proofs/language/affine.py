"""What is asked of every number of samples s >= a is decided at finitely many of them.

    check_unbounded     the expression under windows(a) is one that can be decided so; else InvalidInput says where s stands
    decisive            the values of s that decide it on one system

**Why this decides it.** Let n be the number of states. From s = n on rank O_s stays as it is (Cayley-Hamilton). rank T_(s+1) - rank T_s is
the number of infinite zeros of order up to s, rank [O_(s+1) T_(s+1)] - rank [O_s T_s] is p less the number of left minimal indices up to s,
and no index and no order exceeds n, since n is the sum of all indices, orders and finite zeros ([VD79], [F75]); so both grow by a constant
from s = n on, and `gap` is constant there. The solutions of problem (11) are n + p less the sum of mu + 1 over the indices mu below s, a
constant from s = n + 1 on. Hence each function with a window is a linear function of its argument from n + 1 on, and, where its argument is
s + c, a linear function of s from n + 1 - c on. Let S be the largest of these, over the functions in the expression. Sums, differences, and
multiples by numbers without s of linear functions are linear, so that the two sides of each comparison are linear from S on, and where
their difference is not constant it changes its sign at one place only. Between two neighbouring ones of these places no comparison
changes, and neither does the expression, which is made of comparisons by `and`, `or`, `not`, `implies`, `iff`. What it is at a, ..., S, and
at the last integer up to each place and the two after it, is therefore all that it is from a on. Source: [F75], [VD79].

Where a factor without s is infinite, a product is inf or -inf by the sign of the other factor, which is linear: the place where that is 0
is one of those places, too.

Of two systems n is the larger number of states: the ranks of each are linear from n + 1 on, and whether their outputs of s samples are
equal, or those of one among those of the other, stays as it is from n + 1 on, since no kernel row of either has a larger degree than n.
Of a record n is the number of samples, where that is larger: a Hankel matrix with more block rows has no columns, and the rank 0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from math import floor, isinf

from ...base.errors import InvalidInput, shorten
from ..quantities.registry import Kind
from .nodes import MOST_WINDOWS, Node, Undefined, variables, walk

ZERO = Node("constant", Kind.INTEGER, (), 0, "0", 0)
LOGIC = ("and", "or", "not", "implies", "iff", "constant", "quantity")


def check_unbounded(node: Node, variable: str) -> None:
    """Raise InvalidInput unless the variable stands in functions with a window, sums, differences and comparisons of integers alone."""
    if variable not in variables(node):
        return
    if node.kind == Kind.WORD and node.op in LOGIC:
        for part in node.args:
            check_unbounded(part, variable)
        return
    if node.op == "windowed":
        _check_argument(node, variable)
        return
    if node.op == "compare" and all(part.kind == Kind.INTEGER for part in node.args):
        for part in node.args:
            _check_linear(part, variable)
        return
    raise _refusal(node, variable)


def _check_linear(node: Node, variable: str) -> None:
    if variable not in variables(node) or node.op == "variable":
        return
    holding = [part for part in node.args if variable in variables(part)]
    if node.op == "windowed" and node.kind == Kind.INTEGER:
        _check_argument(node, variable)
        return
    if node.op in ("+", "-", "negative") or (node.op == "*" and len(holding) == 1):
        for part in holding:
            _check_linear(part, variable)
        return
    raise _refusal(node, variable)


def _check_argument(node: Node, variable: str) -> None:
    """Raise InvalidInput unless the number of samples is s with numbers without s added and taken away."""
    argument = node.args[0]
    part: Node | None = argument
    while part is not None and part.op != "variable":
        part = _holding(part, variable)
    if part is not None:
        return
    raise InvalidInput(
        f"column {argument.column}: got {shorten(node.text)} for every {variable}, expected {variable}, {variable} + c or "
        f"{variable} - c as the number of samples, c without {variable}"
    )


def _holding(node: Node, variable: str) -> Node | None:
    """Return the part of a sum that holds the variable, where it is one part alone, and is not taken away."""
    holding = [variable in variables(part) for part in node.args]
    if node.op not in ("+", "-") or sum(holding) != 1 or (node.op == "-" and holding[1]):
        return None
    return node.args[holding.index(True)]


def _refusal(node: Node, variable: str) -> InvalidInput:
    return InvalidInput(
        f"column {node.column}: got {variable} in {shorten(node.text)}, and windows(a) without an end asks for every {variable} >= a; "
        f"there {variable} may stand in functions of a number of samples, rank_OT say, in sums, differences and comparisons alone; give "
        "windows an end"
    )


def decisive(body: Node, variable: str, start: int, n: int, value: Callable[[Node, int | None], float]) -> list[int]:
    """Return the values of s >= start, ascending, that decide the expression on a system of n states; see above.

    `value` gives the number that a part of the expression is, with s as told, or, for parts without s, None. Raises Undefined where a
    place of change is too far to be told, or where `start` is too far before n.
    """
    linear_from = max([start, *(n + 1 - _shift(node, variable, value) for node in walk(body) if _holds(node, variable))])
    if linear_from - start > MOST_WINDOWS:
        raise Undefined(f"got windows from {start} to {linear_from}, expected at most {MOST_WINDOWS}")
    points = set(range(start, linear_from + 1))
    for left, right in _comparisons(body, variable):
        try:
            at, after = (_difference(value(left, s), value(right, s)) for s in (linear_from, linear_from + 1))
        except Undefined:  # it is at every s, and either guarded against or found again where the whole is decided
            continue
        if at is None or after is None or at == after:
            continue
        place = linear_from - Fraction(at) / Fraction(after - at)
        points |= {s for s in range(floor(place), floor(place) + 3) if s >= linear_from}
    return sorted(points)


def _difference(left: float, right: float) -> int | None:
    return None if isinf(left) or isinf(right) else int(left) - int(right)


def _holds(node: Node, variable: str) -> bool:
    return node.op == "windowed" and variable in variables(node)


def _shift(node: Node, variable: str, value: Callable[[Node, int | None], float]) -> int:
    """Return c of the argument s + c; 0 where c is no number, which is told when the whole is decided, unless it is guarded against."""
    argument, shift = node.args[0], 0
    while argument.op != "variable":
        holding = _holding(argument, variable)
        if holding is None:
            return 0
        other = next(part for part in argument.args if part is not holding)
        try:
            found = value(other, None)
        except Undefined:
            return 0
        if isinf(found):
            return 0
        shift += int(found) if argument.op == "+" else -int(found)
        argument = holding
    return shift


def _comparisons(body: Node, variable: str) -> Iterator[tuple[Node, Node]]:
    """Yield the sides of comparisons, and each factor with the variable beside 0: its sign is that of a product with inf."""
    for node in walk(body):
        if node.op == "compare" and variable in variables(node):
            yield from zip(node.args, node.args[1:], strict=False)
        if node.op == "*":
            yield from ((part, ZERO) for part in node.args if variable in variables(part))
