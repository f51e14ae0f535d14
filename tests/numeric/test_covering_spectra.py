"""`covering_spectra`: no frequency of a record escapes the count against a healthy one, whatever its length."""

from __future__ import annotations

import numpy as np
import pytest

from faultspace.numeric.plant.healthy.against_healthy import fault_dimension_against_healthy
from faultspace.numeric.plant.healthy.healthy_model import MANY_TAPERS, covering_spectra, healthy_reference, spectra


@pytest.mark.parametrize("samples", range(8 * MANY_TAPERS - 1, 10 * MANY_TAPERS))
def test_the_windows_cover_all_frequencies(samples: int) -> None:
    e = np.random.default_rng(samples).standard_normal((samples, 2))
    for tapers in (4, MANY_TAPERS):
        found, apart = covering_spectra(e, tapers), spectra(e, tapers)
        centres = found.frequencies * 2 * (samples + 1)
        assert np.isclose(centres[0], tapers) and np.isclose(centres[-1], samples + 1 - tapers)
        assert np.diff(centres).max() <= 2 * tapers + 1e-9
        kept = len(apart.frequencies)
        assert len(centres) <= kept + 1 and np.array_equal(found.transforms[:kept], apart.transforms)


@pytest.mark.parametrize("samples", [800, 815, 830, 831])
def test_a_fault_that_alternates_with_a_smooth_envelope_is_seen(samples: int) -> None:
    """Its spectrum lies next to one half, where centres that share nothing may leave out up to 16 / N."""
    draw = np.random.default_rng(samples)
    reference = healthy_reference(draw.standard_normal((800, 3)))
    r, k = draw.standard_normal((samples, 3)), np.arange(samples)
    assert fault_dimension_against_healthy(r, reference).n_v == 0
    r[:, 1] += 20.0 * (-1.0) ** k * np.sin(np.pi * k / samples) ** 2
    assert fault_dimension_against_healthy(r, reference).at_least == 1
