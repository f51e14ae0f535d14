"""Mistakes in the small print: numbers that come twice or not at all, the shortest records, signals that are alike."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.from_records import TWO_U, TWO_Y, recorded
from tests.numeric.audit.unseen.systems import Faulty, channel, faulty, general, joined, mixing, plant
from tests.numeric.audit.unseen.witnesses import counts, restores

IDENTIFY, RESIDUAL, RANKS, COUNT = Mutants("identify"), Mutants("residual"), Mutants("window_ranks"), Mutants("fault_dimension")
SPACE, SIGNAL, STRUCTURE = Mutants("fault_space"), Mutants("reconstruct"), Mutants("structure")
COUNTED, FOUND = Mutants("count_faults"), Mutants("identified_fault_space")

MODEL = plant([0.7, -0.4], 2, 2, 901)
TWO = faulty(general([0.7, -0.4], 2, 3, 903), 200, 903)


def cut(found: Faulty, N: int) -> Faulty:
    """Return the first samples."""
    return replace(found, v=found.v[:N], r=found.r[:N])


@SIGNAL.broken("records with no more samples than states", restores(cut(faulty(general([0.7, -0.4, 0.3, 0.2], 1, 2, 907), 50, 907), 8)))
def needs_twice_as_many_samples_as_states(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """Records with at most two samples a state are refused, which an observer would need."""
    if len(r) <= 2 * len(A):
        raise ValueError("too short")
    return reference.reconstruct(r, A, F, C, G, x0)


WIDE = joined([channel([0.6], [0.5, -0.3])], mixing(2, 1), 909)


@COUNTED.broken("more faults than states", counts(2, TWO_Y, TWO_U, 1))
def tells_no_more_faults_than_states(y: Any, u: Any, order: int) -> Any:
    """A fault for each state is the most that a system has."""
    found = reference.count_faults(y, u, order)
    return found if found is None else min(found, order)


LOUD_Y, LOUD_U, _ = recorded(1, 3, 300, 1e-4)
