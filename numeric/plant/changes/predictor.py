"""This learns a residual without fault as a predictor with a constant: what it leaves is white enough to be tested, at any frequency.

    e(k) = r(k) - c - sum_j A_j r(k-j) - sum_j B_j u(k-j),  least squares on the healthy part, r in units of `scales`

Three things are worth keeping of the healthy part. The coefficients with (X0' X0)^-1: a sum over another part of s(k) e(k) has the error
X' s of their error in it, and with x = X' s / s's the variance of the coefficient of s is S h, h = 1/s's + x' (X0' X0)^-1 x, S the spectral
density of e where s has its power (forecasts by least squares [C60]). The cosine transforms of e, each of covariance S at its frequency, so
that colour which the predictor leaves is in every variance: B = .41 K^(2/3) neighbours make one estimate of the covariance of e [LLSW18].

The fault is in the regressors too, as far as it is in r; x is taken with that part replaced by what is expected without it, so that h does
not grow with the fault.

    Predictor      what was learnt; `innovations`, `filtered` signals, the variance of sums
    predictor      learns it
    Stretch        residual, outputs and inputs of consecutive samples
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy  # its folders are loaded when they are first used
from numpy.typing import NDArray

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ...method.ranks.sample_windows import channel_sizes
from ..healthy.healthy_model import lagged, number_of_lags
from ..healthy.mean_shift import COSINES, UNIT_ROOT, nearest_root

Complex = NDArray[np.complex128]

LEARNT_FROM = 1 << 14
"""The last so many healthy samples are learnt from: the regressors are many times as many numbers."""


@dataclass(frozen=True, eq=False)
class Stretch:
    """Consecutive samples: the residual r (M, p), the outputs y (M, p), the inputs u (M, n_u) and the responses of the model to
    each input alone, (n_u, M, p), None where there is no stable model. `fitted` parameters of the model for each output were fitted to
    them. `gain_errors` (K, p, n_u) are those of the static gain of a model that was fitted to others, where they are known."""

    r: Array
    y: Array
    u: Array
    responses: Array | None
    fitted: float = 0.0
    gain_errors: Array | None = None

    def __len__(self) -> int:
        return len(self.r)

    def part(self, first: int, last: int) -> Stretch:
        """Return samples first .. last - 1."""
        responses = None if self.responses is None else self.responses[:, first:last]
        return Stretch(self.r[first:last], self.y[first:last], self.u[first:last], responses, self.fitted, self.gain_errors)


@dataclass(frozen=True, eq=False)
class Predictor:
    """A predictor of the healthy residual, with what its errors are worth.

    `moving` numbers the n_u inputs that are not constant. `scales` (p,) and `input_scales` (n_u,) are the units, `constant` (p,), `steps`
    (lags, p, p + n_u), `direct` (p, n_u) the coefficients, `regressors` X0 (count, q) are in the order constant, lags, inputs now, and
    `root` (q, q) satisfies root' root = (X0' X0)^-1. `e` (count, p) is what is left of the healthy part, `share` the part of the degrees
    of freedom that is left, `waves` (count - 1, p) the cosine transforms of e but the first, put right for the share; `freedom` is B, and
    `spread` (p,) the standard deviation of the healthy residual, in its units.
    """

    scales: Array
    moving: NDArray[np.int_]
    input_scales: Array
    constant: Array
    steps: Array
    direct: Array
    root: Array
    regressors: Array
    e: Array
    share: float
    waves: Array
    freedom: int
    spread: Array

    @property
    def p(self) -> int:
        """Return the number of outputs."""
        return len(self.scales)

    @property
    def lags(self) -> int:
        """Return the number of lags."""
        return len(self.steps)

    @property
    def count(self) -> int:
        """Return how many healthy samples were predicted."""
        return len(self.e)

    @property
    def covariance(self) -> Array:
        """Return the covariance (p, p) of e, spent degrees of freedom taken off."""
        return np.asarray(self.e.T @ self.e / (len(self.e) * self.share))

    @property
    def wanders(self) -> bool:
        """Say whether a root of the predictor is at one, within what a random walk shows [F76]: means say nothing then."""
        return nearest_root([step[:, : self.p] for step in self.steps]) * self.count < UNIT_ROOT

    def response(self, frequency: float) -> Complex:
        """Return I - sum A_j exp(-2 pi i f j), (p, p), at f cycles a sample: what the predictor makes of a signal in r, both scaled."""
        turns = np.exp(-2j * np.pi * frequency * np.arange(1, self.lags + 1))
        return np.asarray(np.eye(self.p) - np.tensordot(turns, self.steps[:, :, : self.p], axes=1), dtype=complex)

    def scaled(self, part: Stretch) -> Array:
        """Return residual and inputs of a part in the units of the predictor, (M, p + n_u)."""
        return np.hstack([part.r / self.scales, part.u[:, self.moving] / self.input_scales])

    def innovations(self, part: Stretch) -> Array:
        """Return e (M - lags, p) of another part, lag by lag: the regressors of a long one do not fit into memory."""
        joint = self.scaled(part)
        e = joint[self.lags :, : self.p] - self.constant - joint[self.lags :, self.p :] @ self.direct.T
        for j, step in enumerate(self.steps, start=1):
            e -= joint[self.lags - j : len(joint) - j] @ step.T
        return np.asarray(e)

    def filtered(self, signal: Array) -> Array:
        """Return what the predictor makes of a signal (M, p) in r, in units of r: (M - lags, p)."""
        scaled = signal / self.scales
        made = scaled[self.lags :].copy()
        for j, step in enumerate(self.steps, start=1):
            made -= scaled[self.lags - j : len(scaled) - j] @ step[:, : self.p].T
        return made

    def moments(self, part: Stretch, weights: Array) -> Array:
        """Return sum_k x(k) w(k)' (q, m) for the regressors x of another part and weights (M - lags, m)."""
        joint = self.scaled(part)
        blocks = [joint[self.lags - j : len(joint) - j].T @ weights for j in range(1, self.lags + 1)]
        now = joint[self.lags :, self.p :].T @ weights
        return np.vstack([weights.sum(axis=0)[None], *blocks, now])

    def without(self, moments: NDArray[Any], amplitude: NDArray[Any], frequency: float) -> NDArray[Any]:
        """Return `moments` (q,) with the fault of this amplitude (p,) in r, at this frequency, taken out of the lags of r."""
        cleared = moments.astype(np.result_type(moments, amplitude))
        width, turn = self.steps.shape[2], np.exp(-2j * np.pi * frequency) if frequency else 1.0
        for j in range(self.lags):
            cleared[1 + j * width : 1 + j * width + self.p] -= amplitude * turn ** (j + 1)
        return cleared

    def forecast(self, moments: NDArray[Any]) -> float:
        """Return x' (X0' X0)^-1 x for x (q,): the error of the coefficients."""
        return float(np.sum(np.abs(self.root @ moments) ** 2))

    def variance(self, weights: Array) -> tuple[float, float]:
        """Return the variance of sum_k w(k)' e(k), w (M - lags, p), by the spectrum of e, and its degrees of freedom [S46]."""
        own = np.asarray(scipy.fft.dct(weights, type=2, axis=0, norm="ortho"))
        bands = max(len(self.waves) // self.freedom, 1)
        total, squares = 0.0, 0.0
        # Band for band the same frequencies: of waves there is none at frequency zero, whose neighbours stand for it.
        edges = np.round(np.linspace(0.0, len(own), bands + 1)).astype(int)
        for waves, first, last in zip(np.array_split(self.waves, bands), edges, edges[1:], strict=False):
            inside = own[first:last]
            power = float(np.sum((waves.T @ waves) * (inside.T @ inside))) / len(waves)
            total, squares = total + power, squares + power**2 / len(waves)
        return total, total**2 / squares if squares > 0.0 else float(self.freedom)


def predictor(healthy: Stretch) -> Predictor:
    """Learn from a healthy part, of which the last LEARNT_FROM samples are taken.

    Raises InvalidData for channels that are constant or exact combinations of others, and for too few samples.
    """
    r, u = healthy.r[-LEARNT_FROM:], healthy.u[-LEARNT_FROM:]
    moving = np.flatnonzero(np.ptp(u, axis=0) > 0.0)
    u = u[:, moving]
    few = f"{counted(len(healthy), 'sample')} without fault are too few to say what a change of {counted(r.shape[1], 'output')} is worth"
    if int(COSINES * len(r) ** (2 / 3)) < r.shape[1] + 2:
        raise InvalidData(f"{few}: state more of them")
    scales = channel_sizes(r - r.mean(axis=0))
    input_scales = channel_sizes(u - u.mean(axis=0)) if u.shape[1] else np.ones(0)
    spread = r.std(axis=0)
    r, u = r / scales, u / input_scales
    p, n_u = r.shape[1], u.shape[1]
    lags = number_of_lags(r - r.mean(axis=0), u - u.mean(axis=0))
    past, now = lagged(r, u, lags)
    X = np.hstack([np.ones((len(now), 1)), past])
    freedom = int(COSINES * len(now) ** (2 / 3))
    if freedom < p + 2 or len(now) <= X.shape[1] + freedom:
        raise InvalidData(f"{few}: state more of them")
    factor, triangle = np.linalg.qr(X)
    root = np.asarray(np.linalg.inv(triangle)).T
    coefficients = root.T @ (factor.T @ now)
    e = now - X @ coefficients
    share = 1.0 - X.shape[1] / len(now)
    width = p + n_u
    return Predictor(
        scales=scales,
        moving=moving,
        input_scales=input_scales,
        constant=coefficients[0],
        steps=coefficients[1 : 1 + lags * width].reshape(lags, width, p).transpose(0, 2, 1),
        direct=coefficients[1 + lags * width :].T,
        root=root,
        regressors=X,
        e=e,
        share=share,
        waves=np.asarray(scipy.fft.dct(e, type=2, axis=0, norm="ortho"))[1:] / np.sqrt(share),
        freedom=freedom,
        spread=spread,
    )
