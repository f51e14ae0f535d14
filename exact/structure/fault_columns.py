"""This solves problem (11): all fault columns z = [f; g] that explain no more than the system does, on a window and in the limit.

    FaultSpace          the solution space at a window; `basis` = [F_z; G_z]' in reduced row echelon form, dim x (n + p)
    fault_space         of a kernel representation; window None: the limit Z, reached from lag + 1 samples on
    from_kernel_rows    the same from any left null rows, of a model or of data
    with_pair           the system (A, Fhat P, C, Ghat P) for a dim x k matrix P

z solves (11), N_s T_s(z) = 0 with all block columns, iff every kernel row of degree below s annihilates the system (A, f, C, g).
Equal spaces have equal bases. Source: [G25] problem (11), Theorem 3.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from ...base.errors import InvalidInput
from ...base.sheets import Shown, counted, told
from ..algebra.matrices import Matrix, right_null_space, row_echelon, stacked
from ..algebra.notation import named_matrix
from ..algebra.validation import natural
from ..system.systems import ResidualSystem, System
from .kernel_rows import KernelRepresentation, column_conditions, kernel_of


@dataclass(frozen=True, repr=False)
class FaultSpace(Shown):
    """The space of all fault columns [f; g] that explain no more than the system does, on a window or in the limit.

    `basis` is n_z x (n + p) in reduced row echelon form, with rows [f' g'], so that equal spaces have equal bases; `F` (n x n_z) and `G` (p
    x n_z) are the columns. `window` is a number of samples, None for the limit; `exact_from`, which is lag + 1, or 1 where there is no
    kernel row, is the least window at which the limit is reached, and `warning` says so where the window is shorter. Source: [G25] problem
    (11), Theorem 3. Raises nothing by itself; `fault_space` makes it.

    >>> from faultspace.exact import ResidualSystem, fault_space, kernel_representation
    >>> kernel = kernel_representation(ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 0], [0, 0]], [[0], [1]]))
    >>> limit, short = fault_space(kernel), fault_space(kernel, window=1)
    >>> limit.basis, limit.exact_from, short.dimension, short.is_limit
    ([[0, 1, 0, 1]], 3, 4, False)
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
        """This tells whether the window is long enough for the space to be the limit Z."""
        return self.window is None or self.window >= self.exact_from

    @property
    def warning(self) -> str | None:
        """This says why the solutions on a short window are not yet the limit Z, and what to ask for; it is None where they are."""
        if self.is_limit:
            return None
        lag, samples = self.exact_from - 1, f"{counted(self.window or 0, 'sample')} {'is' if self.window == 1 else 'are'}"
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

    @property
    def title(self) -> str:
        """This says how many fault columns there are, and on what window."""
        where = "in the limit" if self.window is None else f"on a window of {counted(self.window, 'sample')}"
        return f"{counted(self.dimension, 'fault column')} {where}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are the fault columns, and what is to be known of the window."""
        yield "the limit is reached from", counted(self.exact_from, "sample")
        yield from named_matrix("Fhat", self.F)
        yield from named_matrix("Ghat", self.G)
        if self.warning is not None:
            yield "but", self.warning

    def to_json(self) -> dict[str, Any]:
        """The rows of "fault_space" are [f' g']."""
        return told(self, "window", "exact_from", "dimension") | {"fault_space": self.basis.to_json()}


def from_kernel_rows(rows: Iterable[Matrix], A: Matrix, C: Matrix) -> Matrix:
    """Return the basis rows [f' g'] of the columns that all rows ((mu + 1) x p coefficients each) annihilate, in echelon form."""
    nothing = Matrix.zero(A.field, 0, A.nrows + C.nrows)
    conditions = stacked(nothing, *(column_conditions(row, A, C) for row in rows))
    return row_echelon(right_null_space(conditions).transposed()).matrix


def fault_space(kernel: KernelRepresentation | System, window: int | None = None) -> FaultSpace:
    """Return the solution space of problem (11) on a window, or its limit Z, of which every equivalent F and G is made.

    A column z = [f; g] is in the space iff every kernel row of degree below the window annihilates the system (A, f, C, g). Source: [G25]
    problem (11), Theorem 3.

    Parameters
    ----------
    kernel : KernelRepresentation or System
        Of n states and p outputs.
    window : int, optional
        A number of samples >= 0; None for the limit, which is reached from lag + 1 samples on.

    Returns
    -------
    FaultSpace

    Raises
    ------
    InvalidInput
        For a window that is no integer >= 0, and for what is no system.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, fault_space, kernel_representation
    >>> space = fault_space(kernel_representation(ResidualSystem.of([["1/2"]], [[1]], [[1], [0]], [[0], [0]])))
    >>> space.F, space.G  # the second output is no fault's
    ([[1, 0]], [[0, 1], [0, 0]])
    """
    window = None if window is None else natural(window, "window")
    kernel = kernel_of(kernel)
    system = kernel.system
    basis = from_kernel_rows((row.coefficients for row in kernel.rows_within(window)), system.A, system.C)
    return FaultSpace(system, window, kernel.lag + 1, basis)


def fault_space_dimension(kernel: KernelRepresentation | System, window: int | None = None) -> int:
    """Return the dimension of the space of problem (11), found without the space.

    It is n + p less the sum of mu + 1 over the kernel rows of degree mu below the window. Source: [G25] problem (11), [F75] for the
    indices.

    Parameters
    ----------
    kernel : KernelRepresentation or System
    window : int, optional
        A number of samples; None for the limit.

    Returns
    -------
    int

    Raises
    ------
    InvalidInput
        For a window that is no integer >= 0, and for what is no system.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, fault_space_dimension, kernel_representation
    >>> kernel = kernel_representation(ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 0], [0, 0]], [[0], [1]]))
    >>> [fault_space_dimension(kernel, s) for s in (1, 2, 3, None)]
    [4, 4, 1, 1]
    """
    kernel = kernel_of(kernel)
    system = kernel.system
    return system.n + system.p - sum(row.degree + 1 for row in kernel.rows_within(window))


def with_pair(space: FaultSpace | KernelRepresentation | System, P: object) -> ResidualSystem:
    """Return the system (A, Fhat P, C, Ghat P) whose fault matrices are the columns of a fault space combined by P.

    `judge` says whether it is equivalent. Source: [G25] Theorem 3.

    Parameters
    ----------
    space : FaultSpace or KernelRepresentation or System
        Of a system the limit is taken.
    P : what `Matrix.of` takes, shape (n_z, k)
        Over the same field.

    Returns
    -------
    ResidualSystem

    Raises
    ------
    InvalidInput
        For another shape.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, fault_space, kernel_representation, with_pair
    >>> space = fault_space(kernel_representation(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]])))
    >>> print(with_pair(space, [[3], [2]]))
    A=[[1/2]], F=[[3]], C=[[1]], G=[[2]]
    """
    space = space if isinstance(space, FaultSpace) else fault_space(space)
    P = Matrix.of(P, space.system.field, where="P")
    if P.nrows != space.dimension:
        raise InvalidInput(f"P: got {P.nrows} x {P.ncols}, expected {counted(space.dimension, 'row')}, one a basis column")
    return space.system.with_faults(space.F @ P, space.G @ P)
