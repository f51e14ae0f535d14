"""This measures how near fault spaces come to the Cramer-Rao bound, how often the number of zeros is right, and how honest the angles are.

    python benchmarks/space_at_the_bound.py [--systems 100] [--seed 1] [--cells study random] [--samples 1001 10000] [--limit SECONDS]
        [--jobs 1]
    python benchmarks/space_at_the_bound.py --cases FILE [--table] [--identified] [the same but --jobs and --limit]
    python benchmarks/space_at_the_bound.py --calibrate [the same]

`identified_fault_space` with n_v and the order of the model given, on the systems of `space_at_the_bound_cells.py`. Error: the two-sided
distance (`distances.py`) to the true space, the states of the model mapped to the true ones by least squares, over the median that the
bound gives this distance, so that an efficient estimate scores about one. A wrong number of zeros is an error like any other: the space
found counts, decided or not. A row a cell and N:

    zeta        right/undecided/wrong with the A, C of `arx_reduction`; an abstention is neither right nor wrong
    error       in % of its maximum, and error / bound: median with its 95 % bootstrap interval, and the 90 % quantile
    true A, C   the same error / bound where A and C are the true ones: what the rows alone contribute
    angle holds share of the largest principal angles, in the basis of the estimate, below the stated 95 % angle, where zeta is right;
                "small": of those where the stated angle is below SMALL
    angle       what is stated, in radians, and over the true error: medians; an angle normal in one direction has 2.9 on the right

`--calibrate` prints how often the angle holds, and its median, with fewer random starts than STARTS of `numeric/method/model/valleys.py`,
and with more; and what WIDENED of `numeric/method/rows/space_by_rows.py` is set by: quantiles of the tangent of the angle over that of the
stated one, not widened, in records where the estimate's own valley has a probability of ALONE.

With --cases every record is kept in FILE, and a run that was stopped goes on where it was (`kept_cases.py`); records come in rounds of one
a cell, so that all cells have as many wherever it ends. --table measures nothing and shows what FILE has. --identified leaves the true
A, C out, which take nearly half of the time with 10 000 samples.

Brackets of rates are Wilson's 95 % intervals. Seconds are CPU seconds of the space alone; hold BLAS to one thread.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, TypeVar
from unittest.mock import patch

import joblib
import numpy as np
import scipy.stats
from at_the_bound import summary
from kept_cases import Cases
from numpy.typing import NDArray
from space_at_the_bound_cells import CELLS, Cell, Trial

from faultspace.base.errors import InvalidData
from faultspace.numeric import (
    FaultSpaceEstimate,
    StateSpaceModel,
    arx_reduction,
    fault_space_bound,
    fault_space_by_rows,
    identified_fault_space,
)
from faultspace.numeric.method.model import valleys
from faultspace.numeric.method.model.models import observability_matrix
from faultspace.numeric.method.rows import space_by_rows as rows_space
from faultspace.numeric.method.space.distances import principal_angles, two_sided_error
from faultspace.numeric.method.space.estimate import orthonormal

Array = NDArray[np.float64]
T = TypeVar("T")

SMALL = 0.5  # radians below which a stated angle says that the space is known
STARTS = (0, 4, 8, 16, 32)  # numbers of random starts that are compared
ALONE = 0.95  # probability from which a valley counts as the only one


@dataclass(frozen=True)
class Found:
    """A fault space beside the true one: `verdict` on the number of zeros, distance (0 to 1), CPU seconds; the largest angle and the
    stated one, None where zeta is wrong."""

    verdict: str
    error: float
    seconds: float
    angles: tuple[float, float] | None


@dataclass(frozen=True)
class Outcome:
    """One record: the median distance of the bound, what was found with identified A, C and, where that was asked, with the true ones."""

    bound: float
    identified: Found
    true: Found | None


def mapped(space: Array, source: StateSpaceModel, target: StateSpaceModel) -> Array:
    """Return a basis (n + p, k) of a space in the states of the target."""
    n = target.n
    windows = (observability_matrix(model.A, model.C, 2 * n) for model in (target, source))
    turn = np.linalg.lstsq(*windows, rcond=None)[0]
    return orthonormal(np.vstack([turn @ space[:n], space[n:]]))


def judged(trial: Trial, model: StateSpaceModel, found: FaultSpaceEstimate, seconds: float) -> Found:
    """Return the found space beside the truth."""
    verdict = "undecided" if found.zeta is None else "right" if found.zeta == trial.zeta else "wrong"
    error = two_sided_error(trial.Z, mapped(found.basis, model, trial.model))
    angles = None
    if found.n_z == trial.Z.shape[1] and found.uncertainty is not None:
        angles = float(principal_angles(mapped(trial.Z, trial.model, model), found.basis)[-1]), found.uncertainty.angle()
    return Found(verdict, error, seconds, angles)


def compared(cell: Cell, seed: int, number: int, samples: int) -> Outcome:
    """Return what is found in one record."""
    trial = cell.trial(seed, number, samples)
    begin = time.process_time()
    space = fault_space_by_rows(trial.y, trial.u, trial.model.A, trial.model.C, n_v=trial.n_v)
    true = judged(trial, trial.model, space, time.process_time() - begin)
    return replace(identified(cell, seed, number, samples), true=true)


def identified(cell: Cell, seed: int, number: int, samples: int) -> Outcome:
    """Return what is found in one record with identified A, C alone."""
    trial = cell.trial(seed, number, samples)
    bound = fault_space_bound(trial.model, trial.F, trial.G, trial.spectra, samples).distance()
    try:
        model = arx_reduction(trial.y, trial.u, order=trial.model.n)
        begin = time.process_time()
        space = identified_fault_space(trial.y, trial.u, model, n_v=trial.n_v)
        found = judged(trial, model.model, space, time.process_time() - begin)
    except InvalidData:
        found = Found("undecided", 1.0, float("nan"), None)
    return Outcome(bound, found, None)


def rate(count: int, total: int) -> str:
    """Return the rate in %, with Wilson's interval."""
    if not total:
        return "none"
    interval = scipy.stats.binomtest(count, total).proportion_ci(method="wilson")
    return f"{100 * count / total:.0f} [{100 * interval.low:.0f},{100 * interval.high:.0f}]"


HEADS = (
    "cell",
    "N",
    "systems",
    "zeta",
    "right %",
    "wrong %",
    "error %",
    "error / bound",
    "true A, C",
    "angle holds %",
    "small",
    "angle",
    "angle / error",
    "true A, C",
    "s",
)


def line(name: str, samples: int, outcomes: list[Outcome]) -> str:
    """Return one row of the table."""
    rng = np.random.default_rng(0)
    verdicts = [sum(outcome.identified.verdict == verdict for outcome in outcomes) for verdict in ("right", "undecided", "wrong")]
    errors = np.array([outcome.identified.error for outcome in outcomes])
    bounds = np.array([outcome.bound for outcome in outcomes])
    known = [(outcome.true, outcome.bound) for outcome in outcomes if outcome.true]
    angles = [outcome.identified.angles for outcome in outcomes if outcome.identified.angles]
    true = [found.angles for found, _ in known if found.angles]
    small = [pair for pair in angles if pair[1] < SMALL]
    columns = [
        "/".join(map(str, verdicts)),
        rate(verdicts[0], len(outcomes)),
        rate(verdicts[2], len(outcomes)),
        summary(100 * errors, rng),
        summary(errors / bounds, rng),
        summary(np.array([found.error / bound for found, bound in known]), rng) if known else "",
        *(rate(sum(angle <= stated for angle, stated in kind), len(kind)) for kind in (angles, small)),
        *sizes(angles),
        rate(sum(angle <= stated for angle, stated in true), len(true)) if known else "",
        f"{np.nanmean([outcome.identified.seconds for outcome in outcomes]):.2f}",
    ]
    return f"| {name} | {samples} | {len(outcomes)} | {' | '.join(columns)} |"


def sizes(pairs: list[tuple[float, float]]) -> tuple[str, str]:
    """Return the medians of the stated angles, and of these over the true ones."""
    if not pairs:
        return "none", "none"
    return f"{np.median([stated for _, stated in pairs]):.2f}", f"{np.median([stated / angle for angle, stated in pairs]):.1f}"


def made(
    run: joblib.Parallel, options: argparse.Namespace, samples: int, trial: Callable[[Cell, int, int, int], T]
) -> Iterator[tuple[Cell, list[T]]]:
    """Yield what was found in each cell, as far as the time goes, which the cells and lengths share."""
    cells = [cell for cell in CELLS if cell.kind in options.cells]
    share = options.limit / len(cells) / len(options.samples)
    for cell in cells:
        end, outcomes = time.monotonic() + share, list[T]()
        records = [(seed, number) for number in range(options.systems) for seed in options.seed]
        for first in range(0, len(records), options.jobs):
            if time.monotonic() > end:
                break
            several = records[first : first + options.jobs]
            outcomes += run(joblib.delayed(trial)(cell, seed, number, samples) for seed, number in several)
        yield cell, outcomes


def tables(options: argparse.Namespace) -> Iterator[str]:
    """Yield the lines of the table."""
    yield f"| {' | '.join(HEADS)} |\n|{'---|' * len(HEADS)}"
    with joblib.Parallel(n_jobs=options.jobs) as run:
        for samples in options.samples:
            found = made(run, options, samples, options.compared) if options.cases is None else kept(options, samples)
            together: dict[str, list[Outcome]] = {}
            for cell, outcomes in found:
                together.setdefault(f"{cell.kind}, all, {'coloured' if cell.coloured else 'white'}", []).extend(outcomes)
                if outcomes:
                    yield line(cell.name, samples, outcomes)
            for name, outcomes in together.items():
                if outcomes:
                    yield line(name, samples, outcomes)


def places(options: argparse.Namespace, samples: int) -> Iterator[tuple[Cell, int, int, str]]:
    """Yield cell, seed, number and key of every record of this length, in rounds."""
    for number in range(options.systems):
        for seed in options.seed:
            for cell in CELLS:
                if cell.kind in options.cells:
                    yield cell, seed, number, f"{cell.name}, {samples}, {seed}, {number}"


def measured(options: argparse.Namespace) -> None:
    """Measure and keep the records that FILE does not have yet."""
    cases = Cases(options.cases)
    cases.begin()
    for samples in options.samples:
        for cell, seed, number, key in places(options, samples):
            if key not in cases.found:
                cases.add(key, asdict(options.compared(cell, seed, number, samples)))


def kept(options: argparse.Namespace, samples: int) -> list[tuple[Cell, list[Outcome]]]:
    """Return the records of each cell that FILE has."""
    cases = Cases(options.cases).found
    found: dict[Cell, list[Outcome]] = {}
    for cell, _, _, key in places(options, samples):
        if key in cases:
            case = cases[key]
            true = None if case["true"] is None else _found(case["true"])
            found.setdefault(cell, []).append(Outcome(case["bound"], _found(case["identified"]), true))
    return list(found.items())


def _found(case: dict[str, Any]) -> Found:
    """Return what `asdict` has made a dictionary of."""
    return Found(
        case["verdict"], case["error"], case["seconds"], None if case["angles"] is None else (case["angles"][0], case["angles"][1])
    )


def number(cell: Cell, seed: int, number: int, samples: int) -> Outcome:
    """Return what is found in one record with identified A, C, but for the angle: which takes most of the time."""
    trial = cell.trial(seed, number, samples)
    bound = fault_space_bound(trial.model, trial.F, trial.G, trial.spectra, samples).distance()
    try:
        model = arx_reduction(trial.y, trial.u, order=trial.model.n).model
        begin = time.process_time()
        space = fault_space_by_rows(trial.y, trial.u, model.A, model.C, n_v=trial.n_v)
        found = replace(judged(trial, model, space, time.process_time() - begin), angles=None)
    except InvalidData:
        found = Found("undecided", 1.0, float("nan"), None)
    return Outcome(bound, found, None)


@dataclass(frozen=True)
class Followed:
    """The true angle of one record, the stated ones with each number of STARTS, and the one not widened, None beside other valleys."""

    angle: float
    stated: tuple[float, ...]
    narrow: float | None


def followed(cell: Cell, seed: int, number: int, samples: int) -> Followed | None:
    """Return what is stated with each number of starts, None where the number of zeros is wrong or there is no model."""
    trial = cell.trial(seed, number, samples)
    stated, angle = list[float](), 0.0
    try:
        model = arx_reduction(trial.y, trial.u, order=trial.model.n)
        for starts in STARTS:
            with patch.object(valleys, "STARTS", starts):
                space = identified_fault_space(trial.y, trial.u, model, n_v=trial.n_v)
            pair = judged(trial, model.model, space, 0.0).angles
            if pair is None:
                return None
            angle = pair[0]
            stated.append(pair[1])
        with patch.object(rows_space, "WIDENED", 1.0):
            known = identified_fault_space(trial.y, trial.u, model, n_v=trial.n_v).uncertainty
    except InvalidData:
        return None
    return Followed(angle, tuple(stated), known.angle() if known is not None and known.valleys[0].weight >= ALONE else None)


def calibration(options: argparse.Namespace) -> Iterator[str]:
    """Yield how often the angle holds with each number of starts, for each number of samples."""
    with joblib.Parallel(n_jobs=options.jobs) as run:
        for samples in options.samples:
            records = [one for _, found in made(run, options, samples, followed) for one in found if one is not None]
            for number, starts in enumerate(STARTS):
                held = sum(one.angle <= one.stated[number] for one in records)
                median = np.median([one.stated[number] for one in records])
                share = f"{held} of {len(records)}, {rate(held, len(records))} %"
                yield f"N = {samples}, {starts} starts: holds in {share}; median {median:.2f} rad"
            ratios = [np.tan(one.angle) / np.tan(one.narrow) for one in records if one.narrow is not None]
            quantiles = ", ".join(f"{100 * q:g} %: {np.quantile(ratios, q):.2f}" for q in (0.5, 0.9, 0.95)) if ratios else "none"
            yield f"N = {samples}, not widened: {quantiles} of {len(ratios)}"


def main() -> None:
    """Print the table in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--systems", type=int, default=100, help="records a cell and seed")
    parser.add_argument("--seed", type=int, nargs="+", default=[1])
    parser.add_argument("--samples", type=int, nargs="+", default=[1001, 10000])
    parser.add_argument("--cells", nargs="+", default=["study", "random"], choices=["study", "random"])
    parser.add_argument("--limit", type=float, default=float("inf"), help="seconds for all")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--calibrate", action="store_true", help="how often the angle holds by the number of starts")
    parser.add_argument("--cases", type=Path, help="keep the records in this file, and go on with it")
    parser.add_argument(
        "--identified", dest="compared", action="store_const", const=identified, default=compared, help="leave the true A, C out"
    )
    parser.add_argument("--table", action="store_true", help="only show what the file has")
    parser.add_argument("--number", dest="compared", action="store_const", const=number, help="leave the angle out, too")
    options = parser.parse_args()
    if options.cases is not None and not options.table:
        measured(options)
    seeds = f"seed {' and '.join(map(str, options.seed))}"
    print(seeds if options.calibrate else f"median [95 % interval of the median] 90 % quantile; {seeds}\n")
    for text in calibration(options) if options.calibrate else tables(options):
        print(text, flush=True)


if __name__ == "__main__":
    main()
