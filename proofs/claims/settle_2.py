"""settle-2: in exact arithmetic with assumption 4, rank R_(s+1) - rank R_s equals the true fault dimension."""

from __future__ import annotations

from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench
from . import assumption_4


def n_minus_1(bench: Workbench) -> Outcome:
    """s >= max(l, n - 1)."""
    return assumption_4.n_minus_1_known(bench)


def n(bench: Workbench) -> Outcome:
    """s >= max(l, n)."""
    return assumption_4.n_known(bench)


def excitation(bench: Workbench) -> Outcome:
    """[X; V_s] of full row rank at the same s."""
    return assumption_4.excitation_at_s(bench)


def on_data(bench: Workbench) -> Outcome:
    """The ranks of R_s themselves, s >= lag, [X; V_(s+1)] of full row rank."""
    return assumption_4.excitation_at_s_plus_1(bench)
