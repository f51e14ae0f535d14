"""Doubts that the one-step errors of an ARX model raise: drifts, outliers, bursts, non-linearity.

error_doubts       the doubts of errors e (T, p), with the regressors that the model was fitted on
score_chance       the chance of scores as large as these, from sums over blocks
outlier_sizes      the errors in units of their deviation nearby

With a linear plant, whatever the faults, e(k) is white and uncorrelated with what the inputs have done. Each test adds regressors z(k) that
a doubt would need, takes off what those of the model explain of them, and looks at the sums of e z (a score test, [L99, ch. 16]).

    drift           a line and a parabola over the record
    non-linearity   z from the input alone, so that no fault passes for a non-linearity: with g(x) = x^2 and x |x| of x in units of its
                    deviation, B(q) g(u_i) for each input (a curved actuator), and A(q) g(x_j) with x = G u (a curved sensor)

The sums are taken over blocks as long as the model's lags, longer than what is left of the correlation of e z; for blocks s_b, independent
and normal about zero, s' (sum_b s_b s_b')^-1 s over the number of blocks is a beta variable, s their sum. A variance that changes over the
record, as it does where a fault sets in, is in the denominator too.

Bursts. Where the power of noise comes and goes, large errors follow large ones, though no error is foretold: |e| has autocorrelations,
which errors of a linear model do not disturb, as those of e^2 [ML83]. They are taken of the normal scores of the ranks of |e|, which no
law of e changes, and those of NEAR lags are held against those of as many FAR ones. A power that rises once, as where a fault sets in,
and its colour are no bursts: either side of the sample where sums of scores lie farthest off has an autoregression and a mean score of its
own. The difference, of 2 NEAR of about equal variance 1 / T, is normal.

Outliers are held against the medians of |e| over WINDOW samples before and after them, the larger of both, so that a fault that comes or
goes is none. The median of normal numbers is normal about its value, with the variance of order statistics, so that e beyond t medians has
the probability 2 Phi(-t / sqrt(1 + t^2 v)), v its relative variance, and less with the larger of two; that of any among N p is at most
N p times as large.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import scipy  # its folders are loaded when they are first used

from ....base.arrays import Array
from ...method.model.arx import Arx
from ...method.model.compression import EPS
from .listing import DOUBT_LEVEL, Doubt, named

WINDOW = 101
"""Samples on one side that tell the size of the errors there: the median of so many is known to 12 %."""
QUARTER = float(scipy.special.ndtri(0.75))
LEAST_BLOCKS = 4
"""Blocks for each regressor, below which a test is not asked: the beta variable could not reach DOUBT_LEVEL."""
MOST_TOLD = 5
NEAR, FAR, SAMPLES_OF_LAG = 5, 25, 10
"""Lags 1 .. NEAR are those of a burst, and FAR - NEAR + 1 .. FAR those behind it; a side has at least SAMPLES_OF_LAG for each."""


def error_doubts(e: Array, u: Array, x: Array, regressors: Array, arx: Arx, outputs: Sequence[str]) -> Iterator[Doubt]:
    """Yield the doubts that errors e (T, p) raise, with the inputs u (T + h, n_u), the response x (T + h, p) of the ARX plant to them, and
    the regressors (T, k) of its h lags, all about their means."""
    yield from _drift(e, regressors, arx, outputs)
    yield from _non_linearity(e, u, x, regressors, arx, outputs)
    yield from outlier_doubts(e, arx.order, outputs)
    yield from _bursts(e, outputs)


def _drift(e: Array, regressors: Array, arx: Arx, outputs: Sequence[str]) -> Iterator[Doubt]:
    time = np.linspace(-1.0, 1.0, len(e))
    shapes = _beside(np.column_stack([time, time**2]), regressors)
    chances = np.array([score_chance(column[:, None] * shapes, arx.order + 1) for column in e.T]) * len(outputs)
    moved = [name for name, chance in zip(outputs, chances, strict=True) if chance < DOUBT_LEVEL]
    if moved:
        yield Doubt(
            "drift",
            tuple(moved),
            f"what the inputs leave of {named(moved)} moves along a line or an arc over the record",
            "the model suffers little, but a slow fault and a drift of a sensor or of the plant are one to the data, and the residual and "
            "the count of faults have it",
            "where no fault is that slow, take a line off each output, or use a shorter stretch",
            float(chances.min()),
        )


def _non_linearity(e: Array, u: Array, x: Array, regressors: Array, arx: Arx, outputs: Sequence[str]) -> Iterator[Doubt]:
    h, T = arx.order, len(e)
    curved = [np.asarray(form) for form in (_unit(u) ** 2, _unit(u) * np.abs(_unit(u)))]
    bent = [np.asarray(form) for form in (_unit(x) ** 2, _unit(x) * np.abs(_unit(x)))]
    found = []
    for j in range(len(outputs)):
        columns = [_filtered(form[:, [i]], arx.inputs[:, [j], i : i + 1], T) for form in curved for i in range(u.shape[1])]
        columns += [_filtered(form, arx.outputs[:, [j], :], T) for form in bent]
        shapes = _beside(np.hstack(columns), regressors)
        found.append(len(outputs) * score_chance(e[:, [j]] * shapes, h + 1))
    chances = np.array(found)
    curves = [name for name, chance in zip(outputs, chances, strict=True) if chance < DOUBT_LEVEL]
    if curves:
        yield Doubt(
            "non-linearity",
            tuple(curves),
            f"the errors of {named(curves)} follow squares of the inputs or of the response to them",
            "the model is the best linear one for inputs of this size, and what it misses looks like noise or like a fault",
            "smaller inputs about one operating point, or the curve of actuator or sensor taken off the channels",
            float(chances.min()),
        )


def _bursts(e: Array, outputs: Sequence[str]) -> Iterator[Doubt]:
    chances = np.array([burst_chance(column) for column in e.T]) * len(outputs)
    seen = [name for name, chance in zip(outputs, chances, strict=True) if chance < DOUBT_LEVEL]
    if seen:
        yield Doubt(
            "bursts",
            tuple(seen),
            f"large errors of {named(seen)} follow large ones: the power of the noise comes and goes",
            "the model suffers little, but its standard errors, and every chance that takes the noise for steady, are too small: onsets, a "
            "growth of variance and outliers may be such bursts",
            "state healthy samples that have bursts too, and believe what stays; look whether the plant is run in two ways",
            float(chances.min()),
        )


def burst_chance(e: Array) -> float:
    """Return the chance of so much more autocorrelation of |e| (T,) at the lags of a burst than behind them; 1 of few or equal numbers."""
    least = SAMPLES_OF_LAG * NEAR
    if len(e) < 4 * least or np.ptp(e) == 0.0:
        return 1.0
    rise = int(np.clip(np.argmax(np.abs(np.cumsum(_scores(e)))) + 1, least, len(e) - least))
    sides = [_own_errors(side) for side in (e[:rise], e[rise:])]
    split = np.split(_scores(np.concatenate(sides)), [len(sides[0])])
    scores = np.concatenate([part - part.mean() for part in split])
    own = float(scores @ scores)
    near, far = (sum(float(scores[lag:] @ scores[:-lag]) / own for lag in range(last - NEAR + 1, last + 1)) for last in (NEAR, FAR))
    return float(scipy.special.ndtr(-(near - far) * np.sqrt(len(scores) / (2.0 * NEAR)))) if own > 0.0 else 1.0


def _scores(e: Array) -> Array:
    """Return the normal scores of the ranks of |e| (T,), which have the mean zero."""
    _, place, counts = np.unique(np.abs(e), return_inverse=True, return_counts=True)
    return np.asarray(scipy.special.ndtri((np.cumsum(counts) - (counts - 1) / 2)[place] / (len(e) + 1)))


def _own_errors(part: Array) -> Array:
    """Return what an autoregression of NEAR lags leaves of a part (T,) that it was fitted to, (T - NEAR,)."""
    past = np.column_stack([np.ones(len(part) - NEAR)] + [part[NEAR - i : len(part) - i] for i in range(1, NEAR + 1)])
    return np.asarray(part[NEAR:] - past @ np.linalg.lstsq(past, part[NEAR:], rcond=None)[0])


def outlier_doubts(e: Array, before: int, outputs: Sequence[str]) -> Iterator[Doubt]:
    """Yield the outputs with errors e (T, p) that normal noise of the size nearby would not have; sample `before` of the record is e[0]."""
    sizes, width = outlier_sizes(e)
    chances = e.size * outlier_chance(sizes, width)
    seen = np.argwhere(chances < DOUBT_LEVEL)
    if len(seen):
        who = [name for j, name in enumerate(outputs) if j in seen[:, 1]]
        when = sorted({int(k) + before for k in seen[:, 0]})
        listed = ", ".join(map(str, when[:MOST_TOLD])) + (f" and {len(when) - MOST_TOLD} more" if len(when) > MOST_TOLD else "")
        yield Doubt(
            "outliers",
            tuple(who),
            f"errors of {named(who)} at samples {listed} reach {sizes.max():.3g} deviations of those around them",
            "squares give such samples a weight that they do not deserve: one in a hundred, of ten deviations of the output, makes the "
            "model's errors three times as large, and the standard errors grow with them",
            "look at these samples: a slip of the sensor is to be mended, a fault that strikes for a moment is to be kept",
            float(chances.min()),
        )


def outlier_sizes(e: Array) -> tuple[Array, int]:
    """Return |e| (T, p) in deviations as the medians of the samples on each side tell them, and how many samples that are."""
    width = min(WINDOW, len(e) - 1 + len(e) % 2)
    sides = [scipy.ndimage.median_filter(np.abs(e), (width, 1), mode="mirror", origin=(end, 0)) for end in (-(width // 2), width // 2)]
    around = np.maximum(*sides) / QUARTER
    floor = np.median(np.abs(e), axis=0) * EPS
    return np.asarray(np.abs(e) / np.maximum(around, np.where(floor > 0, floor, 1.0))), width


def outlier_chance(sizes: Array, width: int) -> Array:
    """Return the probability of an error beyond these many deviations, that of the deviation from the median of `width` samples in it."""
    density = 2 * np.exp(-(QUARTER**2) / 2) / np.sqrt(2 * np.pi)
    variance = 0.25 / (density * QUARTER) ** 2 / width
    return np.asarray(2 * scipy.special.ndtr(-sizes / np.sqrt(1 + sizes**2 * variance)))


def score_chance(scores: Array, length: int) -> float:
    """Return the chance of a sum of scores (T, q) as far from zero as this one, by blocks of so many samples; 1 where they are too few.

    Scores that are zero throughout take no part.
    """
    sizes = np.linalg.norm(scores, axis=0)
    scores = scores[:, sizes > 0] / sizes[sizes > 0]
    blocks = len(scores) // max(length, 1)
    if scores.shape[1] == 0 or blocks < LEAST_BLOCKS * scores.shape[1]:
        return 1.0
    sums = scores[: blocks * length].reshape(blocks, length, -1).sum(axis=1)
    left, values, _ = np.linalg.svd(sums, full_matrices=False)
    kept = values > EPS * values.max(initial=0.0) * blocks
    q = int(kept.sum())
    if q == 0:
        return 1.0
    # The squared length of the vector of ones in the span of the columns of blocks, over their number.
    share = float(np.sum(left[:, kept].sum(axis=0) ** 2)) / blocks
    return float(scipy.special.betaincc(q / 2, (blocks - q) / 2, min(share, 1.0)))


def _beside(shapes: Array, regressors: Array) -> Array:
    """Return what the regressors leave of the shapes (T, q), zero where that is rounding."""
    shapes = shapes - shapes.mean(axis=0)
    rest = shapes - regressors @ np.linalg.lstsq(regressors, shapes, rcond=None)[0]
    rest = rest - rest.mean(axis=0)
    kept = np.linalg.norm(rest, axis=0) > np.sqrt(EPS) * np.linalg.norm(shapes, axis=0)
    return np.asarray(rest * kept)


def _unit(values: Array) -> Array:
    sizes = values.std(axis=0)
    return np.asarray(values / np.where(sizes > 0, sizes, 1.0))


def _filtered(values: Array, coefficients: Array, T: int) -> Array:
    """Return sum_i coefficients[i] values(k - i), (T, 1), for the last T samples; the coefficients are (h + 1, 1, width)."""
    end = len(values)
    return np.asarray(sum(values[end - T - i : end - i] @ part.T for i, part in enumerate(coefficients)))
