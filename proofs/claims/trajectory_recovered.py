"""trajectory-recovered: the fault signal from the residual, for a pair (F, G) that one has chosen; with and without the initial state."""

from __future__ import annotations

import numpy as np

from ...exact.algebra import polynomials
from ...exact.algebra.matrices import Matrix, rank
from ...exact.pairs.no_feedthrough import zero_feedthrough
from ...exact.structure.kernel_rows import kernel_representation
from ...exact.structure.record import analyze
from ...exact.system.systems import ResidualSystem
from ...exact.system.windows import observability_matrix
from ..evidence.corpus import Dossier
from ..evidence.search import Box
from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench, certify, refute
from .common import delays, zeros

BOX = Box(total=4, largest_n=2, largest_m=2, largest_p=2)


def state_known(bench: Workbench) -> Outcome:
    """x(0) known: v is determined iff the system is left-invertible, with a delay of the largest infinite zero order at most."""

    def holds(d: Dossier) -> bool:
        if not d.left_invertible:
            return d.delay_known_state is None
        return d.delay_known_state == max(d.infinite_zero_orders or (), default=0)

    return certify(bench, lambda d: d.infinite_zero_orders is not None, holds, delays)


def state_unknown(bench: Workbench) -> Outcome:
    """x(0) unknown: left-invertible and observable, so v is determined."""
    return refute(
        bench,
        BOX,
        lambda f: np.asarray(f.observable & f.left_invertible & (f.delay_unknown_state > f.n)),
        lambda d: d.observable and d.left_invertible,
        lambda d: d.delay_unknown_state is not None,
        delays,
    )


def no_finite_zeros(bench: Workbench) -> Outcome:
    """x(0) unknown: v is determined iff left-invertible and all finite zeros are unobservable modes, none where (A, C) is observable."""

    def holds(d: Dossier) -> bool:
        hidden = d.n - rank(observability_matrix(d.system, d.n))
        return (d.delay_unknown_state is not None) == (d.left_invertible and d.finite_zeros == hidden)

    return certify(bench, lambda d: d.finite_zeros is not None, holds, lambda s: [*zeros(s), *delays(s)])


def no_finite_zeros_as_a_set(bench: Workbench) -> Outcome:
    """x(0) unknown: v is determined iff left-invertible and every finite zero is an unobservable mode, multiplicities not counted."""

    def holds(d: Dossier) -> bool:
        return (d.delay_unknown_state is not None) == (d.left_invertible and zeros_are_hidden_modes(d.system))

    return certify(bench, lambda d: d.finite_zeros is not None and d.n <= 4, holds, lambda s: [*zeros(s), *delays(s)])


def zeros_are_hidden_modes(system: ResidualSystem) -> bool:
    """Whether every finite zero is one of the system without faults: those are the unobservable modes."""
    field = system.field
    faultless = system.with_faults(Matrix.zero(field, system.n, 0), Matrix.zero(field, system.p, 0))
    hidden, rest = analyze(faultless).invariant_zero_polynomial, analyze(system).invariant_zero_polynomial
    while len(common := polynomials.gcd(rest, hidden)) > 1:
        rest, _ = polynomials.divide(rest, common)
    return len(rest) == 1


def zero_feedthrough_signal(bench: Workbench) -> Outcome:
    """G = 0: v is the same in all equivalent pairs, up to a basis, iff rank CF = m and the finite zeros are the unobservable modes."""

    def holds(d: Dossier) -> bool:
        found = zero_feedthrough(kernel_representation(d.system))
        hidden = d.n - rank(observability_matrix(d.system, d.n))
        return found.pins_v == (rank(d.system.C @ d.system.F) == d.m and d.finite_zeros == hidden)

    return certify(bench, lambda d: d.left_invertible and d.m > 0 and d.finite_zeros is not None and d.system.G.is_zero(), holds, zeros)
