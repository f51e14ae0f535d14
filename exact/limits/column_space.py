"""This is what PI-MOESP and PO-MOESP converge to: the population limit of the projected outputs, and what its column space says of A, C.

    past_input_limit             Z = Up: past inputs as instruments, PI-MOESP [V93]
    past_input_and_output_limit  Z = [Up; Yp]: PO-MOESP, as in the packaged subspace tools that we measured
    Limit                        L, its rank beside that of O_s and of [O_s L], the projection X, the model (A, C) that its columns carry
    StatePart                    A, C of a shift-invariant column space, up to similarity

L = Cov(Yf, Z) - Cov(Yf, Uf) X with Cov(Uf, Uf) X = Cov(Uf, Z) is the limit of (1/N) Yf Pi Z', Pi projecting on the complement of the rows
of Uf. Where L has the columns of O_s, (A, C) observable on s - 1 samples, every choice of n independent columns gives the true A, C. Where
its rank is smaller, states are missing. Where it has these columns and more, they are not told apart by the rank, which is above n; the
leading left singular vectors can still span the range of O_s, exactly, and then A, C are right: `leading_vectors` decides that.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..algebra.matrices import Matrix, beside, column_basis, left_null_space, rank
from ..algebra.stability import rational_characteristic_polynomial
from ..system.modular import LARGEST_PRIME, reduce_matrix
from ..system.windows import observability_matrix
from .experiments import Experiment
from .lyapunov import solve
from .moments import WindowCovariances


@dataclass(frozen=True)
class StatePart:
    """A (n x n) and C (p x n) with the limit's column space equal to that of C, CA, ..., CA^(s-1); unique up to similarity."""

    A: Matrix
    C: Matrix

    @property
    def characteristic_polynomial(self) -> tuple[Fraction, ...]:
        """det(qI - A), ascending and monic."""
        return rational_characteristic_polynomial(self.A)


@dataclass(frozen=True)
class Limit:
    """The limit L (s p x rows of Z) and its projection X (s nu x rows of Z), with the ranks of L, O_s and [O_s L].

    `state` is None where the column space is not shift-invariant of rank n, n the number of states of the system.
    """

    matrix: Matrix
    projection: Matrix
    rank: int
    observability_rank: int
    joint_rank: int
    state: StatePart | None

    @property
    def within_observability_range(self) -> bool:
        """This tells whether every column of L is one of O_s."""
        return self.joint_rank == self.observability_rank

    @property
    def contains_observability_range(self) -> bool:
        """This tells whether every column of O_s is one of L."""
        return self.joint_rank == self.rank

    @property
    def equals_observability_range(self) -> bool:
        """This tells whether the column spaces are the same."""
        return self.within_observability_range and self.contains_observability_range


def past_input_limit(experiment: Experiment, blocks: WindowCovariances) -> Limit:
    """Return what PI-MOESP's projected outputs converge to."""
    return _limit(experiment, blocks, blocks.yf_up, blocks.uf_up)


def past_input_and_output_limit(experiment: Experiment, blocks: WindowCovariances) -> Limit:
    """Return what PO-MOESP's projected outputs converge to."""
    return _limit(experiment, blocks, beside(blocks.yf_up, blocks.yf_yp), beside(blocks.uf_up, blocks.uf_yp))


def _limit(experiment: Experiment, blocks: WindowCovariances, outputs: Matrix, inputs: Matrix) -> Limit:
    residual = experiment.system.residual
    projection = solve(blocks.uf_uf, inputs)
    matrix = outputs - blocks.yf_uf @ projection
    observability = observability_matrix(residual, experiment.s)
    seen = rank(observability)
    # Rows orthogonal to O_s see of [O_s L] what L adds; rank L is at most the rank of both, and at least its rank modulo a prime.
    joint = seen + rank(left_null_space(observability) @ matrix)
    own = joint if _modular_rank(matrix) == joint else rank(matrix)
    state = None
    if own == residual.n:
        state = state_part(observability if own == seen == joint else column_basis(matrix), residual.p)
    return Limit(matrix, projection, own, seen, joint, state)


def _modular_rank(matrix: Matrix) -> int:
    """Return the rank modulo a prime, 0 where that divides a denominator: a lower bound."""
    reduced = reduce_matrix(matrix, LARGEST_PRIME, None)
    return 0 if reduced is None else rank(reduced)


def state_part(basis: Matrix, p: int) -> StatePart | None:
    """Return A, C from independent columns in block rows of p, or None where their space is not shift-invariant.

    A space is shift-invariant where dropping the last block row loses no column, and the rows below the first are combinations W+ = W- A.
    """
    upper, lower = basis.rows(range(basis.nrows - p)), basis.rows(range(p, basis.nrows))
    if rank(upper) < basis.ncols:
        return None
    gram = upper.transposed() @ upper
    A = solve(gram, upper.transposed() @ lower)
    return StatePart(A, basis.rows(range(p))) if upper @ A == lower else None
