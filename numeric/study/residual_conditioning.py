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

import numpy as np

from ...base.arrays import Array
from ..method.model.compression import EPS
from ..method.model.models import BLOCK, StateSpaceModel, lower_toeplitz, observability_matrix
from ..method.signal.reconstruction import Reconstruction
from .conditioning import SMALL, UNIT, frobenius, reflections_error, state_norm

DETERMINED = 1e-10  # of the largest singular value of [O_N T_N]: below it a direction is one that no sample shows


def _gain(model: StateSpaceModel, samples: int) -> float:
    """Return sum |C A^k| over the record."""
    blocks = observability_matrix(model.A, model.C, samples).reshape(samples, model.p, model.n)
    return float(np.sum(np.linalg.norm(blocks, axis=(1, 2))))


def _arithmetic(model: StateSpaceModel) -> float:
    """Return the relative error of each matrix that stands for its rounding, a Schur form's, and sums over a block of samples."""
    return (1 + BLOCK * (model.n_u + model.n)) * UNIT + SMALL * model.n * EPS


def simulation_error(model: StateSpaceModel, y: Array, u: Array, states: float) -> float:
    """Return the bound on the error of y (N, p) less the response to u (N, n_u), for `states` = |x| over the record."""
    unit, gain = _arithmetic(model), _gain(model, len(u))
    of_states = unit * (frobenius(model.C) + gain * frobenius(model.A)) * states
    of_inputs = unit * (gain * frobenius(model.B) + frobenius(model.D)) * frobenius(u)
    # y and u themselves are roundings, and so is the last difference.
    return of_states + of_inputs + UNIT * (gain * frobenius(model.B) + frobenius(model.D)) * frobenius(u) + 3 * UNIT * frobenius(y)


def fitted_state_error(y: Array, u: Array, model: StateSpaceModel, r: Array) -> float:
    """Return the bound on |r - exact r| for `residual(y, u, model)` with its result `r` (N, p); stable models, full observability."""
    N = len(u)
    zero = np.zeros(model.n)
    error = y - model.simulate(u, zero)
    Phi = observability_matrix(model.A, model.C, N)
    theta = np.linalg.lstsq(Phi, (error - r).ravel(), rcond=None)[0]
    free = frobenius(observability_matrix(model.A, np.eye(model.n), N))
    moved = _arithmetic(model) * (frobenius(model.C) + _gain(model, N) * frobenius(model.A)) * free
    moved += reflections_error(model.n + 1, N * model.p) * frobenius(Phi)
    least = float(np.linalg.svd(Phi, compute_uv=False).min(initial=np.inf))  # without states nothing is fitted
    rounded = reflections_error(model.n + 1, N * model.p) * frobenius(error)
    return simulation_error(model, y, u, state_norm(model, u, zero)) + rounded + moved * (frobenius(theta) + frobenius(r) / least)


def fault_signal_error(r: Array, A: Array, F: Array, C: Array, G: Array, found: Reconstruction, *, x0: Array | None = None) -> float:
    """Return the bound on |v - exact v| over the trusted samples of `reconstruct_fault(r, A, F, C, G, x0=x0)`; builds [O_N T_N] in full."""
    N, m, n = len(r), F.shape[1], len(A)
    model = StateSpaceModel(A, F, C, G)
    free = observability_matrix(A, C, N)
    T = lower_toeplitz(model.markov(N))
    known = x0 is not None
    inverse = np.linalg.pinv(T if known else np.hstack([free, T]), rcond=DETERMINED)
    first, last = found.trusted
    rows = inverse[(0 if known else n) :][first * m : last * m]
    amplified = float(np.linalg.norm(rows, 2)) if rows.size else 0.0
    left = frobenius(r - found.simulated)
    if x0 is not None:
        left += UNIT * frobenius(free) * frobenius(x0)
    return amplified * (left + simulation_error(model, r, found.v, frobenius(found.x)))
