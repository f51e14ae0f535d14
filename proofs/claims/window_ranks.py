"""window-ranks: every window at once, from the minimal indices of the pencil, without any hypothesis."""

from __future__ import annotations

from collections.abc import Iterator

from ...exact.structure.kernel_rows import kernel_representation
from ...exact.system.systems import ResidualSystem
from ..evidence.corpus import Evidence
from ..evidence.questions import RANKS, RIGHT_INDICES, SPACE, WINDOW_SPACES, WINDOWS, ZEROS
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench, certify
from .common import spaces, zeros


def ranks(bench: Workbench) -> Outcome:
    """rank [O_s T_s] = s r + sum of min(s, eta_i), which is compared with the rank of each window by itself for s = 1, ..., n + 2."""
    return certify(
        bench,
        (RANKS, WINDOWS),
        lambda e: True,
        lambda e: all(e.kernel.rank(s) == rank for s, rank in enumerate(e.window_ranks, 1)),
        _windows,
    )


def indices(bench: Workbench) -> Outcome:
    """n = sum eta + sum eps + n_f + n_inf, where indices and zeros are each from certificates of their own."""

    def holds(e: Evidence) -> bool:
        return e.system.n == sum(e.kernel.left_minimal_indices) + sum(e.right_minimal_indices) + e.zeta

    return certify(bench, (RANKS, RIGHT_INDICES, *ZEROS), lambda e: True, holds, _all_indices)


def solutions(bench: Workbench) -> Outcome:
    """Problem (11) at window s has dimension n + p - sum of (eta_i + 1) over eta_i <= s - 1."""

    def holds(e: Evidence) -> bool:
        predicted = [
            e.system.n + e.system.p - sum(eta + 1 for eta in e.kernel.left_minimal_indices if eta < s)
            for s in range(1, len(e.space_dimensions) + 1)
        ]
        return list(e.space_dimensions) == predicted

    return certify(bench, (RANKS, WINDOW_SPACES), lambda e: True, holds, spaces(lambda s: s.n + 1))


def limit(bench: Workbench) -> Outcome:
    """The limit has n_z = r + zeta + sum eps, which is n_v + zeta where the system is left-invertible."""

    def holds(e: Evidence) -> bool:
        return e.fault_space.dimension == e.kernel.normal_rank + e.zeta + sum(e.right_minimal_indices)

    return certify(bench, (RANKS, RIGHT_INDICES, *ZEROS, SPACE), lambda e: True, holds, _all_indices)


def _windows(system: ResidualSystem) -> Iterator[Certificate]:
    yield make.window_ranks(kernel_representation(system))
    for s in range(1, system.n + 2):
        yield make.matrix_rank("window", system, window=s)


def _all_indices(system: ResidualSystem) -> Iterator[Certificate]:
    yield from zeros(system)
    yield make.window_ranks(kernel_representation(system.transposed()))
