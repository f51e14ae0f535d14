"""This reads measured data from files: named columns of CSV, Parquet, NPZ, NPY and MAT files as inputs and outputs.

read_record     the chosen channels of a file, or of a folder of Parquet files, as a Record
read_stretches  the stretches of a file between rows that are not whole, as Records
FORMATS         suffix -> format
READERS         format -> the function that reads it, at the end of the file

A channel is chosen by its column's name, or by a selector of a matrix (`selectors.py`; NPZ, NPY, MAT, and text without a line of names; in
NPY and text the matrix is called `data`). The file is only read. Everything wrong raises InvalidInput: what was got, what is needed,
what to try.

No more of a file than a piece is held in memory: text goes by lines, Parquet by the pages of its columns, NPY by a memory map, large
arrays of an NPZ by a memory map of what is unpacked among the temporary files. MAT is the exception: its variables are compressed as a
whole, so that each one asked for is read as a whole; so are the times of a record.

Times. A column, or an array, that is named as `clocks` knows it (time, t, "time [ms]", timestamp, date, ..) and is not chosen as a channel
tells the sample time; nothing else is done with it, and one that holds no times is left alone.
"""

from __future__ import annotations

import io
import mmap
import os
import re
import shlex
import shutil
import tempfile
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from math import prod
from pathlib import Path
from typing import Any

import numpy as np
import psutil
from numpy.typing import NDArray

from ...base.arrays import Array
from ...base.errors import InvalidData, InvalidInput, in_file, quote_path, shorten
from ...base.others_text import printable
from ...base.progress import Progress, silent
from ...base.regular_files import open_regular
from ...base.sheets import counted
from .clocks import Clock, first_clock, time_name, whole_clock
from .damage import from_library, readable, unpacks_to
from .hdf5 import hdf5_arrays
from .parts import ParquetParts, parts_of
from .records import Record, RecordWriter
from .selectors import MOST_NAMED, Missing, labels_of, missing, named_once, picked, quoted, split_names
from .text_tables import TextTable
from .validation import PIECE, first_not_finite

OnRead = Callable[[int, int], None]

FORMATS = {
    ".csv": "text", ".tsv": "text", ".txt": "text", ".dat": "text",
    ".parquet": "Parquet", ".pq": "Parquet", ".npz": "NPZ", ".npy": "NPY", ".mat": "MAT",
}  # fmt: skip
MATRIX = "data"
MAPPED = 1 << 20  # bytes of an array above which it is mapped, not read


@dataclass(frozen=True)
class _Opened:
    """What a reader found: the channels of each selector, whether an output is known to float32 only, rows (any, sum of widths) in
    time's order, and what a time column says of them."""

    widths: tuple[int, ...]
    single: bool
    rows: Iterator[Array]
    clock: Clock | None = None


def read_record(
    path: str | os.PathLike[str], *, inputs: str | Sequence[str], outputs: str | Sequence[str], on_progress: Progress | None = None
) -> Record:
    """Return the record in a file: some of its named columns as inputs, others as outputs, ready for `identify`.

    Rows are samples, in the order of time and in the file's units, and every number must be finite.

    Parameters
    ----------
    path : str or path
        Ends in .csv, .tsv, .txt, .dat, .parquet, .pq, .npz, .npy or .mat, or is a folder of Parquet files with the same columns, one record
        in parts, in the order of the numbers in their names.
    inputs, outputs : str or list of str
        n_u and p channels, by the names of columns or, for matrices, as NAME[:,j]; a text may hold several names, separated by commas, and
        a name with a comma stands in double quotes.
    on_progress : callable, optional
        Hears (stage, done, total).

    Returns
    -------
    Record
        Its `len` is the number of samples; `clock` is from a column of times or dates that is no channel. It is read in pieces and need not
        fit into memory (a MAT file must).

    Raises
    ------
    InvalidInput
        A file that cannot be read, a channel that is not there or is named twice, numbers that are not finite.

    Examples
    --------
    >>> import faultspace as fs, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp(), "small.csv")
    >>> _ = path.write_text("valve,level\\n0.0,1.0\\n1.0,0.5\\n")
    >>> record = fs.read_record(path, inputs="valve", outputs="level")
    >>> len(record), record.inputs, record.outputs
    (2, ('valve',), ('level',))
    """
    path = os.fspath(path)
    with in_file(path), ExitStack() as stack:
        read_as, found, u_names, y_names = _opened(path, inputs, outputs, on_progress or silent, stack)
        writer = RecordWriter(len(u_names) + len(y_names))
        with readable(read_as):
            for rows in found.rows:
                _finite([*u_names, *y_names], rows, len(writer.store))
                writer.append(rows)
        _some(len(writer.store))
        return writer.record(outputs=y_names, inputs=u_names, format=read_as, single=found.single, clock=found.clock)


def read_stretches(
    path: str | os.PathLike[str], *, inputs: str | Sequence[str], outputs: str | Sequence[str], on_progress: Progress | None = None
) -> list[Record]:
    """Return the whole stretches of a file in which samples are missing, as a list of Records.

    They lie between rows with a cell that is no finite number, and between times at which rows are missing. They are experiments of one
    plant, and go into one answer as such: `identify(parts)`, or `arx_reduction_experiments(parts)` for the model alone.

    Parameters
    ----------
    path, inputs, outputs, on_progress
        As of `read_record`.

    Returns
    -------
    list of Record
        In the order of time, each with at least one sample, in the file's units, with the sample time where a column tells it.

    Raises
    ------
    InvalidInput
        As `read_record`, but for numbers that are not finite; and where no row is whole.

    Examples
    --------
    >>> import faultspace as fs, pathlib, tempfile
    >>> from faultspace.numeric import read_stretches
    >>> path = pathlib.Path(tempfile.mkdtemp(), "small.csv")
    >>> _ = path.write_text("valve,level\\n0.0,1.0\\n1.0,0.5\\n1.0,\\n0.0,0.2\\n")
    >>> [len(part) for part in read_stretches(path, inputs="valve", outputs="level")]
    [2, 1]
    """
    path = os.fspath(path)
    with in_file(path), ExitStack() as stack:
        read_as, found, u_names, y_names = _opened(path, inputs, outputs, on_progress or silent, stack)
        writers: list[RecordWriter] = []
        clock = None if found.clock is None else whole_clock(found.clock)
        gaps = np.array([] if found.clock is None else found.clock.gaps, dtype=int)
        going, start = False, 0
        with readable(read_as):
            for rows in found.rows:
                whole = np.asarray(np.isfinite(rows).all(axis=1))
                ends = np.union1d(np.flatnonzero(np.diff(whole)) + 1, gaps[(gaps > start) & (gaps < start + len(rows))] - start)
                for part in np.split(np.arange(len(rows)), ends):
                    if len(part) and whole[part[0]]:
                        if not going or start + part[0] in gaps:
                            writers.append(RecordWriter(len(u_names) + len(y_names)))
                        writers[-1].append(rows[part])
                    going = bool(len(part) and whole[part[0]])
                start += len(rows)
        _some(len(writers))
        return [writer.record(outputs=y_names, inputs=u_names, format=read_as, single=found.single, clock=clock) for writer in writers]


def _opened(
    path: str, inputs: str | Sequence[str], outputs: str | Sequence[str], heard: Progress, stack: ExitStack
) -> tuple[str, _Opened, list[str], list[str]]:
    """Return the format, the chosen channels of a file, open until the stack closes, and the names of inputs and outputs."""
    chosen = {"inputs": split_names(inputs), "outputs": split_names(outputs)}
    names = [*chosen["inputs"], *chosen["outputs"]]
    named_once(chosen["inputs"], chosen["outputs"])
    in_parts = os.path.isdir(path)
    if not in_parts:
        open_regular(path, f"a data file: {', '.join(FORMATS)}").close()
    read_as = "Parquet" if in_parts else FORMATS.get(Path(path).suffix.lower())
    if read_as is None:
        suffix = shorten(Path(path).suffix)
        raise InvalidInput(f"got a file whose name ends in {suffix}, expected {', '.join(FORMATS)}: rename or convert it")

    def read(wanted: Sequence[str]) -> _Opened:
        return READERS[read_as](Path(path), wanted, lambda done, total: heard(f"reading {quote_path(path)}", done, total), stack)

    with readable(read_as):
        if not (chosen["inputs"] and chosen["outputs"]):
            raise nothing_chosen(path, chosen["inputs"], chosen["outputs"], read)
        found = read(names)
        found = replace(found, rows=_even(found.rows))
    labels = [labels_of(name, width) for name, width in zip(names, found.widths, strict=True)]
    u_names = [label for group in labels[: len(chosen["inputs"])] for label in group]
    y_names = [label for group in labels[len(chosen["inputs"]) :] for label in group]
    named_once(u_names, y_names)
    return read_as, found, u_names, y_names


def _even(pieces: Iterator[Array]) -> Iterator[Array]:
    """Yield the same rows PIECE at a time, so that no sum of them depends on how a file is laid out, or in which parts it came."""
    kept: list[Array] = []
    held = 0
    for rows in pieces:
        kept.append(rows)
        held += len(rows)
        if held >= PIECE:
            together = np.concatenate(kept)
            whole = held - held % PIECE
            yield from (together[start : start + PIECE] for start in range(0, whole, PIECE))
            kept, held = [together[whole:].copy()], held - whole
    if held:
        yield np.concatenate(kept)


def _finite(labels: Sequence[str], rows: Array, first: int) -> None:
    """Refuse what is no finite number; the rows begin with sample `first`."""
    if wrong := first_not_finite(rows):
        k, j = wrong
        what = "no number (NaN or empty)" if np.isnan(rows[k, j]) else "infinite"
        raise InvalidInput(
            f"channel {shorten(labels[j])} is {what} at sample {first + k} (counted from 0), expected finite numbers: cut the record "
            "before or after, fill the samples in, or take the parts between as experiments (read_stretches, or --gaps)"
        )


def _text(path: Path, names: Sequence[str], on_read: OnRead, stack: ExitStack) -> _Opened:
    table, names = TextTable.opened(path), list(map(printable, names))
    wanted: list[list[int]] = []
    for name in names:
        if table.names is not None:
            if name not in table.names:
                raise missing(name, table.names, f"column (separated by {table.separator_name})")
            wanted.append([table.names.index(name)])
        else:
            # The first line of values tells the width: a selector on it tells the columns.
            stand_in = np.tile(np.arange(table.width), (2, 1))
            chosen = picked({MATRIX: stand_in}, name, "matrix; the file has no line of names, so its columns are")
            if not np.array_equal(chosen[0], chosen[-1]):
                raise InvalidInput(f"got {shorten(name)}, expected columns {MATRIX}[:,j] of a file without a line of names")
            wanted.append([int(j) for j in np.atleast_1d(chosen[0])])
    places = [place for group in wanted for place in group]
    there = table.names or ()
    units = dict(zip(there, table.units or (), strict=False))
    clock = first_clock([name for name in there if name not in names], lambda name: table.column(there.index(name)), units)
    return _Opened(tuple(map(len, wanted)), False, table.pieces(places, on_read), clock)


def _parquet(path: Path, names: Sequence[str], on_read: OnRead, stack: ExitStack) -> _Opened:
    parts = ParquetParts(parts_of(path) if path.is_dir() else [path], names)
    clock = first_clock([name for name in parts.columns if name not in names], parts.column)
    return _Opened((1,) * len(names), parts.single, parts.rows(PIECE, on_read), clock)


def _npz(path: Path, names: Sequence[str], on_read: OnRead, stack: ExitStack) -> _Opened:
    with from_library("NPZ", "arrays of numbers as numpy.savez writes them"):
        if not zipfile.is_zipfile(path):
            with open(path, "rb") as stream:
                np.load(stream, allow_pickle=False)  # complains of what is no data at all
            raise InvalidInput("got a single array under the name of an archive, expected an NPZ file: name it .npy, or use numpy.savez")
        archive = stack.enter_context(zipfile.ZipFile(path))
        members = {name.removesuffix(".npy"): name for name in archive.namelist()}
    folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="faultspace-")))
    arrays = _Lazily(list(members), lambda name: _member(archive, members[name], folder))
    return _timed(_side_by_side([_signal(picked(arrays, name, "array"), name) for name in names], names, on_read), arrays, names)


def _member(archive: zipfile.ZipFile, name: str, folder: Path) -> Any:
    """Return an array of the archive: read where it is small, else unpacked and mapped."""
    there = archive.getinfo(name)
    if there.file_size > MAPPED:
        unpacks_to(there.file_size, there.compress_size, shutil.disk_usage(folder).free, "the folder for temporary files")
    with from_library("NPZ", "arrays of numbers as numpy.savez writes them"):
        with archive.open(name) as packed:
            if there.file_size <= MAPPED:
                return np.load(io.BytesIO(packed.read()), allow_pickle=False)
            unpacked = folder / f"{len(list(folder.iterdir()))}.npy"
            with open(unpacked, "wb") as stream:
                shutil.copyfileobj(packed, stream, 1 << 20)
        return np.load(unpacked, mmap_mode="r", allow_pickle=False)


def _npy(path: Path, names: Sequence[str], on_read: OnRead, stack: ExitStack) -> _Opened:
    with from_library("NPY", "an array of numbers as numpy.save writes it"):
        small = path.stat().st_size <= MAPPED
        array = np.load(path, mmap_mode=None if small else "r", allow_pickle=False)
    if not isinstance(array, np.ndarray):
        array.close()
        raise InvalidInput("got an archive under the name of a single array, expected an NPY file: name it .npz")
    if array.ndim == 0:
        raise InvalidInput("got a single number, expected a matrix with a row a sample")
    what = f"array; the one of an NPY file is called {MATRIX}, it is not"
    return _side_by_side([_signal(picked({MATRIX: array}, name, what), name) for name in names], names, on_read)


def _mat(path: Path, names: Sequence[str], on_read: OnRead, stack: ExitStack) -> _Opened:
    from scipy.io import loadmat, whosmat

    expected = "a MAT file as MATLAB saves it"
    with from_library("MAT", expected):
        try:
            there = {name: prod(shape) for name, shape, _ in whosmat(path)}
        except NotImplementedError:  # version 7.3
            there = None

    def read(name: str) -> Any:
        # A number has one byte at the least.
        unpacks_to((there or {})[name], path.stat().st_size, psutil.virtual_memory().available, "memory")
        with from_library("MAT", expected):
            return loadmat(path, variable_names=[name])[name]

    arrays: Mapping[str, Any] = hdf5_arrays(path, stack) if there is None else _Lazily(list(there), read)
    return _timed(_side_by_side([_signal(picked(arrays, name, "variable"), name) for name in names], names, on_read), arrays, names)


def _side_by_side(signals: Sequence[NDArray[Any]], names: Sequence[str], on_read: OnRead) -> _Opened:
    """Return signals (N, k) of one length, joined piece by piece."""
    samples = len(signals[0])
    if any(len(values) != samples for values in signals):
        sizes = ", ".join(f"{name} {len(values)}" for name, values in zip(names, signals, strict=True))
        raise InvalidData(f"got channels of unequal length ({sizes}), expected as many samples of each: cut them to those they share")

    def rows() -> Iterator[Array]:
        for first in range(0, samples, PIECE):
            part = slice(first, first + PIECE)
            yield np.hstack([np.asarray(values[part], dtype=np.float64) for values in signals])
            for values in signals:
                _forget(values)
            on_read(min(first + PIECE, samples), samples)

    single = any(values.dtype in (np.float16, np.float32) for values in signals)
    return _Opened(tuple(values.shape[1] for values in signals), single, rows())


def _timed(opened: _Opened, arrays: Mapping[str, Any], names: Sequence[str]) -> _Opened:
    """Return what was opened with the clock of an array of times, where there is one of as many numbers as there are samples."""
    chosen = {name.partition("[")[0] for name in names}
    clock = first_clock([name for name in arrays if name not in chosen], lambda name: np.ravel(np.asarray(arrays[name])))
    return replace(opened, clock=clock)


def _forget(values: Any) -> None:
    """Give the pages of a memory map back, which would else count as memory used as long as there is enough."""
    while isinstance(values, np.ndarray):
        values = values.base
    if isinstance(values, mmap.mmap) and hasattr(mmap, "MADV_DONTNEED"):
        values.madvise(mmap.MADV_DONTNEED)


class _Lazily(Mapping[str, Any]):
    """The mapping gives arrays by name; each is read when it is asked for and then kept."""

    def __init__(self, names: Sequence[str], read: Callable[[str], Any]) -> None:
        self._names, self._read = list(names), read
        self._kept: dict[str, Any] = {}

    def __getitem__(self, name: str) -> Any:
        if name not in self._kept:
            self._kept[name] = self._read(name)
        return self._kept[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


def _signal(values: Any, name: str) -> NDArray[Any]:
    """Return the values as a view (N, k) of their own type: a vector is one channel, whichever way it lies."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiub":
        hint = "its real and imaginary part as two channels" if array.dtype.kind == "c" else "a plain array of numbers"
        raise InvalidInput(f"{shorten(name)} holds values of type {array.dtype}, expected {hint}")
    if array.ndim == 2 and 1 in array.shape:
        array = array.reshape(-1)
    if array.ndim == 1:
        array = array[:, np.newaxis]
    if array.ndim != 2:
        shape = " x ".join(map(str, array.shape))
        raise InvalidInput(f"{shorten(name)} is {shape}, expected one channel or (samples, channels): choose with NAME[:,j] or NAME[i,j]")
    _some(len(array))
    if array.shape[1] > len(array):
        rows, columns = array.shape
        advice = f"{name}[i,:] is row i" if "[" not in name else "write it transposed"
        looks = f"{counted(rows, 'sample')} of {counted(columns, 'channel')} and looks transposed"
        raise InvalidInput(f"{shorten(name)} has {looks}, expected a row a sample: {advice}")
    return array


def _some(samples: int) -> None:
    if samples == 0:
        raise InvalidInput("got no samples, expected a record of many")


READERS: dict[str, Callable[[Path, Sequence[str], OnRead, ExitStack], _Opened]] = {
    "text": _text, "Parquet": _parquet, "NPZ": _npz, "NPY": _npy, "MAT": _mat,
}  # fmt: skip


NOBODYS = "\0"  # no file has a channel of this name
ACTING = re.compile(r"(x?mv|u|in|inputs?|cmd|command|valve|heater|pump|voltage)[ _.\-\[(]*\d*.?", re.IGNORECASE)
"""Names that inputs often have: a guess, which is told as an example only."""


def nothing_chosen(path: str, inputs: Sequence[str], outputs: Sequence[str], read: Callable[[Sequence[str]], object]) -> InvalidInput:
    """Return the refusal; `read` opens the file for channels of these names, and raises Missing for one that it has not."""
    there: tuple[str, ...] = ()
    columns = True
    try:
        read([NOBODYS])
    except Missing as found:
        there, columns = found.there, found.columns
    lacking = " and ".join(f"no {option}" for option, names in (("inputs", inputs), ("outputs", outputs)) if not names)
    clock = time_name(there)
    free = [name for name in there if name not in {*inputs, *outputs, clock}]
    listed = ", ".join([*map(quoted, free[:MOST_NAMED]), *([f"... ({len(free)} in all)"] if len(free) > MOST_NAMED else [])])
    told = f"left are {listed}" if inputs or outputs else f"the file has {listed}"
    time = f", and times in {clock}" if clock else ""
    if len(free) == 1 and not columns:
        told, free = f"there is one matrix, {free[0]}, with columns {free[0]}[:,j] counted from 0", [f"{free[0]}[:,0]", f"{free[0]}[:,1:]"]
    if len(free) + len(inputs) + len(outputs) < 2 or not free:
        what = f"{told}{time}" if free else f"no channel is left of {counted(len(there), 'channel')}"
        return InvalidInput(f"got {lacking}, and {what}; a model needs an input, which acts on the plant, and an output, which is measured")
    u, y = _example(free, list(inputs), list(outputs))
    command = f"faultspace identify {shlex.quote(path)} --inputs {shlex.quote(u)} --outputs {shlex.quote(y)} --out answer"
    return InvalidInput(f"got {lacking}, expected what acts on the plant and what is measured; {told}{time}: choose, as in {command}")


def _example(free: list[str], inputs: list[str], outputs: list[str]) -> tuple[str, str]:
    """Return a choice out of the free channels: those named, the rest for the others, by their names where neither is named."""
    if not inputs and not outputs:
        inputs = [name for name in free if ACTING.fullmatch(name.strip())]
        inputs = inputs if 0 < len(inputs) < len(free) else free[:1]
    outputs = outputs or [name for name in free if name not in inputs]
    inputs = inputs or [name for name in free if name not in outputs]
    return ",".join(map(quoted, inputs[:MOST_NAMED])), ",".join(map(quoted, outputs[:MOST_NAMED]))
