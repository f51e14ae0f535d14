"""What is asked of one system alone, exactly and found once, and the same of many integer systems at a first look.

    Facets   observable, controllable, left-invertible, stable, normal rank, lag
    facets   those of a system
    of_system   the hypotheses about one system, of subjects that have one
    flags    which of many systems meet all of some hypotheses about one system
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeVar

import numpy as np

from ...exact.fields import PrimeField
from ...exact.kernel_representation import kernel_representation
from ...exact.matrices import rank
from ...exact.stability import is_stable
from ...exact.systems import ResidualSystem
from ...exact.windows import observability_matrix, reachability_matrix
from ..search import Facts, Flags

S = TypeVar("S")


@dataclass(frozen=True)
class Facets:
    """A finite field has no unit circle: over one, every A counts as stable."""

    observable: bool
    controllable: bool
    left_invertible: bool
    stable: bool
    normal_rank: int
    lag: int


@lru_cache(maxsize=1 << 18)
def facets(system: ResidualSystem) -> Facets:
    """What is asked of the system."""
    kernel = kernel_representation(system)
    return Facets(
        observable=rank(observability_matrix(system, system.n)) == system.n,
        controllable=rank(reachability_matrix(system)) == system.n,
        left_invertible=kernel.normal_rank == system.m,
        stable=isinstance(system.field, PrimeField) or is_stable(system.A),
        normal_rank=kernel.normal_rank,
        lag=kernel.lag,
    )


def of_system(system: Callable[[S], ResidualSystem]) -> dict[str, Callable[[S], bool]]:
    """The hypotheses about one system, of subjects that have one: the names are those of `flags`."""
    return {
        "observable": lambda subject: facets(system(subject)).observable,
        "controllable": lambda subject: facets(system(subject)).controllable,
        "left-invertible": lambda subject: facets(system(subject)).left_invertible,
        "A stable": lambda subject: facets(system(subject)).stable,
    }


def nilpotent(facts: Facts) -> Flags:
    """An integer matrix is Schur stable iff it is nilpotent: its characteristic polynomial is monic with integer coefficients."""
    return np.asarray(~np.linalg.matrix_power(facts.A, facts.n).any(axis=(1, 2)))


_LOOKS: dict[str, Callable[[Facts], Flags]] = {
    "observable": lambda f: f.observable,
    "controllable": lambda f: f.controllable,
    "left-invertible": lambda f: f.left_invertible,
    "A stable": nilpotent,
}


def flags(kept: Collection[str], prefix: str = "") -> Callable[[Facts], Flags]:
    """The systems that meet those of the hypotheses that are about one system: their names are the keys of _LOOKS after a prefix."""

    def test(facts: Facts) -> Flags:
        found = np.full(len(facts.A), True)
        for name, look in _LOOKS.items():
            if prefix + name in kept and found.any():
                found &= look(facts)
        return found

    return test
