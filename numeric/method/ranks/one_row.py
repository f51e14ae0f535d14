"""This fits maximum-likelihood kernel rows: the row polynomial N(q) that annihilates r as well as the noise allows.

With fewer faults than outputs, r = s + w where s obeys N(q) s = 0 for at least one polynomial row N, whatever the
fault signal is [W91]. Eliminating s leaves, for noise w of spectrum phi in every channel, the likelihood of N alone:

    cost(N) = sum over frequencies of |N r|^2 / (phi N N*)

a structured total least squares problem [MV07]. The plain left null space of a Hankel matrix instead minimises the numerator
and is biased towards rows that amplify little. The colour phi is estimated in turns with N, as an autoregression of the
normalised row residual, scaled to a mean logarithm of zero so that the level below is comparable between colours.

    degree              eta, the degree of N; coefficient rows N_0 .. N_eta of p entries, stacked into g
    window              psi(k) = [r(k); ..; r(k+eta)], so that N(q) r (k) = g psi(k)
    WindowMoments       second moments of psi in frequency bands: all that the likelihood needs of the data, whatever N
    FittedRow           the fitted row, its level and the noise colour
    level               log of the mean of |N r|^2 / (phi N N*): the log noise power per sample that N leaves
    angle               centre of a band, in radians per sample

The row is filtered in the time domain, where the product with a true kernel row is small to begin with, and only the
weights live on the frequency grid; so leakage of the large signal s never enters.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ...data.validation import signal
from .sample_windows import stacked_triangle

BANDS = 64
SEGMENT = 2048
PAST = 20
NOISE_ORDER, ROUNDS = 4, 3
FLAT = 1e-5  # nats that the last step of a descent gains: far below those that are compared
_STEPS = 60
_COLOUR_FLOOR = 1e-3
"""This is the least normalised noise spectrum: below it a spectral null of the noise would claim all the weight."""


@dataclass(frozen=True)
class WindowMoments:
    """Second moments of the window psi, by bands of frequencies.

    `moments` (bands, p (degree+1), p (degree+1)) are real parts and sum to the time Gram of psi; `counts` (bands,) are real degrees of
    freedom a band and sum to `samples` = N - degree; `angles` (bands,) are the centres of the bands.
    """

    moments: Array
    counts: Array
    angles: Array
    channels: int
    degree: int
    samples: int

    def of_degree(self, degree: int) -> WindowMoments:
        """Return the moments of the shorter window: the same samples, so levels of different degrees are comparable."""
        size = self.channels * (degree + 1)
        return WindowMoments(self.moments[:, :size, :size], self.counts, self.angles, self.channels, degree, self.samples)

    def mixed(self, mix: Array) -> WindowMoments:
        """Return the moments of the signal r @ mix, mix of shape (p, k) with orthonormal columns."""
        repeated = np.kron(np.eye(self.degree + 1), mix)
        moments = repeated.T @ self.moments @ repeated
        return WindowMoments(moments, self.counts, self.angles, mix.shape[1], self.degree, self.samples)


@dataclass(frozen=True)
class FittedRow:
    """A kernel row that was fitted.

    `coefficients` (degree+1, p) have unit norm and make N(q) = sum_j coefficients[j] q^j; `level` is in nats; `noise_colour` is the monic
    autoregression (1, a_1, ..) of the noise; `flat` says whether the last step gained less than `FLAT` nats.
    """

    coefficients: Array
    level: float
    noise_colour: Array
    flat: bool

    @property
    def degree(self) -> int:
        """Return the degree allowed, eta."""
        return int(self.coefficients.shape[0]) - 1


def window_moments(r: Array, degree: int, *, u: Array | None = None) -> WindowMoments:
    """Return banded moments of the windows of r (N, p), in memory that does not depend on N.

    With u (N, n_u) the windows are first made orthogonal to the inputs from `PAST` samples before to their end: then what u explains
    of N r, the error of an identified model above all, does not count as noise. (Projecting r itself would leave the fault's
    chance correlation with u; projecting the windows leaves that of N r only.)

    Raises InvalidData if there are too few samples for the window: N >= 2 p (degree+1) + degree is needed, with u
    PAST + 2 n_u (PAST + degree + 1) more.
    """
    r = signal(r, "r")
    samples, p = r.shape
    inputs = np.zeros((samples, 0)) if u is None else signal(u, "u")
    before = PAST if inputs.shape[1] else 0
    windows = samples - degree - before
    needed = 2 * p * (degree + 1) + 2 * inputs.shape[1] * (before + degree + 1)
    if windows < needed:
        raise InvalidData(
            f"r has {counted(samples, 'sample')} of {counted(p, 'channel')}: a kernel row of degree {degree} needs at least "
            f"{needed + degree + before}; give more samples or a lower degree (smaller block_rows)"
        )

    def outputs_and_inputs(start: int, stop: int) -> tuple[Array, Array]:
        psi = np.hstack([r[before + start + j : before + stop + j] for j in range(degree + 1)])
        if not before:
            return psi, np.zeros((stop - start, 0))
        return psi, np.hstack([inputs[start + j : stop + j] for j in range(before + degree + 1)])

    bands = max(4, min(BANDS, windows // 8))
    size = p * (degree + 1)
    moments = np.zeros((bands, size, size))
    counts = np.zeros(bands)
    pieces = max(1, round(windows / SEGMENT))
    edges = np.linspace(0, windows, pieces + 1).astype(int)
    explained = np.zeros((inputs.shape[1] * (before + degree + 1), size))
    if before:
        both = (outputs_and_inputs(start, stop) for start, stop in pairwise(edges.tolist()))
        lead = stacked_triangle(len(explained) + size, (np.hstack([pushes, psi]) for psi, pushes in both))[: len(explained)]
        explained = np.linalg.lstsq(lead[:, : len(explained)], lead[:, len(explained) :], rcond=None)[0]
    for start, stop in pairwise(edges.tolist()):
        psi, pushes = outputs_and_inputs(start, stop)
        psi -= pushes @ explained
        length = stop - start
        spectrum = np.fft.rfft(psi, axis=0) / np.sqrt(length)
        weight = np.full(spectrum.shape[0], 2.0)
        weight[0] = 1.0
        if length % 2 == 0:
            weight[-1] = 1.0
        band = np.minimum((np.arange(spectrum.shape[0]) * 2 * bands) // length, bands - 1)
        spectrum *= np.sqrt(weight)[:, None]
        for b in range(bands):
            part = spectrum[band == b]
            moments[b] += (part.real.T @ part.real) + (part.imag.T @ part.imag)
            counts[b] += weight[band == b].sum()
    angles = (np.arange(bands) + 0.5) * np.pi / bands
    return WindowMoments(moments, counts, angles, p, degree, windows)


def kernel_row(moments: WindowMoments, *, starts: tuple[Array, ...] = (), within: Array | None = None) -> FittedRow:
    """Return the maximum-likelihood row for these moments.

    `starts`: coefficient arrays (d+1, p), d <= degree, tried beside the plain null space (the row that the least singular
    vector of the Hankel matrix gives). `within` (q, p (degree+1)): rows that span the coefficient vectors allowed, for
    example the orthonormal complement of the observability matrix [G25, problem (11)]. Noise colour and row are fitted in turns.
    """
    p, degree, angles = moments.channels, moments.degree, moments.angles
    basis = np.eye(p * (degree + 1)) if within is None else np.linalg.qr(np.asarray(within, dtype=float).T)[0].T
    powers = np.exp(1j * np.outer(angles, np.arange(degree + 1)))
    gains = np.real(powers[:, :, None] * powers.conj()[:, None, :])
    gains = np.einsum("bij,kl->bikjl", gains, np.eye(p)).reshape(len(angles), p * (degree + 1), -1)
    scale = np.trace(moments.moments.sum(axis=0)) / (moments.samples * p * (degree + 1)) or 1.0
    data = basis @ (moments.moments / (scale * moments.samples)) @ basis.T
    gains = basis @ gains @ basis.T

    guesses = [*np.linalg.eigh(data.sum(axis=0))[1].T[:2], *(basis @ _padded(start, degree) for start in starts)]
    colour = np.ones(len(angles))
    fits = [_descend(data, gains, g / np.linalg.norm(g)) for g in guesses if np.linalg.norm(g) > 0]
    # Costs that rounding makes are equal: the plain null vector is then the most exact.
    g, cost, flat = min(fits, key=lambda fit: max(fit[1], _rounding(data, gains, fit[0])))
    regression = np.array([1.0])
    for _ in range(ROUNDS):
        spectrum = _numerator(data, g) / (_numerator(gains, g) * moments.counts)
        regression = _autoregression(spectrum, angles, moments.counts)
        colour = 1.0 / np.abs(np.exp(-1j * np.outer(angles, np.arange(NOISE_ORDER + 1))) @ regression) ** 2
        colour = np.maximum(colour, _COLOUR_FLOOR)
        colour /= np.exp(np.average(np.log(colour), weights=moments.counts))
        g, cost, flat = _descend(data / colour[:, None, None], gains, g)
    level = float(np.log(max(cost, np.finfo(float).tiny)) + np.log(scale))
    return FittedRow((basis.T @ g).reshape(degree + 1, p), level, regression, flat)


def _padded(start: Array, degree: int) -> Array:
    """Return a coefficient array of lower degree as a vector of this degree."""
    start = np.asarray(start, dtype=float)
    return np.vstack([start, np.zeros((degree + 1 - start.shape[0], start.shape[1]))]).ravel()


def _numerator(forms: Array, g: Array) -> Array:
    """Return the quadratic forms g' Q_b g of all bands."""
    return np.asarray((forms @ g) @ g)


def _rounding(data: Array, gains: Array, g: Array) -> float:
    """Return how wrong rounding may make the cost: each g' S g, a sum of w terms, by w eps |S|."""
    sizes = np.einsum("bii->b", data) / np.maximum(_numerator(gains, g), 1e-12)
    return float(len(g) * np.finfo(float).eps * np.sum(sizes))


def _descend(data: Array, gains: Array, g: Array) -> tuple[Array, float, bool]:
    """Descend by Levenberg and Marquardt on sum_b (g' S_b g) / (g' Q_b g) over the unit sphere; the Jacobian includes the denominator.

    Invariant: the cost never rises.
    """
    damping = 1e-3
    dead, eps = np.finfo(float).tiny, np.finfo(float).eps
    columns = data.reshape(len(data), -1)

    def at(g: Array) -> tuple[Array, Array, Array, Array, float]:
        """Return S_b g and Q_b g of all bands, numerators and denominators, and the cost."""
        sg, qg = data @ g, gains @ g
        a, d = np.maximum(sg @ g, 0.0), np.maximum(qg @ g, 1e-12)
        return sg, qg, a, d, float(np.sum(a / d))

    sg, qg, a, d, cost = at(g)
    flat = False
    # Of a cost that rounding makes, as without noise, no slope is known: steps would turn g by the root of rounding.
    if cost <= _rounding(data, gains, g):
        return g, cost, True
    for _ in range(_STEPS):
        gradient = (sg / d[:, None] - qg * (a / d**2)[:, None]).sum(axis=0)
        cross = (sg / (d**2)[:, None]).T @ qg
        hessian = ((1.0 / d)[None] @ columns).reshape(cross.shape) - cross - cross.T + (qg * (a / d**3)[:, None]).T @ qg
        ridge = np.maximum(hessian.diagonal(), 0.0) + eps * abs(hessian.trace()) + dead
        while True:
            damped = hessian.copy()
            damped.flat[:: len(g) + 1] += damping * ridge
            # Without noise both may underflow; then there is nothing left to gain.
            try:
                step = np.linalg.solve(damped, -gradient)
            except np.linalg.LinAlgError:
                return g, cost, True
            step -= g * (g @ step)
            trial = (g + step) / np.linalg.norm(g + step)
            there = at(trial)
            if there[-1] < cost or damping > 1e8:
                break
            damping *= 8.0
        if not there[-1] < cost:
            return g, cost, True
        drop = np.log(cost / max(there[-1], dead))
        g, (sg, qg, a, d, cost), damping = trial, there, max(damping / 6.0, 1e-10)
        if drop < FLAT:
            flat = True
            break
    return g, cost, flat


def _autoregression(spectrum: Array, angles: Array, counts: Array) -> Array:
    """Return the monic Yule-Walker autoregression of a spectrum sampled at the angles."""
    weight = spectrum * counts / counts.sum()
    order = NOISE_ORDER
    lags = np.cos(np.outer(np.arange(order + 1), angles)) @ weight
    if lags[0] <= 0.0:
        return np.asarray(np.eye(1, order + 1)[0], dtype=np.float64)
    toeplitz = lags[np.abs(np.subtract.outer(np.arange(order), np.arange(order)))] + 1e-9 * lags[0] * np.eye(order)
    return np.asarray(np.concatenate([[1.0], -np.linalg.solve(toeplitz, lags[1:])]), dtype=np.float64)
