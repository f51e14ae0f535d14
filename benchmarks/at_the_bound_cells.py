"""Make records with strong coloured faults, and what is true of them, on which models are compared with the Cramer-Rao bound.

    paper      systems of the study (n = 5, p = 3, one input), its two faults (a chirp, a slow rise in white noise), low-pass noise
               40 dB down
    2in3out    n = 4, p = 3, two inputs, one AR(1) fault as strong as the inputs' response, white sensor noise 40 dB down
    1in1out    n = 4, p = 1, one input, the same

Inputs are white, or coloured: AR(1) with coefficient 0.8. The disturbance's spectrum is known but for the study's faults, which are no
stationary signals: theirs is their periodogram smoothed by a Gaussian of BANDWIDTH radians; the null of the low-pass is filled to NULL of
its mean, which makes the bound larger, if anything.

Cell, CELLS     the cells; `trial` draws one of a seed
Trial           y, u, the true model and the spectra
Faults          of a system of the study: F, G, the fault space, the spectra of faults and noise
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
import scipy.signal
from numpy.typing import NDArray

from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.study.driving_spectra import Spectra, Spectrum, filtered, through, total, white
from faultspace.numeric.study.random_systems import study_system
from faultspace.numeric.study.runs import LOW_PASS, NOISE_GAIN, coloured_noise, response, study_faults

Array = NDArray[np.float64]

BANDWIDTH = 0.08
NULL = 1e-3
INPUT_POLE = 0.8
NOISE = 0.01
SETTLING = 500  # samples before a record begins
ZEROS = 4  # numbers of zeros of the study, 0 to 3, in turn


@dataclass(frozen=True)
class Faults:
    """The faults enter by F (n, n_v) and G (p, n_v), their space has the basis Z (n + p, n_z), and they and the noise have spectra."""

    F: Array
    G: Array
    Z: Array
    spectrum: Spectrum
    noise: Spectrum


@dataclass(frozen=True)
class Trial:
    """A trial has y (N, p), u (N, n_u), the model that made them but for faults and noise, the spectra, and the study's faults."""

    y: Array
    u: Array
    model: StateSpaceModel
    spectra: Spectra
    faults: Faults | None = None


@dataclass(frozen=True)
class Cell:
    """A cell is one kind of systems with one kind of inputs."""

    kind: str
    coloured: bool

    @property
    def name(self) -> str:
        """Return the name that the tables show."""
        return f"{self.kind} {'coloured' if self.coloured else 'white'}"

    def trial(self, seed: int, number: int, samples: int) -> Trial:
        """Draw the record of this number, which is the same for the same seed."""
        kind = ("paper", "2in3out", "1in1out").index(self.kind)
        rng = np.random.default_rng([seed, kind, self.coloured, number, samples])
        if self.kind == "paper":
            return _of_the_study(seed, number, samples, self.coloured, rng)
        return _one_fault(samples, self.coloured, rng, *((2, 3) if self.kind == "2in3out" else (1, 1)))


CELLS = tuple(Cell(kind, coloured) for kind in ("paper", "2in3out", "1in1out") for coloured in (False, True))


def input_signal(samples: int, channels: int, coloured: bool, rng: np.random.Generator) -> tuple[Array, Spectrum]:
    pole = INPUT_POLE if coloured else 0.0
    numerator, denominator = [np.sqrt(1 - pole**2)], [1.0, -pole]
    u = scipy.signal.lfilter(numerator, denominator, rng.standard_normal((samples + SETTLING, channels)), axis=0)
    return np.asarray(u), filtered(numerator, denominator, channels)


def _of_the_study(seed: int, number: int, samples: int, coloured: bool, rng: np.random.Generator) -> Trial:
    system = study_system(number % ZEROS, np.random.SeedSequence([seed, number]))
    plant = system.model
    u, spectrum = input_signal(samples, plant.n_u, coloured, rng)
    u = u[SETTLING:]
    v = study_faults(samples, rng)
    faulty = StateSpaceModel(plant.A, system.F, plant.C, system.G)
    clean = response(plant, u, np.zeros(plant.n)) + response(faulty, v, rng.standard_normal(plant.n))
    deviations = NOISE / NOISE_GAIN * clean.std(axis=0)
    y = clean + deviations * coloured_noise(samples, plant.p, rng)

    def noise(angles: Array) -> NDArray[np.complex128]:
        power = filtered(*LOW_PASS)(angles)[:, 0, 0].real
        return np.asarray(np.maximum(power, NULL * power.mean())[:, None, None] * np.diag(deviations**2), dtype=np.complex128)

    # An offset disturbs the model at one angle only, but it tells the direction of its fault.
    faults = Faults(system.F, system.G, system.Z, _smoothed(v, 0), noise)
    return Trial(y, u, plant, Spectra(spectrum, total(through(faulty, _smoothed(v, 1)), noise)), faults)


def _smoothed(v: Array, first_angle: int) -> Spectrum:
    """Return the smoothed periodogram of each fault as a spectrum, from that angle on: 0 includes the offset, 1 leaves it out.

    Positive angles alone are smoothed over, at every angle asked for. `smoothed` of `space_at_the_bound_cells` goes round the circle,
    negative angles included, and interpolates; the two differ beside an offset, by up to a factor of two in the power and by about 1 % in
    the bound of a fault space (seed 9901, 4 records of 1000 samples). Tables made with one are not made again with the other.
    """
    power = np.abs(np.fft.rfft(v, axis=0)[first_angle:]) ** 2 / len(v)
    at = 2 * np.pi * np.arange(first_angle, first_angle + len(power)) / len(v)
    # Behind each angle but zero stands a negative one.
    sides = np.where(at == 0, 0.5, 1.0)

    def spectrum(angles: Array) -> NDArray[np.complex128]:
        values = np.empty((len(angles), v.shape[1]))
        for first in range(0, len(angles), 256):
            weights = sides * np.exp(-0.5 * ((angles[first : first + 256, None] - at) / BANDWIDTH) ** 2)
            values[first : first + 256] = weights @ power / weights.sum(axis=1, keepdims=True)
        return np.asarray(values[:, :, None] * np.eye(v.shape[1]), dtype=np.complex128)

    return spectrum


def _one_fault(samples: int, coloured: bool, rng: np.random.Generator, n_u: int, p: int) -> Trial:
    n = 4
    A, rotation = stable_matrix(n, rng)

    def entries(*shape: int) -> Array:
        return np.asarray(rng.choice((-1.0, 1.0), shape) * rng.uniform(0.5, 1.5, shape))

    plant = StateSpaceModel(A, rotation @ entries(n, n_u), entries(p, n) @ rotation.T, entries(p, n_u))
    fault_pole = rng.uniform(0.5, 0.95)
    u, spectrum = input_signal(samples, n_u, coloured, rng)
    v = scipy.signal.lfilter([1.0], [1.0, -fault_pole], rng.standard_normal((samples + SETTLING, 1)), axis=0)
    faulty = StateSpaceModel(A, rotation @ entries(n, 1), plant.C, entries(p, 1))
    driven, disturbed = plant.simulate(u)[SETTLING:], faulty.simulate(v)[SETTLING:]
    gain = np.sqrt(np.mean(driven**2) / np.mean(disturbed**2))
    clean = driven + gain * disturbed
    deviations = NOISE * clean.std(axis=0)
    faulty = StateSpaceModel(A, gain * faulty.B, faulty.C, gain * faulty.D)
    disturbance = total(through(faulty, filtered([1.0], [1.0, -fault_pole])), white(np.diag(deviations**2)))
    return Trial(clean + deviations * rng.standard_normal(clean.shape), u[SETTLING:], plant, Spectra(spectrum, disturbance))


def stable_matrix(n: int, rng: np.random.Generator) -> tuple[Array, Array]:
    """Draw A (n, n) with poles 0.15 apart of modulus 0.3 to 0.95, turned by an orthogonal matrix that is returned too."""
    while True:
        poles: list[complex] = []
        while len(poles) < n:
            radius, angle = rng.uniform(0.3, 0.95), rng.uniform(0, np.pi)
            pair = len(poles) < n - 1 and rng.random() < 0.5
            pole = radius * np.exp(1j * angle)
            poles += [pole, np.conj(pole)] if pair else [complex(radius * rng.choice((-1, 1)))]
        if np.min(np.abs(np.subtract.outer(poles, poles)) + np.eye(n)) >= 0.15:
            break
    blocks = [
        np.array([[pole.real, pole.imag], [-pole.imag, pole.real]]) if pole.imag > 0 else np.array([[pole.real]])
        for pole in poles
        if pole.imag >= 0
    ]
    rotation = np.linalg.qr(rng.standard_normal((n, n)))[0]
    return np.asarray(rotation @ scipy.linalg.block_diag(*blocks) @ rotation.T), np.asarray(rotation)
