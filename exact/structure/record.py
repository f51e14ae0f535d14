"""Everything the exact branch knows about a residual system, in one record: what `faultspace inspect` prints.

Structure       indices, zeros, orders, lag, observability, both delays, window ranks, problem (11) at every window
analyze         the Structure of a ResidualSystem
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ...base.progress import Progress, silent
from ...base.sheets import Shown, told
from ..algebra.matrices import Matrix
from ..algebra.notation import named_matrix, polynomial, several
from ..algebra.polynomials import Poly, written
from ..system.systems import ResidualSystem, System, residual_of
from .fault_columns import FaultSpace, fault_space, fault_space_dimension
from .inversion import delay_known_state, delay_unknown_state
from .kernel_rows import KernelRepresentation, kernel_representation
from .pencil import infinite_zero_orders, invariant_zero_polynomial, right_minimal_indices


@dataclass(frozen=True, repr=False)
class Structure(Shown):
    """Everything that is known exactly about a system with n states, m faults and p outputs; `analyze` makes it.

    `kernel` has the lag (a number of samples), the left minimal indices and the window ranks; `right_minimal_indices`,
    `infinite_zero_orders` and `invariant_zero_polynomial` (ascending coefficients) are those of the pencil [[qI - A, -F], [C, G]]; `zeta`
    is the number of zeros, finite and infinite; the delays are numbers of samples, or None; `fault_space` is the limit of problem (11).
    Source: [G25], [K80] 6.3 and [VD79] for the pencil. Raises nothing by itself.

    >>> import faultspace as fs
    >>> found = fs.analyze(fs.System(A=[["1/2"]], F=[["-3/2"]], C=[[1]], G=[[1]]))
    >>> found.invariant_zero_polynomial, found.zeta, found.delay_known_state, found.delay_unknown_state  # a zero at 2
    ((-2, 1), 1, 0, None)
    """

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
        """The system that the structure is of."""
        return self.kernel.system

    @property
    def finite_zeros(self) -> int:
        """n_f, the number of finite invariant zeros with multiplicity."""
        return len(self.invariant_zero_polynomial) - 1

    @property
    def zeta(self) -> int:
        """zeta is the number of zeros of the pencil, finite and infinite together."""
        return self.finite_zeros + sum(self.infinite_zero_orders)

    @property
    def left_invertible(self) -> bool:
        """This tells whether the normal rank is m."""
        return self.kernel.normal_rank == self.system.m

    @property
    def title(self) -> str:
        """This says how many states, faults and outputs there are, and over which field."""
        return self.system.sizes

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield what `faultspace inspect` prints, as (name, value) pairs."""
        kernel, n = self.kernel, self.system.n
        yield "pencil P(q) = [[qI - A, -F], [C, G]]", ""
        yield "normal rank r", f"{kernel.normal_rank} of at most {min(self.system.m, self.system.p)}"
        yield "left minimal indices", several(kernel.left_minimal_indices)
        yield "lag", str(kernel.lag)
        yield "right minimal indices", several(self.right_minimal_indices)
        yield "invariant zero polynomial", polynomial(self.invariant_zero_polynomial, self.system.field)
        yield "infinite zero orders", several(self.infinite_zero_orders)
        yield "zeros, finite + infinite = zeta", f"{self.finite_zeros} + {sum(self.infinite_zero_orders)} = {self.zeta}"
        yield "states and faults", ""
        yield "(A, C) observable", _yes(self.observable)
        yield "(A, F) controllable", _yes(self.controllable)
        yield "left-invertible (r = m)", _yes(self.left_invertible)
        yield "inversion delay, x(0) known", _delay(self.delay_known_state)
        yield "inversion delay, x(0) unknown", _delay(self.delay_unknown_state)
        document = self.to_json()
        yield f"windows of s = 1, ..., {n + 3} samples", ""
        yield "rank [O_s T_s]", several(document["window_ranks"])
        yield "dimension of problem (11)", several(document["fault_space_dimensions"])
        space = self.fault_space
        yield f"fault space: n_z = {space.dimension}, reached from s = {space.exact_from} on", ""
        yield from named_matrix("Fhat", space.F)
        yield from named_matrix("Ghat", space.G)

    def to_json(self) -> dict[str, Any]:
        """Return the object that `faultspace inspect --json` prints."""
        system, kernel = self.system, self.kernel
        windows = range(1, system.n + 4)
        return {
            "field": system.field.to_json(),
            **told(system, "n", "p", "m"),
            **told(kernel, "normal_rank", "left_minimal_indices"),
            "right_minimal_indices": list(self.right_minimal_indices),
            "invariant_zero_polynomial": written(self.invariant_zero_polynomial, system.field),
            **told(self, "infinite_zero_orders", "zeta"),
            "lag": kernel.lag,
            **told(self, "observable", "controllable", "left_invertible", "delay_known_state", "delay_unknown_state"),
            "window_ranks": [kernel.rank(s) for s in windows],
            "fault_space_dimensions": [fault_space_dimension(kernel, s) for s in windows],
            "fault_space_dimension": self.fault_space.dimension,
            "fault_space": self.fault_space.basis.to_json(),
        }


def analyze(system: System, *, on_progress: Progress | None = None) -> Structure:
    """Compute all that is known exactly about a system: its indices, zeros, delays, window ranks and fault space.

    Source: [G25]; [W91] for the lag.

    Parameters
    ----------
    system : System
        Over any field, with n states, m faults and p outputs, observable or not, left-invertible or not; B and D play no part.
    on_progress : callable, optional
        It hears how many of the points are done from which the zeros are interpolated, which is most of the work.

    Returns
    -------
    Structure
        `kernel.lag` (a number of samples), `kernel.left_minimal_indices`, `invariant_zero_polynomial` (ascending coefficients),
        `infinite_zero_orders`, `delay_known_state` and `delay_unknown_state` (samples, or None where there is no inverse) and
        `fault_space`, whose basis is n_z x (n + p) with rows [f' g'].

    Raises
    ------
    InvalidInput
        For anything that is no system.

    Examples
    --------
    >>> import faultspace as fs
    >>> found = fs.analyze(fs.System(A=[[0, 1], [0, 0]], F=[[0], [1]], C=[[1, 0], [0, 0]], G=[[0], [1]]))
    >>> found
    <Structure: 2 states, 1 fault, 2 outputs, over Q>
    >>> found.kernel.lag, found.delay_known_state
    (2, 0)
    """
    system = residual_of(system)
    kernel = kernel_representation(system)
    right = right_minimal_indices(system)
    infinite = infinite_zero_orders(kernel)
    finite = system.n - sum(kernel.left_minimal_indices) - sum(right) - sum(infinite)
    return Structure(
        kernel=kernel,
        right_minimal_indices=right,
        invariant_zero_polynomial=invariant_zero_polynomial(kernel, finite, on_progress or silent),
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


def _yes(value: bool) -> str:
    return "yes" if value else "no"


def _delay(value: int | None) -> str:
    return "none" if value is None else str(value)
