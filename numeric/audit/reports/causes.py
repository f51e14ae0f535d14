"""Failures folded: what one error causes stands in one entry.

Cause      results that share it, the first of which is shown
folded     results that probably fail for one reason, before anything is known of the reason
causes     folds joined where their explanations are the same, and where there are many of one slug without any
lines_of   the lines below the title of a cause: the answer beside the truth, what is probably wrong, what it does, how to see it again
beside     the answer beside the truth, on one line
NOT_PROVED what a count of checks passed does not show
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from ....base.sheets import counted
from ..records import GREEN, CheckResult, Demand, Status

FEW = 3


@dataclass(frozen=True)
class Cause:
    """The results are of one function; `explanation` is what is probably wrong, empty where that is not known."""

    results: tuple[CheckResult, ...]
    explanation: str

    @property
    def first(self) -> CheckResult:
        """This is the result that stands for all."""
        return next((one for one in self.results if one.explanation), self.results[0])

    @property
    def title(self) -> str:
        """This says how the first is called, how many views of its vector share the cause, and how many other checks."""
        first = self.first
        same = sum(one.vector == first.vector for one in self.results)
        others = len({one.vector for one in self.results}) - 1
        words = f"{first.function}: {first.verdict}: {first.name}"
        words += f" x {same} {'views' if first.verdict == Status.FAIL else 'checks'}" if same > 1 else ""
        return words + (f", and {counted(len(self.results) - same, 'check')} of {counted(others, 'other vector')}" if others else "")


def told(results: Iterable[CheckResult]) -> tuple[CheckResult, ...]:
    """Return the results of musts that did not simply pass, whether or not their verdict counts as a failure."""
    return tuple(one for one in results if one.kind != Demand.FREE and one.verdict not in GREEN)


def folded(results: Iterable[CheckResult]) -> list[tuple[CheckResult, ...]]:
    """Return the results in folds: those of a function that broke or refused with the same words; those that answered what was to be
    refused, by slug; else the views of a vector that rest on one claim, the gravest verdict first."""
    groups: dict[tuple[object, ...], list[CheckResult]] = {}
    for one in results:
        groups.setdefault(_key(one), []).append(one)
    return [tuple(sorted(group, key=lambda one: _GRAVE.get(one.verdict, 0))) for group in groups.values()]


def causes(results: Iterable[CheckResult]) -> list[Cause]:
    """Return the causes of what did not pass, in the order of the checks."""
    joined: dict[tuple[object, ...], list[CheckResult]] = {}
    for fold in folded(told(results)):
        known = next((one.explanation for one in fold if one.explanation), "")
        joined.setdefault((fold[0].function, known) if known else (fold[0].full_name,), []).extend(fold)
    _gather(joined)
    return [Cause(tuple(group), next((one.explanation for one in group if one.explanation), "")) for group in joined.values()]


def _gather(joined: dict[tuple[object, ...], list[CheckResult]]) -> None:
    """Put together those of one slug and function that nothing explains, in the place of the first, where there are more than FEW."""
    alike: dict[tuple[object, ...], list[tuple[object, ...]]] = {}
    for key, group in joined.items():
        if group[0].verdict == Status.FAIL and not any(one.explanation for one in group):
            alike.setdefault((group[0].function, group[0].slug, group[0].claim), []).append(key)
    for first, *others in alike.values():
        if len(others) >= FEW:
            for key in others:
                joined[first] += joined.pop(key)


_GRAVE: dict[str, int] = {Status.FAIL: -1}


def _key(one: CheckResult) -> tuple[object, ...]:
    if one.verdict in (Status.BROKEN, Status.REFUSED):
        return one.function, one.verdict, re.sub(r"\d+", "#", one.detail)
    if one.verdict == Status.UNEXPECTED:
        return one.function, one.verdict, one.detail
    if one.kind == Demand.MUST_REFUSE:
        return one.function, one.slug
    return one.function, one.vector, one.claim or one.slug


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
