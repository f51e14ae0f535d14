"""Find where a weighted reduction starts: A and C by subspaces, from the data's windows and from an ARX model's Markov parameters.

    PI-MOESP [V93] on windows of the ARX factor: all of them, and half as long
    realisation [HK66, K78] of the ARX plant, plain, and under the weight of the noise model's Toeplitz matrix

No single one is near the minimum in all data: PI-MOESP suffers from few instruments or an unlucky colour of the input, the realisation from
the noise of high lags. B and D follow linearly.

starts          system matrices T with a stable A, one a method that gives one
realisations    those of them that need the ARX model alone
one_state_less  system matrices out of one with a state more
hankel_factors  the realisation's singular vectors and values
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
from scipy.linalg import block_diag

from ....base.arrays import Array
from ....base.errors import InvalidData
from .arx import Arx
from .arx_windows import ArxWindows, past_input_compression
from .past_inputs import pi_moesp_from_compression
from .weighted_reduction import Reduction

MARGIN = 1e-3  # distance from the unit circle at which a reflected pole is left


def starts(windows: ArxWindows, arx: Arx, problem: Reduction, n: int) -> Iterator[Array]:
    """Yield system matrices (n + p, n + n_u) in the units of the ARX model; for n = 0 the one with the best D."""
    p, n_u = windows.p, windows.n_u
    if n == 0:
        yield problem.input_matrices(np.zeros((0, 0)), np.zeros((p, 0)))
        return
    least = max(-(-n // p) + 1, -(-n // n_u))
    half = (windows.lags + 1) // 2
    yield from _completed((_by_past_inputs(windows, n, rows) for rows in (half, half // 2) if rows >= least), problem)
    yield from realisations(arx, problem, n, windows.lags)


def realisations(arx: Arx, problem: Reduction, n: int, lags: int) -> Iterator[Array]:
    """Yield system matrices out of the ARX model alone, for n > 0, from Hankel matrices of half the `lags` and of all."""
    p, n_u = problem.plant.shape[1:]
    least = max(-(-n // p) + 1, -(-n // n_u))
    sizes = (max((lags + 1) // 2, least), max(lags, least))
    yield from _completed((_realised(arx, n, rows, weighted) for rows in sizes for weighted in (False, True)), problem)


def _completed(pairs: Iterable[tuple[Array, Array] | None], problem: Reduction) -> Iterator[Array]:
    """Yield system matrices of those A and C that there are, with stable A and the best B and D."""
    for pair in pairs:
        if pair is not None and np.all(np.isfinite(pair[0])) and np.all(np.isfinite(pair[1])):
            yield problem.input_matrices(_reflected(pair[0]), pair[1])


def one_state_less(matrix: Array, n: int, problem: Reduction) -> Iterator[Array]:
    """Yield system matrices with n - 1 states out of one with n: without a real pole, or with a pair made one, and with the best B and D.

    Descent is easier with a state to spare: all modes of the plant are then there, and one that is not.
    """
    A, C = matrix[:n, :n], matrix[n:, :n]
    values, vectors = np.linalg.eig(A)
    blocks = [(value, vector) for value, vector in zip(values, vectors.T, strict=True) if value.imag >= 0]
    for left_out in range(len(blocks)):
        states, outputs = [], []
        for number, (value, vector) in enumerate(blocks):
            seen, pair = C @ vector, value.imag > 0
            if number != left_out and pair:
                states.append(np.array([[value.real, value.imag], [-value.imag, value.real]]))
                outputs += [seen.real, seen.imag]
            elif number != left_out or pair:
                states.append(np.array([[value.real]]))
                outputs.append(seen.real)
        shorter = np.array(outputs).T.reshape(len(C), n - 1)
        yield problem.input_matrices(block_diag(*states) if states else np.zeros((0, 0)), shorter)


def _by_past_inputs(windows: ArxWindows, n: int, rows: int) -> tuple[Array, Array] | None:
    try:
        model = pi_moesp_from_compression(past_input_compression(windows, rows, rows), order=n).model
    except InvalidData:
        return None
    return model.A, model.C


def hankel_factors(arx: Arx, rows: int, weighted: bool) -> tuple[Array, Array, Array]:
    """Return the weight V and the factors U, S of the singular value decomposition V^-1 H = U S ...

    H is the block Hankel matrix (rows p, rows n_u) of the ARX plant's Markov parameters, V the Toeplitz matrix of the noise model, or I.
    """
    plant, noise = arx.markov(2 * rows)
    p, n_u = plant.shape[1:]
    numbers = np.arange(rows)
    hankel = plant[1 + np.add.outer(numbers, numbers)].transpose(0, 2, 1, 3).reshape(rows * p, rows * n_u)
    colour = np.eye(rows * p)
    if weighted:
        lags = np.subtract.outer(numbers, numbers)
        blocks = np.where((lags >= 0)[:, :, None, None], noise[np.maximum(lags, 0)], 0.0)
        colour = blocks.transpose(0, 2, 1, 3).reshape(rows * p, rows * p)
    left, values, _ = np.linalg.svd(np.linalg.solve(colour, hankel), full_matrices=False)
    return colour, left, values


def _realised(arx: Arx, n: int, rows: int, weighted: bool) -> tuple[Array, Array] | None:
    try:
        colour, left, values = hankel_factors(arx, rows, weighted)
    except np.linalg.LinAlgError:
        return None
    p = len(arx.covariance)
    observability = colour @ (left[:, :n] * np.sqrt(values[:n]))
    A = np.asarray(np.linalg.lstsq(observability[:-p], observability[p:], rcond=None)[0], dtype=np.float64)
    return A, observability[:p]


def _reflected(A: Array) -> Array:
    """Return A with the poles outside the unit circle reflected into it, which keeps |det(z I - A)| on the circle but for a constant."""
    values, vectors = np.linalg.eig(A)
    sizes = np.abs(values)
    if np.all(sizes < 1):
        return A
    moved = np.where(sizes >= 1, values / sizes * np.minimum(1 / np.maximum(sizes, 1.0), 1 - MARGIN), values)
    try:
        return np.asarray((vectors * moved @ np.linalg.inv(vectors)).real, dtype=np.float64)
    except np.linalg.LinAlgError:
        return np.asarray(A / sizes.max() * (1 - MARGIN), dtype=np.float64)
