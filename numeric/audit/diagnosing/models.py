"""Suspicions of `identify`.

SUSPICIONS   in the order in which they are tested: what is definite before what is vague
orders       the orders of channels that are tried
fitted       a model with A and C as they are and B and D, or D alone, fitted to the record
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import permutations
from typing import Any

import numpy as np

from ....base.arrays import Array
from ...method.model.models import StateSpaceModel
from ...study.conditioning import regressor_of
from .. import reference
from ..records import Function
from .suspicions import SAME, Suspicion, answer_changed, asked_otherwise, misled_by_sizes, seen, sizes, to_one

MOST_CHANNELS = 4  # of which all orders are tried: 23 of them
LONGEST = 2000  # samples to which matrices are fitted


def fitted(answer: Any, y: Array, u: Array, feedthrough_alone: bool) -> tuple[Array, Array, Array, Array]:
    """Return A, C as answered, with D (and B, unless `feedthrough_alone`) from least squares over the record, the initial state free."""
    A, B, C, _ = _arrays(answer)
    n, n_u, p = len(A), u.shape[1], len(C)
    if len(y) > LONGEST:
        raise ValueError("the record is too long to fit matrices to")
    model = StateSpaceModel(A, B, C, np.zeros((p, n_u)))
    regressors, targets = regressor_of(model, u)[0], y
    if feedthrough_alone:
        regressors, targets = np.delete(regressors, slice(n, n + n * n_u), axis=1), y - model.simulate(u)
    weights = np.tile(1 / sizes(y), len(y))
    regressors = regressors * weights[:, None]
    scale = np.linalg.norm(regressors, axis=0)
    scale[scale == 0] = 1
    found = np.linalg.lstsq(regressors / scale, targets.ravel() * weights, rcond=None)[0] / scale
    if not feedthrough_alone:
        B = found[n : n + n * n_u].reshape(n_u, n).T
    return A, B, C, found[len(found) - p * n_u :].reshape(p, n_u)


def _arrays(answer: Any) -> tuple[Array, Array, Array, Array]:
    A, B, C, D = (np.atleast_2d(np.asarray(one, dtype=float)) for one in answer)
    return A, B, C, D


def _changed(words: str, change: Callable[[Array, Array, Array, Array], Any]) -> Suspicion:
    return answer_changed(words, lambda answer, *_: change(*_arrays(answer)))


def _left_out(answer: Any, y: Array, u: Array, *_: Any) -> Any:
    return None if np.any(_arrays(answer)[3]) else fitted(answer, y, u, feedthrough_alone=True)


def orders(count: int) -> list[list[int]]:
    """Return every order of so many channels but the one that they have; none for more than MOST_CHANNELS."""
    return [list(order) for order in permutations(range(count))][1:] if 1 < count <= MOST_CHANNELS else []


def _confirmed_by_any(words: str, many: Callable[[int], Iterator[Suspicion]], axis: int) -> Suspicion:
    """Return the suspicion that one of several holds, as many as channels of argument number `axis` have orders."""
    return Suspicion(words, lambda case: any(one.confirmed(case) for one in many(case.calls[0].arguments[axis].shape[1])))


def _inputs_permuted(count: int) -> Iterator[Suspicion]:
    for order in orders(count):
        yield answer_changed("", lambda answer, *_, order=order: [one[:, order] if j % 2 else one for j, one in enumerate(_arrays(answer))])


def _outputs_permuted(count: int) -> Iterator[Suspicion]:
    for order in orders(count):
        yield answer_changed("", lambda answer, *_, order=order: [one[order] if j > 1 else one for j, one in enumerate(_arrays(answer))])


def _each_channel_to_one(function: Function, y: Array, u: Array, *rest: Any) -> Any:
    outputs, inputs = sizes(y), sizes(u)
    A, B, C, D = _arrays(function(y / outputs, u / inputs, *rest))
    return A, B / inputs, C * outputs[:, None], D * outputs[:, None] / inputs


def _record_to_one(function: Function, y: Array, u: Array, *rest: Any) -> Any:
    outputs, inputs = to_one(y), to_one(u)
    A, B, C, D = _arrays(function(y / outputs, u / inputs, *rest))
    return A, B / inputs, C * outputs, D * outputs / inputs


def _from_rest(function: Function, y: Array, u: Array, order: int, block_rows: int) -> Any:
    model = StateSpaceModel(*reference.identify(y, u, order, block_rows))
    return function(model.simulate(u, np.zeros(order)), u, order, block_rows)


def _blind_to_means(function: Function, y: Array, u: Array, *rest: Any) -> bool:
    """This tells whether a constant added to the outputs changes nothing: it changes every right answer but that of an integrator."""
    before, after = (_arrays(function(signal, u, *rest)) for signal in (y.copy(), y + sizes(y)))
    scale = max(np.max(np.abs(one), initial=0.0) for one in before)
    return all(np.allclose(one, other, rtol=0.0, atol=SAME * scale) for one, other in zip(before, after, strict=True))


SUSPICIONS = (
    answer_changed("D is ignored: it is zero in the answer, and with D fitted to the record the answer passes.", _left_out),
    _changed("A is transposed: with A' in its place the answer passes.", lambda A, B, C, D: (A.T, B, C, D)),
    _changed("The transfer function is transposed: (A', C', B', D') passes.", lambda A, B, C, D: (A.T, C.T, B.T, D.T)),
    _changed("B and C are each transposed: with B' and C' the answer passes.", lambda A, B, C, D: (A, B.T, C.T, D)),
    _changed("D has the wrong sign: with -D the answer passes.", lambda A, B, C, D: (A, B, C, -D)),
    _changed("B or C has the wrong sign: with -B the answer passes.", lambda A, B, C, D: (A, -B, C, D)),
    _changed("The response has the wrong sign: with -B and -D the answer passes.", lambda A, B, C, D: (A, -B, C, -D)),
    _changed("A has the wrong sign: with -A the answer passes.", lambda A, B, C, D: (-A, B, C, D)),
    _changed(
        "A is inverted, as if time ran backwards: with its inverse the answer passes.", lambda A, B, C, D: (np.linalg.inv(A), B, C, D)
    ),
    _changed(
        "The response is one sample late: with A, A B, C, C B the answer passes.",
        lambda A, B, C, D: None if np.any(D) else (A, A @ B, C, C @ B),
    ),
    _changed(
        "The response is one sample early: with A, A^-1 B, C, 0 the answer passes.",
        lambda A, B, C, D: (A, np.linalg.solve(A, B), C, 0 * D),
    ),
    _confirmed_by_any("Input channels are permuted: in another order of the columns of B and D the answer passes.", _inputs_permuted, 1),
    _confirmed_by_any("Output channels are permuted: in another order of the rows of C and D the answer passes.", _outputs_permuted, 0),
    seen("All numbers are of single precision.", lambda answer, *_: _single(_arrays(answer))),
    answer_changed(
        "A, B and C are right and D is wrong: with D fitted to the record the answer passes.",
        lambda answer, y, u, *_: fitted(answer, y, u, True),
    ),
    answer_changed(
        "A and C are right and B or D is wrong: with both fitted to the record the answer passes.",
        lambda answer, y, u, *_: fitted(answer, y, u, False),
    ),
    asked_otherwise("The initial state is ignored: asked of the same system from rest, the function passes.", _from_rest),
    *misled_by_sizes(_record_to_one, _each_channel_to_one),
    Suspicion(
        "Means are subtracted: a constant added to the outputs does not change the answer.",
        lambda case: all(call.answer is not None and _blind_to_means(case.function, *call.arguments) for call in case.calls),
    ),
)


def _single(parts: tuple[Array, ...]) -> bool:
    numbers = np.concatenate([one.ravel() for one in parts])
    return bool(np.any(numbers != np.round(numbers, 3))) and np.array_equal(numbers, numbers.astype(np.float32))
