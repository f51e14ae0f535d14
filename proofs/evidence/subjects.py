"""One exact system with everything that quantities ask of it, found when it is first asked for, and kernel representations found once.

Subject      the system, with kernel representations of it and of its relatives
kernel       that of the system: left minimal indices, ranks of [O_s T_s]
dual         that of the transposed system (A', C', F', G'): right minimal indices
silent       that of (A, C) without faults: ranks of O_s
reached      that of (A', F') without faults: ranks of [F, AF, ...]
kernel_once  what `kernel_representation` returns, kept for the systems that were asked for last
space_once   its fault space, the limit of problem (11), likewise

Certificates, hypotheses, ablations and searches come to the same small systems; a kernel representation takes a few kilobytes.
"""

from __future__ import annotations

from functools import cached_property, lru_cache

from ...exact.algebra.matrices import Matrix
from ...exact.algebra.polynomials import Poly
from ...exact.structure.fault_columns import FaultSpace, fault_space
from ...exact.structure.inversion import largest_output_nulling
from ...exact.structure.kernel_rows import KernelRepresentation, kernel_representation
from ...exact.structure.pencil import infinite_zero_orders, invariant_zero_polynomial
from ...exact.structure.zero_output import chain_from_rest
from ...exact.system.systems import ResidualSystem


class Subject:
    """A system over Q or GF(p) with n states, m faults and p outputs, and what is known of it."""

    def __init__(self, system: ResidualSystem) -> None:
        self.system = system

    @cached_property
    def transposed(self) -> ResidualSystem:
        """(A', C', F', G')."""
        return self.system.transposed()

    @cached_property
    def faultless(self) -> ResidualSystem:
        """(A, C), with no fault."""
        return without_faults(self.system)

    @cached_property
    def kernel(self) -> KernelRepresentation:
        """This has the left minimal indices and the rank of [O_s T_s] for every s."""
        return kernel_once(self.system)

    @cached_property
    def dual(self) -> KernelRepresentation:
        """This has the right minimal indices."""
        return kernel_once(self.transposed)

    @cached_property
    def silent(self) -> KernelRepresentation:
        """This has the rank of O_s for every s; its lag is the observability index."""
        return kernel_representation(self.faultless)

    @cached_property
    def reached(self) -> KernelRepresentation:
        """This has the rank of [F, AF, ..., A^(s-1) F] for every s; its lag is the controllability index."""
        return kernel_representation(without_faults(self.transposed))

    @cached_property
    def fault_space(self) -> FaultSpace:
        """All solutions of problem (11), with their reduced basis."""
        return fault_space(self.kernel)

    @cached_property
    def infinite_zero_orders(self) -> tuple[int, ...]:
        """The orders of the infinite zeros, ascending, one a unit of normal rank, zeros included."""
        return infinite_zero_orders(self.kernel)

    @cached_property
    def finite_zeros(self) -> int:
        """The number of finite zeros with multiplicity: the states that neither indices nor infinite zeros take."""
        indices = (*self.kernel.left_minimal_indices, *self.dual.left_minimal_indices)
        return self.system.n - sum(indices) - sum(self.infinite_zero_orders)

    @cached_property
    def zero_polynomial(self) -> Poly:
        """The product of the invariant polynomials of the pencil, monic, coefficients ascending."""
        return invariant_zero_polynomial(self.kernel, self.finite_zeros)

    @cached_property
    def weakly_unobservable(self) -> Matrix:
        """V*, a column basis."""
        return largest_output_nulling(self.system)

    @cached_property
    def strongly_reachable(self) -> Matrix:
        """S*, a column basis."""
        return chain_from_rest(self.system).last_subspace


def without_faults(system: ResidualSystem) -> ResidualSystem:
    """Return (A, C) as a system with no fault."""
    return system.with_faults(Matrix.zero(system.field, system.n, 0), Matrix.zero(system.field, system.p, 0))


MOST_KEPT = 1 << 13


@lru_cache(maxsize=MOST_KEPT)
def kernel_once(system: ResidualSystem) -> KernelRepresentation:
    """Return the kernel representation of a system. Raises what `kernel_representation` raises."""
    return kernel_representation(system)


@lru_cache(maxsize=MOST_KEPT)
def space_once(system: ResidualSystem) -> FaultSpace:
    """Return the limit of problem (11) of a system. Raises what `kernel_representation` raises."""
    return fault_space(kernel_once(system))
