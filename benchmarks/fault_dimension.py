"""This measures how often the fault dimension is right, undecided or wrong, on data like the paper's and on harder ones.

    python benchmarks/fault_dimension.py [--trials 30] [--seed 1] [--samples 1001] [--markdown]

Systems: n = 5 states, random (A, F, C, G), G zero for every other one, spectral radius .5 to .95; the paper's fault signals (a chirp with
an offset; a settling step plus white noise) and, for more faults, coloured noise; measurement noise through the paper's low-pass filter
at the stated level below each output's standard deviation, for `spread` 10 at levels from that level to ten times lower, evenly in
decibels over the outputs. One seed a trial: rates do not depend on the order of cells.

    true           residual with the true model
    identified     with the model that PI-MOESP finds in the same faulty record (order given, s = 20), u handed over
    without u      the same, u kept back
    healthy        identified, against the residual of a second record of the same plant without fault and the same model

What the constants of the rules are worth, `constants.py` measures on the same draws.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from dataclasses import dataclass

import numpy as np
import scipy.signal
from numpy.typing import NDArray

from faultspace.numeric.method.model.past_inputs import pi_moesp
from faultspace.numeric.method.model.residuals import residual
from faultspace.numeric.method.ranks.rank_gap import fault_dimension
from faultspace.numeric.plant.healthy.against_healthy import fault_dimension_against_healthy
from faultspace.numeric.plant.healthy.healthy_model import healthy_reference

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Cell:
    """A cell has p outputs, m faults, noise so many decibels below them, a ratio of its levels, and a source of the residual."""

    p: int
    m: int
    decibel: float
    spread: float = 1.0
    model: str = "true"


CELLS = (
    *(Cell(3, m, decibel, spread, "true") for decibel in (40.0, 20.0) for spread in (1.0, 10.0) for m in (1, 2, 3)),
    *(Cell(3, m, decibel, spread, "identified") for decibel in (40.0, 20.0) for spread in (1.0, 10.0) for m in (1, 2, 3)),
    *(Cell(3, m, decibel, spread, "healthy") for decibel in (40.0, 20.0) for spread in (1.0, 10.0) for m in (0, 1, 2, 3)),
    *(Cell(3, m, 40.0, 1.0, "without u") for m in (1, 2, 3)),
    *(Cell(4, m, 40.0) for m in (1, 2, 3, 4)),
    *(Cell(2, m, 40.0) for m in (1, 2)),
    *(Cell(3, m, np.inf) for m in (1, 2, 3)),
)


def fault_signals(random: np.random.Generator, samples: int, m: int) -> Array:
    """m fault signals (samples, m): the paper's two, then coloured noise."""
    t = np.arange(samples)
    signals = [np.sin(0.25 * t**1.3) + 0.1, 1.0 - 0.99**t + random.standard_normal(samples)]
    while len(signals) < m:
        pole = random.uniform(-0.8, 0.8)
        signals.append(scipy.signal.lfilter([1.0], [1.0, -pole], random.standard_normal(samples)))
    return np.stack(signals, axis=1)[:, :m]


@dataclass(frozen=True)
class Plant:
    """A random plant with faults; records of it share its noise levels (p,)."""

    A: Array
    B: Array
    C: Array
    D: Array
    F: Array
    G: Array

    def respond(self, state: Array, u: Array, v: Array) -> tuple[Array, Array]:
        """Return what v (and the initial state) and what u do to the outputs, (N, p) each."""
        driven = np.zeros(len(self.A))
        by_fault, by_input = np.empty((len(u), len(self.C))), np.empty((len(u), len(self.C)))
        for k in range(len(u)):
            by_fault[k], by_input[k] = self.C @ state + self.G @ v[k], self.C @ driven + self.D @ u[k]
            state, driven = self.A @ state + self.F @ v[k], self.A @ driven + self.B @ u[k]
        return by_fault, by_input


def random_plant(random: np.random.Generator, p: int, m: int, n: int = 5) -> Plant:
    """This draws one plant with one input."""
    A = random.standard_normal((n, n))
    A *= random.uniform(0.5, 0.95) / np.max(np.abs(np.linalg.eigvals(A)))
    B, D = random.standard_normal((n, 1)), random.standard_normal((p, 1))
    C, F = random.standard_normal((p, n)), random.standard_normal((n, m))
    return Plant(A, B, C, D, F, random.standard_normal((p, m)) * random.integers(2))


def noise(random: np.random.Generator, samples: int, levels: Array) -> Array:
    """Return low-pass noise of the paper with these standard deviations."""
    white = random.standard_normal((samples + 64, len(levels)))
    low = scipy.signal.lfilter([0.17, 0.5, 0.5, 0.17], [1.0, 0.0, 0.33, 0.0], white, axis=0)[64:]
    return np.asarray(low / low.std(axis=0) * levels)


def answer(cell: Cell, random: np.random.Generator, samples: int) -> int | None:
    """This is the n_v that one trial of a cell finds."""
    r, u, quiet, before = residuals(cell, random, samples)
    if cell.model == "healthy":
        return fault_dimension_against_healthy(r, healthy_reference(quiet, before), u=u).n_v
    return fault_dimension(r, u=u if cell.model == "identified" else None).n_v


def residuals(cell: Cell, random: np.random.Generator, samples: int) -> tuple[Array, Array, Array, Array]:
    """Return the residual of one trial of a cell with its inputs, and those of a record without fault, which are empty where none is
    asked."""
    plant, none = random_plant(random, cell.p, cell.m), np.zeros((0, cell.p))
    state, u, v = random.standard_normal(5), random.standard_normal((samples, 1)), fault_signals(random, samples, cell.m)
    by_fault, by_input = plant.respond(state, u, v)
    levels = np.zeros(cell.p)
    if np.isfinite(cell.decibel):
        levels = (by_fault + by_input).std(axis=0) * 10.0 ** (-cell.decibel / 20.0) * np.geomspace(1.0, 1.0 / cell.spread, cell.p)
        by_fault = by_fault + noise(random, samples, levels)
    if cell.model == "true":
        return by_fault, u, none, none
    model = pi_moesp(by_fault + by_input, u, order=5, block_rows=20).model
    r = residual(by_fault + by_input, u, model).r
    if cell.model != "healthy":
        return r, u, none, none
    before = random.standard_normal((samples, 1))
    quiet = sum(plant.respond(random.standard_normal(5), before, np.zeros((samples, cell.m)))) + noise(random, samples, levels)
    return r, u, residual(quiet, before, model).r, before


def main() -> None:
    """Measure every cell and print a line each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--trials", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--samples", type=int, default=1001)
    parser.add_argument("--model", choices=sorted({cell.model for cell in CELLS}), help="only these cells")
    parser.add_argument("--markdown", action="store_true", help="print a table in Markdown")
    arguments = parser.parse_args()
    heads = ("model", "outputs", "faults", "noise", "spread", "right", "undecided", "wrong", "answers", "seconds")
    print(f"{arguments.trials} trials a row, N = {arguments.samples}")
    row = "{:>10} {:>7} {:>6} {:>7} {:>6} {:>5} {:>9} {:>5}  {} {}"
    if arguments.markdown:
        row = "| {} |".format(" | ".join(["{}"] * len(heads)))
    print(row.format(*heads))
    if arguments.markdown:
        print("|---" * len(heads) + "|")
    for cell in CELLS:
        if arguments.model not in (None, cell.model):
            continue
        counts: Counter[int | None] = Counter()
        start = time.perf_counter()
        for trial in range(arguments.trials):
            random = np.random.default_rng((arguments.seed, cell.p, cell.m, trial))
            counts[answer(cell, random, arguments.samples)] += 1
        seconds = (time.perf_counter() - start) / arguments.trials
        undecided, right = counts.pop(None, 0), counts[cell.m]
        level = "none" if np.isinf(cell.decibel) else f"-{cell.decibel:g} dB"
        wrong = arguments.trials - right - undecided
        said = " ".join(f"{n_v}x{count}" for n_v, count in sorted((+counts).items())) or "-"
        figures = (cell.model, cell.p, cell.m, level, f"{cell.spread:g}", right, undecided, wrong, said, f"{seconds:.2f}")
        print(row.format(*figures), flush=True)


if __name__ == "__main__":
    main()
