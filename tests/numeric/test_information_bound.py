"""The Cramer-Rao bound is tested against the Fisher information in time, against an exact likelihood, and on functions broken."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import scipy.linalg
import scipy.optimize
import scipy.signal

from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidData
from faultspace.numeric import Spectra, StateSpaceModel, Uncertainty, cramer_rao
from faultspace.numeric.method.model.invariants import off_gauge, state_space, system_matrix
from faultspace.numeric.method.model.uncertainty import uncertainty_of
from faultspace.numeric.method.model.weighted_reduction import Reduction
from faultspace.numeric.study import information_bound
from faultspace.numeric.study.driving_spectra import filtered, through, total, white
from faultspace.numeric.study.information_bound import relative_error

Bound = Callable[[StateSpaceModel, Spectra, int], Uncertainty]

PLANT = StateSpaceModel([[0.5, 0.2], [-0.3, 0.4]], [[1.0], [0.5]], [[1.0, 0.0], [0.3, -1.0]], [[0.2], [0.0]])
FAULT = StateSpaceModel(PLANT.A, [[0.4], [1.0]], PLANT.C, [[0.0], [0.7]])
NOISE = np.diag([0.04, 0.09])
COLOURED = Spectra(filtered([1.0, 0.5], [1.0]), total(through(FAULT, filtered([1.0], [1.0, -0.6])), white(NOISE)))


def inverse(spectrum: Any) -> Any:
    return np.linalg.inv(spectrum)


def impulse_of(model: StateSpaceModel, pole: float, count: int) -> Array:
    """Return the impulse response (count, p, 1) of the model driven through 1 / (1 - pole q^-1)."""
    return np.asarray(scipy.signal.lfilter([1.0], [1.0, -pole], model.markov(count), axis=0))


def in_the_time_domain(samples: int) -> Array:
    """Return the expected information of so many samples from rest, by the Toeplitz covariance of the disturbance: the slow twin."""
    matrix, step, long = system_matrix(PLANT), 1e-6, 400
    h = impulse_of(FAULT, 0.6, long)[:, :, 0]
    lags = [h[lag:].T @ h[: long - lag] + NOISE * (lag == 0) for lag in range(samples)]  # E v(k + lag) v(k)'
    covariance = np.block([[lags[i - j] if i >= j else lags[j - i].T for j in range(samples)] for i in range(samples)])
    root = np.linalg.cholesky(covariance)
    whitened = []
    for entry in range(matrix.size):
        change = np.zeros(matrix.size)
        change[entry] = step
        markov = [state_space(matrix + sign * change.reshape(matrix.shape), 2).markov(samples) for sign in (1, -1)]
        # What white noise does through the input's colour 1 + q^-1 / 2 and this derivative.
        d = (markov[0] - markov[1])[:, :, 0] / (2 * step)
        d[1:] += 0.5 * d[:-1].copy()
        toeplitz = np.vstack([np.column_stack([d[i - j] if i >= j else np.zeros(2) for j in range(samples)]) for i in range(samples)])
        whitened.append(scipy.linalg.solve_triangular(root, toeplitz, lower=True).ravel())
    rows = np.array(whitened)
    return np.asarray(rows @ rows.T, dtype=np.float64)


def agrees_in_time(bound: Bound) -> bool:
    """End effects are the same for two lengths: the difference is what the samples in between tell."""
    longer, shorter = 70, 50
    slow = uncertainty_of(PLANT, in_the_time_domain(longer) - in_the_time_domain(shorter))
    found = bound(PLANT, COLOURED, longer - shorter)
    same = np.allclose(found.markov(8), slow.markov(8), rtol=1e-4) and np.allclose(found.poles(), slow.poles(), rtol=1e-4)
    return bool(same and np.allclose(found.transfer([0.5, 2.0]), slow.transfer([0.5, 2.0]), rtol=1e-4))


def agrees_with_likelihood(bound: Bound) -> bool:
    """One state, one input, white noise: the spread of the exact maximum likelihood over 250 records, and its mean square."""
    truth, samples, records, deviation = np.array([0.7, 1.0, 0.4]), 400, 250, 0.3
    rng = np.random.default_rng(7)
    estimates = np.empty((records, 3))

    def response(theta: Array, u: Array) -> Array:
        return np.asarray(scipy.signal.lfilter([theta[2], theta[1] - theta[0] * theta[2]], [1.0, -theta[0]], u))

    for k in range(records):
        u = rng.standard_normal(samples)
        y = response(truth, u) + deviation * rng.standard_normal(samples)
        estimates[k] = scipy.optimize.leastsq(lambda theta, y=y, u=u: y - response(theta, u), truth)[0]
    model = StateSpaceModel([[truth[0]]], [[truth[1]]], [[1.0]], [[truth[2]]])
    found = bound(model, Spectra(white([[1.0]]), white([[deviation**2]])), samples)
    stated = np.array([found.poles()[0].real, found.markov(2)[1, 0, 0], found.markov(2)[0, 0, 0]])
    # The mean square of 250 standard normal numbers has the deviation 0.09: these are four.
    return bool(np.all(np.abs(np.mean(((estimates - truth) / stated) ** 2, axis=0) - 1) < 0.36))


def twice_the_information(model: StateSpaceModel, spectra: Spectra, N: int) -> Uncertainty:
    return cramer_rao(model, spectra, 2 * N)


def as_if_white(model: StateSpaceModel, spectra: Spectra, N: int) -> Uncertainty:
    return cramer_rao(model, Spectra(spectra.input, white(spectra.disturbance(np.array([1.0]))[0])), N)


def test_as_in_the_time_domain() -> None:
    assert agrees_in_time(cramer_rao)


@pytest.mark.parametrize("broken", [twice_the_information, as_if_white])
def test_a_broken_bound_is_noticed_in_time(broken: Bound) -> None:
    assert not agrees_in_time(broken)


def test_an_exact_likelihood_attains_it() -> None:
    assert agrees_with_likelihood(cramer_rao)
    assert not agrees_with_likelihood(twice_the_information)


def test_regression_of_a_static_plant_attains_it() -> None:
    empty = np.zeros((0, 0))
    covariance, power = np.array([[2.0, 0.5], [0.5, 1.0]]), np.array([[1.0, 0.3], [0.3, 2.0]])
    model = StateSpaceModel(empty, np.zeros((0, 2)), np.zeros((2, 0)), [[1.0, 2.0], [0.0, -1.0]])
    exact = np.sqrt(np.outer(np.diag(covariance), np.diag(np.linalg.inv(power))) / 50)
    assert np.allclose(cramer_rao(model, Spectra(white(power), white(covariance)), 50).markov(1)[0], exact, rtol=1e-12)


def test_it_falls_with_the_root_of_the_samples_and_not_with_the_basis() -> None:
    one, four = cramer_rao(PLANT, COLOURED, 100), cramer_rao(PLANT, COLOURED, 400)
    assert np.allclose(one.markov(10), 2 * four.markov(10), rtol=1e-9)
    W = np.array([[1.0, 3.0], [-1.0, 0.5]])
    turned = StateSpaceModel(np.linalg.solve(W, PLANT.A @ W), np.linalg.solve(W, PLANT.B), PLANT.C @ W, PLANT.D)
    assert np.allclose(cramer_rao(turned, COLOURED, 100).markov(10), one.markov(10), rtol=1e-6)
    assert np.allclose(cramer_rao(turned, COLOURED, 100).poles(), one.poles(), rtol=1e-6)


def test_more_disturbance_or_less_input_never_helps() -> None:
    louder = Spectra(COLOURED.input, total(COLOURED.disturbance, white(0.1 * np.eye(2))))
    assert np.all(cramer_rao(PLANT, louder, 100).markov(10) >= cramer_rao(PLANT, COLOURED, 100).markov(10))
    assert np.all(
        cramer_rao(PLANT, Spectra(white([[0.1]]), louder.disturbance), 100).markov(10) > cramer_rao(PLANT, louder, 100).markov(10)
    )


def test_the_gauge_is_what_no_data_tell() -> None:
    angles = np.linspace(0.1, 3, 50)
    reduction = Reduction(angles, np.zeros((50, 2, 1), complex), inverse(COLOURED.disturbance(angles)), COLOURED.input(angles), 10)
    values = np.linalg.eigvalsh(reduction.information(system_matrix(PLANT), 2))
    across = off_gauge(system_matrix(PLANT), 2)
    assert np.all(np.abs(values[:4]) < 1e-10 * values[-1]) and values[4] > 1e-6 * values[-1]
    inner = np.linalg.eigvalsh(across.T @ reduction.information(system_matrix(PLANT), 2) @ across)
    assert np.allclose(inner, values[4:], rtol=1e-6)


def test_a_pole_near_the_circle_takes_as_many_angles_as_it_needs(monkeypatch: pytest.MonkeyPatch) -> None:
    near = StateSpaceModel([[0.999]], [[1.0]], [[1.0]], [[0.0]])
    spectra = Spectra(white([[1.0]]), white([[1.0]]))
    # J of the pole is N times the integral of |z / (z - a)^2|^2 = (1 + a^2) / (1 - a^2)^3, with D known; not known adds nothing at 1e-3.
    a = 0.999
    alone = np.sqrt((1 - a**2) ** 3 / (1 + a**2) / 1000)
    found = cramer_rao(near, spectra, 1000).poles()[0].real
    assert alone <= found < 2.5 * alone
    monkeypatch.setattr(information_bound, "FINE", 64)
    assert not np.isclose(cramer_rao(near, spectra, 1000).poles()[0].real, found, rtol=0.05)


def test_the_truth_has_no_error_and_one_deviation_everywhere_is_one() -> None:
    bound = cramer_rao(PLANT, COLOURED, 100)
    assert relative_error(PLANT, PLANT, bound) == 0
    moved = StateSpaceModel(PLANT.A, PLANT.B, PLANT.C, PLANT.D + np.linalg.norm(bound.markov(20)) / np.sqrt(2))
    assert relative_error(moved, PLANT, bound) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("model", "spectra", "says"),
    [
        (StateSpaceModel([[1.1]], [[1.0]], [[1.0]], [[0.0]]), Spectra(white([[1.0]]), white([[1.0]])), "not stable"),
        (PLANT, Spectra(white([[1.0]]), white(np.zeros((2, 2)))), "no power"),
        (PLANT, Spectra(white([[1.0]]), white([[1.0]])), "shape"),
        (PLANT, Spectra(white(np.eye(2)), white(np.eye(2))), "shape"),
    ],
)
def test_what_has_no_bound_is_refused(model: StateSpaceModel, spectra: Spectra, says: str) -> None:
    with pytest.raises(InvalidData, match=says):
        cramer_rao(model, spectra, 100)
