"""A folder of Parquet files is one record in parts: here are their order, and the rows of all of them as those of one file.

parts_of        the files of a folder, in natural order; refused where one is missing or none of ours
ParquetParts    one file, or the parts of a folder: columns, rows in pieces, and a column of times as a whole

Names are sorted by their numbers: part-9 stands before part-10. Where they count, a number that is left out is a part that is lost. No more
than one file is open at a time, and no more of it in memory than the pages of its columns.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from ...base.arrays import Array
from ...base.errors import InvalidInput, in_file, shorten
from ...base.regular_files import open_regular
from ...base.writing import reason
from .damage import from_library, readable
from .selectors import Missing, missing

SUFFIXES = (".parquet", ".pq")
BUFFER = 1 << 20  # bytes of a column that Parquet reads at once


def parts_of(folder: Path) -> list[Path]:
    """Return the Parquet files of a folder in natural order; names that begin with a point or an underscore are those of other programs.

    Raises InvalidInput for a folder that cannot be read, has none of them or anything else, and where a number among theirs is left out or
    stands twice.
    """
    try:
        paths = [path for path in folder.iterdir() if not path.name.startswith((".", "_"))]
    except OSError as error:
        raise InvalidInput(f"cannot be read ({reason(error)}), expected a folder of Parquet files") from None
    others = sorted(path.name for path in paths if path.suffix.lower() not in SUFFIXES or path.is_dir())
    if others or not paths:
        got = f"is a directory with {shorten(others[0])} in it" if others else "is a directory without files"
        raise InvalidInput(
            f"{got}, expected a data file, or a folder of Parquet files ({', '.join(SUFFIXES)}), which are one record in parts"
        )
    paths.sort(key=lambda path: (_natural(path.name), path.name))
    _counted_through(paths)
    return paths


def _natural(name: str) -> list[tuple[int, str]]:
    """Return what names are sorted by: texts and numbers by turns, so that like stands against like."""
    return [(int(word), "") if word.isdecimal() else (-1, word) for word in re.split(r"([0-9]+)", name)]


def _counted_through(paths: Sequence[Path]) -> None:
    """Raise InvalidInput where the names differ in one number, which counts, and one is left out or stands twice."""
    words = [_natural(path.name) for path in paths]
    if len({len(each) for each in words}) > 1:
        return
    places = [place for place in range(len(words[0])) if len({each[place] for each in words}) > 1]
    if places and (len(places) > 1 or words[0][places[0]][0] < 0):
        return
    for (before, one), (after, other) in pairwise(zip(paths, words, strict=True)):
        if one == other:
            raise InvalidInput(f"got the parts {shorten(before.name)} and {shorten(after.name)}, expected every number once")
    numbers = [each[places[0]][0] for each in words] if places else []
    steps = [last - first for first, last in pairwise(numbers)]
    if steps and max(steps) > 1 and (min(steps) == 1 or numbers[0] <= 1):  # else they are times, or the like
        place = next(k for k, step in enumerate(steps) if step > 1)
        first, last = numbers[place] + 1, numbers[place + 1] - 1
        lost = f"part {first} is" if first == last else f"parts {first} to {last} are"
        raise InvalidInput(
            f"{lost} missing between {shorten(paths[place].name)} and {shorten(paths[place + 1].name)}, expected every part of one record"
        )


class ParquetParts:
    """One Parquet file, or several with the same columns, one after the other. Raises InvalidInput where they cannot be read, or
    the columns `names` are not there, hold no numbers, or are not the same in all."""

    def __init__(self, paths: Sequence[Path], names: Sequence[str]) -> None:
        try:
            self._parquet: Any = import_module("pyarrow.parquet")
            self._arrow: Any = import_module("pyarrow")
        except ImportError:
            advice = "pip install 'faultspace[parquet]', or write the data as CSV or NPZ"
            raise InvalidInput(f"got a Parquet file, which needs pyarrow: {advice}") from None
        self._paths, self._names, self._together = paths, names, len(paths) > 1
        self.length = 0
        kinds: dict[str, str] = {}
        for number, path in enumerate(paths):
            with self._opened(path) as file:
                found = self._columns(file, self._names if not number else ())
                if number and found != kinds:
                    raise InvalidInput(f"{_difference(found, kinds)}, expected the columns of the first part, {shorten(paths[0].name)}")
                kinds = found
                self.length += file.metadata.num_rows
        self.columns = tuple(kinds)
        self.single = any(kinds[name] == "float" for name in names)

    def rows(self, size: int, on_read: Callable[[int, int], None]) -> Iterator[Array]:
        """Yield the chosen columns, at most `size` rows at a time; `on_read` hears rows read and rows in all."""
        done = 0
        for path in self._paths:
            with self._opened(path) as file:
                batches = file.iter_batches(batch_size=size, columns=list(self._names), use_threads=False)
                while (values := self._next(batches)) is not None:
                    yield values
                    done += len(values)
                    on_read(done, self.length)

    def column(self, name: str) -> Any:
        """Return one column of all parts, in whatever type it has."""
        found = []
        for path in self._paths:
            with self._opened(path) as file, from_library("Parquet", "a Parquet file"):
                found.append(file.read(columns=[name]).column(0).to_numpy())
        return found[0] if len(found) == 1 else np.concatenate(found)

    @contextmanager
    def _opened(self, path: Path) -> Iterator[Any]:
        """Open a file; what is wrong in one of several is told with its name."""
        if not self._together:
            with self._file(path) as file:
                yield file
            return
        lacking: Missing | None = None
        with in_file(path.name), readable("Parquet"), self._file(path) as file:
            try:
                yield file
            except Missing as error:
                lacking = error
        if lacking is not None:  # which knows the columns that there are, and is told of the first part as of a single file
            raise lacking

    def _file(self, path: Path) -> Any:
        open_regular(path, "a Parquet file").close()
        with from_library("Parquet", "a Parquet file"):
            return self._parquet.ParquetFile(path, pre_buffer=False, buffer_size=BUFFER)

    def _columns(self, file: Any, names: Sequence[str]) -> dict[str, str]:
        """Return the type of each column of a file by name, once those with these names are found to hold numbers."""
        with from_library("Parquet", "a Parquet file"):
            schema = file.schema_arrow
            there = list(schema.names)
        twice = [name for name in names if there.count(name) > 1]
        if twice:
            raise InvalidInput(f"got two columns named {shorten(twice[0])}, expected every name once")
        types = self._arrow.types
        for name in names:
            if name not in there:
                raise missing(name, there, "column")
            kind = schema.field(name).type
            if not (types.is_integer(kind) or types.is_floating(kind) or types.is_boolean(kind)):
                raise InvalidInput(f"column {shorten(name)} holds values of type {kind}, expected numbers")
        return {name: str(schema.types[place]) for place, name in enumerate(there)}

    def _next(self, batches: Iterator[Any]) -> Array | None:
        with from_library("Parquet", "a Parquet file"):
            batch = next(batches, None)
            if batch is None:
                return None
            columns = [batch.column(batch.schema.get_field_index(name)).cast(self._arrow.float64()) for name in self._names]
            return np.column_stack([np.asarray(column.to_numpy(zero_copy_only=False), dtype=np.float64) for column in columns])


def _difference(found: dict[str, str], first: dict[str, str]) -> str:
    """Return in words how the columns differ from those of the first part."""
    lacking, more = [name for name in first if name not in found], [name for name in found if name not in first]
    if lacking or more:
        return f"lacks the column {shorten(lacking[0])}" if lacking else f"has the column {shorten(more[0])} as well"
    other = next(name for name in found if found[name] != first[name])
    return f"column {shorten(other)} holds values of type {found[other]} and not {first[other]}"
