"""assumption-4: left-invertible with delay l, (A, C) observable, [X; V_s] of full row rank, s >= max(l, n_x - 1) (elsewhere max(l, n_x)).

Decided by what it is for: does rank R_(s+1) - rank R_s = n_v follow? Each stated bound on s, each sense of the delay, and the
condition on the data.
"""

from __future__ import annotations

import random
from collections.abc import Iterable
from itertools import islice, product

from ...exact.algebra.fields import QQ
from ...exact.algebra.matrices import Matrix, rank
from ...exact.structure.signals import excitation_matrix, hankel, persistency, simulate
from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box, in_order
from ..evidence.families import adversarial, random_systems
from ..evidence.kept_kernels import kernel_once
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate, sha256
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, accepted, counterexample

# -- the condition on the data ---------------------------------------------------------------------------------------------

VALID = "observable and left_invertible and delay_unknown <= 1"  # n = s = 1 is at least both delays


def excitation_at_s(bench: Workbench) -> Outcome:
    """[X; V_s] of full row rank at the s of the statement is not enough: this finds the smallest trajectory whose gap of R is wrong."""
    box = Box(n=(1, 1), m=(1, 1), p=(1, 2), total=4)
    samples = 5
    for system in in_order(box, VALID):
        for x, *v in product((-1, 0, 1), repeat=1 + samples):
            x0, faults = Matrix.of([[x]]), Matrix.of([[value] for value in v])
            data = simulate(system, x0, faults)
            s = 1
            full = rank(excitation_matrix(data, s)) == system.n + system.m * s
            if full and rank(hankel(data.residuals, s + 1)) - rank(hankel(data.residuals, s)) != system.m:
                certificates = [make.data_rank("excitation", system, x0, faults, s)]
                certificates += [make.data_rank("residual-hankel", system, x0, faults, k) for k in (s, s + 1)]
                words = f"{system}, x(0) = {x}, v = {v}, s = {s}"
                return counterexample(words, f"{box}, {samples} samples, entries of x(0) and v in {{-1, 0, 1}}", certificates)
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def excitation_at_s_plus_1(bench: Workbench) -> Outcome:
    """Where [X; V_(s+1)] has full row rank, R_s and R_(s+1) have the ranks of the model, so that the gap is m for s >= lag."""
    return _on_data(bench, excited=True)


def excitation_necessary(bench: Workbench) -> Outcome:
    """Is full row rank of [X; V_(s+1)] needed for the gap? A system with a mode that is never excited says no."""
    box = Box(n=(1, 1), m=(1, 1), p=(1, 2), total=4)
    samples = 6
    for system in in_order(box, VALID, "not controllable"):
        for v in product((0, 1, -1), repeat=samples):
            x0, faults, s = Matrix.of([[0]]), Matrix.of([[value] for value in v]), 1
            data = simulate(system, x0, faults)
            deficient = rank(excitation_matrix(data, s + 1)) < system.n + system.m * (s + 1)
            right = rank(hankel(data.residuals, s + 1)) - rank(hankel(data.residuals, s)) == system.m
            if deficient and right and persistency(faults) >= system.n + s + 1:
                certificates = [make.data_rank("excitation", system, x0, faults, s + 1)]
                certificates += [make.data_rank("residual-hankel", system, x0, faults, k) for k in (s, s + 1)]
                return counterexample(f"{system}, x(0) = 0, v = {list(v)}, s = {s}: rank deficient, gap right", box, certificates)
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def persistency_suffices(bench: Workbench) -> Outcome:
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
        certificates = accepted(_gap_certificates(system, x0, v, s))
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


def _gap_certificates(system: ResidualSystem, x0: Matrix, v: Matrix, s: int) -> Iterable[Certificate]:
    yield make.data_rank("excitation", system, x0, v, s + 1)
    yield make.data_rank("residual-hankel", system, x0, v, s)
    yield make.data_rank("residual-hankel", system, x0, v, s + 1)
