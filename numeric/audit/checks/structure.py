"""Checks of `structure`: normal rank, left-invertibility, orders of the infinite zeros, finite zeros each within its condition."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np

from ..adapter import ZeroStructure
from ..records import Broken, Check, Function, Measurement, NotOffered, Severity
from ..vectors.exact_comparison import matched
from ..vectors.shipped_vectors import StructureVector, floats, shipped


def checks() -> Iterator[Check]:
    """This yields all checks of the module."""
    for vector in shipped("structure"):
        effect = "independent faults are taken for dependent or the reverse"
        yield _check("normal-rank", vector, "proposition-3", effect, _ranks, "normal_rank", "left_invertible")
        effect = "wrong delays, wrong n_v + zeta: the fault space has another dimension than told"
        yield _check("infinite-zeros", vector, "theorem-2", effect, _infinite, "infinite_zero_orders")
        if vector.left_invertible:
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
    yield Measurement("normal rank", float(abs(found.normal_rank - vector.normal_rank)), 0.0)
    yield Measurement("left invertible", float(bool(found.left_invertible) != vector.left_invertible), 0.0)


def _infinite(found: ZeroStructure, vector: StructureVector) -> Iterator[Measurement]:
    got, due = sorted(found.infinite_zero_orders), vector.infinite_zero_orders
    yield Measurement("number of orders", float(abs(len(got) - len(due))), 0.0)
    if len(got) == len(due):
        yield Measurement("orders of infinite zeros", float(sum(abs(a - b) for a, b in zip(got, due, strict=True))), 0.0)


def _finite(found: ZeroStructure, vector: StructureVector) -> Iterator[Measurement]:
    try:
        got = [complex(z) for z in found.finite_zeros]
    except TypeError:
        raise Broken("finite_zeros is no list of numbers") from None
    yield Measurement("number of finite zeros", float(abs(len(got) - len(vector.zeros))), 0.0)
    if len(got) == len(vector.zeros) and got:
        off = matched(got, vector.zeros)[1]
        worst = int(np.argmax(off / np.array(vector.zero_bounds)))
        yield Measurement("finite zeros", float(off[worst]), vector.zero_bounds[worst])
