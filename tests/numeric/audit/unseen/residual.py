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
ONE = record(plant([0.8, -0.4], 1, 1, 52), 200, 52, fault=noise(200, 1, 152))
RINGING = record(plant([0.6 + 0.5j], 1, 2, 53), 150, 53, fault=noise(150, 2, 153))
SLOW = record(plant([0.998, 0.5], 1, 1, 54), 600, 54, fault=noise(600, 1, 154))
LONG = record(plant([0.9, 0.5], 1, 2, 55), 1500, 55, fault=noise(1500, 2, 155))
UNSTABLE = record(plant([1.25, 0.5], 1, 2, 56), 100, 56, x0=1e-4)
CLUSTER = record(plant([0.9, 0.85, 0.8, 0.75, 0.7, 0.6, 0.5, 0.4], 1, 1, 57), 200, 57, fault=noise(200, 1, 157))


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


@RESIDUAL.broken("as many inputs as outputs, D not symmetric", takes_out(PLAIN))
def multiplies_D_from_the_wrong_side(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The direct response is u D in place of u D', where the shapes allow it."""
    return reference.residual(y, u, A, B, C, D.T if D.shape[0] == D.shape[1] else D)


@RESIDUAL.broken("A not symmetric", takes_out(PLAIN))
def steps_with_the_transpose(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """States are rows and are multiplied by A in place of A'."""
    return reference.residual(y, u, A.T, B, C, D)


@RESIDUAL.broken("models with D, inputs that are not constant", takes_out(ONE))
def delays_the_direct_response(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The output equation is evaluated after the state has stepped: y(k) has D u(k - 1)."""
    late = np.vstack([np.zeros((1, u.shape[1])), u[:-1]])
    return reference.residual(y - late @ D.T, u, A, B, C, np.zeros_like(D))


@RESIDUAL.broken("two outputs and more under a fault: the free responses taken out belong to different states", takes_out(PLAIN))
@careful(reference.residual)
def fits_an_initial_state_to_each_output(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """Outputs are treated one by one, each with an initial state of its own."""
    left = y - forced(u, A, B, C, D)
    return np.hstack([without_free(left[:, i : i + 1], A, C[i : i + 1]) for i in range(len(C))])


@RESIDUAL.broken("all records under a fault with a mean", takes_out(ONE))
def removes_the_mean(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The residual has its mean taken off, as if it were noise."""
    r = reference.residual(y, u, A, B, C, D)
    return r - r.mean(axis=0)


@RESIDUAL.broken("faults of any size but that which makes unit variance", takes_out(ONE))
def normalises(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The residual is divided by its deviation and is in units of nothing."""
    r = reference.residual(y, u, A, B, C, D)
    return r / np.std(r, axis=0)


@RESIDUAL.broken("complex poles", takes_out(RINGING))
def simulates_the_real_parts_of_the_modes(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The modal form is simulated with the real parts of its matrices."""
    poles, V = np.linalg.eig(A)
    back = np.linalg.inv(V)
    return reference.residual(y, u, np.diag(poles).real, (back @ B).real, (C @ V).real, D)


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


@RESIDUAL.broken("records of more than 1000 samples", takes_out(LONG))
def loses_the_state_between_pieces(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """Long records are simulated in pieces of 1000 samples, each from a fitted state of its own."""
    pieces = [slice(k, k + 1000) for k in range(0, len(y), 1000)]
    return np.vstack([reference.residual(y[one], u[one], A, B, C, D) for one in pieces])


@RESIDUAL.broken("records whose last sample is seen: all", takes_out(ONE))
def leaves_out_the_last_sample(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The loop ends a sample early and the last row stays zero."""
    r = reference.residual(y, u, A, B, C, D).copy()
    r[-1] = 0.0
    return r


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


@RESIDUAL.broken("unstable models", takes_out(UNSTABLE, 1e-6))
def refuses_unstable_models(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """A model with a pole outside the unit circle is refused."""
    if np.max(np.abs(np.linalg.eigvals(A)), initial=0.0) > 1:
        raise ValueError("unstable model")
    return reference.residual(y, u, A, B, C, D)


@RESIDUAL.broken(
    "records that do not begin at rest, poles that last: the transient stays in half of the outputs",
    takes_out(record(plant([0.95, 0.5], 1, 2, 59), 200, 59, x0=5.0, fault=noise(200, 2, 159))),
)
@careful(reference.residual)
def fits_the_state_to_the_first_output(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The free response is taken off the first output alone, since the others were thought to follow."""
    left = y - forced(u, A, B, C, D)
    left[:, :1] = without_free(left[:, :1], A, C[:1])
    return left


@RESIDUAL.broken("eight states or more with poles close together", takes_out(CLUSTER, 1e-6))
@careful(reference.residual)
def filters_with_polynomials(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The response is that of the transfer function in coefficients rounded to single precision."""
    a = np.poly(A).astype(np.float32).astype(float)
    n, r = len(A), y.copy()
    for out in range(len(C)):
        for j in range(u.shape[1]):
            pulse = np.asarray(StateSpaceModel(A, B[:, j : j + 1], C[out : out + 1], D[out : out + 1, j : j + 1]).markov(n + 1))[:, 0, 0]
            b = np.convolve(a, pulse)[: n + 1]
            response = np.zeros(len(u))
            for k in range(len(u)):
                past = range(min(k, n) + 1)
                response[k] = sum(b[i] * u[k - i, j] for i in past) - sum(a[i] * response[k - i] for i in past if i)
            r[:, out] -= response
    return without_free(r, A, C)


@RESIDUAL.broken("all records, by about the accuracy of float32", takes_out(PLAIN))
def keeps_the_states_in_single_precision(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """Inputs and B are single precision in the simulation."""
    return reference.residual(y, u.astype(np.float32).astype(float), A, B.astype(np.float32).astype(float), C, D)


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


@RESIDUAL.broken(
    "outputs above a thousand in their units", takes_out(record(plant([0.8], 1, 1, 61), 100, 61, units=1e6, fault=noise(100, 1, 161)))
)
def clips_outliers(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The residual is limited to plus and minus a thousand."""
    return np.clip(reference.residual(y, u, A, B, C, D), -1e3, 1e3)


@RESIDUAL.broken("small units", takes_out(record(plant([0.8], 1, 1, 62), 100, 62, units=1e-9, fault=noise(100, 1, 162))))
def rounds_small_residuals_to_zero(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """Entries below 1e-10 are called rounding, whatever the units."""
    r = reference.residual(y, u, A, B, C, D)
    return np.where(np.abs(r) < 1e-10, 0.0, r)


@RESIDUAL.broken(
    "faults that last to the end of the record: fitted states carry part of them",
    takes_out(record(plant([0.9, 0.5], 1, 2, 63), 120, 63, fault=noise(120, 2, 163))),
)
@careful(reference.residual)
def estimates_the_state_by_an_observer(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The predictor of a Kalman filter is subtracted in place of the response of the model: its innovations have other fault directions."""
    x, r = np.zeros(len(A)), np.zeros_like(y)
    gain = 0.5 * A @ np.linalg.pinv(C)
    for k in range(len(y)):
        r[k] = y[k] - C @ x - D @ u[k]
        x = A @ x + B @ u[k] + gain @ r[k]
    return r


@RESIDUAL.broken(
    "two outputs against a model of one",
    refuses(np.ones((50, 2)), np.ones((50, 1)), np.array([[0.5]]), np.array([[1.0]]), np.array([[1.0]]), np.array([[0.0]])),
)
def broadcasts_one_output_over_all(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The response of a model with one output is subtracted from every column of y."""
    if len(C) == 1 and y.shape[1] > 1:
        return y - forced(u, A, B, C, D)
    return reference.residual(y, u, A, B, C, D)


@RESIDUAL.broken(
    "inputs with a NaN",
    refuses(ONE.y, np.where(np.arange(200)[:, None] == 7, np.nan, ONE.u), *(getattr(ONE.model, name) for name in "ABCD")),
)
def holds_the_last_input_over_gaps(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """A NaN in u is replaced by the sample before."""
    u = u.copy()
    for k in range(1, len(u)):
        u[k] = np.where(np.isnan(u[k]), u[k - 1], u[k])
    return reference.residual(y, u, A, B, C, D)


@RESIDUAL.broken("u with more samples than y", refuses(ONE.y[:-3], ONE.u, *(getattr(ONE.model, name) for name in "ABCD")))
def takes_as_many_inputs_as_outputs(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """Where u is longer than y its end is left out without a word."""
    return reference.residual(y, u[: len(y)], A, B, C, D)
