"""problem-11: the maximal solution of N_s T_s = 0, N_s a basis of the left null space, is a basis (Fhat, Ghat) with n_z columns."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import numpy as np

from ...exact.algebra.matrices import Matrix
from ...exact.structure.kernel_rows import column_conditions, kernel_representation
from ...exact.system.systems import ResidualSystem
from ..evidence.corpus import Evidence
from ..evidence.questions import DELAY_KNOWN_STATE, OBSERVABILITY, RANKS, SPACE, WINDOW_SPACES, ZEROS
from ..evidence.search import Box, Facts, Flags, systems_in_order
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, certify, counterexample, refute
from .common import spaces, under_assumption_4, zeros

BOX = Box(total=4, largest_n=2, largest_m=2, largest_p=2)


def window_n(bench: Workbench) -> Outcome:
    """At s = max(l, n), under assumption 4, the solutions are claimed to be those of every longer window."""

    def candidate(facts: Facts) -> Flags:
        return np.asarray(facts.observable & facts.left_invertible & (facts.delay_known_state <= facts.n))

    def holds(e: Evidence) -> bool:
        return e.system.n == 0 or e.space_dimensions[max(e.system.n, e.delay_known_state or 0) - 1] == e.fault_space.dimension

    asks = RANKS, OBSERVABILITY, DELAY_KNOWN_STATE, SPACE, WINDOW_SPACES
    return refute(bench, BOX, candidate, asks, under_assumption_4(True), holds, spaces(lambda s: s.n))


def window_n_plus_1(bench: Workbench) -> Outcome:
    """At every s >= n + 1 the solutions are the limit Z, without any hypothesis."""
    return certify(
        bench,
        (SPACE, WINDOW_SPACES),
        lambda e: True,
        lambda e: all(x == e.fault_space.dimension for x in e.space_dimensions[e.system.n :]),
        spaces(lambda s: s.n + 1),
    )


def lag_plus_1(bench: Workbench) -> Outcome:
    """The limit is reached exactly at s = lag + 1 where p > r; where p = r the solutions are all n + p columns at every s >= 1."""

    def holds(e: Evidence) -> bool:
        if e.system.p == e.kernel.normal_rank:
            return all(x == e.system.n + e.system.p for x in (*e.space_dimensions, e.fault_space.dimension))
        return all((x == e.fault_space.dimension) == (s >= e.kernel.lag + 1) for s, x in enumerate(e.space_dimensions, 1))

    return certify(bench, (RANKS, SPACE, WINDOW_SPACES), lambda e: True, holds, spaces(lambda s: kernel_representation(s).lag + 1))


def dimension(bench: Workbench) -> Outcome:
    """The limit of a left-invertible system has dimension n_v + zeta, where zeta counts the zeros of the pencil, finite and infinite."""

    def show(system: ResidualSystem) -> Iterator[Certificate]:
        yield from zeros(system)
        yield from spaces(lambda s: s.n + 1)(system)

    def holds(e: Evidence) -> bool:
        return e.fault_space.dimension == e.system.m + e.zeta

    return certify(bench, (RANKS, *ZEROS, SPACE), lambda e: e.left_invertible, holds, show)


def first_block_column(bench: Workbench) -> Outcome:
    """Is it enough that N_s annihilates the first block column of T_s(z)? The smallest system and column that say no."""
    for system in systems_in_order(BOX, lambda f: np.asarray(f.observable & f.left_invertible)):
        kernel = kernel_representation(system)
        window = kernel.lag + 1
        rows = kernel.rows_within(window)
        for entries in product((-1, 0, 1), repeat=system.n + system.p):
            z = Matrix.of([[x] for x in entries])
            if _first_column_vanishes(system, z, window) and not all(
                (column_conditions(r.coefficients, system.A, system.C) @ z).is_zero() for r in rows
            ):
                words = f"{system}, z = {list(entries)}, s = {window}"
                return counterexample(words, f"{BOX}, s = lag + 1", [make.first_column_only(kernel, window, z), make.window_ranks(kernel)])
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def _first_column_vanishes(system: ResidualSystem, z: Matrix, window: int) -> bool:
    """Return whether every left null row of [O_s T_s] annihilates (g, C f, C A f, ...)."""
    x, outputs = z.rows(range(system.n)), [z.rows(range(system.n, system.n + system.p))]
    for _ in range(window - 1):
        outputs.append(system.C @ x)
        x = system.A @ x
    for row in kernel_representation(system).rows_within(window):
        for shift in range(window - row.degree):
            values = [row.coefficients.rows([k]) @ outputs[k + shift] for k in range(row.degree + 1)]
            if not sum(values[1:], values[0]).is_zero():
                return False
    return True
