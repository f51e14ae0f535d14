"""This computes what the two routes of the compression must cost at least, and how they grow.

With L = 2 s lags, c = n_u + p channels and k = 2 s n_u + s p rows of the Hankel matrix [Uf; Up; Yf] of N samples:

    displacement    2 N L c^2 flops: every correlation of the joint signal at L lags, once
    QR              2 N k^2 flops: Householder's, of the N by k matrix
    plain Gram      N k^2 flops: its symmetric square by dsyrk, told for comparison

Rates       dgemm and dsyrk in flops a second, one thread, the best seen
measure_rates
bound       the seconds that a route takes at the dgemm rate
exponent    least-squares slope of log seconds against log x
growth      the settings in which N, s and the channels grow one at a time
"""

from __future__ import annotations

import json
import subprocess
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import log

import numpy as np

from benchmarks.identification_cells import RESULT, ROOT, environment, python_command
from benchmarks.identification_data import Setting

SIZE = 1024
BEST_OF = 8


@dataclass(frozen=True)
class Rates:
    """The rates are in flops a second."""

    dgemm: float
    dsyrk: float


def flops(route: str, setting: Setting) -> float:
    """Return the operations of "ours-gram", "ours-qr", or "plain Gram"."""
    N, s, c = setting.samples, setting.block_rows, setting.n_u + setting.p
    k = 2 * s * setting.n_u + s * setting.p
    return {"ours-gram": 2.0 * N * 2 * s * c**2, "ours-qr": 2.0 * N * k**2, "plain Gram": 1.0 * N * k**2}[route]


def bound(route: str, setting: Setting, rates: Rates) -> float:
    """The bound is in seconds."""
    return flops(route, setting) / (rates.dsyrk if route == "plain Gram" else rates.dgemm)


def rates_here() -> Rates:
    """Measure the rates in this process, whose libraries must have one thread."""
    from scipy.linalg import blas

    matrix = np.asfortranarray(np.random.default_rng(1).standard_normal((SIZE, SIZE)))
    return Rates(2.0 * SIZE**3 / _least(lambda: blas.dgemm(1.0, matrix, matrix)), 1.0 * SIZE**3 / _least(lambda: blas.dsyrk(1.0, matrix)))


def measure_rates() -> Rates:
    """The rates are measured in a process with one thread."""
    printed = subprocess.run(python_command("rates"), cwd=ROOT, env=environment(), capture_output=True, check=True, text=True).stdout
    return Rates(**json.loads(printed[len(RESULT) :]))


def best(*measured: Rates) -> Rates:
    """Return the highest rates: on a busy machine the ones nearest the truth, and the strictest for us."""
    return Rates(max(each.dgemm for each in measured), max(each.dsyrk for each in measured))


def _least(call: Callable[[], object]) -> float:
    times = []
    for _ in range(BEST_OF):
        start = time.process_time()
        call()
        times.append(time.process_time() - start)
    return min(times)


def exponent(points: Sequence[tuple[float, float]]) -> float | None:
    """Return the slope through (x, seconds); None with fewer than three points."""
    if len(points) < 3:
        return None
    x, y = np.log(np.array(points, dtype=np.float64)).T
    return float(np.polyfit(x, y, 1)[0]) if log(max(p[0] for p in points)) > log(min(p[0] for p in points)) else None


def growth(quick: bool) -> dict[str, list[Setting]]:
    """The settings by what grows; the quick ones are shorter."""
    samples = 30_000 if quick else 100_000
    lengths = (10_000, 30_000, 100_000) if quick else (100_000, 300_000, 1_000_000)
    return {
        "N": [Setting(2, 3, 20, length) for length in lengths],
        "s": [Setting(2, 3, s, samples) for s in (5, 10, 20, 40)],
        "n_u + p": [Setting(c, c, 10, samples) for c in (1, 2, 4, 8)],
    }


def grown(name: str, setting: Setting) -> float:
    """This is what grows, as a number."""
    return float({"N": setting.samples, "s": setting.block_rows, "n_u + p": setting.n_u + setting.p}[name])
