"""Problem (11): all fault columns z = [f; g] that explain no more than the system does, on a window and in the limit.

    FaultSpace          the solution space at a window; `basis` = [F_z; G_z]' in reduced row echelon form, dim x (n + p)
    fault_space         of a kernel representation; window None: the limit Z, reached from lag + 1 samples on
    from_kernel_rows    the same from any left null rows, of a model or of data
    with_pair           the system (A, Fhat P, C, Ghat P) for a dim x k matrix P

z solves (11), N_s T_s(z) = 0 with all block columns, iff every kernel row of degree below s annihilates the system (A, f, C, g).
Equal spaces have equal bases. Source: [G25] problem (11), Theorem 3.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ...base.errors import InvalidInput
from ..algebra.matrices import Matrix, right_null_space, row_echelon, stacked
from ..system.systems import ResidualSystem
from .kernel_rows import KernelRepresentation, column_conditions


@dataclass(frozen=True)
class FaultSpace:
    """The solution space of problem (11) for `system` on `window` samples (None: the limit), as basis rows [f' g'].

    `exact_from` is the least window at which the limit is reached: lag + 1, or 1 where there is no kernel row.
    """

    system: ResidualSystem
    window: int | None
    exact_from: int
    basis: Matrix

    @property
    def dimension(self) -> int:
        """n_z at this window."""
        return self.basis.nrows

    @property
    def is_limit(self) -> bool:
        """Whether the window is long enough for the space to be the limit Z."""
        return self.window is None or self.window >= self.exact_from

    @property
    def warning(self) -> str | None:
        """Why the solutions on a short window are not yet the limit Z, naming the lag and what to ask for; None where they are."""
        if self.is_limit:
            return None
        lag, samples = self.exact_from - 1, "1 sample is" if self.window == 1 else f"{self.window} samples are"
        return (
            f"window: {samples} fewer than lag + 1 = {lag + 1} (the lag is {lag}), so that the {self.dimension} columns "
            f"found include some that are no fault columns of an equivalent model; ask for {lag + 1} samples or for the limit"
        )

    @property
    def F(self) -> Matrix:
        """Fhat, n x n_z."""
        return self.basis.columns(range(self.system.n)).transposed()

    @property
    def G(self) -> Matrix:
        """Ghat, p x n_z."""
        return self.basis.columns(range(self.system.n, self.system.n + self.system.p)).transposed()


def from_kernel_rows(rows: Iterable[Matrix], A: Matrix, C: Matrix) -> Matrix:
    """Basis rows [f' g'] of the columns that all rows ((mu + 1) x p coefficients each) annihilate, in echelon form."""
    nothing = Matrix.zero(A.field, 0, A.nrows + C.nrows)
    conditions = stacked(nothing, *(column_conditions(row, A, C) for row in rows))
    return row_echelon(right_null_space(conditions).transposed()).matrix


def fault_space(kernel: KernelRepresentation, window: int | None = None) -> FaultSpace:
    """The solution space of problem (11) on `window` >= 0 samples, or the limit Z. Raises InvalidInput for a negative window."""
    if window is not None and (type(window) is not int or window < 0):
        raise InvalidInput(f"window: got {window!r}, expected an integer >= 0 or None")
    system = kernel.system
    basis = from_kernel_rows((row.coefficients for row in kernel.rows_within(window)), system.A, system.C)
    return FaultSpace(system, window, kernel.lag + 1, basis)


def fault_space_dimension(kernel: KernelRepresentation, window: int | None = None) -> int:
    """n + p - sum over rows of degree below the window of (mu + 1): the dimension without the space."""
    system = kernel.system
    return system.n + system.p - sum(row.degree + 1 for row in kernel.rows_within(window))


def with_pair(space: FaultSpace, P: object) -> ResidualSystem:
    """(A, Fhat P, C, Ghat P) for P of shape n_z x k, what `Matrix.of` takes, over the same field. Raises InvalidInput for another shape."""
    P = Matrix.of(P, space.system.field, where="P")
    if P.nrows != space.dimension:
        raise InvalidInput(f"P: got {P.nrows} x {P.ncols}, expected {space.dimension} rows, one a basis column")
    return space.system.with_faults(space.F @ P, space.G @ P)
