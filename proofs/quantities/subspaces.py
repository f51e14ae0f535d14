"""These are dimensions of subspaces of the state space, and the words that say that one is trivial. Source: [TSH01] ch. 3, 7, 8, [BM69].

V* holds the states from which some v keeps the output at zero for ever, and S* those that some v reaches from rest, the output being zero.
n steps say what V* and S* are, so that ranks of n samples give their dimensions: n - rank [O_n T_n] + rank T_n is that of V*, and
rank [R_n; T_n] - rank T_n that of S*, R_n = [A^(n-1) F, ..., F]. S* is the orthogonal complement of the V* of the transposed system.
"""

from __future__ import annotations

from ..evidence import certified
from ..evidence import questions as ask
from .ranks import DRIVEN, OBSERVED, REACHED, SILENT, WINDOW
from .registry import Kind, Quantity, Told

QUANTITIES = (
    Quantity(
        "unobservable_dimension",
        Kind.INTEGER,
        "n - rank O_n",
        lambda x: x.system.n - x.silent.rank(x.system.n),
        lambda r: r.n - r.at(OBSERVED, r.n),
        certified.observed,
        told=Told((ask.OBSERVABILITY,), lambda e: e.system.n - e.answer(ask.OBSERVABILITY)),
        at_most=("n",),
    ),
    Quantity(
        "uncontrollable_dimension",
        Kind.INTEGER,
        "n - rank [F, ..., A^(n-1) F]",
        lambda x: x.system.n - x.reached.rank(x.system.n),
        lambda r: r.n - r.at(REACHED, r.n),
        certified.reached,
        told=Told((ask.REACHABILITY,), lambda e: e.system.n - e.answer(ask.REACHABILITY)),
        at_most=("n",),
    ),
    Quantity(
        "weakly_unobservable_dimension",
        Kind.INTEGER,
        "dim V*: the states from which some v keeps the output at zero for ever",
        lambda x: x.weakly_unobservable.ncols,
        lambda r: r.n - r.at(WINDOW, r.n) + r.at(DRIVEN, r.n),
        certified.settled,
        at_most=("n",),
    ),
    Quantity(
        "strongly_reachable_dimension",
        Kind.INTEGER,
        "dim S*: the states that some v reaches from rest with zero output",
        lambda x: x.strongly_reachable.ncols,
        lambda r: r.table(SILENT)[0] - r.at(DRIVEN, r.n),
        certified.dual_settled,
        at_most=("n",),
    ),
    Quantity(
        "observable",
        Kind.WORD,
        "rank O_n = n",
        lambda x: x.silent.rank(x.system.n) == x.system.n,
        lambda r: r.at(OBSERVED, r.n) == r.n,
        certified.observed,
        told=Told((ask.OBSERVABILITY,), lambda e: e.observable),
        balance=("unobservable_dimension", ""),
    ),
    Quantity(
        "controllable",
        Kind.WORD,
        "rank [F, ..., A^(n-1) F] = n",
        lambda x: x.reached.rank(x.system.n) == x.system.n,
        lambda r: r.at(REACHED, r.n) == r.n,
        certified.reached,
        told=Told((ask.REACHABILITY,), lambda e: e.controllable),
        balance=("uncontrollable_dimension", ""),
    ),
    Quantity(
        "minimal",
        Kind.WORD,
        "observable and controllable",
        lambda x: x.silent.rank(x.system.n) == x.system.n == x.reached.rank(x.system.n),
        lambda r: r.at(OBSERVED, r.n) == r.n == r.at(REACHED, r.n),
        certified.both,
        told=Told((ask.OBSERVABILITY, ask.REACHABILITY), lambda e: e.observable and e.controllable),
        parts=("observable", "controllable"),
    ),
)
