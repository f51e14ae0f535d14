"""These bring a record to size one, so that an absolute threshold of whoever reads it does no harm.

sizes    the root mean square of each channel, 1 where that is zero
to_one   that of the whole record
"""

from __future__ import annotations

import numpy as np

from ....base.arrays import Array


def sizes(signal: Array) -> Array:
    """There is a number for each channel of the signal (N, p)."""
    largest = np.max(np.abs(signal), axis=0, initial=0.0)
    largest[~(largest > 0)] = 1.0
    found: Array = largest * np.sqrt(np.mean((signal / largest) ** 2, axis=0))
    return found


def to_one(signal: Array) -> float:
    """Return one number for all channels: the root mean square of the largest."""
    return float(np.max(sizes(signal), initial=0.0)) or 1.0
