"""How often the fault dimension is right, undecided or wrong, on data like the paper's and on harder ones.

    python benchmarks/fault_dimension.py [--trials 20] [--seed 1] [--samples 1001]

Systems: n = 5 states, random (A, F, C, G), G zero for every other one, spectral radius .5 to .95; the paper's fault signals (a chirp with
an offset; a settling step plus white noise) and, for more faults, coloured noise; measurement noise through the paper's low-pass filter
at the stated level below each output's standard deviation. Residuals with the true model. One seed a trial: rates do not depend on the
order of cells.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter

import numpy as np
import scipy.signal
from numpy.typing import NDArray

from faultspace.numeric.fault_dimension import fault_dimension

Array = NDArray[np.float64]

CELLS: tuple[tuple[int, int, float], ...] = (
    (3, 1, 40.0),
    (3, 2, 40.0),
    (4, 1, 40.0),
    (4, 2, 40.0),
    (4, 3, 40.0),
    (2, 1, 40.0),
    (3, 1, 20.0),
    (3, 2, 20.0),
    (2, 2, 40.0),
    (3, 3, 40.0),
    (4, 4, 40.0),
    (3, 1, np.inf),
    (3, 2, np.inf),
    (3, 3, np.inf),
)
"""Outputs, faults, level of the noise below the outputs in decibel."""


def fault_signals(random: np.random.Generator, samples: int, m: int) -> Array:
    """m fault signals (samples, m): the paper's two, then coloured noise."""
    t = np.arange(samples)
    signals = [np.sin(0.25 * t**1.3) + 0.1, 1.0 - 0.99**t + random.standard_normal(samples)]
    while len(signals) < m:
        pole = random.uniform(-0.8, 0.8)
        signals.append(scipy.signal.lfilter([1.0], [1.0, -pole], random.standard_normal(samples)))
    return np.stack(signals[:m], axis=1)


def faulty_residual(random: np.random.Generator, p: int, m: int, decibel: float, samples: int, n: int = 5) -> Array:
    """One residual (samples, p) with m faults."""
    A = random.standard_normal((n, n))
    A *= random.uniform(0.5, 0.95) / np.max(np.abs(np.linalg.eigvals(A)))
    B, D = random.standard_normal((n, 1)), random.standard_normal((p, 1))
    C, F = random.standard_normal((p, n)), random.standard_normal((n, m))
    G = random.standard_normal((p, m)) * random.integers(2)
    u, v = random.standard_normal((samples, 1)), fault_signals(random, samples, m)
    state, driven = random.standard_normal(n), np.zeros(n)
    r, y = np.empty((samples, p)), np.empty((samples, p))
    for k in range(samples):
        r[k], y[k] = C @ state + G @ v[k], C @ driven + D @ u[k]
        state, driven = A @ state + F @ v[k], A @ driven + B @ u[k]
    if np.isinf(decibel):
        return r
    white = random.standard_normal((samples + 64, p))
    noise = scipy.signal.lfilter([0.17, 0.5, 0.5, 0.17], [1.0, 0.0, 0.33, 0.0], white, axis=0)[64:]
    return r + noise / noise.std(axis=0) * (r + y).std(axis=0) * 10.0 ** (-decibel / 20.0)


def main() -> None:
    """Measure every cell and print a line each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--trials", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--samples", type=int, default=1001)
    arguments = parser.parse_args()
    print(f"{arguments.trials} trials a row, N = {arguments.samples}")
    print(f"{'outputs':>7} {'faults':>6} {'noise':>8} {'right':>6} {'undecided':>9} {'wrong':>6}   seconds a trial")
    for p, m, decibel in CELLS:
        counts: Counter[str] = Counter()
        start = time.perf_counter()
        for trial in range(arguments.trials):
            random = np.random.default_rng((arguments.seed, p, m, trial))
            n_v = fault_dimension(faulty_residual(random, p, m, decibel, arguments.samples)).n_v
            counts["undecided" if n_v is None else "right" if n_v == m else "wrong"] += 1
        seconds = (time.perf_counter() - start) / arguments.trials
        level = "none" if np.isinf(decibel) else f"-{decibel:g} dB"
        print(f"{p:7d} {m:6d} {level:>8} {counts['right']:6d} {counts['undecided']:9d} {counts['wrong']:6d}   {seconds:.2f}", flush=True)


if __name__ == "__main__":
    main()
