"""window-ranks: every window at once, from the minimal indices of the pencil, without any hypothesis."""

from __future__ import annotations

from collections.abc import Iterator

from ...exact.system.systems import ResidualSystem
from ..evidence.corpus import Evidence
from ..evidence.kept_kernels import kernel_once
from ..evidence.questions import RANKS, WINDOW_SPACES, WINDOWS
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench, certify
from .common import spaces


def ranks(bench: Workbench) -> Outcome:
    """rank [O_s T_s] = s r + sum of min(s, eta_i), which is compared with the rank of each window by itself for s = 1, ..., n + 2."""
    return certify(
        bench,
        (RANKS, WINDOWS),
        lambda e: True,
        lambda e: all(e.kernel.rank(s) == rank for s, rank in enumerate(e.window_ranks, 1)),
        _windows,
    )


def solutions(bench: Workbench) -> Outcome:
    """Problem (11) at window s has dimension n + p - sum of (eta_i + 1) over eta_i <= s - 1."""

    def holds(e: Evidence) -> bool:
        predicted = [
            e.system.n + e.system.p - sum(eta + 1 for eta in e.kernel.left_minimal_indices if eta < s)
            for s in range(1, len(e.space_dimensions) + 1)
        ]
        return list(e.space_dimensions) == predicted

    return certify(bench, (RANKS, WINDOW_SPACES), lambda e: True, holds, spaces(lambda s: s.n + 1))


def _windows(system: ResidualSystem) -> Iterator[Certificate]:
    yield make.window_ranks(kernel_once(system))
    for s in range(1, system.n + 2):
        yield make.matrix_rank("window", system, window=s)
