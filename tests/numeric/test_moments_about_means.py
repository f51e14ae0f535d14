"""Moments of records about their means are judged: what the ends of a record leave at frequency zero is no fault and no missing order."""

from __future__ import annotations

import numpy as np
import pytest

from faultspace.base.arrays import Array
from faultspace.numeric.method.rows import joint
from faultspace.numeric.method.rows.fault_count import count_faults
from faultspace.numeric.method.rows.joint import joint_moments
from faultspace.numeric.method.rows.space_by_rows import fault_space_by_rows
from faultspace.numeric.method.space.tapered_moments import about_means
from tests.numeric.test_experiments import PLANT, A, C


def quiet(seed: int, samples: int, decibels: float) -> tuple[Array, Array]:
    """Return a record with one fault and an operating point, about its means, with so little noise."""
    rng = np.random.default_rng(seed)
    u, v, w = rng.standard_normal((samples, 1)), rng.standard_normal((samples, 1)), rng.standard_normal((samples, 3))
    y = PLANT.simulate(np.hstack([u, v])) + [5.0, -3.0, 2.0] + 10 ** (-decibels / 20) * w
    return y - y.mean(axis=0), u - u.mean(axis=0)


@pytest.mark.parametrize(("samples", "decibels"), [(300, 80.0), (9000, 100.0)])
def test_large_signals_over_little_noise_are_counted_about_their_means(samples: int, decibels: float) -> None:
    y, u = quiet(77, samples, decibels)
    assert count_faults(y, u, order=2).n_v == 1
    found = fault_space_by_rows(y, u, A, C, n_v=1)
    assert found.decided and found.n_z == 1


def test_without_a_constant_they_are_not(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(joint, "about_means", lambda r: False)
    assert count_faults(*quiet(77, 300, 80.0), order=2).n_v is None


@pytest.mark.parametrize("samples", [300, 20000])
def test_a_constant_of_the_windows_is_no_part_of_the_moments(samples: int) -> None:
    """The same moments, but for rounding, wherever the means were before; and about nothing where a mean is that of chance."""
    y, u = quiet(2, samples, 20.0)
    assert about_means(np.hstack([y, u])) and not about_means(np.hstack([y, u]) + 1e-3)
    moved = y + 100.0
    again = joint_moments([(moved - moved.mean(axis=0), u)], 3).moments
    here = joint_moments([(y, u)], 3).moments
    np.testing.assert_allclose(again.moments, here.moments, atol=1e-9)
    assert abs(here.weights.sum() - 1) < 1e-12 and here.weights[0] < joint_moments([(moved, u)], 3).moments.weights[0]
