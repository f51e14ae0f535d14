"""Records in which no fault acts: what they do not show must not be told.

checks     no-fault-told: `fault_dimension` of free responses; no-fault-of-record: `count_faults` of outputs that the input alone moves

Contract. The answer 0 is right, and so is none, since a fault that does not excite looks the same; a number above 0 is made up.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

from ..records import Check, Function, Measurement, Severity, or_refused
from ..vectors.rationals import floats
from ..vectors.shipped_vectors import shipped
from .edges import FREE, free_response
from .faults import compared_count
from .laws import LOUD, nothing_acts

EFFECT = "a fault is reported where none acts"


def checks() -> Iterator[Check]:
    """This yields all checks of the module."""
    for name in FREE:
        yield _none("no-fault-told", "fault_dimension", name, partial(_free_response, name))
    for vector in shipped("noisy")[:1]:
        for name, noise in (("exact", 0.0), ("noisy", LOUD)):
            yield _none("no-fault-of-record", "count_faults", f"{vector.slug}-{name}", partial(nothing_acts, vector, noise))


def _free_response(name: str) -> tuple[Any, ...]:
    return (np.ascontiguousarray(floats(free_response(name)[0])),)


def _none(slug: str, function: str, vector: str, arguments: Callable[[], tuple[Any, ...]]) -> Check:
    def compare(called: Function) -> Iterator[Measurement]:
        yield compared_count("n_v", called(*arguments()), 0)

    return Check(slug, function, vector, "proposition-3", EFFECT, Severity.SILENT, or_refused(compare))
