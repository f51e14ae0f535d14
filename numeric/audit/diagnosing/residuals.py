"""Suspicions of `residual`, whose answer may be off by a free response of the model.

SUSPICIONS   in the order in which they are tested
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from ....base.arrays import Array
from ...method.model.models import StateSpaceModel
from ..records import Function
from .scales import sizes, to_one
from .suspicions import SAME, answer_changed, asked_otherwise, seen


def _shifted(signal: Array, samples: int) -> Array:
    moved = np.zeros_like(signal)
    if samples > 0:
        moved[samples:] = signal[:-samples]
    else:
        moved[:samples] = signal[-samples:]
    return moved


def _array(answer: Any) -> Array:
    return np.asarray(answer, dtype=float)


def _moved(r: Any, y: Array, u: Array, *system: Array, samples: int) -> bool:
    """This tells whether y - r is the response from rest, moved by so many samples, wherever both have one."""
    response = StateSpaceModel(*system).simulate(u)
    subtracted, due = (one[1:-1] for one in (y - _array(r), _shifted(response, samples)))
    return bool(np.any(due)) and np.allclose(subtracted, due, rtol=0.0, atol=SAME * np.max(np.abs(due)))


def _record_to_one(function: Function, y: Array, u: Array, A: Array, B: Array, C: Array, D: Array) -> Any:
    size, inputs = to_one(y), to_one(u)
    return _array(function(y / size, u / inputs, A, B * inputs / size, C, D * inputs / size)) * size


def _each_channel_to_one(function: Function, y: Array, u: Array, A: Array, B: Array, C: Array, D: Array) -> Any:
    size = sizes(y)
    return _array(function(y / size, u, A, B, C / size[:, None], D / size[:, None])) * size


SUSPICIONS = (
    answer_changed("The residual has the wrong sign: with -r the answer passes.", lambda r, *_: -_array(r)),
    answer_changed("The residual is transposed: it should have a row a sample.", lambda r, y, *_: _array(r).T),
    answer_changed(
        "The response is added where it is to be subtracted: with 2 y - r the answer passes.", lambda r, y, *_: 2 * y - _array(r)
    ),
    answer_changed("D is ignored: less D u the answer passes.", lambda r, y, u, A, B, C, D: _array(r) - u @ D.T),
    answer_changed("D has the wrong sign: less 2 D u the answer passes.", lambda r, y, u, A, B, C, D: _array(r) - 2 * u @ D.T),
    asked_otherwise("A is used transposed: asked with A', the function passes.", lambda f, y, u, A, *rest: f(y, u, A.T.copy(), *rest)),
    asked_otherwise(
        "Input channels are permuted: asked with them in reverse order, the function passes.",
        lambda f, y, u, A, *rest: f(y, u[:, ::-1].copy(), A, *rest) if u.shape[1] > 1 else None,
    ),
    answer_changed(
        "Output channels are permuted: in reverse order the answer passes.", lambda r, y, *_: _array(r)[:, ::-1] if y.shape[1] > 1 else None
    ),
    seen("The response is one sample early: what is subtracted is the response of the next sample.", partial(_moved, samples=-1)),
    seen("The response is one sample late: what is subtracted is the response of the sample before.", partial(_moved, samples=1)),
    seen("Nothing is subtracted: the answer is y.", lambda r, y, *_: np.array_equal(_array(r), y)),
    asked_otherwise("A threshold is absolute: with the whole record brought to size one first, the function passes.", _record_to_one),
    asked_otherwise(
        "Channels in unlike units mislead it: with each output brought to size one first, the function passes.", _each_channel_to_one
    ),
)
