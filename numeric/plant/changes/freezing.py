"""Sensors that freeze: runs of equal values in a raw output, longer than its healthy values explain.

In the healthy part a share a of the samples repeats the one before, and of those that do a share b is repeated once more; both are taken
at the upper end of their exact confidence intervals at a quarter of the level each [CP34], and the run has the other half. Were these the
probabilities, a run of L equal values would begin at one of M samples with probability M a b^(L-2) at most. Where nothing repeats among
the healthy samples b is a. A quantised sensor, whose healthy values repeat most of the time, may stand still for as long as the record
lasts: the row says from how many samples on a run would have been seen, if any.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import scipy  # its folders are loaded when they are first used

from ....base.sheets import counted
from ..healthy.unlike_healthy import longest_run
from .predictor import Stretch
from .table_rows import FREEZING, Evidence


def frozen_sensors(before: Stretch, after: Stretch, names: Sequence[str], level: float) -> Iterator[Evidence]:
    """Yield a row for each output, each tested at `level`."""
    for i, name in enumerate(names):
        repeats = np.diff(before.y[:, i]) == 0.0
        often, again = int(np.sum(repeats)), int(np.sum(repeats[1:] & repeats[:-1]))
        first = _at_most(often, len(repeats), level / 4.0)
        more = max(_at_most(again, often, level / 4.0), first) if often else first
        length, count = longest_run(after.y[:, i]), len(after)
        logarithm = np.log(count) + np.log(first) + max(length - 2, 0) * np.log(min(more, 1.0)) if length > 1 else 0.0
        # Half the level is for the intervals; what is left of it is exceeded where twice this is below it.
        chance = float(min(2.0 * np.exp(min(logarithm, 0.0)), 1.0))
        needed = np.inf
        if more < 1.0:
            needed = max(2.0 + np.ceil((np.log(level / 2.0) - np.log(count) - np.log(first)) / np.log(more)), 2.0)
        visible = float(needed) if needed <= count else np.inf
        detail = f"longest run {counted(length, 'sample')}, before {longest_run(before.y[:, i])}"
        yield Evidence(FREEZING, name, chance, float(length), float(length), None, visible, None, "samples", detail)


def _at_most(hits: int, trials: int, level: float) -> float:
    """Return the probability that is exceeded with confidence `level` only [CP34]."""
    return 1.0 if hits >= trials else float(scipy.special.betaincinv(hits + 1, trials - hits, 1.0 - level))
