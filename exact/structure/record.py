"""Everything the exact branch knows about a residual system, in one record: what `faultspace inspect` prints.

Structure       indices, zeros, orders, lag, observability, both delays, window ranks, problem (11) at every window
structure       of a ResidualSystem
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..algebra.matrices import Matrix
from ..algebra.polynomials import Poly, written
from ..system.systems import FaultySystem, ResidualSystem
from .fault_columns import FaultSpace, fault_space, fault_space_dimension
from .inversion import delay_known_state, delay_unknown_state
from .kernel_rows import KernelRepresentation, kernel_representation
from .pencil import infinite_zero_orders, invariant_zero_polynomial, right_minimal_indices


@dataclass(frozen=True)
class Structure:
    """The structural invariants of a residual system; names as in the module `pencil` and `kernel_representation`."""

    kernel: KernelRepresentation
    right_minimal_indices: tuple[int, ...]
    invariant_zero_polynomial: Poly
    infinite_zero_orders: tuple[int, ...]
    observable: bool
    controllable: bool
    delay_known_state: int | None
    delay_unknown_state: int | None
    fault_space: FaultSpace

    @property
    def system(self) -> ResidualSystem:
        """The system."""
        return self.kernel.system

    @property
    def finite_zeros(self) -> int:
        """n_f, the number of finite invariant zeros with multiplicity."""
        return len(self.invariant_zero_polynomial) - 1

    @property
    def zeta(self) -> int:
        """Finite and infinite zeros of the pencil together."""
        return self.finite_zeros + sum(self.infinite_zero_orders)

    @property
    def left_invertible(self) -> bool:
        """Whether the normal rank is m."""
        return self.kernel.normal_rank == self.system.m

    def to_json(self) -> dict[str, Any]:
        """The object that `faultspace inspect --json` prints."""
        system, kernel = self.system, self.kernel
        windows = range(1, system.n + 4)
        return {
            "field": system.field.to_json(),
            "n": system.n,
            "p": system.p,
            "m": system.m,
            "normal_rank": kernel.normal_rank,
            "left_minimal_indices": list(kernel.left_minimal_indices),
            "right_minimal_indices": list(self.right_minimal_indices),
            "invariant_zero_polynomial": written(self.invariant_zero_polynomial, system.field),
            "infinite_zero_orders": list(self.infinite_zero_orders),
            "zeta": self.zeta,
            "lag": kernel.lag,
            "observable": self.observable,
            "controllable": self.controllable,
            "left_invertible": self.left_invertible,
            "delay_known_state": self.delay_known_state,
            "delay_unknown_state": self.delay_unknown_state,
            "window_ranks": [kernel.rank(s) for s in windows],
            "fault_space_dimensions": [fault_space_dimension(kernel, s) for s in windows],
            "fault_space_dimension": self.fault_space.dimension,
            "fault_space": self.fault_space.basis.to_json(),
        }


def structure(system: ResidualSystem | FaultySystem) -> Structure:
    """The structure of a system (B and D play no part): any field, any dimensions, observable or not, left-invertible or not."""
    system = system.residual
    kernel = kernel_representation(system)
    right = right_minimal_indices(system)
    infinite = infinite_zero_orders(kernel)
    finite = system.n - sum(kernel.left_minimal_indices) - sum(right) - sum(infinite)
    return Structure(
        kernel=kernel,
        right_minimal_indices=right,
        invariant_zero_polynomial=invariant_zero_polynomial(kernel, finite),
        infinite_zero_orders=infinite,
        observable=_is_observable(system),
        controllable=_is_observable(system.transposed()),
        delay_known_state=delay_known_state(kernel),
        delay_unknown_state=delay_unknown_state(kernel),
        fault_space=fault_space(kernel),
    )


def _is_observable(system: ResidualSystem) -> bool:
    """rank O_n = n, read off the kernel representation of the system without faults."""
    faultless = system.with_faults(Matrix.zero(system.field, system.n, 0), Matrix.zero(system.field, system.p, 0))
    return kernel_representation(faultless).rank(system.n) == system.n
