"""These are the delays of left inversion, inf where there is none, and the two words on invertibility. Source: [SM69], [HP98]."""

from __future__ import annotations

from math import inf

from ...exact.structure.inversion import delay_known_state, delay_unknown_state
from ..evidence import certified
from ..evidence import questions as ask
from .ranks import DRIVEN, LATER, WINDOW, Ranks
from .registry import Kind, Quantity, Told


def _or_inf(delay: int | None) -> float:
    return inf if delay is None else delay


def _known(ranks: Ranks) -> float:
    """rank T_(l+1) - rank T_l = m: no combination of the columns of v(0) is one of the later columns."""
    return next((k for k in range(ranks.n + 1) if ranks.step(DRIVEN, k) == ranks.m), inf)


def _unknown(ranks: Ranks) -> float:
    """The columns of v(0) in [O_(l+1) T_(l+1)] are independent of each other and of all the others."""
    return next((k for k in range(ranks.n + 1) if ranks.at(WINDOW, k + 1) == ranks.m + ranks.at(LATER, k + 1)), inf)


QUANTITIES = (
    Quantity(
        "delay_known",
        Kind.INTEGER,
        "the least l with which r(0), ..., r(l) determine v(0), the initial state being known; inf where none does",
        lambda x: _or_inf(delay_known_state(x.kernel)),
        _known,
        certified.delay_known,
        told=Told((ask.DELAY_KNOWN_STATE,), lambda e: _or_inf(e.delay_known_state)),
        infinite=True,
    ),
    Quantity(
        "delay_unknown",
        Kind.INTEGER,
        "the least l with which r(0), ..., r(l) determine v(0) whatever x(0) is; inf where none does",
        lambda x: _or_inf(delay_unknown_state(x.kernel)),
        _unknown,
        certified.delay_unknown,
        told=Told((ask.DELAY_UNKNOWN_STATE,), lambda e: _or_inf(e.delay_unknown_state)),
        infinite=True,
    ),
    Quantity(
        "left_invertible",
        Kind.WORD,
        "the normal rank is m",
        lambda x: x.kernel.normal_rank == x.system.m,
        lambda r: r.normal_rank == r.m,
        certified.invertible,
        told=Told((ask.RANKS,), lambda e: e.left_invertible),
        balance=("normal_rank", "m"),
    ),
    Quantity(
        "right_invertible",
        Kind.WORD,
        "the normal rank is p",
        lambda x: x.kernel.normal_rank == x.system.p,
        lambda r: r.normal_rank == r.p,
        certified.dual_invertible,
        told=Told((ask.RANKS,), lambda e: e.kernel.normal_rank == e.system.p),
        balance=("normal_rank", "p"),
    ),
)
