"""A sinusoid that the healthy part has not: a line of the periodogram against the healthy spectrum, as in Fisher's g test [F29].

ratio     |d(f)|^2 / V(f): d the amplitude of each output by itself at frequency f, from the transform of the innovations and the
          inverse of the predictor's response; V what it is worth by the healthy spectrum around f, whose nu degrees of freedom make
          the law of the ratio that of Fisher with 2 and nu. The spectrum is estimated from another part than the one tested, so that
          the line itself is not in it, as it is in Fisher's own statistic
chance    at all frequencies: their number times that of one (Bonferroni); they stand twice as close as the record's own, so that no
          line loses more than a tenth of its amplitude between two of them
hum       a line that the healthy part has too is none, unless its amplitude has doubled: the spectrum around it is wider than it

sinusoids    a row for each output
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import scipy  # its folders are loaded when they are first used

from ....base.arrays import Array
from ..healthy.mean_shift import POWER
from .predictor import Complex, Predictor, Stretch
from .slow import about_slope
from .table_rows import LINE, Evidence, undecided

SLOWEST = 3  # periods in the part tested: a slower sinusoid is a drift
CANDIDATES = 12  # lines whose forecast's error is computed
CLOSEST = 0.9  # share of its amplitude that a line between two frequencies keeps: sinc(1/4)
CHUNK = 4096
HUM = 0.01  # level at which the healthy part has a line


def sinusoids(learnt: Predictor, after: Stretch, e: Array, names: Sequence[str], level: float) -> Iterator[Evidence]:
    """Yield a row for each output, from the innovations e (M - lags, p) of the part `after`, each tested at `level`."""
    length = len(e)
    frequencies = np.arange(2 * SLOWEST, length - 1) / (2.0 * length)
    if len(frequencies) < 2:
        yield from (undecided(LINE, name, "there are too few samples") for name in names)
        return
    transform = 2.0 / length * np.fft.rfft(about_slope(e), n=2 * length, axis=0)[2 * SLOWEST : length - 1]
    spectrum = HealthySpectrum(learnt)
    amplitudes, densities = spectrum.seen(frequencies, transform)
    freedom = spectrum.freedom
    variances = 4.0 / length * densities
    bound = freedom / 2.0 * ((len(frequencies) / level) ** (2.0 / freedom) - 1.0)
    for i, name in enumerate(names):
        ratios = np.abs(amplitudes[:, i]) ** 2 / variances[:, i]
        visible = _visible(np.sqrt(np.median(variances[:, i])), bound) * learnt.scales[i]
        best, where = 0.0, None
        for place in np.argsort(-ratios)[:CANDIDATES]:
            error = _forecast(learnt, after, float(frequencies[place]), amplitudes[place], length)
            weighed = float(ratios[place]) / (1.0 + error * length / 4.0)
            if weighed > best and not spectrum.hums(float(frequencies[place]), float(abs(amplitudes[place, i])), length, i):
                best, where = weighed, place
        if where is None:
            hum = "only lines that the healthy part has, too"
            yield Evidence(LINE, name, 1.0, 0.0, 0.0, 0.0, visible, visible / learnt.spread[i], detail=hum)
            continue
        chance = min(len(frequencies) * (1.0 + 2.0 * best / freedom) ** (-freedom / 2.0), 1.0)
        size, spread = float(abs(amplitudes[where, i])) * learnt.scales[i], learnt.spread[i]
        detail = f"at {frequencies[where]:.4g} cycles a sample"
        yield Evidence(LINE, name, chance, best, size, size / spread, visible, visible / spread, detail=detail)


def _visible(deviation: float, bound: float) -> float:
    """Return the amplitude whose ratio exceeds `bound` with the chance POWER: the part of the noise along the line is normal."""
    return float(deviation * (np.sqrt(bound) + scipy.special.ndtri(POWER) / np.sqrt(2.0)) / CLOSEST)


class HealthySpectrum:
    """The spectrum of the healthy innovations in bands of `width` frequencies, which gives it twice as many degrees of freedom."""

    def __init__(self, learnt: Predictor) -> None:
        self.learnt = learnt
        e = learnt.e
        self.transforms = np.fft.rfft(e, axis=0)[1 : (len(e) + 1) // 2] / np.sqrt(len(e) * learnt.share)
        self.frequencies = np.arange(1, len(self.transforms) + 1) / len(e)
        bands = max(len(self.transforms) // learnt.freedom, 1)
        parts = np.array_split(self.transforms, bands)
        self.freedom = 2.0 * min(map(len, parts))
        self.edges = np.cumsum([len(part) for part in parts])[:-1]
        self.densities = np.stack([part.T @ part.conj() / len(part) for part in parts])
        # As lines are: amplitudes of the outputs themselves, and what noise gives around them, by the median that no line moves.
        amplitudes, _ = self.seen(self.frequencies, 2.0 / np.sqrt(len(e)) * self.transforms)
        self.amplitudes = np.abs(amplitudes)
        medians = [np.median(part, axis=0) for part in np.array_split(self.amplitudes**2, bands)]
        noise = np.repeat(medians, [len(part) for part in parts], axis=0) / np.log(2.0)
        self.lines = self.amplitudes**2 > noise * np.log(self.amplitudes.size / HUM)

    def seen(self, frequencies: Array, transform: Complex) -> tuple[Complex, Array]:
        """Return the outputs' own transforms (nf, p), and the spectral density of each at these frequencies (nf, p)."""
        learnt = self.learnt
        amplitudes, densities = np.empty_like(transform), np.empty(transform.shape)
        places = np.searchsorted(self.edges, np.clip(np.round(frequencies * len(learnt.e)).astype(int) - 1, 0, None), side="right")
        lags = np.arange(1, learnt.lags + 1)
        for first in range(0, len(frequencies), CHUNK):
            part = slice(first, first + CHUNK)
            turns = np.exp(-2j * np.pi * np.outer(frequencies[part], lags))
            back = np.linalg.inv(np.eye(learnt.p) - np.tensordot(turns, learnt.steps[:, :, : learnt.p], axes=1))
            amplitudes[part] = np.einsum("fij,fj->fi", back, transform[part])
            densities[part] = np.einsum("fij,fjk,fik->fi", back, self.densities[places[part]], back.conj(), optimize=True).real
        return amplitudes, densities

    def hums(self, frequency: float, amplitude: float, length: int, i: int) -> bool:
        """Say whether the healthy part has a line there, of half this amplitude at least."""
        near = np.abs(self.frequencies - frequency) <= 1.5 / len(self.learnt.e) + 1.0 / length
        return bool(np.any(self.lines[near, i] & (2.0 * self.amplitudes[near, i] > amplitude)))


def _forecast(learnt: Predictor, after: Stretch, frequency: float, amplitude: Complex, length: int) -> float:
    """Return |x' root'|^2 for the transform x of the regressors at this frequency, the line itself taken out."""
    turns = np.exp(-2j * np.pi * frequency * np.arange(length))
    real, imaginary = (learnt.moments(after, part[:, None])[:, 0] for part in (turns.real, turns.imag))
    return learnt.forecast(learnt.without(2.0 / length * (real + 1j * imaginary), amplitude, frequency))
