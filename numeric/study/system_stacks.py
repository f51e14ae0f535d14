"""Many systems of the study are drawn at once, as arrays with one system after the other along the first axis.

    SystemStack     A, B, C, D, F, G, zeros and fault spaces of systems with the same number of zeros
    study_systems   the systems that `study_system` makes of these seeds, each from its own seed

One call of LAPACK for a matrix of five rows takes less time than Python takes to make it, so that a stack is drawn in a third of the time
of its systems. The steps are those of `systems`, on the same numbers, so that systems are the same up to rounding. Only
the check that there are no other zeros is another one: eigenvalues and eigenvectors of the compressed pencil in place of singular values at
each eigenvalue. It accepts what is far from doubt, and whatever it does not accept is drawn anew by `study_system`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from ...base.arrays import Array
from .random_systems import DIRECTIONS, INTERSECTION_BASIS, N_U, N_V, N_X, P, companion, draw_poles, study_system

EPS = float(np.finfo(np.float64).eps)
# A column of the compressed pencil's kernel leaves this or less of the outputs left out at a zero, and this or more elsewhere. Zeros have
# 1e-12 and others some 0.1; what lies between is for `study_system` to decide.
AT_A_ZERO, ELSEWHERE = 1e-10, 1e-5
# Zeros are where they were planted within this, they lie this far apart, and G is better conditioned than this: all are stricter by orders
# of magnitude than what `study_system` asks.
PLACE, APART, CONDITION = 1e-8, 1e-2, 1e6


@dataclass(frozen=True, eq=False)
class SystemStack:
    """k systems as `StudySystem` has them: A (k, n, n), B (k, n, n_u), C (k, p, n), D (k, p, n_u), F (k, n, n_v), G (k, p, n_v),
    `zeros` (k, z) in ascending order, Z (k, n + p, n_v + z)."""

    A: Array
    B: Array
    C: Array
    D: Array
    F: Array
    G: Array
    zeros: Array
    Z: Array


def study_systems(n_zeros: int, seeds: Sequence[np.random.SeedSequence]) -> SystemStack:
    """Return the systems of `study_system(n_zeros, seed)` for each seed. Raises as that."""
    generators = [np.random.default_rng(seed) for seed in seeds]
    A = np.array([companion(draw_poles(rng)) for rng in generators])
    widths = N_X * N_U, P * N_U, P * P, len(DIRECTIONS[n_zeros])
    normal = np.array([rng.standard_normal(sum(widths)) for rng in generators])
    b, d, mixing, zeros = np.split(normal, np.cumsum(widths)[:-1], axis=1)
    B, D = b.reshape(-1, N_X, N_U), d.reshape(-1, P, N_U)
    C = np.zeros((len(A), P, N_X))
    C[:, :, :P] = np.linalg.qr(mixing.reshape(-1, P, P))[0]
    F, G, W, sure = _with_zeros(A, C, zeros, n_zeros, generators)
    if n_zeros > zeros.shape[1]:
        third, state = _third_zeros(A, F, C, G, zeros)
        zeros, W = np.column_stack([zeros, third]), np.concatenate([W, state[:, :, np.newaxis]], axis=2)
        F[:, :, 0] *= INTERSECTION_BASIS
        G[:, :, 0] *= INTERSECTION_BASIS
    zeros = np.sort(zeros, axis=1)
    sure &= _as_planted(A, F, C, G, zeros)
    stack = SystemStack(A, B, C, D, F, G, zeros, _fault_spaces(F, G, W))
    for i in np.flatnonzero(~sure).tolist():
        single = study_system(n_zeros, seeds[i])
        parts = {name: getattr(single.model, name) for name in "ABCD"} | {name: getattr(single, name) for name in ("F", "G", "zeros", "Z")}
        for field in fields(stack):
            getattr(stack, field.name)[i] = parts[field.name]
    return stack


def _with_zeros(
    A: Array, C: Array, zeros: Array, n_zeros: int, generators: Sequence[np.random.Generator]
) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """Return F, G, W of `with_zeros` for each system, and which of them have as many solutions as expected."""
    k, n, p = len(A), N_X, P
    directions = DIRECTIONS[n_zeros]
    count, height = len(directions), (n + p) * N_V
    if not count:
        columns = np.array([rng.standard_normal(height) for rng in generators]).reshape(k, N_V, n + p).swapaxes(1, 2)
        return columns[:, :n].copy(), columns[:, n:].copy(), np.zeros((k, n, 0)), np.ones(k, dtype=bool)
    equations = np.zeros((k, count, n + p, height + n * count))
    for i, column in enumerate(directions):
        equations[:, i, :, (n + p) * column : (n + p) * (column + 1)] = np.eye(n + p)
        states = equations[:, i, :, height + n * i : height + n * (i + 1)]
        states[:, :n] = A - zeros[:, i, np.newaxis, np.newaxis] * np.eye(n)
        states[:, n:] = C
    rank = count * (n + p)
    _, values, right = np.linalg.svd(equations.reshape(k, rank, -1))
    sure = values[:, -1] > equations.shape[-1] * count * EPS * values[:, 0]
    solutions = right[:, rank:].swapaxes(1, 2)
    basis, sizes, turned = np.linalg.svd(solutions[:, :height], full_matrices=False)
    sure &= sizes[:, -1] > 1e-8 * sizes[:, 0]
    rows = np.ascontiguousarray(basis.swapaxes(1, 2))
    draws = rows @ np.array([rng.standard_normal(height) for rng in generators])[:, :, np.newaxis]
    columns = (basis @ draws).reshape(k, N_V, n + p).swapaxes(1, 2)
    coefficients = turned.swapaxes(1, 2) @ (draws / np.maximum(sizes, EPS)[:, :, np.newaxis])
    states = (solutions[:, height:] @ coefficients).reshape(k, count, n).swapaxes(1, 2)
    return columns[:, :n].copy(), columns[:, n:].copy(), states, np.asarray(sure)


def _third_zeros(A: Array, F: Array, C: Array, G: Array, zeros: Array) -> tuple[Array, Array]:
    """Return the zeros (k,) that follow from two planted in the first fault, and their states (k, n)."""
    f, g = F[:, :, 0], G[:, :, 0]
    third = -f[:, 2] / f[:, 1] + A[:, -1, -1] - zeros.sum(axis=1)
    pencil = np.zeros((len(A), N_X + P, N_X + 1))
    pencil[:, :N_X, :N_X] = A - third[:, np.newaxis, np.newaxis] * np.eye(N_X)
    pencil[:, N_X:, :N_X] = C
    pencil[:, :N_X, N_X], pencil[:, N_X:, N_X] = f, g
    return third, np.asarray(np.linalg.svd(pencil)[2][:, -1, :N_X])


def _as_planted(A: Array, F: Array, C: Array, G: Array, zeros: Array) -> NDArray[np.bool_]:
    """Say which systems (k,) have these zeros (k, z), in ascending order, and surely no others, none at infinity either."""
    sizes = np.linalg.svd(G, compute_uv=False)
    sure = sizes[:, 0] < CONDITION * sizes[:, -1]
    if zeros.shape[1] > 1:
        sure &= np.min(np.diff(zeros, axis=1), axis=1) > APART
    whole = np.sqrt(sum(np.sum(each**2, axis=(1, 2)) for each in (A, F, C, G)))[:, np.newaxis]
    rng = np.random.default_rng(0)
    for _ in range(2):  # two compressions, as in `pencil_zeros`
        mix = np.linalg.qr(rng.standard_normal((P, P)))[0]
        try:
            gain = np.linalg.solve(mix[:N_V] @ G, mix[:N_V] @ C)
        except np.linalg.LinAlgError:  # some system has no compression: all of them are for `study_system`
            return np.zeros(len(A), dtype=bool)
        found, states = np.linalg.eig(A - F @ gain)
        left = np.linalg.norm((mix[N_V:] @ (C - G @ gain)) @ states, axis=1)
        left /= np.sqrt(1 + np.sum(np.abs(gain @ states) ** 2, axis=1)) * (whole + np.abs(found))
        at_zero = left < AT_A_ZERO
        sure &= np.all(at_zero | (left > ELSEWHERE), axis=1) & (at_zero.sum(axis=1) == zeros.shape[1])
        places = np.sort(np.where(at_zero, found.real, np.inf), axis=1)[:, : zeros.shape[1]]
        sure &= np.all(np.abs(places - zeros) < PLACE * np.maximum(1, np.abs(zeros)), axis=1)
        sure &= np.all(~at_zero | (np.abs(found.imag) < PLACE * np.maximum(1, np.abs(found))), axis=1)
    return np.asarray(sure)


def _fault_spaces(F: Array, G: Array, W: Array) -> Array:
    """Return orthonormal bases (k, n + p, n_v + z) of the spaces of `StudySystem.Z`."""
    k, _, count = W.shape
    columns = np.zeros((k, N_X + P, N_V + count))
    columns[:, :N_X, :N_V], columns[:, N_X:, :N_V] = F, G
    columns[:, :N_X, N_V:] = W / np.linalg.norm(W, axis=1, keepdims=True)
    return np.asarray(np.linalg.qr(columns)[0])
