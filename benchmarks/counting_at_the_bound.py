"""Try kernel rows of outputs and inputs: the number of faults, on seeds that no rule was chosen on.

    python benchmarks/counting_at_the_bound.py {count,calibrate,laws} [--trials 30] [--seed 1] [--samples 1001] [--limit SECONDS]

count       `count_faults` on random plants of order 5 with one input (`fault_dimension.py`): p outputs, n_v faults, noise so many
            decibels below each output, equal for spread 1, else the loudest to the faintest in that ratio, in random order
calibrate   means of the likelihood ratios of degrees over what they should be: what MISFITS is set by
laws        the ratios of `laws.py` over what they should be, where the rows are laws and where they are none: what its constants are set by

Brackets are Wilson's 95 % intervals. Seconds are CPU seconds; hold BLAS to one thread.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator

import numpy as np
import scipy.stats
from fault_dimension import fault_signals, noise, random_plant
from numpy.typing import NDArray

from faultspace.numeric.rows.degree import MISFITS, freedom, likelihood_ratio
from faultspace.numeric.rows.fault_count import count_faults
from faultspace.numeric.rows.joint import course, joint_moments
from faultspace.numeric.rows.laws import FAR, FAR_LONGER, FLAT_MISFIT, SHAPE_MISFIT, SINGLE_MISFITS, Evidence, tested
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


def count(seed: int, trials: int, samples: int, clock: Clock) -> None:
    """Print a line for each cell: how many were right, undecided, wrong."""
    for p, n_v, decibels, spread in COUNT_CELLS:
        right = undecided = wrong = 0
        begin = time.process_time()
        for trial in clock.range(trials):
            y, u = record(seed + trial, p, n_v, decibels, spread, samples)
            found = count_faults(y, u, order=N_X)
            right += found.n_v == n_v
            undecided += found.n_v is None
            wrong += found.n_v not in (None, n_v)
        made = right + undecided + wrong
        if made:
            seconds = (time.process_time() - begin) / made
            name = f"p={p} n_v={n_v} {decibels:g} dB 1:{spread:g}"
            print(
                f"{name:24s} {right}/{undecided}/{wrong}  right {rate(right, made)}  wrong {rate(wrong, made)}  {seconds:.2f} s", flush=True
            )


def calibrate(seed: int, trials: int, samples: int, clock: Clock) -> None:
    """Print ratios over their expectations: of degrees on the study's systems, of sphericity and flatness on random plants."""
    degree: dict[int, list[float]] = {1: [], 2: [], 3: []}
    for trial in clock.range(trials):
        zeros = trial % 4
        system = study_system(zeros, np.random.SeedSequence([seed + trial, zeros]))
        run = study_run(system, np.random.SeedSequence([seed + trial, zeros, samples]), level=0.01 / NOISE_GAIN, samples=samples)
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


def laws(seed: int, trials: int, samples: int, clock: Clock) -> None:
    """Print the ratios of `laws.py` over their expectations: of as many rows as are laws, and of one more, which are none."""
    shapes, flats, others, steps = list[float](), list[float](), list[float](), list[float]()
    singles: list[tuple[float, ...]] = []
    full: list[bool] = []
    for trial in clock.range(trials):
        p, n_v, decibels, spread = COUNT_CELLS[trial % len(COUNT_CELLS)]
        evidence = Evidence(*record(seed + trial, p, n_v, decibels, spread, samples), N_X)
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
                steps.append(tested(evidence, 2).level - found.level)
    print(f"laws, k >= 2: sphericity / expected {quantiles(shapes)} (SHAPE_MISFIT is {SHAPE_MISFIT:g}, FAR {FAR:g})")
    print(f"laws, k >= 2: flatness / freedom {quantiles(flats)} (FLAT_MISFIT is {FLAT_MISFIT:g}, FAR_LONGER {FAR_LONGER:g})")
    for i, misfit in enumerate(SINGLE_MISFITS):
        print(
            f"laws, k = 1: flatness / freedom, step {i + 1}: {quantiles([ratios[i] for ratios in singles])} (SINGLE_MISFITS has {misfit:g})"
        )
    print(f"no laws, k >= 2: the larger of the ratios over FAR and FAR_LONGER: least {min(others):.2f}, {quantiles(others)}")
    print(f"n_v = p, k = 1: not refused {sum(full)} of {len(full)}, accepted {len(steps)}, with steps {np.round(steps, 1).tolist()}")


def quantiles(values: list[float]) -> str:
    """Return the mean and some quantiles, as text."""
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
    parser.add_argument("table", choices=("count", "calibrate", "laws"))
    parser.add_argument("--trials", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--samples", type=int, default=1001)
    parser.add_argument("--limit", type=float, default=float("inf"))
    chosen = parser.parse_args()
    calls = len(COUNT_CELLS) if chosen.table == "count" else 1
    {"count": count, "calibrate": calibrate, "laws": laws}[chosen.table](
        chosen.seed, chosen.trials, chosen.samples, Clock(chosen.limit, calls)
    )


if __name__ == "__main__":
    main()
