"""objection-1: the proof of proposition-1 needs u and v uncorrelated at lags of both signs; the assumption has one."""

from __future__ import annotations

from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench, witnessed
from . import proposition_1


def one_sided_is_not_enough(bench: Workbench) -> Outcome:
    """Some fault uncorrelated with u at all l >= 0 moves B and D, u white, and leaves A and C right: proposition-1 as printed fails."""
    return witnessed(proposition_1.white_b_d(bench))


def two_sided_suffices(bench: Workbench) -> Outcome:
    """The two-sided one is, u of any colour: not for the range of O_s."""
    return proposition_1.two_sided_range(bench)


def two_sided_long_past(bench: Workbench) -> Outcome:
    """It is with a past that is long enough for the colour of u."""
    records = [e for e in bench.limits if e.whole_range_expected and e.past_of_input]
    return proposition_1.certify_limits(records, lambda e: e.equal and e.inputs_right)
