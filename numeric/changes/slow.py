"""A mean that has moved since the healthy part, and a drift: constants and slopes in the residual, each output by itself.

A constant or slope d of r is (I - sum A_j) d in the innovations e. The estimate of d is that of e times the inverse, for all outputs
together, so that what moves in one output is not put down to another. Their power stands at the lowest frequencies, where a residual that
wanders has more than any healthy part can tell: undecided there.

    slow_changes    a row for the mean and one for the drift of each output
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ...base.arrays import Array
from .predictor import Predictor, Stretch
from .rows import DRIFT, MEAN, Evidence, by_student, estimate, undecided

WANDERS = "the healthy residual wanders: means and slopes say nothing (an integrating plant, a drift, a fault in it?)"


def slow_changes(learnt: Predictor, after: Stretch, e: Array, names: Sequence[str], level: float) -> Iterator[Evidence]:
    """Yield the rows of mean and drift, from the innovations e (M - lags, p) of the part `after`, each tested at `level`."""
    length = len(e)
    slope = np.arange(length) - (length - 1) / 2.0
    back = np.linalg.inv(learnt.response(0.0).real)
    kinds = ((MEAN, np.ones(length)), (DRIFT, slope / length))  # a drift is told by the change over the whole part
    for kind, pattern in kinds:
        if learnt.wanders or length < 3:
            yield from (undecided(kind, name, WANDERS if learnt.wanders else "too few samples") for name in names)
            continue
        squares = float(pattern @ pattern)
        amplitude = back @ (pattern @ e) / squares
        moments = learnt.moments(after, pattern[:, None])[:, 0] / squares
        cleared = learnt.without(moments, amplitude, 0.0)
        for i, name in enumerate(names):
            weights = np.outer(pattern / squares, back[i])
            found = estimate(learnt, e, weights, np.outer(cleared, back[i]))
            yield by_student(kind, name, found, level, learnt.scales[i], learnt.spread[i])
