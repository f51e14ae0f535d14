"""Vectors: exact systems, data and answers, with the bounds that rounding allows; JSON that any language can read.

    IdentificationVector   A, B, C, D, x0, u, y over Q; Markov parameters, characteristic polynomial, transfer function
    FaultVector            A, F, C, G, x0, v, r over Q; window ranks, n_v, fault space; certified singular-value gaps
    StructureVector        A, F, C, G in dyadic rationals, so that their floats are exact; normal rank, zeros, left-invertibility
    ConsistencyVector      an experiment, a recipe for its record, the pole and what past outputs as instruments make of it
    shipped                the vectors of one kind that come with the package
    documents              all files, name -> JSON document, made anew
    floats                 a rational matrix correctly rounded (to nearest, ties to even): the stated rounding
    main                   `python -m faultspace.numeric.audit.vectors --out DIR` writes the files; never edit them by hand

Rationals are strings "p/q" as in every exact file; bounds are floats.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from faultspace.exact.matrices import Matrix
from faultspace.exact.signals import simulate
from faultspace.exact.systems import ResidualSystem

Array = NDArray[np.float64]
FORMAT = "faultspace-audit-vectors/1"
ROUNDING = "each rational to the nearest IEEE binary64, ties to even, once"
POINTS = (1, -1, 2)  # where transfer functions are compared: floats, and no pole of a stable model
KINDS = ("identification", "faults", "structure", "consistency")


def matrix(rows: Sequence[Sequence[Any]], width: int) -> Matrix:
    """Over Q, from strings, integers or Fractions; `width` for matrices without rows."""
    return Matrix.of([[str(entry) for entry in row] for row in rows], shape=(len(rows), width))


def fractions(given: Matrix) -> list[list[Fraction]]:
    """The entries as Fractions."""
    return [[Fraction(int(x.p), int(x.q)) for x in row] for row in given.elements()]


def floats(given: Matrix) -> Array:
    """Each entry correctly rounded; a new array at every call."""
    return np.array([[float(x) for x in row] for row in fractions(given)], dtype=np.float64).reshape(given.shape)


def scaled(given: Matrix, factors: Sequence[Fraction]) -> Matrix:
    """Column j times factors[j]."""
    return matrix([[x * f for x, f in zip(row, factors, strict=True)] for row in fractions(given)], given.ncols)


@dataclass(frozen=True, eq=False)
class IdentificationVector:
    """x(k+1) = A x + B u, y = C x + D u from x0, exactly; `bounds` for an order-`order` model from `block_rows` block rows.

    bounds: "markov" (2 n + 2, p, n_u), "characteristic_polynomial" (n,) for z^(n-1), ..., 1, "transfer" (points, p, n_u), "poles" (n,)
    in the order of `poles`.
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

    @property
    def order(self) -> int:
        """Number of states."""
        return self.A.nrows

    @cached_property
    def y(self) -> Matrix:
        """The exact outputs (N, p)."""
        return simulate(ResidualSystem(self.A, self.B, self.C, self.D), self.x0, self.u).residuals

    def bound(self, name: str) -> Array:
        """The bounds of that name as an array."""
        return np.array(self.bounds[name], dtype=float)

    def to_json(self) -> dict[str, Any]:
        """With the exact outputs and answers spelt out for other languages."""
        from .exact_comparison import characteristic_polynomial, markov, poles, transfer

        parts: dict[str, Any] = {name: getattr(self, name).to_json() for name in ("A", "B", "C", "D", "x0", "u", "y")}
        expected = {
            "markov": [part.to_json() for part in markov(self.A, self.B, self.C, self.D, 2 * self.order + 2)],
            "characteristic_polynomial": [str(c) for c in characteristic_polynomial(self.A)],
            "transfer": [{"z": z, "value": transfer(self.A, self.B, self.C, self.D, z).to_json()} for z in POINTS],
            "poles": [[z.real, z.imag] for z in poles(self.A)],
        }
        head = {"slug": self.slug, "order": self.order, "block_rows": self.block_rows}
        return {**head, **parts, "expected": expected, "bounds": dict(self.bounds)}

    @staticmethod
    def from_json(data: Mapping[str, Any]) -> IdentificationVector:
        """The vector that `to_json` wrote; outputs and answers are computed again from the system."""
        n, n_u = data["order"], len(data["u"][0])
        width = {"A": n, "B": n_u, "C": n, "D": n_u, "x0": 1, "u": n_u}
        parts = {name: matrix(data[name], columns) for name, columns in width.items()}
        return IdentificationVector(data["slug"], **parts, block_rows=data["block_rows"], bounds=data["bounds"])


@dataclass(frozen=True, eq=False)
class FaultVector:
    """A residual r of x(k+1) = A x + F v, r = C x + G v from x0, exactly; `space`: basis columns [f; g] (n + p, n_z) of all solutions.

    ranks: of R_1, R_2, ... over all columns of each. gaps: (certified lower bound on the least nonzero, upper on the largest singular
    value of R_s). bounds: "residual" on |r - exact r| of the fitted residual, "space" on the sine of the angle to `space`, "signal" on
    |v - exact v| on the first `trusted` samples (None: not to be asked).
    """

    slug: str
    system: ResidualSystem
    x0: Matrix
    v: Matrix
    ranks: tuple[int, ...]
    gaps: tuple[tuple[float, float], ...]
    n_v: int
    space: Matrix
    trusted: int
    bounds: Mapping[str, float | None]

    @cached_property
    def r(self) -> Matrix:
        """The exact residual (N, p)."""
        return simulate(self.system, self.x0, self.v).residuals

    def to_json(self) -> dict[str, Any]:
        """With the exact residual spelt out."""
        return {
            "slug": self.slug,
            "system": self.system.to_json(),
            **{name: getattr(self, name).to_json() for name in ("x0", "v", "r")},
            "expected": {"window_ranks": list(self.ranks), "n_v": self.n_v, "fault_space": self.space.to_json(), "trusted": self.trusted},
            "singular_values": [{"least_nonzero_above": low, "largest_below": high} for low, high in self.gaps],
            "bounds": dict(self.bounds),
        }

    @staticmethod
    def from_json(data: Mapping[str, Any]) -> FaultVector:
        """The vector that `to_json` wrote; the residual is computed again."""
        known = data["expected"]
        system = ResidualSystem.of(*(data["system"][name] for name in "AFCG"))
        return FaultVector(
            data["slug"],
            system,
            matrix(data["x0"], 1),
            matrix(data["v"], system.m),
            tuple(known["window_ranks"]),
            tuple((one["least_nonzero_above"], one["largest_below"]) for one in data["singular_values"]),
            known["n_v"],
            matrix(known["fault_space"], len(known["fault_space"][0])),
            known["trusted"],
            data["bounds"],
        )


@dataclass(frozen=True, eq=False)
class StructureVector:
    """zeros: the finite invariant zeros, correct to rounding, with `zero_bounds` for each; not asked for where not left-invertible."""

    slug: str
    system: ResidualSystem
    normal_rank: int
    zeros: tuple[complex, ...]
    zero_bounds: tuple[float, ...]
    infinite_zero_orders: tuple[int, ...]

    @property
    def left_invertible(self) -> bool:
        """Whether the normal rank is m."""
        return self.normal_rank == self.system.m

    def to_json(self) -> dict[str, Any]:
        """JSON-ready."""
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
        """The vector that `to_json` wrote."""
        known = data["expected"]
        return StructureVector(
            data["slug"],
            ResidualSystem.of(*(data["system"][name] for name in "AFCG")),
            known["normal_rank"],
            tuple(complex(*z) for z in known["finite_zeros"]),
            tuple(data["bounds"]["finite_zeros"]),
            tuple(known["infinite_zero_orders"]),
        )


@dataclass(frozen=True, eq=False)
class ConsistencyVector:
    """A first-order system x(k+1) = a x + u + v, y = x with u white and v(k) = c v(k-1) + e(k), both independent.

    u and e are the signs of `signs` (`samples` of each, u first). pole: a. biased_pole: that of the first left singular vector of the
    exact limit with past outputs as instruments, `block_rows` = past rows = s. The bound is half their distance: which of the two is
    nearer?
    """

    slug: str
    a: Fraction
    c: Fraction
    block_rows: int
    samples: int
    seed: int
    biased_pole: float

    @property
    def bound(self) -> float:
        """Half the bias."""
        return abs(self.biased_pole - float(self.a)) / 2

    def record(self) -> tuple[Array, Array]:
        """(y, u), each (samples, 1)."""
        drawn = signs(self.seed, 2 * self.samples)
        u, e = drawn[: self.samples], drawn[self.samples :]
        y, x, v = np.empty(self.samples), 0.0, 0.0
        for k in range(self.samples):
            v = float(self.c) * v + e[k]
            y[k] = x
            x = float(self.a) * x + u[k] + v
        return y[:, np.newaxis], u[:, np.newaxis]

    def to_json(self) -> dict[str, Any]:
        """JSON-ready."""
        names = ("slug", "block_rows", "samples", "seed", "biased_pole", "bound")
        return {"a": str(self.a), "c": str(self.c)} | {name: getattr(self, name) for name in names}

    @staticmethod
    def from_json(data: Mapping[str, Any]) -> ConsistencyVector:
        """The vector that `to_json` wrote."""
        numbers = {name: data[name] for name in ("slug", "block_rows", "samples", "seed", "biased_pole")}
        return ConsistencyVector(a=Fraction(data["a"]), c=Fraction(data["c"]), **numbers)


def signs(seed: int, count: int) -> Array:
    """+-1 by bit 63 of the linear congruential generator x := 6364136223846793005 x + 1442695040888963407 mod 2^64 from `seed`."""
    state, result = seed, np.empty(count)
    for k in range(count):
        state = (6364136223846793005 * state + 1442695040888963407) % 2**64
        result[k] = 1.0 if state >> 63 else -1.0
    return result


_READERS: dict[str, Any] = {
    "identification": IdentificationVector.from_json,
    "faults": FaultVector.from_json,
    "structure": StructureVector.from_json,
    "consistency": ConsistencyVector.from_json,
}


@cache
def shipped(kind: str) -> tuple[Any, ...]:
    """The vectors of one of KINDS that come with the package, as the class of that kind."""
    text = files("faultspace.numeric.audit").joinpath(f"data/{kind}.json").read_text("utf-8")
    document = json.loads(text)
    if document["format"] != FORMAT:
        raise ValueError(f"{kind}.json has format {document['format']!r}, this program reads {FORMAT!r}")
    return tuple(_READERS[kind](one) for one in document["vectors"])


def documents() -> dict[str, dict[str, Any]]:
    """File name -> document, computed anew by the exact branch."""
    from .making_vectors import MAKERS

    return {
        f"{kind}.json": {"format": FORMAT, "kind": kind, "rounding": ROUNDING, "vectors": [one.to_json() for one in MAKERS[kind]()]}
        for kind in KINDS
    }


def written(document: Mapping[str, Any]) -> str:
    """One vector a line."""
    head = {name: value for name, value in document.items() if name != "vectors"}
    lines = ",\n".join(json.dumps(one) for one in document["vectors"])
    return f'{json.dumps(head)[:-1]}, "vectors": [\n{lines}\n]}}\n'


def main(arguments: Sequence[str] | None = None) -> int:
    """Writes all files; returns 0."""
    parser = argparse.ArgumentParser(prog="python -m faultspace.numeric.audit.vectors", description="Make the audit's vectors.")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder for the files, made if it is not there")
    out: Path = parser.parse_args(arguments).out
    texts = {name: written(document) for name, document in documents().items()}
    out.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        (out / name).write_text(text, "utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
