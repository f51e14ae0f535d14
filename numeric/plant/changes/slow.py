"""A mean that has moved since the healthy part, and a drift: constants and slopes in the residual, each output by itself.

A constant or slope d of r is (I - sum A_j) d in the innovations e. The estimate of d is that of e times the inverse, for all outputs
together, so that what moves in one output is not put down to another. Where the standard errors of the model's static gain are known, what
they make of a constant or slope of the inputs is in the variance too, of which few lags of the inputs hold part. The power of both kinds
stands at the lowest frequencies, where a residual that wanders has more than any healthy part can tell: undecided there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from ....base.arrays import Array
from .predictor import LEARNT_FROM, Predictor, Stretch, predictor
from .table_rows import DRIFT, MEAN, Estimate, Evidence, by_student, estimate, undecided

WANDERS = "the healthy residual wanders: means and slopes say nothing (an integrating plant, a drift, a fault in it?)"


def slow_changes(learnt: Predictor, before: Stretch, after: Stretch, e: Array, names: Sequence[str], level: float) -> Iterator[Evidence]:
    """Yield the rows of mean and drift, from the innovations e (M - lags, p) of the part `after`, each tested at `level`."""
    length = len(e)
    for kind, pattern in ((MEAN, np.ones(length)), (DRIFT, _slope(length))):
        if learnt.wanders or length < 3:
            yield from (undecided(kind, name, WANDERS if learnt.wanders else "there are too few samples") for name in names)
            continue
        rest = before.u.mean(axis=0) if kind == MEAN else 0.0
        wrong = _wrong(after, pattern @ after.u[len(after) - length :] / float(pattern @ pattern) - rest) / learnt.scales
        for i, one in enumerate(_amplitudes(learnt, after, e, pattern)):
            found = replace(one, deviation=float(np.hypot(one.deviation, wrong[i])))
            yield by_student(kind, names[i], found, level, learnt.scales[i], learnt.spread[i])


def drifting(before: Stretch, level: float) -> set[int]:
    """Return the outputs that drift within the healthy part itself, each tested at `level`: its two halves may hide that, since a predictor
    takes a drift for noise of the lowest frequencies. One learnt about the slopes does not. Raises InvalidData as `predictor` does."""
    learnt = predictor(replace(before, r=about_slope(before.r)))
    before = before.part(max(len(before) - LEARNT_FROM, 0), len(before))
    e = learnt.innovations(before)
    return {i for i, found in enumerate(_amplitudes(learnt, before, e, _slope(len(e)))) if found.chance() < level}


def about_slope(values: Array) -> Array:
    """Return values (M, m) with mean and slope taken off."""
    pattern = _slope(len(values))
    values = values - values.mean(axis=0)
    return np.asarray(values - np.outer(pattern, pattern @ values) / float(pattern @ pattern))


def _wrong(part: Stretch, moved: Array) -> Array:
    """Return the deviations (p,) of what the model makes of inputs with this mean or slope (n_u,); zero where nothing is known of them."""
    if part.gain_errors is None:
        return np.zeros(part.r.shape[1])
    return np.asarray(np.sqrt(np.sum((part.gain_errors @ moved) ** 2, axis=0)))


def _slope(length: int) -> Array:
    """Return a slope about zero; a drift is told by the change over the whole part."""
    return (np.arange(length) - (length - 1) / 2.0) / length


def _amplitudes(learnt: Predictor, part: Stretch, e: Array, pattern: Array) -> Iterator[Estimate]:
    """Yield the estimate of the pattern in each output."""
    back = np.linalg.inv(learnt.response(0.0).real)
    squares = float(pattern @ pattern)
    moments = learnt.moments(part, pattern[:, None])[:, 0] / squares
    cleared = learnt.without(moments, back @ (pattern @ e) / squares, 0.0)
    for row in back:
        yield estimate(learnt, e, np.outer(pattern / squares, row), np.outer(cleared, row))
