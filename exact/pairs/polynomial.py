"""This tells which P give a pair (Fhat P, Ghat P) with the behaviour of the system, and with which zeros: the polynomial D(q; P).

    Exceptional          Z = im [Fhat; Ghat], U = {u : [u; 0] in Z}, and the coordinates b of [U; 0] and a of [A U; C U] in Z
    exceptional          of a kernel representation
    PairVerdict          a P with D(q; P), its rank, and where it is bad a null vector of the pencil
    judge                the verdict on a P of r columns, r the normal rank (m where the system is left-invertible)

    D(q; P) = det [ P | q b - a ]            n_z x n_z, n_z = r + zeta, linear in the r x r minors of P

Up to a unit it is the greatest common divisor of the maximal minors of the pencil of (A, Fhat P, C, Ghat P), for every system,
observable, controllable, left-invertible or not: with W completing U to a basis of K^n, that pencil is, by column operations and a sign
of rows,

    [ [qI - A; -C] W | Fhat;Ghat ] diag(I, [ q b - a | P ]),

and the left factor has full column rank at every q: a null vector would give w outside U with [(q - A) w; -C w] in Z, which the kernel
rows N(q) allow only for w in U. So P is bad, the normal rank of its pair below r, iff D(q; P) = 0. U is V* + S* of the system.

In coordinates of Z that begin with b the pencil q b - a is [qI - A_U; -C_U]: (A_U, C_U) has zeta states, its unobservable ones are those
of (A, C), and with a minimal basis L(q) of its left kernel, of degrees k_1..k_r,

    D(q; P) = unit * fixed(q) * det(L(q) P),      fixed = characteristic polynomial of A on the unobservable subspace,

sum k_j = zeta - deg fixed. Source: [G25] Theorem 3, [M73] and [TSH01] for V* and S*, [F75] for L.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ...base.errors import InvalidInput
from ...base.sheets import Shown, counted
from ..algebra.matrices import Matrix, beside, left_null_space, rank, row_echelon, row_profile, solve_left, stacked
from ..algebra.notation import named_matrix, polynomial, several
from ..algebra.polynomials import Poly, written
from ..structure.fault_columns import FaultSpace, fault_space, with_pair
from ..structure.kernel_rows import KernelRepresentation, column_conditions, kernel_of, kernel_representation
from ..structure.pencil import NullPolynomial, right_null_polynomial, zero_dynamics_polynomial
from ..system.systems import ResidualSystem, System
from .linear_determinants import linear_determinant


@dataclass(frozen=True, repr=False)
class Exceptional(Shown):
    """The pencil q b - a of a system's fault space Z.

    `kernel` and `space` are those of the system; `states` is U (n x zeta, reduced column echelon form); `b` and `a` (n_z x zeta) satisfy
    [Fhat; Ghat] b = [U; 0] and [Fhat; Ghat] a = [A U; C U].
    """

    kernel: KernelRepresentation
    space: FaultSpace
    states: Matrix
    b: Matrix
    a: Matrix

    @property
    def system(self) -> ResidualSystem:
        """The system whose fault space it is."""
        return self.space.system

    @property
    def columns(self) -> int:
        """r, the number of columns of every P: the normal rank, which is m where the system is left-invertible."""
        return self.kernel.normal_rank

    @property
    def n_z(self) -> int:
        """n_z = r + zeta, the number of rows of every P."""
        return self.space.dimension

    @property
    def zeta(self) -> int:
        """Dim U, the number of zeros, finite and infinite, of every good pair, and the bound on the degree of D."""
        return self.states.ncols

    @cached_property
    def reduced(self) -> ResidualSystem:
        """(A_U, C_U), zeta states and r outputs, no fault: q b - a in coordinates of Z that begin with b."""
        zeta, field = self.zeta, self.system.field
        inverse = _inverse(self.basis_change)
        both = inverse @ self.a
        none = Matrix.zero(field, zeta, 0), Matrix.zero(field, self.columns, 0)
        return ResidualSystem(both.rows(range(zeta)), none[0], both.rows(range(zeta, self.n_z)), none[1])

    @cached_property
    def basis_change(self) -> Matrix:
        """[b | unit columns], invertible, n_z x n_z."""
        free = sorted(set(range(self.n_z)) - set(row_profile(self.b)))
        return beside(self.b, Matrix.identity(self.system.field, self.n_z).columns(free))

    @cached_property
    def left_kernel(self) -> tuple[Matrix, ...]:
        """The rows L_j(q) of a minimal basis of {l(q) : l(q) (q b - a) = 0}, (k_j + 1) x n_z coefficients each, ascending by
        degree.
        """
        inverse = _inverse(self.basis_change)
        reduced = self.reduced
        rows = kernel_representation(reduced).rows
        return tuple(column_conditions(row.coefficients, reduced.A, reduced.C) @ inverse for row in rows)

    @property
    def left_degrees(self) -> tuple[int, ...]:
        """k_1 <= ... <= k_r."""
        return tuple(row.nrows - 1 for row in self.left_kernel)

    @cached_property
    def fixed(self) -> Poly:
        """The zeros that no P moves: the characteristic polynomial, monic, of A on the unobservable subspace of (A, C)."""
        return zero_dynamics_polynomial(self.reduced)

    @property
    def observable(self) -> bool:
        """This tells whether (A, C) is observable: then no zero is fixed."""
        return len(self.fixed) == 1

    @property
    def title(self) -> str:
        """This says of what shape P is, and how many zeros a good pair has."""
        return f"P is {self.n_z} x {self.columns}, zeta = {self.zeta}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are the pencil and what it says about every P."""
        yield "D(q; P) = det [ P | q b - a ]", f"of degree at most zeta = {self.zeta}"
        yield from named_matrix("b", self.b)
        yield from named_matrix("a", self.a)
        yield "zeros that no P moves", polynomial(self.fixed, self.system.field)
        yield "degrees of the rows L_j(q)", several(self.left_degrees)

    def to_json(self) -> dict[str, Any]:
        """The dict has the sizes, b and a, the fixed zeros and the degrees k_j."""
        return {
            "n_z": self.n_z,
            "columns": self.columns,
            "zeta": self.zeta,
            "b": self.b.to_json(),
            "a": self.a.to_json(),
            "fixed": written(self.fixed, self.system.field),
            "left_degrees": list(self.left_degrees),
        }


@dataclass(frozen=True, repr=False)
class PairVerdict(Shown):
    """P with its `rank` and `polynomial` = det [P | q b - a], ascending coefficients, which is () where P is bad."""

    exceptional: Exceptional
    P: Matrix
    rank: int
    polynomial: Poly

    @property
    def good(self) -> bool:
        """This tells whether (A, Fhat P, C, Ghat P) has the output behaviour of the system."""
        return bool(self.polynomial)

    @property
    def system(self) -> ResidualSystem:
        """(A, Fhat P, C, Ghat P)."""
        return with_pair(self.exceptional.space, self.P)

    @property
    def finite_zeros(self) -> int | None:
        """The number of finite zeros of the pair, those of the unobservable part included; None for a bad P."""
        return len(self.polynomial) - 1 if self.good else None

    @property
    def infinite_zeros(self) -> int | None:
        """The number of infinite zeros of the pair; None for a bad P."""
        return self.exceptional.zeta - len(self.polynomial) + 1 if self.good else None

    @cached_property
    def null_vector(self) -> NullPolynomial | None:
        """For a bad P this is some (x(q), v(q)) != 0 in the right kernel of the pair's pencil; it is None for a good one."""
        return None if self.good else right_null_polynomial(self.system)

    @property
    def reason(self) -> str:
        """This says in one line for people why P is good or bad."""
        if self.good:
            return f"D(q; P) is not zero: {self.finite_zeros} finite and {self.infinite_zeros} infinite zeros"
        if self.rank < self.P.ncols:
            return f"P has rank {self.rank}, below its {counted(self.P.ncols, 'column')}"
        return f"P has full column rank, but D(q; P) = 0: the pair has normal rank below {self.P.ncols}"

    def to_json(self) -> dict[str, Any]:
        """Return what a certificate needs: P, the coefficients of D, b and a, and the null vector of a bad P."""
        field = self.P.field
        null = self.null_vector
        return {
            "P": self.P.to_json(),
            "good": self.good,
            "rank": self.rank,
            "polynomial": written(self.polynomial, field),
            "b": self.exceptional.b.to_json(),
            "a": self.exceptional.a.to_json(),
            "null_vector": None if null is None else {"x": null.state.to_json(), "v": null.fault.to_json()},
        }

    @property
    def title(self) -> str:
        """This says whether P is good, and why."""
        return f"{'good' if self.good else 'bad'}: {self.reason}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are P and D(q; P)."""
        yield from named_matrix("P", self.P)
        yield "rank P", str(self.rank)
        yield "D(q; P)", polynomial(self.polynomial, self.P.field)


def exceptional(kernel: KernelRepresentation | System) -> Exceptional:
    """Return the pencil q b - a of the fault space of a system: D(q; P) = det [P | q b - a] says which P are bad.

    Source: [G25] Theorem 3, [M73] and [TSH01] for the subspaces, [F75] for the rows of the left kernel.

    Parameters
    ----------
    kernel : KernelRepresentation or System
        Over any field.

    Returns
    -------
    Exceptional
        `n_z` and `columns` (r, the normal rank), the shape of every P, `zeta`, the number of zeros of every good pair, `b` and `a` (n_z
        x zeta), and the `fixed` zeros that no P moves.

    Raises
    ------
    InvalidInput
        For what is no system.
    ArithmeticError
        If the space does not have the dimension r + zeta, which would be an error of ours.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, exceptional, kernel_representation
    >>> pencil = exceptional(kernel_representation(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]])))
    >>> pencil.n_z, pencil.columns, pencil.zeta, pencil.b, pencil.a
    (2, 1, 1, [[1], [0]], [[1/2], [1]])
    """
    kernel = kernel_of(kernel)
    space = fault_space(kernel)
    system = space.system
    echelon = row_echelon(space.basis)
    without_feedthrough = left_null_space(space.basis.columns(range(system.n, system.n + system.p)))
    U = row_echelon(without_feedthrough @ space.basis.columns(range(system.n))).matrix.transposed()
    at_once = stacked(U, Matrix.zero(system.field, system.p, U.ncols))
    one_step = stacked(system.A @ U, system.C @ U)
    # the basis of Z is in reduced echelon form, so the coordinates of a member are its entries at the pivots
    b, a = at_once.rows(echelon.pivots), one_step.rows(echelon.pivots)
    columns = space.basis.transposed()
    if columns @ b != at_once or columns @ a != one_step or kernel.normal_rank + U.ncols != space.dimension:
        raise ArithmeticError("the fault space does not contain [U; 0] and [A U; C U], or has a wrong dimension")
    return Exceptional(kernel, space, U, b, a)


def pencil_of(given: Exceptional | KernelRepresentation | System) -> Exceptional:
    """Return the pencil that is given, or that of a system. Raises InvalidInput for anything else."""
    return given if isinstance(given, Exceptional) else exceptional(given)


def judge(pencil: Exceptional | System, P: object) -> PairVerdict:
    """Return the verdict on a choice P of fault matrices (Fhat P, Ghat P): whether it keeps the behaviour, and which zeros it has.

    Source: [G25] Theorem 3 (ii), repaired: P of full column rank is not enough.

    Parameters
    ----------
    pencil : Exceptional or System
    P : Matrix, nested lists or sympy matrix, shape (n_z, r)
        Over the system's field.

    Returns
    -------
    PairVerdict
        `good`, `polynomial` = D(q; P) (ascending, () where P is bad), `rank`, `system`, `finite_zeros` and a `reason` in words.

    Raises
    ------
    InvalidInput
        For another shape or field.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, exceptional, judge, kernel_representation
    >>> pencil = exceptional(kernel_representation(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]])))
    >>> judge(pencil, [[0], [1]]).reason
    'D(q; P) is not zero: 1 finite and 0 infinite zeros'
    >>> judge(pencil, [[0], [0]]).good
    False
    """
    pencil = pencil_of(pencil)
    matrix = pair_matrix(pencil, P)
    return PairVerdict(pencil, matrix, rank(matrix), polynomial_at(pencil, matrix))


def polynomial_at(pencil: Exceptional, P: Matrix) -> Poly:
    """Return D(q; P) = det [P | q b - a] for P of shape n_z x r."""
    nothing = Matrix.zero(pencil.system.field, pencil.n_z, pencil.columns)
    return linear_determinant(beside(P, -pencil.a), beside(nothing, pencil.b))


def pair_matrix(pencil: Exceptional, P: object) -> Matrix:
    """Return P as a Matrix of shape n_z x r. Raises InvalidInput for another shape or field."""
    shape = (pencil.n_z, pencil.columns)
    matrix = P if isinstance(P, Matrix) else Matrix.of(P, pencil.system.field, shape=shape if 0 in shape else None, where="P")
    if matrix.field != pencil.system.field:
        raise InvalidInput(f"P: got entries over {matrix.field}, expected {pencil.system.field} as for the system")
    if matrix.shape != shape:
        raise InvalidInput(
            f"P: got {matrix.nrows} x {matrix.ncols}, expected {shape[0]} x {shape[1]}: a row for each basis column of the "
            f"fault space, and as many columns as the normal rank of the system"
        )
    return matrix


def _inverse(matrix: Matrix) -> Matrix:
    inverse = solve_left(matrix, Matrix.identity(matrix.field, matrix.nrows))
    if inverse is None:
        raise ArithmeticError("an invertible matrix has no inverse")
    return inverse
