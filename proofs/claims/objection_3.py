"""objection-3: proposition-3 uses theorem-2, stated for minimal systems, while assumption 4 does not ask (A, F) to be controllable."""

from __future__ import annotations

import numpy as np

from ...exact.system.systems import ResidualSystem
from ..evidence.corpus import Evidence
from ..evidence.families import paper_example
from ..evidence.questions import MINIMAL, RANKS, REACHABILITY, ZEROS
from ..evidence.search import Box, smallest
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, certify, counterexample
from .common import gap_is_m_from, zeros

BOX = Box(total=4, largest_n=2, largest_m=2, largest_p=2)


def controllability_needed(bench: Workbench) -> Outcome:
    """'Without controllability the formula fails': the smallest system not controllable where it holds; the paper's example is another."""

    def holds(system: ResidualSystem) -> bool:
        e = bench.examined(system, MINIMAL)
        return not e.controllable and e.observable and e.left_invertible and gap_is_m_from(lambda e: e.system.n)(e)

    found = smallest(BOX, lambda f: np.asarray(f.observable & f.left_invertible & ~f.controllable), holds)
    if found is None:
        return Outcome(Verdict.ERROR, "no uncontrollable system in the box with the right gap")
    example = paper_example().residual
    words = f"{found}, where the gap is m for s >= n all the same, as for the paper's example, which is not controllable either"
    return counterexample(words, BOX, [*zeros(found), *zeros(example)])


def gap_without_controllability(bench: Workbench) -> Outcome:
    """Where a left-invertible system is not controllable and s >= n, the gap is m all the same."""
    return certify(
        bench, (RANKS, REACHABILITY), lambda e: e.left_invertible and not e.controllable, gap_is_m_from(lambda e: e.system.n), zeros
    )


def ranks_without_minimality(bench: Workbench) -> Outcome:
    """Without controllability or observability, rank [O_s T_s] = n + s m - zeta for s >= lag, with the zeros of the pencil."""

    def holds(e: Evidence) -> bool:
        return all(e.kernel.rank(s) == e.system.n + s * e.system.m - e.zeta for s in range(e.kernel.lag, e.system.n + 4))

    return certify(bench, (*MINIMAL, *ZEROS), lambda e: e.left_invertible and not (e.controllable and e.observable), holds, zeros)
