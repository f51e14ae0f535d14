"""This is the system pencil P(q) = [[qI - A, -F], [C, G]]: its zeros, finite and infinite, and its right minimal indices.

    right_minimal_indices        degrees of a minimal basis of {w(q) : P(q) w(q) = 0}: the left ones of the transposed system
    infinite_zero_orders         delta_1 <= ... <= delta_r: #{delta <= k} = rank T_(k+1) - rank T_k
    invariant_zero_polynomial    product of the invariant polynomials, monic, as a Poly, left-invertible or not; where F = G = 0 its roots
                                 are the eigenvalues of A that C does not show, though the transfer function is zero
    zeros_alone                  the same where nothing else is asked: its degree is found on the way
    zero_dynamics_polynomial     the same from the motion inside V*/R*, where no output sees it: another route
    right_null_polynomial        (x(q), v(q)) with P(q) [x; v] = 0, the proof of not being left-invertible
    PencilParts, pencil_parts    P(q) as constant + q slope
    finite_diagonal, infinite_diagonal   diagonal forms with multipliers, of P(q) and of the reversed pencil, for certificates

n = sum eta + sum eps + n_f + n_inf, so the degree n_f is known before the polynomial is. Source: [K80] 6.3, [VD79], [TSH01] ch. 7.
"""

from __future__ import annotations

import random
from dataclasses import dataclass

from flint import fmpq, fmpz_mat

from ...base.progress import Progress, silent
from ..algebra import polynomials
from ..algebra.fields import PrimeField, Rationals
from ..algebra.matrices import Matrix, beside, column_basis, rank, right_null_space, row_profile, solve_left, stacked
from ..algebra.polynomials import Poly, PolyMatrix, SmithDiagonal
from ..system.systems import ResidualSystem
from ..system.windows import toeplitz_matrix
from .inversion import largest_output_nulling
from .kernel_rows import KernelRepresentation, horner_states, kernel_representation
from .zero_output import chain_from_rest


@dataclass(frozen=True)
class NullPolynomial:
    """(x(q), v(q)) != 0 satisfies (qI - A) x = F v and C x + G v = 0: `state` is (e+1) x n, `fault` (e+1) x m, row j the coefficient of
    q^j.
    """

    state: Matrix
    fault: Matrix


@dataclass(frozen=True)
class PencilParts:
    """P(q) = constant + q slope, both (n + p) x (n + m)."""

    constant: Matrix
    slope: Matrix


def right_minimal_indices(system: ResidualSystem) -> tuple[int, ...]:
    """The right minimal indices of the pencil are ascending; there are m - r of them."""
    return kernel_representation(system.transposed()).left_minimal_indices


def infinite_zero_orders(kernel: KernelRepresentation) -> tuple[int, ...]:
    """Return the orders of the infinite zeros, ascending, one per unit of normal rank, zeros included."""
    orders: list[int] = []
    k, previous = 0, 0
    while len(orders) < kernel.normal_rank:
        current = rank(toeplitz_matrix(kernel.system, k + 1))
        orders.extend([k] * (current - previous - len(orders)))
        k, previous = k + 1, current
    return tuple(orders)


def invariant_zero_polynomial(kernel: KernelRepresentation, degree: int, on_progress: Progress = silent) -> Poly:
    """The product of the invariant polynomials of the pencil, monic; `degree` is n_f.

    Over Q: the gcd of minors of compressed pencils, which is complete as soon as its degree is n_f. Else: the zero dynamics.
    """
    one = kernel.system.field.element(1)
    if degree == 0:
        return (one,)
    if isinstance(kernel.system.field, Rationals):
        return _gcd_of_minors(kernel, degree, on_progress)
    return zero_dynamics_polynomial(kernel.system)


def zeros_alone(kernel: KernelRepresentation) -> Poly:
    """Return the invariant zero polynomial, where nothing else is asked of the system: the degree is what the indices leave of n."""
    system, infinite = kernel.system, infinite_zero_orders(kernel)
    finite = system.n - sum(kernel.left_minimal_indices) - sum(right_minimal_indices(system)) - sum(infinite)
    return invariant_zero_polynomial(kernel, finite)


def zero_dynamics_polynomial(system: ResidualSystem) -> Poly:
    """Return the characteristic polynomial, monic, of the motion on V*/(V* inter S*) under zero output."""
    nulling = largest_output_nulling(system)
    reachable = chain_from_rest(system).last_subspace
    common = right_null_space(beside(nulling, -reachable)).rows(range(nulling.ncols))
    controllable = column_basis(nulling @ common)
    extended = beside(controllable, nulling)
    chosen = row_profile(extended.transposed())
    basis = extended.columns(chosen)
    # for each basis vector x some v with C x + G v = 0 and A x + F v in V*: solve for v and the coordinates of A x + F v
    unknowns = stacked(beside(system.F, -basis), beside(system.G, Matrix.zero(system.field, system.p, basis.ncols)))
    right_side = stacked(-(system.A @ basis), -(system.C @ basis))
    solution = solve_left(unknowns.transposed(), right_side.transposed())
    if solution is None:
        raise ArithmeticError("V* is not output-nulling")
    coordinates = solution.transposed().rows(range(system.m, system.m + basis.ncols))
    free = range(controllable.ncols, basis.ncols)
    return characteristic_polynomial(coordinates.rows(free).columns(free))


def characteristic_polynomial(matrix: Matrix) -> Poly:
    """Return det(qI - M), monic."""
    field, size = matrix.field, matrix.nrows
    if isinstance(field, (Rationals, PrimeField)):
        poly = matrix.flint.charpoly()
        return tuple(field.element(fmpq(poly[i]) if isinstance(field, Rationals) else int(poly[i])) for i in range(size + 1))
    coefficients = [field.element(1)]  # Faddeev-LeVerrier: characteristic 0
    auxiliary = Matrix.zero(field, size, size)
    for k in range(1, size + 1):
        scaled = Matrix.from_elements(field, size, size, [[coefficients[-1] * (i == j) for j in range(size)] for i in range(size)])
        auxiliary = matrix @ auxiliary + scaled
        product = matrix @ auxiliary
        trace = field.element(0)
        for i in range(size):
            trace = trace + product[i, i]
        coefficients.append(-trace / fmpq(k))
    return tuple(reversed(coefficients))


def right_null_polynomial(system: ResidualSystem) -> NullPolynomial | None:
    """Return a polynomial vector in the right kernel of the pencil, of least degree, or None for a left-invertible system."""
    rows = kernel_representation(system.transposed()).rows
    if not rows:
        return None
    # the transposed row annihilates (A', C', F', G'): its Horner states are the x(q) belonging to v(q)
    coefficients = rows[0].coefficients
    _, *states = horner_states(coefficients, system.A.transposed(), system.F.transposed())
    return NullPolynomial(stacked(*states), coefficients)


def pencil_parts(system: ResidualSystem) -> PencilParts:
    """The pencil is assembled here and nowhere else: [[qI - A, -F], [C, G]]."""
    field, n = system.field, system.n
    top = beside(Matrix.identity(field, n), Matrix.zero(field, n, system.m))
    constant = stacked(beside(-system.A, -system.F), beside(system.C, system.G))
    return PencilParts(constant, stacked(top, Matrix.zero(field, system.p, top.ncols)))


def pencil(system: ResidualSystem) -> PolyMatrix:
    """Return P(q) as a matrix of Poly, (n + p) x (n + m)."""
    parts = pencil_parts(system)
    return _linear(parts.constant, parts.slope)


def reversed_pencil(system: ResidualSystem) -> PolyMatrix:
    """Return t P(1/t) = [[I - tA, -tF], [tC, tG]]: its zeros at t = 0 are those of P at infinity."""
    parts = pencil_parts(system)
    return _linear(parts.slope, parts.constant)


def finite_diagonal(system: ResidualSystem) -> SmithDiagonal:
    """Return a diagonal form of P(q) with unimodular multipliers."""
    return polynomials.smith_diagonal(pencil(system), system.n + system.p, system.n + system.m, system.field.element(1))


def infinite_diagonal(system: ResidualSystem) -> SmithDiagonal:
    """Return a diagonal form of the reversed pencil with unimodular multipliers."""
    return polynomials.smith_diagonal(reversed_pencil(system), system.n + system.p, system.n + system.m, system.field.element(1))


def _linear(constant: Matrix, slope: Matrix) -> PolyMatrix:
    pairs = zip(constant.elements(), slope.elements(), strict=True)
    return [[polynomials.trimmed(pair) for pair in zip(row, other, strict=True)] for row, other in pairs]


def _gcd_of_minors(kernel: KernelRepresentation, degree: int, on_progress: Progress) -> Poly:
    """gcd of det(R P(q) S) over integer R, S, taken until its degree is n_f; each is a multiple of the invariant polynomials."""
    system = kernel.system
    size = system.n + kernel.normal_rank
    parts = pencil_parts(system)
    rng = random.Random(system.n)
    result: Poly = ()
    while len(result) != degree + 1:
        left = _small_integers(rng, size, system.n + system.p)
        right = _small_integers(rng, system.n + system.m, size)
        h, e = (left @ parts.constant @ right).flint, (left @ parts.slope @ right).flint
        (top, bottom), (slope_top, slope_bottom) = h.numer_denom(), e.numer_denom()
        a, b = fmpz_mat(top * slope_bottom), fmpz_mat(slope_top * bottom)
        points = [fmpq(k) for k in range(system.n + 1)]
        values = []
        for k in range(len(points)):
            values.append(fmpq((a + b * k).det()))
            on_progress("zeros", k + 1, len(points))
        minor = polynomials.interpolate(points, values)
        result = polynomials.gcd(result, minor)
    return result


def _small_integers(rng: random.Random, nrows: int, ncols: int) -> Matrix:
    field = Rationals()
    return Matrix.from_elements(field, nrows, ncols, [[fmpq(rng.randint(-9, 9)) for _ in range(ncols)] for _ in range(nrows)])
