"""Vectors: exact systems, data and answers, with the bounds that rounding allows; JSON that any language can read.

    IdentificationVector   A, B, C, D, x0, u, y over Q; Markov parameters, characteristic polynomial, transfer function
    StructureVector        A, F, C, G in dyadic rationals, so that their floats are exact; normal rank, zeros, left-invertibility
    FaultVector, UnexcitingVector        see `fault_vectors`
    ConsistencyVector, NoisyVector       see `recipe_vectors`
    shipped                the vectors of one kind that come with the package

`python -m faultspace.numeric.audit.making --out DIR` writes the files anew; they are never edited by hand.
Rationals are strings "p/q" as in every exact file; bounds are floats.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from importlib.resources import files
from typing import Any

import numpy as np

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.structure.signals import simulate
from faultspace.exact.system.systems import ResidualSystem

from ....base.arrays import Array
from .fault_vectors import FaultVector, UnexcitingVector
from .rationals import matrix, residual_system
from .recipe_vectors import ConsistencyVector, NoisyVector

FORMAT = "faultspace-audit-vectors/1"
POINTS = (1, -1, 2)  # where transfer functions are compared: floats, and no pole of a stable model


@dataclass(frozen=True, eq=False)
class IdentificationVector:
    """This is x(k+1) = A x + B u, y = C x + D u from x0, exactly; `bounds` for an order-`order` model from `block_rows` block rows.

    bounds: "markov" (2 n + 2, p, n_u), "characteristic_polynomial" (n,) for z^(n-1), ..., 1, "transfer" (points, p, n_u), "poles" (n,)
    in the order of `poles`; None for what is not asked. parts: slug -> (first, last, bounds of the same names) for the record cut to
    samples first .. last - 1.
    """

    slug: str
    A: Matrix
    B: Matrix
    C: Matrix
    D: Matrix
    x0: Matrix
    u: Matrix
    block_rows: int
    bounds: Mapping[str, Any]
    parts: Mapping[str, tuple[int, int, Mapping[str, Any]]] = field(default_factory=dict)

    @property
    def order(self) -> int:
        """The order is the number of states."""
        return self.A.nrows

    @cached_property
    def y(self) -> Matrix:
        """These are the exact outputs (N, p)."""
        return simulate(ResidualSystem(self.A, self.B, self.C, self.D), self.x0, self.u).residuals

    def bound(self, name: str, part: str | None = None) -> Array:
        """Return the bounds of that name as an array, for the whole record or a part of it."""
        return np.array(self.bounds[name] if part is None else self.parts[part][2][name], dtype=float)

    def asked(self, name: str, part: str | None = None) -> bool:
        """Say whether the quantity of that name is asked: it is not where rounding may make anything of it, and has no bound then."""
        return (self.bounds if part is None else self.parts[part][2])[name] is not None

    def to_json(self) -> dict[str, Any]:
        """Return the vector in JSON, with the exact outputs and answers spelt out for other languages."""
        from .exact_comparison import markov, poles, polynomial_from_the_top, transfer

        parts: dict[str, Any] = {name: getattr(self, name).to_json() for name in ("A", "B", "C", "D", "x0", "u", "y")}
        expected = {
            "markov": [part.to_json() for part in markov(self.A, self.B, self.C, self.D, 2 * self.order + 2)],
            "characteristic_polynomial": [str(c) for c in polynomial_from_the_top(self.A)],
            "transfer": [{"z": z, "value": transfer(self.A, self.B, self.C, self.D, z).to_json()} for z in POINTS],
            "poles": [[z.real, z.imag] for z in poles(self.A)],
        }
        head = {"slug": self.slug, "order": self.order, "block_rows": self.block_rows}
        cut = [{"slug": slug, "samples": [first, last], "bounds": dict(bounds)} for slug, (first, last, bounds) in self.parts.items()]
        return {**head, **parts, "expected": expected, "bounds": dict(self.bounds), "parts": cut}

    @staticmethod
    def from_json(data: Mapping[str, Any]) -> IdentificationVector:
        """Return the vector that `to_json` wrote; outputs and answers are computed again from the system."""
        n, n_u = data["order"], len(data["u"][0])
        width = {"A": n, "B": n_u, "C": n, "D": n_u, "x0": 1, "u": n_u}
        parts = {name: matrix(data[name], columns) for name, columns in width.items()}
        cut = {one["slug"]: (*one["samples"], one["bounds"]) for one in data["parts"]}
        return IdentificationVector(data["slug"], **parts, block_rows=data["block_rows"], bounds=data["bounds"], parts=cut)


@dataclass(frozen=True, eq=False)
class StructureVector:
    """This is a system with its structure. zeros: the finite invariant zeros, correct to rounding, with `zero_bounds` for each; not asked
    for where not left-invertible.
    """

    slug: str
    system: ResidualSystem
    normal_rank: int
    zeros: tuple[complex, ...]
    zero_bounds: tuple[float, ...]
    infinite_zero_orders: tuple[int, ...]

    @property
    def left_invertible(self) -> bool:
        """It is left-invertible where the normal rank is m."""
        return self.normal_rank == self.system.m

    def to_json(self) -> dict[str, Any]:
        """The document is JSON-ready."""
        expected = {
            "normal_rank": self.normal_rank,
            "finite_zeros": [[z.real, z.imag] for z in self.zeros],
            "infinite_zero_orders": list(self.infinite_zero_orders),
            "left_invertible": self.left_invertible,
        }
        bounds = {"finite_zeros": list(self.zero_bounds)}
        return {"slug": self.slug, "system": self.system.to_json(), "expected": expected, "bounds": bounds}

    @staticmethod
    def from_json(data: Mapping[str, Any]) -> StructureVector:
        """This reads the vector that `to_json` wrote."""
        known = data["expected"]
        return StructureVector(
            data["slug"],
            residual_system(data["system"]),
            known["normal_rank"],
            tuple(complex(*z) for z in known["finite_zeros"]),
            tuple(data["bounds"]["finite_zeros"]),
            tuple(known["infinite_zero_orders"]),
        )


_READERS: dict[str, Any] = {
    "identification": IdentificationVector.from_json,
    "faults": FaultVector.from_json,
    "unexciting": UnexcitingVector.from_json,
    "noisy": NoisyVector.from_json,
    "structure": StructureVector.from_json,
    "consistency": ConsistencyVector.from_json,
}
KINDS = tuple(_READERS)


@cache
def shipped(kind: str) -> tuple[Any, ...]:
    """Return the vectors of one of KINDS that come with the package, as the class of that kind."""
    text = files("faultspace.numeric.audit.vectors").joinpath(f"data/{kind}.json").read_text("utf-8")
    document = json.loads(text)
    if document["format"] != FORMAT:
        raise ValueError(f"{kind}.json has format {document['format']!r}, this program reads {FORMAT!r}")
    return tuple(_READERS[kind](one) for one in document["vectors"])
