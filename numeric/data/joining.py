"""Several records of one plant: experiments side by side, or one without fault before the others.

one_record      the Record of whatever holds one or several experiments
healthy_from    the healthy record, of whatever holds one, with the channels of the other
joined          both in one record, the healthy samples first
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ...base.errors import InvalidData, shorten
from ...base.progress import Progress
from .records import Record, side_by_side
from .sources import record_from

SAME_TIME = 1e-6  # relative difference of two sample times that is put down to their digits


def one_record(
    y: Any,
    u: Any = None,
    *,
    inputs: str | Sequence[str] | None = None,
    outputs: str | Sequence[str] | None = None,
    on_progress: Progress | None = None,
) -> Record:
    """Return the Record of y and u, as `record_from` does, or of several experiments, whose samples follow each other in it.

    Several experiments are a list of Records, paths, frames or iterators of pieces (y, u), or y and u are lists of as many arrays or frames
    each. A list of pairs (y, u) are the pieces of one experiment. Raises InvalidData where channels or sample times differ.
    """
    several = _several(y, u)
    if several is None:
        return record_from(y, u, inputs=inputs, outputs=outputs, on_progress=on_progress)
    records: list[Record] = []
    for number, (one_y, one_u) in enumerate(several, 1):
        named = {} if isinstance(one_y, Record) else {"inputs": inputs, "outputs": outputs}
        try:
            records.append(record_from(one_y, one_u, **named, on_progress=on_progress))
        except InvalidData as error:
            raise InvalidData(f"experiment {number} of {len(several)}: {error}") from None
    first = records[0]
    for number, record in enumerate(records, 1):
        if (record.inputs, record.outputs) != (first.inputs, first.outputs):
            raise InvalidData(
                f"experiment {number} has the channels {', '.join(map(shorten, record.names[:6]))} where the first has "
                f"{', '.join(map(shorten, first.names[:6]))}: all need the same inputs and outputs"
            )
        if record.offset.any():
            raise InvalidData(f"experiment {number} is about its means; give the samples as they were measured")
    times = [record.clock.dt for record in records if record.clock is not None]
    if times and max(times) - min(times) > SAME_TIME * max(times):
        raise InvalidData(
            f"experiments: got sample times from {min(times):.6g} to {max(times):.6g} s; one model needs one sample time: resample, or "
            "identify them apart"
        )
    return side_by_side(records)


def _several(y: Any, u: Any) -> list[tuple[Any, Any]] | None:
    """Return the experiments (y, u) of what holds several, None for what holds one."""
    if not isinstance(y, list | tuple) or not y:
        return None
    if u is None:
        whole = [isinstance(one, Record | str | os.PathLike | Iterator) or hasattr(one, "columns") for one in y]
        if not any(whole):
            return None
        if not all(whole):
            raise InvalidData("experiments: got records among other things; a list of records, paths, frames or iterators is needed")
        return [(one, None) for one in y]
    if not all(_table(one) for one in y):
        return None
    if not isinstance(u, list | tuple) or len(u) != len(y):
        got = len(u) if isinstance(u, list | tuple) else f"one of type {type(u).__name__}"
        raise InvalidData(f"u: got {got} for {len(y)} experiments in y; as many arrays of inputs are needed, one an experiment")
    return list(zip(y, u, strict=True))


def _table(one: Any) -> bool:
    """Say whether this is a table by itself: two-dimensional, or a frame."""
    if hasattr(one, "columns") or isinstance(one, np.ndarray):
        return hasattr(one, "columns") or one.ndim == 2
    return isinstance(one, list | tuple) and len(one) > 0 and isinstance(one[0], list | tuple | np.ndarray)


def healthy_from(healthy: Any, record: Record, on_progress: Progress | None = None) -> Record:
    """Return the Record of `healthy`: one already, the path of a file, a frame, pieces (y, u), or a pair of arrays (y, u).

    The channels of a file or a frame are those of `record` by their names. Raises InvalidData for channels that are not the same.
    """
    names = {"inputs": record.inputs, "outputs": record.outputs}
    if isinstance(healthy, Record):
        found = healthy
    elif isinstance(healthy, tuple) and len(healthy) == 2:
        found = record_from(*healthy, **names, on_progress=on_progress)
    elif isinstance(healthy, str | os.PathLike) or hasattr(healthy, "columns") or hasattr(healthy, "__iter__"):
        found = record_from(healthy, **names, on_progress=on_progress)
    else:
        raise InvalidData(f"healthy: got {shorten(healthy)}; a number of samples is needed, or a record, a path, or a pair (y, u)")
    if (found.inputs, found.outputs) != (record.inputs, record.outputs):
        raise InvalidData(
            f"healthy: got the channels {', '.join(map(shorten, found.names[:6]))} beside {', '.join(map(shorten, record.names[:6]))}: "
            "both records need the same inputs and outputs"
        )
    if found.offset.any():
        raise InvalidData("healthy: got a record about its means; give the samples as they were measured")
    if found.lengths:
        raise InvalidData(f"healthy: got {len(found.lengths)} experiments; give one without fault, and the others as experiments")
    return found


def joined(healthy: Record, record: Record) -> Record:
    """Return one record of the samples of both, the healthy ones first, as an experiment of their own; both are copied."""
    return side_by_side([healthy, record])
