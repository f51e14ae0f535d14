"""proposition-3: n_v = rank R_(s+1) - rank R_s. As rank [O_(s+1) T_(s+1)] - rank [O_s T_s]; for data see assumption-4."""

from __future__ import annotations

from ..evidence.parametric import gap_claim
from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench
from .common import identity


def parametric(bench: Workbench) -> Outcome:
    """With all entries indeterminate, the gap is the normal rank from n on, on every stratum of the parameter space."""
    return identity(
        bench, gap_claim, [(1, 1, 1), (1, 2, 1), (1, 1, 2), (1, 2, 2), (2, 1, 1), (2, 2, 1)], [(1, 3, 1), (2, 1, 2), (1, 3, 2), (2, 2, 2)]
    )
