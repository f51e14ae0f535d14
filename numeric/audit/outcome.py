"""This records what an audit has found.

Audit           the result of every check, in order: a sequence, with a face for people, programs and notebooks
FunctionTally   of the checks of one function: how many there are, with which verdicts, how many failed or are free; the largest ratio
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, overload

from ...base.errors import InvalidData, quote_path
from ...base.sheets import Shown, counted
from .records import CheckResult, Demand, Status
from .reports.causes import Cause, causes, lines_of
from .reports.versions import versions

FORMAT = "faultspace-audit-result/1"


@dataclass(frozen=True)
class FunctionTally:
    """`verdicts` says how many musts have which verdict, in the order of Status; what is free, or not offered, is not among them.
    `largest_ratio` is None where nothing was measured that must hold."""

    function: str
    checks: int
    verdicts: Mapping[str, int]
    failed: int
    largest_ratio: float | None

    @property
    def free(self) -> int:
        """This is how many checks cannot fail."""
        return self.checks - sum(self.verdicts.values())


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
        """These are the failures in words, a text for each cause, with the line that shows the first of its checks again."""
        return tuple("; ".join([one.title, *lines_of(one, quote_path(self.adapter))]) for one in self.causes)

    @property
    def causes(self) -> tuple[Cause, ...]:
        """These are the musts that did not simply pass, one entry a cause, those with a failure first."""
        return tuple(sorted(causes(self.results), key=lambda cause: not any(one.failed for one in cause.results)))

    @property
    def title(self) -> str:
        """This says how many checks there are of which functions, how many failed, and how many the adapter alone excuses."""
        names = ", ".join(dict.fromkeys(one.function for one in self.results))
        known = sum(one.verdict == Status.EXPECTED for one in self.results)
        excused = sum(replace(one, not_promised="").failed for one in self.results if one.not_promised)
        told = "".join(
            f", {count} {words}" for count, words in ((known, "as expected"), (excused, "not met that it never promised")) if count
        )
        return f"{counted(len(self), 'check')} of {names or 'nothing'}: {len(self.failed)} failed{told}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield a line for each function, then the failures in words."""
        for one in self.functions:
            ratio = "" if one.largest_ratio is None else f", largest ratio {one.largest_ratio:.2g}"
            counts = ", ".join(f"{count} {verdict}" for verdict, count in one.verdicts.items())
            yield one.function, f"{counted(one.checks, 'check')}: {', '.join(filter(None, [counts, f'{one.free} free']))}{ratio}"
        for words in self.failures:
            yield "failed", words

    def to_json(self) -> dict[str, Any]:
        """Return what is ready for JSON, as `faultspace audit --json` prints it: `versions` are those of now."""
        head = {"format": FORMAT, "adapter": self.adapter, "failed": len(self.failed), "versions": versions()}
        return {**head, "records": [one.to_json() for one in self.results]}

    @staticmethod
    def from_json(document: Any) -> Audit:
        """Return the audit that `to_json` wrote, without the versions. Raises InvalidData for anything else."""
        if not isinstance(document, dict) or document.get("format") != FORMAT:
            raise InvalidData(f"got no result of an audit, expected what `faultspace audit --json` prints, of the format {FORMAT!r}")
        try:
            return Audit(str(document["adapter"]), tuple(CheckResult.from_json(one) for one in document["records"]))
        except (KeyError, TypeError, ValueError) as error:
            raise InvalidData(
                f"got a result of an audit that is incomplete ({error!r}), expected what `faultspace audit --json` prints"
            ) from None


def _tally(function: str, results: Sequence[CheckResult]) -> FunctionTally:
    musts = [one for one in results if one.kind != Demand.FREE]
    ratios = [one.ratio for one in musts if one.ratio is not None]
    counts = {str(verdict): sum(one.verdict == verdict for one in musts) for verdict in Status if verdict != Status.NOT_OFFERED}
    verdicts = {verdict: count for verdict, count in counts.items() if count}
    return FunctionTally(function, len(results), verdicts, sum(one.failed for one in musts), max(ratios, default=None))
