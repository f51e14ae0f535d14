"""These are exact trajectories, their Hankel matrices, and rank and problem (11) read off data instead of a model.

    Trajectory           x (N+1) x n, v N x m, r N x p, time-major
    simulate             the trajectory from x0 under v
    hankel               s block rows: block (i, k) = sample i + k; ps x (N - s + 1)
    excitation_matrix    [X; V_s], (n + ms) x (N - s + 1)
    persistency          the largest order of which a signal is persistently exciting
    data_fault_space     problem (11) with N_s from the left null space of R_s

R_s = [O_s T_s] [X; V_s], so where [X; V_s] has full row rank the data say all that the model does. Source: [G25] section IV, [WRMM05].
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ...base.errors import InvalidInput
from ...base.sheets import Shown, counted
from ..algebra.matrices import Matrix, as_matrix, left_null_space, rank, stacked
from ..algebra.notation import named_matrix
from ..algebra.validation import natural
from ..system.systems import System, residual_of
from .fault_columns import from_kernel_rows


@dataclass(frozen=True, repr=False)
class Trajectory(Shown):
    """A trajectory of N steps: `states` x(0..N), (N+1) x n, `faults` v(0..N-1), N x m, and `residuals` r(0..N-1), N x p.

    `simulate` makes it; time runs down the rows, and all three are over the field of the system. Source: [G25] section IV for what data it
    stands for. Raises nothing by itself.

    >>> from faultspace.exact import Matrix, ResidualSystem, simulate
    >>> found = simulate(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]]), x0=Matrix.of([[4]]), v=Matrix.of([[0], [0]]))
    >>> found.states, found.residuals
    ([[4], [2], [1]], [[4], [2]])
    """

    states: Matrix
    faults: Matrix
    residuals: Matrix

    @property
    def title(self) -> str:
        """This says how long the trajectory is, and how many states, faults and residuals it has."""
        return ", ".join(
            counted(number, noun)
            for number, noun in (
                (self.faults.nrows, "step"),
                (self.states.ncols, "state"),
                (self.faults.ncols, "fault"),
                (self.residuals.ncols, "residual"),
            )
        )

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are the three signals, a line a sample; of long ones the middle is left out."""
        yield from named_matrix("x(k)", self.states)
        yield from named_matrix("v(k)", self.faults)
        yield from named_matrix("r(k)", self.residuals)

    def to_json(self) -> dict[str, Any]:
        """Each signal is a list with one row a sample."""
        return {"x": self.states.to_json(), "v": self.faults.to_json(), "r": self.residuals.to_json()}


def simulate(system: System, x0: object, v: object) -> Trajectory:
    """Return the exact trajectory of a residual system from an initial state under a fault.

    Of a system with inputs it is the trajectory for u = 0. Source: [G25] section IV.

    Parameters
    ----------
    system : System
    x0 : Matrix or nested lists, shape (n, 1)
    v : Matrix or nested lists, shape (N, m)
        Time runs down the rows; both are over the field of the system.

    Returns
    -------
    Trajectory

    Raises
    ------
    InvalidInput
        When a shape or field does not fit, and for what is no system.

    Examples
    --------
    >>> from faultspace.exact import Matrix, ResidualSystem, simulate
    >>> system = ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]])
    >>> simulate(system, x0=Matrix.of([[0]]), v=Matrix.of([[1], [0], [0]])).residuals
    [[0], [1], [1/2]]
    """
    system = residual_of(system)
    x0, v = Matrix.of(x0, system.field, where="x0"), Matrix.of(v, system.field, where="v")
    if x0.shape != (system.n, 1) or v.ncols != system.m:
        raise InvalidInput(f"x0, v: got {x0.shape} and {v.shape}, expected ({system.n}, 1) and (N, {system.m})")
    # Time runs down the rows, so that all is transposed; what does not depend on the states is one product.
    driven, A = v @ system.F.transposed(), system.A.transposed()
    x = x0.transposed()
    states = [x]
    for k in range(v.nrows):
        x = x @ A + driven.rows([k])
        states.append(x)
    X = stacked(*states)
    return Trajectory(X, v, X.rows(range(v.nrows)) @ system.C.transposed() + v @ system.G.transposed())


def hankel(signal: Matrix, s: int) -> Matrix:
    """Return the block Hankel matrix with s block rows of a time-major signal (N x q): qs x (N - s + 1). Raises InvalidInput if N <
    s.
    """
    s = natural(s, "window")
    if s > signal.nrows:
        raise InvalidInput(f"window: got {s} with {signal.nrows} samples, expected 0 <= window <= samples")
    columns = signal.nrows - s + 1
    blocks = [signal.rows(range(i, i + columns)).transposed() for i in range(s)]
    return stacked(Matrix.zero(signal.field, 0, columns), *blocks)


def excitation_matrix(trajectory: Trajectory, s: int) -> Matrix:
    """Return [X; V_s], (n + ms) x (N - s + 1). Raises InvalidInput if there are fewer than s samples."""
    faults = hankel(trajectory.faults, s)
    return stacked(trajectory.states.rows(range(faults.ncols)).transposed(), faults)


def persistency(signal: Matrix) -> int:
    """Return the largest order s with a block Hankel matrix of full row rank, which is 0 where there is none."""
    order = 0
    while order < signal.nrows and rank(hankel(signal, order + 1)) == signal.ncols * (order + 1):
        order += 1
        if signal.ncols == 0:
            return signal.nrows
    return order


def data_fault_space(residuals: Matrix, A: Matrix, C: Matrix, s: int) -> Matrix:
    """Return the fault space as data tell it: problem (11) with the left null space of their Hankel matrix for kernel rows.

    Where [X; V_s] has full row rank the rows are those of `fault_space` at window s; a fault that excites less can leave more null
    rows, and a smaller space. Source: [G25] problem (11) and section IV, [WRMM05] for excitation.

    Parameters
    ----------
    residuals : Matrix, shape (N, p)
        Time runs down the rows. Nested lists are taken over Q.
    A, C : Matrix, shapes (n, n) and (p, n)
        Over the same field.
    s : int
        A number of samples.

    Returns
    -------
    Matrix, shape (n_z, n + p)
        Rows [f' g'] in reduced row echelon form.

    Raises
    ------
    InvalidInput
        For s that is no integer >= 0, and if there are fewer than s samples.

    Examples
    --------
    >>> from faultspace.exact import Matrix, ResidualSystem, data_fault_space, simulate
    >>> system = ResidualSystem.of([["1/2"]], [[1]], [[1], [0]], [[0], [0]])
    >>> data = simulate(system, x0=Matrix.of([[1]]), v=Matrix.of([[1], [0], [0], [1], [1], [0], [1]]))
    >>> data_fault_space(data.residuals, system.A, system.C, s=2)
    [[1, 0, 0], [0, 1, 0]]
    """
    residuals = as_matrix(residuals, "residuals")
    A, C = as_matrix(A, "A", residuals.field), as_matrix(C, "C", residuals.field)
    null = left_null_space(hankel(residuals, s))
    p = residuals.ncols
    rows = [
        stacked(Matrix.zero(A.field, 0, p), *(null.rows([i]).columns(range(k * p, k * p + p)) for k in range(s))) for i in range(null.nrows)
    ]
    return from_kernel_rows(rows, A, C)
