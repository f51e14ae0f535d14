"""Checks of every kind of trouble: the plain questions of each function that it concerns, on one vector each, drawn from a seed.

checks      those of all kinds for a seed
questions   the plain questions of a kind, and what compares the answers
of_forms    the same numbers in another order in memory, with strides, read-only, of other types: the answers are the same
FORMS       name -> (how an array takes that form, whether it must be answered or may be refused)

Forms are asked of integers, which every type of number holds exactly. Order, strides and read-only flags say nothing of the numbers, so
that an answer is due: also from who writes into the arguments and restores them, for a read-only array does not let him. Single precision,
integers and objects are numbers of another type: to refuse them, be it by TypeError, is right as well, a wrong answer is not. Who computes
in the type that he is given loses the digits that are asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

from ....base.arrays import Array
from ..making.trouble_vectors import troubles
from ..records import Broken, Check, Function, Measurement, Refused, Severity, or_refused
from ..vectors.fault_vectors import FaultVector
from ..vectors.rationals import floats
from ..vectors.shipped_vectors import IdentificationVector
from ..vectors.trouble import Trouble, default_troubles
from . import structure
from .faults import PLAIN, WINDOW, free_count, space_off
from .identification import RECOVERY, as_it_is

Compare = Callable[[Function], Iterator[Measurement]]


def checks(seed: int) -> Iterator[Check]:
    """This yields all checks of the module."""
    for one in troubles(seed):
        yield from of_trouble(one)


def of_trouble(trouble: Trouble) -> Iterator[Check]:
    """Yield the checks of the functions that the kind concerns, as far as it has vectors and bounds for them."""
    if trouble.structure:
        yield from structure.of_vector(trouble.structure)
    for slug, function, claim, effect, compare in questions(trouble):
        if function != "structure":
            yield Check(slug, function, trouble.kind, claim, effect, Severity.SILENT, compare)
    if trouble.faults and trouble.faults.n_v >= trouble.faults.system.p:
        yield _free_count("as-many-faults-as-outputs", trouble.faults, "noise is taken for faults, or faults for noise")
    if trouble.faults and trouble.faults.n_v == 0:
        yield _free_count("fault-dimension-unexciting", trouble.faults, "no fault is taken for one that does not excite, or the reverse")


def questions(trouble: Trouble) -> Iterator[tuple[str, str, str, str, Compare]]:
    """Yield (slug, function, claim, effect, what compares the answers of a function with the truth), one or two a function."""
    vector, model = trouble.faults, trouble.model
    if trouble.structure:
        effect = "faults that no output shows are missed, or seen where there are none"
        yield "finite-zeros", "structure", "window-ranks", effect, partial(structure.zeros_off, trouble.structure)
    if vector:
        for slug, (function, claim, effect, compare) in PLAIN.items():
            if function in trouble.asks and not (function == "reconstruct" and vector.bounds["signal"] is None):
                yield slug, function, claim, effect, partial(compare, vector)
                if function == "fault_space":
                    shortest = partial(space_off, vector, block_rows=vector.lag + 1)
                    yield "fault-space-shortest-window", function, "sharp-windows", WINDOW, shortest
    if model and any(model.asked(name) for name in ("markov", "characteristic_polynomial", "poles")):
        yield "exact-recovery", "identify", "proposition-1", RECOVERY, partial(_model_off, model)


def _free_count(slug: str, vector: FaultVector, effect: str) -> Check:
    """The count is free: as many faults as outputs look like noise in every output, and none like one that does not excite."""
    return free_count(slug, vector.slug, effect, "n_v", vector.r, vector.n_v)


def _model_off(vector: IdentificationVector, function: Function) -> Iterator[Measurement]:
    yield from as_it_is(function(floats(vector.y), floats(vector.u), vector.order, vector.block_rows), vector)


# -- the same numbers in other forms ------------------------------------------------------------------------------------------------------

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


def of_forms() -> Iterator[Check]:
    """Yield the checks of forms."""
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
