"""This reads samples as they come: lines of a text table from standard input or from a file that grows.

followed       the lines of a growing file, or RESTARTED where it was cut short or replaced
TableStream    samples (k,) from such lines, the chosen columns of each; NaN where a field is empty

A line counts when its end has come. The columns are found by the first two lines, as in a file (`text_tables`).
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from pathlib import Path

import numpy as np

from ...base.arrays import Array
from ...base.errors import InvalidInput, in_file, quote_path, shorten
from ...base.others_text import printable
from .text_tables import TextTable

RESTARTED = None  # in place of a line: what follows is a table of its own
PAUSE = 0.2  # seconds between looks at a file that has not grown
CHUNK = 1 << 20
LONGEST_LINE = 1 << 22
_COLUMN = re.compile(r"^.+\[(?:\s*:\s*,)?\s*(\d+)\s*\]$")


def followed(path: str, *, idle: float | None = None) -> Iterator[bytes | None]:
    """Yield the lines of the file at `path` from its beginning, and those that are added, until nothing has come for `idle` seconds (None:
    for ever). Raises InvalidInput where the file cannot be read."""
    waited, rest, place, identity = 0.0, b"", 0, None
    while idle is None or waited <= idle:
        try:
            with open(path, "rb") as stream:
                state = os.fstat(stream.fileno())
                if identity is not None and (identity != (state.st_dev, state.st_ino) or state.st_size < place):
                    rest, place = b"", 0
                    yield RESTARTED
                identity = (state.st_dev, state.st_ino)
                stream.seek(place)
                came = stream.read(CHUNK)
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise InvalidInput(f"{quote_path(path)}: cannot be read ({reason}), expected a text table that grows") from None
        if not came:
            time.sleep(PAUSE)
            waited += PAUSE
            continue
        waited, place = 0.0, place + len(came)
        *lines, rest = (rest + came).split(b"\n")
        if len(rest) > LONGEST_LINE:
            raise InvalidInput(f"{quote_path(path)}: a line is longer than {LONGEST_LINE} characters, expected a line a sample")
        yield from lines


class TableStream:
    """The stream gives the samples in `lines`, of the columns with these names; `name` says in messages where they come from.

    A name of the form data[:,j] or data[j] is column j of a table without a line of names. Iterating gives an array (k,) a sample, and
    RESTARTED where `lines` says so. Raises InvalidInput for lines that are no table, columns that are not there, and fields that are no
    numbers.
    """

    def __init__(self, lines: Iterable[bytes | None], names: Sequence[str], name: str) -> None:
        self._lines, self._names, self._name = iter(lines), list(names), name
        self._number = 0

    def __iter__(self) -> Iterator[Array | None]:
        while True:
            beginning, ended = self._beginning()
            if beginning:
                with in_file(self._name):
                    table = TextTable.of_lines(Path(self._name), beginning)
                    columns = self._columns(table)
                first = [pair for pair in beginning if pair[0] > table.skipped]
                for pair in chain(first, () if ended else self._numbered()):
                    if pair is RESTARTED:
                        break
                    with in_file(self._name):
                        row = table.row(*pair, columns)
                    yield np.array(row, dtype=np.float64)
                else:
                    return
            elif ended:
                return
            yield RESTARTED

    def _beginning(self) -> tuple[list[tuple[int, str]], bool]:
        """Return the first two lines, which show the columns, and whether nothing comes after them."""
        found: list[tuple[int, str]] = []
        for pair in self._numbered():
            if pair is RESTARTED:
                return [], False
            found.append(pair)
            if len(found) == 2:
                return found, False
        return found, True

    def _numbered(self) -> Iterator[tuple[int, str] | None]:
        for line in self._lines:
            if line is RESTARTED:
                self._number = 0
                yield RESTARTED
                continue
            self._number += 1
            try:
                text = line.decode("utf-8-sig").rstrip("\r\n")
            except UnicodeDecodeError as error:
                got = f"got byte {error.object[error.start]:#04x}, expected text in UTF-8"
                raise InvalidInput(f"{quote_path(self._name)}: line {self._number}: {got}") from None
            if text.strip() and not text.lstrip().startswith("#"):
                yield self._number, text

    def _columns(self, table: TextTable) -> list[int]:
        found = []
        for name in map(printable, self._names):
            match = _COLUMN.match(name)
            if table.names is not None and name in table.names:
                found.append(table.names.index(name))
            elif table.names is None and match and int(match[1]) < table.width:
                found.append(int(match[1]))
            else:
                there = ", ".join(map(shorten, table.names)) if table.names else f"{table.width} columns without names, data[0] the first"
                raise InvalidInput(f"there is no column {shorten(name)}, expected one of: {there}")
        return found
