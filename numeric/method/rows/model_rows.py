"""Begin kernel rows from a model of the system, which says what the inputs and the initial state do, and leaves open what the faults do.

A row [N_y N_u] that annihilates [y; u] of x+ = A x + B u, y = C x + D u without faults has N_y O = 0 and N_u = -N_y T, with O the
observability matrix of its window and T the Toeplitz matrix of its Markov parameters D, CB, CAB, ..  [W91]. The rows that faults leave are
among them: so few coefficients are free that the least combination is found from any start. Where the model is wrong they are a
start, and no more, for rows whose coefficients are all free.

    model_within    for each row the orthonormal vectors that its coefficients may combine
    model_rows      the likeliest rows among them
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ....base.arrays import Array
from ..model.models import StateSpaceModel, observability_matrix
from ..space.basis import ROUGH, KernelBasis, kernel_basis
from .joint import JointMoments

# Turns of colour and rows; what follows has more.
ROUNDS = 1


def model_within(model: StateSpaceModel, degrees: Sequence[int]) -> list[Array]:
    """Return, for each degree eta, (p (eta + 1) - n, (p + n_u) (eta + 1)), in the order of the window of [y; u]."""
    spaces = {eta: _annihilators(model, eta) for eta in set(degrees)}
    return [spaces[eta] for eta in degrees]


def _annihilators(model: StateSpaceModel, eta: int) -> Array:
    p, n_u, n = model.p, model.n_u, model.n
    left = np.linalg.svd(observability_matrix(model.A, model.C, eta + 1))[0][:, n:].T
    markov = model.markov(eta + 1)
    toeplitz = np.block([[markov[i - j] if i >= j else np.zeros((p, n_u)) for j in range(eta + 1)] for i in range(eta + 1)])
    both = np.concatenate([left.reshape(-1, eta + 1, p), (-left @ toeplitz).reshape(-1, eta + 1, n_u)], axis=2)
    return np.asarray(np.linalg.qr(both.reshape(len(left), -1).T)[0].T, dtype=np.float64)


def model_rows(data: JointMoments, model: StateSpaceModel, degrees: Sequence[int], shares: Array | None = None) -> KernelBasis:
    """Fit rows of these degrees that the model, in the units of the moments, admits."""
    moments = data.moments.of_degree(max(degrees))
    return kernel_basis(moments, model_within(model, degrees), rounds=ROUNDS, shares=data.noise(shares), flat=ROUGH)
