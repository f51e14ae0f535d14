"""Floats meet the exact limit: estimates from long records lie within their standard errors of what exact covariances predict."""

from __future__ import annotations

import json
from functools import cache
from importlib import resources
from typing import Any

import numpy as np
import pytest

from faultspace.exact.limits.experiments import read_experiment
from faultspace.exact.limits.moesp import PopulationLimits, limit
from faultspace.numeric.method.model.compression import compress
from faultspace.numeric.method.model.past_inputs import pi_moesp
from faultspace.numeric.method.model.past_outputs import po_moesp
from tests.numeric.predicted_limits import floats, invariants, predicted_model, simulated

SAMPLES, SEEDS, ERRORS = 100_000, 8, 5.0
NAMES = ("fault-leads-input", "fault-follows-input", "independent-fault")


@cache
def known(name: str) -> PopulationLimits:
    text = resources.files("faultspace").joinpath("examples", f"{name}.json").read_text("utf-8")
    return limit(read_experiment(json.loads(text)))


@cache
def records(name: str) -> list[tuple[Any, Any]]:
    return [simulated(known(name).experiment, SAMPLES, seed) for seed in range(SEEDS)]


def distances(estimates: list[Any], exact: Any) -> Any:
    """Return how many standard errors of the mean lie between the mean and the limit, entry by entry."""
    table = np.array(estimates)
    error = table.std(axis=0, ddof=1) / np.sqrt(len(table))
    return np.abs(table.mean(axis=0) - exact) / error


@pytest.mark.parametrize("name", NAMES)
def test_the_projected_outputs_tend_to_the_limit(name: str) -> None:
    """The matrix (1/N) Yf Pi Up' is compared entry by entry, from the factor that PI-MOESP computes."""
    found = known(name)
    experiment, estimates = found.experiment, []
    for y, u in records(name):
        compression = compress(y, u, block_rows=experiment.s, past_rows=experiment.past)
        parts = compression.blocks()
        estimates.append(parts.l32 @ parts.l22.T / compression.columns)
    assert np.max(distances(estimates, floats(found.past_inputs.matrix))) < ERRORS


@pytest.mark.parametrize("method", [pi_moesp, po_moesp])
@pytest.mark.parametrize("name", NAMES)
def test_models_tend_to_the_predicted_one(name: str, method: Any) -> None:
    """At the true order, consistent or not, this holds for poles and Markov parameters, with B and D by output error for the A and C
    found."""
    found = known(name)
    experiment, outputs = found.experiment, method is po_moesp
    s, past, n = experiment.s, experiment.past, experiment.system.residual.n
    limit = found.past_outputs if outputs else found.past_inputs
    exact = predicted_model(found.known, found.blocks, limit, s, past, n, outputs=outputs)
    models = [method(y, u, order=n, block_rows=s, past_rows=past).model for y, u in records(name)]
    estimates = [invariants(model.A, model.B, model.C, model.D) for model in models]
    assert np.max(distances(estimates, exact)) < ERRORS
    if limit.state is not None:
        predicted = [float(c) for c in reversed(limit.state.characteristic_polynomial)][1:]
        assert np.allclose(exact[:n], predicted, atol=1e-9)
        markov = found.of_limit(limit)["markov"]
        assert np.allclose(exact[n:], np.array([[[_float(x) for x in row] for row in part] for part in markov])[: n + 1].ravel(), atol=1e-9)


def test_another_limit_would_be_noticed() -> None:
    """The truth in place of the limit lies tens of standard errors away where the limit is biased."""
    found = known("fault-leads-input")
    system, residual = found.experiment.system, found.experiment.system.residual
    truth = invariants(*(floats(M) for M in (residual.A, system.B, residual.C, system.D)))
    models = [pi_moesp(y, u, order=2, block_rows=4, past_rows=4).model for y, u in records("fault-leads-input")]
    gaps = distances([invariants(model.A, model.B, model.C, model.D) for model in models], truth)
    assert np.max(gaps[:2]) < ERRORS and np.max(gaps[2:]) > 10 * ERRORS


def _float(text: str) -> float:
    top, _, bottom = text.partition("/")
    return int(top) / int(bottom or "1")
