"""The kernel representation of a system, found once: certificates, hypotheses, ablations and searches come to the same systems.

kernel_once    what `kernel_representation` returns, kept for the systems that were asked for last
space_once     its fault space, the limit of problem (11), likewise

It is for the small systems of boxes and corpora. A kernel representation is immutable, and takes a few kilobytes.
"""

from __future__ import annotations

from functools import lru_cache

from ...exact.structure.fault_columns import FaultSpace, fault_space
from ...exact.structure.kernel_rows import KernelRepresentation, kernel_representation
from ...exact.system.systems import ResidualSystem

MOST_KEPT = 1 << 13


@lru_cache(maxsize=MOST_KEPT)
def kernel_once(system: ResidualSystem) -> KernelRepresentation:
    """Return the kernel representation of a system. Raises what `kernel_representation` raises."""
    return kernel_representation(system)


@lru_cache(maxsize=MOST_KEPT)
def space_once(system: ResidualSystem) -> FaultSpace:
    """Return the limit of problem (11) of a system. Raises what `kernel_representation` raises."""
    return fault_space(kernel_once(system))
