"""This tells what G = 0 adds: how far a zero feedthrough pins the fault matrix F, and with it the fault signal v.

    ZeroFeedthrough      U = {u : [u; 0] in Z}, what G = 0 leaves free, and whether that is im F alone
    zero_feedthrough     of a left-invertible system with G = 0
    Alternative          F' of another column space with the same behaviour and no feedthrough, where there is one

The members of Z with zero feedthrough are the columns [u; 0] with u in U = V* + S*, zeta dimensions of them: with G = 0, im F lies in S*
and A (U inter ker C) in U, so that the formula im F + U + A (U inter ker C) is U itself. An equivalent pair without feedthrough is F' = U
R, R of shape zeta x m, with D(q; b R) != 0. Hence, G = 0, left-invertible, m >= 1:

    F is fixed up to a basis  iff  im F = U      iff  zeta = m      iff  rank CF = m and there are no finite zeros,
    v is fixed up to a basis  iff  im F + N = U  iff  zeta = m + o  iff  rank CF = m and the finite zeros are the o unobservable modes,

with N the unobservable subspace of (A, C), o = dim N. The second holds with the initial state known (and equal) and unknown alike: no
zero of its own is left to hide v. Where a condition fails, another good F' exists over every field: with c in U outside im F (+ N),
exchange the first column f of F for c or for f + c; D is linear in that column, so that not both give 0. The fault v' that goes with an
F' outside im F + N is v filtered, not v in another basis. For one given F: v is determined from the known initial state always, from an
unknown one iff all finite zeros are unobservable modes. Source: [G25], [M73] and [TSH01] for V* and S*, [HP98] for recovery.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ...base.errors import InvalidInput
from ...base.sheets import Shown, counted, told
from ..algebra.matrices import Matrix, beside, rank, stacked
from ..algebra.notation import named_matrix
from ..structure.inversion import delay_known_state, delay_unknown_state, largest_output_nulling
from ..structure.kernel_rows import KernelRepresentation, kernel_of
from ..system.systems import ResidualSystem, System
from .polynomial import Exceptional, PairVerdict, exceptional, judge


@dataclass(frozen=True)
class Alternative:
    """An `F` with another column space and G = 0 that makes the same outputs.

    The column `replaced` is put in the place of the first. Where v is not pinned either, it is outside im F + N, N the unobservable
    subspace.
    """

    F: Matrix
    replaced: Matrix
    verdict: PairVerdict

    @property
    def system(self) -> ResidualSystem:
        """(A, F', C, 0)."""
        return self.verdict.system

    def to_json(self) -> dict[str, Any]:
        """Return F', the column and the verdict on the pair."""
        return {"F": self.F.to_json(), "replaced": self.replaced.to_json(), **self.verdict.to_json()}


@dataclass(frozen=True, repr=False)
class ZeroFeedthrough(Shown):
    """This says how far G = 0 pins F: `zero_feedthrough` makes it.

    `members` is U, n x zeta in reduced column echelon form; `own` is the verdict on the system's own pair. `delay_known_state` and
    `delay_unknown_state` are the samples after which v(0) is determined for the given F; the latter is None where it never is.
    """

    exceptional: Exceptional
    own: PairVerdict
    members: Matrix
    rank_CF: int
    alternative: Alternative | None
    delay_known_state: int
    delay_unknown_state: int | None

    @property
    def ambiguity(self) -> int:
        """Zeta - m, the dimension that the members have beyond im F."""
        return self.members.ncols - self.exceptional.columns

    @property
    def pins_F(self) -> bool:
        """This tells whether every equivalent F' with zero feedthrough is F T with an invertible T."""
        return self.alternative is None

    @property
    def pins_v(self) -> bool:
        """This tells whether all equivalent pairs (F', 0) explain an output by v' = T^-1 v, one T a pair, be the initial state known or
        not.
        """
        return self.exceptional.columns == 0 or self.ambiguity == len(self.exceptional.fixed) - 1

    @property
    def finite_zeros(self) -> int:
        """n_f of the system."""
        return len(self.own.polynomial) - 1

    def to_json(self) -> dict[str, Any]:
        """Return what a certificate needs: members, condition, and the alternative where there is one."""
        counts = told(self, "ambiguity", "rank_CF", "finite_zeros", "pins_F", "pins_v", "delay_known_state", "delay_unknown_state")
        return {"members": self.members.to_json(), "zeta": self.members.ncols, **counts, **told(self, "own", "alternative")}

    @property
    def title(self) -> str:
        """This says what the knowledge that G = 0 pins."""
        return f"F is {'' if self.pins_F else 'not '}pinned up to a basis, v is {'pinned' if self.pins_v else 'not'}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are the conditions, and another F where there is one."""
        yield "zeta - m", str(self.ambiguity)
        yield "rank C F", str(self.rank_CF)
        yield "finite zeros", str(self.finite_zeros)
        yield "inversion delay, x(0) known", str(self.delay_known_state)
        yield "inversion delay, x(0) unknown", "none" if self.delay_unknown_state is None else str(self.delay_unknown_state)
        if self.alternative is not None:
            yield from named_matrix("another F", self.alternative.F)


def zero_feedthrough(kernel: KernelRepresentation | System) -> ZeroFeedthrough:
    """Return how far the knowledge that G = 0 pins the fault matrix F (n x m), and with it the fault signal.

    Source: [G25], [M73] and [TSH01] for the subspaces, [HP98] for recovery.

    Parameters
    ----------
    kernel : KernelRepresentation or System
        Left-invertible, with G = 0.

    Returns
    -------
    ZeroFeedthrough
        `pins_F` (whether F is known up to a basis), `pins_v`, `ambiguity`, a number of dimensions, an `alternative` F' of another
        column space where there is one, and both delays in samples.

    Raises
    ------
    InvalidInput
        Unless G = 0 and the system is left-invertible.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, kernel_representation, zero_feedthrough
    >>> found = zero_feedthrough(kernel_representation(ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 0]], [[0]])))
    >>> found.pins_F, found.ambiguity, found.alternative.F  # C F = 0: the fault is seen one sample late
    (False, 1, [[1], [0]])
    """
    kernel = kernel_of(kernel)
    system = kernel.system
    if not system.G.is_zero():
        raise InvalidInput("G: got a nonzero feedthrough, expected G = 0; problem (11) itself is answered by fault_space")
    known = delay_known_state(kernel)
    if known is None:
        raise InvalidInput(
            f"system: has normal rank {kernel.normal_rank} and {counted(system.m, 'fault')}, expected a left-invertible system; keep "
            f"{counted(kernel.normal_rank, 'independent fault')}"
        )
    pencil = exceptional(kernel)
    own = judge(pencil, _coordinates(pencil, system.F))
    return ZeroFeedthrough(
        pencil,
        own,
        pencil.states,
        rank(system.C @ system.F),
        _alternative(pencil, system),
        known,
        delay_unknown_state(kernel),
    )


def _coordinates(pencil: Exceptional, F: Matrix) -> Matrix:
    """Return P with [Fhat; Ghat] P = [F; 0]."""
    from_basis = stacked(F, Matrix.zero(F.field, pencil.system.p, F.ncols))
    pivots = [next(j for j, x in enumerate(row) if x != 0) for row in pencil.space.basis.elements()]
    return from_basis.rows(pivots)


def _alternative(pencil: Exceptional, system: ResidualSystem) -> Alternative | None:
    """Return another F' with zero feedthrough, by exchanging one column; None where im F = U or there is no fault."""
    if system.m == 0 or pencil.zeta == system.m:
        return None
    hidden = pencil.states @ largest_output_nulling(pencil.reduced)
    taken = beside(system.F, hidden) if pencil.zeta > system.m + hidden.ncols else system.F
    members = (pencil.states.columns([j]) for j in range(pencil.zeta))
    outside = next(c for c in members if rank(beside(taken, c)) > rank(taken))
    for column in (outside, system.F.columns([0]) + outside):
        F = beside(column, system.F.columns(range(1, system.m)))
        verdict = judge(pencil, _coordinates(pencil, F))
        if verdict.good:
            return Alternative(F, column, verdict)
    raise ArithmeticError("D is not linear in a column of P")
