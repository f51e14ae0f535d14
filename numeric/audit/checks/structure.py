"""Checks of `structure`: normal rank, left-invertibility, orders of the infinite zeros, finite zeros each within its condition."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np

from ..adapter import ZeroStructure
from ..records import Broken, Check, Function, Measurement, NotOffered, Severity, Sides
from ..vectors.exact_comparison import matched
from ..vectors.rationals import floats
from ..vectors.shipped_vectors import StructureVector, shipped


def checks() -> Iterator[Check]:
    """This yields all checks of the module."""
    for vector in shipped("structure"):
        yield from of_vector(vector)


def of_vector(vector: StructureVector) -> Iterator[Check]:
    """Yield the three checks of a vector, that of finite zeros where it is left-invertible or has some."""
    effect = "independent faults are taken for dependent or the reverse"
    yield _check("normal-rank", vector, "proposition-3", effect, _ranks, "normal_rank", "left_invertible")
    effect = "wrong delays, wrong n_v + zeta: the fault space has another dimension than told"
    yield _check("infinite-zeros", vector, "theorem-2", effect, _infinite, "infinite_zero_orders")
    if vector.left_invertible or vector.zeros:
        effect = "faults that no output shows are missed, or seen where there are none"
        yield _check("finite-zeros", vector, "window-ranks", effect, _finite, "finite_zeros")


def _check(slug: str, vector: StructureVector, claim: str, effect: str, compare: Any, *names: str) -> Check:
    def measure(function: Function) -> Iterator[Measurement]:
        system = vector.system
        answer = function(*(floats(M) for M in (system.A, system.F, system.C, system.G)))
        yield from compare(_structure(answer, names), vector)

    return Check(slug, "structure", vector.slug, claim, effect, Severity.SILENT, measure)


def _structure(answer: ZeroStructure | Mapping[str, Any], names: Sequence[str]) -> Any:
    """Return something with these attributes. Of a mapping that lacks one of them the check does not ask."""
    if not isinstance(answer, Mapping):
        return answer
    lacking = [name for name in names if name not in answer]
    if lacking:
        raise NotOffered(f"the answer has no {', '.join(lacking)}")
    return SimpleNamespace(**answer)


def _ranks(found: ZeroStructure, vector: StructureVector) -> Iterator[Measurement]:
    rank, invertible = found.normal_rank, bool(found.left_invertible)
    yield Measurement("normal rank", float(abs(rank - vector.normal_rank)), 0.0, Sides("normal_rank", rank, vector.normal_rank))
    sides = Sides("left_invertible", invertible, vector.left_invertible)
    yield Measurement("left invertible", float(invertible != vector.left_invertible), 0.0, sides)


def _infinite(found: ZeroStructure, vector: StructureVector) -> Iterator[Measurement]:
    got, due = sorted(found.infinite_zero_orders), vector.infinite_zero_orders
    sides = Sides("infinite_zero_orders", list(got), list(due))
    yield Measurement("number of orders", float(abs(len(got) - len(due))), 0.0, sides)
    if len(got) == len(due):
        yield Measurement("orders of infinite zeros", float(sum(abs(a - b) for a, b in zip(got, due, strict=True))), 0.0, sides)


def zeros_off(vector: StructureVector, function: Function) -> Iterator[Measurement]:
    """Compare the finite zeros that the function finds with those of the vector."""
    system = vector.system
    answer = function(*(floats(M) for M in (system.A, system.F, system.C, system.G)))
    yield from _finite(_structure(answer, ["finite_zeros"]), vector)


def _finite(found: ZeroStructure, vector: StructureVector) -> Iterator[Measurement]:
    try:
        got = [complex(z) for z in found.finite_zeros]
    except TypeError:
        raise Broken("finite_zeros is no list of numbers") from None
    sides = Sides("finite_zeros", got, list(vector.zeros), list(vector.zero_bounds))
    yield Measurement("number of finite zeros", float(abs(len(got) - len(vector.zeros))), 0.0, sides)
    if len(got) == len(vector.zeros) and got:
        places, off = matched(got, vector.zeros)
        worst = int(np.argmax(off / np.array(vector.zero_bounds)))
        sides = replace(sides, answer=[got[j] for j in places], place=(worst,))
        yield Measurement("finite zeros", float(off[worst]), vector.zero_bounds[worst], sides)
