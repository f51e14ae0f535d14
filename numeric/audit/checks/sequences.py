"""Several questions to one function: each answer is that to its own question, stays as it was, and leaves nothing behind.

checks    one-argument-changed: questions that differ in one matrix alone, each with its own exact answer, and the first one again after one
          a thousand million times as large; same-beginning: records that begin alike; earlier-answers-stay: an answer after others were
          given, and beside the arguments; forgets-the-records: how many of the records asked about are still held,
          and what memory more of them take for good

A program may remember what it was asked, as long as it knows the question again by all of it, and as long as what it keeps has an end.
"""

from __future__ import annotations

import gc
import tracemalloc
import weakref
from collections.abc import Callable, Iterable, Iterator
from dataclasses import astuple, is_dataclass, replace
from functools import cache, partial
from typing import Any

import numpy as np

from faultspace.exact.algebra.matrices import Matrix, rank, stacked
from faultspace.exact.structure.signals import hankel
from faultspace.exact.system.systems import ResidualSystem

from ..making.fault_records import residual_bound, signal_bound
from ..making.trouble_vectors import structure_vector
from ..records import Check, Function, Measurement, Severity, inside
from ..vectors.fault_vectors import FaultVector
from ..vectors.rationals import floats, fractions, matrix
from ..vectors.shipped_vectors import StructureVector, shipped
from ..vectors.trouble import default_troubles
from . import growth, structure
from .faults import ranks_off, residual_off, signal_off
from .manners import answered, copies, equal, questions

LARGE = 2**30
ASKED = 20  # records
HELD = 10  # of them at most: to keep some answers is a program's own affair, to keep all of the records is none
MANY = 600  # samples of each of many records: far more bytes than an interpreter leaves lying about
MORE = 3  # in each of the rounds after that, of which the first is nobody's: who keeps all of them grows in each
WINDOWS = 5  # from the fourth on the laws of two faults show


def checks() -> Iterator[Check]:
    """This yields all checks of the module."""
    effect = "an answer to another question, which differs in one matrix alone"
    yield _check("one-argument-changed", "structure", "square-complex", effect, _structures)
    effect = "an answer to another record, which began alike"
    for name, measure in (
        ("window_ranks", _ranks),
        ("residual", partial(_of_alike, residual_off)),
        ("reconstruct", partial(_of_alike, signal_off)),
    ):
        yield _check("same-beginning", name, "two-faults", effect, measure)
    for name, vector, arguments in (*questions(), _silent_model()):
        effect = "an answer that was kept is overwritten, or what is done to it is done to the caller's data"
        yield _check("earlier-answers-stay", name, vector, effect, partial(inside, _stay, arguments))
        effect = "memory grows with every question"
        long = name != "structure" and vector != "silent-model"  # which have no records, or were asked before
        yield _check("forgets-the-records", name, vector, effect, partial(_forgetting, name if long else None, arguments))


def _check(slug: str, function: str, vector: str, effect: str, measure: Callable[[Function], Iterable[Measurement]]) -> Check:
    return Check(slug, function, vector, None, effect, Severity.SOMETIMES, measure, nearness=1.0)


def _silent_model() -> tuple[str, str, tuple[Any, ...]]:
    """A model that makes no output: the residual is y, in an array of its own."""
    _, _, (y, u, A, F, C, G) = next(one for one in questions() if one[0] == "residual")
    return "residual", "silent-model", (y, u, A, 0 * F, 0 * C, 0 * G)


# -- truth -------------------------------------------------------------------------------------------------------------------------------


@cache
def variants() -> tuple[StructureVector, ...]:
    """Return the system as it is, and with one of its matrices halved, or without G, each with its own answer."""
    vector = next(one.structure for one in default_troubles() if one.kind == "square-complex")
    assert vector is not None
    given = vector.system
    parts = [given.A, given.F, given.C, given.G]
    found = [vector]
    for place, size in ((0, 1), (1, 1), (2, 1), (3, 1), (3, 0)):
        changed = [_times(M, size, 2) if i == place else M for i, M in enumerate(parts)]
        found.append(structure_vector(vector.slug, ResidualSystem(*changed)))
    return tuple(found)


def _times(given: Matrix, above: int, below: int) -> Matrix:
    return matrix([[x * above / below for x in row] for row in fractions(given)], given.ncols)


def _structures(function: Function) -> Iterator[Measurement]:
    first, *others = variants()
    for one in (first, *others, first):
        yield from _all_of(one, function)
    A, F, C, G = (floats(M) for M in (first.system.A, first.system.F, first.system.C, first.system.G))
    answered(function, (LARGE * A, LARGE * F, C, G))
    yield from _all_of(first, function)


def _all_of(vector: StructureVector, function: Function) -> Iterator[Measurement]:
    for check in structure.of_vector(vector):
        yield from check.measure(function)


def _two_faults() -> FaultVector:
    vector: FaultVector = next(one for one in shipped("faults") if one.slug == "two-faults")
    return vector


def _ranks(function: Function) -> Iterator[Measurement]:
    """The second record obeys no law from its middle on, where the first output stands for the second, and so on."""
    for one in records_alike():
        due = tuple(rank(hankel(one, s)) for s in range(1, WINDOWS + 1))
        yield from ranks_off(function(floats(one), WINDOWS), due)


def records_alike() -> tuple[Matrix, Matrix, Matrix]:
    """Return the residual, the same with its outputs one place further in the second half, and the first again."""
    r = _two_faults().r
    half = r.nrows // 2
    further = r.columns([*range(1, r.ncols), 0]).rows(range(half, r.nrows))
    return r, stacked(r.rows(range(half)), further), r


@cache
def alike() -> tuple[FaultVector, FaultVector]:
    """Return a vector, and one of which the fault goes backwards in the second half, with the bounds of its own record."""
    vector = replace(_two_faults(), views={})
    half = vector.v.nrows // 2
    v = stacked(vector.v.rows(range(half)), vector.v.rows(range(vector.v.nrows - 1, half - 1, -1)))
    other = replace(vector, v=v)
    bounds = {"residual": residual_bound(other.r, other.system, other.view.scale), "signal": signal_bound(other.r, other.system, other.x0)}
    return vector, replace(other, bounds=bounds)


def _of_alike(compare: Callable[..., Iterator[Measurement]], function: Function) -> Iterator[Measurement]:
    for one in (*alike(), alike()[0]):
        yield from compare(one, function)


# -- what is kept ------------------------------------------------------------------------------------------------------------------------


def _stay(arguments: tuple[Any, ...], function: Function) -> Iterator[Measurement]:
    """The others are of the same shapes: half of the record or of the model, and the same backwards."""
    given = copies(arguments)
    held = function(*given)
    then = [np.array(one, copy=True) for one in _arrays(held)]
    for other in (given[0] / 2, np.ascontiguousarray(given[0][::-1])):
        answered(function, (other, *copies(arguments)[1:]))
    now = _arrays(held)
    changed = sum(not equal(one, other) for one, other in zip(then, now, strict=True))
    yield Measurement("parts of an answer changed by later questions", float(changed), 0.0)
    shared = sum(np.shares_memory(one, other) for one in now for other in _arrays(given))
    yield Measurement("parts of an answer that are the caller's arrays", float(shared), 0.0)


def _arrays(answer: Any) -> list[Any]:
    """Return the arrays that an answer consists of."""
    if isinstance(answer, np.ndarray):
        return [answer]
    if is_dataclass(answer) and not isinstance(answer, type):
        answer = astuple(answer)
    if isinstance(answer, dict):
        answer = tuple(answer.values())
    return [array for one in answer for array in _arrays(one)] if isinstance(answer, (list, tuple)) else []


def _forgetting(long: str | None, arguments: tuple[Any, ...], function: Function) -> Iterator[Measurement]:
    yield from inside(_forgets, (arguments, None if long is None else growth.question(long, MANY)), function)


def _forgets(asked: tuple[Any, ...], function: Function) -> Iterator[Measurement]:
    arguments, long = asked
    ghosts = []
    for number in range(ASKED):
        first = arguments[0] * (1 + number)
        ghosts.append(weakref.ref(first))
        answered(function, (first, *copies(arguments)[1:]))
        del first
    gc.collect()
    yield Measurement("records held", float(sum(ghost() is not None for ghost in ghosts)), float(HELD))
    if long is not None:
        yield Measurement(f"records' worth of memory kept of {MORE}", _kept(function, *long), MORE / 2)


def _kept(function: Function, record: Any, *others: Any) -> float:
    """Return by how many records' worth the memory of this process grows with MORE of them, after ASKED others.

    A copy of each is seen so, or an answer for each, however it is kept.
    """

    def asked(numbers: range) -> int:
        before = tracemalloc.get_traced_memory()[0]
        for number in numbers:
            answered(function, (record * (1 + number), *copies(others)))
        gc.collect()
        return tracemalloc.get_traced_memory()[0] - before

    tracemalloc.start()
    try:
        _, *grown = (asked(range(first, first + MORE)) for first in range(ASKED, ASKED + 3 * MORE, MORE))
    finally:
        tracemalloc.stop()
    return float(max(min(grown), 0) / record.nbytes)
