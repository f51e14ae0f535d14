"""A record without fault before another one of the same plant: both become one, which begins with the healthy samples.

healthy_from    the healthy record, of whatever holds one, with the channels of the other
joined          both in one record, the healthy samples first
"""

from __future__ import annotations

import os
from typing import Any

from ...base.errors import InvalidData, shorten
from ...base.progress import Progress
from .records import Record, RecordWriter
from .sources import record_from


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
    return found


def joined(healthy: Record, record: Record) -> Record:
    """Return one record of the samples of both, the healthy ones first; both are copied."""
    writer = RecordWriter(record.store.width)
    for part in (healthy, record):
        for rows in part.store.pieces(0, len(part)):
            writer.append(rows)
    single = healthy.single or record.single
    return writer.record(outputs=record.outputs, inputs=record.inputs, format=record.format, single=single)
