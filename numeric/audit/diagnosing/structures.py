"""Suspicions of `structure`.

SUSPICIONS   in the order in which they are tested
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import is_dataclass, replace
from typing import Any

import numpy as np

from ....base.arrays import Array
from .suspicions import SAME, Case, Suspicion, answer_changed, asked_otherwise


def _with(answer: Any, **changed: Any) -> Any:
    if isinstance(answer, Mapping):
        return {**answer, **changed}
    if is_dataclass(answer) and not isinstance(answer, type):
        return replace(answer, **changed)
    return {name: getattr(answer, name) for name in ("normal_rank", "finite_zeros", "infinite_zero_orders", "left_invertible")} | changed


def _field(answer: Any, name: str) -> Any:
    return answer[name] if isinstance(answer, Mapping) else getattr(answer, name)


def _zeros(words: str, change: Callable[[complex], complex]) -> Suspicion:
    return answer_changed(
        words, lambda answer, *_: _with(answer, finite_zeros=[change(complex(z)) for z in _field(answer, "finite_zeros")])
    )


def _orders(words: str, step: int) -> Suspicion:
    return answer_changed(
        words, lambda answer, *_: _with(answer, infinite_zero_orders=[int(k) + step for k in _field(answer, "infinite_zero_orders")])
    )


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
        sides = next((one.sides for one in case.measured if one.sides is not None and one.sides.of == "finite_zeros"), None)
        added = [] if sides is None else [complex(z) for z in sides.truth if lost(complex(z))]
        if not added or len(added) == len(sides.truth if sides else ()):
            return False

        def change(answer: Any, *_: Array) -> Any:
            return _with(answer, finite_zeros=[*map(complex, _field(answer, "finite_zeros")), *added])

        return answer_changed("", change).confirmed(case)

    return Suspicion(words, confirmed)


SUSPICIONS = (
    answer_changed(
        "left_invertible is told the wrong way round.",
        lambda answer, *_: _with(answer, left_invertible=not _field(answer, "left_invertible")),
    ),
    answer_changed(
        "The normal rank is one too large.", lambda answer, *_: _with(answer, normal_rank=int(_field(answer, "normal_rank")) - 1)
    ),
    answer_changed(
        "The normal rank is one too small.", lambda answer, *_: _with(answer, normal_rank=int(_field(answer, "normal_rank")) + 1)
    ),
    _orders("The orders of infinite zeros are one too large: that without a delay has order 0.", -1),
    _orders("The orders of infinite zeros are one too small.", 1),
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
