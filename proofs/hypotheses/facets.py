"""What is asked of one system alone, exactly and found once, and the same of many integer systems in the language of claims.

Facets        observable, controllable, left-invertible, stable, normal rank, lag
facets        those of a system
degenerate    why a system would be a poor witness; "" where it would not
POOR          an expression that says so of systems with states, outputs and faults
of_system     the hypotheses about one system, of subjects that have one
MODEL         the hypotheses about one system as expressions of the language, for integer systems
expressions   those of some hypotheses
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeVar

from ...exact.algebra.fields import PrimeField
from ...exact.algebra.matrices import rank, stacked
from ...exact.algebra.stability import is_stable
from ...exact.system.systems import ResidualSystem
from ...exact.system.windows import observability_matrix, reachability_matrix
from ..evidence.kept_kernels import kernel_once

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
    """Return what the hypotheses ask of a system, found once."""
    kernel = kernel_once(system)
    return Facets(
        observable=rank(observability_matrix(system, system.n)) == system.n,
        controllable=rank(reachability_matrix(system)) == system.n,
        left_invertible=kernel.normal_rank == system.m,
        stable=isinstance(system.field, PrimeField) or is_stable(system.A),
        normal_rank=kernel.normal_rank,
        lag=kernel.lag,
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


# An integer matrix is Schur stable iff it is nilpotent: its characteristic polynomial is monic with integer coefficients.
MODEL = {"observable": "observable", "controllable": "controllable", "left-invertible": "left_invertible", "A stable": "nilpotent(A)"}
POOR = "is_zero(C) or is_zero(F) or rank(vstack(F, G)) < m"


def expressions(kept: Collection[str], prefix: str = "") -> tuple[str, ...]:
    """Return the expressions of those of the hypotheses that are about one system: their names are the keys of MODEL after a prefix."""
    return tuple(text for name, text in MODEL.items() if prefix + name in kept)
