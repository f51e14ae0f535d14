"""About which point the plant is linear: healthy samples tell it; without them zero where it may be, else the means, and that is said."""

from __future__ import annotations

import numpy as np
import pytest

from faultspace.base.arrays import Array
from faultspace.numeric import Identification, StateSpaceModel, identify
from faultspace.numeric.plant.healthy.mean_shift import mean_about_zero
from faultspace.numeric.plant.report.summary import summary

PLANT = StateSpaceModel([[0.8, 0.2], [-0.2, 0.7]], [[1.0, 0.3], [0.2, -0.8]], [[1.0, 0.0], [0.5, 1.0], [0.0, 1.0]], np.zeros((3, 2)))
N, K, POINT = 600, 300, np.array([40.0, -7.0, 2700.0, 5.0, -120.0])


def measured(bias: float = 0.0, seed: int = 1) -> tuple[Array, Array]:
    draw = np.random.default_rng(seed)
    u = draw.standard_normal((N, 2))
    y = PLANT.simulate(u) + 0.1 * draw.standard_normal((N, 3))
    y[K:, 1] += bias
    return y, u


def found(y: Array, u: Array, **known: object) -> Identification:
    return identify(y, u, order=2, **known)  # type: ignore[arg-type]


def test_beside_healthy_samples_their_means_are_the_point_and_nothing_depends_on_it() -> None:
    y, u = measured(0.5)
    here, there = (found(y + lift * POINT[2:], u + lift * POINT[:2], healthy=K) for lift in (0.0, 1.0))
    for one in (here, there):
        assert one.operating_point.of == "healthy samples" and one.mean is not None and one.mean.channels == (1,)
        assert one.shift_isolation is not None and one.n_v != 0
    assert there.operating_point.values == pytest.approx(here.operating_point.values + POINT)
    assert here.model is not None and there.model is not None and here.mean is not None and there.mean is not None
    assert np.abs(here.model.model.A - there.model.model.A).max() < 5e-3  # where a search stops
    assert here.mean.statistic == pytest.approx(there.mean.statistic, rel=0.02)
    assert "operating point: the means of the healthy samples, u1 39.9" in "\n".join(summary(there, "x"))


def test_without_healthy_samples_zero_is_taken_where_it_may_be_and_means_hide_no_fault() -> None:
    y, u = measured()
    at_rest = found(y, u)
    assert at_rest.operating_point.of == "zero" and at_rest.n_v == 0
    for lift in (0.3 * np.array([0.0, 0.0, 1.0, 0.0, 0.0]), POINT):  # a constant of three sigma, and a plant as they are
        far = found(y + lift[2:], u + lift[:2])
        assert far.operating_point.of == "whole record" and not far.operating_point.stated
        assert far.n_v is None and "a constant fault would have gone with the means" in far.reason
        assert "only samples without fault can tell it" in far.operating_point.reason
    means = found(y + POINT[2:], u + POINT[:2], operating_point="means")
    assert means.n_v == 0 and means.operating_point.stated and means.mean is None and not means.moved
    about = identify([y[:200], y[:200] + 10.0], [u[:200], u[:200] - 4.0], order=2)
    assert about.operating_point.of == "single experiments" and about.operating_point.values is None


def test_what_has_no_noise_stays_as_it_is() -> None:
    _, u = measured()
    y = PLANT.simulate(u)
    for healthy in (None, K):
        one = found(y, u + 0.0, healthy=healthy)
        assert one.exact and one.operating_point.of == "zero" and one.n_v == 0


def test_an_input_that_stands_far_off_is_no_constant_of_the_outputs() -> None:
    draw = np.random.default_rng(3)
    chances = []
    for _ in range(20):
        u = draw.standard_normal((400, 1)) + 3.0
        y = StateSpaceModel([[0.7]], [[1.0]], [[1.0], [2.0]], [[0.0], [0.0]]).simulate(u)[50:] + 0.3 * draw.standard_normal((350, 2))
        chances.append([mean_about_zero(y + off, u[50:], level=0.01).shifted for off in (0.0, [0.0, 3.0])])
    clean, moved = np.sum(np.array(chances, dtype=bool), axis=0)
    assert clean <= 2 and moved >= 18
