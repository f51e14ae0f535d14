"""Compute the Cramer-Rao bound of the fault space, of which the model's error and that of the kernel rows are parts.

y = G u + H v + w with fault transfer H = C (z - A)^-1 F + G_v, faults of spectrum S and noise of spectrum R. Neither S nor the level of the
noise is known, at any frequency. Then the information of N samples is the sum of two parts [W53, SN90],

    of the model       N / (2 pi) integral of  Re tr( Phi^-1 dG P dG* ),                      Phi = H S H* + R, P the input's spectrum
    of the directions  N / (2 pi) integral of  Re tr( (K R K*)^-1 dK  H S H* Phi^-1 H S H*  dK* ),      K(z) H(z) = 0,

K(z) = sum_j K_j z^j the p - n_v kernel rows of the fault transfer. The first comes from the response to the input, the second from the
covariance of what disturbs the outputs, in which the faults have directions but the noise has all; a fault of unknown spectrum tells its
direction only. For loud faults the matrix between dK and dK* is their own spectrum H S H*, as for faults that are no random signals.

The two parts have parameters in common: the rows annihilate the free response, sum_j K_j C A^j = 0, whose derivative

    sum_j (dK_j C + K_j dC + X_(j+1) dA) A^j = 0,      X_j = K_j C + X_(j+1) A,

ties dK to dA and dC. The bound is the inverse of the information on the directions (dA, .., dD, dK) that obey this [GH90, SN98], less the
gauge: changes of the state basis, and q^a K_j added to K_i for a <= eta_i - eta_j, which leaves the span of the rows alone. The degrees
eta_i of the rows, and with them the number of zeros, are known.

fault_space_bound   the bound, as an uncertainty of the space: an angle with a confidence, a distance
FaultSpectra        of the input, the faults and the noise
kernel_rows         the rows of least degrees of a given A, F, C, G
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
import scipy.linalg
from numpy.typing import ArrayLike, NDArray

from ...base.arrays import Array
from ...base.errors import InvalidData
from ...base.sheets import counted
from ...base.threads import one_thread
from ..data.validation import positive
from ..method.model.invariants import half_transfers, off_gauge, system_matrix
from ..method.model.models import StateSpaceModel, lower_toeplitz, observability_matrix
from ..method.model.weighted_reduction import Reduction, circle
from ..method.ranks.sample_windows import ObservedCoordinates, observed_coordinates
from ..method.space.estimate import SpaceUncertainty, kernel_conditions
from ..method.space.space_uncertainty import turned_by_model, turned_by_rows
from .driving_spectra import Spectrum, through
from .information_bound import COARSE, settled, stable

RANK = 1e-8
"""Singular values of columns of unit length that count as zero: exact ones are some 1e-14 of the largest."""


@dataclass(frozen=True)
class FaultSpectra:
    """The bound of a fault space is computed from these spectra of the input, of the faults and of the noise [L99].

    Each is a function of angles (M,) in radians a sample. `input` returns an array of the shape (M, n_u, n_u) in squared units of u,
    `faults` (M, n_v, n_v) and `noise` (M, p, p) in squared units of y; `faultspace.numeric.study.driving_spectra` has functions that
    make them. Raises nothing.

    >>> from faultspace.numeric import FaultSpectra
    >>> from faultspace.numeric.study.driving_spectra import filtered, white
    >>> spectra = FaultSpectra(white([[1.0]]), filtered([1.0], [1.0, -0.5]), white([[0.01]]))
    >>> spectra.faults([0.0])[0, 0, 0].real.round(6).tolist()
    4.0
    """

    input: Spectrum
    faults: Spectrum
    noise: Spectrum


@one_thread()
def fault_space_bound(model: StateSpaceModel, F: ArrayLike, G: ArrayLike, spectra: FaultSpectra, N: int) -> SpaceUncertainty:
    """Compute the least error of an unbiased estimate of the fault space from N samples [SN90].

    The number of zeros is known. The states of an estimate are mapped to those of the model by least squares, as
    `method/space/space_uncertainty.py` says.

    Parameters
    ----------
    model : StateSpaceModel
        Stable and minimal.
    F, G : array_like, (n, n_v) and (p, n_v)
        n_v < p.
    spectra : FaultSpectra
        Of the input, of the faults and of the noise.
    N : int
        Number of samples.

    Returns
    -------
    SpaceUncertainty
        Error of an orthonormal basis (n + p, n_z) in the states of the model and the units of y: `angle(confidence)` in radians,
        `distance(confidence)`.

    Raises
    ------
    InvalidData
        A model that is not stable, shapes that do not fit, dependent faults, as many faults as outputs, noise without power in some
        direction.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import FaultSpectra, StateSpaceModel, fault_space_bound
    >>> from faultspace.numeric.study.driving_spectra import white
    >>> static = StateSpaceModel(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((2, 0)), [[1.0], [2.0]])
    >>> spectra = FaultSpectra(white([[1.0]]), white([[1.0]]), white(0.0001 * np.eye(2)))
    >>> bound = fault_space_bound(static, np.zeros((0, 1)), [[1.0], [0.0]], spectra, 100)
    >>> round(float(np.linalg.norm(bound.root)), 5)
    0.001
    """
    samples = positive(N, "N")
    columns = _fault_columns(model, F, G)
    stable(model)
    tied = _tied(model, columns, spectra)
    return tied.pushed(settled(partial(tied.information, samples)))


def _fault_columns(model: StateSpaceModel, F: ArrayLike, G: ArrayLike) -> Array:
    """Return [F; G] (n + p, n_v). Raises InvalidData where it does not fit the model."""
    parts = [np.asarray(part, dtype=np.float64) for part in (F, G)]
    n_v = parts[1].shape[-1] if parts[1].ndim == 2 else 0
    if [part.shape for part in parts] != [(model.n, n_v), (model.p, n_v)] or n_v == 0:
        raise InvalidData(f"F, G: got shapes {parts[0].shape}, {parts[1].shape}; needed ({model.n}, n_v), ({model.p}, n_v), n_v at least 1")
    if n_v >= model.p:
        raise InvalidData(
            f"no kernel row is left by {counted(n_v, 'fault')} in "
            f"{counted(model.p, 'output')}: every column is a solution, and there is no bound"
        )
    return np.vstack(parts)


@dataclass(frozen=True)
class _Tied:
    """This holds the model, the fault transfer and its kernel rows, in observed coordinates, with the spectra in these units."""

    driven: StateSpaceModel
    faulty: StateSpaceModel
    rows: list[Array]
    spectra: FaultSpectra
    coordinates: ObservedCoordinates

    def information(self, samples: int, count: int) -> Array:
        """Return the Fisher information of the entries of [[A, B], [C, D]] and then of the rows, as if they were free."""
        angles = circle(count)
        n, p, n_u = self.driven.n, self.driven.p, self.driven.n_u
        driven, faults, noise = self.spectra.input(angles), self.spectra.faults(angles), self.spectra.noise(angles)
        transfer = half_transfers(system_matrix(self.faulty), n, angles)[0]
        power = np.asarray(transfer @ faults @ np.conj(np.swapaxes(transfer, 1, 2)), dtype=np.complex128)
        weight = np.asarray(np.linalg.inv(power + noise), dtype=np.complex128)
        of_model = Reduction(angles, np.zeros((count, p, n_u), dtype=np.complex128), weight, driven, samples)
        lags = max(len(row) for row in self.rows)
        z = np.exp(1j * np.outer(angles, np.arange(lags)))
        K = np.array([z[:, : len(row)] @ row for row in self.rows]).swapaxes(0, 1)
        left = np.linalg.inv(K @ noise @ np.conj(np.swapaxes(K, 1, 2)))
        right = power @ weight @ power
        outer = np.einsum("mj,mab,ml->mjalb", z, right, z.conj(), optimize=True).reshape(count, lags * p, lags * p)
        of_rows = samples / count * np.tensordot(left, outer, axes=(0, 0)).real.transpose(1, 2, 0, 3)
        kept = np.concatenate([i * lags * p + np.arange(row.size) for i, row in enumerate(self.rows)])
        size = len(self.rows) * lags * p
        parts = of_model.information(system_matrix(self.driven), n), of_rows.reshape(size, size)[np.ix_(kept, kept)]
        return np.asarray(scipy.linalg.block_diag(*parts))

    def pushed(self, information: Array) -> SpaceUncertainty:
        """Return the error of the space for this information, of which what is tied and what is gauge is taken away."""
        n, p = self.driven.n, self.driven.p
        matrix = system_matrix(self.driven)
        across = np.linalg.qr(off_gauge(matrix, n))[0]
        sizes = (matrix.size, sum(row.size for row in self.rows))
        ties = np.hstack([self._of_model(), self._of_rows()])
        shifts = np.hstack([np.zeros((len(self._shifts()), sizes[0])), self._shifts()])
        free = scipy.linalg.block_diag(across, np.eye(sizes[1])) @ scipy.linalg.null_space(
            np.vstack([ties, shifts]) @ scipy.linalg.block_diag(across, np.eye(sizes[1])), rcond=RANK
        )
        values, vectors = scipy.linalg.eigh(free.T @ information @ free)
        rounding = len(values) * float(np.finfo(np.float64).eps) * float(values[-1])
        root = free @ vectors / np.sqrt(np.maximum(values, rounding))
        of_states = root[: matrix.size].reshape(*matrix.shape, root.shape[1])[:, :n].reshape((n + p) * n, root.shape[1])
        conditions = np.vstack([kernel_conditions(row[None], self.driven.A, self.driven.C)[0] for row in self.rows])
        columns = np.linalg.svd(conditions)[2][len(conditions) :].T
        moved = np.concatenate(
            [turned_by_model(self.rows, self.coordinates, columns), turned_by_rows(self.rows, self.coordinates, columns)]
        )
        return SpaceUncertainty(np.tensordot(np.vstack([of_states, root[matrix.size :]]).T, moved, axes=1))

    def _of_model(self) -> Array:
        """Return what unit changes of the entries of [[A, B], [C, D]] make of sum_j K_j C A^j, for each row (n,)."""
        n, p, n_u = self.driven.n, self.driven.p, self.driven.n_u
        A, C = self.driven.A, self.driven.C
        units = np.eye(n * (n + p)).reshape(n * (n + p), n + p, n)
        ties = np.zeros((len(self.rows), n, n + p, n + n_u))
        for row, tie in zip(self.rows, ties, strict=True):
            X, dX = np.zeros(n), np.zeros((len(units), n))
            for K in row[::-1]:
                dX = K @ units[:, n:] + dX @ A + X @ units[:, :n]
                X = K @ C + X @ A
            tie[:, :, :n] = dX.T.reshape(n, n + p, n)
        return ties.reshape(len(self.rows) * n, (n + p) * (n + n_u))

    def _of_rows(self) -> Array:
        """Return the same for unit changes of the coefficients of the rows."""
        return np.asarray(scipy.linalg.block_diag(*[observability_matrix(self.driven.A, self.driven.C, len(row)).T for row in self.rows]))

    def _shifts(self) -> Array:
        """Return the changes of the rows that leave their span alone."""
        sizes = [row.size for row in self.rows]
        starts = np.cumsum([0, *sizes])
        shifts = []
        for i, row in enumerate(self.rows):
            for other in self.rows:
                for first in range(len(row) - len(other) + 1):
                    shift = np.zeros(starts[-1])
                    shift[starts[i] : starts[i + 1]] = np.pad(other, ((first, len(row) - len(other) - first), (0, 0))).ravel()
                    shifts.append(shift)
        return np.array(shifts)


def _tied(model: StateSpaceModel, columns: Array, spectra: FaultSpectra) -> _Tied:
    """Return the problem in observed coordinates, the outputs in units of what the faults make of them."""
    n = model.n
    plain = StateSpaceModel(model.A, columns[:n], model.C, columns[n:])
    angles = circle(COARSE)
    noise, n_v = spectra.noise(angles), columns.shape[1]
    shapes = (("input", spectra.input(angles), model.n_u), ("faults", spectra.faults(angles), n_v), ("noise", noise, model.p))
    for name, spectrum, size in shapes:
        if spectrum.shape != (COARSE, size, size):
            raise InvalidData(f"the spectrum of the {name} has shape {spectrum.shape} at {COARSE} angles, needed {(COARSE, size, size)}")
    if np.linalg.eigvalsh(noise).min() <= 0:
        raise InvalidData(
            "the noise has no power in some direction at some angle, so that an estimate could be exact and "
            "there is no bound; noise in every direction is needed"
        )
    power = through(plain, spectra.faults)(angles) + noise
    sizes = np.sqrt(np.maximum(np.einsum("mii->i", power).real / COARSE, np.finfo(np.float64).tiny))
    coordinates = observed_coordinates(sizes[None], model.A, model.C, n + 1)
    A, C, T = coordinates.A, coordinates.C, coordinates.T
    driven = StateSpaceModel(A, T @ model.B, C, model.D / sizes[:, None])
    faulty = StateSpaceModel(A, T @ plain.B, C, plain.D / sizes[:, None])

    values = np.linalg.svd(half_transfers(system_matrix(faulty), n, angles)[0], compute_uv=False)
    if np.all(values[:, -1] <= RANK * values[:, 0]):
        raise InvalidData(
            f"the rank of the transfer function of {counted(n_v, 'fault')} is below {n_v} at every angle; needed are independent faults"
        )

    def scaled(at: Array) -> NDArray[np.complex128]:
        return np.asarray(spectra.noise(at) / np.outer(sizes, sizes))

    return _Tied(driven, faulty, kernel_rows(A, faulty.B, C, faulty.D), FaultSpectra(spectra.input, spectra.faults, scaled), coordinates)


def kernel_rows(A: Array, F: Array, C: Array, G: Array) -> list[Array]:
    """Return rows K (eta_i + 1, p) of least degrees, ascending, with K(z) (C (z - A)^-1 F + G) = 0 and sum_j K_j C A^j = 0, for n_v
    independent faults.

    In windows of s samples the left kernel of [O_s T_s] grows with s by the shifts of the rows there are and by the rows of degree s - 1.
    Coordinates ought to be such that entries are of size one.
    """
    n, n_v = F.shape
    p, markov = len(C), StateSpaceModel(A, F, C, G).markov(n + 1)
    rows: list[Array] = []
    for s in range(1, n + 2):
        left, values, _ = np.linalg.svd(np.hstack([observability_matrix(A, C, s), lower_toeplitz(markov[:s])]))
        kernel = left[:, int(np.sum(values > RANK * values[0])) :]
        shifts = [np.pad(row, ((first, s - len(row) - first), (0, 0))).ravel() for row in rows for first in range(s - len(row) + 1)]
        known = np.array(shifts).reshape(len(shifts), p * s).T
        # What the shifts do not span: the least directions of the kernel seen from them.
        Q = np.linalg.qr(known)[0]
        across = kernel.T @ (np.eye(p * s) - Q @ Q.T) @ kernel
        fresh = np.linalg.eigh(across)[1][:, len(shifts) :]
        rows += [(kernel @ direction).reshape(s, p) for direction in fresh.T]
        if len(rows) >= p - n_v:
            break
    return rows
