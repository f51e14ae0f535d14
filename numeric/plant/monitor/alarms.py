"""What a monitor says: alarms, and what it saw of the samples that it was given."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ....base.arrays import Array
from ....base.sheets import Shown, counted
from ...data.plain import by_name
from .statistics import TESTS

MISSING = "missing"
MOST_NAMED = 2  # outputs in a title


@dataclass(frozen=True, repr=False)
class Alarm(Shown):
    """A test has crossed its threshold at `sample`, counted from 0 since the monitor was made.

    `test` is one of residual, chi-square, cusum and hankel, or "missing" where an output has sent nothing for a whole window. `outputs`
    have at least half the share of the output with the largest share in the statistic: where the fault shows, which is not always where
    it acts. `onset` is the sample from which the fault is estimated to act: the likeliest change of the mean for the CUSUM, of the power
    for the windows, among the samples that are remembered. `rank_gap` is the number of signals that the Hankel moments show at that
    sample, 0 where they show none yet, and for a constant one, which changes no rank gap. `inputs_beyond` are inputs that were, within
    the window before, outside what the healthy record has shown, by a tenth of its range: a nonlinear plant then differs from its model
    without any fault. Raises nothing. Source: [BN93] for the estimates of the onset.

    >>> from faultspace.numeric import Alarm
    >>> print(Alarm(90, "cusum", 15.0, 13.8, ("level",), 85, 0, ()).line)
    sample 90: cusum 15 > 13.8, outputs level, since about sample 85
    """

    sample: int
    test: str
    statistic: float
    threshold: float
    outputs: tuple[str, ...]
    onset: int
    rank_gap: int
    inputs_beyond: tuple[str, ...]

    @property
    def title(self) -> str:
        """Return which test alarms where."""
        more = f" and {len(self.outputs) - MOST_NAMED} more" if len(self.outputs) > MOST_NAMED else ""
        return f"{self.test} at sample {self.sample}, {', '.join(name[:20] for name in self.outputs[:MOST_NAMED])}{more}"

    @property
    def line(self) -> str:
        """Return the alarm with what it rests on, on one line."""
        if self.test == MISSING:
            return f"sample {self.sample}: {', '.join(self.outputs)} missing since sample {self.onset}; what it would show is not seen"
        beyond = f"; inputs beyond the healthy record: {', '.join(self.inputs_beyond)}" if self.inputs_beyond else ""
        gap = f", rank gap {self.rank_gap}" if self.rank_gap else ""
        return (
            f"sample {self.sample}: {self.test} {self.statistic:.4g} > {self.threshold:.4g}, outputs {', '.join(self.outputs)}, "
            f"since about sample {self.onset}{gap}{beyond}"
        )

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield the fields."""
        yield "statistic against threshold", f"{self.statistic:.4g} against {self.threshold:.4g}"
        yield "outputs in question", ", ".join(self.outputs)
        yield "estimated onset", str(self.onset)
        yield "rank gap", str(self.rank_gap)
        if self.inputs_beyond:
            yield "inputs beyond the healthy record", ", ".join(self.inputs_beyond)

    def to_json(self) -> dict[str, Any]:
        """Return the fields as a JSON-ready dict."""
        return by_name(self)


@dataclass(frozen=True, eq=False, repr=False)
class Watched(Shown):
    """What a monitor's `extend` saw, from its sample `first` on.

    `alarms` are those that began, `statistics` (N, 4) are in the order of the tests, and `innovations` (N, p) are uncorrelated and of
    deviation one without a fault; both are NaN at samples that no test could judge. Raises nothing. Source: [BN93].

    >>> import numpy as np
    >>> from faultspace.numeric import Watched
    >>> Watched(0, (), np.zeros((3, 4)), np.zeros((3, 2)))
    <Watched: 3 samples from sample 0, 0 alarms>
    """

    first: int
    alarms: tuple[Alarm, ...]
    statistics: Array
    innovations: Array

    @property
    def title(self) -> str:
        """Return how much was seen, and how many alarms."""
        return f"{counted(len(self.statistics), 'sample')} from sample {self.first}, {counted(len(self.alarms), 'alarm')}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield the alarms."""
        yield "alarms", ", ".join(f"{sum(alarm.test == test for alarm in self.alarms)} {test}" for test in (*TESTS, MISSING))
        yield from (("", alarm.line) for alarm in self.alarms)

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict; null stands for NaN."""
        return by_name(self, "first", "alarms", "statistics", "innovations")
