"""This measures how near models from faulty data come to the Cramer-Rao bound, by method, and how honest their standard errors are.

    python benchmarks/at_the_bound.py [--systems 24] [--seed 1] [--cells paper 2in3out] [--samples 200 1000 10000] [--jobs 1]
    python benchmarks/at_the_bound.py --calibrate lags | ladder | angles | starts
    python benchmarks/at_the_bound.py --orders

Error: Frobenius norm of the error of the first 20 Markov parameters over the root of the trace of their Cramer-Rao bound. A row a cell
and N: median with its 95 % bootstrap interval, and the 90 % quantile, of each method; a method that gives no model counts as infinite.

    pi 10, pi 20    PI-MOESP with 10 and 20 block rows          po 20     PO-MOESP with 20
    ours            arx_reduction                               ours n+1  the same told one order too high

cover: share of the Markov parameters that lie in their intervals of 95 %, and of the real parts of those poles that can be known to
DETERMINED: errors of others are not linear. seconds: CPU seconds of the reduction from the windows.

`--orders`: the order left open. Right: the choice is the true order, and no other is left open; open: the range holds it; below, above: the
range lies there. Least above: the least order that is not refused is above the true one, which should happen in one record of a hundred.
Errors over the bound of the model chosen, and of the one told its order; seconds of the choice. `--calibrate` shows ours with one constant
of the method changed, on the same records: what it was chosen by.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from unittest.mock import patch

import joblib
import numpy as np
from at_the_bound_cells import CELLS, Cell, Trial
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from faultspace.base.errors import InvalidData
from faultspace.numeric.method.model import arx_windows, reduced_model, reduction_search, weighted_reduction
from faultspace.numeric.method.model.asymptotic_likelihood import arx_reduction
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.model.past_inputs import pi_moesp
from faultspace.numeric.method.model.past_outputs import po_moesp
from faultspace.numeric.method.model.uncertainty import Uncertainty
from faultspace.numeric.study.information_bound import COUNT, cramer_rao, relative_error

Array = NDArray[np.float64]
Method = Callable[[Trial], StateSpaceModel]

METHODS: Mapping[str, Method] = {
    "pi 10": lambda trial: pi_moesp(trial.y, trial.u, order=trial.model.n, block_rows=10).model,
    "pi 20": lambda trial: pi_moesp(trial.y, trial.u, order=trial.model.n, block_rows=20).model,
    "po 20": lambda trial: po_moesp(trial.y, trial.u, order=trial.model.n, block_rows=20).model,
    "ours n+1": lambda trial: arx_reduction(trial.y, trial.u, order=trial.model.n + 1).model,
}
DETERMINED = 0.1
NORMAL = 1.959964
"""Deviations of a normal variable that hold 95 %."""

# For each constant: label -> what is replaced.
VARIANTS: Mapping[str, Mapping[str, tuple[tuple[object, str, object], ...]]] = {
    "lags": {f"{rate:g} N^1/3": ((arx_windows, "RATE", rate),) for rate in (0.8, 1.2, 1.6, 2.4, 3.2)},
    "ladder": {
        "10": ((weighted_reduction, "RUNG", 10.0),),
        "100": ((weighted_reduction, "RUNG", 100.0),),
        "none": ((weighted_reduction, "RUNG", 1e40),),
    },
    "angles": {f"{count}": ((reduced_model, "COARSE", count), (reduced_model, "FINE", count)) for count in (32, 64, 128, 256)},
    "starts": {f"{count} kept": ((reduction_search, "KEPT", count),) for count in (1, 2, 3)},
}


@dataclass(frozen=True)
class Outcome:
    """Errors by method; hits and number of intervals of Markov parameters and poles; CPU seconds."""

    errors: Mapping[str, float]
    covered: tuple[int, int, int, int] = (0, 0, 0, 0)
    seconds: float = float("nan")


@contextmanager
def changed(replacements: tuple[tuple[object, str, object], ...]) -> Iterator[None]:
    """The constants are replaced for a while."""
    with ExitStack() as stack:
        for place, name, value in replacements:
            stack.enter_context(patch.object(place, name, value))
        yield


def error(method: Method, trial: Trial, bound: Uncertainty) -> float:
    """Return the error over its bound, infinite where there is no model."""
    try:
        return relative_error(method(trial), trial.model, bound)
    except InvalidData:
        return float("inf")


def compared(cell: Cell, seed: int, number: int, samples: int) -> Outcome:
    """Return what all methods find in one record."""
    trial = cell.trial(seed, number, samples)
    bound = cramer_rao(trial.model, trial.spectra, samples)
    errors = {name: error(method, trial, bound) for name, method in METHODS.items()}
    data = [(trial.y, trial.u)]
    windows = arx_windows.arx_windows(data, arx_windows.longest_lag([samples], trial.model.p, trial.model.n_u))
    started = time.process_time()
    found = reduced_model.reduced(windows, trial.model.n)
    seconds = time.process_time() - started
    errors["ours"] = relative_error(found.model, trial.model, bound)
    wrong = np.abs(found.model.markov(COUNT) - trial.model.markov(COUNT))
    inside = wrong <= NORMAL * found.uncertainty.markov(COUNT)
    poles, true = found.model.poles, trial.model.poles
    rows, columns = linear_sum_assignment(np.abs(np.subtract.outer(poles, true)))
    known = bound.poles()[columns].real < DETERMINED
    near = (np.abs((poles[rows] - true[columns]).real) <= NORMAL * found.uncertainty.poles()[rows].real)[known]
    return Outcome(errors, (int(inside.sum()), inside.size, int(near.sum()), near.size), seconds)


def calibrated(constant: str, cell: Cell, seed: int, number: int, samples: int) -> Outcome:
    """Return the errors of our method on one record, with each value of one constant."""
    trial = cell.trial(seed, number, samples)
    bound = cramer_rao(trial.model, trial.spectra, samples)
    errors = {}
    for label, replacements in VARIANTS[constant].items():
        with changed(replacements):
            errors[label] = error(lambda trial: arx_reduction(trial.y, trial.u, order=trial.model.n).model, trial, bound)
    return Outcome(errors)


@dataclass(frozen=True)
class Choice:
    """What was said of the order of one record, whether the choice was right, both errors over the bound, and CPU seconds."""

    said: str
    right: bool
    errors: tuple[float, float]
    seconds: float


def order_found(cell: Cell, seed: int, number: int, samples: int) -> Choice:
    """Return what was said of the order of one record."""
    trial = cell.trial(seed, number, samples)
    n, bound = trial.model.n, cramer_rao(trial.model, trial.spectra, samples)
    started = time.process_time()
    found = arx_reduction(trial.y, trial.u)
    seconds = time.process_time() - started
    told = found if found.order == n else arx_reduction(trial.y, trial.u, order=n)
    errors = (relative_error(found.model, trial.model, bound), relative_error(told.model, trial.model, bound))
    orders = found.orders
    assert orders is not None
    said = "below" if orders.most < n else "above" if orders.least > n else "right" if orders.decided else "open"
    return Choice(said, orders.best == n, errors, seconds)


def summary(errors: Array, rng: np.random.Generator) -> str:
    """Return the median with its 95 % interval, and the 90 % quantile."""
    medians = np.median(rng.choice(errors, (2000, len(errors))), axis=1)
    # Without interpolation: errors may be infinite.
    low, high = np.quantile(medians, (0.025, 0.975), method="nearest")
    return f"{np.median(errors):.2f} [{low:.2f},{high:.2f}] {np.quantile(errors, 0.9, method='nearest'):.2f}"


def line(cell: Cell, samples: int, outcomes: list[Outcome], names: list[str]) -> str:
    """Return one row of the table."""
    rng = np.random.default_rng(0)
    columns = [summary(np.array([outcome.errors[name] for outcome in outcomes]), rng) for name in names]
    hits = np.sum([outcome.covered for outcome in outcomes], axis=0)
    if hits[1]:
        columns += [
            f"{hits[0] / hits[1]:.3f}",
            f"{hits[2] / max(hits[3], 1):.3f}",
            f"{np.mean([outcome.seconds for outcome in outcomes]):.2f}",
        ]
    return f"| {cell.name} | {samples} | {len(outcomes)} | {' | '.join(columns)} |"


def print_orders(options: argparse.Namespace, run: joblib.Parallel) -> None:
    """The table of orders left open."""
    answers = ("right", "open", "below", "above")
    heads = ["cell", "N", "systems", *answers, "choice right", "error of the choice", "error told", "seconds"]
    print(f"seed {options.seed}\n\n| {' | '.join(heads)} |\n|{'---|' * len(heads)}")
    for samples in options.samples:
        for cell in (cell for cell in CELLS if cell.kind in options.cells):
            found = list(run(joblib.delayed(order_found)(cell, options.seed, number, samples) for number in range(options.systems)))
            rng = np.random.default_rng(0)
            said = [one.said for one in found]
            columns = [str(said.count(answer)) for answer in answers] + [str(sum(one.right for one in found))]
            columns += [summary(np.array([one.errors[which] for one in found]), rng) for which in (0, 1)]
            seconds = np.mean([one.seconds for one in found])
            print(f"| {cell.name} | {samples} | {len(found)} | {' | '.join(columns)} | {seconds:.2f} |", flush=True)


def main() -> None:
    """Print the table in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--systems", type=int, default=24, help="records a cell")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--samples", type=int, nargs="+", default=[200, 1000, 10000])
    parser.add_argument("--cells", nargs="+", default=sorted({cell.kind for cell in CELLS}), choices=sorted({cell.kind for cell in CELLS}))
    parser.add_argument("--calibrate", choices=sorted(VARIANTS))
    parser.add_argument("--orders", action="store_true", help="how often the order is found")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    run = joblib.Parallel(n_jobs=options.jobs)
    if options.orders:
        print_orders(options, run)
        return
    names = list(VARIANTS[options.calibrate]) if options.calibrate else [*METHODS, "ours"]
    heads = ["cell", "N", "systems", *names, *([] if options.calibrate else ["cover Markov", "cover poles", "seconds"])]
    print(f"median [95 % interval of the median] 90 % quantile of error / bound; seed {options.seed}\n")
    print(f"| {' | '.join(heads)} |\n|{'---|' * len(heads)}")
    for samples in options.samples:
        for cell in CELLS:
            if cell.kind not in options.cells:
                continue
            numbers = range(options.systems)
            if options.calibrate:
                outcomes = run(joblib.delayed(calibrated)(options.calibrate, cell, options.seed, number, samples) for number in numbers)
            else:
                outcomes = run(joblib.delayed(compared)(cell, options.seed, number, samples) for number in numbers)
            print(line(cell, samples, list(outcomes), names), flush=True)


if __name__ == "__main__":
    main()
