"""What is asked of one system alone, exactly and found once, and the same of many integer systems at a first look.

Facets        observable, controllable, left-invertible, stable, normal rank, lag, number of unobservable modes
facets        those of a system
degenerate    why a system would be a poor witness; "" where it would not
poor          which of many integer systems would be so
of_system     the hypotheses about one system, of subjects that have one
nilpotent     which of many integer systems have a stable A
flags         which of many systems meet all of some hypotheses about one system
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeVar

import numpy as np

from ...exact.algebra.fields import PrimeField
from ...exact.algebra.matrices import rank, stacked
from ...exact.algebra.stability import is_stable
from ...exact.system.systems import ResidualSystem
from ...exact.system.windows import observability_matrix, reachability_matrix
from ..evidence.kept_kernels import kernel_once
from ..evidence.search import Facts, Flags, ranks

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
    unobservable_modes: int


@lru_cache(maxsize=1 << 18)
def facets(system: ResidualSystem) -> Facets:
    """What the hypotheses ask of a system, found once."""
    kernel = kernel_once(system)
    seen = rank(observability_matrix(system, system.n))
    return Facets(
        observable=seen == system.n,
        controllable=rank(reachability_matrix(system)) == system.n,
        left_invertible=kernel.normal_rank == system.m,
        stable=isinstance(system.field, PrimeField) or is_stable(system.A),
        normal_rank=kernel.normal_rank,
        lag=kernel.lag,
        unobservable_modes=system.n - seen,
    )


@lru_cache(maxsize=1 << 18)
def degenerate(system: ResidualSystem) -> str:
    """Why a counterexample made of this system says little: it fails for want of a state, an output or a fault that does something."""
    reasons = {
        "there is no state": system.n == 0,
        "there is no output": system.p == 0,
        "there is no fault": system.m == 0,
        "C = 0": system.C.is_zero(),
        "F = 0": system.F.is_zero(),
        "the columns of [F; G] are dependent": rank(stacked(system.F, system.G)) < system.m,
    }
    return ", ".join(reason for reason, so in reasons.items() if so)


def of_system(system: Callable[[S], ResidualSystem]) -> dict[str, Callable[[S], bool]]:
    """The hypotheses about one system, of subjects that have one: the names are those of `flags`."""
    return {
        "observable": lambda subject: facets(system(subject)).observable,
        "controllable": lambda subject: facets(system(subject)).controllable,
        "left-invertible": lambda subject: facets(system(subject)).left_invertible,
        "A stable": lambda subject: facets(system(subject)).stable,
    }


def poor(facts: Facts) -> Flags:
    """Whether `degenerate` has something to say of them, where there are states, outputs and faults."""
    columns = np.concatenate([facts.F, facts.G], axis=1)
    return np.asarray(~facts.C.any(axis=(1, 2)) | ~facts.F.any(axis=(1, 2)) | (ranks(columns) < facts.m))


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
