"""Records without noise on which a fault acts are judged: rows and count are exact, the model is an estimate, and is not called exact."""

from __future__ import annotations

import numpy as np
import pytest

import faultspace as fs
from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidData
from faultspace.numeric import ReducedModel
from faultspace.numeric.method.ranks.exactness import driven_exactly, obeys_exactly
from faultspace.numeric.plant.steps import modelling
from tests.numeric.test_experiments import PLANT, F, G, in_states_of


def record(seed: int, samples: int, fault: float = 1.0) -> tuple[Array, Array]:
    """Return y and u of a plant without noise, on which a white fault acts."""
    u, v = np.random.default_rng(seed).standard_normal((2, samples, 1))
    return PLANT.simulate(np.hstack([u, fault * v]), [1.0, -1.0]), u


def test_the_space_comes_with_an_angle_that_holds() -> None:
    y, u = record(5, 600)
    found = fs.identify(y, u, order=2)
    space = found.fault_space
    assert isinstance(found.model, ReducedModel) and found.n_v == 1 and space is not None and space.uncertainty is not None
    assert space.decided and space.error_bound is None and space.n_z == 1
    column = np.concatenate([in_states_of(found.model.model) @ F, G]).ravel()
    column /= np.linalg.norm(column)
    angle = np.arcsin(np.linalg.norm(column - space.basis @ (space.basis.T @ column)))
    assert 1e-3 < angle <= space.uncertainty.angle() < 0.3, "an estimate that is not exact, of a stated error"
    assert any("the model is an estimate" in note for note in found.notes)


def test_without_an_arx_model_the_space_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(*arguments: object) -> None:
        raise InvalidData("no ARX model today")

    monkeypatch.setattr(modelling, "_by_reduction", refused)
    found = fs.identify(*record(5, 600), order=2)
    space = found.fault_space
    assert space is not None and not space.decided and space.error_bound is None and "by chance alone" in space.reason
    assert found.pair is None and any("no ARX model today" in note for note in found.notes)


def test_without_a_fault_the_model_is_exact() -> None:
    y, u = record(5, 600, fault=0.0)
    found = fs.identify(y, u, order=2)
    assert (
        found.model is not None and found.n_v == 0 and obeys_exactly(y, u) and not driven_exactly(y, u) and driven_exactly(*record(5, 600))
    )
    change = in_states_of(found.model.model)
    assert np.max(np.abs(change @ np.asarray(PLANT.A) - found.model.model.A @ change)) < 1e-9
    assert not driven_exactly(y[:5], u[:5])


def test_with_healthy_samples_the_space_is_exact() -> None:
    u, v = np.random.default_rng(6).standard_normal((2, 600, 1))
    v[:300] = 0.0
    found = fs.identify(PLANT.simulate(np.hstack([u, v]), [1.0, -1.0]), u, order=2, healthy=300, n_v=1)
    space = found.fault_space
    assert found.model is not None and space is not None and space.decided
    column = np.concatenate([in_states_of(found.model.model) @ F, G]).ravel()
    column /= np.linalg.norm(column)
    assert np.linalg.norm(column - space.basis @ (space.basis.T @ column)) < 1e-6
