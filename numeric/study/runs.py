"""This makes what is measured in the Monte Carlo study: inputs, faults and noise of one run, each from the run's own seed.

    StudyRun         inputs u, outputs y, faults v of one run, with the noise that was added
    study_run        one run of a system
    study_faults     v1 = sin(0.25 t^1.3) + 0.1, v2 = 1 - 0.99^t + white noise; study_chirp and study_rise their parts without chance
    coloured_noise   white noise through the low-pass of the study
    response         y from u and x0 by one recursive filter with the poles of A: what a small model needs
    NOISE_GAIN       standard deviation of that noise for white noise of deviation one: the reason why "1 %" is 43 dB

The published run draws one u and one v for all systems; here every system has its own, so that cases are independent. Source: [G25]
section V.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.signal

from ...base.arrays import Array
from ..data.validation import positive
from ..method.model.models import StateSpaceModel, observability_matrix
from .random_systems import N_U, N_X, P, StudySystem

SAMPLES = 1001
LOW_PASS = (0.17, 0.5, 0.5, 0.17), (1.0, 0.0, 0.33, 0.0)  # of the published study [G25]


def _noise_gain() -> float:
    impulse = np.zeros(500)
    impulse[0] = 1.0
    return float(np.linalg.norm(scipy.signal.lfilter(*LOW_PASS, impulse)))


NOISE_GAIN = _noise_gain()


@dataclass(frozen=True, eq=False)
class StudyRun:
    """The run has u (N, n_u), y (N, p) with noise and v (N, n_v); the noise lies `decibels` below the outputs' standard deviation, on
    average."""

    u: Array
    y: Array
    v: Array
    decibels: float


def study_run(system: StudySystem, seed: np.random.SeedSequence | int, *, level: float, samples: int = SAMPLES) -> StudyRun:
    """Simulate one run: u is white and normal, the faults are those of the study, the noise is `level` times each output's standard
    deviation through the low-pass of the study.

    level = 0.01 is the published setting; level = 0.01 / NOISE_GAIN makes noise of 1 % in fact. The same seed makes the same u, v and
    noise shape for every level. Raises InvalidData for `samples` below one.
    """
    samples = positive(samples, "samples")
    rng = np.random.default_rng(seed)
    u, v, x0 = rng.standard_normal((samples, N_U)), study_faults(samples, rng), rng.standard_normal(N_X)
    plain = system.model
    whole = StateSpaceModel(plain.A, np.hstack([plain.B, system.F]), plain.C, np.hstack([plain.D, system.G]))
    clean = response(whole, np.hstack([u, v]), x0)
    by_channel = np.ascontiguousarray(clean.T)  # sums over its rows are faster
    noise = level * by_channel.std(axis=1, ddof=1) * coloured_noise(samples, P, rng)
    ratios = by_channel.std(axis=1) / np.ascontiguousarray(noise.T).std(axis=1) if level > 0 else np.array([np.inf])
    decibels = float(np.mean(20 * np.log10(ratios)))
    return StudyRun(u, clean + noise, v, decibels)


def response(model: StateSpaceModel, u: Array, x0: Array) -> Array:
    """Return y (N, p) of a model of few states for u (N, n_u) and x(0) = x0 (n,).

    With a(q) the characteristic polynomial of A, a(q) y is a finite sum of past inputs, and of x0 in the first n samples. The
    recursion by a costs nothing to set up; it loses digits where many poles crowd, so large models use `StateSpaceModel.simulate`.
    """
    n, p, samples = model.n, model.p, len(u)
    characteristic = np.poly(np.linalg.eigvals(model.A)).real
    # C A^l [B x0], l = 0..n-1, and below them D: the Markov parameters and the free response.
    effects = (observability_matrix(model.A, model.C, n) @ np.column_stack([model.B, x0])).reshape(n, p, -1)
    forced = np.concatenate([model.D[np.newaxis], effects[:, :, :-1]])
    lags = np.subtract.outer(np.arange(n + 1), np.arange(n + 1))
    times_characteristic = np.where(lags >= 0, characteristic[np.abs(lags)], 0.0)
    numerator = np.tensordot(times_characteristic, forced, 1)
    lagged = np.zeros((samples, n + 1, model.n_u))
    for lag in range(min(n + 1, samples)):
        lagged[lag:, lag] = u[: samples - lag]
    driven = lagged.reshape(samples, -1) @ numerator.swapaxes(1, 2).reshape(-1, p)
    driven[:n] += (times_characteristic[:n, :n] @ effects[:, :, -1])[:samples]
    return np.asarray(scipy.signal.lfilter([1.0], characteristic, driven, axis=0), dtype=np.float64)


def study_faults(samples: int, rng: np.random.Generator) -> Array:
    """Return (samples, 2): a chirp of rising frequency with an offset, and a slow rise buried in white noise."""
    return np.column_stack([study_chirp(samples), study_rise(samples) + rng.standard_normal(samples)])


def study_chirp(samples: int) -> Array:
    """Return the first fault (samples,)."""
    return np.asarray(np.sin(0.25 * np.arange(samples) ** 1.3) + 0.1, dtype=np.float64)


def study_rise(samples: int) -> Array:
    """Return the second fault (samples,) without its noise."""
    return np.asarray(1 - 0.99 ** np.arange(samples), dtype=np.float64)


def coloured_noise(samples: int, channels: int, rng: np.random.Generator) -> Array:
    """Return (samples, channels) of white normal noise through the low-pass, from rest as published: standard deviation NOISE_GAIN."""
    return np.asarray(scipy.signal.lfilter(*LOW_PASS, rng.standard_normal((samples, channels)), axis=0), dtype=np.float64)
