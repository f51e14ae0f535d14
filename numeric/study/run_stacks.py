"""Many runs of the study are measured at once; channels lie along the second axis and samples along the last, where filters are fastest.

RunStack     inputs, outputs with noise, and the noise's decibels of k runs
study_runs   the runs that `study_run` makes of these seeds, each from its own seed
responses    y of many models of the same size to as many inputs: `response` for a stack
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.signal

from ...base.arrays import Array
from .random_systems import N_U, N_X, P
from .runs import LOW_PASS, study_chirp, study_rise
from .system_stacks import SystemStack


@dataclass(frozen=True, eq=False)
class RunStack:
    """The runs have u (k, n_u, N), y (k, p, N) with noise, and `decibels` (k,) as `StudyRun` has them."""

    u: Array
    y: Array
    decibels: Array


def study_runs(systems: SystemStack, seeds: Sequence[np.random.SeedSequence], *, level: float, samples: int) -> RunStack:
    """Return the run of `study_run` for each system and seed; the level of the noise is above zero."""
    generators = [np.random.default_rng(seed) for seed in seeds]
    first = N_U * samples
    normal = np.array([rng.standard_normal(first + samples + N_X + P * samples) for rng in generators])
    u, rise, x0, noise = np.split(normal, (first, first + samples, first + samples + N_X), axis=1)
    inputs = np.empty((len(normal), N_U + 2, samples))
    inputs[:, :N_U] = u.reshape(-1, samples, N_U).swapaxes(1, 2)
    inputs[:, N_U] = study_chirp(samples)
    inputs[:, N_U + 1] = study_rise(samples) + rise
    B, D = np.concatenate([systems.B, systems.F], axis=2), np.concatenate([systems.D, systems.G], axis=2)
    y = responses(systems.A, B, systems.C, D, inputs, x0)
    sizes = y.std(axis=2, keepdims=True)
    by_channel = np.ascontiguousarray(noise.reshape(-1, samples, P).swapaxes(1, 2))
    # As `study_run`: the level is that of the standard deviation with one degree of freedom less.
    coloured = scipy.signal.lfilter(*LOW_PASS, by_channel) * (level * np.sqrt(samples / (samples - 1)) * sizes)
    decibels = 20 * np.log10(sizes / coloured.std(axis=2, keepdims=True))
    y += coloured
    return RunStack(inputs[:, :N_U], y, decibels.mean(axis=(1, 2)))


def responses(A: Array, B: Array, C: Array, D: Array, u: Array, x0: Array) -> Array:
    """Return y (k, p, N) of models A (k, n, n), B (k, n, n_u), C (k, p, n), D (k, p, n_u) for u (k, n_u, N) with N >= n and x(0) = x0
    (k, n)."""
    k, n, p, (n_u, samples) = len(A), A.shape[1], C.shape[1], u.shape[1:]
    characteristic = _characteristic(A)
    # C A^l [B x0], l = 0..n-1, and below them D.
    effects, block = np.empty((k, n, p, n_u + 1)), C
    starts = np.concatenate([B, x0[:, :, np.newaxis]], axis=2)
    for lag in range(n):
        effects[:, lag] = block @ starts
        block = block @ A
    forced = np.concatenate([D[:, np.newaxis], effects[..., :-1]], axis=1)
    lags = np.subtract.outer(np.arange(n + 1), np.arange(n + 1))
    times_characteristic = np.where(lags >= 0, characteristic[:, np.abs(lags)], 0.0)
    numerator = (times_characteristic @ forced.reshape(k, n + 1, -1)).reshape(k, n + 1, p, n_u)
    free = times_characteristic[:, :n, :n] @ effects[..., -1]
    taps = numerator.transpose(0, 2, 1, 3).reshape(k, p, -1)
    y, lagged = np.empty((k, p, samples)), np.zeros((n + 1, n_u, samples))
    for i in range(k):
        for lag in range(n + 1):
            lagged[lag, :, lag:] = u[i, :, : samples - lag]
        driven = taps[i] @ lagged.reshape(-1, samples)
        driven[:, :n] += free[i].T
        y[i] = scipy.signal.lfilter([1.0], characteristic[i], driven)
    return y


def _characteristic(A: Array) -> Array:
    """Return the coefficients (k, n + 1) of the characteristic polynomials, highest power first, by Faddeev and Le Verrier."""
    k, n = A.shape[:2]
    found, product = np.ones((k, n + 1)), np.broadcast_to(np.eye(n), A.shape)
    for i in range(1, n + 1):
        product = A @ product
        found[:, i] = -np.trace(product, axis1=1, axis2=2) / i
        product = product + found[:, i, np.newaxis, np.newaxis] * np.eye(n)
    return found
