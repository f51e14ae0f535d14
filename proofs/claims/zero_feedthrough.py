"""zero-feedthrough: if G = 0, fault matrices and trajectory are recovered exactly, up to a choice of basis."""

from __future__ import annotations

from collections.abc import Iterator

from ...exact.algebra.matrices import rank
from ...exact.structure.fault_columns import fault_space
from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box
from ..evidence.corpus import Evidence
from ..evidence.kept_kernels import kernel_once
from ..evidence.questions import OBSERVABILITY, RANKS, SPACE, ZEROS
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench, certify, refute
from .common import zeros

BOX = Box(n=(1, 2), m=(1, 2), p=(1, 2), total=4)


def fault_matrices(bench: Workbench) -> Outcome:
    """With G = 0 known, every member of Z without feedthrough is claimed to lie in im F, for left-invertible observable systems."""
    return refute(
        bench,
        BOX,
        "observable and left_invertible and is_zero(G)",
        (RANKS, OBSERVABILITY, SPACE),
        lambda e: _applies(e) and e.observable,
        _pinned,
        _show,
    )


def exactly_when(bench: Workbench) -> Outcome:
    """With G = 0 and a left-invertible system, im F is determined iff zeta = m, that is iff rank CF = m and there are no finite zeros."""

    def holds(e: Evidence) -> bool:
        condition = rank(e.system.C @ e.system.F) == e.system.m and e.finite_zeros == 0
        return _pinned(e) == condition == (e.zeta == e.system.m)

    return certify(bench, (RANKS, *ZEROS, SPACE), _applies, holds, _show)


def _applies(e: Evidence) -> bool:
    return e.left_invertible and e.system.G.is_zero()


def _pinned(e: Evidence) -> bool:
    return e.without_feedthrough == rank(e.system.F)


def _show(system: ResidualSystem) -> Iterator[Certificate]:
    yield from zeros(system)
    kernel = kernel_once(system)
    yield make.fault_space(kernel, fault_space(kernel))
