"""This is the SYSTEM of the certificate format, read strictly, and its trajectories.

System(field, A, F, C, G)   x(k+1) = A x + F v, r = C x + G v;  .n states, .m faults, .p outputs
parse_system(json)          SYSTEM -> System; B and D are checked for their shape and dropped
write_system(system)        System -> SYSTEM
parse_matrix, parse_vector, parse_keys    pieces of the grammar that other statements need
trajectory(system, x0, v)   states x(0..N) and outputs r(0..N-1), by running the recursion
transposed(system)          A', C', F', G': rows and columns of the pencil change places
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from .fields import Element, Field, Json, parse_field, parse_index
from .linear import Matrix, column_of, matrix

MAX_DIMENSION = 512


@dataclass(frozen=True)
class System:
    """This is x(k+1) = A x(k) + F v(k), r(k) = C x(k) + G v(k), with A n x n, F n x m, C p x n, G p x m."""

    field: Field
    A: Matrix
    F: Matrix
    C: Matrix
    G: Matrix

    @property
    def n(self) -> int:
        return self.A.height

    @property
    def m(self) -> int:
        return self.F.width

    @property
    def p(self) -> int:
        return self.C.height


def parse_keys(json: Json, required: set[str], optional: frozenset[str] = frozenset()) -> dict[str, Any]:
    """The result is the JSON object when it has the required keys and none but these and the optional ones; raises ValueError."""
    if not isinstance(json, dict):
        raise ValueError(f"not a JSON object: {json!r}")
    if required - set(json):
        raise ValueError(f"keys are missing: {sorted(required - set(json))}")
    if set(json) - required - optional:
        raise ValueError(f"unknown keys: {sorted(set(json) - required - optional)}")
    return json


def parse_vector(field: Field, json: Json, length: int) -> list[Element]:
    """VECTOR of `length` entries; raises ValueError."""
    if not isinstance(json, list) or len(json) != length:
        raise ValueError(f"not a VECTOR of {length} entries: {json!r}")
    return [field.parse(entry) for entry in json]


def parse_matrix(field: Field, json: Json, height: int, width: int) -> Matrix:
    """The result is the MATRIX of that shape, where [] stands for every matrix without entries. Raises ValueError."""
    if not isinstance(json, list):
        raise ValueError(f"not a MATRIX: {json!r}")
    if height * width == 0 and json == []:
        return matrix(field, height, width, [[]] * height)
    if len(json) != height:
        raise ValueError(f"a MATRIX of {height} rows is due (got {len(json)})")
    return matrix(field, height, width, [parse_vector(field, row, width) for row in json])


def parse_system(json: Json) -> System:
    """SYSTEM -> System; raises ValueError."""
    parse_keys(json, {"A", "F", "C", "G"}, frozenset({"field", "n", "m", "p", "B", "D", "nu"}))
    # An explicit null is not an absent key.
    if "field" in json and json["field"] is None:
        raise ValueError("not a FIELD: None")
    field = parse_field(json.get("field"))
    n, m, p = (
        _dimension(json, "n", _width(json["A"])),
        _dimension(json, "m", _width(json["F"])),
        _dimension(json, "p", _height(json["C"])),
    )
    if n + m + p > MAX_DIMENSION:
        raise ValueError(f"n + m + p is at most {MAX_DIMENSION} (got {n + m + p})")
    if ("B" in json) != ("D" in json) or ("nu" in json and "B" not in json):
        raise ValueError("B and D are given together, and nu with them only")
    sizes = {"n": n, "m": m, "p": p}
    if "B" in json:
        sizes["nu"] = _dimension(json, "nu", _width(json["B"]))
        parse_matrix(field, json["B"], n, sizes["nu"])
        parse_matrix(field, json["D"], p, sizes["nu"])
    if 0 in sizes.values() and not set(sizes) <= set(json):
        raise ValueError(f"with a zero dimension {', '.join(sizes)} are required")
    return System(
        field,
        parse_matrix(field, json["A"], n, n),
        parse_matrix(field, json["F"], n, m),
        parse_matrix(field, json["C"], p, n),
        parse_matrix(field, json["G"], p, m),
    )


def write_system(system: System) -> dict[str, Json]:
    """The result is the SYSTEM with its dimensions and its field."""
    json: dict[str, Json] = {
        name: [[system.field.write(x) for x in row] for row in block.rows]
        for name, block in (("A", system.A), ("F", system.F), ("C", system.C), ("G", system.G))
    }
    json.update({"n": system.n, "m": system.m, "p": system.p, "field": system.field.to_json()})
    return json


def trajectory(system: System, x0: Sequence[Element], v: Sequence[Sequence[Element]]) -> tuple[list[Matrix], list[Matrix]]:
    """The result is the columns x(0), ..., x(N) and r(0), ..., r(N-1) from x0 under v(0), ..., v(N-1)."""
    states = [column_of(system.field, x0)]
    outputs = []
    for sample in v:
        fault = column_of(system.field, sample)
        outputs.append(system.C @ states[-1] + system.G @ fault)
        states.append(system.A @ states[-1] + system.F @ fault)
    return states, outputs


def transposed(system: System) -> System:
    """The result is the system of A', C', F', G', whose pencil is the transposed one up to signs."""
    return System(system.field, system.A.T, system.C.T, system.F.T, system.G.T)


def _dimension(json: dict[str, Json], name: str, inferred: int) -> int:
    return parse_index(json[name]) if name in json else inferred


def _height(json: Json) -> int:
    return len(json) if isinstance(json, list) else 0


def _width(json: Json) -> int:
    return len(json[0]) if isinstance(json, list) and json and isinstance(json[0], list) else 0
