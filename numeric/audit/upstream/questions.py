"""What a check asks and what is due, taken from the check itself while a stand-in answers it.

Argument   name, value, and the rationals that it was rounded from
Due        what of an answer is compared, with the truth and the bounds
Question   the calls of a check in order, with what is due of each
question   that of one check
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from faultspace.exact.algebra.matrices import Matrix

from ....base.arrays import Array
from ..adapter import ARGUMENTS, ZeroStructure
from ..diagnosing.suspicions import Call, Recorder
from ..records import Check, Demand, Measurement, Refused, Sides
from ..vectors.rationals import fractions, roundings

LONGEST = 1000  # rows of an array up to which rationals are given; longer records are made in floats, which are the data
GROWS = ("memory-grows-with-N", "time-grows-with-N")


@dataclass(frozen=True)
class Argument:
    """`value` is an array or an integer; `exact` has the shape of the array and holds what its floats were rounded from, None where the
    floats themselves are the data, or two rationals have one float."""

    name: str
    value: Any
    exact: Any


@dataclass(frozen=True)
class Due:
    """`sides` has the truth and the bounds; the answer in it is that of the stand-in. Of a residual `bounds`
    and the kernel rows are lists, one entry a row."""

    quantity: str
    sides: Sides


@dataclass(frozen=True)
class Asking:
    """This is one call: its arguments, and what is due of the answer."""

    arguments: tuple[Argument, ...]
    due: tuple[Due, ...]


@dataclass(frozen=True)
class Question:
    """`may_refuse`: whether no answer is as good as a right one. `measured` names quantities of manners, which compare no answer with a
    truth, with their bounds."""

    check: Check
    calls: tuple[Asking, ...]
    may_refuse: bool
    measured: tuple[tuple[str, float], ...]


def question(check: Check) -> Question:
    """Return what the check asks. A stand-in answers it, since what is due does not depend on the answer."""

    def stand_in(*arguments: Any) -> Any:
        if check.kind is Demand.MUST_REFUSE:
            raise Refused("as it should be")
        return _shaped(check.function, dict(zip(ARGUMENTS[check.function], arguments, strict=True)))

    recorder = Recorder(stand_in)
    due: dict[int, list[Measurement]] = {}
    with roundings() as rounded, suppress(Refused):
        for one in check.measure(recorder):
            due.setdefault(len(recorder.calls) - 1, []).append(one)
    found = tuple(
        Asking(tuple(_arguments(check.function, call, rounded)), tuple(_due(due.get(number, []))))
        for number, call in enumerate(recorder.calls)
    )
    manners = tuple((one.quantity, one.bound) for many in due.values() for one in many if one.sides is None)
    return Question(check, found, check.kind is Demand.MUST_HOLD and _may_refuse(check), manners)


def _shaped(function: str, given: Mapping[str, Any]) -> Any:
    """Return an answer that has the shape of a right one and is wrong."""
    match function:
        case "identify":
            n, n_u, p = given["order"], given["u"].shape[1], given["y"].shape[1]
            return np.zeros((n, n)), np.zeros((n, n_u)), np.zeros((p, n)), np.zeros((p, n_u))
        case "residual":
            return np.zeros(given["y"].shape)
        case "window_ranks":
            return [0] * given["windows"]
        case "fault_space":
            return np.eye(len(given["A"]) + len(given["C"]), 1)
        case "reconstruct":
            return np.zeros((len(given["r"]), given["F"].shape[1]))
        case "structure":
            return ZeroStructure(0, [], [], False)
        case "identified_fault_space":
            n, p = given["order"], given["y"].shape[1]
            return np.zeros((n, n)), np.zeros((p, n)), np.eye(n + p)[:, [n]]
    return 0


def _arguments(function: str, call: Call, rounded: Sequence[tuple[Array, Matrix]]) -> Iterator[Argument]:
    for name, value in zip(ARGUMENTS[function], call.arguments, strict=True):
        yield Argument(name, value, _exact(value, rounded) if isinstance(value, np.ndarray) and len(value) <= LONGEST else None)


def _exact(value: Array, rounded: Sequence[tuple[Array, Matrix]]) -> Any:
    """Return nested lists of Fractions, floats for what is not finite. The entries are those of the matrix whose rows the array has; else
    those that were rounded to them, if one rational each was; else the floats are the data."""
    value = np.asarray(value, dtype=float)
    rows = value.reshape(-1, 1) if value.ndim == 1 else value
    found = next((exact for array, given in reversed(rounded) if (exact := _rows_of(rows, array, given)) is not None), None)
    if found is None:
        found = _entries(rows, rounded)
    return [row[0] for row in found] if found is not None and value.ndim == 1 else found


def _rows_of(value: Array, array: Array, given: Matrix) -> list[list[Any]] | None:
    """Return the rationals where the array's rows, from one of them on, are those of the value wherever that is finite."""
    if value.shape[1:] != array.shape[1:]:
        return None
    finite = np.isfinite(value)
    for first in range(len(array) - len(value) + 1):
        part = array[first : first + len(value)]
        if np.array_equal(part[finite], value[finite]):
            exact = fractions(given.rows(range(first, first + len(value))))
            return [[x if ok else float(y) for x, y, ok in zip(*three, strict=True)] for three in zip(exact, value, finite, strict=True)]
    return None


def _entries(value: Array, rounded: Sequence[tuple[Array, Matrix]]) -> list[list[Any]] | None:
    table: dict[float, set[Fraction]] = {}
    for array, given in rounded:
        for x, exact in zip(array.ravel(), (one for row in fractions(given) for one in row), strict=True):
            table.setdefault(float(x), set()).add(exact)
    found = [[table.get(float(x), {Fraction(float(x))}) if np.isfinite(x) else {float(x)} for x in row] for row in value]
    if any(len(entry) > 1 for row in found for entry in row):
        return None
    return [[next(iter(entry)) for entry in row] for row in found]


def _due(measured: Sequence[Measurement]) -> Iterator[Due]:
    """Yield what is compared, once each: the rows of a residual together, and no dimension beside the space that has it."""
    rows = [one for one in measured if one.sides is not None and one.sides.of == "residual"]
    if rows:
        first = rows[0].sides
        assert first is not None
        given = {"kernel_rows": [one.sides.given["kernel_row"] for one in rows if one.sides is not None]}
        yield Due("r, up to a response to an initial state", replace(first, bounds=[one.bound for one in rows], given=given))
    seen = set[tuple[str, str]]()
    for one in measured:
        if one.sides is None or one.sides.of in ("residual", "dimension"):
            continue
        key = one.sides.of, str(dict(one.sides.given)) if one.sides.of == "transfer" else ""
        if key not in seen:
            seen.add(key)
            yield Due(one.quantity, one.sides)


def _may_refuse(check: Check) -> bool:
    """This tells whether the check takes a refusal for an answer."""

    def refusing(*arguments: Any) -> Any:
        raise Refused("as a question")

    if check.slug in GROWS:
        return False
    try:
        return all(one.ratio <= 1 for one in check.measure(refusing))
    except Refused:
        return False
