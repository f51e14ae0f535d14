"""The fault space in noise that healthy samples have told: noise that goes together across outputs turns nothing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

import faultspace as fs
from faultspace.base.errors import InvalidData
from faultspace.base.progress import silent
from faultspace.numeric import ReducedModel, StateSpaceModel, arx_reduction, identified_fault_space, isolate
from faultspace.numeric.data.joining import one_record
from faultspace.numeric.method.model.moesp_model import MoespModel
from faultspace.numeric.method.rows.known_noise import space_in_known_noise, state_units, whitening
from faultspace.numeric.plant.steps import modelling
from faultspace.numeric.plant.steps.choice import noise_mix
from faultspace.numeric.plant.steps.explaining import explained
from faultspace.numeric.plant.steps.findings import Measured
from faultspace.numeric.plant.steps.operating_point import with_operating_point

Array = NDArray[np.float64]
PLANT = StateSpaceModel([[0.7, 0.2], [-0.3, 0.5]], np.eye(2), [[1.0, 0.5], [0.2, 1.0], [1.0, -1.0]], np.zeros((3, 2)))
TOGETHER = np.array([[1.0, 0.9, 0.0], [0.0, 0.5, 0.9], [0.0, 0.0, 0.4]]) * 0.05


def drawn(seed: int) -> tuple[Array, Array, ReducedModel]:
    """Return y and u with a faint white fault at the second sensor, and the model from samples without it."""
    draw = np.random.default_rng(seed)
    u, noise = draw.standard_normal((700, 2)), draw.standard_normal((700, 3)) @ TOGETHER
    y = PLANT.simulate(u) + noise
    model = arx_reduction(y[:350], u[:350], order=2)
    y[350:, 1] += 0.15 * draw.standard_normal(350)
    return y[350:], u[350:], model


def test_the_sensor_that_has_failed_is_consistent_in_noise_that_goes_together() -> None:
    mix = whitening(TOGETHER.T @ TOGETHER)
    assert mix is not None
    known, plain = [], []
    for seed in range(2):
        y, u, model = drawn(seed)
        found = space_in_known_noise(y, u, model, mix, n_v=1)
        known.append(isolate(found, model, units=state_units(y, mix)).causes[1].p_value)
        plain.append(isolate(identified_fault_space(y, u, model, n_v=1), model, units=y.std(axis=0)).causes[1].p_value)
    # Of two chances the least is below 0.001 once in 500 times; where the noise is not known the sensor is excluded.
    assert min(chance for chance in known if chance is not None) > 1e-3
    assert min(chance for chance in plain if chance is not None) < 1e-5, plain


def test_a_mixture_of_the_outputs_mixes_the_space_and_changes_no_angle() -> None:
    y, u, model = drawn(1)
    own = space_in_known_noise(y, u, model, np.eye(3), n_v=1)
    plain = identified_fault_space(y, u, model, n_v=1, noise_level=np.ones(3))
    assert own.uncertainty is not None and plain.uncertainty is not None
    assert np.allclose(np.abs(own.basis.T @ plain.basis), 1.0) and own.n_z == plain.n_z
    assert own.uncertainty.angle() == pytest.approx(plain.uncertainty.angle(), rel=1e-6)


def test_a_covariance_that_is_none_gives_no_mixture_and_units_that_are_none_are_refused() -> None:
    assert whitening(np.ones((2, 2))) is None and whitening(np.diag([1.0, 0.0])) is None and whitening(np.diag([1.0, np.nan])) is None
    unequal = whitening(np.diag([1e-24, 1e24]))
    assert unequal is not None and np.allclose(unequal, np.diag([1e12, 1e-12]), rtol=1e-12, atol=0.0)
    y, u, model = drawn(1)
    found = identified_fault_space(y, u, model, n_v=1)
    for units in (np.ones((3, 3)), np.ones((2, 2)), np.full((3, 3), np.nan)):
        with pytest.raises(InvalidData, match="units"):
            isolate(found, model, units=units)
    sizes = y.std(axis=0)
    assert isolate(found, model, units=sizes).to_json() == isolate(found, model, units=np.diag(sizes)).to_json()


def test_units_of_known_noise_are_taken_only_where_the_space_was_sought_in_them(monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(*arguments: object) -> None:
        raise InvalidData("no ARX model today")

    draw = np.random.default_rng(1)
    u = draw.standard_normal((400, 2))
    y = PLANT.simulate(u) + draw.standard_normal((400, 3)) @ TOGETHER
    y[200:, 1] += 0.3 * draw.standard_normal(200)
    model = arx_reduction(y[:200], u[:200], order=2)
    monkeypatch.setattr(modelling, "_by_reduction", refused)
    found = fs.identify(y, u, order=2, healthy=200, n_v=1)
    # A model of PI-MOESP, whose space is from rows of the outputs as they are.
    assert isinstance(found.model, MoespModel) and found.fault_space is not None and found.fault_space.method == "kernel rows"
    part = one_record(y, u)
    plant = explained(Measured(*with_operating_point(part, 200, None), 200, False, None), found.model, False, 20, silent)
    assert noise_mix(plant) is None and noise_mix(replace(plant, model=model)) is not None
