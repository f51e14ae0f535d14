"""Single causes of a shift of the mean: those that explain it, those that do not, and where nothing can be said."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brute
from scipy.stats import chi2, f

from faultspace import example_data as plant
from faultspace import numeric
from faultspace.base.errors import InvalidData
from faultspace.numeric import ShiftIsolation, StateSpaceModel, arx_reduction, isolate_shift
from faultspace.numeric.method.space import shift_isolation
from faultspace.numeric.plant.report.causes_told import isolation_lines

Array = NDArray[np.float64]
MODEL = StateSpaceModel(plant.A, plant.B, plant.C, plant.D)
GAIN = MODEL.C @ np.linalg.solve(np.eye(3) - MODEL.A, MODEL.B) + MODEL.D
NAMES = ("a sensor fault on y1", "a sensor fault on y2", "a sensor fault on y3", "an actuator fault on u1", "an actuator fault on u2")
CANDIDATES = np.hstack([np.eye(3), GAIN])
NOISE = 0.035


def covariance(seed: int, p: int = 3) -> Array:
    root = np.random.default_rng(seed).standard_normal((p, p + 2))
    return np.asarray(root @ root.T)


@pytest.mark.parametrize("j", range(5))
@pytest.mark.parametrize("freedom", [None, 60])
def test_the_one_cause_is_named_with_its_size_in_any_units(j: int, freedom: int | None) -> None:
    V = covariance(j)
    d = 40.0 * CANDIDATES[:, j] / np.sqrt(CANDIDATES[:, j] @ np.linalg.solve(V, CANDIDATES[:, j]))
    found = isolate_shift(d, V, MODEL, freedom=freedom)
    assert found.answer == f"{NAMES[j]} explains the shift, and no other single sensor or actuator does" and found.decided
    size = found.causes[j].size
    assert size is not None and np.allclose(size * CANDIDATES[:, j], d)
    units = np.array([1e6, 1e-3, 50.0])
    scaled = StateSpaceModel(MODEL.A, MODEL.B, units[:, None] * MODEL.C, units[:, None] * MODEL.D)
    other = isolate_shift(units * d, V * np.outer(units, units), scaled, freedom=freedom)
    pairs = zip(found.causes, other.causes, strict=True)
    assert all(np.isclose(a.p_value, b.p_value, atol=1e-12) and np.isclose(a.bound, b.bound) for a, b in pairs)  # type: ignore[arg-type]


def test_the_chances_are_drawn_of_those_causes_that_have_one() -> None:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    axes = isolate_shift(40.0 * GAIN[:, 0], np.eye(3), MODEL, steady=False).plot(pyplot.figure().add_subplot())
    assert [label.get_text() for label in axes.get_yticklabels()] == ["sensor y1", "sensor y2", "sensor y3"]
    found = isolate_shift(40.0 * GAIN[:, 0], np.eye(3), MODEL)
    axes = found.plot(pyplot.figure().add_subplot())
    lengths = [bar.get_width() for bar in axes.patches]
    assert len(lengths) == 5 and np.argmin(lengths) == 3 and max(lengths) <= 12.0
    for bar, cause in zip(lengths, found.causes, strict=True):
        assert cause.p_value is not None and np.isclose(10.0**-bar, max(cause.p_value, 1e-12))
    pyplot.close("all")


def test_a_shift_elsewhere_is_neither() -> None:
    assert (
        isolate_shift([30.0, -20.0, 25.0], np.eye(3), MODEL).answer == "neither: no single sensor and no single actuator explains the shift"
    )


def test_where_an_actuator_moves_one_output_alone_both_are_named() -> None:
    alone = StateSpaceModel(np.diag([0.5, 0.3]), np.eye(2), np.eye(2), np.zeros((2, 2)))
    found = isolate_shift([10.0, 0.3], np.eye(2), alone)
    assert found.answer == "a sensor fault on y1 and an actuator fault on u1 explain the shift, each by itself: the data cannot tell which"


def test_the_chance_is_that_of_hotellings_statistic_across_the_direction() -> None:
    V, d = covariance(1), np.array([3.0, 9.0, -2.0])
    across = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]).T  # to sensor 2
    T = d @ across @ np.linalg.solve(across.T @ V @ across, across.T @ d)
    assert np.isclose(isolate_shift(3 * d, 9 * V, MODEL).causes[1].p_value, chi2.sf(T, 2))  # type: ignore[arg-type]
    assert np.isclose(isolate_shift(3 * d, 9 * V, MODEL, freedom=20).causes[1].p_value, f.sf(T * 19 / 40, 2, 19))  # type: ignore[arg-type]


def test_the_mean_of_a_fault_that_varies_tells_no_cause() -> None:
    column = GAIN[:, 0] / np.linalg.norm(GAIN[:, 0])
    d = 10.0 * column + 4.0 * np.array([0.0, 1.0, -1.0])  # what an actuator's fault of changing size leaves, and no static gain tells
    assert "actuator fault on u1" not in isolate_shift(d, 0.1 * np.eye(3), MODEL).answer
    chance = isolate_shift(d, 0.1 * np.eye(3), MODEL, varying=200.0 * np.eye(3))
    assert "what the residual varies by" in chance.reason and not chance.decided
    assert {cause.answer for cause in chance.causes} == {"undecided"}
    constant = isolate_shift(10.0 * column, 0.1 * np.eye(3), MODEL, varying=0.1 * np.eye(3))
    assert constant.answer == f"{NAMES[3]} explains the shift, and no other single sensor or actuator does"
    with pytest.raises(InvalidData, match="positive definite"):
        isolate_shift(d, np.eye(3), MODEL, varying=np.zeros((3, 3)))


def test_a_true_cause_is_excluded_as_often_as_stated() -> None:
    draw, B, excluded = np.random.default_rng(11), 12, 0
    root = np.linalg.cholesky(covariance(2))
    for _ in range(500):
        white = root @ draw.standard_normal((3, B))
        found = isolate_shift(200 * CANDIDATES[:, 1] + root @ draw.standard_normal(3), white @ white.T / B, MODEL, freedom=B)
        excluded += found.causes[1].answer == "excluded"
    assert 1 <= excluded <= 14  # 5 are expected


def test_the_least_statistic_is_that_of_a_slow_search() -> None:
    draw = np.random.default_rng(4)
    for _ in range(4):
        d, c, variances = 20 * draw.standard_normal(3), draw.standard_normal(3), draw.uniform(0, 0.2, 3)
        c /= np.linalg.norm(c)

        def statistic(a: float, d: Array = d, c: Array = c, variances: Array = variances) -> float:
            return float(np.sum((d - a * c) ** 2 / (1 + a * a * variances)))

        slow = brute(lambda a: statistic(float(a[0])), ((-500, 500),), Ns=4001, finish=None)
        assert statistic(shift_isolation._best(d, c, variances)) <= statistic(float(slow)) + 1e-9
        assert np.isclose(shift_isolation._best(d, c, np.zeros(3)), shift_isolation._best(d, c, np.full(3, 1e-18)), rtol=1e-6)


def test_the_errors_of_the_static_gain_are_its_derivatives() -> None:
    draw = np.random.default_rng(6)
    root = 1e-6 * draw.standard_normal((30, 4))
    gain, errors = shift_isolation._static_gain(MODEL, root)
    assert np.allclose(gain, GAIN)
    for column, error in zip(root.T, errors, strict=True):
        E = column.reshape(6, 5)
        A, B, C, D = MODEL.A + E[:3, :3], MODEL.B + E[:3, 3:], MODEL.C + E[3:, :3], MODEL.D + E[3:, 3:]
        assert np.allclose(C @ np.linalg.solve(np.eye(3) - A, B) + D - GAIN, error, atol=1e-3 * np.abs(error).max())


def test_an_actuator_of_unsure_gain_is_not_excluded_and_not_named() -> None:
    draw = np.random.default_rng(8)
    u = draw.standard_normal((900, 2))
    model = arx_reduction(MODEL.simulate(u) + NOISE * draw.standard_normal((900, 3)), u, order=3)
    off = GAIN[:, 0] * (1 + np.array([0.0, 0.01, -0.01]))  # by less than the errors of the model, once they are made larger
    V = 1e-10 * np.eye(3)
    assert isolate_shift(off, V, model.model).causes[3].answer == "excluded"
    unsure = replace(model, uncertainty=replace(model.uncertainty, root=5 * model.uncertainty.root))
    assert isolate_shift(off, V, unsure).causes[3].answer != "excluded"


def test_where_nothing_can_be_said_it_says_why() -> None:
    one = isolate_shift([5.0], [[0.01]], StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]]))
    assert "never to be told apart" in one.answer and {cause.answer for cause in one.causes} == {"undecided"}
    chance = isolate_shift([0.5, 0.5, 0.5], np.eye(3), MODEL)
    assert "not beyond chance" in chance.answer and not chance.decided
    for pole in (1.0, 1.1, -1.0):
        wandering = StateSpaceModel(np.diag([pole, 0.5]), np.eye(2), np.eye(2), np.zeros((2, 2)))
        bias = isolate_shift([0.0, 9.0], np.eye(2), wandering)
        assert bias.answer.startswith("a sensor fault on y2 explains the shift; undecided: whether an actuator fault on u1 or")
        assert bias.actuators == shift_isolation.NO_GAIN
    moving = isolate_shift(30 * GAIN[:, 0], np.eye(3), MODEL, steady=False)
    assert moving.answer.startswith("undecided: an actuator fault on u1 or an actuator fault on u2 may explain the shift, and nothing")
    without = StateSpaceModel([[0.5]], [[0.0]], [[1.0], [1.0]], [[0.0], [0.0]])  # an actuator that does nothing
    assert isolate_shift([0.0, 9.0], np.eye(2), without).causes[2].answer == "undecided"
    blind = StateSpaceModel(np.zeros((0, 0)), np.zeros((0, 0)), np.zeros((2, 0)), np.zeros((2, 0)))
    assert isolate_shift([0.0, 9.0], np.eye(2), blind).of("consistent")[0].channel == "y2"


def test_what_does_not_fit_is_refused() -> None:
    for shift, V in (
        ([1.0], np.eye(3)),
        ([1.0, 2.0, np.nan], np.eye(3)),
        ([1.0, 2.0, 3.0], np.ones((3, 3))),
        ([1.0, 2.0, 3.0], -np.eye(3)),
    ):
        with pytest.raises(InvalidData):
            isolate_shift(shift, V, MODEL)
    with pytest.raises(InvalidData, match="names"):
        isolate_shift([1.0, 2.0, 3.0], np.eye(3), MODEL, inputs=["a"])
    with pytest.raises(InvalidData, match="freedom"):
        isolate_shift([1.0, 2.0, 3.0], np.eye(3), MODEL, freedom=2)


def identified(number: int, healthy: int | None, seed: int, samples: int = 900, at: int = 450) -> numeric.Identification:
    """Return the answer for a record with a step of 10 sigma of the noise at a sensor, at an actuator (-1: elsewhere)."""
    draw = np.random.default_rng((seed, number + 1))
    u = draw.standard_normal((samples, 2))
    direction = CANDIDATES[:, number] if number >= 0 else np.array([1.0, -1.0, 1.0])
    size = 10 * NOISE / np.abs(direction).max()
    moved, bias = u.copy(), np.zeros(3)
    if number >= 3:
        moved[at:, number - 3] += size
    else:
        bias = size * direction
    y = MODEL.simulate(moved) + NOISE * draw.standard_normal((samples, 3))
    y[at:] += bias
    return numeric.identify(y, u, order=3, healthy=healthy)


# What the slow ones would say is asked daily of `isolate_shift`, in the tests above.
@pytest.mark.parametrize(
    ("number", "healthy"),
    [pytest.param(1, 400, marks=pytest.mark.slow), (3, 400), (-1, 400), pytest.param(2, None, marks=pytest.mark.slow)],
)
def test_identify_tells_what_a_step_is(number: int, healthy: int | None) -> None:
    answer = identified(number, healthy, 20261122)
    found = answer.shift_isolation
    assert isinstance(found, ShiftIsolation) and found.samples is not None and found.against is not None
    assert found.samples[0] >= 450 and found.against[1] <= 450
    said = f"{NAMES[number]} explains the shift" if number >= 0 else "neither: no single sensor and no single actuator explains the shift"
    assert found.answer.startswith(said) and len(found.of("consistent")) == (number >= 0)
    lines = list(isolation_lines(answer))
    assert lines[:2] == ["", "## Which sensor or actuator"] and lines[2] == f"**{found.answer}**"
    assert json.loads(json.dumps(answer.to_json(), allow_nan=False))["shift_isolation"]["answer"] == found.answer


def test_a_shift_that_moves_on_does_not_stay() -> None:
    draw = np.random.default_rng(5)
    gaps = [shift_isolation.stays(np.zeros(3), gap, np.eye(3), None) for gap in draw.standard_normal((400, 3))]
    assert 388 <= sum(gaps) < 400  # 396 are expected
    assert not shift_isolation.stays(np.zeros(3), np.array([0.0, 5.0, 0.0]), np.eye(3), None)


@pytest.mark.slow
def test_a_drifting_sensor_is_named_and_nothing_is_said_of_actuators() -> None:
    draw = np.random.default_rng(3)
    u = draw.standard_normal((900, 2))
    y = MODEL.simulate(u) + NOISE * draw.standard_normal((900, 3))
    y[450:, 0] += np.linspace(0, 1, 450)
    found = numeric.identify(y, u, order=3, healthy=400).shift_isolation
    assert found is not None and found.of("consistent") == (found.causes[0],) and found.actuators == shift_isolation.UNSTEADY
