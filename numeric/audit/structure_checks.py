"""Checks of `structure`: normal rank, left-invertibility, orders of the infinite zeros, finite zeros each within its condition."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from .adapter import Structure
from .exact_comparison import matched
from .records import Broken, Check, Function, Measurement, Severity
from .vectors import StructureVector, floats, shipped


def checks() -> Iterator[Check]:
    """All of this module."""
    for vector in shipped("structure"):
        yield _check("normal-rank", vector, "proposition-3", "independent faults are taken for dependent or the reverse", _ranks)
        effect = "wrong delays, wrong n_v + zeta: the fault space has another dimension than told"
        yield _check("infinite-zeros", vector, "theorem-2", effect, _infinite)
        if vector.left_invertible:
            effect = "faults that no output shows are missed, or seen where there are none"
            yield _check("finite-zeros", vector, "window-ranks", effect, _finite)


def _check(slug: str, vector: StructureVector, claim: str, effect: str, compare: Any) -> Check:
    def measure(function: Function) -> Iterator[Measurement]:
        system = vector.system
        answer = function(*(floats(M) for M in (system.A, system.F, system.C, system.G)))
        yield from compare(_structure(answer), vector)

    return Check(slug, "structure", vector.slug, claim, effect, Severity.SILENT, measure)


def _structure(answer: Structure | Mapping[str, Any]) -> Structure:
    try:
        return Structure(**answer) if isinstance(answer, Mapping) else answer
    except TypeError as error:
        raise Broken(f"structure: {error}") from None


def _ranks(found: Structure, vector: StructureVector) -> Iterator[Measurement]:
    yield Measurement("normal rank", float(abs(found.normal_rank - vector.normal_rank)), 0.0)
    yield Measurement("left invertible", float(bool(found.left_invertible) != vector.left_invertible), 0.0)


def _infinite(found: Structure, vector: StructureVector) -> Iterator[Measurement]:
    got, due = sorted(found.infinite_zero_orders), vector.infinite_zero_orders
    yield Measurement("number of orders", float(abs(len(got) - len(due))), 0.0)
    if len(got) == len(due):
        yield Measurement("orders of infinite zeros", float(sum(abs(a - b) for a, b in zip(got, due, strict=True))), 0.0)


def _finite(found: Structure, vector: StructureVector) -> Iterator[Measurement]:
    try:
        got = [complex(z) for z in found.finite_zeros]
    except TypeError:
        raise Broken("finite_zeros is no list of numbers") from None
    yield Measurement("number of finite zeros", float(abs(len(got) - len(vector.zeros))), 0.0)
    if len(got) == len(vector.zeros) and got:
        off = matched(got, vector.zeros)[1]
        worst = int(np.argmax(off / np.array(vector.zero_bounds)))
        yield Measurement("finite zeros", float(off[worst]), vector.zero_bounds[worst])
