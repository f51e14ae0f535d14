"""Run the parametric bootstrap of kernel rows: make records of the same system with other noise, from the rows alone.

Of all noise that the rows admit, N_y w = N [y; u], the least is taken away from y. What is left obeys the rows exactly: it is a record that
a system of these rows could have made without noise, whatever its faults. New noise of the estimated spectrum and shares added, it is
what the record could have been, and every statistic can be asked how it is distributed where the rows are laws [ET93].

The mean of a likelihood ratio over such records, beside the degrees of freedom that it should have, is what it is divided by to have the
law that is stated [B37]; so a few records do, where quantiles would ask for hundreds. What is left of y holds the faults and the noise in
their directions, so that a fault fainter than the noise is not as faint in these records.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

from ....base.arrays import Array
from ..space.basis import KernelBasis
from .joint import JointMoments
from .remainder import remainder, whitened

# Share of its diagonal that keeps the normal equations regular where N_y has zeros on the unit circle.
RIDGE = 1e-12


def least_noise(rows: Sequence[Array], z: Array, shares: Array) -> Array:
    """Return w (N, p) for rows (eta_i + 1, p + n_u), z (N, p + n_u) = [y, u] and shares (p,), all in the same units."""
    N, p = len(z), len(shares)
    banded = [scipy.sparse.hstack([_convolution(row[:, c], N) for c in range(p)]) for row in rows]
    left = [sum((z[j : N - len(row) + 1 + j] @ row[j] for j in range(1, len(row))), z[: N - len(row) + 1] @ row[0]) for row in rows]
    # In order of time, so that the normal equations are banded.
    order = np.argsort(np.concatenate([np.arange(len(e)) for e in left]), kind="stable")
    M = scipy.sparse.vstack(banded).tocsr()[order]
    weights = np.repeat(shares, N)
    gram = (M.multiply(weights) @ M.T).tocsc()
    gram = gram + RIDGE * float(gram.diagonal().mean()) * scipy.sparse.identity(len(order), format="csc")
    multipliers = scipy.sparse.linalg.spsolve(gram, np.concatenate(left)[order], permc_spec="NATURAL")
    return np.asarray((weights * (M.T @ multipliers)).reshape(p, N).T)


def _convolution(coefficients: Array, N: int) -> scipy.sparse.spmatrix:
    """Return the matrix (N - eta, N) that takes a signal to what the polynomial makes of it."""
    eta = len(coefficients) - 1
    diagonals = [np.full(N - eta, value) for value in coefficients]
    return scipy.sparse.diags(diagonals, list(range(eta + 1)), shape=(N - eta, N), format="csr")


def redrawn(y: Array, u: Array, data: JointMoments, fit: KernelBasis, shares: Array, draws: int, seed: int) -> Iterator[Array]:
    """Yield `draws` records (N, p) for the input u, which obey the rows of `fit` but for noise of the spectrum that these leave."""
    scale = data.scale[: data.p]
    z = np.hstack([y, u]) / data.scale
    clean = z[:, : data.p] - least_noise(fit.rows, z, shares)
    E = whitened(remainder(data, fit), shares)
    power = np.maximum(np.einsum("bii->b", E).real / E.shape[1], 0.0)
    random = np.random.default_rng(seed)
    length = 2 * len(y)
    frequencies = np.arange(length // 2 + 1) * 2 * np.pi / length
    size = np.sqrt(np.interp(frequencies, data.moments.angles, power) * length / 2)
    for _ in range(draws):
        parts = random.standard_normal((2, len(size), data.p))
        noise = np.fft.irfft((parts[0] + 1j * parts[1]) * size[:, None], n=length, axis=0)[: len(y)]
        yield (clean + noise * np.sqrt(shares)) * scale
