"""About which point of the plant the model is linear: zero, or the means of the samples that tell it.

with_operating_point   a record about its operating point, and what was taken
OperatingPoint         the point, where it comes from, and why
asked_for              what a user states, checked
ASKED                  what a user can state

A model is y = G u + noise about a point at which the plant rests. Stated healthy samples show it: their means are taken off all samples, so
that a constant fault that sets in later stays in them. Without such samples the means of a whole record hold a constant fault too, and are
not taken where zero may be the point: where every channel varies by more than its mean, and outputs and inputs show no constant beside
their lags (`mean_about_zero`). Whether a constant is an operating point or a fault no such record can tell. Samples without noise obey
a law, about zero or about none, which means that are not quite those of the point would break: they stay as they are.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData, shorten
from ...data.plain import by_name
from ...data.records import Record
from ...method.ranks.exactness import SCREENED, obeys_exactly
from ..doubt.listing import named
from ..healthy.mean_shift import mean_about_zero

ZERO, MEANS = "zero", "means"
ASKED = (MEANS, ZERO)
HEALTHY, WHOLE, EACH = "healthy samples", "whole record", "single experiments"
TESTED = 1 << 14  # samples of an experiment of which it is asked whether zero is the point


@dataclass(frozen=True, eq=False)
class OperatingPoint:
    """The point that was taken off all channels.

    `of` says what it is: "zero", or the means of the "healthy samples", of the "whole record", or of the "single experiments", each by
    itself. `reason` says why. `stated` says that the caller asked for it. `values` (k,), inputs before outputs, are zeros for zero, and
    None where each experiment has its own, which are `by_experiment`.
    """

    of: str
    reason: str
    stated: bool
    values: Array | None
    by_experiment: tuple[Array, ...] = ()

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict."""
        return by_name(self, "of", "reason", "stated", "values", "by_experiment")


def asked_for(operating_point: object) -> str | None:
    """Return what the caller states of the operating point. Raises InvalidData for what is not one of ASKED, or None."""
    if operating_point is None or (isinstance(operating_point, str) and operating_point in ASKED):
        return operating_point
    choices = " or ".join(f'"{word}"' for word in ASKED)
    raise InvalidData(f"operating_point: got {shorten(operating_point)}; {choices} is needed, or leave it out to have it found")


def with_operating_point(record: Record, healthy: int | None, asked: str | None) -> tuple[Record, OperatingPoint]:
    """Return the record about its operating point, of which the first `healthy` samples are without fault, and what was taken."""
    stated = asked is not None
    nothing = np.zeros(len(record.names))
    if asked == ZERO:
        return record, OperatingPoint(ZERO, "as stated", stated, nothing)
    part = record if healthy is None else record.beginning(healthy)
    if not stated and _without_noise(part):
        return record, OperatingPoint(ZERO, "the samples have no noise, and obey a law as they are", stated, nothing)
    if healthy is not None:
        means = part.channels.mean
        reason = "so that a constant fault which sets in later stays in the samples"
        return record.about(means), OperatingPoint(HEALTHY, reason, stated, means)
    why = "as stated" if stated else _not_zero(part)
    if not why:
        return record, OperatingPoint(
            ZERO, "no mean exceeds the deviation of its channel, and nothing shows that the plant rests elsewhere", stated, nothing
        )
    reason = f"{why}; a fault that is constant over all samples goes with them, and only samples without fault can tell it (healthy=K)"
    if record.lengths:
        own = tuple(one.channels.mean for one in record.experiments)
        return record.about_own_means(), OperatingPoint(EACH, reason, stated, None, own)
    return record.about_means(), OperatingPoint(WHOLE, reason, stated, record.channels.mean)


def _without_noise(record: Record) -> bool:
    """Say whether the longest experiment obeys a law to rounding: each channel about its mean, beside which what it does may be rounding
    too, and one of two outputs that are the same left out, for no noise comes between these."""
    y, u = max(record.experiments, key=len).stretch(0, SCREENED)
    y, u = np.unique(y - y.mean(axis=0), axis=1), u - u.mean(axis=0)
    return obeys_exactly(y, u, single=record.single)


def _not_zero(record: Record) -> str:
    """Return why zero is not taken for the operating point, nothing where it may be."""
    for one in record.experiments:
        known, begun = one.channels, np.hstack(one.stretch(0, min((len(one) + 1) // 2, TESTED))[::-1])
        # What grows, as an unstable plant does, has a mean too; what rests elsewhere has half of it in the first half, or more.
        early = begun.mean(axis=0)
        rests = (np.abs(known.mean) > known.deviation) & (2 * early * np.sign(known.mean) > np.abs(known.mean))
        far = [name for name, resting in zip(one.names, rests, strict=True) if resting]
        if far:
            return f"the mean of {named(far)} exceeds its deviation"
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # copies, and numbers too unequal
            found = mean_about_zero(*one.stretch(0, TESTED))
        if found.shifted:
            return f"a plant that rests at zero has other levels: {found.reason}"
    return ""
