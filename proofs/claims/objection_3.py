"""objection-3: proposition-3 uses theorem-2, stated for minimal systems, while assumption 4 does not ask (A, F) to be controllable."""

from __future__ import annotations

import numpy as np

from ...exact.system.systems import ResidualSystem
from ..evidence.families import paper_example
from ..evidence.questions import MINIMAL
from ..evidence.search import Box, smallest
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, counterexample
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
