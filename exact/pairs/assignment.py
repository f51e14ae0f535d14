"""This makes a pair with the finite zeros that one wants, and a pair whose fault can be recovered without the initial state.

    ZeroAssignment        P with D(q; P) = unit * desired, and the pair
    assign_zeros          P for a desired polynomial: of degree at most zeta, a multiple of `fixed`; the other zeros are infinite
    Recovery              a pair with no zeros but the fixed ones, its delay and the left inverse that recovers v(0)
    recoverable_pair      always exists, for every system

Hypotheses: none but that the unobservable modes of (A, C), which are zeros of every pair, are among the desired zeros; for observable (A,
C) every polynomial of degree at most zeta is reached, and no field extension is needed. Construction: the coefficients of the rows
L_j(q), stacked, are independent, so that L(q) P is any r x r polynomial matrix Q with row j of degree at most k_j. Take, with k_r the
largest,

    Q = [ q^k_1  -1                    ]
        [        q^k_2  -1             ]     det Q = c_1 + c_2 q^k_1 + c_3 q^(k_1+k_2) + ...,  deg c_j <= k_r,
        [  ...                         ]
        [ c_1    c_2   ...         c_r ]

where the exponents leave no power up to zeta unreached. Source: [F75] for minimal bases, [HP98] for recovery, [G25] Theorem 3.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from ...base.errors import InvalidInput, shorten
from ...base.sheets import Shown
from ..algebra import polynomials
from ..algebra.matrices import Matrix, solve_left, stacked
from ..algebra.notation import named_matrix, polynomial
from ..algebra.polynomials import Poly, written
from ..algebra.sympy_values import is_expression
from ..algebra.writing import sum_of_powers
from ..structure.inversion import delay_unknown_state, left_inverse
from ..structure.kernel_rows import kernel_representation
from ..system.systems import ResidualSystem, System
from .polynomial import Exceptional, PairVerdict, judge, pencil_of


@dataclass(frozen=True, repr=False)
class ZeroAssignment(Shown):
    """`verdict.polynomial` = unit * `desired`; `free` = desired / fixed is what det(L(q) P) was made to be."""

    desired: Poly
    free: Poly
    unit: Any
    verdict: PairVerdict

    @property
    def P(self) -> Matrix:
        """The choice of columns P (n_z, r)."""
        return self.verdict.P

    @property
    def system(self) -> ResidualSystem:
        """(A, Fhat P, C, Ghat P), whose invariant zero polynomial is `desired`, made monic."""
        return self.verdict.system

    def to_json(self) -> dict[str, Any]:
        """Return the desired polynomial, the unit and the verdict."""
        field = self.P.field
        return {"desired": written(self.desired, field), "unit": field.write(self.unit), **self.verdict.to_json()}

    @property
    def title(self) -> str:
        """This says which zeros the pair has."""
        return f"a pair with the zeros of {polynomial(self.desired, self.P.field)}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are those of the verdict, and the fault matrices."""
        yield from self.verdict.sheet()
        yield from named_matrix("F", self.system.F)
        yield from named_matrix("G", self.system.G)


@dataclass(frozen=True, repr=False)
class Recovery(Shown):
    """A pair of as many faults as the normal rank: `left_inverse` takes r(0..delay), from any initial state, to its v(0)."""

    assignment: ZeroAssignment
    delay: int
    left_inverse: Matrix

    def to_json(self) -> dict[str, Any]:
        """Return the delay, the left inverse and the assignment."""
        return {"delay": self.delay, "left_inverse": self.left_inverse.to_json(), **self.assignment.to_json()}

    @property
    def title(self) -> str:
        """This says from how many samples the fault is recovered."""
        return f"r(0), ..., r({self.delay}) give v(0), whatever the initial state is"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are those of the assignment, and the left inverse."""
        yield from self.assignment.sheet()
        yield from named_matrix("left inverse", self.left_inverse)


def assign_zeros(pencil: Exceptional | System, desired: object) -> ZeroAssignment:
    """Return a pair (Fhat P, Ghat P) of fault matrices, equivalent to the given ones, whose invariant zeros are the wanted ones.

    Source: [F75] for minimal bases, [G25] Theorem 3.

    Parameters
    ----------
    pencil : Exceptional or System
    desired : list or sympy polynomial
        Ascending coefficients in the field, or over Q a polynomial in one symbol, of degree at most zeta.

    Returns
    -------
    ZeroAssignment
        `P` (n_z x r), `system`, and `unit` with D(q; P) = unit * desired; the zeta - deg desired other zeros are infinite.

    Raises
    ------
    InvalidInput
        For the zero polynomial, a degree above zeta, and a polynomial that the unobservable modes of (A, C) do not divide.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, assign_zeros, exceptional, kernel_representation
    >>> pencil = exceptional(kernel_representation(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]])))
    >>> found = assign_zeros(pencil, [-2, 1])  # a zero at 2
    >>> print(found.system)
    A=[[1/2]], F=[[-3/4]], C=[[1]], G=[[1/2]]
    """
    pencil = pencil_of(pencil)
    polynomial = _polynomial(pencil, desired)
    field, zeta, fixed = pencil.system.field, pencil.zeta, pencil.fixed
    if not polynomial:
        raise InvalidInput("desired: got the zero polynomial, expected a nonzero one (a P with D(q; P) = 0 is bad; see bad_pair)")
    if len(polynomial) - 1 > zeta:
        raise InvalidInput(f"desired: got degree {len(polynomial) - 1}, expected at most zeta = {zeta}")
    free, rest = polynomials.divide(polynomial, fixed)
    if rest:
        raise InvalidInput(
            f"desired: got {_text(pencil, polynomial)}, expected a multiple of {_text(pencil, fixed)}: (A, C) is not observable, and its "
            f"unobservable modes are zeros of every pair"
        )
    if pencil.columns == 0 and len(free) > 1:
        raise InvalidInput("desired: the normal rank is 0, so that P has no column and the zeros are the unobservable modes alone")
    P = Matrix.zero(field, pencil.n_z, 0) if pencil.columns == 0 else _realising(pencil, free)
    verdict = judge(pencil, P)
    if len(verdict.polynomial) != len(polynomial):
        raise ArithmeticError("the pair does not have the zeros it was made for")
    unit = verdict.polynomial[-1] / polynomial[-1]
    if any(x != unit * y for x, y in zip(verdict.polynomial, polynomial, strict=True)):
        raise ArithmeticError("the pair does not have the zeros it was made for")
    return ZeroAssignment(polynomial, free, unit, verdict)


def recoverable_pair(pencil: Exceptional | System) -> Recovery:
    """Return an equivalent pair whose fault the outputs give without the initial state: it has no zeros that can be avoided.

    Such a pair exists for every system, observable or not; its only finite zeros are the unobservable modes. The left inverse is computed,
    so that it is verified. Source: [HP98] for recovery, [G25] Theorem 3.

    Parameters
    ----------
    pencil : Exceptional or System

    Returns
    -------
    Recovery
        `delay`, a number of samples, and `left_inverse`, which takes r(0), ..., r(delay) to v(0): as many rows as the normal rank,
        p(delay + 1) columns.

    Raises
    ------
    ArithmeticError
        If the construction failed, which would be an error of ours.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, exceptional, kernel_representation, recoverable_pair
    >>> found = recoverable_pair(exceptional(kernel_representation(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]]))))
    >>> found.delay, found.left_inverse
    (1, [[-1, 2]])
    """
    pencil = pencil_of(pencil)
    assignment = assign_zeros(pencil, pencil.fixed)
    delay = delay_unknown_state(kernel_representation(assignment.system))
    inverse = None if delay is None else left_inverse(assignment.system, delay, known_state=False)
    if delay is None or inverse is None:
        raise ArithmeticError("a pair without zeros of its own has no left inverse")
    return Recovery(assignment, delay, inverse)


def _realising(pencil: Exceptional, free: Poly) -> Matrix:
    """Return P with det(L(q) P) = +- free: it solves stacked(L_j) P = coefficients of Q."""
    field, degrees = pencil.system.field, pencil.left_degrees
    zero, one = field.element(0), field.element(1)
    r, largest = len(degrees), degrees[-1]
    starts = [sum(degrees[:j]) for j in range(r)]
    rows: list[list[Any]] = []
    for j in range(r - 1):
        block = [[zero] * r for _ in range(degrees[j] + 1)]
        block[degrees[j]][j] = one
        block[0][j + 1] = -one
        rows += block
    last = [[zero] * r for _ in range(largest + 1)]
    for power, coefficient in enumerate(free):
        j = max(j for j in range(r) if starts[j] <= power <= starts[j] + largest)
        last[power - starts[j]][j] = coefficient
    rows += last
    wanted = Matrix.from_elements(field, len(rows), r, rows)
    solution = solve_left(stacked(*pencil.left_kernel).transposed(), wanted.transposed())
    if solution is None:
        raise ArithmeticError("the coefficients of a minimal basis are not independent")
    return solution.transposed()


def _polynomial(pencil: Exceptional, desired: object) -> Poly:
    field = pencil.system.field
    if is_expression(desired):
        import sympy  # which is loaded, where there is an expression of it

        try:
            poly = desired if isinstance(desired, sympy.Poly) else sympy.Poly(desired, *(desired.free_symbols or {sympy.Symbol("q")}))
        except sympy.PolynomialError:
            raise InvalidInput(f"desired: got {shorten(desired)}, expected a polynomial in one symbol") from None
        if len(poly.gens) != 1:
            raise InvalidInput(f"desired: got a polynomial in {len(poly.gens)} symbols, expected one")
        desired = list(reversed(poly.all_coeffs()))
    if not isinstance(desired, Sequence) or isinstance(desired, str):
        raise InvalidInput(f"desired: got {shorten(desired)}, expected coefficients by ascending power")
    return polynomials.trimmed([field.element(c, f"desired[{k}]") for k, c in enumerate(desired)])


def _text(pencil: Exceptional, polynomial: Poly) -> str:
    return sum_of_powers([str(c) for c in polynomial], "q")
