"""Restricted behaviours B|_s, the column spaces of [O_s T_s], compared by ranks; Hankel matrices of trajectories.

    included_on(inner, outer, s), equal_on(first, second, s)     on a window of s samples
    included(inner, outer), equivalent(first, second)            on every window
    first_difference(first, second)                              least window on which they differ, or None
    is_word(system, outputs)                                     whether some x(0), v produce these outputs
    residual_hankel(system, x0, v, s)                            R_s of the trajectory from x0 under v
    excitation(system, x0, v, s)                                 [X; V_s] of the same trajectory

How long a window is conclusive: rank [O_s T_s] grows by gap(k) = rank [C W_k, G] where W_k, the states reachable at
time k with zero output before, form a decreasing chain in K^n that stays constant once it repeats: the gap is constant
from k = n on. Now B(inner)|_s is within B(outer)|_s iff outer and the sum of both behaviours (the output of both
systems side by side, with n1 + n2 states) have equal ranks; if they have on s = n1 + n2 + 1 then, words having
beginnings, on all shorter windows too, all their gaps up to k = n1 + n2 agree, and therefore all others.
"""

from __future__ import annotations

from collections.abc import Sequence

from .fields import Element
from .linear import Matrix, above, beside, column_of, rank, solve, zeros
from .systems import System, trajectory
from .windows import hankel, window_matrix, window_rank


def conclusive_window(first: System, second: System) -> int:
    """The result is a number of samples on which two behaviours agree only if they do on every window."""
    return first.n + second.n + 1


def included_on(inner: System, outer: System, s: int) -> bool:
    """This tells whether every word of s samples of `inner` is one of `outer`."""
    both = beside(window_matrix(outer, s), window_matrix(inner, s))
    return rank(both) == window_rank(outer, s)


def equal_on(first: System, second: System, s: int) -> bool:
    """This tells whether the restricted behaviours on s samples are equal."""
    return included_on(first, second, s) and included_on(second, first, s)


def included(inner: System, outer: System) -> bool:
    """This tells whether B(inner) is contained in B(outer), on every window."""
    return included_on(inner, outer, conclusive_window(inner, outer))


def equivalent(first: System, second: System) -> bool:
    """This tells whether the behaviours are equal, on every window."""
    return equal_on(first, second, conclusive_window(first, second))


def first_difference(first: System, second: System) -> int | None:
    """The result is the least s >= 1 such that the restricted behaviours on s samples differ; None when there is none."""
    for s in range(1, conclusive_window(first, second) + 1):
        if not equal_on(first, second, s):
            return s
    return None


def is_word(system: System, outputs: Sequence[Matrix]) -> bool:
    """This tells whether the outputs r(0), ..., r(s-1), each p x 1, are those of some x(0) and v."""
    stacked = above(zeros(system.field, 0, 1), *outputs)
    return solve(window_matrix(system, len(outputs)), stacked) is not None


def residual_hankel(system: System, x0: Sequence[Element], v: Sequence[Sequence[Element]], s: int) -> Matrix:
    """The result is R_s, (p s) x (N-s+1): the block Hankel matrix of r(0..N-1)."""
    _, outputs = trajectory(system, x0, v)
    return hankel(system.field, outputs, system.p, s)


def excitation(system: System, x0: Sequence[Element], v: Sequence[Sequence[Element]], s: int) -> Matrix:
    """The result is [X; V_s], (n + m s) x (N-s+1): x(k) on top of v(k..k+s-1)."""
    states, _ = trajectory(system, x0, v)
    faults = hankel(system.field, [column_of(system.field, sample) for sample in v], system.m, s)
    return above(beside(zeros(system.field, system.n, 0), *states[: faults.width]), faults)
