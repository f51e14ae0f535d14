"""The hypotheses of the claims about one system, each as an ablation on windows of systems.

rank_formula                        theorem-2
gap, gap_from_lag                   proposition-3, as the paper bounds s and with the sharp bound
solutions, solutions_from_lag       problem (11) at a window, with both bounds
columns                             the number of columns of (Fhat, Ghat)
range_of_f                          zero-feedthrough
signal_from_known_state, signal_from_unknown_state    trajectory-recovered
every_window, sharp_gap             window-ranks and sharp-windows
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from ...exact.algebra.matrices import rank
from ..claims.common import delays, spaces, zeros
from ..evidence.questions import DELAY_KNOWN_STATE, DELAY_UNKNOWN_STATE, FINITE_ZEROS, RANKS, SPACE, WINDOW_SPACES, WINDOWS, ZEROS
from ..evidence.search import Box, Facts, Flags
from ..verdict.ablation import Ablation, Proof
from .facets import facets
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
    windowed,
)

MODEL = {"observable": OBSERVABLE, "controllable": CONTROLLABLE, "left-invertible": LEFT_INVERTIBLE, "A stable": STABLE}
INVERTIBLE = "left-invertible"


def _formula(subject: Windowed) -> bool:
    e, s = subject.evidence, subject.window
    return e.kernel.rank(s) == e.system.n + s * e.system.m - e.zeta


def _formula_look(facts: Facts, s: int) -> Flags:
    """Return whether the formula surely holds: of left-invertible systems, whose zeta is read off a late rank; others stay open."""
    late = facts.n + 1
    zeta = facts.n + late * facts.m - facts.rank(late)
    return np.asarray(facts.left_invertible & (facts.rank(s) == facts.n + s * facts.m - zeta))


def _settled(facts: Facts, s: int) -> Flags:
    """Return whether no left minimal index is above s - 1."""
    return np.asarray(facts.gap(s - 1) == facts.gap(facts.n + 1))


GAP_IS_M = Condition((RANKS,), lambda w: w.evidence.kernel.gap(w.window) == w.evidence.system.m, lambda f, s: np.asarray(f.gap(s) == f.m))
LIMIT_REACHED = Condition(
    (SPACE, WINDOW_SPACES), lambda w: w.evidence.space_dimensions[w.window - 1] == w.evidence.fault_space.dimension, _settled
)


def rank_formula() -> Ablation[Windowed]:
    """Return the ablation of theorem-2 with the zeros of the pencil."""
    hypotheses = {**MODEL, "s >= n": from_n()}
    conclusion = Condition((RANKS, *ZEROS), _formula, _formula_look)
    proof = _proof("theorem_2", "lag_at_most_n", uses={INVERTIBLE, "s >= n"})
    return windowed("rank-formula", "theorem-2", "rank [O_s T_s] = n + s m - zeta", hypotheses, conclusion, zeros, proof=proof)


def gap() -> Ablation[Windowed]:
    """Return the ablation of proposition-3 as the paper bounds s."""
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
    conclusion = Condition(
        (*ZEROS, SPACE), lambda w: w.evidence.fault_space.dimension == w.evidence.system.m + w.evidence.zeta, lambda f, s: f.left_invertible
    )
    words = "Z has dimension n_z = m + zeta"
    proof = _proof("problem_11_dimension", "zeros_exist", "lag_at_most_n", uses={INVERTIBLE})
    return windowed("columns", "problem-11", words, MODEL, conclusion, zeros, windows=lambda n: NO_WINDOW, proof=proof)


NO_FEEDTHROUGH = Condition((), lambda w: w.evidence.system.G.is_zero(), lambda f, s: np.asarray(~f.G.any(axis=(1, 2))))
RELATIVE_DEGREE_ONE = Condition(
    (),
    lambda w: rank(w.evidence.system.C @ w.evidence.system.F) == w.evidence.system.m,
    lambda f, s: np.asarray(f.rank_from_rest(2) == f.m),
)
NO_FINITE_ZEROS = Condition((FINITE_ZEROS,), lambda w: w.evidence.finite_zeros == 0, lambda f, s: np.full(len(f.A), True))
ONLY_UNOBSERVABLE = Condition(
    (FINITE_ZEROS,), lambda w: w.evidence.finite_zeros == facets(w.evidence.system).unobservable_modes, lambda f, s: np.full(len(f.A), True)
)


def range_of_f() -> Ablation[Windowed]:
    """The ablation of zero-feedthrough: with G = 0 known, im F is determined by the outputs."""
    hypotheses = {**MODEL, "rank CF = m": RELATIVE_DEGREE_ONE, "no finite zeros": NO_FINITE_ZEROS}
    conclusion = Condition(
        (SPACE,), lambda w: w.evidence.without_feedthrough == rank(w.evidence.system.F), lambda f, s: np.full(len(f.A), False)
    )
    words = "the members of Z without feedthrough are im F"
    box = Box(total=4, largest_n=2, largest_m=2, largest_p=2)
    proof = _proof("zero_feedthrough", "theorem_3_part_i", "zeros_exist", uses={INVERTIBLE, "rank CF = m", "no finite zeros"})
    implied = {
        "observable": "each unobservable mode is a finite zero",
        INVERTIBLE: "as G = 0 and rank CF = m, the first v that is not 0 shows one step later, as CF v",
    }
    made = ("range-of-F", "zero-feedthrough", words, hypotheses, conclusion, zeros, NO_FEEDTHROUGH, lambda n: NO_WINDOW, box)
    return windowed(*made, proof=proof, implied=implied)


def signal_from_known_state() -> Ablation[Windowed]:
    """Return the ablation of trajectory-recovered where v is found from the outputs and x(0)."""
    conclusion = Condition(
        (DELAY_KNOWN_STATE,), lambda w: w.evidence.delay_known_state is not None, lambda f, s: np.asarray(f.delay_known_state <= f.n)
    )
    words = "the outputs and x(0) determine v"
    proof = _proof("trajectory_state_known", uses={INVERTIBLE})
    made = ("signal-known-state", "trajectory-recovered", words, MODEL, conclusion, delays)
    return windowed(*made, windows=lambda n: NO_WINDOW, proof=proof)


def signal_from_unknown_state() -> Ablation[Windowed]:
    """Return the ablation of trajectory-recovered where v is found from the outputs alone."""
    zeros_hidden = "as many finite zeros as unobservable modes"
    hypotheses = {**MODEL, zeros_hidden: ONLY_UNOBSERVABLE}
    conclusion = Condition(
        (DELAY_UNKNOWN_STATE,), lambda w: w.evidence.delay_unknown_state is not None, lambda f, s: np.asarray(f.delay_unknown_state <= f.n)
    )
    words = "the outputs alone determine v"
    proof = _proof("trajectory_no_finite_zeros", "zeros_exist", uses={INVERTIBLE, zeros_hidden})
    made = ("signal-unknown-state", "trajectory-recovered", words, hypotheses, conclusion, delays)
    return windowed(*made, windows=lambda n: NO_WINDOW, proof=proof)


def every_window() -> Ablation[Windowed]:
    """The ablation of window-ranks: the formula of the indices gives the rank of each window."""
    conclusion = Condition(
        (RANKS, WINDOWS),
        lambda w: w.evidence.kernel.rank(w.window) == w.evidence.window_ranks[w.window - 1],
        lambda f, s: np.full(len(f.A), False),
    )
    words = "rank [O_s T_s] = s r + sum of min(s, eta_i)"
    proof = _proof("window_ranks", "window_ranks_left_indices", "zeros_exist")
    return windowed("every-window", "window-ranks", words, MODEL, conclusion, spaces(lambda s: s.n + 1), proof=proof)


def sharp_gap() -> Ablation[Windowed]:
    """The ablation of sharp-windows: the gap is r for exactly the s >= lag."""
    conclusion = Condition(
        (RANKS,),
        lambda w: (w.evidence.kernel.gap(w.window) == w.evidence.kernel.normal_rank) == (w.window >= w.evidence.kernel.lag),
        lambda f, s: np.full(len(f.A), False),
    )
    words = "gap(s) = r iff s >= lag"
    return windowed("sharp-gap", "sharp-windows", words, MODEL, conclusion, delays, proof=_proof("sharp_gap"))


def _proof(*theorems: str, uses: Collection[str] = ()) -> Proof:
    return Proof(theorems, frozenset(uses))
