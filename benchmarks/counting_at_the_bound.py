"""Try kernel rows of outputs and inputs: the number of faults, on seeds that no rule was chosen on.

    python benchmarks/counting_at_the_bound.py {count,calibrate,laws} [--trials 30] [--seed 1] [--samples 1001] [--limit SECONDS]
        [--cells 0 1 ..] [--jobs 1] [--out FILE]
    python benchmarks/counting_at_the_bound.py merge FILE ..

count       `count_faults` on random plants of order 5 with one input (`fault_dimension.py`): p outputs, n_v faults, noise so many
            decibels below each output, equal for spread 1, else the loudest to the faintest in that ratio, in random order. Trial i of a
            cell has the seed --seed + i and depends on nothing else; with --out each is appended to FILE as a line of JSON
merge       the same table from such files: parts of cells, made at different times; a trial that stands there twice counts once
calibrate   means of the likelihood ratios of degrees over what they should be: what MISFITS is set by
laws        the ratios of `laws.py` over what they should be, where the rows are laws and where they are none: what its constants are set by

Brackets are Wilson's 95 % intervals. Seconds are CPU seconds; hold BLAS to one thread.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import joblib
import numpy as np
import scipy.stats
from fault_dimension import fault_signals, noise, random_plant
from numpy.typing import NDArray

from faultspace.numeric.rows.degree import MISFITS, freedom, likelihood_ratio
from faultspace.numeric.rows.evidence import Evidence
from faultspace.numeric.rows.fault_count import FAINTEST, count_faults
from faultspace.numeric.rows.joint import course, joint_moments
from faultspace.numeric.rows.laws import FAR, FAR_LONGER, FLAT_MISFIT, SHAPE_MISFIT, SINGLE_MISFITS, step_to_two, tested
from faultspace.numeric.study.runs import NOISE_GAIN, study_run
from faultspace.numeric.study.systems import N_X, study_system

Array = NDArray[np.float64]

# p, n_v, decibels, spread
COUNT_CELLS = (
    (3, 1, 40.0, 1.0),
    (3, 1, 20.0, 1.0),
    (3, 1, 40.0, 10.0),
    (3, 1, 20.0, 10.0),
    (4, 1, 20.0, 10.0),
    (4, 2, 40.0, 1.0),
    (4, 2, 20.0, 1.0),
    (4, 2, 40.0, 10.0),
    (3, 0, 20.0, 10.0),
    (4, 0, 40.0, 10.0),
    (3, 2, 40.0, 1.0),
    (3, 2, 20.0, 1.0),
    (4, 3, 40.0, 1.0),
    (3, 3, 40.0, 1.0),
    (3, 3, 20.0, 1.0),
    (4, 4, 40.0, 1.0),
)

# Of those the ones where a single row is a law.
SINGLE_CELLS = tuple(cell for cell in COUNT_CELLS if cell[0] - cell[1] == 1)


def record(seed: int, p: int, n_v: int, decibels: float, spread: float, samples: int) -> tuple[Array, Array]:
    """Make y (samples, p) and u (samples, 1)."""
    random = np.random.default_rng([seed, p, n_v, int(decibels), int(spread), samples])
    plant = random_plant(random, p, max(n_v, 1))
    state, u = random.standard_normal(N_X), random.standard_normal((samples, 1))
    v = fault_signals(random, samples, max(n_v, 1)) * (n_v > 0)
    clean = np.sum(plant.respond(state, u, v), axis=0)
    levels = clean.std(axis=0) * 10 ** (-decibels / 20) * random.permutation(np.geomspace(1, 1 / spread, p))
    return clean + noise(random, samples, levels), u


@dataclass(frozen=True)
class Trial:
    """One count: the number of its cell, its seed, the answer (None for undecided), and CPU seconds."""

    cell: int
    samples: int
    seed: int
    answer: int | None
    possible: tuple[int, ...]
    seconds: float


def trial(cell: int, seed: int, samples: int) -> Trial:
    """Make a record and count its faults."""
    y, u = record(seed, *COUNT_CELLS[cell], samples)
    begin = time.process_time()
    found = count_faults(y, u, order=N_X)
    return Trial(cell, samples, seed, found.n_v, found.possible, round(time.process_time() - begin, 3))


def count(seed: int, trials: int, samples: int, clock: Clock, cells: Sequence[int], jobs: int, out: Path | None) -> None:
    """Print a line for each cell: how many were right, undecided, wrong."""
    for cell in cells:
        calls = (joblib.delayed(trial)(cell, seed + number, samples) for number in clock.range(trials))
        made = []
        for one in joblib.Parallel(n_jobs=jobs, return_as="generator", pre_dispatch=jobs)(calls):
            made.append(one)
            if out is not None:
                with out.open("a") as file:
                    file.write(json.dumps(asdict(one)) + "\n")
        line(cell, made)


def merge(files: Sequence[Path]) -> None:
    """Print the same lines from what was written before."""
    found = [Trial(**json.loads(text)) for file in files for text in file.read_text().splitlines()]
    once = {(one.cell, one.samples, one.seed): one for one in found}
    for cell, samples in sorted({key[:2] for key in once}):
        line(cell, [one for one in once.values() if (one.cell, one.samples) == (cell, samples)])


def line(cell: int, made: Sequence[Trial]) -> None:
    """Print how often one cell was right, undecided and wrong."""
    if not made:
        return
    p, n_v, decibels, spread = COUNT_CELLS[cell]
    right, undecided = sum(one.answer == n_v for one in made), sum(one.answer is None for one in made)
    # An undecided answer errs too, where the truth is not among what it leaves.
    astray = sum(one.answer is None and n_v not in one.possible for one in made)
    wrong, seconds = len(made) - right - undecided, np.mean([one.seconds for one in made])
    name = f"{cell:2d} p={p} n_v={n_v} {decibels:g} dB 1:{spread:g} N={made[0].samples}"
    rates = f"right {rate(right, len(made))}  wrong {rate(wrong, len(made))}"
    print(f"{name:34s} {right}/{undecided}/{wrong}  {rates}  undecided without the truth {astray}  {seconds:.2f} s", flush=True)


def calibrate(seed: int, trials: int, samples: int, clock: Clock) -> None:
    """Print ratios over their expectations: of degrees on the study's systems, of sphericity and flatness on random plants."""
    degree: dict[int, list[float]] = {1: [], 2: [], 3: []}
    for number in clock.range(trials):
        zeros = number % 4
        system = study_system(zeros, np.random.SeedSequence([seed + number, zeros]))
        run = study_run(system, np.random.SeedSequence([seed + number, zeros, samples]), level=0.01 / NOISE_GAIN, samples=samples)
        data = joint_moments(run.y, run.u, N_X + 3)
        fits = course(data, 1, N_X - zeros + 3)
        for extra, ratios in degree.items():
            low, high = fits[N_X - zeros], fits[N_X - zeros + extra]
            ratios.append(likelihood_ratio(data, low, high) / freedom(data, low, high))
    for extra, ratios in degree.items():
        parameters = 4 * extra
        tail = scipy.stats.chi2.sf(np.array(ratios) * parameters / MISFITS[min(extra, 2) - 1], parameters)
        shares = ", ".join(f"{np.mean(tail < level):.2f} below {level:g}" for level in (0.05, 0.01, 1e-3, 1e-4))
        print(f"{extra} degrees more: ratio / freedom {quantiles(ratios)}; of the stated probabilities {shares}")


def laws(seed: int, trials: int, samples: int, clock: Clock, cells: Sequence[int]) -> None:
    """Print the ratios of `laws.py` over their expectations: of as many rows as are laws, and of one more, which are none."""
    shapes, flats, others, steps = list[float](), list[float](), list[float](), list[float]()
    singles: list[tuple[float, ...]] = []
    full, clear = list[bool](), list[float]()
    for number in clock.range(trials):
        p, n_v, decibels, spread = COUNT_CELLS[cells[number % len(cells)]]
        evidence = Evidence(*record(seed + number, p, n_v, decibels, spread, samples), N_X)
        if n_v < p:
            found = tested(evidence, p - n_v)
            if found.sphericity is None:
                singles.append(found.ratios)
            else:
                shapes.append(found.sphericity.nats / found.sphericity.expected)
                flats.extend(found.ratios)
        if 0 < n_v < p:
            others.append(tested(evidence, p - n_v + 1).farness)
        if n_v == p:
            found = tested(evidence, 1)
            full.append(found.holds is not False)
            if found.holds:
                steps.append(step_to_two(evidence, found, tested(evidence, 2)))
        if n_v == p - 1 and decibels == 40.0:
            clear.append(step_to_two(evidence, found, tested(evidence, 2)))
    print(f"laws, k >= 2: sphericity / expected {quantiles(shapes)} (SHAPE_MISFIT is {SHAPE_MISFIT:g}, FAR {FAR:g})")
    print(f"laws, k >= 2: flatness / freedom {quantiles(flats)} (FLAT_MISFIT is {FLAT_MISFIT:g}, FAR_LONGER {FAR_LONGER:g})")
    for i, misfit in enumerate(SINGLE_MISFITS):
        print(
            f"laws, k = 1: flatness / freedom, step {i + 1}: {quantiles([ratios[i] for ratios in singles])} (SINGLE_MISFITS has {misfit:g})"
        )
    print(
        f"no laws, k >= 2: the larger of the ratios over FAR and FAR_LONGER: least {min(others, default=np.nan):.2f}, {quantiles(others)}"
    )
    print(
        f"n_v = p, k = 1: not refused {sum(full)} of {len(full)}, accepted {len(steps)}, with steps {np.round(sorted(steps), 1).tolist()}"
    )
    print(f"n_v = p - 1, 40 dB: steps {np.round(sorted(clear), 1).tolist()} (FAINTEST is {FAINTEST:g})")


def quantiles(values: list[float]) -> str:
    """Return the mean and some quantiles, as text."""
    if not values:
        return "none made"
    q = np.quantile(values, [0.5, 0.9, 0.99])
    return f"mean {np.mean(values):.2f}, median {q[0]:.2f}, 90 % {q[1]:.2f}, 99 % {q[2]:.2f} of {len(values)}"


def rate(count: int, total: int) -> str:
    """Return the rate in %, with Wilson's interval."""
    interval = scipy.stats.binomtest(count, total).proportion_ci(method="wilson")
    return f"{100 * count / total:.0f} [{100 * interval.low:.0f}, {100 * interval.high:.0f}] %"


class Clock:
    """The clock gives trials as long as there is time, which is shared equally among the calls that are left."""

    def __init__(self, seconds: float, calls: int) -> None:
        self.end, self.left = time.monotonic() + seconds, calls

    def range(self, trials: int) -> Iterator[int]:
        """Yield 0, 1, .., trials - 1, or as far as the time of this call goes."""
        stop = time.monotonic() + max(self.end - time.monotonic(), 0.0) / max(self.left, 1)
        self.left -= 1
        for trial in range(trials):
            if time.monotonic() > stop:
                return
            yield trial


def main() -> None:
    """Parse the arguments, run what they ask for, and print it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", choices=("count", "calibrate", "laws", "merge"))
    parser.add_argument("files", nargs="*", type=Path, help="of merge: what --out wrote")
    parser.add_argument("--trials", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--samples", type=int, default=1001)
    parser.add_argument("--limit", type=float, default=float("inf"))
    parser.add_argument("--cells", type=int, nargs="+", default=range(len(COUNT_CELLS)), help="of count and laws: which, from 0")
    parser.add_argument("--jobs", type=int, default=1, help="of count: processes at a time")
    parser.add_argument("--out", type=Path, help="of count: the file to which trials are appended")
    chosen = parser.parse_args()
    if chosen.table == "merge":
        merge(chosen.files)
    elif chosen.table == "count":
        clock = Clock(chosen.limit, len(chosen.cells))
        count(chosen.seed, chosen.trials, chosen.samples, clock, chosen.cells, chosen.jobs, chosen.out)
    elif chosen.table == "laws":
        laws(chosen.seed, chosen.trials, chosen.samples, Clock(chosen.limit, 1), chosen.cells)
    else:
        calibrate(chosen.seed, chosen.trials, chosen.samples, Clock(chosen.limit, 1))


if __name__ == "__main__":
    main()
