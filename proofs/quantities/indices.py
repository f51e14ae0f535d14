"""The sizes n, m, p, the normal rank and the minimal indices of the pencil P(q) = [[qI - A, -F], [C, G]].

Source: [F75], [K80] 6.3, [W91].
"""

from __future__ import annotations

from operator import attrgetter

from ..evidence import certified
from ..evidence import questions as ask
from .ranks import OBSERVED, REACHED
from .registry import Kind, Quantity, Told


def _size(name: str, meaning: str) -> Quantity:
    of = attrgetter(f"system.{name}")
    return Quantity(name, Kind.INTEGER, meaning, of, attrgetter(name), certified.read, told=Told((), of))


QUANTITIES = (
    _size("n", "the number of states"),
    _size("m", "the number of faults (unknown inputs)"),
    _size("p", "the number of outputs"),
    Quantity(
        "normal_rank",
        Kind.INTEGER,
        "the rank of C (qI - A)^-1 F + G over the rational functions of q",
        lambda x: x.kernel.normal_rank,
        lambda r: r.normal_rank,
        certified.windows,
        told=Told((ask.RANKS,), lambda e: e.kernel.normal_rank),
        at_most=("m", "p"),
    ),
    Quantity(
        "left_minimal_indices",
        Kind.LIST,
        "the degrees of a minimal basis of the relations N(q) r = 0, ascending; there are p - normal_rank",
        lambda x: x.kernel.left_minimal_indices,
        lambda r: r.left_minimal_indices,
        certified.windows,
        told=Told((ask.RANKS,), lambda e: e.kernel.left_minimal_indices),
        balance=("p", "normal_rank"),
    ),
    Quantity(
        "right_minimal_indices",
        Kind.LIST,
        "the degrees of a minimal basis of {w(q) : P(q) w(q) = 0}, ascending; there are m - normal_rank",
        lambda x: x.dual.left_minimal_indices,
        lambda r: r.right_minimal_indices,
        certified.dual_windows,
        told=Told((ask.RIGHT_INDICES,), lambda e: e.right_minimal_indices),
        balance=("m", "normal_rank"),
    ),
    Quantity(
        "lag",
        Kind.INTEGER,
        "the largest left minimal index, 0 where there is none",
        lambda x: x.kernel.lag,
        lambda r: max(r.left_minimal_indices, default=0),
        certified.windows,
        told=Told((ask.RANKS,), lambda e: e.kernel.lag),
        at_most=("sum(left_minimal_indices)",),
    ),
    Quantity(
        "observability_index",
        Kind.INTEGER,
        "the least s with rank O_s = rank O_n, observable or not",
        lambda x: x.silent.lag,
        lambda r: r.settled(OBSERVED),
        certified.silent_windows,
        at_most=("n",),
    ),
    Quantity(
        "controllability_index",
        Kind.INTEGER,
        "the least s with rank [F, ..., A^(s-1) F] = rank [F, ..., A^(n-1) F], controllable or not",
        lambda x: x.reached.lag,
        lambda r: r.settled(REACHED),
        certified.reached_windows,
        at_most=("n",),
    ),
)
