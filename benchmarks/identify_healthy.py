"""This measures how often `identify --healthy-until` finds a fault where there is none, and one of the size that it says it would see.

    python benchmarks/identify_healthy.py [--trials 40] [--seed 1] [--markdown] [--inputs]

Random stable plants of three states, two inputs and three outputs, order given; noise of a random colour and of levels 1 to 100 apart; K
healthy samples, then as many again and a half. Of each record three are made: as it is; with a constant at one output, and with a white
signal there, of the sizes that the answer to the first says are seen with a chance of .9.

    zero, undecided, fault    what is told of the record without a fault: a fault there is a false alarm
    constant, white           share of the faults of the stated size that are found

With --inputs the records have no fault, and inputs that are so many times as loud after the healthy samples, or so many deviations away:
how often is a fault found where no answer is left undecided for their sake? LOUDER of `numeric/plant/healthy/unlike_healthy.py` stands for
the largest that was tried at which no more alarms are false than where the inputs stay as they were, by a sign test. An input that has
moved counts by its power about the healthy mean, and so many deviations by themselves are printed beside.
"""

from __future__ import annotations

import argparse
import time
from unittest.mock import patch

import numpy as np
import scipy.special
from numpy.typing import NDArray
from scipy.signal import lfilter

from faultspace.numeric.data.records import recorded
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.plant.healthy import unlike_healthy
from faultspace.numeric.plant.pipeline import identify

Array = NDArray[np.float64]

HEALTHY = (300, 600, 1500)
LOUDNESSES, DISTANCES = (1.25, 1.5, 1.75, 2.0, 3.0, 5.0), (2.0, 3.0, 10.0)
LEVEL = 0.05
OUTPUTS, INPUTS = ("y1", "y2", "y3"), ("u1", "u2")


def plant(random: np.random.Generator) -> StateSpaceModel:
    """This draws a stable plant."""
    A = random.standard_normal((3, 3))
    A *= random.uniform(0.3, 0.95) / np.abs(np.linalg.eigvals(A)).max()
    return StateSpaceModel(A, random.standard_normal((3, 2)), random.standard_normal((3, 3)), np.zeros((3, 2)))


def noise(random: np.random.Generator, samples: int) -> Array:
    """Return correlated noise of one random colour and very unequal levels, some per cent of the outputs."""
    white = random.standard_normal((samples + 200, 3)) @ (np.eye(3) + 0.5 * random.standard_normal((3, 3)))
    coloured = lfilter([1.0, random.uniform(-0.8, 0.8)], [1.0, -random.uniform(-0.8, 0.8)], white, axis=0)[200:]
    return np.asarray(coloured * 10.0 ** random.uniform(-2.5, -0.5, 3))


def trial(random: np.random.Generator, until: int) -> tuple[str, bool | None, bool | None]:
    """What is told without a fault; whether the constant and the white one of the stated sizes are found (None: no size was stated)."""
    samples = until + until * 3 // 2
    u = random.standard_normal((samples, 2))
    y = plant(random).simulate(u) + noise(random, samples)
    output = int(random.integers(3))

    def counted(added: Array | float) -> tuple[int | None, int, tuple[Array | None, Array | None]]:
        faulty = y.copy()
        faulty[until:, output] += added
        answer = identify(recorded(faulty, u, outputs=OUTPUTS, inputs=INPUTS), order=3, healthy=until)
        return answer.n_v, answer.at_least, (answer.mean.visible if answer.mean else None, answer.visible)

    count, at_least, (constant, white) = counted(0.0)
    verdict = "fault" if at_least else "undecided" if count is None else "zero"
    if verdict != "zero" or constant is None or white is None or not np.isfinite(white[output]):
        return verdict, None, None
    return verdict, counted(constant[output])[1] > 0, counted(white[output] * random.standard_normal(samples - until))[1] > 0


def false_alarm(random: np.random.Generator, until: int, louder: float, away: float) -> bool:
    """Tell whether a fault is found in a record without one, whose inputs are so different after the healthy samples."""
    samples = until + until * 3 // 2
    u = random.standard_normal((samples, 2))
    u[until:] = louder * u[until:] + away
    y = plant(random).simulate(u) + noise(random, samples)
    with patch.object(unlike_healthy, "LOUDER", np.inf):
        return identify(recorded(y, u, outputs=OUTPUTS, inputs=INPUTS), order=3, healthy=until).at_least > 0


def inputs(trials: int, seed: int) -> None:
    """Print how often it is, by the change of the inputs and the number of healthy samples, and the largest loudness that makes no
    difference: on the same records it does where so many more new alarms than ones that are gone have a probability below LEVEL."""
    lengths = HEALTHY[::2]
    print(f"false alarms of {trials} records; LOUDER is {unlike_healthy.LOUDER:g}")

    def alarms(louder: float, away: float) -> Array:
        rows = [[false_alarm(np.random.default_rng((seed, until, k)), until, louder, away) for k in range(trials)] for until in lengths]
        counts = [sum(row) for row in rows]
        print(f"{louder:4g} times as loud, {away:3g} deviations away: {counts} with {list(lengths)} healthy samples", flush=True)
        return np.array(rows, dtype=np.float64)

    def differ(found: Array, usual: Array) -> bool:
        new, gone = int(np.sum(found > usual)), int(np.sum(found < usual))
        return bool(scipy.special.bdtrc(new - 1, new + gone, 0.5) < LEVEL) if new else False

    usual, largest = alarms(1.0, 0.0), 1.0
    for louder in LOUDNESSES:
        if differ(alarms(louder, 0.0), usual):
            break
        largest = louder
    print(f"LOUDER: {largest:g} is the largest that was tried without more alarms than where the inputs stay as they were", flush=True)
    away = (unlike_healthy.LOUDER**2 - 1) ** 0.5
    moved = alarms(1.0, away)
    print(f"as much power as {unlike_healthy.LOUDER:g} times as loud: {'' if differ(moved, usual) else 'no '}more alarms", flush=True)
    for distance in DISTANCES:
        alarms(1.0, distance)


def main() -> None:
    """Measure and print a line for each number of healthy samples."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--trials", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--markdown", action="store_true", help="print a table in Markdown")
    parser.add_argument("--inputs", action="store_true", help="false alarms by how the inputs change")
    arguments = parser.parse_args()
    if arguments.inputs:
        inputs(arguments.trials, arguments.seed)
        return
    heads = ("healthy", "records", "zero", "undecided", "fault", "constant found", "white found", "seconds a record")
    row = "| {} |".format(" | ".join(["{}"] * len(heads))) if arguments.markdown else "  ".join(f"{{:>{len(head)}}}" for head in heads)
    print(row.format(*heads))
    if arguments.markdown:
        print("|---" * len(heads) + "|")
    for until in HEALTHY:
        start = time.perf_counter()
        found = [trial(np.random.default_rng((arguments.seed, until, k)), until) for k in range(arguments.trials)]
        asked = [(constant, white) for _, constant, white in found if constant is not None]
        seconds = (time.perf_counter() - start) / (len(found) + 2 * len(asked))
        verdicts = [verdict for verdict, _, _ in found]
        shares = [f"{sum(bool(answers[i]) for answers in asked)} of {len(asked)}" for i in (0, 1)]
        counts = (verdicts.count("zero"), verdicts.count("undecided"), verdicts.count("fault"))
        print(row.format(until, len(found), *counts, *shares, f"{seconds:.2f}"), flush=True)


if __name__ == "__main__":
    main()
