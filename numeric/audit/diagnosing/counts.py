"""Suspicions of `window_ranks`, `fault_dimension`, `count_faults` and `structure`.

RANKS, OF_RESIDUAL, OF_RECORD, OF_STRUCTURE   in the order in which they are tested
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import is_dataclass, replace
from typing import Any

import numpy as np

from ....base.arrays import Array
from .. import reference
from .suspicions import SAME, Case, Suspicion, answer_changed, asked_otherwise, misled_by_sizes, seen, sizes, to_one


def _full(ranks: Any, r: Array, windows: int) -> bool:
    """This tells whether every rank is as large as its matrix lets it be."""
    return [int(one) for one in ranks] == [min(r.shape[1] * s, len(r) - s + 1) for s in range(1, windows + 1)]


def _gap_at_one(n_v: Any, r: Array) -> bool:
    one, two = reference.window_ranks(r, 2)
    return int(n_v) == two - one


def _counts(noise: Callable[..., bool], sized: tuple[Suspicion, ...], *others: Suspicion) -> tuple[Suspicion, ...]:
    """Return the suspicions of a number of faults; `noise` tells whether it is that of the outputs."""
    return (
        *sized,
        seen("There are as many faults as outputs: rounding or noise is taken for faults, or windows are too short.", noise),
        *others,
        answer_changed("There is one fault too many.", lambda n_v, *_: float(n_v) - 1),
        answer_changed("There is one fault too few.", lambda n_v, *_: float(n_v) + 1),
    )


RANKS = (
    asked_otherwise(
        "The windows are counted from 0: the rank of s - 1 block rows is answered for s.", lambda f, r, s: list(f(r, s + 1))[1:]
    ),
    answer_changed("Every rank is one too small.", lambda ranks, *_: [int(one) + 1 for one in ranks]),
    answer_changed("Every rank is one too large.", lambda ranks, *_: [int(one) - 1 for one in ranks]),
    *misled_by_sizes(lambda f, r, windows: f(r / to_one(r), windows), lambda f, r, windows: f(r / sizes(r), windows)),
    seen("Every rank is full: rounding is taken for signal.", _full),
)
OF_RESIDUAL = _counts(
    lambda n_v, r: int(n_v) == r.shape[1],
    misled_by_sizes(lambda f, r: f(r / to_one(r)), lambda f, r: f(r / sizes(r))),
    seen("The answer equals rank R_2 - rank R_1: windows are too short.", _gap_at_one),
)
OF_RECORD = _counts(
    lambda n_v, y, *_: int(n_v) == y.shape[1],
    misled_by_sizes(lambda f, y, u, n: f(y / to_one(y), u / to_one(u), n), lambda f, y, u, n: f(y / sizes(y), u / sizes(u), n)),
)


def _with(answer: Any, **changed: Any) -> Any:
    if isinstance(answer, Mapping):
        return {**answer, **changed}
    if is_dataclass(answer) and not isinstance(answer, type):
        return replace(answer, **changed)
    return {name: getattr(answer, name) for name in ("normal_rank", "finite_zeros", "infinite_zero_orders", "left_invertible")} | changed


def _field(answer: Any, name: str) -> Any:
    return answer[name] if isinstance(answer, Mapping) else getattr(answer, name)


def _changed(words: str, name: str, change: Callable[[Any], Any]) -> Suspicion:
    return answer_changed(words, lambda answer, *_: _with(answer, **{name: change(_field(answer, name))}))


def _zeros(words: str, change: Callable[[complex], complex]) -> Suspicion:
    return _changed(words, "finite_zeros", lambda zeros: [change(complex(z)) for z in zeros])


def _poles(case: Case) -> bool:
    """This tells whether the finite zeros are the eigenvalues of A."""
    for call in case.calls:
        got = np.sort_complex(np.array([complex(z) for z in _field(call.answer, "finite_zeros")], dtype=complex))
        due = np.sort_complex(np.linalg.eigvals(call.arguments[0]).astype(complex))
        if len(got) != len(due) or not len(due) or not np.allclose(got, due, rtol=SAME, atol=SAME):
            return False
    return bool(case.calls)


def _without_delay(case: Case) -> bool:
    """This tells whether orders of infinite zeros are wrong, and all of them are 0."""
    wrong = (one.sides for one in case.measured if one.ratio > 1 and one.sides is not None and one.sides.of == "infinite_zero_orders")
    return any(sides.answer and not any(sides.answer) for sides in wrong)


def _missing(words: str, lost: Callable[[complex], bool]) -> Suspicion:
    """Suspect that zeros of one kind are left out: with those of the truth that are of this kind, the answer passes."""

    def confirmed(case: Case) -> bool:
        sides = case.sides("finite_zeros")
        truth = [complex(z) for z in sides.truth] if sides else []
        added = [z for z in truth if lost(z)]
        return 0 < len(added) < len(truth) and _changed("", "finite_zeros", lambda zeros: [*map(complex, zeros), *added]).confirmed(case)

    return Suspicion(words, confirmed)


OF_STRUCTURE = (
    _changed("left_invertible is told the wrong way round.", "left_invertible", lambda told: not told),
    _changed("The normal rank is one too large.", "normal_rank", lambda rank: int(rank) - 1),
    _changed("The normal rank is one too small.", "normal_rank", lambda rank: int(rank) + 1),
    _changed(
        "The orders of infinite zeros are one too large: that without a delay has order 0.",
        "infinite_zero_orders",
        lambda orders: [int(k) - 1 for k in orders],
    ),
    _changed("The orders of infinite zeros are one too small.", "infinite_zero_orders", lambda orders: [int(k) + 1 for k in orders]),
    _zeros("The zeros have the wrong sign: with -z the answer passes.", lambda z: -z),
    _zeros("The zeros are inverted: with 1/z the answer passes.", lambda z: 1 / z),
    _missing("Zeros at 0 are left out.", lambda z: z == 0),
    _missing("Zeros on or outside the unit circle are left out.", lambda z: abs(z) >= 1),
    _missing("Zeros inside the unit circle are left out.", lambda z: abs(z) < 1),
    _missing("Complex zeros are left out.", lambda z: z.imag != 0),
    Suspicion("The finite zeros are the poles: the eigenvalues of A.", _poles),
    asked_otherwise("A is used transposed: asked with A', the function passes.", lambda f, A, *rest: f(A.T.copy(), *rest)),
    Suspicion("Every infinite zero is given the order 0.", _without_delay),
)
