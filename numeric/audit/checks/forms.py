"""The same numbers in other forms: another order in memory, strides, read-only, other types. The answers are the same.

checks      for every function, on integers, which every type of number holds exactly
FORMS       name -> (how an array takes that form, whether it must be answered or may be refused)

Order, strides and read-only flags say nothing of the numbers, so that an answer is due: also from who writes into the arguments and
restores them, for a read-only array does not let him. Single precision, integers and objects are numbers of another type: to refuse them,
be it by TypeError, is right as well, a wrong answer is not. Who computes in the type that he is given loses the digits that are asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

from ....base.arrays import Array
from ..records import Broken, Check, Function, Measurement, Refused, Severity, or_refused
from ..vectors.trouble import Trouble, default_troubles
from .trouble import Compare, questions

KIND = "whole-numbers"


def _strided(array: Array) -> Array:
    """Return a view of every other entry along each axis, with NaN between."""
    wide = np.full([2 * size for size in array.shape], np.nan)
    view = wide[(slice(None, None, 2),) * array.ndim]
    view[...] = array
    return view


def _backwards(array: Array) -> Array:
    """Return a view with negative strides."""
    return np.ascontiguousarray(array[::-1])[::-1]


def _read_only(array: Array) -> Array:
    kept = array.copy()
    kept.flags.writeable = False
    return kept


def _as(kind: Any, array: Array) -> Any:
    return array.astype(kind)


FORMS: dict[str, tuple[Callable[[Array], Any], bool]] = {
    "fortran-order": (np.asfortranarray, True),
    "strides": (_strided, True),
    "backwards": (_backwards, True),
    "read-only": (_read_only, True),
    "float32": (partial(_as, np.float32), False),
    "integers": (partial(_as, np.int64), False),
    "objects": (partial(_as, object), False),
}


def checks() -> Iterator[Check]:
    """This yields all checks of the module."""
    whole = next(one for one in default_troubles() if one.kind == KIND)
    for slug, function, claim, compare in _plain(whole):
        for name, (form, due) in FORMS.items():
            if slug == "fault-space-shortest-window":
                continue
            measure = partial(_formed, compare, form, due)
            effect = f"a wrong answer for the same numbers: {name}"
            yield Check(f"form-{name}", function, KIND, claim, effect, Severity.SOMETIMES, measure)


def _plain(whole: Trouble) -> Iterator[tuple[str, str, str, Compare]]:
    """Yield one plain question for each function."""
    seen = set()
    for slug, function, claim, _, compare in questions(whole):
        if function not in seen and slug != "normal-rank":
            seen.add(function)
            yield slug, function, claim, compare


def _formed(compare: Compare, form: Callable[[Array], Any], due: bool, function: Function) -> Iterator[Measurement]:
    def called(*arguments: Any) -> Any:
        return function(*(form(one) if isinstance(one, np.ndarray) else one for one in arguments))

    def untyped(*arguments: Any) -> Any:
        try:
            return called(*arguments)
        except Broken as failure:
            if isinstance(failure.__cause__, TypeError):
                raise Refused(str(failure)) from failure
            raise

    yield from compare(called) if due else or_refused(compare)(untyped)
