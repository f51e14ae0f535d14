"""A row of the table of changes before it is judged, and the sums over time that two kinds of rows are made of."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy  # its folders are loaded when they are first used

from ....base.arrays import Array
from ..healthy.mean_shift import POWER
from .predictor import Predictor

MEAN, DRIFT, GROWTH, LOSS, FREEZING, LINE, OUTPUT_GAIN, INPUT_GAIN = KINDS = (
    *("mean shift", "drift", "growth of variance", "loss of variance", "freezing", "sinusoid", "output gain", "input gain"),
)


@dataclass(frozen=True)
class Evidence:
    """What one test says of one channel.

    `chance` is the probability of so much by chance, not corrected for other tests, None where `reason` says why it cannot be had.
    `statistic` is what it was read from. `size` is the estimated change, in units of the output unless `unit` says another one, `sigmas`
    the same in standard deviations of the healthy residual of that output, `visible` the size that the test finds with the chance POWER
    (infinite: none, whatever its size), `detail` what else there is to say.
    """

    kind: str
    channel: str
    chance: float | None
    statistic: float | None = None
    size: float | None = None
    sigmas: float | None = None
    visible: float | None = None
    visible_sigmas: float | None = None
    unit: str = ""
    detail: str = ""
    reason: str = ""


@dataclass(frozen=True)
class Estimate:
    """A value with its standard deviation and the degrees of freedom of that."""

    value: float
    deviation: float
    freedom: float

    @property
    def statistic(self) -> float:
        """Return how many deviations the value is from zero."""
        return self.value / self.deviation if self.deviation > 0.0 else 0.0

    def chance(self) -> float:
        """Return the probability of a value so far from zero, on either side."""
        return float(2.0 * scipy.special.stdtr(self.freedom, -abs(self.statistic)))

    def visible(self, level: float) -> float:
        """Return the value that is found at this level with the chance POWER, to the first order of Student's law."""
        found, spare = scipy.special.stdtrit(self.freedom, level / 2.0), scipy.special.stdtrit(self.freedom, 1.0 - POWER)
        return float(-self.deviation * (found + spare))


def estimate(learnt: Predictor, e: Array, weights: Array, moments: Array) -> Estimate:
    """Return the estimate sum_k w(k)' e(k) for w (T, p): its variance is that by the spectrum of the healthy e, times 1 + f / g. g is
    sum w' S w, f the variance by the error of the coefficients, for `moments` (q, p), the sums of x(k) w(k)' with the fault taken out."""
    covariance = learnt.covariance
    noise = float(np.sum(weights @ covariance * weights))
    own, freedom = learnt.variance(weights)
    forecast = float(np.sum((learnt.root @ moments @ np.linalg.cholesky(covariance)) ** 2))
    variance = own * (1.0 + forecast / noise) if noise > 0.0 else 0.0
    return Estimate(float(np.sum(weights * e)), float(np.sqrt(variance)), freedom)


def by_student(kind: str, channel: str, found: Estimate, level: float, factor: float, spread: float, detail: str = "") -> Evidence:
    """Return the Evidence of an estimate; `factor` brings its value into units of the output, `spread` is the size of its residual."""
    size, visible = abs(found.value) * factor, found.visible(level) * factor
    signed = size if found.value >= 0.0 else -size
    return Evidence(kind, channel, found.chance(), found.statistic, signed, signed / spread, visible, visible / spread, detail=detail)


def undecided(kind: str, channel: str, reason: str) -> Evidence:
    """Return a row that cannot be had."""
    return Evidence(kind, channel, None, reason=reason)
