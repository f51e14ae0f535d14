"""The evidence for an order is tested: the range left open, and how often the choice is right."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.signal

from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidData
from faultspace.numeric import StateSpaceModel, arx_reduction, arx_reduction_experiments, identify
from faultspace.numeric.method.model.order_choice import order_left_open
from faultspace.numeric.method.model.order_evidence import OrderRow, weighed

PLANT = StateSpaceModel(
    [[0.9, 0.2, 0.0], [0.0, -0.6, 0.0], [0.0, 0.0, 0.3]], [[1.0], [1.0], [1.0]], [[1.0, 1.0, 1.0], [1.0, -1.0, 0.5]], [[0.3], [0.0]]
)
STATIC = StateSpaceModel(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((2, 0)), [[1.0], [2.0]])
N = 400


def fault(seed: int) -> Array:
    return np.asarray(scipy.signal.lfilter([1.0], [1.0, -0.9], np.random.default_rng(seed).standard_normal((N, 2)), axis=0))


def row(order: int, cost: float) -> OrderRow:
    return OrderRow(order, cost, 3 * order, 0.0, 0.5, 0.5, 2.0)


def test_the_choice_is_akaikes_and_the_range_what_is_not_refused_below_it() -> None:
    clear = weighed([row(0, 100.0), row(1, 20.0), row(2, 15.0)])
    assert (clear.best, clear.least, clear.most, clear.decided) == (1, 1, 1, True)
    # Three parameters a state: 7 is worth a state, and chance does as much in .072 of records, in each of the two orders above.
    open_ = weighed([row(0, 100.0), row(1, 20.0), row(2, 13.0), row(3, 8.0)])
    assert (open_.best, open_.least, open_.most, open_.decided) == (2, 1, 2, False)
    assert [one.chance for one in open_.rows[2:]] == [1.0, 1.0] and open_.rows[1].chance == pytest.approx(2 * 0.0719, abs=2e-3)
    assert weighed([row(0, 100.0), row(1, 11.4), row(2, 0.0)]).least == 2 and weighed([row(0, 100.0), row(1, 11.3), row(2, 0.0)]).least == 1
    alone = weighed([row(0, 5.0)])
    assert alone.decided and alone.best == 0


def test_an_order_is_refused_by_chance_as_seldom_as_is_said() -> None:
    """Chi-squared gains of two states that are not there; the deviation of the share is .0016."""
    rng = np.random.default_rng(0)
    gains = rng.chisquare(3, (4000, 2))
    refused = [weighed([row(0, one + two), row(1, two), row(2, 0.0)]).least > 0 for one, two in gains]
    assert 0.004 < np.mean(refused) < 0.015


@pytest.mark.parametrize(("plant", "noise"), [(PLANT, 0.3), (PLANT, 0.0), (STATIC, 1.0)])
def test_the_order_is_found(plant: StateSpaceModel, noise: float) -> None:
    u = np.random.default_rng(1).standard_normal((N, 1))
    found = arx_reduction(plant.simulate(u) + noise * fault(2), u)
    assert found.orders is not None and found.order == found.orders.best == found.orders.most
    assert found.orders.least == plant.n <= found.orders.most <= plant.n + (2 if noise else 0)
    rows = {one.order: one for one in found.orders.rows}
    below, right = rows.get(plant.n - 1), rows[plant.n]
    assert right.chance >= 0.01 and (below is None or below.chance < 0.01)
    if below is not None:
        assert right.one_step > below.one_step and right.free_run > below.free_run and right.cost < below.cost
        assert right.gap > rows[plant.n + 1].gap
    assert len(found.orders.summary().splitlines()) == 2 + len(found.orders.rows)


def test_data_that_tell_nothing_of_a_weak_state_leave_the_order_open_or_lower() -> None:
    weak = StateSpaceModel(PLANT.A, PLANT.B, PLANT.C * [1.0, 1.0, 0.04], PLANT.D)
    u = np.random.default_rng(1).standard_normal((N, 1))
    ranges = []
    for seed in range(2):
        found = arx_reduction(weak.simulate(u) + 0.3 * fault(seed), u)
        assert found.orders is not None
        ranges.append((found.orders.least, found.orders.most))
        assert found.orders.decided or "open" in found.notes[-1]
    assert all(least == 2 <= most for least, most in ranges)


def test_fits_on_held_back_samples_are_those_of_the_part_before() -> None:
    """Without a fault the free run is exact about any operating point, with a white one its error is the one-step error."""
    u = np.random.default_rng(1).standard_normal((N, 1))
    clean = PLANT.simulate(u)
    exact = arx_reduction(clean + np.array([1e3, -70.0]), u + 30).orders
    assert exact is not None and exact.rows[3].free_run > 1 - 1e-6 and exact.rows[3].one_step > 1 - 1e-6
    noisy = arx_reduction(clean + 0.5 * np.random.default_rng(3).standard_normal(clean.shape), u).orders
    assert noisy is not None
    share = 0.5 / np.sqrt(np.mean((clean / clean.std(axis=0)) ** 2)) / clean.std(axis=0)
    assert 1 - noisy.rows[3].free_run == pytest.approx(np.sqrt(np.mean(share**2 / (1 + share**2))), rel=0.15)
    assert noisy.rows[3].one_step == pytest.approx(noisy.rows[3].free_run, abs=0.02)


def test_several_experiments() -> None:
    u = np.random.default_rng(1).standard_normal((N, 1))
    y = PLANT.simulate(u) + 0.3 * fault(4)
    found = arx_reduction_experiments([(y[:150], u[:150]), (y[150:], u[150:])])
    assert found.orders is not None and found.orders.least == 3 and len(found.initial_states) == 2
    assert all(state.shape == (found.order,) for state in found.initial_states)
    with pytest.raises(InvalidData, match="record more"):
        arx_reduction(y[:3], u[:3])


def test_where_nothing_else_tells_the_order_samples_held_back_do() -> None:
    """An unstable plant of four states under noise: singular values have no gap, and ARX models take no unstable plant."""
    rng = np.random.default_rng(36)
    plant = StateSpaceModel(np.diag([1.02, 0.8, -0.6, 0.3]), *(rng.standard_normal(shape) for shape in ((4, 1), (2, 4), (2, 1))))
    u = rng.standard_normal((120, 1))
    y = plant.simulate(u)
    y = y + 0.1 * np.std(y) * rng.standard_normal(y.shape)
    found = identify(y, u)
    assert found.model is not None and np.max(np.abs(found.model.model.poles)) > 1
    (note,) = (note for note in found.notes if "last" in note and "fits best" in note)
    assert f"{found.model.order} fits best" in note and "not told apart" in note
    open_ = order_left_open(y, u, found.block_rows)
    assert open_ is not None and open_.least <= open_.best == found.model.order <= open_.most
    assert open_.fits[open_.best - 1] == np.nanmax(open_.fits)
    assert order_left_open(rng.standard_normal((60, 2)), rng.standard_normal((60, 1)), 3) is None
