"""The hypotheses of the claims about one system, each as an ablation on windows of systems.

rank_formula                        theorem-2
gap, gap_from_lag                   proposition-3, with s >= n as the review has it, and with the sharp bound
solutions, solutions_from_lag       problem (11) at a window, with both bounds
columns                             the number of columns of (Fhat, Ghat)
range_of_f                          zero-feedthrough
signal_from_known_state, signal_from_unknown_state    trajectory-recovered
every_window, sharp_gap             window-ranks and sharp-windows
"""

from __future__ import annotations

from collections.abc import Collection

from ...exact.algebra.matrices import rank
from ..boxes.box import Box
from ..claims.common import delays, spaces, zeros
from ..evidence.questions import RANKS, SPACE, WINDOWS
from ..verdict.ablation import Ablation, Proof
from .windowed import (
    CONTROLLABLE,
    FROM_DELAY,
    LEFT_INVERTIBLE,
    NO_WINDOW,
    OBSERVABLE,
    STABLE,
    Condition,
    Windowed,
    from_lag,
    from_n,
    says,
    windowed,
)

MODEL = {"observable": OBSERVABLE, "controllable": CONTROLLABLE, "left-invertible": LEFT_INVERTIBLE, "A stable": STABLE}
INVERTIBLE = "left-invertible"


GAP_IS_M = says("gap({s}) == m")
LIMIT_REACHED = says("solutions({s}) == n_z")


def rank_formula() -> Ablation[Windowed]:
    """Return the ablation of theorem-2 with the zeros of the pencil."""
    hypotheses = {**MODEL, "s >= n": from_n()}
    conclusion = says("rank_OT({s}) == n + {s} * m - zeta")
    proof = _proof("theorem_2", "lag_at_most_n", uses={INVERTIBLE, "s >= n"})
    return windowed("rank-formula", "theorem-2", "rank [O_s T_s] = n + s m - zeta", hypotheses, conclusion, zeros, proof=proof)


def gap() -> Ablation[Windowed]:
    """Return the ablation of proposition-3 with s >= n, as the review has it."""
    hypotheses = {**MODEL, "s >= l": FROM_DELAY, "s >= n": from_n()}
    proof = _proof("proposition_3", uses={INVERTIBLE, "s >= n"})
    implied = {"s >= l": "a left-invertible system is inverted with delay n at most (theorem left_invertible_delay), so l <= n <= s"}
    return windowed("gap", "proposition-3", "gap(s) = m", hypotheses, GAP_IS_M, delays, proof=proof, implied=implied)


def gap_from_lag() -> Ablation[Windowed]:
    """Return the ablation of proposition-3 with the sharp bound on s."""
    hypotheses = {**MODEL, "s >= l": FROM_DELAY, "s >= lag": from_lag()}
    proof = _proof("proposition_3_lag", uses={INVERTIBLE, "s >= lag"})
    return windowed("gap-from-lag", "proposition-3", "gap(s) = m", hypotheses, GAP_IS_M, delays, proof=proof)


def solutions() -> Ablation[Windowed]:
    """The ablation of problem (11) at a window: its solutions are those of every longer one."""
    hypotheses = {**MODEL, "s >= n + 1": from_n(1)}
    words = "the solutions of problem (11) at s are Z"
    proof = _proof("problem_11", uses={"s >= n + 1"})
    return windowed("solutions", "problem-11", words, hypotheses, LIMIT_REACHED, spaces(lambda s: s.n), proof=proof)


def solutions_from_lag() -> Ablation[Windowed]:
    """Return the same ablation with the sharp bound on s."""
    hypotheses = {**MODEL, "s >= lag + 1": from_lag(1)}
    words = "the solutions of problem (11) at s are Z"
    proof = _proof("problem_11_lag", uses={"s >= lag + 1"})
    return windowed("solutions-from-lag", "problem-11", words, hypotheses, LIMIT_REACHED, spaces(lambda s: s.n), proof=proof)


def columns() -> Ablation[Windowed]:
    """Return the ablation of the claim on the number of columns of (Fhat, Ghat)."""
    conclusion = says("n_z == m + zeta")
    words = "Z has dimension n_z = m + zeta"
    proof = _proof("problem_11_dimension", "zeros_exist", "lag_at_most_n", uses={INVERTIBLE})
    return windowed("columns", "problem-11", words, MODEL, conclusion, zeros, windows=lambda n: NO_WINDOW, proof=proof)


NO_FEEDTHROUGH = Condition((), lambda w: w.evidence.system.G.is_zero(), "is_zero(G)")
RELATIVE_DEGREE_ONE = Condition((), lambda w: rank(w.evidence.system.C @ w.evidence.system.F) == w.evidence.system.m, "rank(C @ F) == m")
NO_FINITE_ZEROS = says("finite_zeros == 0")
ONLY_UNOBSERVABLE = says("finite_zeros == unobservable_dimension")


def range_of_f() -> Ablation[Windowed]:
    """The ablation of zero-feedthrough: with G = 0 known, im F is determined by the outputs."""
    hypotheses = {**MODEL, "rank CF = m": RELATIVE_DEGREE_ONE, "no finite zeros": NO_FINITE_ZEROS}
    conclusion = Condition((SPACE,), lambda w: w.evidence.without_feedthrough == rank(w.evidence.system.F), None)
    words = "the members of Z without feedthrough are im F"
    box = Box(n=(1, 2), m=(1, 2), p=(1, 2), total=4)
    proof = _proof("zero_feedthrough", "theorem_3_part_i", "zeros_exist", uses={INVERTIBLE, "rank CF = m", "no finite zeros"})
    implied = {
        "observable": "each unobservable mode is a finite zero",
        INVERTIBLE: "as G = 0 and rank CF = m, the first v that is not 0 shows one step later, as CF v",
    }
    made = ("range-of-F", "zero-feedthrough", words, hypotheses, conclusion, zeros, NO_FEEDTHROUGH, lambda n: NO_WINDOW, box)
    return windowed(*made, proof=proof, implied=implied)


def signal_from_known_state() -> Ablation[Windowed]:
    """Return the ablation of trajectory-recovered where v is found from the outputs and x(0)."""
    conclusion = says("delay_known < inf")
    words = "the outputs and x(0) determine v"
    proof = _proof("trajectory_state_known", uses={INVERTIBLE})
    made = ("signal-known-state", "trajectory-recovered", words, MODEL, conclusion, delays)
    return windowed(*made, windows=lambda n: NO_WINDOW, proof=proof)


def signal_from_unknown_state() -> Ablation[Windowed]:
    """Return the ablation of trajectory-recovered where v is found from the outputs alone."""
    zeros_hidden = "as many finite zeros as unobservable modes"
    hypotheses = {**MODEL, zeros_hidden: ONLY_UNOBSERVABLE}
    conclusion = says("delay_unknown < inf")
    words = "the outputs alone determine v"
    proof = _proof("trajectory_no_finite_zeros", "zeros_exist", uses={INVERTIBLE, zeros_hidden})
    made = ("signal-unknown-state", "trajectory-recovered", words, hypotheses, conclusion, delays)
    return windowed(*made, windows=lambda n: NO_WINDOW, proof=proof)


def every_window() -> Ablation[Windowed]:
    """The ablation of window-ranks: the formula of the indices gives the rank of each window."""
    conclusion = Condition(
        (RANKS, WINDOWS),
        lambda w: w.evidence.kernel.rank(w.window) == w.evidence.window_ranks[w.window - 1],
        None,
    )
    words = "rank [O_s T_s] = s r + sum of min(s, eta_i)"
    proof = _proof("window_ranks", "window_ranks_left_indices", "zeros_exist")
    return windowed("every-window", "window-ranks", words, MODEL, conclusion, spaces(lambda s: s.n + 1), proof=proof)


def sharp_gap() -> Ablation[Windowed]:
    """The ablation of sharp-windows: the gap is r for exactly the s >= lag."""
    conclusion = says("iff(gap({s}) == normal_rank, {s} >= lag)")
    words = "gap(s) = r iff s >= lag"
    return windowed("sharp-gap", "sharp-windows", words, MODEL, conclusion, delays, proof=_proof("sharp_gap"))


def _proof(*theorems: str, uses: Collection[str] = ()) -> Proof:
    return Proof(theorems, frozenset(uses))
