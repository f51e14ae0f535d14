"""Claims about data and fault signals: what the residual of an excited system shows, and which faults can be told from it.

assumption-4          left-invertible with delay l, (A, C) observable, [X; V_s] of full row rank, s >= max(l, n_x - 1) (elsewhere
                      max(l, n_x)); decided by what it is for: does rank R_(s+1) - rank R_s = n_v follow? Each stated bound on s, each
                      sense of the delay, and the condition on the data
zero-feedthrough      if G = 0, fault matrices and trajectory are recovered exactly, up to a choice of basis
trajectory-recovered  the fault signal from the residual, for a pair (F, G) that one has chosen; with and without the initial state
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from itertools import islice, product

from ...exact.algebra import polynomials
from ...exact.algebra.fields import QQ
from ...exact.algebra.matrices import Matrix, rank
from ...exact.pairs.no_feedthrough import zero_feedthrough
from ...exact.structure.fault_columns import fault_space
from ...exact.structure.pencil import zeros_alone
from ...exact.structure.signals import excitation_matrix, hankel, persistency, simulate
from ...exact.system.systems import ResidualSystem
from ...exact.system.windows import observability_matrix
from ..boxes.box import Box, in_order
from ..evidence.corpus import Evidence
from ..evidence.families import adversarial, random_systems
from ..evidence.questions import DELAY_UNKNOWN_STATE, FINITE_ZEROS, OBSERVABILITY, RANKS, SPACE, ZEROS
from ..evidence.subjects import kernel_once
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate, sha256
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, accepted, certify, counterexample, refute
from .common import delays, zeros

# -- assumption-4 ----------------------------------------------------------------------------------------------------------


BOX = Box(n=(1, 2), m=(1, 2), p=(1, 2), total=4)
ONE_STATE = Box(n=(1, 1), m=(1, 1), p=(1, 2), total=4)
VALID = "observable and left_invertible and delay_unknown <= 1"  # n = s = 1 is at least both delays


def assumption_4_excitation_at_s(bench: Workbench) -> Outcome:
    """[X; V_s] of full row rank at the s of the statement is not enough: this finds the smallest trajectory whose gap of R is wrong."""
    samples, s = 5, 1
    for system in in_order(ONE_STATE, VALID):
        for x, *v in product((-1, 0, 1), repeat=1 + samples):
            x0, faults = Matrix.of([[x]]), Matrix.of([[value] for value in v])
            data = simulate(system, x0, faults)
            full = rank(excitation_matrix(data, s)) == system.n + system.m * s
            if full and rank(hankel(data.residuals, s + 1)) - rank(hankel(data.residuals, s)) != system.m:
                words, scope = f"{system}, x(0) = {x}, v = {v}, s = {s}", f"{samples} samples, entries of x(0) and v in {{-1, 0, 1}}"
                return counterexample(words, f"{ONE_STATE}, {scope}", _gap_certificates(system, x0, faults, s, s))
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def assumption_4_excitation_at_s_plus_1(bench: Workbench) -> Outcome:
    """Where [X; V_(s+1)] has full row rank, R_s and R_(s+1) have the ranks of the model, so that the gap is m for s >= lag."""
    return _on_data(bench, excited=True)


def assumption_4_excitation_necessary(bench: Workbench) -> Outcome:
    """Is full row rank of [X; V_(s+1)] needed for the gap? A system with a mode that is never excited says no."""
    s = 1
    for system in in_order(ONE_STATE, VALID, "not controllable"):
        for v in product((0, 1, -1), repeat=6):
            x0, faults = Matrix.of([[0]]), Matrix.of([[value] for value in v])
            data = simulate(system, x0, faults)
            deficient = rank(excitation_matrix(data, s + 1)) < system.n + system.m * (s + 1)
            right = rank(hankel(data.residuals, s + 1)) - rank(hankel(data.residuals, s)) == system.m
            if deficient and right and persistency(faults) >= system.n + s + 1:
                words = f"{system}, x(0) = 0, v = {list(v)}, s = {s}: rank deficient, gap right"
                return counterexample(words, ONE_STATE, _gap_certificates(system, x0, faults, s, s + 1))
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def assumption_4_persistency_suffices(bench: Workbench) -> Outcome:
    """Where v is persistently exciting of order n + s + 1 and s >= lag, the gap of R is m, whatever the rank of [X; V_(s+1)] is."""
    return _on_data(bench, excited=False)


def _on_data(bench: Workbench, *, excited: bool) -> Outcome:
    """On random trajectories of left-invertible systems, rank R_(s+1) - rank R_s is m at s = max(lag, 1), by certificates of rank."""
    rng = random.Random(4)
    systems = [s for _, s in adversarial() if 0 < s.n <= 3] + list(
        islice(random_systems(QQ, 4000, seed=5, largest=3), 400 if bench.full else 30)
    )
    tried, deficient, decided = 0, 0, set[str]()
    headline: tuple[Certificate, ...] = ()
    for system in systems:
        kernel = kernel_once(system)
        if kernel.normal_rank < system.m or system.m == 0 or system.n == 0:
            continue
        s = max(kernel.lag, 1)
        samples = (system.m + 1) * (system.n + s + 1) + system.n + 2
        v = Matrix.of([[rng.randint(-2, 2) for _ in range(system.m)] for _ in range(samples)])
        x0 = Matrix.of([[rng.randint(-1, 1) if excited else 0] for _ in range(system.n)])
        full = rank(excitation_matrix(simulate(system, x0, v), s + 1)) == system.n + system.m * (s + 1)
        if (excited and not full) or (not excited and persistency(v) < system.n + s + 1):
            continue
        certificates = accepted(_gap_certificates(system, x0, v, s, s + 1))
        gap = certificates[2]["statement"]["rank"] - certificates[1]["statement"]["rank"]
        if gap != system.m:
            return Outcome(Verdict.REFUTED, f"fails on {system}, x(0) = {x0}, v = {v}, s = {s}", certificates)
        tried, deficient = tried + 1, deficient + (not full)
        decided.update(map(sha256, certificates))
        headline = headline or certificates
    if not tried:
        return Outcome(Verdict.ERROR, "no trajectory meets the hypotheses")
    note = "" if excited else f", {deficient} of them with [X; V_(s+1)] rank-deficient"
    which = f"{tried} exact trajectories of left-invertible systems over Q, named and random, at s = max(lag, 1)"
    words = f"no counterexample found in {which}{note}"
    return Outcome(Verdict.CERTIFIED, words, headline, frozenset(decided))


def _gap_certificates(system: ResidualSystem, x0: Matrix, v: Matrix, s: int, excited: int) -> Iterator[Certificate]:
    """Yield certificates of the ranks of [X; V] on so many excited samples, of R_s and of R_(s+1)."""
    yield make.data_rank("excitation", system, x0, v, excited)
    for k in (s, s + 1):
        yield make.data_rank("residual-hankel", system, x0, v, k)


# -- zero-feedthrough ------------------------------------------------------------------------------------------------------


def zero_feedthrough_fault_matrices(bench: Workbench) -> Outcome:
    """With G = 0 known, every member of Z without feedthrough is claimed to lie in im F, for left-invertible observable systems."""
    asks, candidates = (RANKS, OBSERVABILITY, SPACE), "observable and left_invertible and is_zero(G)"
    return refute(bench, BOX, candidates, asks, lambda e: _applies(e) and e.observable, _pinned, _show)


def zero_feedthrough_exactly_when(bench: Workbench) -> Outcome:
    """With G = 0 and a left-invertible system, im F is determined iff zeta = m, that is iff rank CF = m and there are no finite zeros."""

    def holds(e: Evidence) -> bool:
        condition = rank(e.system.C @ e.system.F) == e.system.m and e.finite_zeros == 0
        return _pinned(e) == condition == (e.zeta == e.system.m)

    return certify(bench, (RANKS, *ZEROS, SPACE), _applies, holds, _show)


def _applies(e: Evidence) -> bool:
    return e.left_invertible and e.system.G.is_zero()


def _pinned(e: Evidence) -> bool:
    return e.without_feedthrough == rank(e.system.F)


def _show(system: ResidualSystem) -> Iterator[Certificate]:
    yield from zeros(system)
    kernel = kernel_once(system)
    yield make.fault_space(kernel, fault_space(kernel))


# -- trajectory-recovered --------------------------------------------------------------------------------------------------


def trajectory_recovered_no_finite_zeros_as_a_set(bench: Workbench) -> Outcome:
    """The same is claimed with multiplicities not counted: that every finite zero is an unobservable mode."""

    def holds(e: Evidence) -> bool:
        return (e.delay_unknown_state is not None) == (e.left_invertible and zeros_are_hidden_modes(e.system))

    return certify(bench, (RANKS, DELAY_UNKNOWN_STATE), lambda e: True, holds, lambda s: [*zeros(s), *delays(s)])


def zeros_are_hidden_modes(system: ResidualSystem) -> bool:
    """Return whether every finite zero is one of the system without faults: those are the unobservable modes."""
    field = system.field
    faultless = system.with_faults(Matrix.zero(field, system.n, 0), Matrix.zero(field, system.p, 0))
    hidden, rest = (zeros_alone(kernel_once(one)) for one in (faultless, system))
    while len(common := polynomials.gcd(rest, hidden)) > 1:
        rest, _ = polynomials.divide(rest, common)
    return len(rest) == 1


def trajectory_recovered_zero_feedthrough_signal(bench: Workbench) -> Outcome:
    """With G = 0, v is the same in all equivalent pairs up to a basis iff rank CF = m and the finite zeros are the unobservable modes."""

    def holds(e: Evidence) -> bool:
        found = zero_feedthrough(kernel_once(e.system))
        hidden = e.system.n - rank(observability_matrix(e.system, e.system.n))
        return found.pins_v == (rank(e.system.C @ e.system.F) == e.system.m and e.finite_zeros == hidden)

    return certify(bench, (RANKS, FINITE_ZEROS), lambda e: e.left_invertible and e.system.m > 0 and e.system.G.is_zero(), holds, zeros)
