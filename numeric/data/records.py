"""This is a measured record that need not fit into memory: written once, piece by piece, then read in pieces as often as a method needs it.

A record may hold several experiments of one plant, one after the other: their samples follow each other in the store and not in time.

stored          a SampleStore of an array
in_memory       the samples of a result that keeps them in a store, as an array
SampleStore     rows (N, k) of floats: in memory while they are few, beyond IN_MEMORY bytes in a temporary file
Record          inputs and outputs in one store, their names, and what is known of every channel; iterating gives pieces (y, u)
side_by_side    one Record of several, each an experiment of its own
Moments         least and greatest values, means and deviations of rows that come in pieces
RecordWriter    takes the rows [u, y] as they come and makes the Record
recorded        a Record from arrays
Passes          the pieces of a Record, telling how far each reading of them has come

A text file is parsed once: what is read again and again are its numbers. They take 8 bytes each in the folder for temporary files
(TMPDIR names another one), and the file vanishes with the store.
"""

from __future__ import annotations

import os
import tempfile
import weakref
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ...base.arrays import Array
from ...base.errors import InvalidInput
from ...base.others_text import printable
from ...base.progress import Progress
from ...base.sheets import Shown, counted, several
from .clocks import Clock
from .plain import by_name, plain
from .validation import PIECE

IN_MEMORY = 1 << 24
NUMBER = 8  # bytes
MOST_NAMED = 12  # names that a record shows of its channels


class SampleStore:
    """The store keeps rows of `width` floats, which are appended and read by number; `len` is how many there are. What is read cannot be
    written to."""

    def __init__(self, width: int) -> None:
        self.width = width
        self._count = 0
        self._file = tempfile.SpooledTemporaryFile(max_size=IN_MEMORY)  # noqa: SIM115
        # The file is closed with its owner, and not left to the interpreter, which would warn of it.
        weakref.finalize(self, self._file.close)

    def __len__(self) -> int:
        return self._count

    def append(self, rows: Array) -> None:
        """Append rows (any, width) behind the others. Raises InvalidInput where the disk is full."""
        try:
            self._file.seek(0, os.SEEK_END)
            self._file.write(np.ascontiguousarray(rows, dtype=np.float64).data)
        except OSError as error:
            needed = NUMBER * self.width * (self._count + len(rows))
            raise InvalidInput(
                f"got more than {needed} bytes of numbers, which do not fit into the folder for temporary files {tempfile.gettempdir()} "
                f"({error.strerror or error}): expected room there, or TMPDIR naming a folder that has it"
            ) from None
        self._count += len(rows)

    def read(self, first: int, last: int) -> Array:
        """Return rows first .. last - 1."""
        last = min(last, self._count)
        self._file.seek(NUMBER * self.width * first)
        content = self._file.read(NUMBER * self.width * max(last - first, 0))
        return np.frombuffer(content, dtype=np.float64).reshape(-1, self.width)

    def pieces(self, first: int = 0, last: int | None = None) -> Iterator[Array]:
        """Yield rows first .. last - 1, PIECE at a time."""
        end = self._count if last is None else min(last, self._count)
        for start in range(first, end, PIECE):
            yield self.read(start, min(start + PIECE, end))


def stored(rows: Array) -> SampleStore:
    """Return a store of the rows (N, k)."""
    store = SampleStore(rows.shape[1])
    store.append(rows)
    return store


class Stored(Protocol):
    """A result that keeps its samples in a `store`, as the residual of a model does."""

    @property
    def store(self) -> SampleStore:
        """Return the samples (N, k)."""


def in_memory(rows: ArrayLike | SampleStore | Stored) -> Any:
    """Return the samples of a store, or of a result that keeps them in one, as an array (N, k); an array as it is."""
    store = rows if isinstance(rows, SampleStore) else getattr(rows, "store", None)
    return store.read(0, len(store)) if isinstance(store, SampleStore) else rows


@dataclass(frozen=True)
class Channels:
    """What is known of every channel, inputs before outputs: least and greatest value, mean and standard deviation, each (k,)."""

    least: Array
    greatest: Array
    mean: Array
    deviation: Array


@dataclass(frozen=True, eq=False, repr=False)
class Record(Shown):
    """A Record is a measured record: y (N, p) and u (N, n_u) with the names of their channels, read in pieces and never held as a whole.

    `len` is the number of samples, `outputs` and `inputs` are the names, `y` and `u` read all samples, and iterating gives pieces (y, u) in
    the order of time. The `store` holds rows [u, y] of finite numbers in the units that they came in, `offset` (k,) is taken off every row
    that is read, and `format` says how they came. `single` says whether an output was given in float32, so that it is known to float32
    rounding only; `length` samples of the store, from number `first` on, belong to the record (None: all). `clock` is what a time column
    says of the steps, None where there is none. Where the record holds several experiments, one after the other, `lengths` has the samples
    of each, and `experiments` gives each of them as a Record; it is empty for one. Raises InvalidInput where the disk has no room for what
    is written.

    >>> from faultspace.numeric import record_from
    >>> record = record_from([[1.0], [3.0]], [[0.0], [1.0]])
    >>> len(record), record.y.tolist(), record.about_means().y.tolist()
    (2, [[1.0], [3.0]], [[-1.0], [1.0]])
    """

    store: SampleStore
    outputs: tuple[str, ...]
    inputs: tuple[str, ...]
    format: str
    channels: Channels
    offset: Array
    single: bool = False
    length: int | None = None
    clock: Clock | None = None
    first: int = 0
    lengths: tuple[int, ...] = ()

    def __len__(self) -> int:
        return len(self.store) - self.first if self.length is None else self.length

    @property
    def title(self) -> str:
        """Return what the record is, on one short line."""
        of = f" of {len(self.lengths)} experiments" if self.lengths else ""
        return f"{counted(len(self), 'sample')}{of}, inputs {several(self.inputs, MOST_NAMED)}, outputs {several(self.outputs, MOST_NAMED)}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield one line a channel, inputs before outputs."""
        yield "read from", self.format
        if self.lengths:
            yield "samples of the experiments", ", ".join(map(str, self.lengths))
        if self.clock is not None:
            yield "sample time", f"{self.clock.dt:.6g} s, by {self.clock.source}"
        yield "", "".join(f"{name:>10}" for name in ("least", "greatest", "mean", "deviation"))
        known = self.channels
        for j, name in enumerate(self.names):
            moved = (part[j] - self.offset[j] for part in (known.least, known.greatest, known.mean))
            row = (*moved, known.deviation[j])
            yield f"{'input' if j < self.n_u else 'output'} {name}", "".join(f"{value:>10.3g}" for value in row)

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict of everything but the samples."""
        known, clock = self.channels, self.clock
        return {
            "samples": len(self),
            "experiments": list(self.lengths) or [len(self)],
            **by_name(self, "inputs", "outputs", "format"),
            "dt": None if clock is None else clock.dt,
            **{name: plain(getattr(known, name) - self.offset) for name in ("least", "greatest", "mean")},
            "deviation": plain(known.deviation),
        }

    def __iter__(self) -> Iterator[tuple[Array, Array]]:
        for rows in self.rows():
            yield self._split(rows)

    def rows(self) -> Iterator[Array]:
        """Yield the samples [u, y] as they stand in the store, in pieces."""
        return self.store.pieces(self.first, self.first + len(self))

    def stretch(self, first: int, last: int) -> tuple[Array, Array]:
        """Return y and u of samples first .. last - 1."""
        return self._split(self.store.read(self.first + first, self.first + min(last, len(self))))

    @property
    def bounds(self) -> tuple[tuple[int, int], ...]:
        """Return (first, last) of each experiment, whose samples are first .. last - 1; those of the whole where there is one."""
        ends = np.cumsum(self.lengths).tolist() or [len(self)]
        return tuple(zip([0, *ends], ends, strict=False))

    @cached_property
    def experiments(self) -> tuple[Record, ...]:
        """Return each experiment as a record of its own, or the record itself where it is one; nothing is copied."""
        return tuple(self.part(*bounds) for bounds in self.bounds) if self.lengths else (self,)

    def stretches(self, first: int, last: int) -> list[tuple[Array, Array]]:
        """Return y and u of samples first .. last - 1, a pair for each experiment that has some of them."""
        inside = [(max(first, start), min(last, stop)) for start, stop in self.bounds]
        return [self.stretch(start, stop) for start, stop in inside if start < stop]

    @property
    def y(self) -> Array:
        """Return all outputs (N, p), in memory."""
        return self.stretch(0, len(self))[0]

    @property
    def u(self) -> Array:
        """Return all inputs (N, n_u), in memory."""
        return self.stretch(0, len(self))[1]

    @property
    def p(self) -> int:
        """Return the number of outputs."""
        return len(self.outputs)

    @property
    def n_u(self) -> int:
        """Return the number of inputs."""
        return len(self.inputs)

    @property
    def names(self) -> tuple[str, ...]:
        """Return all channels, inputs before outputs."""
        return self.inputs + self.outputs

    def about_means(self) -> Record:
        """Return the same record with every channel about its mean."""
        return self.about(self.channels.mean)

    def about_own_means(self) -> Record:
        """Return the record with every channel about its mean in each experiment, whose operating points may differ; several are copied."""
        if not self.lengths:
            return self.about_means()
        writer = RecordWriter(self.store.width)
        for one in self.experiments:
            for rows in one.rows():
                writer.append(rows - one.channels.mean)
        return replace(self, store=writer.store, channels=writer.known(), offset=np.zeros_like(self.offset), length=None, first=0)

    def about(self, means: Array) -> Record:
        """Return the same record with `means` (k,), inputs before outputs, taken off."""
        return replace(self, offset=means)

    def beginning(self, length: int) -> Record:
        """Return the first `length` samples as a record of their own, with what is known of their channels; nothing is copied."""
        return self.part(0, length)

    def part(self, first: int, last: int) -> Record:
        """Return samples first .. last - 1 as a record of their own, with what is known of their channels; nothing is copied."""
        known = Moments(self.store.width)
        for rows in self.store.pieces(self.first + first, self.first + last):
            known.add(rows)
        inside = [min(last, stop) - max(first, start) for start, stop in self.bounds]
        lengths = tuple(length for length in inside if length > 0)
        lengths = lengths if len(lengths) > 1 else ()
        return replace(self, channels=known.channels(), first=self.first + first, length=last - first, lengths=lengths)

    def _split(self, rows: Array) -> tuple[Array, Array]:
        rows = rows - self.offset
        return rows[:, self.n_u :], rows[:, : self.n_u]


class Moments:
    """The object gathers what is known of channels whose rows come in pieces; the moments of pieces are merged, not summed up from zero."""

    def __init__(self, width: int) -> None:
        self._count = 0
        self._least, self._greatest = np.full(width, np.inf), np.full(width, -np.inf)
        self._mean, self._squares = np.zeros(width), np.zeros(width)

    def add(self, rows: Array) -> None:
        """Take in rows (1 or more, width)."""
        before, count = self._count, len(rows)
        self._count += count
        self._least, self._greatest = np.minimum(self._least, rows.min(axis=0)), np.maximum(self._greatest, rows.max(axis=0))
        with np.errstate(over="ignore", invalid="ignore"):  # numbers too large are refused by name later on
            mean = rows.mean(axis=0)
            step = mean - self._mean
            self._mean = self._mean + step * count / (before + count)
            self._squares = self._squares + ((rows - mean) ** 2).sum(axis=0) + step**2 * before * count / (before + count)

    def channels(self) -> Channels:
        """Return what is known of the channels from the rows that have come."""
        return Channels(self._least, self._greatest, self._mean, np.sqrt(self._squares / max(self._count, 1)))


class RecordWriter:
    """The writer takes rows [u, y] of finite numbers, and `record` makes the Record of them."""

    def __init__(self, width: int) -> None:
        self.store = SampleStore(width)
        self._known = Moments(width)

    def append(self, rows: Array) -> None:
        """Return rows (any, width). Raises InvalidInput where there is no room."""
        if len(rows):
            self.store.append(rows)
            self._known.add(rows)

    def known(self) -> Channels:
        """Return what is known of the channels from the rows that have been taken."""
        return self._known.channels()

    def record(
        self,
        *,
        outputs: Sequence[str],
        inputs: Sequence[str],
        format: str,
        single: bool = False,
        clock: Clock | None = None,
        lengths: tuple[int, ...] = (),
    ) -> Record:
        """Make the record of the rows that have been taken; `lengths` are the samples of its experiments where there are several."""
        offset = np.zeros(self.store.width)
        y_names, u_names = (tuple(map(printable, names)) for names in (outputs, inputs))
        return Record(self.store, y_names, u_names, format, self.known(), offset, single, clock=clock, lengths=lengths)


def side_by_side(records: Sequence[Record]) -> Record:
    """Return one record of all the experiments of `records`, which have the same channels and are copied as they were measured.

    A single one is returned as it is. The clock is that of the first with one.
    """
    first = records[0]
    if len(records) == 1:
        return first
    writer = RecordWriter(first.store.width)
    for record in records:
        for rows in record.rows():
            writer.append(rows)
    lengths = tuple(stop - start for record in records for start, stop in record.bounds)
    single = any(record.single for record in records)
    clock = next((record.clock for record in records if record.clock is not None), None)
    return writer.record(outputs=first.outputs, inputs=first.inputs, format=first.format, single=single, clock=clock, lengths=lengths)


def recorded(y: ArrayLike, u: ArrayLike, *, outputs: Sequence[str], inputs: Sequence[str]) -> Record:
    """Return the record of arrays y (N, p) and u (N, n_u) of finite numbers."""
    rows = np.hstack([np.asarray(u, dtype=np.float64), np.asarray(y, dtype=np.float64)])
    writer = RecordWriter(rows.shape[1])
    writer.append(rows)
    return writer.record(outputs=outputs, inputs=inputs, format="arrays", single=np.asarray(y).dtype == np.float32)


class Passes:
    """The object gives the pieces of a record any number of times; each reading is reported by its number, as `stage`, pass 1, 2, .."""

    def __init__(self, record: Record, stage: str, on_progress: Progress) -> None:
        self._record, self._stage, self._on_progress = record, stage, on_progress
        self._begun = 0

    def __iter__(self) -> Iterator[tuple[Array, Array]]:
        self._begun += 1
        stage, done = f"{self._stage}, pass {self._begun}", 0
        self._on_progress(stage, 0, len(self._record))
        for y, u in self._record:
            yield y, u
            done += len(y)
            self._on_progress(stage, done, len(self._record))
