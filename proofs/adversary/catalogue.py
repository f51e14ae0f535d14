"""All attacks, by target.

catalogue      every attack, once
attacks_on     those on one target
statement_of   what the ledger says of a target: the words that an attack is made on
"""

from __future__ import annotations

from functools import cache

from ..evidence.attacks import Attack
from ..verdict.ledger import expected_without, load
from .limit_catalogue import limit_attacks
from .pair_attacks import pair_attacks
from .structure_attacks import structure_attacks

WITHOUT = "without "


@cache
def catalogue() -> tuple[Attack, ...]:
    """Return all attacks in the order of the files. Raises ValueError where two attacks have one id."""
    found = (*limit_attacks(), *pair_attacks(), *structure_attacks())
    if len({attack.id for attack in found}) < len(found):
        raise ValueError("two attacks have the same id")
    return found


def attacks_on(target: str) -> tuple[Attack, ...]:
    """Return the attacks on this reading ("claim.reading") or row ("without EXPERIMENT: HYPOTHESIS")."""
    return tuple(attack for attack in catalogue() if attack.target == target)


def statement_of(target: str) -> str | None:
    """Return the statement with its hypotheses, or for a row the hypotheses of its experiment; None where the ledger has no such
    target."""
    if target.startswith(WITHOUT):
        experiment, _, dropped = target.removeprefix(WITHOUT).partition(": ")
        hypotheses = expected_without().get(experiment, {})
        return f"{experiment}: {'; '.join(hypotheses)}, without {dropped}" if dropped in hypotheses else None
    name, _, reading = target.partition(".")
    for claim in load():
        for one in claim.readings:
            if (claim.id, one.id) == (name, reading):
                return f"{one.statement} [{'; '.join(one.hypotheses)}]"
    return None


def expected_of(target: str) -> str | None:
    """Return the verdict that the ledger expects of a target, or None."""
    if target.startswith(WITHOUT):
        experiment, _, dropped = target.removeprefix(WITHOUT).partition(": ")
        return expected_without().get(experiment, {}).get(dropped)
    name, _, reading = target.partition(".")
    return next((one.expected for claim in load() if claim.id == name for one in claim.readings if one.id == reading), None)
