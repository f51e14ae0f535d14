"""Suspicions of `fault_space` and of `identified_fault_space`.

SUSPICIONS, OF_RECORD   in the order in which they are tested
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from ....base.arrays import Array
from ..records import Function
from .suspicions import SAME, Case, Suspicion, answer_changed, asked_otherwise, misled_by_sizes, sizes, to_one


def _array(answer: Any) -> Array:
    return np.asarray(answer, dtype=float)


def _parts(answer: Any, A: Array) -> tuple[Array, Array]:
    columns = _array(answer)
    return columns[: len(A)], columns[len(A) :]


def _turned(answer: Any, r: Array, A: Array, C: Array, *_: Any) -> Array:
    columns = _array(answer)
    return np.vstack([columns[len(C) :], columns[: len(C)]])


def _of_parts(change: Any) -> Any:
    return lambda answer, r, A, C, *rest: np.vstack(change(*_parts(answer, A), A))


def _record_to_one(function: Function, r: Array, *rest: Any) -> Any:
    return function(r / to_one(r), *rest)


def _each_channel_to_one(function: Function, r: Array, A: Array, C: Array, *rest: Any) -> Any:
    size = sizes(r)
    f, g = _parts(function(r / size, A, C / size[:, None], *rest), A)
    return np.vstack([f, g * size[:, None]])


def _other_window(rows: int) -> Any:
    return lambda function, r, A, C, n_v, block_rows: function(r, A, C, n_v, block_rows + rows)


def _contained(larger: bool, case: Case) -> bool:
    """This tells whether the answer lies in the true space without filling it, or holds it and more (`larger`)."""
    sides = case.sides("space")
    if sides is None:
        return False
    answer, truth = (np.array([[float(x) for x in row] for row in side]) for side in (sides.answer, sides.truth))
    inner, outer = (truth, answer) if larger else (answer, truth)
    ranks = [
        int(np.linalg.matrix_rank(one, SAME * np.linalg.norm(one, 2))) for one in (inner, outer, np.hstack([_unit(outer), _unit(inner)]))
    ]
    return ranks[0] < ranks[1] == ranks[2]


def _unit(columns: Array) -> Array:
    return columns / np.linalg.norm(columns, 2)


def _answered_columns(function: Any) -> Any:
    """Make of a change of columns one of a whole answer (A, C, columns)."""
    return lambda answer, *arguments: (
        answer[0],
        answer[1],
        function(answer[2], arguments[0], np.asarray(answer[0]), np.asarray(answer[1])),
    )


_SIGNS = "The parts f and g have unlike signs: with -g the answer passes."
_ORDER = "The columns are [g; f] where they are to be [f; g]: turned round, the answer passes."

SUSPICIONS = (
    answer_changed(_ORDER, _turned),
    answer_changed(_SIGNS, _of_parts(lambda f, g, A: (f, -g))),
    answer_changed("The basis is transposed: it should have a column a solution.", lambda answer, *_: _array(answer).T),
    answer_changed("The columns f are one sample late: with A f the answer passes.", _of_parts(lambda f, g, A: (A @ f, g))),
    answer_changed(
        "The columns f are one sample early: with A^-1 f the answer passes.", _of_parts(lambda f, g, A: (np.linalg.solve(A, f), g))
    ),
    asked_otherwise("A is used transposed: asked with A', the function passes.", lambda f, r, A, *rest: f(r, A.T.copy(), *rest)),
    answer_changed(
        "The output parts g are permuted: in reverse order the answer passes.",
        lambda answer, r, A, C, *_: np.vstack([_parts(answer, A)[0], _parts(answer, A)[1][::-1]]) if len(C) > 1 else None,
    ),
    *misled_by_sizes(_record_to_one, _each_channel_to_one),
    asked_otherwise("The window is one block row too short: asked with one more, the function passes.", _other_window(1)),
    asked_otherwise("The window is one block row too long: asked with one less, the function passes.", _other_window(-1)),
    Suspicion("True columns are left out: the answer lies in the space, whose dimension is larger.", partial(_contained, False)),
    Suspicion("The space is too large: it holds all true columns, and others that explain nothing.", partial(_contained, True)),
)
OF_RECORD = (
    answer_changed(_ORDER, _answered_columns(_turned)),
    answer_changed(_SIGNS, _answered_columns(_of_parts(lambda f, g, A: (f, -g)))),
    *misled_by_sizes(lambda function, y, u, *rest: function(y / to_one(y), u / to_one(u), *rest)),
)
