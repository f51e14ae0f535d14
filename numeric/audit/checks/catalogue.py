"""This collects every check that there is, and the choice among them.

MODULES      the modules that have checks, in the order in which they are asked
all_checks   every check, in that order
chosen       the checks of some functions, or those of them that are named
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from ....base.errors import InvalidData
from ..records import Check
from . import consistency, excitation, faults, growth, identification, laws, manners, refusals, structure

MODULES = (identification, consistency, faults, excitation, structure, refusals, manners, growth, laws)


def all_checks() -> Iterator[Check]:
    """This yields every check."""
    for module in MODULES:
        yield from module.checks()


def chosen(functions: Collection[str], only: Sequence[str] = ()) -> list[Check]:
    """Return the checks of these functions, those named by slug or slug[vector] alone if any are. Raises InvalidData for an unknown
    name."""
    known = list(all_checks())
    for name in only:
        if not any(name in one.names for one in known):
            raise InvalidData(f"check {name}: there is none of that name; there are {', '.join(dict.fromkeys(one.slug for one in known))}")
        if functions and not any(name in one.names for one in known if one.function in functions):
            asked = ", ".join(dict.fromkeys(one.function for one in known if name in one.names))
            raise InvalidData(f"check {name} asks {asked}, which this adapter does not have: it has {', '.join(functions)}")
    return [one for one in known if one.function in functions and (not only or any(name in only for name in one.names))]
