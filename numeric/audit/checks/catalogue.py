"""This collects every check that there is, and the choice among them.

GENERATORS   what yields checks, in the order in which they are asked: what a first call leaves behind is looked at first
all_checks   every check, in that order; the kinds of trouble, drawn from a seed, come last
quick_checks part of them, by a rule
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from difflib import get_close_matches

from ....base.errors import InvalidData
from ..making.kinds_of_trouble import KINDS
from ..records import Check, Demand, named, patterned
from ..vectors.trouble import SEED
from . import (
    edges,
    excitation,
    faults,
    growth,
    identification,
    laws,
    manners,
    misfits,
    refusals,
    sequences,
    structure,
    surroundings,
    trouble,
)

GENERATORS = (
    surroundings.checks,
    identification.checks,
    faults.checks,
    excitation.checks,
    structure.checks,
    edges.checks,
    refusals.checks,
    misfits.checks,
    edges.of_silence,
    manners.checks,
    trouble.of_forms,
    sequences.checks,
    growth.checks,
    laws.checks,
)


def all_checks(seed: int = SEED) -> Iterator[Check]:
    """This yields every check, those of kinds of trouble on vectors drawn from the seed."""
    for generator in GENERATORS:
        yield from generator()
    yield from trouble.checks(seed)


def quick_checks(checks: Iterable[Check]) -> Iterator[Check]:
    """This yields the first check of each slug and function, and of those on kinds of trouble all; what is free, and fails nobody, is left
    out."""
    troubled = {kind.slug for kind in KINDS}
    seen = set()
    for one in checks:
        if one.kind != Demand.FREE and (one.vector in troubled or (one.slug, one.function) not in seen):
            seen.add((one.slug, one.function))
            yield one


def chosen(functions: Collection[str], only: Sequence[str] = (), seed: int = SEED, quick: bool = False) -> list[Check]:
    """Return the checks of these functions, those alone that a name or a pattern (see `names`) fits where any are given. Raises
    InvalidData for a name that fits nothing, and for one without * and ? that fits checks of other functions alone."""
    known = list(quick_checks(all_checks(seed)) if quick else all_checks(seed))
    for name in only:
        if not any(named(one, name) for one in known):
            like = get_close_matches(name, [*dict.fromkeys(one.slug for one in known), *(one.name for one in known)], n=4, cutoff=0.5)
            near = f"; like it are {', '.join(like)}" if like else ""
            near = f"; all that ask it are '*-{name.rstrip('*')}'" if name.rstrip("*") in {one.function for one in known} else near
            raise InvalidData(f"check {name}: there is none of that name, expected one that `faultspace audit --list` lists{near}")
        if functions and not patterned(name) and not any(named(one, name) for one in known if one.function in functions):
            asked = ", ".join(dict.fromkeys(one.function for one in known if named(one, name)))
            raise InvalidData(f"check {name} asks {asked}, which this adapter does not have: it has {', '.join(functions)}")
    return [one for one in known if one.function in functions and (not only or any(named(one, name) for name in only))]
