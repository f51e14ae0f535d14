"""These are the doubts that a record raises, as a list that people and programs read.

Doubt      one reason: of what kind, in which channels, the evidence, what it does to the answer, what to do
Doubts     all of them, with the kinds that were asked, and why others were not
KINDS      every kind of doubt, in the order in which they are told
TESTED     those kinds that rest on a test of level DOUBT_LEVEL; all others are plain facts of the record
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ....base.sheets import Shown, counted
from ...data.plain import by_name

DOUBT_LEVEL = 1e-3
"""The probability with which a test of one kind raises a doubt, in all channels together, where there is no reason for it."""

TESTED = ("closed loop", "non-linearity", "drift", "outliers", "bursts", "limits")
KINDS = (
    *("sampling time", "missing samples", "constant channel", "copies", "operating point", "units", "rounding"),
    *TESTED,
    *("delay", "held input", "slow modes", "fast sampling"),
)
MOST_NAMED = 4  # channels that a line names


@dataclass(frozen=True)
class Doubt:
    """One reason to doubt, of `kind`, one of KINDS, in the channels of these names.

    `evidence`, `effect` and `advice` are words: what was seen, what it does to the answer, and what to do. `chance` bounds the probability
    of evidence as strong where there is no reason for the doubt, and is None where the evidence is a plain fact of the record.
    """

    kind: str
    channels: tuple[str, ...]
    evidence: str
    effect: str
    advice: str
    chance: float | None = None

    @property
    def line(self) -> str:
        """Return all of it on one line."""
        chance = "" if self.chance is None else f" (a chance of {self.chance:.2g} otherwise)"
        return f"{self.kind}: {self.evidence}{chance}; {self.effect}; {self.advice}"

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict; a chance of null stands for a plain fact."""
        return by_name(self)


@dataclass(frozen=True, repr=False)
class Doubts(Shown):
    """The doubts that `doubts` found in a record.

    `rows` is a list of Doubt, one a reason, and may be empty; iterating gives them. Each of the kinds of TESTED that stands in `asked` is
    raised in a clean record with a probability of DOUBT_LEVEL at most, and `unasked` says of the other kinds why they could not be asked.
    Look at `rows` first, then at `unasked`: what was not asked is no evidence of anything. Evidence is in the units of the record's
    channels. Raises nothing of its own: it holds what was found.

    Source: [H76], [LB78] for the test of a closed loop, [L99, ch. 16] for the others; each module of the folder says what it adds.

    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, doubts, record_from
    >>> u = np.random.default_rng(1).standard_normal((400, 1))
    >>> y = StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]]).simulate(u)
    >>> [row.kind for row in doubts(record_from(y + 70, u))]
    ['operating point']
    """

    rows: tuple[Doubt, ...]
    asked: tuple[str, ...]
    unasked: Mapping[str, str] = field(default_factory=dict)

    def __iter__(self) -> Iterator[Doubt]:
        return iter(self.rows)

    def __len__(self) -> int:
        return len(self.rows)

    def of(self, kind: str) -> tuple[Doubt, ...]:
        """Return the doubts of one kind."""
        return tuple(row for row in self.rows if row.kind == kind)

    @property
    def title(self) -> str:
        """Return how many doubts there are, on one short line."""
        return f"{counted(len(self.rows), 'doubt')} of {counted(len(self.asked), 'kind')} asked" if self.rows else "no doubts"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield each doubt in four lines, and what was not asked with the reason."""
        for row in self.rows:
            yield row.kind, row.evidence
            if row.chance is not None:
                yield "chance of that otherwise", f"{row.chance:.2g}, where {DOUBT_LEVEL:g} raises a doubt"
            yield "what it does", row.effect
            yield "what to do", row.advice
        yield from ((f"{kind} was not asked", why) for kind, why in self.unasked.items())

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict: the rows, the kinds that were asked, why others were not, and the level of each test."""
        return {"level": DOUBT_LEVEL} | by_name(self, "rows", "asked", "unasked")


def named(channels: Sequence[str]) -> str:
    """Return the first of these names, and how many more there are."""
    more = len(channels) - MOST_NAMED
    return ", ".join(channels[:MOST_NAMED]) + (f" and {more} more" if more > 0 else "")


def in_order(rows: Sequence[Doubt]) -> tuple[Doubt, ...]:
    """Return the rows in the order of KINDS."""
    return tuple(sorted(rows, key=lambda row: KINDS.index(row.kind)))
