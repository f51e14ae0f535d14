"""Mistakes that begin far along: on long records, where faults begin late or end early, at ends of pieces."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.method.model.models import StateSpaceModel
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.systems import Faulty, Matrices, general, plant, record
from tests.numeric.audit.unseen.witnesses import counts, recovers

IDENTIFY, RESIDUAL, RANKS, COUNT = Mutants("identify"), Mutants("residual"), Mutants("window_ranks"), Mutants("fault_dimension")
SPACE, SIGNAL = Mutants("fault_space"), Mutants("reconstruct")

MODEL = plant([0.7, -0.4], 1, 2, 801)
LONG = record(MODEL, 6000, 801)
SYSTEM = general([0.7, -0.4], 1, 2, 804)


def acting(system: Matrices, N: int, first: int, last: int, seed: int) -> Faulty:
    """Return a record at rest under a fault that acts on the samples first, ..., last - 1."""
    A, F, C, G = system
    v = np.zeros((N, F.shape[1]))
    v[first:last] = np.random.default_rng(seed).standard_normal((last - first, F.shape[1]))
    return Faulty(A, F, C, G, v, np.zeros(len(A)), StateSpaceModel(A, F, C, G).simulate(v))


LATE = acting(SYSTEM, 3000, 2500, 3000, 805)
EARLY = acting(SYSTEM, 400, 0, 150, 806)


@IDENTIFY.broken("records of more than 5000 samples", recovers(LONG, 2, 4))
def saves_memory_on_long_records(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """More than 5000 samples are stored in single precision."""
    if len(y) > 5000:
        y, u = (np.asarray(x, np.float32).astype(float) for x in (y, u))
    return reference.identify(y, u, order, block_rows)


@COUNT.broken("faults that end early", counts(1, EARLY.r))
def counts_in_the_second_half(r: Any) -> Any:
    """The first half of the record is left out as a transient."""
    half = r[len(r) // 2 :]
    return reference.fault_dimension(half) if np.max(np.abs(half)) > 1e-9 * np.max(np.abs(r)) else 0
