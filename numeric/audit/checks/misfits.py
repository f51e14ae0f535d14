"""What fits no question: arrays of shapes that contradict each other, and numbers that are none, in every argument of every function.

AXES       function -> the letter of each axis of each array that it takes, in order; equal letters must have equal sizes
checks     refuses-misfit: one axis a row or a column longer or shorter than the others say, or a matrix turned;
           refuses-no-number: NaN or infinity of either sign in one entry of one argument, in its middle, at its beginning or at its end,
           and late in a long record; where one sample of a record is none, the others determine the model: it may be given instead

A shape is wrong where a letter stands at another axis, too: the number of samples of a residual alone is nobody's business. Both are asked
of two faults in three outputs, and of a single state, fault and output, where a program that repeats, cuts or adds axes finds that
everything fits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from typing import Any

import numpy as np

from ....base.arrays import Array
from ...method.model.models import StateSpaceModel
from ..adapter import ARGUMENTS
from ..making.model_bounds import bounded
from ..records import Check, Demand, Function, Measurement, Severity, or_refused
from ..vectors.fault_vectors import with_input
from ..vectors.rationals import floats, matrix, signs
from ..vectors.shipped_vectors import IdentificationVector, shipped
from .growth import FORGETTING, LENGTHS, model_off, question
from .identification import as_it_is
from .laws import LOUD, record

SEED = 20250602
RECORDS = (("N", "p"), ("N", "n_u"))
AXES: dict[str, tuple[tuple[str, ...], ...]] = {
    "identify": RECORDS,
    "residual": (("N", "p"), ("N", "m"), ("n", "n"), ("n", "m"), ("p", "n"), ("p", "m")),
    "window_ranks": (("N", "p"),),
    "fault_dimension": (("N", "p"),),
    "fault_space": (("N", "p"), ("n", "n"), ("p", "n")),
    "reconstruct": (("N", "p"), ("n", "n"), ("n", "m"), ("p", "n"), ("p", "m"), ("n",)),
    "structure": (("n", "n"), ("n", "m"), ("p", "n"), ("p", "m")),
    "count_faults": RECORDS,
    "identified_fault_space": RECORDS,
}
Arguments = tuple[Any, ...]


@dataclass(frozen=True)
class Asked:
    """A question that fits, which is made to fit no more.

    `right` compares an answer with that to the question as it was, where all samples but one still determine it; else None.
    """

    function: str
    vector: str
    arguments: Callable[[], Arguments]
    right: Callable[[Any], Iterator[Measurement]] | None = None


@dataclass(frozen=True)
class Change:
    """What is done to one array: a name, and the array that comes of it."""

    name: str
    of: Callable[[Array], Array]


def checks() -> Iterator[Check]:
    """This yields all checks of the module."""
    for asked in (*_two_faults(), *_single_channel(), *_of_records()):
        names = ARGUMENTS[asked.function]
        for place, axes in enumerate(AXES[asked.function]):
            for change in _misfits(asked.function, axes, asked.arguments()[place].shape):
                effect = "arrays that contradict each other are cut, repeated or turned until they fit"
                yield _refuses("refuses-misfit", asked, names[place], place, change, effect)
            for change in NO_NUMBERS:
                yield _refuses("refuses-no-number", asked, names[place], place, change, "an answer about no numbers")
    for asked in _long():
        for place, axes in enumerate(AXES[asked.function]):
            if "N" in axes:
                effect = "an answer about no numbers: they come late in the record"
                yield _refuses("refuses-no-number", asked, ARGUMENTS[asked.function][place], place, LATE, effect)


def _refuses(slug: str, asked: Asked, name: str, place: int, change: Change, effect: str) -> Check:
    right = asked.right if change in NO_NUMBERS else None

    def measure(function: Function) -> Iterator[Measurement]:
        arguments = list(asked.arguments())
        arguments[place] = change.of(arguments[place])
        answer = function(*arguments)
        if right is not None:
            yield from right(answer)

    vector = f"{asked.vector}-{name}-{change.name}"
    if right is None:
        return Check(slug, asked.function, vector, None, effect, Severity.SILENT, measure, Demand.MUST_REFUSE)
    return Check(slug, asked.function, vector, None, effect, Severity.SILENT, or_refused(measure))


def _misfits(function: str, axes: tuple[str, ...], shape: tuple[int, ...]) -> Iterator[Change]:
    """Yield the changes of an array after which no sizes give its axes' letters one meaning."""
    letters = [letter for one in AXES[function] for letter in one]
    for axis, letter in enumerate(axes):
        if letters.count(letter) > 1:
            word = ("rows", "columns")[axis]
            yield Change(f"more-{word}", partial(_longer, axis))
            if shape[axis] > 1:
                yield Change(f"fewer-{word}", partial(_shorter, axis))
    if len(axes) > 1 and shape[0] != shape[1] and any(letters.count(letter) > 1 for letter in axes):
        yield Change("turned", _turned)


def _longer(axis: int, array: Array) -> Array:
    """The last row or column stands twice."""
    last = np.take(array, [-1], axis=axis)
    return np.concatenate([array, last], axis=axis)


def _shorter(axis: int, array: Array) -> Array:
    return np.take(array, range(array.shape[axis] - 1), axis=axis)


def _turned(array: Array) -> Array:
    return np.ascontiguousarray(array.T)


def _with(value: float, where: str, array: Array) -> Array:
    """The entry in the middle has this value, the first one, the last one, or the last one of the first row."""
    places = {
        "middle": tuple(size // 2 for size in array.shape),
        "first": (0,) * array.ndim,
        "last": (-1,) * array.ndim,
        "corner": (0,) * (array.ndim - 1) + (-1,),
    }
    changed = array.astype(float)
    changed[places[where]] = value
    return changed


NO_NUMBERS = (
    Change("nan", partial(_with, np.nan, "middle")),
    Change("infinity", partial(_with, np.inf, "middle")),
    Change("nan-at-the-end", partial(_with, np.nan, "last")),
    Change("infinity-in-the-corner", partial(_with, np.inf, "corner")),
    Change("minus-infinity-at-the-beginning", partial(_with, -np.inf, "first")),
)
LATE = NO_NUMBERS[2]


def _two_faults() -> Iterator[Asked]:
    vector = next(one for one in shipped("faults") if one.slug == "two-faults")
    system = vector.system
    y, u = (floats(M) for M in with_input(vector.r, system, vector.view.scale))
    r, A, F, C, G = (floats(M) for M in (vector.r, system.A, system.F, system.C, system.G))
    yield from _asked("two-faults", y, u, r, (A, F, C, G), floats(vector.x0).ravel())
    model = next(one for one in shipped("identification") if one.C.nrows > 1 and one.B.ncols > 1)
    right = partial(as_it_is, vector=model)
    yield Asked("identify", model.slug, lambda: (floats(model.y), floats(model.u), model.order, model.block_rows), right)
    yield Asked("fault_space", "two-faults", lambda: (r.copy(), A, C, vector.n_v, len(A) + 1))


def _single_channel() -> Iterator[Asked]:
    """One state, one fault, one output; as many samples as no other size. No fault space: it has no law, and is refused anyway."""
    A, F, C, G = (np.array([[x]]) for x in (0.5, 1.0, 2.0, 1.0))
    u, v = signs(SEED, 200).reshape(2, 100, 1)
    x0 = np.array([1.0])
    r = np.asarray(StateSpaceModel(A, F, C, G).simulate(v, x0))
    y = r + np.asarray(StateSpaceModel(A, F, C, G).simulate(u, np.zeros(1)))
    yield from _asked("single-channel", y, u, r, (A, F, C, G), x0)
    driven = np.asarray(StateSpaceModel(A, F, C, G).simulate(u, x0))
    yield Asked("identify", "single-channel", lambda: (driven.copy(), u.copy(), 1, 3), lambda answer: as_it_is(answer, _single_model()))


@cache
def _single_model() -> IdentificationVector:
    """Return the model of the single channel, with the bounds of its record."""
    A, B, C, D, x0 = (matrix([[entry]], 1) for entry in ("1/2", 1, 2, 1, 1))
    u = matrix([[int(sign)] for sign in signs(SEED, 200)[:100]], 1)
    return bounded(IdentificationVector("single-channel", A, B, C, D, x0, u, 3, {}))


def _asked(slug: str, y: Array, u: Array, r: Array, system: Arguments, x0: Array) -> Iterator[Asked]:
    yield Asked("residual", slug, lambda: (y.copy(), u.copy(), *system))
    yield Asked("window_ranks", slug, lambda: (r.copy(), 3))
    yield Asked("fault_dimension", slug, lambda: (r.copy(),))
    yield Asked("reconstruct", slug, lambda: (r.copy(), *system, x0))
    yield Asked("structure", slug, lambda: system)


def _long() -> Iterator[Asked]:
    """Records of thousands of samples, which nobody reads twice."""
    for function in ("identify", "residual", "window_ranks", "fault_dimension", "fault_space", "reconstruct"):
        right = partial(model_off, FORGETTING, ()) if function == "identify" else None
        yield Asked(function, f"N{LENGTHS[0]}", partial(question, function, LENGTHS[0]), right)


def _of_records() -> Iterator[Asked]:
    vector = shipped("noisy")[0]
    order, n_v = vector.system.n, vector.system.m
    yield Asked("count_faults", vector.slug, lambda: (*record(vector, LOUD), order))
    yield Asked("identified_fault_space", vector.slug, lambda: (*record(vector, LOUD), order, n_v))
