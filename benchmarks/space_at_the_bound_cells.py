"""Make records with strong coloured faults whose fault space is known, with the spectra that its Cramer-Rao bound asks for.

    study     systems of the study (n = 5, p = 3, n_v = 2, one input) with 0 to 3 zeros, its two faults (a chirp with an offset, a slow rise
              in white noise) and its low-pass noise
    random    stable (n, p, n_v) with one input, AR(1) faults as loud as the response to the input, each with a pole of its own, and white
              noise; almost all of them have no zeros

The noise of each output is 40 dB below it. Inputs are white, or AR(1) with coefficient 0.8. Spectra are those that the records were drawn
from, but for the study's faults, which are no stationary signals: theirs is their periodogram, offset included, smoothed by a Gaussian.

Cell, CELLS     the cells; `trial` draws one of a seed
Trial           y, u, the true model and fault matrices, the spectra
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.signal
from at_the_bound_cells import BANDWIDTH, NOISE, NULL, SETTLING, input_signal, stable_matrix
from numpy.typing import NDArray

from faultspace.numeric import FaultSpectra, StateSpaceModel
from faultspace.numeric.method.space.estimate import kernel_conditions
from faultspace.numeric.study.driving_spectra import Spectrum, filtered, white
from faultspace.numeric.study.random_systems import study_system
from faultspace.numeric.study.runs import LOW_PASS, NOISE_GAIN, coloured_noise, response, study_faults
from faultspace.numeric.study.space_information import kernel_rows

Array = NDArray[np.float64]

GRID = 400  # angles at which a smoothed periodogram is computed: twelve to a BANDWIDTH


@dataclass(frozen=True)
class Trial:
    """A trial has y (N, p), u (N, n_u), the model and the fault matrices that made them, the fault space Z (n + p, n_z), the spectra."""

    y: Array
    u: Array
    model: StateSpaceModel
    F: Array
    G: Array
    Z: Array
    spectra: FaultSpectra

    @property
    def n_v(self) -> int:
        """Return the number of faults."""
        return self.F.shape[1]

    @property
    def zeta(self) -> int:
        """Return the number of zeros."""
        return self.Z.shape[1] - self.n_v


@dataclass(frozen=True)
class Cell:
    """A cell is one kind of systems with one kind of inputs: of the study with so many zeros, or random ones (n, p, n_v)."""

    kind: str
    zeros: int = 0
    sizes: tuple[int, int, int] = (5, 3, 2)
    coloured: bool = False

    @property
    def name(self) -> str:
        """Return the name that the tables show."""
        what = f"{self.zeros} zeros" if self.kind == "study" else "n = {}, p = {}, n_v = {}".format(*self.sizes)
        return f"{self.kind}, {what}, {'coloured' if self.coloured else 'white'}"

    def trial(self, seed: int, number: int, samples: int) -> Trial:
        """Return trial `number` of a seed."""
        rng = np.random.default_rng([seed, number, samples, self.zeros, self.coloured, *self.sizes])
        if self.kind == "study":
            return _of_the_study(seed, number, self.zeros, samples, self.coloured, rng)
        return _random(self.sizes, samples, self.coloured, rng)


CELLS: Sequence[Cell] = (
    *(Cell("study", zeros, coloured=coloured) for coloured in (False, True) for zeros in range(4)),
    *(Cell("random", sizes=sizes, coloured=coloured) for sizes in ((4, 4, 2), (5, 3, 1)) for coloured in (False, True)),
)


def _of_the_study(seed: int, number: int, zeros: int, samples: int, coloured: bool, rng: np.random.Generator) -> Trial:
    system = study_system(zeros, np.random.SeedSequence([seed, number, zeros]))
    plant = system.model
    u, spectrum = input_signal(samples, plant.n_u, coloured, rng)
    u = u[SETTLING:]
    v = study_faults(samples, rng)
    clean = response(plant, u, np.zeros(plant.n))
    clean = clean + response(StateSpaceModel(plant.A, system.F, plant.C, system.G), v, rng.standard_normal(plant.n))
    deviations = NOISE / NOISE_GAIN * clean.std(axis=0)
    y = clean + deviations * coloured_noise(samples, plant.p, rng)

    def noise(angles: Array) -> NDArray[np.complex128]:
        power = filtered(*LOW_PASS)(angles)[:, 0, 0].real
        return np.asarray(np.maximum(power, NULL * power.mean())[:, None, None] * np.diag(deviations**2), dtype=np.complex128)

    return Trial(y, u, plant, system.F, system.G, system.Z, FaultSpectra(spectrum, smoothed(v), noise))


def smoothed(v: Array) -> Spectrum:
    """Return the smoothed periodogram of each fault as a spectrum, with its offset, which tells its direction too.

    It is smoothed round the circle, for it has the offset at angle zero, where `_smoothed` of `at_the_bound_cells` sees one side alone.
    """
    power = np.abs(np.fft.fft(v, axis=0)) ** 2 / len(v)
    at, grid = 2 * np.pi * np.fft.fftfreq(len(v)), np.linspace(0, np.pi, GRID)
    values = np.empty((GRID, v.shape[1]))
    for k, angle in enumerate(grid):
        weights = np.exp(-0.5 * (np.angle(np.exp(1j * (angle - at))) / BANDWIDTH) ** 2)
        values[k] = weights @ power / weights.sum()

    def spectrum(angles: Array) -> NDArray[np.complex128]:
        each = [np.interp(angles, grid, column) for column in values.T]
        return np.asarray(np.stack(each, axis=1)[:, :, None] * np.eye(v.shape[1]), dtype=np.complex128)

    return spectrum


def _random(sizes: tuple[int, int, int], samples: int, coloured: bool, rng: np.random.Generator) -> Trial:
    n, p, n_v = sizes
    A, rotation = stable_matrix(n, rng)

    def entries(*shape: int) -> Array:
        return np.asarray(rng.choice((-1.0, 1.0), shape) * rng.uniform(0.5, 1.5, shape))

    plant = StateSpaceModel(A, rotation @ entries(n, 1), entries(p, n) @ rotation.T, entries(p, 1))
    F, G = rotation @ entries(n, n_v), entries(p, n_v)
    poles = rng.uniform(0.5, 0.95, n_v)
    u, spectrum = input_signal(samples, 1, coloured, rng)
    white_noise = rng.standard_normal((samples + SETTLING, n_v))
    v = np.column_stack([scipy.signal.lfilter([1.0], [1.0, -pole], white_noise[:, i]) for i, pole in enumerate(poles)])
    of_input = plant.simulate(u)[SETTLING:]
    of_faults = StateSpaceModel(A, F, plant.C, G).simulate(v)[SETTLING:]
    gain = float(np.sqrt(np.mean(of_input**2) / np.mean(of_faults**2)))
    clean = of_input + gain * of_faults
    deviations = NOISE * clean.std(axis=0)

    def faults(angles: Array) -> NDArray[np.complex128]:
        each = [filtered([gain], [1.0, -pole])(angles)[:, 0, 0] for pole in poles]
        return np.asarray(np.stack(each, axis=1)[:, :, None] * np.eye(n_v), dtype=np.complex128)

    noise = white(np.diag(deviations**2))
    y = clean + deviations * rng.standard_normal(clean.shape)
    rows = kernel_rows(A, F, plant.C, G)
    conditions = np.vstack([kernel_conditions(row[None], A, plant.C)[0] for row in rows])
    Z = np.linalg.svd(conditions)[2][len(conditions) :].T
    return Trial(y, u[SETTLING:], plant, F, G, np.asarray(Z), FaultSpectra(spectrum, faults, noise))
