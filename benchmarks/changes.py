"""This measures what `identify --healthy-until` sees of each kind of change: how often rightly, and how often of nothing.

    python benchmarks/changes.py [--trials 10] [--healthy-trials 100] [--seed 1] [--samples short usual] [--markdown]

Random stable plants of three states, order given; noise of a random colour, correlated, a fortieth of each output's size. `short`:
5 outputs, 1 input, 160 healthy samples, 240 after; `usual`: 3 outputs, 2 inputs, 600 and 900. Half of the records are of a closed loop
with a random proportional controller, which sees what the sensors say. A change sets in with the first sample after the healthy ones, of
3, 10 and 30 standard deviations (sigma) of the noise of one output:

    mean shift, step     a constant, from the beginning or from the middle on
    drift                a ramp up to this size
    white fault          white noise of this deviation
    sinusoid             of this amplitude and a random frequency
    output gain          a sensor, input gain an actuator, that loses so much of its gain that the loss has this root mean square
    stuck                a sensor that stands still but for a jitter of a hundredth of sigma; freezing: one that holds its value now
                         and then, for 10 to 30 samples. Their size is that of the output: its noise is a third, a tenth, a thirtieth of it

What is told: `right` the row of this kind and channel is seen (of a step that of mean or drift; of a stuck sensor that of lost variance or
of freezing), `other` something else is seen, `undecided` nothing is, and no 0 is said, `zero` a bold 0, which is wrong. Of records without
a change: `alarm` a row of the table is seen, by the number of records, which the level of the table, 0.01, bounds, and in which rows. The
table is there made as `identify` makes it, without the count of faults, which would take most of the time.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from faultspace.numeric import arx_reduction, changes_since_healthy, identify, residual

Array = NDArray[np.float64]

SIZES = (3.0, 10.0, 30.0)
SIGNAL_TO_NOISE = 40.0
SETTINGS = {"short": (5, 1, 160, 240), "usual": (3, 2, 600, 900)}  # outputs, inputs, healthy samples, samples after
KINDS = ("mean shift", "step", "drift", "white fault", "sinusoid", "output gain", "input gain", "stuck", "freezing")
RIGHT = {
    "step": ("mean shift", "drift"),
    "white fault": ("growth of variance",),
    "stuck": ("loss of variance", "freezing"),
}
OUTCOMES = ("right", "other", "undecided", "zero")


@dataclass(frozen=True)
class Plant:
    """x(k+1) = A x(k) + B u(k), y(k) = C x(k), and u(k) = L y(k-1) + what excites it."""

    A: Array
    B: Array
    C: Array
    L: Array


def plant(random: np.random.Generator, p: int, n_u: int, *, loop: bool) -> Plant:
    """Draw a stable plant, whose loop is stable, too."""
    A = random.standard_normal((3, 3))
    A *= random.uniform(0.3, 0.95) / np.abs(np.linalg.eigvals(A)).max()
    B, C, L = random.standard_normal((3, n_u)), random.standard_normal((p, 3)), random.standard_normal((n_u, p)) * loop
    while True:
        closed = np.block([[A, B @ L], [C, np.zeros((p, p))]])
        if np.abs(np.linalg.eigvals(closed)).max() < 0.95 or not L.any():
            return Plant(A, B, C, L)
        L = L * 0.7


def run(system: Plant, dither: Array, noise: Array, sensor: Callable[[int, Array, Array], Array], actuator: Array) -> tuple[Array, Array]:
    """Return y and u: `sensor` makes what is measured of (k, true outputs and noise, the last measured), `actuator` (N, n_u) are gains."""
    x, y, u = np.zeros(3), np.zeros(noise.shape), np.zeros(dither.shape)
    last = np.zeros(noise.shape[1])
    for k in range(len(y)):
        u[k] = system.L @ last + dither[k]
        last = y[k] = sensor(k, system.C @ x + noise[k], last)
        x = system.A @ x + system.B @ (actuator[k] * u[k])
    return y, u


def coloured(random: np.random.Generator, samples: int, p: int) -> Array:
    """Return correlated noise of one random colour, each output of deviation one."""
    white = random.standard_normal((samples + 200, p)) @ (np.eye(p) + 0.5 * random.standard_normal((p, p)))
    made = lfilter([1.0, random.uniform(-0.8, 0.8)], [1.0, -random.uniform(-0.8, 0.8)], white, axis=0)[200:]
    return np.asarray(made / made.std(axis=0))


def record(kind: str, size: float, setting: tuple[int, int, int, int], random: np.random.Generator, loop: bool) -> tuple[Array, Array, int]:
    """Return y, u and the output or input that has changed; the kind "none" changes nothing."""
    p, n_u, healthy, after = setting
    N = healthy + after
    system, dither, unit = plant(random, p, n_u, loop=loop), random.standard_normal((N, n_u)), coloured(random, N, p)
    held = kind in ("stuck", "freezing")
    quiet, given = run(system, dither, np.zeros((N, p)), lambda k, y, last: y, np.ones((N, n_u)))
    sigma = quiet.std(axis=0) / (size if held else SIGNAL_TO_NOISE)
    which = int(random.integers(n_u if kind == "input gain" else p))
    k = np.arange(N)
    on = k >= healthy
    late = np.where(on, k - healthy, 0) / after
    shapes = {
        "mean shift": 1.0 * on,
        "step": 1.0 * (late > 0.5),
        "drift": late,
        "white fault": on * random.standard_normal(N),
        "sinusoid": on * np.sin(2.0 * np.pi * random.uniform(0.02, 0.48) * k + random.uniform(0.0, 6.0)),
    }
    added = size * sigma[min(which, p - 1)] * shapes.get(kind, np.zeros(N))
    gain = -min(size / SIGNAL_TO_NOISE, 0.95) * on if kind == "output gain" else np.zeros(N)
    actuator = np.ones((N, n_u))
    if kind == "input gain":
        alone = run(
            Plant(system.A, system.B, system.C, 0.0 * system.L), given * (np.arange(n_u) == which), np.zeros((N, p)), same, actuator
        )
        actuator[on, which] -= min(size / np.max(alone[0].std(axis=0) / sigma), 0.95)
    stops = on & (kind == "stuck")
    if kind == "freezing":
        for start in random.choice(np.arange(healthy, N - 30), max(after // 100, 1), replace=False):
            stops[start : start + int(random.integers(10, 31))] = True
    jitter = 0.01 * sigma[min(which, p - 1)] * random.standard_normal(N) if kind == "stuck" else np.zeros(N)
    base = [0.0]

    def sensor(k: int, y: Array, last: Array) -> Array:
        y = y.copy()
        if kind != "input gain":
            y[which] = (1.0 + gain[k]) * y[which] + added[k]
            if stops[k]:
                base[0] = base[0] if k and stops[k - 1] else last[which]
                y[which] = base[0] + jitter[k]
        return y

    y, u = run(system, dither, unit * sigma, sensor, actuator)
    return y, u, which


def same(k: int, y: Array, last: Array) -> Array:
    """Measure what is there."""
    return y


def told(kind: str, y: Array, u: Array, healthy: int, which: int) -> str:
    """Return what `identify` tells of a record."""
    answer = identify(y, u, order=3, healthy=healthy)
    rows = answer.changes.seen if answer.changes else ()
    channel = f"{'u' if kind == 'input gain' else 'y'}{which + 1}"
    if any(row.kind in RIGHT.get(kind, (kind,)) and row.channel == channel for row in rows):
        return "right" if answer.n_v != 0 else "zero"
    if answer.at_least:
        return "other"
    return "undecided" if answer.n_v is None else "zero"


def alarms(y: Array, u: Array, healthy: int) -> list[str]:
    """Return the kinds of the rows that are seen in the table that `identify` makes."""
    found = arx_reduction(y[:healthy], u[:healthy], order=3)
    r = residual(y, u, found, x0=found.x0).r
    return [row.kind for row in changes_since_healthy(r, y, u, healthy=healthy, model=found).seen]


def main() -> None:
    """Measure and print a line for each kind, and one for records without a change."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--trials", type=int, default=10)
    parser.add_argument("--healthy-trials", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--samples", nargs="+", choices=list(SETTINGS), default=list(SETTINGS))
    parser.add_argument("--markdown", action="store_true", help="print tables in Markdown")
    arguments = parser.parse_args()
    begin, between, end = ("| ", " | ", " |") if arguments.markdown else ("", "  ", "")

    def line(*cells: object) -> None:
        print(begin + between.join(f"{cell!s:<14}" for cell in cells) + end, flush=True)

    for number, name in enumerate(arguments.samples):
        setting, start = SETTINGS[name], time.perf_counter()
        p, n_u, healthy, after = setting
        print(f"\n{name}: {p} outputs, {n_u} inputs, {healthy} healthy samples and {after} after\n")
        line("no change", "records", "alarms", "rows")
        if arguments.markdown:
            line(*["---"] * 4)
        for loop in (False, True):
            seen = []
            for trial in range(arguments.healthy_trials):
                random = np.random.default_rng((arguments.seed, number, 0, loop, trial))
                y, u, _ = record("none", 1.0, setting, random, loop)
                seen.append(alarms(y, u, healthy))
            rows = Counter(kind for kinds in seen for kind in kinds)
            told_rows = ", ".join(f"{count} {kind}" for kind, count in rows.items()) or "none"
            line("with feedback" if loop else "open", len(seen), sum(map(bool, seen)), told_rows)
        if not arguments.trials:
            continue
        print(f"\n{' / '.join(OUTCOMES)}, open and with feedback, {arguments.trials} records of each\n")
        line("change", *(f"{size:g} sigma{loop}" for size in SIZES for loop in (", open", ", loop")))
        if arguments.markdown:
            line(*["---"] * 7)
        for place, kind in enumerate(KINDS, start=1):
            cells = []
            for size in SIZES:
                for loop in (False, True):
                    found: Counter[str] = Counter()
                    for trial in range(arguments.trials):
                        random = np.random.default_rng((arguments.seed, number, place, int(size), loop, trial))
                        y, u, which = record(kind, size, setting, random, loop)
                        found[told(kind, y, u, healthy, which)] += 1
                    cells.append(" / ".join(str(found[outcome]) for outcome in OUTCOMES))
            line(kind, *cells)
        print(f"\n{time.perf_counter() - start:.0f} s")


if __name__ == "__main__":
    main()
