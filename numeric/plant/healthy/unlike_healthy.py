"""What the tests of means and spectra do not look at, and a plot would show: reasons not to say 0, or not to count, beside healthy samples.

They make an answer undecided and never decide one. What is a spike, or too long a run of equal values, follows from the level of the
count: the largest of N values is held against the largest of K healthy ones, where sizes, and lengths of runs, have tails that fall no
slower than an exponential. For such tails of scale s the largest of K independent values exceeds s (log K - log log(2 / level)) but for a
probability of level / 2, and the largest of N of p channels stays below s log(2 p N / level) but for as much: so the ratio of the two is
bounded without knowing s. Normal noise has thinner tails, for which the bound is safe even where dependent values count for fewer than K.

How much louder an input may be is calibrated: `benchmarks/identify_healthy.py --inputs` prints how often a record without a fault is called
faulty, while nothing is left undecided on that account. An input that has moved is as loud as its power about the healthy mean.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ....base.arrays import Array
from ....base.errors import shorten
from .healthy_model import HEALTHY_LEVEL

# An input of more than so many times its healthy size drives model error that the healthy samples do not show. `identify_healthy.py
# --inputs` prints it: of 64 records without a fault (seed 640200) 1 is called faulty where inputs stay, 1 at 1.5 times as loud, 4 at 1.75;
# of 40 (seed 640100) 2, 2, and 7 at twice, 19 at three times.
LOUDER = 1.5
# Of less than this share of its healthy size a residual is other noise, or none: what `noise_level` of `count_faults` means, too, may be
# wrong by two and no more.
QUIET = 0.5


def beyond_healthy_inputs(before: Array, u: Array, names: Sequence[str]) -> str:
    """Say why the model's error need not be as the healthy samples show it, the inputs being louder, or elsewhere, or nothing."""
    middle, deviations = before.mean(axis=0), before.std(axis=0)
    sizes = np.where(deviations > 0.0, deviations, 1.0)
    power, spread = np.mean((u - middle) ** 2, axis=0), u.std(axis=0)
    for i, name in enumerate(names):
        if power[i] > (LOUDER * sizes[i]) ** 2:
            away = abs(u[:, i].mean() - middle[i]) / sizes[i]
            how = f"{away:.3g} deviations away" if away * sizes[i] > spread[i] else f"{power[i] ** 0.5 / sizes[i]:.3g} times as loud"
            return f"input {shorten(name)} is {how} after the healthy samples, so that the error of the model can look like a fault"
    return ""


def beyond_healthy_levels(before: Array, u: Array, names: Sequence[str]) -> str:
    """Say why the mean of the residual need not be that of the healthy samples, up to the errors of the model's static gain, or nothing.

    A mean that inputs move is foretold up to these errors, however far it is, where the plant is linear. So that a curved plant would have
    shown it, the inputs have to rest where the healthy ones have been.
    """
    for i, name in enumerate(names):
        middle = before[:, i].mean()
        mean, least, most = u[:, i].mean() - middle, before[:, i].min() - middle, before[:, i].max() - middle
        if u[:, i].std() > LOUDER * (before[:, i].std() or 1.0):
            return f"input {shorten(name)} varies more than in the healthy samples, so that the error of the model can look like a fault"
        if not least <= mean <= most:
            return (
                f"input {shorten(name)} rests {mean:+.3g} from its healthy mean, where the healthy samples have not been ({least:+.3g} to "
                f"{most:+.3g}), so that the error of the model can look like a fault"
            )
    return ""


def unlike_healthy(r: Array, healthy: Array, y: Array, healthy_y: Array, names: Sequence[str]) -> str:
    """Say what a plot would show and no spectrum or mean: a spike, or a sensor that is stuck or dead. It is empty where there is none."""
    peaks, sizes = np.abs(healthy).max(axis=0), np.sqrt(np.mean(healthy**2, axis=0))
    most, longest = largest_ratio(len(healthy), r.size), largest_ratio(len(healthy_y), y.size)
    for i, name in enumerate(names):
        where = int(np.argmax(np.abs(r[:, i])))
        if abs(r[where, i]) > most * peaks[i]:
            times = abs(r[where, i]) / peaks[i]
            return f"the residual of {shorten(name)} reaches {times:.3g} times its healthy peak: a short fault, or an outlier"
        if np.sqrt(np.mean(r[:, i] ** 2)) < QUIET * sizes[i]:
            return f"the residual of {shorten(name)} is much smaller than while healthy: a sensor that is stuck or dead, or less noise"
        still = longest_run(y[:, i])
        if still > longest * longest_run(healthy_y[:, i]):
            return f"{shorten(name)} keeps one value for {still} samples: a sensor that is stuck or dead, or nothing that moves it"
    return ""


def largest_ratio(healthy: int, later: int) -> float:
    """Return by how much the largest of so many `later` values exceeds the largest of so many healthy ones at most, but for a
    probability of HEALTHY_LEVEL, where their tails fall like an exponential or faster. It is infinite where the healthy values are too
    few."""
    scales = float(np.log(healthy) - np.log(np.log(2 / HEALTHY_LEVEL)))
    return float(np.log(2 * later / HEALTHY_LEVEL)) / scales if scales > 0.0 else np.inf


def longest_run(values: Array) -> int:
    """Return the samples of the longest run of equal values."""
    edges = np.flatnonzero(np.concatenate([[True], values[1:] != values[:-1], [True]]))
    return int(np.diff(edges).max())
