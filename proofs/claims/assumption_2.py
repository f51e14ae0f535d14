"""assumption-2: (1/N) sum u(k-l) v(k)^T -> 0 for all l >= 0, which with assumption 1 is said to give (1/N) V_s U_s^T -> 0."""

from __future__ import annotations

from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench
from .proposition_1 import WHITE, drives, smallest_limit


def one_sided(bench: Workbench) -> Outcome:
    """The claim is that no correlation at l >= 0 is enough: a fault that leads a white input has none there, and moves B and D."""
    return smallest_limit(
        bench, drives([WHITE], [["0", "1"]]), lambda e: e.one_sided and not e.leads and not e.inputs_right, "v(k) = u(k+1), u white"
    )


def without_lag_zero(bench: Workbench) -> Outcome:
    """The claim is that no correlation at l >= 1 is enough: v(k) = u(k) has none there, and moves B or D."""
    return smallest_limit(bench, drives([WHITE], [["1"]]), lambda e: e.past_lags and not e.inputs_right, "v(k) = u(k), u white")
