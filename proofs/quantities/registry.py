"""What a quantity is, and the one list of them: a file of this folder that has a tuple QUANTITIES adds to it.

    Kind          what an expression is: INTEGER (inf included), LIST of integers, WORD (true or false), MATRIX
    Quantity      a name with all that is known of it: its value, found in three ways, its certificates, what follows from its meaning
    Told          how a value is read off accepted certificates about a system
    quantities    name -> Quantity, of every file of this folder

A value is found in three ways. `exact` asks the room `exact` about one system, over Q or GF(p), of any size. `from_ranks` says the same by
ranks of built matrices, as definitions do: these are found for many thousands of small systems at once, so that it serves boxes. `told`
reads it off answers of certificates, as the ledger does. The tests hold the ways against each other and against a slow oracle, which
knows the quantity by its name.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

from ..evidence.certified import Certifier
from ..evidence.questions import Question
from ..evidence.subjects import Subject
from .ranks import Ranks


class Kind(StrEnum):
    """What an expression stands for."""

    INTEGER = "an integer"
    LIST = "a list of integers"
    WORD = "true or false"
    MATRIX = "a matrix"


@dataclass(frozen=True)
class Told:
    """The questions about a system whose accepted certificates tell a quantity, and how it is read off the `Evidence` (at s samples)."""

    asks: tuple[Question[Any], ...]
    read: Callable[..., Any]


@dataclass(frozen=True)
class Quantity:
    """A name that claims may use. A `windowed` one is a function of a number of samples s >= 0, and the functions here take s too.

    `meaning` says in words what it is; `circle` marks what asks for the unit circle, over Q or a number field with a chosen root.
    `certificates` makes, of a subject (and s), what the checker accepts and what implies the value; it is None where no kind of certificate
    does; `told` is None where no question of the corpus tells it.

    What derivations use: an integer is at least 0, finite unless `infinite`, and at most each of `at_most`. Where it has `parts`, an
    integer is their sum, and a word says all of them. By the two sides of a `balance`, of which "" is 0, a word says that they are equal,
    and a list has the first less the second as its length.
    """

    name: str
    kind: Kind
    meaning: str
    exact: Callable[..., Any]
    from_ranks: Callable[..., Any]
    certificates: Certifier | None
    told: Told | None = None
    windowed: bool = False
    circle: bool = False
    infinite: bool = False
    parts: tuple[str, ...] = ()
    at_most: tuple[str, ...] = ()
    balance: tuple[str, str] | None = None


@cache
def quantities() -> dict[str, Quantity]:
    """Return every quantity by its name, file by file. Raises ValueError where two files use one name."""
    found: dict[str, Quantity] = {}
    package = __name__.rpartition(".")[0]
    for module in sorted(one.name for one in iter_modules(import_module(package).__path__)):
        for one in getattr(import_module(f".{module}", package), "QUANTITIES", ()):
            if one.name in found:
                raise ValueError(f"two quantities have the name {one.name}")
            found[one.name] = one
    return found


__all__ = ["Kind", "Quantity", "Ranks", "Subject", "Told", "quantities"]
