"""This measures how near the fault space of a noisy residual comes to the true one, how honest its uncertainty is, and what it costs.

    python benchmarks/fault_space.py [--trials 20] [--seed 1]

Systems of the paper's kind (n = 5, p = 3, n_v = 2, 0 to 3 finite zeros, the study's faults, low-pass noise 40 dB below each output), the
true A, C, and n_v given. Largest principal angle to the true space in degrees, medians:

    as published    null rows of R_5, rank and n_z given          rows           all kernel rows by likelihood, one at a time
    lag + 1         the same with the least window that suffices  likelihood     fault_space_by_likelihood, nothing but n_v given
    random          a random space of the dimension of the truth

A wrong number of columns counts as 90 degrees. zeta: right / undecided / wrong, of the likelihood form and of the least-squares form.
cover: share of the cases (number of columns right) whose angle is below the stated angle of 95 %. Then systems with p - n_v = 2, and
seconds against the window. One seed a trial: results do not depend on the order of the cells.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray

from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.ranks.sample_windows import hankel_factor
from faultspace.numeric.method.space import by_likelihood as noisy_fault_space
from faultspace.numeric.method.space.by_likelihood import fault_space_by_likelihood
from faultspace.numeric.method.space.by_ranks import fault_space
from faultspace.numeric.method.space.distances import principal_angles
from faultspace.numeric.method.space.estimate import FaultSpaceEstimate, kernel_conditions
from faultspace.numeric.study.random_systems import study_system
from faultspace.numeric.study.runs import coloured_noise, study_faults

Array = NDArray[np.float64]

LEVEL = 0.01
SHAPES = ((4, 4, 2), (5, 3, 1))
"""States, outputs, faults of the systems with two kernel rows."""
WINDOWS = (10, 20, 30, 60)


@dataclass(frozen=True)
class Trial:
    """This is a residual r (N, p) with the truth about it: A, C, Z (n + p, n_v + zeros), n_v."""

    r: Array
    A: Array
    C: Array
    Z: Array
    n_v: int


def paper_like(zeros: int, samples: int, seed: int) -> Trial:
    """This is a system of the study."""
    system = study_system(zeros, np.random.SeedSequence([seed, zeros]))
    rng = np.random.default_rng([seed, zeros, samples])
    model = StateSpaceModel(system.model.A, system.F, system.model.C, system.G)
    r = _noisy(model.simulate(study_faults(samples, rng), rng.standard_normal(model.n)), rng)
    return Trial(r, model.A, model.C, system.Z, 2)


def two_rows(shape: tuple[int, int, int], samples: int, seed: int) -> Trial:
    """Return a random stable system without zeros and with two kernel rows more than none."""
    n, p, n_v = shape
    rng = np.random.default_rng([seed, *shape, samples])
    A = rng.standard_normal((n, n))
    A *= rng.uniform(0.5, 0.95) / np.max(np.abs(np.linalg.eigvals(A)))
    F, C, G = (rng.standard_normal(size) for size in ((n, n_v), (p, n), (p, n_v)))
    r = StateSpaceModel(A, F, C, G).simulate(study_faults(samples, rng)[:, :n_v], rng.standard_normal(n))
    return Trial(_noisy(r, rng), A, C, np.vstack([F, G]), n_v)


def _noisy(r: Array, rng: np.random.Generator) -> Array:
    noise = coloured_noise(len(r), r.shape[1], rng)
    return np.asarray(r + LEVEL * noise / noise.std(axis=0) * r.std(axis=0))


def angle(trial: Trial, basis: Array) -> float:
    """Return the largest angle to the true space in degrees, 90 for a wrong number of columns."""
    return 90.0 if basis.shape != trial.Z.shape else float(np.degrees(principal_angles(trial.Z, basis)[-1]))


def by_null_rows(trial: Trial, s: int) -> Array:
    """The published way at window s: rank and n_z given, left singular vectors of R_s beyond the rank, no weights."""
    n, p, n_z = len(trial.A), len(trial.C), trial.Z.shape[1]
    rank = n + s * trial.n_v - (n_z - trial.n_v)
    if rank >= p * s:
        return np.eye(n + p)[:, :n_z]  # Every column is a solution: any n_z of them.
    rows = np.linalg.svd(hankel_factor(trial.r, s))[0][:, rank:].T.reshape(-1, s, p)
    conditions = kernel_conditions(rows, trial.A, trial.C).reshape(-1, n + p)
    return np.asarray(np.linalg.svd(conditions)[2][n + p - n_z :].T)


def one_at_a_time(trial: Trial) -> FaultSpaceEstimate:
    """Return the estimate of the likelihood form without its joint step."""
    with patch.object(noisy_fault_space, "joint_basis", return_value=None):
        return fault_space_by_likelihood(trial.r, trial.A, trial.C, n_v=trial.n_v)


def verdicts(trials: list[Trial], answers: list[FaultSpaceEstimate]) -> str:
    """Return how often the number of zeros is right / undecided / wrong."""
    right = sum(a.decided and a.n_z == t.Z.shape[1] for t, a in zip(trials, answers, strict=True))
    undecided = sum(not a.decided for a in answers)
    return f"{right}/{undecided}/{len(answers) - right - undecided}"


def coverage(trials: list[Trial], answers: list[FaultSpaceEstimate]) -> str:
    """Hits of the angle of 95 % among the answers with the right number of columns."""
    stated = [(t, a) for t, a in zip(trials, answers, strict=True) if a.n_z == t.Z.shape[1] and a.uncertainty]
    hits = sum(angle(t, a.basis) <= np.degrees(a.uncertainty.angle()) for t, a in stated if a.uncertainty)
    return f"{hits} of {len(stated)}"


def line(label: str, samples: int, trials: list[Trial], seed: int) -> str:
    """This writes one row of the table."""
    answers = [fault_space_by_likelihood(t.r, t.A, t.C, n_v=t.n_v) for t in trials]
    rng = np.random.default_rng(seed)
    lags = [-(-(len(t.A) - t.Z.shape[1] + t.n_v) // (len(t.C) - t.n_v)) for t in trials]
    columns = [
        [angle(t, by_null_rows(t, 5)) for t in trials],
        [angle(t, by_null_rows(t, lag + 1)) for t, lag in zip(trials, lags, strict=True)],
        [angle(t, one_at_a_time(t).basis) for t in trials],
        [angle(t, a.basis) for t, a in zip(trials, answers, strict=True)],
        [angle(t, np.linalg.qr(rng.standard_normal(t.Z.shape))[0]) for t in trials],
    ]
    medians = "".join(f"{np.median(column):>13.3g}" for column in columns)
    counts = f"{verdicts(trials, answers):>10}{coverage(trials, answers):>10}"
    return f"{label:<22}{samples:>6}{medians}{counts}"


def seconds_by_window(seed: int) -> str:
    """Time the paper's example, p = 2, N = 1001, s = 10 .. 60: seconds of the exact-rank form, and the exponent of the growth."""
    A = np.array([[0, 1, 0], [0, 0, 1], [-0.25, 0.75, 0.25]])
    root = float(min(np.roots([4, -1, -3, 1]).real))
    F, C = np.array([[1.0], [root], [root**2]]), np.eye(2, 3)
    v = study_faults(1001, np.random.default_rng(seed))[:, :1]
    r = StateSpaceModel(A, F, C, np.zeros((2, 1))).simulate(v, np.ones(3))
    spent = []
    for s in WINDOWS:
        runs = []
        for _ in range(5):
            start = time.perf_counter()
            fault_space(r, A, C, block_rows=s)
            runs.append(time.perf_counter() - start)
        spent.append(min(runs))
    slope = np.polyfit(np.log(WINDOWS), np.log(spent), 1)[0]
    return ", ".join(f"s = {s}: {t:.3f} s" for s, t in zip(WINDOWS, spent, strict=True)) + f"; growth s^{slope:.2f}"


def main() -> None:
    """Measure every cell and print a line each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--trials", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    names = ("as published", "lag + 1", "rows", "likelihood", "random")
    heads = "".join(f"{name:>13}" for name in names) + f"{'zeta':>10}{'cover':>10}"
    print(f"{'system':<22}{'N':>6}{heads}", flush=True)
    seeds = range(1000 * arguments.seed, 1000 * arguments.seed + arguments.trials)
    for samples in (1001, 10000):
        for zeros in range(4):
            trials = [paper_like(zeros, samples, seed) for seed in seeds]
            print(line(f"paper-like, {zeros} zeros", samples, trials, arguments.seed), flush=True)
        for shape in SHAPES:
            trials = [two_rows(shape, samples, seed) for seed in seeds]
            print(line(f"n, p, n_v = {shape[0]}, {shape[1]}, {shape[2]}", samples, trials, arguments.seed), flush=True)
    print("seconds, noise-free, the paper's example:", seconds_by_window(arguments.seed))


if __name__ == "__main__":
    main()
