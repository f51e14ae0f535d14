"""Which bounds are known: those that the literature file or the ledger in the language of claims states.

known_as     the names of the statements that say what a bound says, or the equality that it is half of

Two bounds are the same where they are the same sum, once nullities are written by ranks and zeta by its two parts. A statement counts where
each of its hypotheses stands among the given ones, word by word, and where the file expects that it is not refuted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources

from ..language.linear import Linear, linear
from ..language.nodes import Node
from ..language.vocabularies import SYSTEM
from ..quantities.registry import Kind, quantities
from .claim_files import read_claims
from .claims import Answered

FILES = ("literature", "ledger")
MEANINGS = {
    **{name: Linear(dict.fromkeys(one.parts, 1), 0) for name, one in quantities().items() if one.kind == Kind.INTEGER and one.parts},
    **{f"nullity({name})": Linear({width: 1, f"rank({name})": -1}, 0) for name, width in (("A", "n"), ("F", "m"), ("C", "n"), ("G", "m"))},
}


@dataclass(frozen=True)
class _Statement:
    name: str
    about: str
    hypotheses: frozenset[str]
    inequalities: tuple[Linear, ...]  # each sum is at most 0


def known_as(bound: Node, hypotheses: Sequence[str], about: str = SYSTEM) -> tuple[str, ...]:
    """Return the names of the statements about as much, as "literature: inverse-bound (Willsky ...)"."""
    wanted = at_most_zero(bound)
    given = {_spaced(one) for one in hypotheses}
    listed = [one for one in _statements() if one.about == about and one.hypotheses <= given]
    return tuple(one.name for one in listed if any(same in one.inequalities for same in wanted))


def at_most_zero(node: Node) -> tuple[Linear, ...]:
    """Return the sums that a comparison says to be at most 0; none where it is no comparison, or says !=."""
    if node.op == "and":
        return tuple(one for part in node.args for one in at_most_zero(part))
    if node.op != "compare" or any(part.kind != node.args[0].kind for part in node.args):
        return ()
    found: list[Linear] = []
    for left, sign, right in zip(node.args, node.value, node.args[1:], strict=False):
        less = linear(left).plus(linear(right), -1).expanded(MEANINGS)
        more = Linear({}, 0).plus(less, -1)
        one = Linear({}, 1)
        found += {"<=": [less], ">=": [more], "<": [less.plus(one)], ">": [more.plus(one)], "==": [less, more]}.get(sign, [])
    return tuple(found)


@cache
def _statements() -> tuple[_Statement, ...]:
    found = []
    examples = resources.files("faultspace").joinpath("examples")  # data of the front door, whose code stands above this room
    for file in FILES:
        for one in read_claims(examples.joinpath(f"{file}.toml").read_text("utf-8")):
            if "Q" not in one.boxes or one.expected.get("Q") not in (Answered.NOT_REFUTED, Answered.PROVED):
                continue
            name = f"{file}: {one.id}" + (f" ({one.source})" if one.source else "")
            hypotheses = frozenset(_spaced(given.that.text) for given in one.hypotheses)
            found.append(_Statement(name, one.about, hypotheses, at_most_zero(one.conclusion)))
    return tuple(found)


def _spaced(text: str) -> str:
    return "".join(text.split())
