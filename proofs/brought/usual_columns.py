"""The quantities that bounds are sought by where none are named, for each kind of claim.

default_columns   of systems all integer quantities and the ranks of A, F, C, G; of other kinds those of USUAL

The values that quantities of two systems take together are many more than those of one: with all quantities of both, a box of pairs has
more sets of values than a machine holds. What two systems share, since they have the same A and C or as many outputs, is named once. Ranks
of data are taken at 1 sample and at n + 1, from which on those of systems are settled.
"""

from __future__ import annotations

from ..language.linear import linear
from ..language.nodes import Node
from ..language.vocabularies import CHOICE, ONE_A_AND_C, PAIR, RECORD, SYSTEM
from ..quantities.registry import Kind, quantities

SIZES = ("n", "m", "p")
RANKS = ("rank(A)", "rank(F)", "rank(C)", "rank(G)")
USUAL = {
    PAIR: ("p", "first_difference", *(f"{one}.{name}" for one in ("first", "second") for name in ("n", "m", "lag", "normal_rank", "n_z"))),
    ONE_A_AND_C: (
        *("n", "p", "first_difference", "first.observability_index"),
        *(f"{one}.{name}" for one in ("first", "second") for name in ("m", "lag", "normal_rank", "n_z")),
    ),
    CHOICE: (
        *("n", "m", "p", "k", "first_difference", "rank(P)", "observability_index"),
        *(before + name for before in ("", "chosen.") for name in ("lag", "normal_rank", "n_z")),
    ),
    RECORD: (
        *("n", "p", "nu", "N", "rank(B)", "rank(D)"),
        *(f"inputs.{name}" for name in ("lag", "normal_rank", "observability_index", "uncontrollable_dimension")),
        *(f"{name}({s})" for name in ("u_rank", "x_rank", "w_rank", "y_rank") for s in ("1", "n + 1")),
    ),
}


def default_columns(target: Node, about: str = SYSTEM) -> list[str]:
    """Return them, but for what the target is a sum of; sizes stay."""
    of_systems = (*sorted(one.name for one in quantities().values() if one.kind == Kind.INTEGER and not one.windowed), *RANKS)
    inside = set(linear(target).multiples)
    return [name for name in USUAL.get(about, of_systems) if name not in inside or (name in SIZES and name != target.text)]
