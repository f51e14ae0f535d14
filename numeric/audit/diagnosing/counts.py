"""Suspicions of `window_ranks`, `fault_dimension` and `count_faults`.

RANKS, OF_RESIDUAL, OF_RECORD   in the order in which they are tested
"""

from __future__ import annotations

from typing import Any

from ....base.arrays import Array
from .. import reference
from ..records import Function
from .scales import sizes, to_one
from .suspicions import answer_changed, asked_otherwise, seen


def _full(ranks: Any, r: Array, windows: int) -> bool:
    """This tells whether every rank is as large as its matrix lets it be."""
    return [int(one) for one in ranks] == [min(r.shape[1] * s, len(r) - s + 1) for s in range(1, windows + 1)]


def _later(function: Function, r: Array, windows: int) -> Any:
    return list(function(r, windows + 1))[1:]


def _less(ranks: Any, step: int) -> list[int]:
    return [int(one) + step for one in ranks]


def _gap_at_one(n_v: Any, r: Array) -> bool:
    one, two = reference.window_ranks(r, 2)
    return int(n_v) == two - one


_ABSOLUTE = "A threshold is absolute: with the whole record brought to size one first, the function passes."
_UNLIKE = "Channels in unlike units mislead it: with each channel brought to size one first, the function passes."
_AS_OUTPUTS = "There are as many faults as outputs: rounding or noise is taken for faults, or windows are too short."

RANKS = (
    asked_otherwise("The windows are counted from 0: the rank of s - 1 block rows is answered for s.", _later),
    answer_changed("Every rank is one too small.", lambda ranks, *_: _less(ranks, 1)),
    answer_changed("Every rank is one too large.", lambda ranks, *_: _less(ranks, -1)),
    asked_otherwise(_ABSOLUTE, lambda function, r, windows: function(r / to_one(r), windows)),
    asked_otherwise(_UNLIKE, lambda function, r, windows: function(r / sizes(r), windows)),
    seen("Every rank is full: rounding is taken for signal.", _full),
)
OF_RESIDUAL = (
    asked_otherwise(_ABSOLUTE, lambda function, r: function(r / to_one(r))),
    asked_otherwise(_UNLIKE, lambda function, r: function(r / sizes(r))),
    seen(_AS_OUTPUTS, lambda n_v, r: int(n_v) == r.shape[1]),
    seen("The answer equals rank R_2 - rank R_1: windows are too short.", _gap_at_one),
    answer_changed("There is one fault too many.", lambda n_v, *_: float(n_v) - 1),
    answer_changed("There is one fault too few.", lambda n_v, *_: float(n_v) + 1),
)
OF_RECORD = (
    asked_otherwise(_ABSOLUTE, lambda function, y, u, order: function(y / to_one(y), u / to_one(u), order)),
    asked_otherwise(_UNLIKE, lambda function, y, u, order: function(y / sizes(y), u / sizes(u), order)),
    seen(_AS_OUTPUTS, lambda n_v, y, *_: int(n_v) == y.shape[1]),
    answer_changed("There is one fault too many.", lambda n_v, *_: float(n_v) - 1),
    answer_changed("There is one fault too few.", lambda n_v, *_: float(n_v) + 1),
)
