"""Vectors of long records: the recipe is kept, not the samples, and any language can follow it.

    ConsistencyVector   a coloured fault beside a white input; the poles, and what past outputs as instruments make of them
    NoisyVector         a residual and white noise; certified: the least singular value of the one, the size of the other

Signals are signs of `rationals.signs`, so that a record differs between machines by rounding alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
import scipy  # its folders are loaded when they are first used

from faultspace.exact.system.systems import FaultySystem, ResidualSystem

from ....base.arrays import Array
from ...method.model.models import StateSpaceModel
from .exact_comparison import matched, poles
from .rationals import floats, matrix, residual_system, signs


def _complexes(values: tuple[complex, ...]) -> list[list[float]]:
    return [[z.real, z.imag] for z in values]


@dataclass(frozen=True, eq=False)
class ConsistencyVector:
    """This is a system from rest with u white and one fault v(k) = c v(k-1) + e(k), both independent.

    The first n_u `samples` signs are the channels of u one after the other, the next are e. biased_poles: those of the first left singular
    vectors of the exact limit with past outputs as instruments, `block_rows` = past rows. The bound is half the largest distance of a pole
    from its biased one: which of the two models is nearer?
    """

    slug: str
    system: FaultySystem
    c: Fraction
    block_rows: int
    samples: int
    seed: int
    biased_poles: tuple[complex, ...]

    @property
    def poles(self) -> tuple[complex, ...]:
        """These are the poles of the system."""
        return poles(self.system.residual.A)

    @property
    def bound(self) -> float:
        """The bound is half the bias."""
        return float(np.max(matched(self.biased_poles, self.poles)[1])) / 2

    def record(self) -> tuple[Array, Array]:
        """The pair is (y, u), of shapes (samples, p) and (samples, n_u)."""
        residual, n_u = self.system.residual, self.system.nu
        drawn = signs(self.seed, (n_u + 1) * self.samples).reshape(n_u + 1, self.samples).T
        v = scipy.signal.lfilter([1.0], [1.0, -float(self.c)], drawn[:, n_u])
        A, B, F, C, D, G = (floats(M) for M in (residual.A, self.system.B, residual.F, residual.C, self.system.D, residual.G))
        model = StateSpaceModel(A, np.hstack([B, F]), C, np.hstack([D, G]))
        u = np.ascontiguousarray(drawn[:, :n_u])
        return model.simulate(np.column_stack([u, v]), np.zeros(len(A))), u

    def to_json(self) -> dict[str, Any]:
        """The document is JSON-ready."""
        names = ("slug", "block_rows", "samples", "seed", "bound")
        found = {"poles": _complexes(self.poles), "biased_poles": _complexes(self.biased_poles)}
        return {"system": self.system.to_json(), "c": str(self.c)} | {name: getattr(self, name) for name in names} | found

    @staticmethod
    def from_json(data: Mapping[str, Any]) -> ConsistencyVector:
        """This reads the vector that `to_json` wrote."""
        parts = data["system"]
        driven = FaultySystem(residual_system(parts), *(matrix(parts[name], len(parts[name][0])) for name in "BD"))
        numbers = {name: data[name] for name in ("slug", "block_rows", "samples", "seed")}
        return ConsistencyVector(
            system=driven, c=Fraction(data["c"]), biased_poles=tuple(complex(*z) for z in data["biased_poles"]), **numbers
        )


@dataclass(frozen=True, eq=False)
class NoisyVector:
    """This is the residual of m white faults from rest, plus white noise in every output.

    The first m `samples` signs are the channels of v one after the other, the next p, times `noise`, are added to the outputs. ranks: of
    the exact R_s for s = 1, 2, ... gaps: certified, of each window (least nonzero singular value of R_s, norm of the noise's Hankel
    matrix): what noise can move a singular value by, and what it would have to.
    """

    slug: str
    system: ResidualSystem
    noise: Fraction
    samples: int
    seed: int
    ranks: tuple[int, ...]
    gaps: tuple[tuple[float, float], ...]

    def drawn(self) -> tuple[Array, Array]:
        """Return v (samples, m) and the noise's signs (samples, p)."""
        m, p = self.system.m, self.system.p
        columns = signs(self.seed, (m + p) * self.samples).reshape(m + p, self.samples).T
        return np.ascontiguousarray(columns[:, :m]), np.ascontiguousarray(columns[:, m:])

    def record(self) -> Array:
        """This is r with noise, (samples, p)."""
        v, noise = self.drawn()
        model = StateSpaceModel(*(floats(M) for M in (self.system.A, self.system.F, self.system.C, self.system.G)))
        return np.asarray(model.simulate(v, np.zeros(self.system.n)) + float(self.noise) * noise)

    def to_json(self) -> dict[str, Any]:
        """The document is JSON-ready."""
        return {
            **{name: getattr(self, name) for name in ("slug", "samples", "seed")},
            "system": self.system.to_json(),
            "noise": str(self.noise),
            "expected": {"window_ranks": list(self.ranks), "n_v": self.system.m},
            "singular_values": [{"least_nonzero_above": low, "noise_below": high} for low, high in self.gaps],
        }

    @staticmethod
    def from_json(data: Mapping[str, Any]) -> NoisyVector:
        """This reads the vector that `to_json` wrote."""
        return NoisyVector(
            data["slug"],
            residual_system(data["system"]),
            Fraction(data["noise"]),
            data["samples"],
            data["seed"],
            tuple(data["expected"]["window_ranks"]),
            tuple((one["least_nonzero_above"], one["noise_below"]) for one in data["singular_values"]),
        )
