"""objection-3: proposition-3 uses theorem-2, stated for minimal systems, while assumption 4 does not ask (A, F) to be controllable."""

from __future__ import annotations

from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box, in_order
from ..evidence.families import paper_example
from ..evidence.questions import MINIMAL
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, counterexample
from .common import gap_is_m_from, zeros

BOX = Box(n=(1, 2), m=(1, 2), p=(1, 2), total=4)


def controllability_needed(bench: Workbench) -> Outcome:
    """The formula is claimed to fail without controllability: the smallest such system where it holds; the paper's example is another."""

    def holds(system: ResidualSystem) -> bool:
        e = bench.examined(system, MINIMAL)
        return not e.controllable and e.observable and e.left_invertible and gap_is_m_from(lambda e: e.system.n)(e)

    sought = in_order(BOX, "observable and left_invertible and not controllable", reduced=True)
    found = next((system for system in sought if holds(system)), None)
    if found is None:
        return Outcome(Verdict.ERROR, "no uncontrollable system in the box with the right gap")
    example = paper_example().residual
    words = f"{found}, where the gap is m for s >= n all the same, as for the paper's example, which is not controllable either"
    return counterexample(words, BOX, [*zeros(found), *zeros(example)])
