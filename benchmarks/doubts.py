"""How often `doubts` doubts a clean record, and how often it sees what was planted.

    OPENBLAS_NUM_THREADS=1 python benchmarks/doubts.py [--clean 500] [--planted 40] [--samples 1000] [--seed 1] [--markdown]

Plants are random: two to five states, one or two inputs, one to three outputs, poles of modulus below 0.95. The inputs are white, coloured
or binary, the noise is coloured and of unequal levels. Clean records are without a fault, with a fault of its own colour, or with one that
sets in at the middle and is larger than the noise; none of these is a reason for a doubt. Each planted doubt changes one thing about a
record without fault; `size` says how much. Every number of the tables is a count of records, each with the 95 % interval of Clopper and
Pearson in the first table. A delay is an estimate and no test: plants whose first answers are small beside the next have one to the data.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter
from scipy.stats import beta

from faultspace.numeric import StateSpaceModel, arx_reduction, doubts, record_from
from faultspace.numeric.plant.doubt.listing import DOUBT_LEVEL, TESTED

Array = NDArray[np.float64]
BEFORE = 300  # samples after which the plant is where it would always have been
COLOURS = ("white", "coloured", "binary")
FAULTS = ("none", "coloured", "sets in")


@dataclass(frozen=True)
class Plant:
    """A model, with the inputs u (N, n_u), the noise (N, p) and the outputs without it."""

    model: StateSpaceModel
    u: Array
    noise: Array
    clean: Array

    @property
    def y(self) -> Array:
        """Return the outputs as they are measured."""
        return self.clean + self.noise


def coloured(random: np.random.Generator, shape: tuple[int, int], most: float = 0.9) -> Array:
    """Return noise of variance one and a random colour."""
    white = random.standard_normal((shape[0] + BEFORE, shape[1]))
    found = lfilter([1.0, random.uniform(-0.8, 0.8)], [1.0, -random.uniform(-most, most)], white, axis=0)[BEFORE:]
    return np.asarray(found / found.std(axis=0))


def plant(random: np.random.Generator, samples: int) -> Plant:
    """Return a random plant and what drives it."""
    n, n_u, p = random.integers((2, 1, 1), (6, 3, 4))
    poles = random.uniform(0.1, 0.95, n) * np.sign(random.standard_normal(n))
    angle = random.uniform(0.2, 2.5)
    A = np.diag(poles)
    A[:2, :2] = abs(poles[0]) * np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    D = random.standard_normal((p, n_u)) * random.integers(2)
    model = StateSpaceModel(A, random.standard_normal((n, n_u)), random.standard_normal((p, n)), D)
    colour = COLOURS[random.integers(3)]
    u = random.standard_normal((samples + BEFORE, n_u)) if colour == "white" else coloured(random, (samples + BEFORE, n_u), 0.8)
    u = np.sign(random.standard_normal(u.shape)) if colour == "binary" else u
    clean = model.simulate(u)[BEFORE:]
    noise = coloured(random, (samples, p)) * clean.std(axis=0) * 10.0 ** random.uniform(-2, -0.5, p)
    return Plant(model, u[BEFORE:], noise, clean)


def clean_record(random: np.random.Generator, samples: int, fault: str) -> tuple[Array, Array, int]:
    """Return y and u of a record that gives no reason to doubt, and the order of its plant."""
    made = plant(random, samples)
    if fault == "none":
        return made.y, made.u, made.model.n
    v = coloured(random, (samples, 1)) * 3.0
    v = v * (np.arange(samples)[:, None] >= samples // 2) if fault == "sets in" else v
    return made.y + v * random.standard_normal(made.y.shape[1]) * made.noise.std(axis=0), made.u, made.model.n


def closed(made: Plant, random: np.random.Generator) -> tuple[Array, Array]:
    """Return the plant in a loop: the inputs have half of the noise of the sample before in them, in units of both."""
    u = made.u.copy()
    u[1:] -= 0.5 * (made.noise / made.noise.std(axis=0)).sum(axis=1)[:-1, None] * u.std(axis=0)
    return made.model.simulate(u) + made.noise, u


def curved(made: Plant, random: np.random.Generator) -> tuple[Array, Array]:
    """Return outputs whose plant is driven by u + 0.2 u |u|, in units of u's deviation; inputs that are not binary."""
    unit = coloured(random, made.u.shape, 0.8)
    return made.model.simulate(unit + 0.2 * unit * np.abs(unit)) + made.noise, unit


def drifting(made: Plant, random: np.random.Generator) -> tuple[Array, Array]:
    """Return outputs, the first of which drifts by its deviation from the first sample to the last."""
    line = np.linspace(0.0, 1.0, len(made.u))[:, None] * np.eye(1, made.y.shape[1])
    return made.y + line * made.y.std(axis=0), made.u


def slipping(made: Plant, random: np.random.Generator) -> tuple[Array, Array]:
    """Return outputs, the first of which is ten deviations of its noise off at one sample."""
    y = made.y.copy()
    y[len(y) // 3, 0] += 10 * made.noise[:, 0].std()
    return y, made.u


def bursting(made: Plant, random: np.random.Generator) -> tuple[Array, Array]:
    """Return outputs whose noise is that of a GARCH process, alpha .3 and beta .6, in all outputs at once."""
    variance, white = np.ones(len(made.u)), random.standard_normal(len(made.u))
    for k in range(1, len(white)):
        variance[k] = 0.1 + (0.3 * white[k - 1] ** 2 + 0.6) * variance[k - 1]
    return made.clean + made.noise * np.sqrt(variance)[:, None], made.u


def clipped(made: Plant, random: np.random.Generator) -> tuple[Array, Array]:
    """Return outputs, the first of which is cut off at one and a half of its deviations above its mean."""
    y = made.y.copy()
    y[:, 0] = np.minimum(y[:, 0], y[:, 0].mean() + 1.5 * y[:, 0].std())
    return y, made.u


def late(made: Plant, random: np.random.Generator) -> tuple[Array, Array]:
    """Return outputs that answer all inputs three samples late, or four where D is zero."""
    return np.roll(made.clean, 3, axis=0)[3:] + made.noise[3:], made.u[3:]


PLANTED: dict[str, Callable[[Plant, np.random.Generator], tuple[Array, Array]]] = {
    "closed loop": closed, "non-linearity": curved, "drift": drifting, "outliers": slipping, "bursts": bursting,
    "limits": clipped, "delay": late,
}  # fmt: skip


def kinds(y: Array, u: Array, order: int) -> tuple[str, ...]:
    """Return the kinds of doubts that `doubts` raises for a record with the model that `arx_reduction` makes of it at this order."""
    model = arx_reduction(y, u, order=order)
    return tuple(row.kind for row in doubts(record_from(y, u), model, means_removed=True))


def interval(seen: int, of: int) -> str:
    """Return the 95 % interval of a share by Clopper and Pearson, in per cent."""
    low = 0.0 if seen == 0 else float(beta.ppf(0.025, seen, of - seen + 1))
    high = 1.0 if seen == of else float(beta.ppf(0.975, seen + 1, of - seen))
    return f"{100 * low:.2g} to {100 * high:.2g} %"


def main() -> None:
    """Measure and print both tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--clean", type=int, default=500, help="records of each kind of fault")
    parser.add_argument("--planted", type=int, default=40, help="records of each planted doubt")
    parser.add_argument("--samples", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--markdown", action="store_true", help="print tables in Markdown")
    arguments = parser.parse_args()
    samples = arguments.samples

    def table(heads: tuple[str, ...], rows: list[tuple[object, ...]]) -> None:
        plain = "  ".join(f"{{!s:>{max(len(head), 9)}}}" for head in heads)
        row = "| {} |".format(" | ".join(["{}"] * len(heads))) if arguments.markdown else plain
        print(row.format(*heads))
        if arguments.markdown:
            print("|---" * len(heads) + "|")
        for cells in rows:
            print(row.format(*cells), flush=True)
        print()

    start, rows = time.process_time(), []
    for index, fault in enumerate(FAULTS):
        found = []
        for k in range(arguments.clean):
            random = np.random.default_rng((arguments.seed, index, k))
            found.append(kinds(*clean_record(random, samples, fault)))
        each = tuple(sum(kind in one for one in found) for kind in TESTED)
        some = sum(any(kind in TESTED for kind in one) for one in found)
        rows.append((fault, len(found), *each, some, interval(some, len(found)), sum("delay" in one for one in found)))
    table(("fault", "records", *TESTED, "any", "any, 95 %", "delay"), rows)
    seconds = time.process_time() - start
    print(f"level of each test {DOUBT_LEVEL:g}; seed {arguments.seed}, {samples} samples, {seconds:.0f} CPU seconds\n")
    rows = []
    for index, (kind, change) in enumerate(PLANTED.items()):
        seen, besides = 0, 0
        for k in range(arguments.planted):
            random = np.random.default_rng((arguments.seed, 100 + index, k))
            made = plant(random, samples)
            # Three samples of delay take three states an input.
            order = made.model.n + 3 * made.u.shape[1] * (kind == "delay")
            found_here = kinds(*change(made, random), order)
            seen += kind in found_here
            besides += any(other in TESTED and other != kind for other in found_here)
        rows.append((kind, arguments.planted, seen, besides))
    table(("planted", "records", "seen", "another kind, too"), rows)


if __name__ == "__main__":
    main()
