"""A small record of faulty data with a known answer, to try `faultspace identify` on: two tanks and a pump, simulated.

faulty_record    the record: inputs, outputs, the fault behind them
csv_text         as a table with a line of names
FILE_NAME        what `faultspace examples DIR` calls it
A, B, C, D, F, G the system x(k+1) = A x + B u + F v, y = C x + D u + G v that made it

The states are two levels and the pump's speed; the fault is a leak of the first tank, which its sensor feels at once. n_v = 1, n = 3.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .numeric.method.model.models import StateSpaceModel

Array = NDArray[np.float64]

FILE_NAME = "faulty-data.csv"
SAMPLES = 4000
SEED = 7
FAULT, NOISE = 0.3, 0.035
INPUTS, OUTPUTS = ("valve", "pump"), ("level1", "level2", "flow")

A = np.array([[0.6, 0.5, 0.0], [-0.5, 0.6, 0.2], [0.0, 0.0, -0.5]])
B = np.array([[1.0, 0.0], [0.4, 0.3], [0.0, 1.0]])
C = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.5, 1.0]])
D = np.zeros((3, 2))
F = np.array([[1.0], [0.3], [0.5]])
G = np.array([[0.4], [0.0], [1.0]])


@dataclass(frozen=True, eq=False)
class FaultyRecord:
    """u (N, 2), y (N, 3), and the fault signal v (N, 1) that nobody measures."""

    u: Array
    y: Array
    v: Array


def faulty_record(samples: int = SAMPLES, *, seed: int = SEED) -> FaultyRecord:
    """Return the record of so many samples: random inputs, a coloured fault signal, sensor noise of deviation 0.035."""
    draw = np.random.default_rng(seed)
    u = draw.standard_normal((samples, 2))
    white = draw.standard_normal(samples + 1)
    v = FAULT * (white[1:] + 0.6 * white[:-1])[:, np.newaxis]
    driven = StateSpaceModel(A, np.hstack([B, F]), C, np.hstack([D, G]))
    y = driven.simulate(np.hstack([u, v])) + NOISE * draw.standard_normal((samples, 3))
    return FaultyRecord(u, y, v)


def csv_text(record: FaultyRecord) -> str:
    """The text has the measured channels, a line for each sample."""
    lines = [",".join(["sample", *INPUTS, *OUTPUTS])]
    rows = np.hstack([record.u, record.y]).tolist()
    lines += [",".join([str(k), *(f"{value:.5g}" for value in row)]) for k, row in enumerate(rows)]
    return "\n".join(lines) + "\n"
