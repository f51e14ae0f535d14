"""This measures the onset and the isolation of `identify`: how far off, how often the interval holds, how often a cause is named wrongly.

    python benchmarks/onset_and_isolation.py [--trials 20] [--seed 1] [--part onset|isolation|both] [--shifts] [--markdown]

Onset, on residuals of three outputs as `fault_onset` takes them: noise of a random colour (autoregressive, poles up to 0.9) and of levels 1
to 30 apart, 1000 samples; a fault in a random direction from a random sample on (a fifth to four fifths of the record), of the size stated:
the root of its mean square over the deviation of the noise in the output that sees it best. Kinds: a step, white noise, an autoregression
with the pole 0.9, a sine of 20 samples a turn, and none.

    found         of so many records those with an onset; of records without a fault each is a false alarm (level 0.01)
    error         the median distance of the nearest onset from the true one, in samples
    held          how often the interval of that onset holds the true one; the 0.95 that is stated is to be compared with it
    more          onsets beyond the nearest, a record: at a level of 0.01 for each stretch, about 0.02 are to be expected

Isolation, on records of the packaged plant (3 states, 2 inputs, 3 outputs; order and n_v told), 1000 samples, with a moving-average fault
of the size stated in deviations of the sensors' noise: at a sensor, at an actuator, or elsewhere, in a random direction of [F; G].

    right         the cause is named, and no other one (elsewhere: "neither")
    wrong         another cause is named alone, or the right one is excluded (elsewhere: any is named)
    several       the right one is named with others
    undecided     nothing is named, and the right one is not excluded

Shifts (`--shifts`, alone), on records of the same plant and length, order told: a step of the size stated, in deviations of the noise in
the output that it moves most, at a sensor, at an actuator, or elsewhere in a random direction of the outputs, from a random sample on (two
to four fifths of the record); `identify` with the first three tenths stated to be healthy, and without. The columns are those of the
isolation; undecided has the records too in which no shift was seen.
"""

from __future__ import annotations

import argparse

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from faultspace import example_data as plant
from faultspace.numeric import (
    Isolation,
    ShiftIsolation,
    StateSpaceModel,
    arx_reduction,
    fault_onset,
    identified_fault_space,
    identify,
    isolate,
)

Array = NDArray[np.float64]

SIZES = (3, 10, 30)
KINDS = ("none", "step", "white", "slow", "sine")
CAUSES = ("sensor", "actuator", "elsewhere")
SAMPLES = 1000
SHIFT = 10
NOISE = 0.035


def fault(random: np.random.Generator, kind: str, samples: int) -> Array:
    """Return a fault of unit mean square that begins with the first sample."""
    if kind == "step":
        return np.ones(samples)
    if kind == "sine":
        return np.asarray(np.sqrt(2) * np.sin(0.1 * np.pi * np.arange(1, samples + 1)))
    white = random.standard_normal(samples + 100)
    return np.asarray(white[100:] if kind == "white" else lfilter([np.sqrt(0.19)], [1.0, -0.9], white)[100:])


def onset_trial(random: np.random.Generator, kind: str, size: float) -> tuple[int, int | None, bool]:
    """Return the number of onsets found, the distance of the nearest to the true one, and whether its interval holds it."""
    white = random.standard_normal((SAMPLES + 200, 3))
    pole = random.uniform(-0.5, 0.9)
    noise = np.sqrt(1 - pole**2) * lfilter([1.0], [1.0, -pole], white, axis=0)[200:]
    direction = random.standard_normal(3)
    direction *= size / np.abs(direction).max()
    at = int(random.integers(SAMPLES // 5, 4 * SAMPLES // 5))
    if kind != "none":
        noise[at:] += fault(random, kind, SAMPLES - at)[:, None] * direction
    found = fault_onset(noise * 10.0 ** random.uniform(0, 1.5, 3)).onsets
    if not found:
        return 0, None, False
    nearest = min(found, key=lambda onset: abs(onset.sample - at))
    return len(found), abs(nearest.sample - at), nearest.interval[0] <= at <= nearest.interval[1]


def isolation_trial(random: np.random.Generator, cause: str, size: float) -> str:
    """Return right, wrong, several or undecided."""
    number = {"sensor": int(random.integers(3)), "actuator": 3 + int(random.integers(2)), "elsewhere": -1}[cause]
    columns = np.hstack([np.vstack([np.zeros((3, 3)), np.eye(3)]), np.vstack([plant.B, plant.D])])
    column = columns[:, number] if number >= 0 else random.standard_normal(6)
    u, white = random.standard_normal((SAMPLES, 2)), random.standard_normal(SAMPLES + 1)
    v = size * NOISE * (white[1:] + 0.6 * white[:-1])[:, None] / np.sqrt(1.36)
    driven = StateSpaceModel(plant.A, np.hstack([plant.B, column[:3, None]]), plant.C, np.hstack([plant.D, column[3:, None]]))
    y = driven.simulate(np.hstack([u, v])) + NOISE * random.standard_normal((SAMPLES, 3))
    model = arx_reduction(y, u, order=3)
    return judged(isolate(identified_fault_space(y, u, model, n_v=1), model, units=y.std(axis=0)), number)


def shift_trial(random: np.random.Generator, cause: str, size: float, healthy: int | None) -> str:
    """Return right, wrong, several or undecided."""
    number = {"sensor": int(random.integers(3)), "actuator": 3 + int(random.integers(2)), "elsewhere": -1}[cause]
    gain = plant.C @ np.linalg.solve(np.eye(3) - plant.A, plant.B) + plant.D
    direction = np.hstack([np.eye(3), gain])[:, number] if number >= 0 else random.standard_normal(3)
    step = size * NOISE / np.abs(direction).max()
    at = int(random.integers(2 * SAMPLES // 5, 4 * SAMPLES // 5))
    u = random.standard_normal((SAMPLES, 2))
    driving, added = u.copy(), np.zeros((SAMPLES, 3))
    if number >= 3:
        driving[at:, number - 3] += step
    else:
        added[at:] = step * direction
    y = StateSpaceModel(plant.A, plant.B, plant.C, plant.D).simulate(driving) + added + NOISE * random.standard_normal((SAMPLES, 3))
    found = identify(y, u, order=3, healthy=healthy).shift_isolation
    return "undecided" if found is None else judged(found, number)


def judged(found: Isolation | ShiftIsolation, number: int) -> str:
    """Return what the answer is beside the true cause, -1 for none of them."""
    named = [j for j, one in enumerate(found.causes) if one.answer == "consistent"]
    if number < 0:
        return "wrong" if named else "undecided" if found.of("undecided") else "right"
    if found.causes[number].answer == "excluded" or (named and number not in named):
        return "wrong"
    return "undecided" if not named else "right" if named == [number] else "several"


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--trials", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--part", choices=("onset", "isolation", "both"), default="both")
    parser.add_argument("--markdown", action="store_true", help="print tables in Markdown")
    parser.add_argument("--shifts", action="store_true", help="measure what explains a shift of the mean, and nothing else")
    arguments = parser.parse_args()

    def line(*cells: object) -> None:
        print("| " + " | ".join(map(str, cells)) + " |" if arguments.markdown else "  ".join(f"{cell!s:>10}" for cell in cells), flush=True)

    def heads(*names: str) -> None:
        line(*names)
        if arguments.markdown:
            print("|---" * len(names) + "|")

    seeds = range(arguments.trials)
    if arguments.shifts:
        heads("cause", "sigmas", "healthy", "records", "right", "several", "undecided", "wrong")
        for healthy in (3 * SAMPLES // 10, None):
            for cause in CAUSES:
                randoms = [np.random.default_rng((arguments.seed, CAUSES.index(cause), 7, k)) for k in seeds]
                answers = [shift_trial(random, cause, SHIFT, healthy) for random in randoms]
                line(cause, SHIFT, healthy or "", len(answers), *(answers.count(w) for w in ("right", "several", "undecided", "wrong")))
        return
    if arguments.part != "isolation":
        heads("fault", "sigmas", "records", "found", "error", "held", "more")
        for kind in KINDS:
            for size in SIZES if kind != "none" else (0,):
                trials = [onset_trial(np.random.default_rng((arguments.seed, KINDS.index(kind), size, k)), kind, size) for k in seeds]
                near = [(error, held) for _, error, held in trials if error is not None]
                more = sum(max(count - 1, 0) for count, *_ in trials) / len(trials)
                told = kind != "none" and near
                error = f"{np.median([error for error, _ in near]):g}" if told else ""
                held = f"{sum(held for _, held in near)} of {len(near)}" if told else ""
                line(kind, size or "", len(trials), len(near), error, held, f"{more:.2f}")
    if arguments.part != "onset":
        heads("cause", "sigmas", "records", "right", "several", "undecided", "wrong")
        for cause in CAUSES:
            for size in SIZES:
                answers = [
                    isolation_trial(np.random.default_rng((arguments.seed, CAUSES.index(cause), size, k)), cause, size) for k in seeds
                ]
                line(cause, size, len(answers), *(answers.count(word) for word in ("right", "several", "undecided", "wrong")))


if __name__ == "__main__":
    main()
