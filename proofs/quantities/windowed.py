"""These are the functions of a number of samples s: ranks of window matrices, and the solutions of problem (11). Source: [G25], [SB21]."""

from __future__ import annotations

from ...exact.structure.fault_columns import fault_space_dimension
from ..evidence import certified
from ..evidence import questions as ask
from ..evidence.corpus import Evidence
from ..evidence.subjects import Subject
from .ranks import DRIVEN, OBSERVED, WINDOW, Ranks
from .registry import Kind, Quantity, Told


def _driven(subject: Subject, s: int) -> int:
    """rank T_(k+1) - rank T_k counts the infinite zeros of order up to k."""
    return sum(max(s - order, 0) for order in subject.infinite_zero_orders)


def _solutions(ranks: Ranks, s: int) -> int:
    return ranks.n + ranks.p - sum(mu + 1 for mu in ranks.left_minimal_indices if mu < s)


def _told_solutions(evidence: Evidence, s: int) -> int:
    """There are certificates for s = 1, ..., n + 2; from n + 1 on the dimension stays as it is, and on no sample every column solves."""
    return evidence.space_dimensions[min(s, evidence.system.n + 2) - 1] if s else evidence.system.n + evidence.system.p


QUANTITIES = (
    Quantity(
        "rank_O",
        Kind.INTEGER,
        "rank O_s, O_s = [C; CA; ...; CA^(s-1)]",
        lambda x, s: x.silent.rank(s),
        lambda r, s: r.at(OBSERVED, s),
        certified.silent_windows,
        windowed=True,
    ),
    Quantity(
        "rank_T",
        Kind.INTEGER,
        "rank T_s",
        _driven,
        lambda r, s: r.at(DRIVEN, s),
        certified.driven,
        windowed=True,
    ),
    Quantity(
        "rank_OT",
        Kind.INTEGER,
        "rank [O_s T_s]",
        lambda x, s: x.kernel.rank(s),
        lambda r, s: r.at(WINDOW, s),
        certified.windows,
        windowed=True,
        told=Told((ask.RANKS,), lambda e, s: e.kernel.rank(s)),
    ),
    Quantity(
        "gap",
        Kind.INTEGER,
        "rank [O_(s+1) T_(s+1)] - rank [O_s T_s]",
        lambda x, s: x.kernel.gap(s),
        lambda r, s: r.step(WINDOW, s),
        certified.windows,
        windowed=True,
        told=Told((ask.RANKS,), lambda e, s: e.kernel.gap(s)),
    ),
    Quantity(
        "solutions",
        Kind.INTEGER,
        "the dimension of the solutions of problem (11) on s samples",
        lambda x, s: fault_space_dimension(x.kernel, s),
        _solutions,
        certified.solutions,
        windowed=True,
        told=Told((ask.WINDOW_SPACES,), _told_solutions),
    ),
    Quantity(
        "n_z",
        Kind.INTEGER,
        "the dimension of all solutions of problem (11), which is that from lag + 1 samples on",
        lambda x: fault_space_dimension(x.kernel),
        lambda r: _solutions(r, r.n + 1),
        certified.solutions,
        told=Told((ask.SPACE,), lambda e: e.fault_space.dimension),
    ),
)
