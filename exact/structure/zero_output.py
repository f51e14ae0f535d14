"""Ranks of [O_s T_s] for every s at once, by the output-nulling recursion; the block matrix is never built.

    W_k                  states reachable at time k with zero output on 0..k-1: W_0 = K^n,
                         W_(k+1) = [A W_k, F] ker [C W_k, G]; decreasing, constant once a dimension repeats
    gap(k)               rank [O_(k+1) T_(k+1)] - rank [O_k T_k] = rank [C W_k, G]
    profile(k)           the outputs of sample k that do not depend on earlier ones
    zero_output_chain    the recursion from W_0 = K^n
    from_rest            the same from W_0 = 0: the ranks of T_s; increasing

The recursion is exact over any field. Over Q and Q(a) its entries grow like the trap they are: run it modulo a prime and let a kernel
representation turn the bound into the truth (`kernel_representation`). For prime fields it is the whole answer. Source: [TSH01] ch.
7-8, [M73].
"""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.matrices import Matrix, beside, column_basis, right_null_space, row_profile
from ..system.systems import ResidualSystem


@dataclass(frozen=True)
class ZeroOutputChain:
    """dim W_k, gap(k) and the independent outputs of sample k, for k = 0, 1, ...; the last of each repeats for ever."""

    dimensions: tuple[int, ...]
    profiles: tuple[tuple[int, ...], ...]
    last_subspace: Matrix

    def gap(self, k: int) -> int:
        """Return rank [O_(k+1) T_(k+1)] - rank [O_k T_k]."""
        return len(self.profiles[min(k, len(self.profiles) - 1)])

    def rank(self, s: int) -> int:
        """Return rank [O_s T_s], from rest rank T_s."""
        return sum(self.gap(k) for k in range(s))

    @property
    def final_gap(self) -> int:
        """The gap of all large windows: the normal rank."""
        return len(self.profiles[-1])


def zero_output_chain(system: ResidualSystem) -> ZeroOutputChain:
    """The chain starts from W_0 = K^n; `last_subspace` is W_n, a column basis."""
    return _chain(system, Matrix.identity(system.field, system.n))


def chain_from_rest(system: ResidualSystem) -> ZeroOutputChain:
    """The chain starts from W_0 = 0, and its ranks are those of T_s; `last_subspace` is the smallest strongly reachable subspace S*."""
    return _chain(system, Matrix.zero(system.field, system.n, 0))


def _chain(system: ResidualSystem, subspace: Matrix) -> ZeroOutputChain:
    dimensions: list[int] = []
    profiles: list[tuple[int, ...]] = []
    while True:
        outputs = beside(system.C @ subspace, system.G)
        dimensions.append(subspace.ncols)
        profiles.append(row_profile(outputs))
        states = beside(system.A @ subspace, system.F)
        successor = column_basis(states @ right_null_space(outputs))
        if successor.ncols == subspace.ncols:  # monotone, so equal dimensions are equal spaces, for ever
            return ZeroOutputChain(tuple(dimensions), tuple(profiles), subspace)
        subspace = successor
