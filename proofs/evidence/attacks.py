"""The records of the adversary.

Aim        what an attack looks for: a change of sign, a common zero, or a value other than zero
Family     a parametrisation of subjects that meet the hypotheses by construction, the same function for floats and for Fractions
Attack     a target, a family, the quantity in floats and exactly, and the exact decision on one point
Witness    a counterexample: the point, in words, as JSON, and the certificates that the checker accepted
Trial      how an attack ended
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..trust.structure_certificates import Certificate

Floats = NDArray[np.float64]
Point = tuple[Fraction, ...]


class Aim(StrEnum):
    """What an attack looks for.

    SIGN: the statement says that a quantity has no zero, and it has one where its sign changes. ZERO: several quantities together have no
    common zero. NONZERO: a quantity is identically zero. STRATUM: ranks drop where a quantity vanishes, and the statement, which says
    nothing of the quantity, is decided there.
    """

    SIGN = "a change of sign"
    ZERO = "a common zero"
    NONZERO = "a value other than zero"
    STRATUM = "a failure where ranks drop"


@dataclass(frozen=True)
class Family:
    """A family of subjects with parameters in a box.

    `box` has the bounds of each parameter; inside, `at` gives a subject that meets the hypotheses, or fails the exact test for them.

    `at` takes floats or Fractions and uses nothing but field operations, so that both see the same subject. `order`: the parameters along
    which zeros are sought, those first in which the quantity has the least degree; all where it is empty.
    """

    words: str
    box: tuple[tuple[float, float], ...]
    at: Callable[[Any], Any]
    order: tuple[int, ...] = ()


@dataclass(frozen=True)
class Witness:
    """A counterexample. `point` are the parameters; `certificates` were accepted by the checker."""

    words: str
    point: Point
    certificates: tuple[Certificate, ...]


@dataclass(frozen=True)
class Block:
    """Equations that are affine in some of the parameters once the others are fixed: exact values, and the places of these parameters."""

    equations: Callable[[Point], Sequence[Fraction]]
    places: tuple[int, ...]


@dataclass(frozen=True)
class Attack:
    """One attack on one statement.

    `target` is "claim.reading", "without ABLATION: HYPOTHESIS", or a statement withdrawn; `name` tells attacks on one target apart.

    `quantity` of the aim SIGN and NONZERO is one number, of ZERO a vector; `measured` says in words what it is and what it is compared
    with. `exact` is the same up to a positive factor, exactly, for SIGN and STRATUM; `blocks` are solved in turn for the aim ZERO. `decide`
    certifies: a Witness where the point is a counterexample, None where it is not.
    """

    target: str
    name: str
    aim: Aim
    measured: str
    family: Family
    quantity: Callable[[Floats], float | Floats]
    decide: Callable[[Point], Witness | None]
    exact: Callable[[Point], Fraction] | None = None
    blocks: tuple[Block, ...] = ()
    starts: int = 12

    @property
    def id(self) -> str:
        """The name that it has in the file of results."""
        return f"{self.target} by {self.name}"


@dataclass(frozen=True)
class Trial:
    """How an attack ended.

    `nearest` is the least absolute value seen (of NONZERO: the largest), at `point`. `bracket`: two exact points of the family whose
    quantities have opposite signs, where no rational zero between them was found. `decided` counts exact decisions.
    """

    attack: Attack
    starts: int
    evaluations: int
    decided: int
    seconds: float
    nearest: float
    point: tuple[float, ...]
    witness: Witness | None
    bracket: tuple[Point, Point] | None


@dataclass(frozen=True)
class Attacked:
    """A stored attack as a run shows it. `refutes`: its counterexample, or its change of sign, was confirmed now. `trouble`: it is
    out of date, where it is `stale`, or what is stored was not found again; None otherwise."""

    id: str
    words: str
    refutes: bool
    trouble: str | None
    stale: bool = False

    def to_json(self) -> dict[str, object]:
        """Return the object in `verify --json`."""
        return {"attack": self.id, "words": self.words, "refutes": self.refutes, "trouble": self.trouble}
