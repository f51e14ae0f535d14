"""Suspicions of `residual`, whose answer may be off by a free response of the model, and of `reconstruct`.

RESIDUAL, SIGNAL   in the order in which they are tested
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from ....base.arrays import Array
from ...method.model.models import StateSpaceModel
from ..records import Function
from .models import orders
from .suspicions import SAME, Case, Suspicion, answer_changed, asked_otherwise, misled_by_sizes, seen, sizes, to_one


def _array(answer: Any) -> Array:
    return np.asarray(answer, dtype=float)


def _shifted(signal: Any, samples: int) -> Array:
    given = _array(signal)
    moved = np.zeros_like(given)
    if samples > 0:
        moved[samples:] = given[:-samples]
    else:
        moved[:samples] = given[-samples:]
    return moved


def _moved(r: Any, y: Array, u: Array, *system: Array, samples: int) -> bool:
    """This tells whether y - r is the response from rest, moved by so many samples, wherever both have one."""
    response = StateSpaceModel(*system).simulate(u)
    subtracted, due = (one[1:-1] for one in (y - _array(r), _shifted(response, samples)))
    return bool(np.any(due)) and np.allclose(subtracted, due, rtol=0.0, atol=SAME * np.max(np.abs(due)))


def _residual_of_one(function: Function, y: Array, u: Array, A: Array, B: Array, C: Array, D: Array) -> Any:
    size, inputs = to_one(y), to_one(u)
    return _array(function(y / size, u / inputs, A, B * inputs / size, C, D * inputs / size)) * size


def _residual_of_ones(function: Function, y: Array, u: Array, A: Array, B: Array, C: Array, D: Array) -> Any:
    size = sizes(y)
    return _array(function(y / size, u, A, B, C / size[:, None], D / size[:, None])) * size


RESIDUAL = (
    answer_changed("The residual has the wrong sign: with -r the answer passes.", lambda r, *_: -_array(r)),
    answer_changed("The residual is transposed: it should have a row a sample.", lambda r, *_: _array(r).T),
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
    *misled_by_sizes(_residual_of_one, _residual_of_ones, "output"),
)


def _permuted(case: Case) -> bool:
    channels = case.calls[0].arguments[2].shape[1]
    return any(answer_changed("", lambda v, *_, order=one: _array(v)[:, order]).confirmed(case) for one in orders(channels))


def _from_rest(function: Function, r: Array, A: Array, F: Array, C: Array, G: Array, x0: Array) -> Any:
    """Take the response from x0 off the record, and ask for the signal from rest."""
    free = StateSpaceModel(A, F, C, G).simulate(np.zeros((len(r), F.shape[1])), np.asarray(x0, dtype=float))
    return function(r - free, A, F, C, G, 0 * x0) if np.any(x0) else None


def _signal_of_one(function: Function, r: Array, A: Array, F: Array, C: Array, G: Array, x0: Array) -> Any:
    size = to_one(r)
    return _array(function(r / size, A, F, C, G, x0 / size)) * size


def _signal_of_ones(function: Function, r: Array, A: Array, F: Array, C: Array, G: Array, x0: Array) -> Any:
    size = sizes(r)
    return function(r / size, A, F, C / size[:, None], G / size[:, None], x0)


def _factor(case: Case) -> bool:
    """This tells whether one number times the answer is the truth."""
    sides = case.sides("signal")
    if sides is None:
        return False
    v, truth = (np.array([[float(x) for x in row] for row in side]) for side in (sides.answer, sides.truth))
    size = float(np.sum(v * v))
    factor = float(np.sum(v * truth)) / size if size else 0.0
    return bool(factor) and answer_changed("", lambda answer, *_: _array(answer) * factor).confirmed(case)


SIGNAL = (
    answer_changed("The signal has the wrong sign: with -v the answer passes.", lambda v, *_: -_array(v)),
    answer_changed("The signal is transposed: it should have a row a sample.", lambda v, *_: _array(v).T),
    Suspicion("Fault channels are permuted: in another order the answer passes.", _permuted),
    answer_changed("The signal is one sample late: moved one sample forward it passes.", lambda v, *_: _shifted(v, -1)),
    answer_changed("The signal is one sample early: moved one sample back it passes.", lambda v, *_: _shifted(v, 1)),
    asked_otherwise("The initial state is ignored: with its response taken off the record, the function passes.", _from_rest),
    asked_otherwise("A is used transposed: asked with A', the function passes.", lambda f, r, A, *rest: f(r, A.T.copy(), *rest)),
    Suspicion("The signal is off by one factor: times that it passes.", _factor),
    *misled_by_sizes(_signal_of_one, _signal_of_ones, "output"),
    seen("The signal is zero everywhere.", lambda v, *_: not np.any(_array(v))),
)
