"""These are numbers as JSON has them.

plain    lists and numbers of an array: null for what is not finite, [real, imaginary] for what is complex
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike


def plain(values: ArrayLike | None) -> Any:
    """Return lists and numbers that JSON has: null for None and for what is not finite, [real, imaginary] for complex numbers."""
    if values is None:
        return None
    array = np.asarray(values)
    if array.ndim:
        return [plain(entry) for entry in array]
    if np.iscomplexobj(array):
        return [plain(array.real), plain(array.imag)]
    number = float(array)
    return number if np.isfinite(number) else None
