"""The value of an expression on many small systems, or pairs, at once: those of which all that it reads is equal are decided together.

    true_of       which systems of a batch an expression is true of
    values_of     what several expressions are on the systems of a batch, and where
    Table         what has been decided: the numbers that were read -> the answer

An expression is tried on what is known of a system, which at first is its sizes. It asks for a family of ranks or for a matrix by raising
`Wanted`; that is found for all systems that need it, and the expression is tried again, once for each set of numbers that occurs. What
cannot be found in batches (`OneByOne`: a matrix whose size depends on the system, numbers beyond 64 bits) is asked of each system exactly.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exact.algebra.stability import is_schur
from ..quantities.batches import characteristic
from ..quantities.blocks import transposed
from ..quantities.elimination import Integers, Overflow, leading_ranks
from ..quantities.many import Chosen, Many
from ..quantities.ranks import Numbers, Wanted
from ..quantities.registry import Quantity, quantities
from .evaluating import Bound, Knows, check_shapes, evaluate, exactly, exponent, side
from .nodes import Node, Undefined, variables

Flags = NDArray[np.bool_]
Values = tuple[Any, ...]


class OneByOne(Exception):
    """What is asked cannot be found for many systems at once."""


@dataclass(frozen=True)
class Unanswered:
    """The expression has no value on a system; `message` says why."""

    message: str


@dataclass
class Table:
    """The answers of one expression, or of several, kept from batch to batch, by the sizes and by the numbers that were read."""

    answers: dict[object, bool | Values | Unanswered | Wanted] = field(default_factory=dict)


_Ask = Callable[[Knows], Any]
_Note = Callable[[Any, Chosen], None]


class UndefinedAt(Undefined):
    """The expression has no value on the system with this number in the batch."""

    def __init__(self, message: str, index: int) -> None:
        super().__init__(message)
        self.index = index


@dataclass(frozen=True)
class _Row:
    """One set of numbers, of one or more cases of the same sizes."""

    numbers: Numbers
    own: Mapping[str, Quantity]

    @property
    def horizon(self) -> int:
        return max(self.numbers.samples, *(n for n, _, _ in self.numbers.sizes.values()))

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self.numbers.sizes)

    def quantity(self, subject: str, name: str) -> Any:
        return self._ask(subject, name)

    def windowed(self, subject: str, name: str, s: int) -> Any:
        return self._ask(subject, name, s)

    def _ask(self, subject: str, name: str, *samples: int) -> Any:
        if not subject and name in self.own:
            return self.own[name].from_ranks(self.numbers, *samples)
        return quantities()[name].from_ranks(self.numbers.of(subject), *samples)

    def of_matrix(self, node: Node, bound: Bound) -> Any:
        if variables(node):
            raise OneByOne
        found = self.numbers.table(node)
        if node.op == "schur_stable":
            return is_schur(found[: np.flatnonzero(found)[-1] + 1])  # what is narrower than others was filled up with zeros
        return bool(found[0]) if node.op in ("is_zero", "nilpotent") else found[0]


def true_of(node: Node, batch: Many, rows: Chosen, table: Table) -> Flags:
    """Return of which systems of these rows the expression is true. Raises UndefinedAt where it has no value on one of them."""
    found = np.zeros(len(rows), dtype=bool)

    def note(answer: Any, places: Chosen) -> None:
        found[places] = answer

    _each(lambda knows: bool(evaluate(node, knows)), batch, rows, table, note)
    return found


def values_of(nodes: Sequence[Node], batch: Many, rows: Chosen, table: Table) -> list[tuple[Values, Chosen]]:
    """Return the values that the expressions have on systems of these rows, with the rows; the same values may come more than once.

    Raises UndefinedAt where one has no value on a system.
    """
    found: list[tuple[Values, Chosen]] = []
    ask = lambda knows: tuple(evaluate(node, knows) for node in nodes)  # noqa: E731
    _each(ask, batch, rows, table, lambda answer, places: found.append((answer, rows[places])))
    return found


def _each(ask: _Ask, batch: Many, rows: Chosen, table: Table, note: _Note) -> None:
    """Ask about the systems of these rows, and note what is answered for which places of `rows`."""
    noted: list[tuple[Any, Chosen]] = []
    try:
        _decide(ask, batch, rows, np.arange(len(rows)), (), table, noted)
    except (OneByOne, Overflow):
        noted = []
        for place, index in enumerate(rows):
            try:
                noted.append((ask(exactly(batch.case(int(index)))), np.array([place])))
            except Undefined as error:
                raise UndefinedAt(str(error), int(index)) from None
    for answer, places in noted:
        note(answer, places)


def _decide(
    ask: _Ask, batch: Many, rows: Chosen, places: Chosen, keys: tuple[Any, ...], table: Table, noted: list[tuple[Any, Chosen]]
) -> None:
    """Note the answers at these places of `rows`, of which the numbers of `keys` are known."""
    known = [batch.column(key, rows[places], _finder(key)) for key in keys]
    numbers = np.concatenate(known, axis=1) if known else np.zeros((len(places), 0), dtype=np.int64)
    distinct, which = _distinct(numbers)
    widths = np.cumsum([one.shape[1] for one in known])[:-1]
    wanting: dict[Any, list[int]] = {}
    groups = np.split(places[np.argsort(which, kind="stable")], np.cumsum(np.bincount(which, minlength=len(distinct)))[:-1])
    sizes = (*batch.sizes.items(), batch.samples)
    for i, row in enumerate(distinct):
        name = (sizes, keys, row.tobytes())
        if name not in table.answers:
            parts = dict(zip(keys, (tuple(map(int, part)) for part in np.split(row, widths)), strict=True)) if known else {}
            table.answers[name] = _answer(ask, _Row(Numbers(batch.sizes, parts, batch.samples), batch.own))
        answer = table.answers[name]
        if isinstance(answer, Wanted):
            wanting.setdefault(answer.key, []).append(i)
        elif isinstance(answer, Unanswered):
            raise UndefinedAt(answer.message, int(rows[groups[i][0]]))
        else:
            noted.append((answer, groups[i]))
    for key, numbered in wanting.items():
        _decide(ask, batch, rows, np.sort(np.concatenate([groups[i] for i in numbered])), (*keys, key), table, noted)


def _answer(ask: _Ask, row: _Row) -> Any:
    try:
        return ask(row)
    except Wanted as wanted:
        return wanted
    except Undefined as error:
        return Unanswered(str(error))


def _distinct(numbers: Integers) -> tuple[Integers, Chosen]:
    """Return the different rows of a table, and for each row which of them it is."""
    if not numbers.shape[1]:
        return numbers[:1], np.zeros(len(numbers), dtype=np.intp)
    code = np.zeros(len(numbers), dtype=np.int64)
    for column in numbers.T:  # different rows get different codes, made small again after each column
        low, high = int(column.min()), int(column.max())
        if high == low:
            continue
        if high - low < 2**20:
            code = code * (high - low + 1) + (column - low)
        else:
            _, inverse = np.unique(column, return_inverse=True)
            code = code * len(column) + inverse
        if len(code) and int(code.max()) > 2**24:
            _, code = np.unique(code, return_inverse=True)
    _, first, which = np.unique(code, return_index=True, return_inverse=True)
    return numbers[first], which


def _finder(key: Any) -> Any:
    return (lambda batch: _of_matrices(key, batch)) if isinstance(key, Node) else None


def _of_matrices(node: Node, batch: Many) -> Integers:
    """Return what a function of a matrix is, for every system of the batch."""
    built = _matrices(node.args[0], batch)
    count, rows, columns = len(built), built.shape[1] // batch.degree, built.shape[2] // batch.degree
    if node.op == "schur_stable" and batch.number_field is not None:
        raise OneByOne
    if node.op in ("nilpotent", "schur_stable") and rows != columns:
        raise OneByOne
    match node.op:
        case "rank":
            found = leading_ranks(built, batch.prime)[:, -1] // batch.degree
        case "nullity":
            found = columns - leading_ranks(built, batch.prime)[:, -1] // batch.degree
        case "rows":
            found = np.full(count, rows)
        case "columns":
            found = np.full(count, columns)
        case "is_zero":
            found = _is_zero(_reduced(built, batch))
        case "nilpotent":
            found = _is_zero(_powers(built, rows, batch))
        case _:
            return characteristic(built)
    return found[:, None]


def _is_zero(matrices: Integers) -> Integers:
    height, width = matrices.shape[1:]
    return np.where(np.any(matrices.reshape(len(matrices), height * width), axis=1), 0, 1)


def _matrices(node: Node, batch: Many) -> Integers:
    """Return the matrix that an expression is, for every system (N, rows, columns). Raises OneByOne, Overflow; the exact way tells what is
    wrong with shapes.
    """
    sizes = _Row(Numbers(batch.sizes, {}, batch.samples), batch.own)

    def number(part: Node) -> float:
        try:
            found: float = evaluate(part, sizes)
        except Wanted:
            raise OneByOne from None
        return found

    try:
        match node.op:
            case "matrix":
                return batch.matrix(*node.value)
            case "I":
                k = side(number(node.args[0]), node)
                return np.broadcast_to(np.eye(k * batch.degree, dtype=np.int64), (len(batch), k * batch.degree, k * batch.degree))
            case "zeros":
                return np.zeros((len(batch), *(side(number(part), node) * batch.degree for part in node.args)), dtype=np.int64)
            case "transpose":
                return transposed(_matrices(node.args[0], batch), batch.degree)
            case "negative":
                return -_matrices(node.args[0], batch)
            case "power":
                base = _matrices(node.args[0], batch)
                if base.shape[1] != base.shape[2]:
                    raise OneByOne
                return _powers(base, exponent(number(node.args[1]), node), batch)
        parts = [_matrices(part, batch) for part in node.args]
        check_shapes(node, [(part.shape[1] // batch.degree, part.shape[2] // batch.degree) for part in parts])
    except Undefined:
        raise OneByOne from None
    match node.op:
        case "matrix +":
            return _reduced(parts[0] + parts[1], batch)
        case "matrix -":
            return _reduced(parts[0] - parts[1], batch)
        case "matrix @":
            return batch.product(parts[0], parts[1])
    return np.concatenate(parts, axis=2 if node.op == "hstack" else 1)


def _reduced(built: Integers, batch: Many) -> Integers:
    if batch.prime is None:
        if built.size and max(-int(built.min()), int(built.max())) >= 2**61:
            raise Overflow("a sum of matrices")
        return built
    return built % batch.prime


def _powers(base: Integers, k: int, batch: Many) -> Integers:
    found = np.broadcast_to(np.eye(base.shape[1], dtype=np.int64), base.shape)
    for _ in range(k):
        found = batch.product(found, base)
    return _reduced(found, batch)
