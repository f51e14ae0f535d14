"""This measures the monitor: false alarms against the stated rate, and delays of detection beside parity space, PCA and dynamic PCA.

    python benchmarks/monitoring.py [--plants 4] [--trials 10] [--seed 1] [--markdown]
    python benchmarks/monitoring.py --data DIR [--markdown]

Simulated. Random stable plants of three states, two inputs and three outputs, sensors' noise white or autoregressive (.8) at some per cent
of the outputs. A model of order 3 is identified from 2000 healthy samples (`arx_reduction`); every method learns from 4000 more. Then

    false alarms   on 20000 healthy samples: alarms of the monitor at its own thresholds, stated LEVEL a sample, per test and in all
    delays         all methods get thresholds that on these 20000 samples are exceeded in the same share of blocks of 100 samples,
                   that of a rate of LEVEL; faults begin after 150 healthy samples, and the delay is that of the first exceedance;
                   the table has the mean over plants and trials, what is not found counting 200, and the share found unless it is 1

A column "PCA Q, 20" is of the mean over 20 samples: the chi-square test sums over as many, and an average sees more than a sample.

Faults: a step, a drift that reaches its size after 100 samples, a sinusoid of a period of 12.5 samples; sizes of 1, 3, 10, 30 deviations
of the noise of the sensor that they act on ("sensor"), or at an input ("actuator"), the size being that of the largest response of an
output to a white fault of deviation one, over its noise.

Tennessee Eastman. DIR holds the text files d00.dat, d00_te.dat .. d21_te.dat of the public repository github.com/camaramm/tennessee-
eastman-profBraatz, which are fetched and never part of this tree. Every method learns from d00.dat alone, 500 samples of the 22
measurements that come at every sample and the 11 manipulated variables. A state-space model of 22 outputs from 500 samples in closed loop
would rest on too little, so that the monitor has a model of order 0 and learns an autoregressive predictor: "ours" of the 22 measurements
with the manipulated variables as inputs, "ours, all" of all 33 as outputs. Faults act from sample 161 of 960 on.

    rate          share of the 800 faulty samples beyond the threshold, in %
    delay         samples from the onset to the first of six exceedances in a row; - where there is none
    thresholds    for every method alike: exceeded by 1 % of the healthy samples, those of d00_te.dat and the first 160 of d01_te.dat ..
                  d21_te.dat, but for the file that is judged; `false` has the share of its own first 160 samples, over 21 files
    *             a statistic that was beyond its threshold at the onset already: it detects nothing there
    own           the monitor's alarms at its own thresholds, from d00.dat alone: false ones, and the first that begins after each onset
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from faultspace.numeric import Monitor, StateSpaceModel, arx_reduction
from faultspace.numeric.data.records import recorded

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # run from a clone, installed or not

from benchmarks.monitoring_methods import Method, averaged, parity_space, principal

Array = NDArray[np.float64]

LEVEL = 1e-3
BLOCK, WINDOW = 100, 20
MODELLED, LEARNT, HEALTHY, LEAD, HORIZON = 2000, 4000, 20_000, 150, 200
SHAPES, SIZES, PLACES = ("step", "drift", "sinusoid"), (1, 3, 10, 30), ("sensor", "actuator")
COLOURS = (0.0, 0.8)
OURS = ("residual", "chi-square", "cusum", "hankel")
TEP_LEVEL, ONSET, RUN = 0.01, 160, 6


def watched(monitor: Monitor, names: Sequence[str]) -> Method:
    """Return the monitor as a method: its four statistics, and the largest of them over its threshold."""

    def statistics(y: Array, u: Array) -> Array:
        monitor.restart()
        found = monitor.extend(y, u).statistics
        return np.column_stack([found, np.max(found / monitor.calibration.threshold, axis=1)])

    return Method(tuple(names), statistics)


class Plant:
    """A plant with the scales of its noise; `record` draws from it."""

    def __init__(self, random: np.random.Generator, colour: float) -> None:
        A = random.standard_normal((3, 3))
        A *= random.uniform(0.3, 0.95) / np.abs(np.linalg.eigvals(A)).max()
        self.model = StateSpaceModel(A, random.standard_normal((3, 2)), random.standard_normal((3, 3)), np.zeros((3, 2)))
        self.colour, self.random = colour, random
        sizes = self.model.simulate(random.standard_normal((1000, 2))).std(axis=0)
        self.noise = sizes * 10.0 ** random.uniform(-2, -1, 3)

    def record(self, samples: int, at_sensor: Array | None = None, at_input: Array | None = None) -> tuple[Array, Array]:
        """Return y, u with a fault (samples, 3) added to the sensors, or (samples, 2) to the inputs."""
        u = self.random.standard_normal((samples, 2))
        white = self.random.standard_normal((samples + 100, 3))
        noise = lfilter([np.sqrt(1 - self.colour**2)], [1.0, -self.colour], white, axis=0)[100:] * self.noise
        y = self.model.simulate(u if at_input is None else u + at_input) + noise
        return y if at_sensor is None else y + at_sensor, u

    def faulty(self, place: str, shape: str, size: float) -> tuple[Array, Array]:
        """Return y, u with a fault from LEAD on at a sensor or an input that is drawn."""
        after = np.arange(HORIZON)
        kinds = {"step": np.ones(HORIZON), "drift": np.minimum(after / 100, 1.0), "sinusoid": np.sin(2 * np.pi * (after + 1) / 12.5)}
        signal = np.concatenate([np.zeros(LEAD), kinds[shape]]) * size
        if place == "sensor":
            fault, where = np.zeros((len(signal), 3)), int(self.random.integers(3))
            fault[:, where] = signal * self.noise[where]
            return self.record(len(signal), at_sensor=fault)
        fault, where = np.zeros((len(signal), 2)), int(self.random.integers(2))
        response = np.sqrt(np.sum(self.model.markov(200)[:, :, where] ** 2, axis=0)) / self.noise
        fault[:, where] = signal / response.max()
        return self.record(len(signal), at_input=fault)


def block_threshold(statistics: Array, rate: float) -> Array:
    """Return the thresholds (k,) that are exceeded in the share of blocks that belongs to a rate of alarms a sample."""
    usable = statistics[np.all(np.isfinite(statistics), axis=1)]
    blocks = len(usable) // BLOCK
    maxima = usable[: blocks * BLOCK].reshape(blocks, BLOCK, -1).max(axis=1)
    return np.asarray(np.quantile(maxima, np.exp(-rate * BLOCK), axis=0))


def simulated(plants: int, trials: int, seed: int) -> tuple[dict[float, Array], dict[str, dict[tuple[str, str, int], list[float]]]]:
    """Return alarms by colour, (plants, 5): of each test and in all; and delays by method and cell, NaN for what is not found."""
    alarms: dict[float, Array] = {}
    delays: dict[str, dict[tuple[str, str, int], list[float]]] = {}
    for colour in COLOURS:
        counts = []
        for number in range(plants):
            plant = Plant(np.random.default_rng((seed, number, int(10 * colour))), colour)
            model = arx_reduction(*plant.record(MODELLED), order=3).model
            learnt = plant.record(LEARNT)
            monitor = Monitor(model, *learnt, level=LEVEL)
            fresh = plant.record(HEALTHY)
            others = [parity_space(model, *learnt), principal(*learnt), principal(*learnt, lags=3)]
            methods = [watched(monitor, (*OURS, "ours")), *others, *(averaged(method, WINDOW) for method in others)]
            found = [method.of(*fresh) for method in methods]
            counts.append([monitor.alarms[test] for test in OURS])
            thresholds = [block_threshold(one, LEVEL) for one in found]
            for place in PLACES:
                for shape in SHAPES:
                    for size in SIZES:
                        for _ in range(trials):
                            y, u = plant.faulty(place, shape, size)
                            for method, threshold in zip(methods, thresholds, strict=True):
                                above = method.of(y, u)[LEAD:] > threshold
                                late = np.where(above.any(axis=0), np.argmax(above, axis=0), np.nan)
                                for name, delay in zip(method.names, late, strict=True):
                                    delays.setdefault(name, {}).setdefault((place, shape, size), []).append(float(delay))
        alarms[colour] = np.array(counts)
    return alarms, delays


def table(heads: Sequence[str], rows: Sequence[Sequence[str]], markdown: bool) -> None:
    """Print one table of delays or rates, with its title above it."""
    if markdown:
        print("| " + " | ".join(heads) + " |\n" + "|---" * len(heads) + "|")
        print("\n".join("| " + " | ".join(row) + " |" for row in rows))
        return
    sizes = [max(len(row[i]) for row in [heads, *rows]) for i in range(len(heads))]
    for row in [heads, *rows]:
        print("  ".join(cell.rjust(size) for cell, size in zip(row, sizes, strict=True)))


def delay_cell(delays: Sequence[float]) -> str:
    """Return the mean delay, with the share found where it is not 1."""
    values = np.array(delays)
    share = float(np.mean(np.isfinite(values)))
    return f"{np.mean(np.where(np.isfinite(values), values, HORIZON)):.1f}" + ("" if share == 1 else f" ({share:.2f})")


def report_simulated(plants: int, trials: int, seed: int, markdown: bool) -> None:
    """Measure and print both tables."""
    alarms, delays = simulated(plants, trials, seed)
    due = LEVEL * HEALTHY
    rows = [
        [f"{colour:g}", str(plants), *(f"{count:.1f}" for count in counts.mean(axis=0)), f"{counts.sum(axis=1).mean():.1f}", f"{due:.0f}"]
        for colour, counts in alarms.items()
    ]
    table(["noise", "plants", *OURS, "in all", "stated at most"], rows, markdown)
    print()
    cells = [(place, shape, size) for place in PLACES for shape in SHAPES for size in SIZES]
    table(
        ["fault", "size", *delays],
        [
            [f"{place} {shape}", str(size), *(delay_cell(delays[name][place, shape, size]) for name in delays)]
            for place, shape, size in cells
        ],
        markdown,
    )


def tep_file(folder: Path, name: str) -> tuple[Array, Array]:
    """Return the 22 measurements of every sample and the 11 manipulated variables of a file, whose first is transposed."""
    values = np.loadtxt(folder / name)
    values = values.T if values.shape[0] == 52 else values
    return np.ascontiguousarray(values[:, :22]), np.ascontiguousarray(values[:, 41:52])


def first_run(above: NDArray[np.bool_]) -> str:
    """Return the delay of the first of RUN exceedances in a row."""
    runs = np.convolve(above, np.ones(RUN), "valid") == RUN
    return str(int(np.argmax(runs))) if runs.any() else "-"


def report_tep(folder: Path, markdown: bool) -> None:
    """Measure and print the tables of the Tennessee Eastman files."""
    y, u = tep_file(folder, "d00.dat")
    nothing = StateSpaceModel(np.zeros((0, 0)), np.zeros((0, 11)), np.zeros((22, 0)), np.zeros((22, 11)))
    alone = StateSpaceModel(np.zeros((0, 0)), np.zeros((0, 0)), np.zeros((33, 0)), np.zeros((33, 0)))
    names = [*(f"x{i}" for i in range(1, 23)), *(f"v{i}" for i in range(1, 12))]
    record = recorded(y, u, outputs=names[:22], inputs=names[22:])
    monitors = {"ours": Monitor(nothing, record, level=LEVEL), "ours, all": Monitor(alone, np.hstack([y, u]), level=LEVEL, outputs=names)}
    every = watched(monitors["ours, all"], ("ours, all",))
    others = [principal(y, u), principal(y, u, lags=2)]
    methods = [
        watched(monitors["ours"], (*OURS, "ours")),
        Method(every.names, lambda y, u: every.of(np.hstack([y, u]), np.zeros((len(y), 0)))[:, -1:]),
        *others,
        *(averaged(method, WINDOW) for method in others),
    ]
    heads = [name for method in methods for name in method.names]
    found = {k: np.hstack([method.of(*tep_file(folder, f"d{k:02d}_te.dat")) for method in methods]) for k in range(22)}
    faults = range(1, 22)
    rates, delays, false = [], [], []
    for k in faults:
        healthy = np.vstack([found[0], *(found[j][:ONSET] for j in faults if j != k)])
        above = found[k] > np.nanquantile(healthy, 1 - TEP_LEVEL, axis=0)
        stood = ["*" if stands else "" for stands in above[ONSET - 1]]
        false.append(100 * np.mean(above[:ONSET], axis=0))
        rates.append([str(k), *(f"{100 * np.mean(column):.0f}{star}" for column, star in zip(above[ONSET:].T, stood, strict=True))])
        delays.append([str(k), *(star or first_run(column) for column, star in zip(above[ONSET:].T, stood, strict=True))])
    print("Detection rate in %, thresholds that 1 % of the healthy samples exceed")
    table(["fault", *heads], [["false", *(f"{value:.1f}" for value in np.mean(false, axis=0))], *rates], markdown)
    print("\nDelay in samples of 3 minutes, six exceedances in a row")
    table(["fault", *heads], delays, markdown)
    print(f"\nOwn thresholds from d00.dat, {LEVEL:g} alarms a sample stated")
    counts, firsts = {}, {}
    for name, monitor in monitors.items():
        before = 0
        for k in range(22):
            monitor.restart()
            start, (outputs, inputs) = monitor.samples, tep_file(folder, f"d{k:02d}_te.dat")
            alarms = monitor.extend(outputs, inputs).alarms if monitor.inputs else monitor.extend(np.hstack([outputs, inputs])).alarms
            before += sum(k == 0 or alarm.sample < start + ONSET for alarm in alarms)
            after = [alarm for alarm in alarms if alarm.sample >= start + ONSET and k]
            firsts[name, k] = f"{after[0].sample - start - ONSET} ({after[0].test}: {', '.join(after[0].outputs[:4])})" if after else "-"
        counts[name] = before
    due = (960 + 21 * ONSET) * LEVEL
    table(["fault", *monitors], [[str(k), *(firsts[name, k] for name in monitors)] for k in faults], markdown)
    print("\n".join(f"{name}: {count} false alarms, at most {due:.1f} stated" for name, count in counts.items()))
    for name, monitor in monitors.items():
        print(f"\n{name}: {monitor.summary()}")


def main() -> None:
    """Read the options and measure."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--plants", type=int, default=4)
    parser.add_argument("--trials", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--data", type=Path, help="the folder of the Tennessee Eastman files")
    parser.add_argument("--markdown", action="store_true", help="print tables in Markdown")
    arguments = parser.parse_args()
    if arguments.data is not None:
        report_tep(arguments.data, arguments.markdown)
    else:
        report_simulated(arguments.plants, arguments.trials, arguments.seed, arguments.markdown)


if __name__ == "__main__":
    main()
