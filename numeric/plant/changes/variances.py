"""The variance of an output has grown since the healthy part, as by a white fault, or is lost, as of a sensor that is stuck.

growth    the mean square of the innovations, about their mean and slope, against the healthy one: Fisher's law, with as many degrees of
          freedom as the squares themselves show among the healthy samples, since heavy tails and clusters leave fewer than normal
          noise has. The errors of the predictor's coefficients and of the model's parameters are in the innovations of another part alone,
              and are divided out.
loss      the squares of the steps y(k) - y(k-1) of the raw output, less those of the simulated output, against the same of the healthy
          part: the simulated output goes on moving where the sensor is stuck, and is still where the inputs are. Student's law, with
          the variance of such means at frequency zero.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import scipy  # its folders are loaded when they are first used

from ....base.arrays import Array
from ..healthy.mean_shift import COSINES, POWER
from .predictor import Predictor, Stretch
from .slow import about_slope
from .table_rows import GROWTH, LOSS, Evidence, undecided

TINY = 1e-300  # near the least float, instead of zero below a ratio
FORECAST_FROM = 1 << 12  # samples that the size of a forecast's error is taken of


def changed_variances(
    learnt: Predictor, before: Stretch, after: Stretch, e: Array, names: Sequence[str], level: float
) -> Iterator[Evidence]:
    """Yield the rows of growth and loss, each tested at `level`; e (M - lags, p) are the innovations of the part `after`."""
    if len(e) < 4:
        yield from (undecided(kind, name, "there are too few samples") for kind in (GROWTH, LOSS) for name in names)
        return
    # The healthy part is explained too well by what was fitted to it, and the other part not as well as by the true system.
    spent = min(before.fitted / len(before), 0.5)
    forecast = (1.0 + _forecast(learnt, after) + spent) / (1.0 - spent)
    flat = about_slope(e)
    for i, name in enumerate(names):
        yield _growth(learnt, flat[:, i], forecast, i, name, level)
    for i, name in enumerate(names):
        yield _loss(learnt, before, after, i, name, level)


def _growth(learnt: Predictor, e: Array, forecast: float, i: int, name: str, level: float) -> Evidence:
    healthy, own = float(np.mean(learnt.e[:, i] ** 2) / learnt.share), float(np.sum(e**2) / (len(e) - 2)) / forecast
    squares = learnt.e[:, i] ** 2
    # Few healthy samples may hide heavy tails, which the others show; how these cluster is part of what is asked.
    spreads = [max(_at_zero(squares)[0], float(np.var(squares))) / float(np.mean(squares)) ** 2]
    shape = (e / max(float(np.max(np.abs(e))), TINY)) ** 2  # fourth powers of an outlier would overflow
    spreads.append(float(np.var(shape)) / max(float(np.mean(shape)), TINY) ** 2)
    thinned = min(1.0, 2.0 / max(spreads))
    over, under = thinned * (len(e) - 2), thinned * learnt.count * learnt.share
    ratio = own / healthy
    needed = scipy.special.fdtri(over, under, 1.0 - level) / scipy.special.fdtri(over, under, 1.0 - POWER)
    # A white signal of deviation s at this output adds s^2 times the power of the predictor's own column.
    gain = 1.0 + float(np.sum(learnt.steps[:, i, i] ** 2))

    def white(times: float) -> float:
        return float(np.sqrt(max(times - 1.0, 0.0) * healthy / gain) * learnt.scales[i])

    chance = float(scipy.special.fdtrc(over, under, ratio))
    size, visible, spread = white(ratio), white(needed), learnt.spread[i]
    return Evidence(GROWTH, name, chance, ratio, size, size / spread, visible, visible / spread, detail="as a white signal")


def _loss(learnt: Predictor, before: Stretch, after: Stretch, i: int, name: str, level: float) -> Evidence:
    """Return the row of an output whose steps are smaller than the model and the healthy noise make them."""
    moved, moved_before = (_steps(part, i) for part in (after, before))
    moved_more = moved_before[0] - moved_before[1]
    variance, freedom = _at_zero(moved_more)
    # Where they do not repel each other, means of squares are never surer than of independent ones; few waves may say so by chance.
    variance, healthy = max(variance, float(np.var(moved_more))), float(np.mean(moved_more))
    louder = max(float(np.mean(moved[1])) / max(float(np.mean(moved_before[1])), TINY), 1.0)
    deviation = float(np.sqrt(variance * (louder / len(moved[0]) + 1.0 / len(moved_before[0]))))
    expected = float(np.mean(moved[1])) + healthy
    if deviation == 0.0 or expected <= 0.0:
        return undecided(LOSS, name, "the output hardly moves")
    statistic = (float(np.mean(moved[0])) - expected) / deviation
    chance = float(scipy.special.stdtr(freedom, statistic))
    lost = 1.0 - float(np.mean(moved[0])) / expected
    bound, spare = scipy.special.stdtrit(freedom, level), scipy.special.stdtrit(freedom, 1.0 - POWER)
    visible = float(-deviation * (bound + spare) / expected)
    detail = f"steps are {100.0 * (1.0 - lost):.3g} % of the power expected"
    return Evidence(LOSS, name, chance, statistic, max(lost, 0.0), None, visible if visible < 1.0 else np.inf, None, "lost share", detail)


def _steps(part: Stretch, i: int) -> tuple[Array, Array]:
    """Return the squared steps of the output and of the simulated output."""
    y, simulated = part.y[:, i], part.y[:, i] - part.r[:, i]
    return np.diff(y) ** 2, np.diff(simulated) ** 2


def _at_zero(values: Array) -> tuple[float, int]:
    """Return the spectral density of values at frequency zero, from their first cosine transforms, and its degrees of freedom [LLSW18]."""
    freedom = max(int(COSINES * len(values) ** (2 / 3)), 1)
    waves = np.asarray(scipy.fft.dct(values, type=2, norm="ortho"))[1 : freedom + 1]
    return float(np.mean(waves**2)), freedom


def _forecast(learnt: Predictor, after: Stretch) -> float:
    """Return the mean of x(k)' (X0' X0)^-1 x(k) over the part, by its first samples."""
    joint = learnt.scaled(after.part(0, FORECAST_FROM + learnt.lags))
    blocks = [joint[learnt.lags - j : len(joint) - j] for j in range(1, learnt.lags + 1)]
    X = np.hstack([np.ones((len(joint) - learnt.lags, 1)), *blocks, joint[learnt.lags :, learnt.p :]])
    return float(np.mean(np.sum((X @ learnt.root.T) ** 2, axis=1)))
