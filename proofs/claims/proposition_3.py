"""proposition-3: n_v = rank R_(s+1) - rank R_s. As rank [O_(s+1) T_(s+1)] - rank [O_s T_s]; for data see assumption-4."""

from __future__ import annotations

import numpy as np

from ..evidence.corpus import Evidence
from ..evidence.parametric import gap_claim
from ..evidence.questions import INFINITE_ZEROS, OBSERVABILITY, RANKS
from ..evidence.search import Box
from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench, certify, refute
from .common import gap_is_m_from, identity, ranks_and_inversion


def n_alone(bench: Workbench) -> Outcome:
    """The gap is m where the system is left-invertible and s >= n; nothing else is asked."""
    return certify(bench, (RANKS,), lambda e: e.left_invertible, gap_is_m_from(lambda e: e.system.n), ranks_and_inversion)


def lag_exactly(bench: Workbench) -> Outcome:
    """The gap of a left-invertible system is m for all s >= lag, and never before unless p = m."""

    def holds(e: Evidence) -> bool:
        return all((e.kernel.gap(s) == e.system.m) == (s >= e.kernel.lag or e.system.p == e.system.m) for s in range(0, e.system.n + 3))

    return certify(bench, (RANKS,), lambda e: e.left_invertible, holds, ranks_and_inversion)


def without_left_invertibility(bench: Workbench) -> Outcome:
    """The gap is claimed to be m without left-invertibility too; it is not, for any window."""
    return refute(
        bench,
        Box(total=4, largest_n=2, largest_m=2, largest_p=2),
        lambda f: np.asarray(~f.left_invertible & f.observable),
        (RANKS, OBSERVABILITY),
        lambda e: e.observable,
        gap_is_m_from(lambda e: e.system.n),
        ranks_and_inversion,
    )


def normal_rank(bench: Workbench) -> Outcome:
    """For s >= n the gap is the normal rank, as certified on a diagonal form of the pencil, without any hypothesis."""

    def holds(e: Evidence) -> bool:
        return all(e.kernel.gap(s) == len(e.infinite_zero_orders) for s in range(e.system.n, e.system.n + 3))

    return certify(bench, (RANKS, INFINITE_ZEROS), lambda e: True, holds, ranks_and_inversion)


def parametric(bench: Workbench) -> Outcome:
    """With all entries indeterminate, the gap is the normal rank from n on, on every stratum of the parameter space."""
    return identity(
        bench, gap_claim, [(1, 1, 1), (1, 2, 1), (1, 1, 2), (1, 2, 2), (2, 1, 1), (2, 2, 1)], [(1, 3, 1), (2, 1, 2), (1, 3, 2), (2, 2, 2)]
    )
