"""objection-1: the proof of proposition-1 needs u and v uncorrelated at lags of both signs; the assumption has one."""

from __future__ import annotations

from ..verdicts import Outcome
from ..workbench import Workbench
from .proposition_1 import two_sided, white_b_d


def one_sided_suffices(bench: Workbench) -> Outcome:
    """The one-sided assumption is enough after all, u white."""
    return white_b_d(bench)


def two_sided_suffices(bench: Workbench) -> Outcome:
    """The two-sided one is, u of any colour."""
    return two_sided(bench)
