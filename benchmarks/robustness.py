"""This shows what `arx_reduction` does where its assumptions fail: how far the model is off, and what it says of itself.

    OPENBLAS_NUM_THREADS=1 python benchmarks/robustness.py [--systems 8] [--seed 1]

Each row changes one thing about records of `2in3out white` (4 states, 3 outputs, 2 inputs, one strong coloured fault, N = 1000), or takes
others. Error: of the first 20 Markov parameters, over the Cramer-Rao bound of the record as it was before the change; stated: over the size
that the model states itself. Both are medians, of the records that got a model. Told: how many records got a note or were refused, with
the first one's words. Seconds are CPU seconds a record.

    closed loop     u = r - gain / |gain of the plant| times the mean of the outputs one sample before: the loop has a delay
    missing         samples not recorded at random; what lies between is given as experiments, where it has LEAST samples
    hardly seen     one state's column of C a thousandth of what it was; from there on plants are random, without a bound
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import scipy.signal
from at_the_bound_cells import CELLS, Trial
from numpy.typing import NDArray

from faultspace.base.errors import InvalidData
from faultspace.numeric import ReducedModel, Spectra, StateSpaceModel, arx_reduction, arx_reduction_experiments
from faultspace.numeric.study.driving_spectra import white
from faultspace.numeric.study.information_bound import COUNT, cramer_rao

Array = NDArray[np.float64]
Estimate = Callable[[Trial, np.random.Generator], ReducedModel]

N = 1000
LEAST = 20
CELL = next(cell for cell in CELLS if cell.name == "2in3out white")


@dataclass(frozen=True)
class Answer:
    """One record: errors over the bound and over what is stated, NaN without a model; what was told; CPU seconds."""

    error: float
    stated: float
    told: str
    seconds: float


def with_order(more: int) -> Estimate:
    """Return the estimate of a model told so many states more than there are."""
    return lambda trial, _: arx_reduction(trial.y, trial.u, order=trial.model.n + more)


def disturbed(change: Callable[[Array, np.random.Generator], Array]) -> Estimate:
    """Return the estimate from outputs to which `change` adds something, in units of their deviations."""

    def estimate(trial: Trial, rng: np.random.Generator) -> ReducedModel:
        deviations = trial.y.std(axis=0)
        return arx_reduction(trial.y + deviations * change(trial.y, rng), trial.u, order=trial.model.n)

    return estimate


def outliers(share: float) -> Callable[[Array, np.random.Generator], Array]:
    """Return what adds ten deviations to that share of the samples of each output."""
    return lambda y, rng: np.asarray(10.0 * (rng.random(y.shape) < share) * rng.choice((-1.0, 1.0), y.shape))


def missing(share: float) -> Estimate:
    """Return the estimate without that share of the samples."""

    def estimate(trial: Trial, rng: np.random.Generator) -> ReducedModel:
        gone = np.flatnonzero(rng.random(len(trial.y)) < share)
        pieces = [(y[1:], u[1:]) for y, u in zip(np.split(trial.y, gone), np.split(trial.u, gone), strict=True)]
        return arx_reduction_experiments([piece for piece in pieces if len(piece[0]) >= LEAST], order=trial.model.n)

    return estimate


def not_a_number(trial: Trial, rng: np.random.Generator) -> ReducedModel:
    """Estimate from a record with a sample that is not a number."""
    y = trial.y.copy()
    y[rng.integers(len(y)), 0] = np.nan
    return arx_reduction(y, trial.u, order=trial.model.n)


def looped(gain: float) -> Estimate:
    """Return the estimate where u follows the mean of the outputs, one sample later: u = r - K y(k - 1), |K| |G(1)| = gain."""

    def estimate(trial: Trial, _: np.random.Generator) -> ReducedModel:
        model, r = trial.model, trial.u
        disturbance = trial.y - model.simulate(r)
        at_rest = model.C @ np.linalg.solve(np.eye(model.n) - model.A, model.B) + model.D
        K = gain / np.linalg.norm(at_rest, 2) * np.ones((model.n_u, model.p)) / np.sqrt(model.n_u * model.p)
        y, u, x = np.zeros_like(trial.y), r.copy(), np.zeros(model.n)
        for k in range(len(y)):
            u[k] -= K @ y[k - 1] if k else 0.0
            y[k] = model.C @ x + model.D @ u[k] + disturbance[k]
            x = model.A @ x + model.B @ u[k]
        return arx_reduction(y, u, order=model.n)

    return estimate


def step(y: Array, _: np.random.Generator) -> Array:
    """Return a constant fault of ten deviations in the second half, in the first output."""
    change = np.zeros_like(y)
    change[len(y) // 2 :, 0] = 10.0
    return change


def first(samples: int) -> Estimate:
    """Return the estimate from the first samples alone."""
    return lambda trial, _: arx_reduction(trial.y[:samples], trial.u[:samples], order=trial.model.n)


ROWS: Mapping[str, Estimate] = {
    "as it is": with_order(0),
    "order two too low": with_order(-2),
    "order one too low": with_order(-1),
    "order one too high": with_order(1),
    "order two too high": with_order(2),
    "outliers of 10 deviations, 0.1 %": disturbed(outliers(0.001)),
    "outliers of 10 deviations, 1 %": disturbed(outliers(0.01)),
    "a sample that is not a number": not_a_number,
    "missing samples, 1 %": missing(0.01),
    "missing samples, 3 %": missing(0.03),
    "drift: a line of 10 deviations": disturbed(lambda y, _: np.linspace(0.0, 10.0, len(y))[:, None] * np.ones_like(y)),
    "drift: a random walk of 10 deviations": disturbed(lambda y, rng: np.cumsum(rng.standard_normal(y.shape), axis=0) * 10 / len(y) ** 0.5),
    "a constant fault of 10 deviations, from the middle on": disturbed(step),
    "an operating point 1e4 deviations away": disturbed(lambda y, _: 1e4 * np.ones_like(y)),
    "closed loop, gain 0.1": looped(0.1),
    "closed loop, gain 0.5": looped(0.5),
    "N = 400": first(400),
    "N = 200": first(200),
    "N = 100": first(100),
    "N = 50": first(50),
    "N = 30": first(30),
    "N = 12": first(12),
}


def made(rng: np.random.Generator, p: int, faint: float) -> Trial:
    """Draw a record of 4 states, 2 inputs and p outputs, 3 AR(1) faults, noise 40 dB down; one state is seen `faint` times as well as the
    others. Its bound is not asked for, nor are the spectra."""
    A = np.diag([0.9, 0.5, -0.3, -0.8])
    B, C, D = (rng.standard_normal(shape) for shape in ((4, 2), (p, 4), (p, 2)))
    plant = StateSpaceModel(A, B, C * np.array([1.0, faint, 1.0, 1.0]), D)
    u = rng.standard_normal((N, 2))
    faults = scipy.signal.lfilter([1.0], [1.0, -0.9], rng.standard_normal((N, 3)), axis=0)
    clean = plant.simulate(u) + faults @ rng.standard_normal((3, p))
    return Trial(clean + 0.01 * clean.std(axis=0) * rng.standard_normal(clean.shape), u, plant, Spectra(white(np.eye(2)), white(np.eye(p))))


def answered(estimate: Estimate, trial: Trial, bound: float, rng: np.random.Generator) -> Answer:
    """Return what one record gives; `bound` is the root of the bound's trace."""
    started = time.process_time()
    try:
        found = estimate(trial, rng)
    except InvalidData as refusal:
        return Answer(float("nan"), float("nan"), f"refused: {refusal}", time.process_time() - started)
    seconds = time.process_time() - started
    error = float(np.linalg.norm(found.model.markov(COUNT) - trial.model.markov(COUNT)))
    stated = float(np.linalg.norm(found.uncertainty.markov(COUNT)))
    return Answer(error / bound, error / stated, "; ".join(found.notes), seconds)


def line(name: str, answers: list[Answer]) -> str:
    """Return one row of the table."""
    models = [one for one in answers if np.isfinite(one.stated)]
    figures = [f"{np.median([getattr(one, key) for one in models]):.2f}" if models else "" for key in ("error", "stated")]
    told = [one.told for one in answers if one.told]
    words = f"{len(told)}: {told[0]}" if told else "0"
    seconds = np.mean([one.seconds for one in answers])
    columns = [name, f"{len(models)} of {len(answers)}", *(figure.replace("nan", "") for figure in figures), words, f"{seconds:.2f}"]
    return f"| {' | '.join(columns)} |"


def main() -> None:
    """Print the table in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--systems", type=int, default=8, help="records a row")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    print(f"seed {options.seed}\n\n| record | models | error / bound | error / stated | told | seconds |\n|{'---|' * 6}")
    trials = [CELL.trial(options.seed, number, N) for number in range(options.systems)]
    bounds = [float(np.linalg.norm(cramer_rao(trial.model, trial.spectra, N).markov(COUNT))) for trial in trials]
    for name, estimate in ROWS.items():
        rngs = (np.random.default_rng([options.seed, number]) for number in range(options.systems))
        print(line(name, [answered(estimate, *one) for one in zip(trials, bounds, rngs, strict=True)]), flush=True)
    for name, p, faint in (("hardly seen", 3, 1e-3), ("not seen at all", 3, 0.0), ("10 outputs", 10, 1.0), ("28 outputs", 28, 1.0)):
        rngs = [np.random.default_rng([options.seed, p, number]) for number in range(options.systems)]
        drawn = [made(rng, p, faint) for rng in rngs]
        answers = [answered(with_order(0), trial, float("nan"), rng) for trial, rng in zip(drawn, rngs, strict=True)]
        print(line(name, answers), flush=True)


if __name__ == "__main__":
    main()
