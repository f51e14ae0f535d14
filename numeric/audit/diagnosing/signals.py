"""Suspicions of `reconstruct`.

SUSPICIONS   in the order in which they are tested
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ....base.arrays import Array
from ...method.model.models import StateSpaceModel
from ..records import Function
from .models import orders
from .scales import sizes, to_one
from .suspicions import Case, Suspicion, answer_changed, asked_otherwise, seen


def _array(answer: Any) -> Array:
    return np.asarray(answer, dtype=float)


def _moved(samples: int) -> Any:
    def change(answer: Any, *_: Any) -> Array:
        v = _array(answer)
        moved = np.zeros_like(v)
        if samples > 0:
            moved[samples:] = v[:-samples]
        else:
            moved[:samples] = v[-samples:]
        return moved

    return change


def _permuted(case: Case) -> bool:
    channels = case.calls[0].arguments[2].shape[1]
    return any(answer_changed("", lambda v, *_, order=one: _array(v)[:, order]).confirmed(case) for one in orders(channels))


def _from_rest(function: Function, r: Array, A: Array, F: Array, C: Array, G: Array, x0: Array) -> Any:
    """Take the response from x0 off the record, and ask for the signal from rest."""
    free = StateSpaceModel(A, F, C, G).simulate(np.zeros((len(r), F.shape[1])), np.asarray(x0, dtype=float))
    return function(r - free, A, F, C, G, 0 * x0) if np.any(x0) else None


def _with_transposed(function: Function, r: Array, A: Array, *rest: Any) -> Any:
    return function(r, A.T.copy(), *rest)


def _record_to_one(function: Function, r: Array, A: Array, F: Array, C: Array, G: Array, x0: Array) -> Any:
    size = to_one(r)
    return _array(function(r / size, A, F, C, G, x0 / size)) * size


def _each_channel_to_one(function: Function, r: Array, A: Array, F: Array, C: Array, G: Array, x0: Array) -> Any:
    size = sizes(r)
    return function(r / size, A, F, C / size[:, None], G / size[:, None], x0)


def _factor(case: Case) -> bool:
    """This tells whether one number times the answer is the truth."""
    sides = next((one.sides for one in case.measured if one.sides is not None and one.sides.of == "signal"), None)
    if sides is None:
        return False
    v, truth = (np.array([[float(x) for x in row] for row in side]) for side in (sides.answer, sides.truth))
    size = float(np.sum(v * v))
    factor = float(np.sum(v * truth)) / size if size else 0.0
    return bool(factor) and answer_changed("", lambda answer, *_: _array(answer) * factor).confirmed(case)


SUSPICIONS = (
    answer_changed("The signal has the wrong sign: with -v the answer passes.", lambda v, *_: -_array(v)),
    answer_changed("The signal is transposed: it should have a row a sample.", lambda v, *_: _array(v).T),
    Suspicion("Fault channels are permuted: in another order the answer passes.", _permuted),
    answer_changed("The signal is one sample late: moved one sample forward it passes.", _moved(-1)),
    answer_changed("The signal is one sample early: moved one sample back it passes.", _moved(1)),
    asked_otherwise("The initial state is ignored: with its response taken off the record, the function passes.", _from_rest),
    asked_otherwise("A is used transposed: asked with A', the function passes.", _with_transposed),
    Suspicion("The signal is off by one factor: times that it passes.", _factor),
    asked_otherwise("A threshold is absolute: with the whole record brought to size one first, the function passes.", _record_to_one),
    asked_otherwise(
        "Channels in unlike units mislead it: with each output brought to size one first, the function passes.", _each_channel_to_one
    ),
    seen("The signal is zero everywhere.", lambda v, *_: not np.any(_array(v))),
)
