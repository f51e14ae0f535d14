"""trajectory-recovered: the fault signal from the residual, for a pair (F, G) that one has chosen; with and without the initial state."""

from __future__ import annotations

from ...exact.algebra import polynomials
from ...exact.algebra.matrices import Matrix, rank
from ...exact.pairs.no_feedthrough import zero_feedthrough
from ...exact.structure.pencil import zeros_alone
from ...exact.system.systems import ResidualSystem
from ...exact.system.windows import observability_matrix
from ..evidence.corpus import Evidence
from ..evidence.kept_kernels import kernel_once
from ..evidence.questions import DELAY_UNKNOWN_STATE, FINITE_ZEROS, RANKS
from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench, certify
from .common import delays, zeros


def no_finite_zeros_as_a_set(bench: Workbench) -> Outcome:
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


def zero_feedthrough_signal(bench: Workbench) -> Outcome:
    """With G = 0, v is the same in all equivalent pairs up to a basis iff rank CF = m and the finite zeros are the unobservable modes."""

    def holds(e: Evidence) -> bool:
        found = zero_feedthrough(kernel_once(e.system))
        hidden = e.system.n - rank(observability_matrix(e.system, e.system.n))
        return found.pins_v == (rank(e.system.C @ e.system.F) == e.system.m and e.finite_zeros == hidden)

    return certify(bench, (RANKS, FINITE_ZEROS), lambda e: e.left_invertible and e.system.m > 0 and e.system.G.is_zero(), holds, zeros)
