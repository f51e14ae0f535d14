"""What the tests of means and spectra do not look at, and a plot would show: reasons not to say 0, or not to count, beside healthy samples.

beyond_healthy_inputs   the inputs are louder, or elsewhere, than while healthy
unlike_healthy          a spike, a sensor that is stuck or dead

The constants are rules of thumb, set by hand. They make an answer undecided and never decide one.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...base.arrays import Array
from ...base.errors import shorten

LOUDER = 1.5  # an input of more than so many times its healthy deviation drives model error that the healthy samples do not show
AWAY = 10.0  # and so does one that moved by more than so many
PEAK = 3.0  # a residual of more than so many times its healthy peak is no noise like the healthy one,
QUIET = 0.5  # nor is one of less than this share of its healthy size,
STUCK = 20  # nor an output that keeps one value for so many samples, and LONGER times as many as while healthy
LONGER = 4


def beyond_healthy_inputs(before: Array, u: Array, names: Sequence[str]) -> str:
    """Say why the model's error need not be as the healthy samples show it, or nothing."""
    sizes = np.where(before.std(axis=0) > 0.0, before.std(axis=0), 1.0)
    louder, away = u.std(axis=0) / sizes, np.abs(u.mean(axis=0) - before.mean(axis=0)) / sizes
    for i, name in enumerate(names):
        if louder[i] > LOUDER or away[i] > AWAY:
            how = f"{louder[i]:.3g} times as loud" if louder[i] > LOUDER else f"{away[i]:.3g} deviations away"
            return f"input {shorten(name)} is {how} after the healthy samples, so that the error of the model can look like a fault"
    return ""


def unlike_healthy(r: Array, healthy: Array, y: Array, healthy_y: Array, names: Sequence[str]) -> str:
    """Say what a plot would show and no spectrum or mean: a spike, or a sensor that is stuck or dead. It is empty where there is none."""
    peaks, sizes = np.abs(healthy).max(axis=0), np.sqrt(np.mean(healthy**2, axis=0))
    for i, name in enumerate(names):
        where = int(np.argmax(np.abs(r[:, i])))
        if abs(r[where, i]) > PEAK * peaks[i]:
            times = abs(r[where, i]) / peaks[i]
            return f"the residual of {shorten(name)} reaches {times:.3g} times its healthy peak: a short fault, or an outlier"
        if np.sqrt(np.mean(r[:, i] ** 2)) < QUIET * sizes[i]:
            return f"the residual of {shorten(name)} is much smaller than while healthy: a sensor that is stuck or dead, or less noise"
        still = _longest_still(y[:, i])
        if still >= max(STUCK, LONGER * _longest_still(healthy_y[:, i])):
            return f"{shorten(name)} keeps one value for {still} samples: a sensor that is stuck or dead, or nothing that moves it"
    return ""


def _longest_still(values: Array) -> int:
    """Return samples of the longest run of equal values."""
    edges = np.flatnonzero(np.concatenate([[True], values[1:] != values[:-1], [True]]))
    return int(np.diff(edges).max())
