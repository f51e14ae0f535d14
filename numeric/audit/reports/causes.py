"""Failures folded: what one error causes stands in one entry.

Cause      results that share it, the first of which is shown
folded     results that probably fail for one reason, before anything is known of the reason
causes     folds joined where their explanations are the same, and where there are many of one slug without any
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

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
