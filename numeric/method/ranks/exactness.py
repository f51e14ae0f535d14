"""Tell whether a record obeys laws without noise: the way of ranks is then exact, and any likelihood of noise has nothing to hold on to.

A system with fewer faults than outputs has kernel rows N(q) [y; u] = N_y(q) w ([W91]). Without the noise w they are exact, so that windows
longer than the lag do not have full rank; any noise in every output fills them. A rank is decided by what rounding can do (`hankel_ranks`).
"""

from __future__ import annotations

import numpy as np

from ....base.arrays import Array
from .hankel_ranks import HankelRanks, rounding_ranks
from .sample_windows import channel_sizes

SCREENED = 1 << 12  # samples: a law that some samples refute is none
LONGEST = 20  # samples of a window
TALLEST = 280  # rows of a Hankel matrix, whose factor costs their square a sample


def obeys_exactly(y: Array, u: Array, *, single: bool = False) -> bool:
    """Say whether y (N, p), u (N, n_u), in any units and of float32 where `single`, obey a law of outputs and inputs to rounding.

    Records too short for windows that could tell do not. Source: [W91]; ranks by [GVL13] corollary 8.6.2.
    """
    ranks = _ranks(y, u, single)
    if ranks is None:
        return False
    joint, own, unit = ranks
    # What stands above half the digits is no rounding, however alike the least singular values are.
    rounding = joint.thresholds[-1] <= np.sqrt(unit) * float(np.linalg.norm(joint.values[-1]))
    return bool(rounding and joint.ranks[-1] - own.ranks[-1] < len(joint.ranks) * y.shape[1])


def driven_exactly(y: Array, u: Array, *, single: bool = False) -> bool:
    """Say whether faults act on y (N, p), u (N, n_u), which obey a law exactly: a model of such a record is an estimate, for what faults do
    is told from what inputs do by chance alone. Constant faults and sums of few sinusoids are not seen: they end as states do."""
    ranks = _ranks(y, u, single)
    if ranks is None or len(ranks[0].ranks) < 2:
        return False
    joint, own, _ = ranks
    added = [whole - of_inputs for whole, of_inputs in zip(joint.ranks[-2:], own.ranks[-2:], strict=True)]
    return bool(added[1] > added[0])


def _ranks(y: Array, u: Array, single: bool) -> tuple[HankelRanks, HankelRanks, float] | None:
    """Return the ranks of the windows of all channels and of the inputs with the unit of rounding; None where windows are too few."""
    y, u = y[:SCREENED], u[:SCREENED]
    channels = y.shape[1] + u.shape[1]
    windows = min(LONGEST, len(y) // (2 * channels + 1), max(TALLEST // channels, 2))
    if windows < 2:
        return None
    unit = float(np.finfo(np.float32 if single else np.float64).eps)
    joint, own = (rounding_ranks(values / channel_sizes(values), windows, unit=unit) for values in (np.hstack([u, y]), u))
    return joint, own, unit
