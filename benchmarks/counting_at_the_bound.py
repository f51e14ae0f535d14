"""Try kernel rows of outputs and inputs: the number of faults, on seeds that no rule was chosen on.

    python benchmarks/counting_at_the_bound.py {count,laws,single,faintest,settings} [--trials 30] [--seed 1] [--samples 1001]
        [--limit SECONDS] [--cells 0 1 ..] [--jobs 1] [--out FILE]
    python benchmarks/counting_at_the_bound.py merge FILE ..

count       `count_faults` on random plants of order 5 with one input (`fault_dimension.py`): p outputs, n_v faults, noise so many
            decibels below each output, equal for spread 1, else the loudest to the faintest in that ratio, in random order. Trial i of a
            cell has the seed --seed + i and depends on nothing else; with --out each is appended to FILE as a line of JSON
merge       the same table from such files: parts of cells, made at different times; a trial that stands there twice counts once
laws        the ratios of `law_tests.py` over what they should be, where several rows are laws and where there is a row too many: what
            SHAPE_MISFIT and FLAT_MISFIT stand for, and the middle between the two that FAR stands for
single      the ratios of single rows that are laws, at 300 to 30001 samples, with faults that fill all frequencies and with some that do
            not: the quantile regression that CROWDED and LOOSE stand for
faintest    single rows of records with as many faults as outputs that are accepted, at 1001 and 30001 samples, and their steps: the
            quantile that FAINTEST stands for, and what it costs where there is a fault less
settings    how many answers change when what only saves time or ends an iteration is halved or doubled

Brackets are Wilson's 95 % intervals. Seconds are CPU seconds; hold BLAS to one thread.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from unittest.mock import patch

import joblib
import numpy as np
import scipy.optimize
import scipy.stats
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # run from a clone, installed or not

from benchmarks.fault_dimension import fault_signals, noise, random_plant
from faultspace.numeric.method.rows import evidence as evidence_module
from faultspace.numeric.method.rows import fault_count as count_module
from faultspace.numeric.method.rows import law_tests as law_module
from faultspace.numeric.method.rows import remainder as remainder_module
from faultspace.numeric.method.rows.evidence import EXTRA, GONE, LONG, Evidence
from faultspace.numeric.method.rows.fault_count import FAINTEST, MOST, count_faults
from faultspace.numeric.method.rows.joint import PRECISION
from faultspace.numeric.method.rows.law_tests import (
    ARRIVALS,
    ARRIVED,
    CROWDED,
    FAR,
    FLAT_MISFIT,
    HOPELESS,
    LOOSE,
    SETTLED,
    SHAPE_MISFIT,
    SUFFICES,
    TURNS,
    step_to_two,
    tested,
)
from faultspace.numeric.method.rows.remainder import SAMPLES, SWEEPS, TEST_BANDS, loose_samples
from faultspace.numeric.method.space.basis import ROUGH
from faultspace.numeric.study.random_systems import N_X

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


def record(
    seed: int, p: int, n_v: int, decibels: float, spread: float, samples: int, faults: Callable[..., Array] = fault_signals
) -> tuple[Array, Array]:
    """Make y (samples, p) and u (samples, 1)."""
    random = np.random.default_rng([seed, p, n_v, int(decibels), int(spread), samples])
    plant = random_plant(random, p, max(n_v, 1))
    state, u = random.standard_normal(N_X), random.standard_normal((samples, 1))
    v = faults(random, samples, max(n_v, 1)) * (n_v > 0)
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


def laws(seed: int, trials: int, samples: int, clock: Clock, cells: Sequence[int]) -> None:
    """Print what `law_tests.py` says of several rows by their ratios: of as many as are laws, and of one more, which are none."""
    shapes, flats, laws_far, others_far = list[float](), list[float](), list[float](), list[float]()
    for number in clock.range(trials):
        p, n_v, decibels, spread = COUNT_CELLS[cells[number % len(cells)]]
        evidence = Evidence([record(seed + number, p, n_v, decibels, spread, samples)], N_X)
        if p - n_v >= 2:
            found = tested(evidence, p - n_v)
            assert found.sphericity is not None
            laws_far.append(found.farness * FAR)
            bands, k = min(TEST_BANDS, int(evidence.data.samples / (2 * SAMPLES * found.count))), found.count
            shapes.append(found.sphericity.nats / found.sphericity.expected / one_in_ten(bands * (k * k - 1)))
            flats.extend(ratio / one_in_ten(EXTRA * evidence.data.moments.channels) for ratio in found.ratios)
        if 1 <= p - n_v < p:
            others_far.append(tested(evidence, p - n_v + 1).farness * FAR)
    for name, values, had in (("SHAPE_MISFIT", shapes, SHAPE_MISFIT), ("FLAT_MISFIT", flats, FLAT_MISFIT)):
        print(f"{name}: {np.quantile(values, 0.9):.2f} (set: {had:g}), of {len(values)}")
    print(f"laws, in units of the misfits: {quantiles(laws_far)}")
    print(f"one row more: least {min(others_far):.1f}, hundredth {np.quantile(others_far, 0.01):.1f} of {len(others_far)}")
    print(f"FAR: {np.sqrt(np.quantile(laws_far, 0.99) * np.quantile(others_far, 0.01)):.2f} (set: {FAR:g})")


def white_faults(random: np.random.Generator, samples: int, m: int) -> Array:
    """Make faults (samples, m) that fill all frequencies evenly, as a chirp does not."""
    return random.standard_normal((samples, m))


def single(seed: int, trials: int, clock: Clock) -> None:
    """Print what the ratios of single rows that are laws exceed one by, as a combination of the two terms of `single_misfits`."""
    kinds = [(samples, faults) for samples in (300, 1001, 3000, 10000, 30001) for faults in (fault_signals, white_faults)]
    places, crowded, loose, excess, small = list[int](), list[float](), list[list[float]](), list[list[float]](), list[bool]()
    for number in clock.range(trials * len(kinds)):
        place = number % len(kinds)
        p = 3 + number // len(kinds) % 2
        evidence = Evidence([record(seed + number, p, p - 1, 40.0, 1.0, kinds[place][0], kinds[place][1])], N_X)
        found, data = tested(evidence, 1), evidence.single
        free = 0.0 if evidence.disturbance is None else loose_samples(evidence.disturbance, data, found.fit, found.shares) ** 0.5
        places.append(place)
        crowded.append((2 * len(data.moments.angles) / data.samples) ** 0.5)
        loose.append([free / (degrees * data.moments.channels) for degrees in (EXTRA, LONG)])
        excess.append(
            [ratio / one_in_ten(degrees * data.moments.channels) - 1 for ratio, degrees in zip(found.ratios, (EXTRA, LONG), strict=True)]
        )
        small.append(found.probability < SUFFICES)
    for i, (name, had) in enumerate(zip(("EXTRA", "LONG"), zip(CROWDED, LOOSE, strict=True), strict=True)):
        terms, values = np.column_stack([crowded, np.array(loose)[:, i]]), np.array(excess)[:, i]
        best = quantile_regression(terms, values, 0.9)
        print(f"{name}: CROWDED {best[0]:.2f} (set: {had[0]:g}), LOOSE {best[1]:.2f} (set: {had[1]:g})")
        for place, (samples, faults) in enumerate(kinds):
            here = np.array(places) == place
            if here.any():
                beyond = rate(sum(values[here] > terms[here] @ had), int(here.sum()))
                print(f"    N={samples}, {faults.__name__}: beyond one in ten {beyond}, median {1 + np.median(values[here]):.2f}")
    print(f"probability below {SUFFICES:g}: {rate(sum(small), len(small))}")


def one_in_ten(freedom: int) -> float:
    """Return the 90 % quantile of a chi-squared variable over its degrees of freedom."""
    return float(scipy.stats.chi2.isf(0.1, freedom)) / freedom


def quantile_regression(terms: Array, values: Array, quantile: float) -> Array:
    """Return the coefficients (c,), none negative, of the terms (N, c) below which this share of the values (N,) lies."""
    count, width = terms.shape
    costs = np.concatenate([np.zeros(width), np.full(count, quantile), np.full(count, 1 - quantile)])
    left = np.hstack([terms, np.eye(count), -np.eye(count)])
    return np.asarray(scipy.optimize.linprog(costs, A_eq=left, b_eq=values, bounds=(0, None)).x[:width])


def faintest(seed: int, trials: int, clock: Clock, cells: Sequence[int], jobs: int) -> None:
    """Print the steps of single rows that are accepted, with as many faults as outputs, and with one less."""
    for less, what in ((0, "as many faults as outputs"), (1, "one fault less")):
        kind = [cell for cell in cells if COUNT_CELLS[cell][0] - COUNT_CELLS[cell][1] == less]
        chosen = [cell for cell in kind if COUNT_CELLS[cell][2] == 40.0 or not less]
        kinds = [(cell, samples) for cell in chosen for samples in ((1001, 30001) if not less else (1001,))]
        if not kinds:
            continue
        calls = (joblib.delayed(step_of)(*kinds[number % len(kinds)], seed + number) for number in clock.range(trials))
        steps = joblib.Parallel(n_jobs=jobs)(calls)
        accepted = sorted(step for step in steps if step > -np.inf)
        beyond = rate(sum(step >= FAINTEST for step in steps), len(steps))
        quantile = float(np.quantile(steps, 0.99, method="higher"))
        print(f"{what}: {len(accepted)} of {len(steps)} accepted, steps {np.round(accepted, 1).tolist()}")
        print(f"    99 % quantile {quantile:.1f}; at or beyond FAINTEST, {FAINTEST:g}: {beyond}")


def step_of(cell: int, samples: int, seed: int) -> float:
    """Return the step from two rows to one, minus infinity where a single row is not accepted."""
    evidence = Evidence([record(seed, *COUNT_CELLS[cell], samples)], N_X)
    one = tested(evidence, 1)
    return step_to_two(evidence, one, tested(evidence, 2)) if one.holds else -np.inf


# What only saves time or ends an iteration: module, name, and the values that stand for half and twice as much.
SETTINGS = (
    (law_module, "HOPELESS", (HOPELESS / 2, HOPELESS * 2)),
    (law_module, "TURNS", (TURNS // 2, TURNS * 2)),
    (law_module, "ARRIVED", (ARRIVED / 2, ARRIVED * 2)),
    (law_module, "ARRIVALS", (ARRIVALS // 2, ARRIVALS * 2)),
    (law_module, "SETTLED", (SETTLED / 2, SETTLED * 2)),
    (law_module, "PRECISION", (PRECISION / 2, PRECISION * 2)),
    (law_module, "ROUGH", (ROUGH / 2, ROUGH * 2)),
    (evidence_module, "GONE", (GONE / 2, GONE * 2)),
    (remainder_module, "SWEEPS", (SWEEPS // 2, SWEEPS * 2)),
    (remainder_module, "TEST_BANDS", (TEST_BANDS // 2, TEST_BANDS * 2)),
    (count_module, "MOST", (MOST // 2, MOST * 2)),
)


def settings(seed: int, trials: int, samples: int, clock: Clock, cells: Sequence[int]) -> None:
    """Print for every setting how many answers change when it is halved and when it is doubled, and in what way."""
    changes: dict[tuple[str, float], list[str]] = {(name, value): [] for _, name, values in SETTINGS for value in values}
    made = 0
    for number in clock.range(trials):
        cell = cells[number % len(cells)]
        y, u = record(seed + number, *COUNT_CELLS[cell], samples)
        usual, made = count_faults(y, u, order=N_X).n_v, made + 1
        for module, name, values in SETTINGS:
            for value in values:
                with patch.object(module, name, value):
                    found = count_faults(y, u, order=N_X).n_v
                if found != usual:
                    changes[name, value].append(f"{usual} to {found} (n_v = {COUNT_CELLS[cell][1]})")
    for (name, value), seen in changes.items():
        print(f"{name} = {value:g}: {len(seen)} of {made} answers change {'; '.join(seen)}")


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
    parser.add_argument("table", choices=("count", "laws", "single", "faintest", "settings", "merge"))
    parser.add_argument("files", nargs="*", type=Path, help="of merge: what --out wrote")
    parser.add_argument("--trials", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--samples", type=int, default=1001)
    parser.add_argument("--limit", type=float, default=float("inf"))
    parser.add_argument(
        "--cells", type=int, nargs="+", default=range(len(COUNT_CELLS)), help="of count, laws, faintest and settings: which, from 0"
    )
    parser.add_argument("--jobs", type=int, default=1, help="of count and faintest: processes at a time")
    parser.add_argument("--out", type=Path, help="of count: the file to which trials are appended")
    chosen = parser.parse_args()
    if chosen.table == "merge":
        merge(chosen.files)
    elif chosen.table == "count":
        clock = Clock(chosen.limit, len(chosen.cells))
        count(chosen.seed, chosen.trials, chosen.samples, clock, chosen.cells, chosen.jobs, chosen.out)
    elif chosen.table == "laws":
        laws(chosen.seed, chosen.trials, chosen.samples, Clock(chosen.limit, 1), chosen.cells)
    elif chosen.table == "single":
        single(chosen.seed, chosen.trials, Clock(chosen.limit, 1))
    elif chosen.table == "faintest":
        faintest(chosen.seed, chosen.trials, Clock(chosen.limit, 2), chosen.cells, chosen.jobs)
    else:
        settings(chosen.seed, chosen.trials, chosen.samples, Clock(chosen.limit, 1), chosen.cells)


if __name__ == "__main__":
    main()
