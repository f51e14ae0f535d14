"""Thresholds for a stated rate of false alarms: derived where the law is known, else simulated, and raised where healthy data ask it.

The rate is shared by the tests alike, so that all of them together have at most the stated one. With rate a sample for one test,

    residual      no more than a of the samples exceed h where p P(|N(0, 1)| > h) = a (union of the outputs, correlated or not)
    chi-square    the sum over a window is chi-squared with p w degrees of freedom, and exceeds its quantile in a of the samples; windows
                  that overlap exceed it in runs, so that there are fewer alarms than that
    cusum, hankel the law of a run is not known in closed form. Gaussian streams are simulated (`simulated`), the largest value of each
                  block of `memory` samples is taken, and the tail of these maxima beyond their quantile 0.9 is exponential with their
                  mean excess, as for maxima in the domain of Gumbel's law [P75]: a threshold h has P(maximum > h) = 1 - exp(-a memory)

A model that is not quite right, or noise that is not Gaussian, leaves healthy errors with larger statistics. So the same statistics are run
over the healthy errors, each quarter judged by what the others taught, and every threshold is multiplied by how far the largest tenth of
the healthy block maxima stands above the largest tenth of the simulated ones, on average; never by less than one. What a healthy record
cannot show are rates beyond its length: 10 / rate samples are needed for a rate to be seen there (ten alarms expected); with fewer the
shape of the tail is that of Gaussian noise, and `notes` of the Calibration says so.

Calibration         thresholds with what they rest on
largest_of_blocks   what they need of healthy errors, for whatever rate
calibrated          from that
simulated           block maxima of Gaussian streams
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy.special

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.progress import Progress, silent
from ....base.sheets import counted
from .statistics import HELD, TESTS, Bank, Settings

STREAMS, BLOCKS, SEED = 128, 20, 20250519  # streams simulated, blocks of each, and their seed
TAIL = 0.1  # share of the maxima from which a tail is extrapolated
SEEN = 10  # alarms that a healthy record must be long enough to show
LEAST_BLOCKS = 3  # blocks of `memory` healthy samples without which nothing is calibrated
TOLD = 1.5  # times by which a threshold is raised before a note says so
SURPRISING = 0.01  # probability of as many healthy alarms below which a note is due


@dataclass(frozen=True, eq=False)
class Calibration:
    """This has for each of TESTS the `threshold`, the `ideal` one of white Gaussian errors, and the `healthy_alarms` of the threshold.

    On the healthy record `expected` alarms are due at most, of all tests together. `samples` of healthy errors were used, and `needed`
    are for the rate to be seen there.
    """

    level: float
    threshold: Array
    ideal: Array
    healthy_alarms: tuple[int, ...]
    expected: float
    samples: int
    needed: int
    notes: tuple[str, ...]


def simulated(settings: Settings, heard: Progress = silent) -> Array:
    """Return the block maxima (STREAMS BLOCKS, 4) of white Gaussian errors, after two memories in which the statistics settle."""
    kept = _kept(settings)
    if not kept:
        kept.append(_simulated(settings, heard))
    return kept[0]


@lru_cache(maxsize=16)
def _kept(settings: Settings) -> list[Array]:
    """Return what has been simulated for these settings, or nothing yet."""
    return []


def _simulated(settings: Settings, heard: Progress) -> Array:
    """Simulate so many streams side by side as HELD allows."""
    memory, side = settings.memory, int(np.clip(HELD // settings.numbers, 1, STREAMS))
    maxima = np.zeros((BLOCKS, STREAMS, len(TESTS)))
    for first in range(0, STREAMS, side):
        draw, part = np.random.default_rng(SEED + first), maxima[:, first : first + side]
        bank = Bank(settings, part.shape[1])
        for k in range(-2 * memory, BLOCKS * memory):
            z = draw.standard_normal((part.shape[1], settings.p))
            found = bank.update(z, z)
            done, steps = k + 2 * memory + 1, (BLOCKS + 2) * memory
            heard("simulating streams without a fault", first * steps + part.shape[1] * done, STREAMS * steps)
            if k >= 0:
                np.maximum(part[k // memory], found, out=part[k // memory])
    result = maxima.reshape(-1, len(TESTS))
    if not result[:, TESTS.index("cusum")].any():
        raise InvalidData(
            f"shift: got {settings.shift:g}; needed a smaller change of mean, in deviations: no CUSUM for this one begins without a fault, "
            "so that none can be calibrated: try 1.0"
        )
    result.setflags(write=False)
    return result


def ideal_thresholds(settings: Settings, rate: float) -> Array:
    """Return the thresholds (4,) of white Gaussian errors for this rate of each test a sample."""
    maxima = simulated(settings)
    beyond = -np.expm1(-rate * settings.memory)
    return np.array(
        [
            -scipy.special.ndtri(rate / (2 * settings.p)),
            scipy.special.chdtri(settings.p * settings.window, rate),
            *(_tail(maxima[:, TESTS.index(name)], beyond) for name in ("cusum", "hankel")),
        ]
    )


def _tail(maxima: Array, beyond: float) -> float:
    """Return what a maximum exceeds with probability `beyond`."""
    if beyond >= TAIL:
        return float(np.quantile(maxima, 1 - beyond))
    edge = float(np.quantile(maxima, 1 - TAIL))
    return edge + float(np.mean(maxima[maxima > edge] - edge)) * float(np.log(TAIL / beyond))


def largest_of_blocks(settings: Settings, errors: Array, sizes: Array, heard: Progress = silent) -> Array:
    """Return the largest statistics (blocks, 4) of each block of `memory` healthy errors (M, p) and (M, p), as `Bank` takes.

    Raises InvalidData where there are fewer than LEAST_BLOCKS blocks.
    """
    memory, samples = settings.memory, len(errors)
    blocks = samples // memory
    if blocks < LEAST_BLOCKS:
        raise InvalidData(
            f"healthy: {counted(samples, 'sample')} of errors are too few to calibrate windows of {settings.window} samples by; "
            f"{LEAST_BLOCKS * memory} are needed: give a longer record without fault, or a shorter window"
        )
    bank = Bank(settings, 1)
    trace = np.empty((samples, len(TESTS)))
    for k, (z, s) in enumerate(zip(errors, sizes, strict=True)):
        trace[k] = bank.update(z[None], s[None])[0]
        heard("judging the healthy record", k + 1, samples)
    return np.asarray(trace[samples - blocks * memory :].reshape(blocks, memory, -1).max(axis=1))


def calibrated(settings: Settings, level: float, maxima: Array, samples: int, heard: Progress = silent) -> Calibration:
    """Return the thresholds for `level` false alarms a sample of all tests together, from the largest statistics (blocks, 4) of the blocks
    of so many healthy samples."""
    blocks = len(maxima)
    simulated(settings, heard)
    ideal = ideal_thresholds(settings, level / len(TESTS))
    threshold = ideal * np.maximum(1.0, _largest(maxima) / _largest(simulated(settings), blocks))
    alarms = tuple(int(count) for count in np.sum(maxima > threshold, axis=0))
    expected, needed = level * samples, int(np.ceil(SEEN / level))
    notes = []
    if samples < needed:
        notes.append(
            f"{counted(samples, 'healthy sample')} cannot show {level:g} false alarms a sample, {needed} could: beyond what they show "
            "the tail of the statistics is taken to be that of Gaussian noise"
        )
    raised = threshold / ideal
    if np.any(raised > TOLD):
        notes.append(
            f"the healthy record has larger errors than Gaussian noise has, so that thresholds are raised, that of "
            f"{TESTS[int(np.argmax(raised))]} to {np.max(raised):.2g} times: outliers, a drift, or an error of the model, which hide faults"
        )
    if sum(alarms) and scipy.special.pdtrc(sum(alarms) - 1, expected) < SURPRISING:
        notes.append(
            f"the healthy record itself has {counted(sum(alarms), 'alarm')} where {expected:.2g} are due: it is not steady (drift, "
            "outliers, a fault in it?), and more false alarms than stated are to be expected"
        )
    return Calibration(level, threshold, ideal, alarms, expected, samples, needed, tuple(notes))


def _largest(maxima: Array, of: int | None = None) -> Array:
    """Return the mean (4,) of the largest tenth of the maxima, one at least; with `of`, its average for so many of their kind."""
    count = len(maxima) if of is None else of
    share = max(1, count // 10) / count
    kept = max(1, round(share * len(maxima)))
    return np.asarray(np.sort(maxima, axis=0)[-kept:].mean(axis=0))
