"""Equal questions get equal answers, and the caller's arrays come back as they were."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import astuple, is_dataclass
from functools import partial
from typing import Any

import numpy as np

from ..records import Check, Function, Measurement, Refused, Severity, inside
from ..vectors.fault_vectors import with_input
from ..vectors.rationals import floats
from ..vectors.shipped_vectors import shipped


def checks() -> Iterator[Check]:
    """Yield "deterministic" and "inputs-untouched" for every function, on one vector each."""
    for function, vector, arguments in questions():
        for slug, effect, severity, measure in (
            ("deterministic", "no result can be reproduced", Severity.NUISANCE, _deterministic),
            ("inputs-untouched", "the caller's data are altered: whatever is computed next is wrong", Severity.SOMETIMES, _untouched),
        ):
            yield Check(slug, function, vector, None, effect, severity, partial(inside, measure, arguments))


def questions() -> Iterator[tuple[str, str, tuple[Any, ...]]]:
    """Yield the function, the vector and the arguments of each of these questions."""
    model, fault, system = (shipped(kind)[0] for kind in ("identification", "faults", "structure"))
    r, A, F, C, G = (floats(M) for M in (fault.r, fault.system.A, fault.system.F, fault.system.C, fault.system.G))
    y, u = (floats(M) for M in with_input(fault.r, fault.system, fault.view.scale))
    yield "identify", model.slug, (floats(model.y), floats(model.u), model.order, model.block_rows)
    yield "residual", fault.slug, (y, u, A, F, C, G)
    yield "window_ranks", fault.slug, (r, 3)
    yield "fault_dimension", fault.slug, (r,)
    yield "fault_space", fault.slug, (r, A, C, fault.n_v, len(A) + 1)
    yield "reconstruct", fault.slug, (r, A, F, C, G, floats(fault.x0).ravel())
    yield "structure", system.slug, tuple(floats(M) for M in (system.system.A, system.system.F, system.system.C, system.system.G))


def copies(arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    return tuple(one.copy() if isinstance(one, np.ndarray) else one for one in arguments)


def answered(function: Function, arguments: tuple[Any, ...]) -> Any:
    """Return the answer, None for a refusal: another question need not have one."""
    try:
        return function(*arguments)
    except Refused:
        return None


def _deterministic(arguments: tuple[Any, ...], function: Function) -> Iterator[Measurement]:
    first, second = (_flat(function(*copies(arguments))) for _ in range(2))
    yield Measurement("two calls differ", float(not _alike(first, second)), 0.0)


def _untouched(arguments: tuple[Any, ...], function: Function) -> Iterator[Measurement]:
    given = copies(arguments)
    function(*given)
    changed = sum(not np.array_equal(one, other) for one, other in zip(given, arguments, strict=True))
    yield Measurement("arguments changed", float(changed), 0.0)


def equal(one: Any, other: Any) -> bool:
    """Say whether two answers have the same numbers, to the last bit; a refusal, None, is like a refusal."""
    if one is None or other is None:
        return one is other
    return _alike(_flat(one), _flat(other))


def _alike(first: Any, second: Any) -> bool:
    return bool(first.shape == second.shape and np.array_equal(first, second, equal_nan=True))


def _flat(answer: Any) -> Any:
    """The array has all numbers of an answer."""
    if is_dataclass(answer) and not isinstance(answer, type):
        answer = astuple(answer)
    if isinstance(answer, dict):
        answer = list(answer.values())
    if isinstance(answer, (list, tuple)):
        return np.concatenate([np.zeros(0, complex), *(_flat(part) for part in answer)])
    return np.asarray(answer, dtype=complex).ravel()
