"""The last of p faults is hardest to see in a residual alone: the step to it must be larger than that to any other."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace.numeric import fault_dimension
from faultspace.numeric.method.ranks import residual_laws


def two_faults(seed: int) -> NDArray[np.float64]:
    """Return a residual (3000, 3) of two coloured faults in noise 60 dB below them."""
    rng = np.random.default_rng(seed)
    v = np.cumsum(rng.standard_normal((3000, 2)), axis=0)
    v = (v - v.mean(axis=0)) / v.std(axis=0)
    return np.asarray(v @ np.array([[1.0, 2.0, -1.0], [1.0, -1.0, 1.0]]) + 0.001 * rng.standard_normal((3000, 3)))


def test_the_last_fault_is_counted_by_its_own_threshold(monkeypatch: pytest.MonkeyPatch) -> None:
    assert fault_dimension(two_faults(1)).n_v == 2
    monkeypatch.setattr(residual_laws, "CLEAR_LAST", 1e9)
    assert fault_dimension(two_faults(1)).n_v is None
