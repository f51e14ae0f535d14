"""These are pairs by construction: good ones with entries 0 and 1, and bad ones of full column rank wherever there are any.

    good_columns         r basis columns of Z that are themselves a good pair: P has one 1 a column and D(point; P) != 0
    GoodColumns          the columns, the point, the verdict
    bad_pair             a bad P of full column rank, with the row L_j(q) or the unobservable direction that makes it bad
    BadPair, NoBadPair   the construction, or why every P of full column rank is good

Why 0 and 1 are enough: every coefficient of D is linear in each single entry of P, and a polynomial that is not zero and of degree at
most one in each unknown is not zero somewhere on {0, 1}^N, over every field. More is true: D(q; P) = sum of det(P_J) h_J(q), so some h_J
is not zero and the basis columns J of Z are a good pair. No search is needed: D(q; P) = unit * fixed(q) * det(L(q) P), and L(point) has
full row rank at every point, a minimal basis being what it is; any r independent columns of L(point) will do. Source: [F75], [G25]
Theorem 3.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ...base.sheets import Shown
from ..algebra.matrices import Matrix, beside, right_null_space, row_echelon, stacked
from ..algebra.notation import named_matrix
from ..system.systems import System
from .polynomial import Exceptional, PairVerdict, judge, pencil_of


@dataclass(frozen=True, repr=False)
class GoodColumns(Shown):
    """P has the unit columns `chosen` (0-based, ascending): the basis columns `chosen` of Z are a good pair by themselves."""

    chosen: tuple[int, ...]
    verdict: PairVerdict

    def to_json(self) -> dict[str, Any]:
        """Return P, the coefficients of D and the columns chosen."""
        return {"chosen": list(self.chosen), **self.verdict.to_json()}

    @property
    def title(self) -> str:
        """This says which basis columns are a good pair by themselves."""
        return f"the basis columns {list(self.chosen)}, counted from 0, are a good pair"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are those of the verdict."""
        yield from self.verdict.sheet()


@dataclass(frozen=True, repr=False)
class BadPair(Shown):
    """A bad P of full column rank, with the `conditions` (rows x n_z) that make it bad.

    Where `kind` is "row", they are the coefficients of one row L_j(q), and L_j(q) P = 0. Where it is "unobservable", they are those of all
    rows, which are not independent of the unobservable part, and the first column of L(q) P is zero.
    """

    kind: str
    conditions: Matrix
    verdict: PairVerdict

    def to_json(self) -> dict[str, Any]:
        """Return P, its null vector and the conditions."""
        return {"kind": self.kind, "conditions": self.conditions.to_json(), **self.verdict.to_json()}

    @property
    def title(self) -> str:
        """This says of which kind the bad pair is."""
        return f"a bad P of full column rank, of kind {self.kind}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are those of the verdict, and the conditions."""
        yield from self.verdict.sheet()
        yield from named_matrix("conditions", self.conditions)


@dataclass(frozen=True, repr=False)
class NoBadPair(Shown):
    """Every P of full column rank is good; `reason` says why."""

    exceptional: Exceptional
    reason: str

    def to_json(self) -> dict[str, Any]:
        """Return the reason with zeta, r and the degrees k_j."""
        left = self.exceptional
        return {"reason": self.reason, "zeta": left.zeta, "columns": left.columns, "left_degrees": list(left.left_degrees)}

    @property
    def title(self) -> str:
        """This says that there is no bad pair."""
        return "every P of full column rank is good"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pair is the reason."""
        yield "reason", self.reason


def good_columns(pencil: Exceptional | System) -> GoodColumns:
    """Return a good P (n_z x r) with entries 0 and 1, a single 1 in each column, found without a search and decided exactly.

    They are the first independent columns of L(0), L(q) being a minimal basis, whose rank drops nowhere. Source: [F75], [G25] Theorem 3.

    Parameters
    ----------
    pencil : Exceptional or System

    Returns
    -------
    GoodColumns
        `chosen` lists the r columns of [Fhat; Ghat] that are an equivalent pair by themselves.

    Raises
    ------
    ArithmeticError
        If the construction failed, which would be an error of ours.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, exceptional, good_columns, kernel_representation
    >>> found = good_columns(exceptional(kernel_representation(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]]))))
    >>> found.chosen, found.verdict.good
    ((0,), True)
    """
    pencil = pencil_of(pencil)
    field = pencil.system.field
    at_zero = stacked(Matrix.zero(field, 0, pencil.n_z), *(row.rows([0]) for row in pencil.left_kernel))
    chosen = row_echelon(at_zero).pivots
    verdict = judge(pencil, Matrix.identity(field, pencil.n_z).columns(chosen))
    if not verdict.good:
        raise ArithmeticError("a minimal basis has no full row rank at 0")
    return GoodColumns(chosen, verdict)


def bad_pair(pencil: Exceptional | System) -> BadPair | NoBadPair:
    """Return a bad P (n_z x r) of full column rank by construction, or the reason why there is none.

    There is one iff r >= 1 and (A, C) is not observable, or r >= 2 and zeta >= 1. Source: [F75], [G25] Theorem 3.

    Parameters
    ----------
    pencil : Exceptional or System

    Returns
    -------
    BadPair or NoBadPair
        A BadPair has `verdict` with P and a null vector, and `conditions`, the rows that make it bad; a NoBadPair has the `reason`.

    Raises
    ------
    ArithmeticError
        If the construction failed, which would be an error of ours.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, bad_pair, exceptional, kernel_representation
    >>> system = ResidualSystem.of([[0, 1], [0, 0]], [[1, 0], [0, 1]], [[1, 0], [0, 1]], [[0, 0], [0, 0]])
    >>> found = bad_pair(exceptional(kernel_representation(system)))
    >>> found.verdict.rank, found.verdict.reason
    (2, 'P has full column rank, but D(q; P) = 0: the pair has normal rank below 2')
    """
    pencil = pencil_of(pencil)
    field, r = pencil.system.field, pencil.columns
    if r == 0:
        return NoBadPair(pencil, "the normal rank is 0: P has no column, and the pair without faults is equivalent")
    rows = pencil.left_kernel
    if not pencil.observable:
        conditions = stacked(*rows)
        silent = right_null_space(conditions).columns([0])
        place = next(i for i in range(pencil.n_z) if silent[i, 0] != 0)
        others = [i for i in range(pencil.n_z) if i != place][: r - 1]
        P = beside(silent, Matrix.identity(field, pencil.n_z).columns(others))
        return BadPair("unobservable", conditions, _certainly_bad(pencil, P))
    if pencil.zeta == 0:
        return NoBadPair(pencil, "zeta = 0: P is square and D(q; P) = det P, so that P is bad only where its rank is deficient")
    if r == 1:
        return NoBadPair(pencil, "(A, C) is observable and r = 1: the coefficients of D are n_z independent linear forms in P")
    # the shortest row: k_1 < zeta, so that the columns which it kills are at least r
    conditions = rows[0]
    P = right_null_space(conditions).columns(range(r))
    return BadPair("row", conditions, _certainly_bad(pencil, P))


def _certainly_bad(pencil: Exceptional, P: Matrix) -> PairVerdict:
    verdict = judge(pencil, P)
    if verdict.good or verdict.rank != pencil.columns:
        raise ArithmeticError("the construction of a bad pair failed")
    return verdict
