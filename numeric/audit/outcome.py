"""This records what an audit has found.

Audit           the result of every check, in order: a sequence, with a face for people, programs and notebooks
FunctionTally   of the checks of one function: how many there are, passed, failed, are free; the largest ratio
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, overload

from ...base.errors import quote_path
from ...base.sheets import Shown
from .records import CheckResult, Demand, Status, grouped, message


@dataclass(frozen=True)
class FunctionTally:
    """What is free, or not offered, is neither passed nor failed. `largest_ratio` is None where nothing was measured that must hold."""

    function: str
    checks: int
    passed: int
    failed: int
    largest_ratio: float | None

    @property
    def free(self) -> int:
        """This is how many checks cannot fail."""
        return self.checks - self.passed - self.failed


@dataclass(frozen=True, repr=False)
class Audit(Shown, Sequence[CheckResult]):
    """`adapter` is what stands after `faultspace audit` to name the implementation; `results` has one entry a check."""

    adapter: str
    results: tuple[CheckResult, ...]

    @overload
    def __getitem__(self, place: int, /) -> CheckResult: ...
    @overload
    def __getitem__(self, place: slice, /) -> tuple[CheckResult, ...]: ...
    def __getitem__(self, place: int | slice, /) -> CheckResult | tuple[CheckResult, ...]:
        return self.results[place]

    def __len__(self) -> int:
        return len(self.results)

    @property
    def failed(self) -> tuple[CheckResult, ...]:
        """These are the results whose must is not met."""
        return tuple(one for one in self.results if one.failed)

    @property
    def functions(self) -> tuple[FunctionTally, ...]:
        """This is the tally of each function, those with a failure first."""
        names = dict.fromkeys(one.function for one in self.results)
        tallies = [_tally(name, [one for one in self.results if one.function == name]) for name in names]
        return tuple(sorted(tallies, key=lambda tally: not tally.failed))  # stable: else in the order of the checks

    @property
    def failures(self) -> tuple[str, ...]:
        """These are the failures in words, a text for each slug and function, with the line that shows the first of them again."""
        name = quote_path(self.adapter)
        groups = [(message(first, name), [one.vector for one in others]) for first, *others in grouped(self.failed)]
        return tuple(f"{words} Also: {', '.join(vectors)}." if vectors else words for words, vectors in groups)

    @property
    def title(self) -> str:
        """This says how many checks there are of which functions, and how many failed."""
        names = ", ".join(dict.fromkeys(one.function for one in self.results))
        return f"{len(self)} check{'' if len(self) == 1 else 's'} of {names or 'nothing'}: {len(self.failed)} failed"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield a line for each function, then the failures in words."""
        for one in self.functions:
            ratio = "" if one.largest_ratio is None else f", largest ratio {one.largest_ratio:.2g}"
            yield one.function, f"{one.passed} of {one.checks} passed, {one.failed} failed, {one.free} free{ratio}"
        for words in self.failures:
            yield "failed", words

    def to_json(self) -> dict[str, Any]:
        """Return what is ready for JSON, as `faultspace audit --json` prints it."""
        return {"adapter": self.adapter, "failed": len(self.failed), "records": [one.to_json() for one in self.results]}


def _tally(function: str, results: Sequence[CheckResult]) -> FunctionTally:
    musts = [one for one in results if one.kind != Demand.FREE]
    ratios = [one.ratio for one in musts if one.ratio is not None]
    passed, failed = sum(one.verdict == Status.PASS for one in musts), sum(one.failed for one in musts)
    return FunctionTally(function, len(results), passed, failed, max(ratios, default=None))
