"""Mistakes in `residual`."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.method.model.models import StateSpaceModel
from tests.numeric.audit.unseen.form import Mutants, careful
from tests.numeric.audit.unseen.systems import free_responses, plant, record
from tests.numeric.audit.unseen.witnesses import refuses, takes_out

RESIDUAL = Mutants("residual")


def noise(N: int, p: int, seed: int) -> Any:
    """Return a white fault in the outputs."""
    return 0.3 * np.random.default_rng(seed).standard_normal((N, p))


PLAIN = record(plant([0.8, -0.4, 0.3], 2, 2, 51), 200, 51, fault=noise(200, 2, 151))
SLOW = record(plant([0.998, 0.5], 1, 1, 54), 600, 54, fault=noise(600, 1, 154))


def without_free(r: Any, A: Any, C: Any) -> Any:
    """Return r less its least-squares fit by free responses."""
    N, p = r.shape
    free = free_responses(A, C, N).reshape(N * p, len(A))
    return r - (free @ np.linalg.lstsq(free, r.reshape(-1), rcond=None)[0]).reshape(N, p)


def forced(u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """Return the response from rest."""
    return StateSpaceModel(A, B, C, D).simulate(u)


@RESIDUAL.broken("models with D", takes_out(PLAIN))
def leaves_the_direct_response(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """D is left out of the simulation."""
    return reference.residual(y, u, A, B, C, np.zeros_like(D))


@RESIDUAL.broken("poles so slow that the response outlives the truncation", takes_out(SLOW))
@careful(reference.residual)
def truncates_the_impulse_response(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The response is a convolution with the first 200 Markov parameters."""
    pulse = np.asarray(StateSpaceModel(A, B, C, D).markov(200))
    response = sum(np.vstack([np.zeros((k, len(C))), u[: len(u) - k] @ pulse[k].T]) for k in range(min(200, len(u))))
    return without_free(y - response, A, C)


@RESIDUAL.broken(
    "slow poles, where the record nearly fills a power of two",
    takes_out(record(plant([0.97, 0.5], 1, 1, 58), 255, 58, fault=noise(255, 1, 158))),
)
@careful(reference.residual)
def wraps_the_convolution_around(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The convolution is by FFT of a length that is the next power of two of N in place of 2 N."""
    N = len(u)
    size = 1 << (N - 1).bit_length()
    pulse = np.fft.rfft(np.asarray(StateSpaceModel(A, B, C, D).markov(N)), size, axis=0)
    response = np.fft.irfft(np.einsum("kij,kj->ki", pulse, np.fft.rfft(u, size, axis=0)), size, axis=0)[:N]
    return without_free(y - response, A, C)


@RESIDUAL.broken(
    "states that grow beyond a thousand: integrators, unstable models", takes_out(record(plant([1.0, 0.5], 1, 2, 64), 400, 64, offset=50.0))
)
@careful(reference.residual)
def saturates_the_states(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """States are held between plus and minus a thousand, so that no overflow stops the program."""
    x, r = np.zeros(len(A)), np.zeros_like(y)
    for k in range(len(y)):
        r[k] = y[k] - C @ x - D @ u[k]
        x = np.clip(A @ x + B @ u[k], -1e3, 1e3)
    return r


@RESIDUAL.broken(
    "a model without states",
    takes_out(
        record(StateSpaceModel(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((2, 0)), [[1.0], [2.0]]), 50, 60, fault=noise(50, 2, 160))
    ),
)
def needs_a_state(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The largest eigenvalue of A is asked for, which a model without states has not."""
    np.max(np.abs(np.linalg.eigvals(A)))
    return reference.residual(y, u, A, B, C, D)


@RESIDUAL.broken("small units", takes_out(record(plant([0.8], 1, 1, 62), 100, 62, units=1e-9, fault=noise(100, 1, 162))))
def rounds_small_residuals_to_zero(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """Entries below 1e-10 are called rounding, whatever the units."""
    r = reference.residual(y, u, A, B, C, D)
    return np.where(np.abs(r) < 1e-10, 0.0, r)


@RESIDUAL.broken(
    "two outputs against a model of one",
    refuses(np.ones((50, 2)), np.ones((50, 1)), np.array([[0.5]]), np.array([[1.0]]), np.array([[1.0]]), np.array([[0.0]])),
)
def broadcasts_one_output_over_all(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The response of a model with one output is subtracted from every column of y."""
    if len(C) == 1 and y.shape[1] > 1:
        return y - forced(u, A, B, C, D)
    return reference.residual(y, u, A, B, C, D)
