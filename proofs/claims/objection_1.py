"""objection-1: the proof of proposition-1 needs u and v uncorrelated at lags of both signs; the assumption has one."""

from __future__ import annotations

from ..verdicts import Outcome
from ..workbench import Workbench, witnessed
from .proposition_1 import two_sided, white_b_d


def one_sided_is_not_enough(bench: Workbench) -> Outcome:
    """Some fault uncorrelated with u at all l >= 0 moves B and D, u white: the counterexample to proposition-1 as printed."""
    return witnessed(white_b_d(bench))


def two_sided_suffices(bench: Workbench) -> Outcome:
    """The two-sided one is, u of any colour."""
    return two_sided(bench)
