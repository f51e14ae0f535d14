"""This bounds how far rounding carries the residual and the fault signal from the exact ones, to first order.

The exact model may be given by rational matrices of which the floats are the correct roundings: entries wrong by u = 2^-53, like the data.

    simulation_error        what simulation loses, |x| given (`state_norm`). An error d(k) of the state's recursion reaches the output by
                            sum |C A^k| = gain, so that |dr| <= (|dC| + gain |dA|) |x| + (gain |dB| + |dD|) |u| + u |y|
    fitted_state_error      |r - exact r|, x0 fitted: r is e = y - T u less its projection on Phi = O_N, so that
                            |dr| <= |de| + |dPhi| (|theta| + |r| / sigma_min(Phi))                        [GVL13, section 5.3]
    fault_signal_error      |v - exact v| on the trusted samples <= |W| |r - exact r that v explains|, W their rows of [O_N T_N]^+: the
                            float v explains its own simulated residual exactly, whatever the way it was found

Norms are Frobenius norms over all samples and channels, in the units of the data. Backward errors are those of `conditioning`.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ...base.arrays import Array
from ..method.model.compression import EPS
from ..method.model.models import BLOCK, StateSpaceModel, observability_matrix
from ..method.signal.reconstruction import Reconstruction
from .conditioning import SMALL, UNIT, reflections_error

DETERMINED = 1e-10  # of the largest singular value of [O_N T_N]: below it a direction is one that no sample shows


def _norm(matrix: Any) -> float:
    return float(np.linalg.norm(matrix))


def _gain(model: StateSpaceModel, samples: int) -> float:
    """Return sum |C A^k| over the record."""
    blocks = observability_matrix(model.A, model.C, samples).reshape(samples, model.p, model.n)
    return float(np.sum(np.linalg.norm(blocks, axis=(1, 2))))


def state_norm(model: StateSpaceModel, u: Array, x0: Array) -> float:
    """Return |x| over the record."""
    return _norm(StateSpaceModel(model.A, model.B, np.eye(model.n), np.zeros((model.n, model.n_u))).simulate(u, x0))


def _arithmetic(model: StateSpaceModel) -> float:
    """Return the relative error of each matrix that stands for its rounding, a Schur form's, and sums over a block of samples."""
    return (1 + BLOCK * (model.n_u + model.n)) * UNIT + SMALL * model.n * EPS


def simulation_error(model: StateSpaceModel, y: Array, u: Array, states: float) -> float:
    """Return the bound on the error of y (N, p) less the response to u (N, n_u), for `states` = |x| over the record."""
    unit, gain = _arithmetic(model), _gain(model, len(u))
    of_states = unit * (_norm(model.C) + gain * _norm(model.A)) * states
    of_inputs = unit * (gain * _norm(model.B) + _norm(model.D)) * _norm(u)
    # y and u themselves are roundings, and so is the last difference.
    return of_states + of_inputs + UNIT * (gain * _norm(model.B) + _norm(model.D)) * _norm(u) + 3 * UNIT * _norm(y)


def fitted_state_error(y: Array, u: Array, model: StateSpaceModel, r: Array) -> float:
    """Return the bound on |r - exact r| for `residual(y, u, model)` with its result `r` (N, p); stable models, full observability."""
    N = len(u)
    zero = np.zeros(model.n)
    error = y - model.simulate(u, zero)
    Phi = observability_matrix(model.A, model.C, N)
    theta = np.linalg.lstsq(Phi, (error - r).ravel(), rcond=None)[0]
    free = _norm(observability_matrix(model.A, np.eye(model.n), N))
    moved = _arithmetic(model) * (_norm(model.C) + _gain(model, N) * _norm(model.A)) * free
    moved += reflections_error(model.n + 1, N * model.p) * _norm(Phi)
    least = float(np.linalg.svd(Phi, compute_uv=False).min(initial=np.inf))  # without states nothing is fitted
    rounded = reflections_error(model.n + 1, N * model.p) * _norm(error)
    return simulation_error(model, y, u, state_norm(model, u, zero)) + rounded + moved * (_norm(theta) + _norm(r) / least)


def fault_signal_error(r: Array, A: Array, F: Array, C: Array, G: Array, found: Reconstruction, *, x0: Array | None = None) -> float:
    """Return the bound on |v - exact v| over the trusted samples of `reconstruct_fault(r, A, F, C, G, x0=x0)`; builds [O_N T_N] in full."""
    N, m, n = len(r), F.shape[1], len(A)
    model = StateSpaceModel(A, F, C, G)
    free = observability_matrix(A, C, N)
    p = len(C)
    pulse = np.vstack([G, (free.reshape(N, p, n)[: N - 1] @ F).reshape(-1, m)])
    T = np.zeros((N * p, N * m))
    for k in range(N):
        T[k * p :, k * m : (k + 1) * m] = pulse[: (N - k) * p]
    known = x0 is not None
    inverse = np.linalg.pinv(T if known else np.hstack([free, T]), rcond=DETERMINED)
    first, last = found.trusted
    rows = inverse[(0 if known else n) :][first * m : last * m]
    amplified = float(np.linalg.norm(rows, 2)) if rows.size else 0.0
    left = _norm(r - found.simulated)
    if x0 is not None:
        left += UNIT * _norm(free) * _norm(x0)
    return amplified * (left + simulation_error(model, r, found.v, _norm(found.x)))
