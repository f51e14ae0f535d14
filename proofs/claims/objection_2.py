"""objection-2: for which P part (ii) of theorem-3 fails is not said, and full column rank is not enough."""

from __future__ import annotations

from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench, witnessed
from .one_determinant import formula
from .theorem_3_ii import every_p


def full_rank_is_not_enough(bench: Workbench) -> Outcome:
    """Some P of full column rank gives a pair that is not equivalent."""
    return witnessed(every_p(bench))


def exact_set(bench: Workbench) -> Outcome:
    """It fails for exactly the P with D(q; P) = 0."""
    return formula(bench)
