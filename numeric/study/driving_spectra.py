"""Make power spectra as functions of the angle: of inputs, of faults through their system, of noise.

A spectrum is a function of angles (M,) in (0, pi), radians a sample, to Hermitian matrices (M, k, k) with the autocovariance
R(l) = 1/(2 pi) integral of S(w) exp(i w l); white noise of covariance R has the constant spectrum R. Units are those of the squared signal.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base.arrays import Array
from ..method.model.invariants import half_transfers, system_matrix
from ..method.model.models import StateSpaceModel

ComplexArray = NDArray[np.complex128]
Spectrum = Callable[[Array], ComplexArray]


@dataclass(frozen=True)
class Spectra:
    """A bound is computed from these spectra of the input and of the disturbance, which is faults and noise together [L99].

    Each is a function of angles (M,) in radians a sample. `input` returns an array of the shape (M, n_u, n_u) in squared units of u,
    `disturbance` one of (M, p, p) in squared units of y; `white` and `filtered` of the same module make such functions. Raises nothing.

    >>> import numpy as np
    >>> from faultspace.numeric import Spectra
    >>> from faultspace.numeric.study.driving_spectra import filtered, white
    >>> spectra = Spectra(input=white([[4.0]]), disturbance=filtered([1.0], [1.0, -0.5]))
    >>> spectra.disturbance(np.array([0.0]))[0, 0, 0].real.round(6).tolist()
    4.0
    """

    input: Spectrum
    disturbance: Spectrum


def white(covariance: ArrayLike) -> Spectrum:
    """Return the spectrum of white noise with this covariance (k, k)."""
    matrix = np.array(covariance, dtype=np.complex128)
    return lambda angles: np.broadcast_to(matrix, (len(angles), *matrix.shape))


def filtered(numerator: ArrayLike, denominator: ArrayLike, channels: int = 1) -> Spectrum:
    """Return the spectrum of independent channels, each white noise of variance one through numerator(q^-1) / denominator(q^-1).

    The coefficients are given by rising lag.
    """
    b, a = (np.atleast_1d(np.asarray(part, dtype=np.float64)) for part in (numerator, denominator))

    def spectrum(angles: Array) -> ComplexArray:
        values = [np.exp(-1j * np.outer(angles, np.arange(len(part)))) @ part for part in (b, a)]
        return np.asarray(np.abs(values[0] / values[1])[:, None, None] ** 2 * np.eye(channels), dtype=np.complex128)

    return spectrum


def through(system: StateSpaceModel, spectrum: Spectrum) -> Spectrum:
    """Return the spectrum H S H* of a system's response to a signal of the given spectrum."""

    def response(angles: Array) -> ComplexArray:
        transfer = half_transfers(system_matrix(system), system.n, angles)[0]
        return np.asarray(transfer @ spectrum(angles) @ np.conj(np.swapaxes(transfer, 1, 2)))

    return response


def total(*spectra: Spectrum) -> Spectrum:
    """Return the spectrum of the sum of independent signals."""
    return lambda angles: np.asarray(sum(spectrum(angles) for spectrum in spectra), dtype=np.complex128)
