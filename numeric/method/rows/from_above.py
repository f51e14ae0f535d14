"""Fit kernel rows again from those of the next higher total degree, where a course that only climbs has stuck.

Rows of total degree d + 1 that explain no more than those of degree d are these times a factor q - a in one row, and a combination of rows.
So at q = a they depend on each other: the combination that vanishes there is divided by q - a, and takes the place of a longest row. A
course upwards ends in a local minimum in some of a hundred records, which then looks like an order that is too low; random starts find it
from there (4 of 8 in one such record, 1 of 8 in another), and this start is one.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ....base.arrays import Array
from ..space.basis import KernelBasis
from .joint import JointMoments, even_split, refitted

# Real roots a that are tried: tan of so many angles, evenly spaced, so that roots and their inverses are alike.
ANGLES = 64


def from_above(data: JointMoments, fits: Sequence[KernelBasis], *, shares: Array | None = None) -> list[KernelBasis]:
    """Return fits of total degrees 0, 1, .. that are no less likely than these."""
    better = list(fits)
    for total in range(len(fits) - 2, -1, -1):
        degrees = even_split(total, len(fits[0].rows))
        trial = refitted(data, degrees, divided(better[total + 1].rows, degrees), shares=shares)
        if trial.level < better[total].level:
            better[total] = trial
    return better


def divided(rows: Sequence[Array], degrees: Sequence[int]) -> list[Array]:
    """Return rows of these degrees, one less in all than those of the rows (eta_i + 1, channels), divided where at a real q these are
    nearest to depending on each other."""
    highest = max(map(len, rows)) - 1
    stacked = np.array([np.pad(row, ((0, highest + 1 - len(row)), (0, 0))) for row in rows])
    # Homogeneous, q = tan: powers of unit size, so that no root is nearer for being small.
    angles = (np.arange(ANGLES) + 0.5) * np.pi / ANGLES - np.pi / 2
    powers = np.sin(angles)[:, None] ** np.arange(highest + 1) * np.cos(angles)[:, None] ** np.arange(highest, -1, -1)
    powers /= np.linalg.norm(powers, axis=1)[:, None]
    left, values, _ = np.linalg.svd(np.einsum("aj,kjc->akc", powers, stacked), full_matrices=False)
    nearest = int(np.argmin(values[:, -1]))
    mix, root = left[nearest, :, -1], float(np.tan(angles[nearest]))
    product = np.zeros((highest + 1, highest))
    product[np.arange(highest), np.arange(highest)] = -root
    product[np.arange(1, highest + 1), np.arange(highest)] = 1.0
    quotient: Array = np.asarray(np.linalg.lstsq(product, np.tensordot(mix, stacked, axes=1), rcond=None)[0], dtype=np.float64)
    longest = [i for i, row in enumerate(rows) if len(row) == highest + 1]
    replaced = max(longest, key=lambda i: abs(mix[i]))
    kept = [quotient if i == replaced else row for i, row in enumerate(rows)]
    return [row[: degree + 1] for row, degree in zip(sorted(kept, key=len), degrees, strict=True)]
