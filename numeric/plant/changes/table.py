"""The table of changes: a row for each kind of change and channel, judged together.

Change     one row: what was tested, whether it was seen, how large it is, from which size on it would have been seen
Changes    the table, with the level of the whole
judged     makes the table of the Evidence of each test
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....base.sheets import Shown, counted
from ...data.plain import by_name
from .table_rows import Evidence

HEALTHY, FIRST_HALF = "the healthy samples", "the first half of the record"
NOT_SHOWN = 6  # channels of a kind that is undecided or not seen, named on one line


@dataclass(frozen=True)
class Change:
    """A row: a `kind` of change in the output or input `channel`.

    `seen` is None where it is undecided, and `reason` says why. `probability` is that of so much by chance in any row of the table (that
    of this row, times their number), `statistic` what it was read from. `size` is the estimate of the change in the `unit` of the row,
    empty for the units of the output, `sigmas` the same in standard deviations of the healthy residual of this output (for a gain, of its
    effect). `visible` is the size from which on it would have been seen with a chance of 0.9 where nothing else changes, infinite where
    none would, and `detail` what else there is to say. Numbers are None where they cannot be had.
    """

    kind: str
    channel: str
    seen: bool | None
    reason: str
    probability: float | None
    statistic: float | None
    size: float | None
    sigmas: float | None
    visible: float | None
    visible_sigmas: float | None
    unit: str
    detail: str

    @property
    def told(self) -> str:
        """Return the row's size in words."""
        if self.size is None:
            return self.detail
        size = f"{self.size:.3g}{' ' + self.unit if self.unit else ''}"
        sigmas = "" if self.sigmas is None else f" ({self.sigmas:.3g} sigma)"
        return f"{size}{sigmas}{', ' + self.detail if self.detail else ''}"

    def to_json(self) -> dict[str, Any]:
        """Return the row as a JSON-ready dict."""
        return by_name(self)


@dataclass(frozen=True, eq=False, repr=False)
class Changes(Shown):
    """What has changed in a record since its healthy part, in a row for each kind of change and channel.

    `level` is the probability that any row is seen by chance where nothing has changed; `rows` are the tests, of `samples` = (before,
    tested) samples; `against` says what those before are. One cause may be seen in several rows: a gain that changes makes the residual
    louder as well. A change of a kind that the table does not have, or smaller than `visible` of its row, is not excluded by rows that
    are not seen. Look at `seen` first, then at `undecided`. Raises nothing itself; `changes_since_healthy`, which makes it, raises
    InvalidData. Source: heads of the modules of `numeric/plant/changes`, [C60], [F29], [LLSW18].

    >>> import numpy as np
    >>> from faultspace.numeric import changes_since_healthy
    >>> draw = np.random.default_rng(2)
    >>> y, u = draw.standard_normal((600, 2)), draw.standard_normal((600, 1))
    >>> y[300:, 1] += 2.0
    >>> found = changes_since_healthy(y, y, u, healthy=300)
    >>> [(row.kind, row.channel) for row in found.seen]
    [('mean shift', 'y2')]
    """

    level: float
    rows: tuple[Change, ...]
    samples: tuple[int, int]
    against: str = HEALTHY

    @property
    def seen(self) -> tuple[Change, ...]:
        """Return the rows that are seen, the least probable by chance first."""
        return tuple(sorted((row for row in self.rows if row.seen), key=lambda row: row.probability or 0.0))

    @property
    def undecided(self) -> tuple[Change, ...]:
        """Return the rows that could not be decided."""
        return tuple(row for row in self.rows if row.seen is None)

    @property
    def doubtful(self) -> tuple[Change, ...]:
        """Return the rows that are undecided though their numbers are beyond chance."""
        return tuple(row for row in self.undecided if row.probability is not None and row.probability < self.level)

    @property
    def title(self) -> str:
        """Return the answer, on one short line."""
        answer = f"{counted(len(self.seen), 'row')} seen" if self.seen else "none seen"
        left = f", {len(self.undecided)} undecided" if self.undecided else ""
        return f"changes since {self.against}: {answer} of {len(self.rows)}{left}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield the rows that are seen, then for each kind what was not decided and why, and from which size on a change is seen."""
        yield "samples before, tested", f"{self.samples[0]}, {self.samples[1]}"
        yield "level of the whole table", f"{self.level:g}"
        for row in self.seen:
            yield f"{row.kind}, {row.channel}", f"SEEN: {row.told}; probability by chance {row.probability:.2g}"
        for kind, reason, rows in _by_reason(self.undecided):
            yield f"{kind}, {_named(rows)}", f"undecided: {reason}"
        for kind, rows in _by_kind([row for row in self.rows if row.seen is False]):
            yield f"{kind}, {_named(rows)}", f"not seen; it would be {_from(rows)}"

    def lines(self) -> Iterator[str]:
        """Yield the table as lines of text for a summary, in the same order as `sheet`."""
        yield (
            f"changes since {self.against}, {len(self.rows)} tests together at level {self.level:g}: "
            f"{counted(len(self.seen), 'row') if self.seen else 'none'} seen, {len(self.undecided)} undecided"
        )
        if self.seen:
            yield "    kind                channel         by chance   size"
            for row in self.seen:
                yield f"    {row.kind:<18}  {row.channel:<14}  {row.probability:>9.2g}   {row.told}"
            yield f"one cause may be seen in several rows; sigma: standard deviation of the residual of the output in {self.against}"
        for kind, reason, rows in _by_reason(self.undecided):
            yield f"not decidable: {kind} of {_named(rows)}: {reason}"
        unseen = [f"{kind} {_from(rows)}" for kind, rows in _by_kind([row for row in self.rows if row.seen is False])]
        if unseen:
            yield f"not seen; with a chance of 0.9 these would have been: {'; '.join(unseen)}"

    def to_json(self) -> dict[str, Any]:
        """Return the table as a JSON-ready dict."""
        return {"level": self.level, "against": self.against, "samples": list(self.samples), "rows": [row.to_json() for row in self.rows]}


def judged(evidence: Sequence[Evidence], level: float, tests: int, samples: tuple[int, int], doubt: str, raw: Sequence[str]) -> Changes:
    """Judge all rows together: a chance counts `tests` times (Bonferroni). Rows that would be seen are undecided where there is a `doubt`,
    unless their kind is one of the `raw` outputs alone."""
    rows = []
    for one in evidence:
        probability = None if one.chance is None else min(one.chance * tests, 1.0)
        seen = None if probability is None else probability < level
        reason = one.reason
        if seen and doubt and one.kind not in raw:
            seen, reason = None, doubt
        told = (one.statistic, one.size, one.sigmas, one.visible, one.visible_sigmas, one.unit, one.detail)
        rows.append(Change(one.kind, one.channel, seen, reason, probability, *told))
    return Changes(level, tuple(rows), samples)


def _by_kind(rows: Sequence[Change]) -> Iterator[tuple[str, list[Change]]]:
    for kind in dict.fromkeys(row.kind for row in rows):
        yield kind, [row for row in rows if row.kind == kind]


def _by_reason(rows: Sequence[Change]) -> Iterator[tuple[str, str, list[Change]]]:
    for kind, reason in dict.fromkeys((row.kind, row.reason) for row in rows):
        yield kind, reason, [row for row in rows if (row.kind, row.reason) == (kind, reason)]


def _named(rows: Sequence[Change]) -> str:
    names = [row.channel for row in rows]
    return ", ".join(names[:NOT_SHOWN]) + (f", ... ({len(names)})" if len(names) > NOT_SHOWN else "")


def _from(rows: Sequence[Change]) -> str:
    """Return from which sizes on the rows would be seen, in sigmas where they have them."""
    sizes = [row.visible_sigmas if row.visible_sigmas is not None else row.visible for row in rows]
    known = [size for size in sizes if size is not None and np.isfinite(size)]
    if not known:
        return "from no size on"
    unit = "sigma" if rows[0].visible_sigmas is not None else rows[0].unit
    least, most = min(known), max(known)
    blind = "" if len(known) == len(sizes) else f", in {len(known)} of {counted(len(sizes), 'channel')}"
    return f"from {least:.3g}{'' if f'{least:.3g}' == f'{most:.3g}' else f' to {most:.3g}'} {unit} on{blind}"
