"""An entry of the report in words.

lines_of   the lines below the title of a cause: the answer beside the truth, what is probably wrong, what it does, how to see it again
beside     the answer beside the truth, on one line
NOT_PROVED what a count of checks passed does not show
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ..records import CheckResult, Status
from .causes import FEW, Cause

MOST_NUMBERS = 8  # of an answer that is shown whole
NOT_PROVED = (
    "It tells what this code answered to these questions on one machine. It does not prove that the code is right on other questions, nor "
    "that it computed the answers: code that imports the vectors of faultspace can know them, and manners, memory and time are measured "
    "in the process of the code itself."
)
"""What stands beside a badge and in a file of JUnit."""


def lines_of(cause: Cause, adapter: str) -> Iterator[str]:
    """Yield the lines, without an indentation."""
    first = cause.first
    if first.answer is not None:
        yield beside(first)
    if first.quantity is not None and first.got is not None and first.bound is not None:
        ratio = "" if first.bound == 0 or first.ratio is None else f", ratio {first.ratio:.3g}"
        yield f"{first.quantity}: off by {first.got:.3g}, bound {first.bound:.3g}{ratio}"
    elif first.quantity is not None:
        yield f"{first.quantity}: off by NaN"
    if first.sample is not None:
        yield f"begins to differ at sample {first.sample} of 0 to {len(first.truth) - 1}"
    if first.detail and not first.detail.startswith("beyond the bound"):
        yield first.detail
    if cause.explanation:
        yield f"probably: {cause.explanation}"
    elif len(vectors := list(dict.fromkeys(one.vector for one in cause.results))) > FEW and first.verdict == Status.FAIL:
        yield f"all of: {', '.join(vectors)}"
    yield f"effect: {first.effect} ({first.severity})"
    yield f"again: faultspace audit {adapter} --check '{first.full_name}'"


def beside(result: CheckResult) -> str:
    """Return the answer beside the truth: at the place where it is furthest off or begins to differ, else whole where that is short."""
    place = result.place or (() if result.sample is None else (result.sample,))
    answer, truth, where = result.answer, result.truth, ""
    if place and len(_flat(answer)) > 1:
        for index in place:
            answer, truth = answer[index], truth[index]
        where = f"[{', '.join(map(str, place))}]"
    if max(len(_flat(answer)), len(_flat(truth))) > MOST_NUMBERS:
        return f"answered {_shape(answer)}, true {_shape(truth)} (--json has both)"
    return f"answered{where} {_short(answer)}, true{where} {_short(truth)}"


def _flat(value: Any) -> list[Any]:
    return [one for part in value for one in _flat(part)] if isinstance(value, (list, tuple)) else [value]


def _shape(value: Any) -> str:
    sizes = []
    while isinstance(value, (list, tuple)) and value:
        sizes.append(str(len(value)))
        value = value[0]
    return f"{' x '.join(sizes)} numbers" if sizes else _short(value)


def _short(value: Any) -> str:
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(_short, value))}]"
    return f"{value:.6g}" if isinstance(value, float) else str(value)
