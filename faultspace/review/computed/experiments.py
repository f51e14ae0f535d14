"""Records in floats of an exact experiment, and what is known of it in floats: shared by the limits and by the bound.

packaged    an experiment that comes with the package
floats      a rational matrix as an array
model       the plant of an experiment without its fault
record      y (N, p) and u (N, n_u), from the stationary state
spectrum    the spectrum of what a filter makes of white noise
"""

from __future__ import annotations

import json
from importlib import resources

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from ...base.arrays import Array
from ...exact.algebra.matrices import Matrix, beside
from ...exact.limits.experiments import Experiment, read_experiment
from ...exact.limits.filters import Filter
from ...numeric.method.model.models import StateSpaceModel
from ...numeric.study.driving_spectra import Spectrum

SETTLING = 500  # samples before a record begins: what is left of x(0) = 0 in these experiments is below rounding


def packaged(name: str) -> Experiment:
    """Return the experiment `example:NAME`."""
    text = resources.files("faultspace").joinpath("examples", f"{name}.json").read_text("utf-8")
    return read_experiment(json.loads(text))


def floats(matrix: Matrix) -> Array:
    """Return each entry of a rational matrix, correctly rounded."""
    return np.array([[int(x.p) / int(x.q) for x in row] for row in matrix.elements()], dtype=np.float64).reshape(matrix.shape)


def model(experiment: Experiment) -> StateSpaceModel:
    """Return A, B, C, D."""
    system = experiment.system
    return StateSpaceModel(floats(system.residual.A), floats(system.B), floats(system.residual.C), floats(system.D))


def record(experiment: Experiment, samples: int, seed: int) -> tuple[Array, Array]:
    """Return (y, u) of so many samples; equal seeds give equal records."""
    draw = np.random.default_rng(seed)
    system, residual = experiment.system, experiment.system.residual
    noise = draw.standard_normal((samples + SETTLING, experiment.u_filter.noise))
    u, v = _filtered(experiment.u_filter, noise), _filtered(experiment.v_filter, noise)
    driven = [floats(beside(M, N)) for M, N in ((system.B, residual.F), (system.D, residual.G))]
    y = StateSpaceModel(floats(residual.A), driven[0], floats(residual.C), driven[1]).simulate(np.hstack([u, v]))
    if experiment.w_filter is not None:
        y = y + _filtered(experiment.w_filter, draw.standard_normal((len(y), experiment.w_filter.noise)))
    return y[SETTLING:], u[SETTLING:]


def spectrum(one: Filter) -> Spectrum:
    """Return the spectrum H H* of what a filter makes of white noise of unit covariance."""
    numerator, denominator = _coefficients(one)

    def values(angles: Array) -> NDArray[np.complex128]:
        lags = np.exp(-1j * np.outer(angles, np.arange(len(numerator))))
        below = np.exp(-1j * np.outer(angles, np.arange(len(denominator)))) @ denominator
        response = np.tensordot(lags, numerator, axes=1) / below[:, None, None]
        return np.asarray(response @ np.conj(np.swapaxes(response, 1, 2)))

    return values


def _filtered(one: Filter, noise: Array) -> Array:
    numerator, denominator = _coefficients(one)
    result = np.zeros((len(noise), one.channels))
    for i in range(one.channels):
        for j in range(one.noise):
            result[:, i] += lfilter(numerator[:, i, j], denominator, noise[:, j])
    return result


def _coefficients(one: Filter) -> tuple[Array, Array]:
    return np.array([floats(block) for block in one.numerator]), np.array([int(d.p) / int(d.q) for d in one.denominator])
