"""Single causes of a fault: those that explain it, those that do not, and those that the data cannot tell."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace import example_data as plant
from faultspace.base.errors import InvalidData
from faultspace.numeric import (
    FaultSpaceEstimate,
    Isolation,
    SpaceUncertainty,
    StateSpaceModel,
    arx_reduction,
    fault_space,
    identified_fault_space,
    isolate,
)

Array = NDArray[np.float64]
MODEL = StateSpaceModel(plant.A, plant.B, plant.C, plant.D)
COLUMNS = np.hstack([np.vstack([np.zeros((3, 3)), np.eye(3)]), np.vstack([plant.B, plant.D])])
NAMES = ("a sensor fault on y1", "a sensor fault on y2", "a sensor fault on y3", "an actuator fault on u1", "an actuator fault on u2")


def exact(columns: Array, n_v: int, model: StateSpaceModel = MODEL) -> Isolation:
    """Return the answer for the residual that faults with these columns [f; g] make, without noise."""
    v = np.random.default_rng(1).standard_normal((400, columns.shape[1]))
    n = model.n
    r = StateSpaceModel(model.A, columns[:n], model.C, columns[n:]).simulate(v, x0=np.arange(1.0, n + 1))
    return isolate(fault_space(r, model.A, model.C, n_v=n_v), model)


@pytest.mark.parametrize("j", range(5))
def test_of_exact_residuals_the_one_cause_is_named_and_no_other(j: int) -> None:
    assert exact(COLUMNS[:, [j]], 1).answer == f"{NAMES[j]} explains it, and no other single sensor or actuator does"


def test_a_fault_elsewhere_is_neither() -> None:
    assert exact(np.vstack([plant.F, plant.G]), 1).answer == "neither: no single sensor and no single actuator explains it"


def test_two_faults_are_explained_by_the_set_that_acts_or_by_none() -> None:
    found = exact(COLUMNS[:, [1, 3]], 2)
    assert found.answer == "a sensor fault on y2 and an actuator fault on u1 explain the 2 faults together"
    mixed = exact(np.hstack([COLUMNS[:, [1]], np.vstack([plant.F, plant.G])]), 2)
    assert mixed.answer.startswith("neither: no 2 sensors and actuators explain the 2 faults; only a sensor fault on y2 is consistent")


def test_where_an_actuator_moves_one_output_alone_both_are_named() -> None:
    alone = StateSpaceModel(np.diag([0.5, 0.3]), np.eye(2), np.array([[1.0, 0.0], [0.0, 1.0]]), np.zeros((2, 2)))
    found = exact(np.array([[0.0], [0.0], [1.0], [0.0]]), 1, alone)
    assert found.answer == "a sensor fault on y1 and an actuator fault on u1 explain it, each by itself: the data cannot tell which"
    assert [len(several) for several in found.sets] == [1, 1]


def test_as_many_faults_as_outputs_cannot_be_told_apart() -> None:
    found = exact(COLUMNS[:, :3], 3)
    assert found.answer.startswith("undecided") and {cause.answer for cause in found.causes} == {"undecided"}


def record(column: Array, seed: int, N: int = 1000, size: float = 10.0) -> tuple[Array, Array]:
    """Return y and u of the packaged plant with a coloured fault of this column [f; g]."""
    draw = np.random.default_rng(seed)
    u, white = draw.standard_normal((N, 2)), draw.standard_normal(N + 1)
    v = size * 0.035 * (white[1:] + 0.6 * white[:-1])[:, None]
    driven = StateSpaceModel(plant.A, np.hstack([plant.B, column[:3]]), plant.C, np.hstack([plant.D, column[3:]]))
    return driven.simulate(np.hstack([u, v])) + 0.035 * draw.standard_normal((N, 3)), u


@pytest.mark.parametrize("j", [0, 3])
def test_of_noisy_records_the_cause_is_named(j: int) -> None:
    y, u = record(COLUMNS[:, [j]], 0)
    model = arx_reduction(y, u, order=3)
    space = identified_fault_space(y, u, model, n_v=1)
    found = isolate(space, model, outputs=plant.OUTPUTS, inputs=plant.INPUTS, units=y.std(axis=0))
    right = found.causes[j]
    assert right.answer == "consistent" and [cause.answer for cause in found.causes].count("excluded") == 4
    assert right.bound is not None and right.p_value is not None and right.p_value > 0.05
    assert found.answer.startswith(("a sensor fault on level1 explains", "an actuator fault on valve explains")[j // 3])
    json.dumps(found.to_json(), allow_nan=False)
    undecided = isolate(replace(space, decided=False), model)
    assert undecided.answer.startswith("undecided") and undecided.sets == ()
    without = isolate(replace(space, method="likelihood"), model)
    assert "takes A and C of the model as right" in without.answer


def test_a_chance_between_the_levels_and_a_wide_bound_are_undecided() -> None:
    model = StateSpaceModel(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((2, 0)), np.array([[0.0], [1.0]]))

    def space(angle: float, error: float) -> FaultSpaceEstimate:
        Q = np.array([[np.cos(angle)], [np.sin(angle)]])
        root = error * np.array([[[-np.sin(angle)], [np.cos(angle)]]])
        v = np.random.default_rng(0).standard_normal((50, 1))
        known = fault_space(v @ Q.T, model.A, model.C, n_v=1)
        return replace(known, basis=Q, uncertainty=SpaceUncertainty(root), decided=True)

    assert isolate(space(0.10, 0.1), model).causes[0].answer == "consistent"
    assert isolate(space(0.22, 0.1), model).causes[0].answer == "undecided"
    assert isolate(space(0.40, 0.1), model).causes[0].answer == "excluded"
    assert isolate(space(0.10, 1.0), model).causes[0].answer == "undecided"
    both = isolate(space(np.pi / 2, 0.01), model)
    assert both.answer.startswith("a sensor fault on y2 and an actuator fault on u1 explain it, each by itself")


def test_names_and_shapes_that_do_not_fit_are_refused() -> None:
    space = fault_space(np.random.default_rng(0).standard_normal((90, 1)) @ np.ones((1, 3)), MODEL.A, MODEL.C, n_v=1)
    with pytest.raises(InvalidData, match="outputs: got 2 names"):
        isolate(space, MODEL, outputs=["a", "b"])
    with pytest.raises(InvalidData, match="space: got"):
        isolate(space, StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]]))
