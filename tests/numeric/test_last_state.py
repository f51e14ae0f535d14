"""Whether the data need the last state of a model: zeros that a surplus state invents are undecided, and those that are there are not."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from faultspace.numeric import arx_reduction, identified_fault_space
from faultspace.numeric.method.model.valleys import last_state
from faultspace.numeric.method.rows.degree import LeastDegree, excess, least_degree, misfits
from faultspace.numeric.method.rows.joint import course, fitted, joint_moments, refitted
from tests.numeric.planted import joint_record, planted


@pytest.mark.parametrize(("seed", "zeros"), [(22, ()), pytest.param(6, (0.5,), marks=pytest.mark.slow)])
def test_zeros_of_a_surplus_state_hold_for_the_order_that_was_given_alone(seed: int, zeros: tuple[float, ...]) -> None:
    system = planted(seed, zeros, n=3)
    y, u = joint_record(system, seed, 1000, 40)
    least, given = (arx_reduction(y, u, order=order) for order in (3, 4))
    found, more = (identified_fault_space(y, u, model, n_v=2) for model in (least, given))
    assert found.decided and found.zeta == len(zeros), found.reason
    assert more.decided and more.n_z == found.n_z + 1
    assert more.reason.startswith("if the order is 4, as given: ") and "order 3 explains the data nearly as well" in more.reason
    # Had the data chosen that order, the zero would be undecided.
    chosen = replace(given, orders=arx_reduction(y, u).orders)
    undecided = identified_fault_space(y, u, chosen, n_v=2)
    assert not undecided.decided and undecided.zeta is None and undecided.margin < 1
    assert undecided.reason.startswith("undecided: ") and "order 3 explains the data nearly as well" in undecided.reason


def test_what_the_last_state_gains() -> None:
    """A state that is there gains what it explains, one that is not about as much as it has parameters."""
    rng = np.random.default_rng(0)
    u, y = rng.standard_normal((300, 1)), np.zeros((300, 2))
    for k in range(299):
        y[k + 1] = 0.5 * y[k] + u[k] * [1.0, 2.0]
    y += 0.1 * rng.standard_normal(y.shape)
    there, surplus = (last_state(arx_reduction(y, u, order=order)) for order in (1, 2))
    assert there.parameters == surplus.parameters == 3
    assert there.worth > 100 and surplus.worth < 1
    # Other units gain the same.
    assert last_state(arx_reduction(1e5 * y, 1e-3 * u, order=1)).gain == pytest.approx(there.gain, rel=0.02)


def chosen_of(levels: tuple[float, ...], least: int, most: int) -> LeastDegree:
    """Return the choice from 1000 samples of four channels, and fits of one row with total degrees 0, 1, .. that leave these levels."""
    fits = [SimpleNamespace(level=level, rows=(np.zeros((degree + 1, 4)),)) for degree, level in enumerate(levels)]
    data = cast(Any, SimpleNamespace(samples=1000.0, moments=SimpleNamespace(channels=4)))
    return least_degree(data, cast(Any, fits), least, most, misfits(len(levels)))


def test_where_every_degree_is_refused_the_likeliest_is_answered() -> None:
    """Degree 2 leaves a little that the highest one explains, degrees 3 and 4 no less, degree 1 nearly everything."""
    found = chosen_of((-1.0, -2.0, -11.0, -11.001, -11.003, -11.203), 1, 4)
    assert found.degree == 2 and not found.decided and "higher degree" in found.reason
    # Where nothing is likely at all the order is too low: the highest degree that it allows is the least wrong.
    low = chosen_of((-1.0, -2.0, -3.0, -11.0), 0, 2)
    assert low.degree == 2 and not low.decided and low.reason.endswith("the order is too low")
    # And a degree that suffices is found as ever.
    assert chosen_of((-1.0, -2.0, -11.0, -11.003, -11.004, -11.005), 1, 4).degree == 2


def test_wide_bands_refuse_no_degree() -> None:
    """Rows that turn fast within a band of the course leave there what a degree more explains; in narrow bands they do not."""
    system = planted(6, (), n=4, p=4, m=2)
    y, u = joint_record(system, 6, 5000, 60)
    wide = joint_moments([(y, u)], 3)
    fits = course(wide, 2, 5)
    narrow = joint_moments([(y, u)], 3, 500)
    found = [refitted(narrow, (2, 2), fits[4].rows), refitted(narrow, (2, 3), fits[5].rows)]
    assert excess(wide, fits[4], fits[5], misfits(1)) < 1e-6
    assert excess(narrow, found[0], found[1], misfits(1)) > 0.01


def test_the_law_of_the_degree() -> None:
    """Where the least degree is true its stated probability is not small, and that of the degree below is none."""
    small = 0
    for seed in range(12):
        system = planted(30 + seed, n=2, p=2, m=1)
        y, u = joint_record(system, seed, 600, 40)
        data = joint_moments([(y, u)], 4)
        chosen = least_degree(data, course(data, 1, 4), 0, 2, misfits(4))
        small += chosen.probabilities[2] < 0.01
        assert chosen.probabilities[1] < 1e-3
    assert small <= 2


def test_a_descent_that_sticks_at_one_degree_leaves_the_answer_decided() -> None:
    """Levels of a course that gained nothing from degree 1 to 2, and much from 2 to 3; a step of one degree alone said that 1 suffices."""
    y, u = joint_record(planted(26, n=3, m=1), 26, 500, 40)
    data = joint_moments([(y, u)], 4)
    fit = fitted(data, (1,))
    steps = [replace(fit, rows=(np.ones((d + 1, 4)),), level=level) for d, level in enumerate((0.0, -4.0, -3.9, -9.0, -9.005))]
    found = least_degree(data, steps, 0, 3, misfits(4))
    assert found.degree == 3 and found.decided
