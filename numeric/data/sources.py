"""This makes a Record of whatever holds one: arrays, data frames, files, pieces that come one after the other.

record_from     the Record of arrays, frames, a path, pieces (y, u) or a Record
Source          what the first argument may be

Everything is written into the store of a Record and read from there, in the same pieces: an array is a record of one piece, so that the
same numbers give the same answer to the last bit however they come.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike

from ...base.errors import InvalidData, shorten
from ...base.progress import Progress
from ...base.sheets import counted
from .clocks import Clock, clock_from, first_clock, time_name
from .files import read_record
from .records import Record, RecordWriter
from .selectors import named_once, split_names
from .validation import checked_pieces, two_dimensional

Source = ArrayLike | str | os.PathLike[str] | Record | Iterable[tuple[ArrayLike, ArrayLike]]


def record_from(
    y: Any,
    u: Any = None,
    *,
    inputs: str | Sequence[str] | None = None,
    outputs: str | Sequence[str] | None = None,
    on_progress: Progress | None = None,
) -> Record:
    """Return the Record of whatever holds one: arrays, data frames, a file, pieces or a Record. It converts only and has no source.

    Parameters
    ----------
    y, u : array_like or data frame, (N, p) and (N, n_u)
        Columns of a frame give the names, one row a sample, in any units. An index of dates, of durations, or that is named as a time, and
        a column of times in a frame of both, give the `clock`. Without `u`, `y` holds both: a Record, the path of a file, a frame, or
        pieces (y, u) in the order of time, which are read once.
    inputs, outputs : str or list of str, optional
        Channels of a file or a frame; otherwise names, by default u1, u2, .. and y1, y2, ..; a text of names has commas between them.
    on_progress : callable, optional
        Hears (stage, done, total).

    Returns
    -------
    Record
        With `len`, the number of samples, `inputs` and `outputs`.

    Raises
    ------
    InvalidData
        What holds no record.
    InvalidInput
        A file that cannot be read.

    Examples
    --------
    >>> from faultspace.numeric import record_from
    >>> record = record_from([[1.0], [2.0]], [[0.0], [1.0]], outputs=["level"])
    >>> len(record), record.inputs, record.outputs
    (2, ('u1',), ('level',))
    """
    inputs, outputs = _listed(inputs), _listed(outputs)
    if u is not None:
        if isinstance(y, Record | str | os.PathLike):
            raise InvalidData(f"u: got one beside y of type {type(y).__name__}, which holds the inputs already: leave u out")
        names = _columns(y) if outputs is None else outputs, _columns(u) if inputs is None else inputs
        single = two_dimensional(_values(y), "y").dtype == np.float32
        return _written([(_values(y), _values(u))], names, single, _one_clock(y, u))
    if isinstance(y, Record):
        if inputs is not None or outputs is not None:
            raise InvalidData("inputs, outputs: a record has its channels' names already: leave them out")
        return y
    if isinstance(y, str | os.PathLike):
        if inputs is None or outputs is None:
            raise InvalidData("inputs, outputs: a file needs the names of both: pass inputs=[...], outputs=[...]")
        return read_record(os.fspath(y), inputs=inputs, outputs=outputs, on_progress=on_progress)
    if _columns(y) is not None:
        if inputs is None or outputs is None:
            raise InvalidData("u is missing: pass it, or name the columns of the frame that are inputs and outputs")
        record = record_from(_chosen(y, outputs), _chosen(y, inputs))
        return record if record.clock is not None else replace(record, clock=_column_clock(y, [*outputs, *inputs]))
    if isinstance(y, np.ndarray) or not isinstance(y, Iterable):
        raise InvalidData(f"u is missing: got y of type {type(y).__name__} alone; pass u, or pieces (y, u), a path or a record")
    return _written(cast(Iterable[tuple[ArrayLike, ArrayLike]], y), (outputs, inputs), False)


def _written(
    chunks: Iterable[tuple[ArrayLike, ArrayLike]],
    names: tuple[Sequence[str] | None, Sequence[str] | None],
    single: bool,
    clock: Clock | None = None,
) -> Record:
    writer, widths = None, (0, 0)
    for y, u in checked_pieces(_pairs(chunks)):
        if writer is None:
            widths = (y.shape[1], u.shape[1])
            writer = RecordWriter(sum(widths))
        if widths != (y.shape[1], u.shape[1]):
            raise InvalidData(
                f"a piece has {counted(u.shape[1], 'input')} and {counted(y.shape[1], 'output')} "
                f"where the first has {widths[1]} and {widths[0]}: all need the "
                "same"
            )
        writer.append(np.hstack([u, y]))
    if writer is None:
        raise InvalidData("got no data, since the iterable of pieces (y, u) is empty: give at least one piece")
    outputs, inputs = (
        list(given) if given is not None else [f"{letter}{i + 1}" for i in range(width)]
        for given, letter, width in zip(names, "yu", widths, strict=True)
    )
    for what, given, width in (("outputs", outputs, widths[0]), ("inputs", inputs, widths[1])):
        if len(given) != width:
            raise InvalidData(
                f"{what}: got {counted(len(given), 'name')} for {counted(width, 'channel')}: one name "
                f"a channel is needed, in the order of the columns; got "
                f"{', '.join(map(shorten, given[:12])) or 'none'}"
            )
    named_once(inputs, outputs)
    return writer.record(outputs=outputs, inputs=inputs, format="arrays", single=single, clock=clock)


def _pairs(chunks: Iterable[Any]) -> Iterable[tuple[ArrayLike, ArrayLike]]:
    for number, chunk in enumerate(chunks):
        if not isinstance(chunk, tuple | list) or len(chunk) != 2:
            raise InvalidData(f"piece {number} is of type {type(chunk).__name__}, where a pair (y, u) is needed; or is u missing?")
        yield _values(chunk[0]), _values(chunk[1])


def _listed(given: str | Sequence[str] | None) -> list[str] | None:
    """Return names as a list: a text is one name, or names separated by commas."""
    if given is None or isinstance(given, str):
        return None if given is None else split_names(given)
    wrong = [name for name in given if not isinstance(name, str)]
    if wrong:
        raise InvalidData(f"inputs, outputs: got {shorten(wrong[0])} as the name of a channel, which is no text")
    return list(given)


def _one_clock(y: Any, u: Any) -> Clock | None:
    """Return what the indexes of two frames say of time. Raises InvalidData where they are of two minds: frames are read row by row."""
    clocks = [_index_clock(values) for values in (y, u)]
    if None not in clocks and len(y) == len(u) and not np.array_equal(np.asarray(y.index), np.asarray(u.index)):
        raise InvalidData("y and u: their indexes have unequal times; rows of one time are needed: join the frames first")
    return clocks[0] or clocks[1]


def _index_clock(values: Any) -> Clock | None:
    """Return what the index of a frame or series says of time, where it holds dates or durations, or is named as a time."""
    index = getattr(values, "index", None) if hasattr(values, "to_numpy") else None
    if index is None or not hasattr(index, "to_numpy"):
        return None
    name = index.name if isinstance(index.name, str) else ""
    times = np.asarray(index.to_numpy())
    return clock_from(times, name or "the index") if times.dtype.kind in "Mm" or time_name([name]) else None


def _column_clock(frame: Any, chosen: Sequence[str]) -> Clock | None:
    """Return what a column of times, or else the index, of a frame says."""
    by_name = dict(zip(_columns(frame) or [], frame.columns, strict=True))
    return first_clock([name for name in by_name if name not in chosen], lambda name: frame[by_name[name]].to_numpy())


def _columns(values: Any) -> list[str] | None:
    """Return the names of a frame's columns, or of a series; None for what has none, as columns that are merely numbered."""
    if not hasattr(values, "to_numpy") or not (hasattr(values, "columns") or hasattr(values, "name")):
        return None
    names = list(values.columns) if hasattr(values, "columns") else [values.name]
    return None if all(name is None or isinstance(name, int) for name in names) else [str(name) for name in names]


def _values(values: Any) -> Any:
    return values.to_numpy() if hasattr(values, "to_numpy") else values


def _chosen(frame: Any, names: Sequence[str]) -> Any:
    there = _columns(frame) or []
    missing = [name for name in names if name not in there]
    if missing or not names:
        raise InvalidData(f"the frame has no column {missing[0] if missing else 'chosen'}; it has {', '.join(there[:12])}")
    return frame[list(names)]
