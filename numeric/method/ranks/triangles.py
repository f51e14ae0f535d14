"""The triangle of a tall matrix whose rows pass by in blocks, so that memory does not grow with their number.

stacked_triangle    R with R' R = X' X, X the blocks one below the other
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ....base.arrays import Array


def stacked_triangle(width: int, blocks: Iterable[Array]) -> Array:
    """Return the triangle R of the QR factorisation of these blocks of `width` columns: as many rows as columns, or as there are rows."""
    triangle = np.zeros((0, width))
    for block in blocks:
        triangle = np.asarray(np.linalg.qr(np.vstack([triangle, block]), mode="r"))
    return triangle
