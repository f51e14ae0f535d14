"""This reads samples as they come: lines of a text table from standard input or from a file that grows.

TableStream    samples (k,) from such lines, the chosen columns of each; NaN where a field is empty, and throughout where a line is no row
RESTARTED      in place of a sample: some may lack before the next one
seldom         whether the count of what happens again and again is one to be told: 1, 2, 4, 8, ..

A line that has all chosen names in it is a line of names wherever it comes, for a logger that is started again writes it again; with the
first row behind it, it shows the table, as in a file (`text_tables`). Where columns are chosen by number the first two lines do.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ...base.arrays import Array
from ...base.errors import InvalidInput, in_file, quote_path, shorten
from ...base.others_text import printable
from .following import LONGEST_LINE, Break
from .text_tables import SEPARATORS, TextTable, fields_of, number_in

RESTARTED = None
_COLUMN = re.compile(r"^.+\[(?:\s*:\s*,)?\s*(\d+)\s*\]$")


def seldom(count: int) -> bool:
    """Say whether the count is a power of two."""
    return count & (count - 1) == 0


class TableStream:
    """The stream gives the samples in `lines`, of the columns with these names; `name` says in messages where they come from.

    A name of the form data[:,j] or data[j] is column j of a table without a line of names. Iterating gives an array (k,) a sample, and
    RESTARTED where a Break of `lines` says that some may lack. The first `after` lines only show the table; `head` is its line of names,
    where an earlier stream has read it. A line that is no row of it, or
    no text, is a missing sample: `bad` counts them, and `heard` is told of them. Raises InvalidInput where the first lines are no table
    with these columns.
    """

    def __init__(
        self,
        lines: Iterable[bytes | Break],
        names: Sequence[str],
        name: str,
        *,
        after: int = 0,
        head: str = "",
        heard: Callable[[str], None] = lambda _: None,
    ) -> None:
        self._lines, self._names, self._name, self._after, self._heard = lines, [*map(printable, names)], name, after, heard
        self._number = 0  # of the line, from 1
        self._fresh = False  # whether it is the first of another table
        self._begun = False  # whether there has been a table
        self._table: TextTable | None = None
        self._columns: list[int] = []
        self.head = head
        self._head = (0, head) if head else None  # a line that shows the table together with the next row
        self._pointed = False  # whether a number had a decimal point
        self.bad = 0

    def __iter__(self) -> Iterator[Array | None]:
        for line in self._lines:
            if isinstance(line, Break):
                self._number, self._after, self._head, self._fresh = 0, 0, None, True
                if line is Break.begun_anew:
                    yield RESTARTED
                continue
            self._number += 1
            passed = self._number <= self._after and self._table is not None and self._names[0].encode() not in line  # no names, either
            if passed or not line.strip() or line.lstrip().startswith(b"#"):
                continue
            samples = self._samples(line)
            self._fresh = False
            if self._number > self._after:
                yield from map(np.array, samples)
        if not self._begun and self._head is not None:
            with in_file(self._name):
                yield from map(np.array, self._opened([self._head]))

    def _samples(self, line: bytes) -> list[list[float]]:
        """Return the samples that this line gives: one unless it shows what the columns are."""
        try:
            return self._read(self._text(line))
        except InvalidInput as error:
            if not (self._begun or (self._head is not None and self._names_all(self._head[1]))):
                raise InvalidInput(f"{quote_path(self._name)}: {error}") from None
            if self._number > self._after:
                self.bad += 1
                if seldom(self.bad):
                    self._heard(f"{quote_path(self._name)}: {error}; it counts as a missing sample, {self.bad} so far")
            return [[float("nan")] * len(self._names)]

    def _text(self, line: bytes) -> str:
        if len(line) >= LONGEST_LINE:
            raise InvalidInput(f"line {self._number} is longer than {LONGEST_LINE} bytes, expected a line a sample")
        if b"\0" in line:
            raise InvalidInput(f"line {self._number} holds a zero byte, expected text")
        try:
            return line.decode("utf-8-sig").rstrip("\r\n")
        except UnicodeDecodeError as error:
            raise InvalidInput(f"line {self._number}: got byte {error.object[error.start]:#04x}, expected text in UTF-8") from None

    def _read(self, text: str) -> list[list[float]]:
        """Return the samples that the text of a line gives. Raises InvalidInput for one that belongs to no table with the columns."""
        refusal = InvalidInput(f"line {self._number} stands in a table without the chosen columns")
        if self._table is not None:
            try:
                return [self._row(self._table, text)]
            except InvalidInput as error:
                refusal = InvalidInput(str(error).rpartition(": ")[0])  # what to do about it is said of files
        if self._names_all(text):
            self._head, self._table = (self._number, text), None
            return []
        if self._head is not None:
            if self._names_all(self._head[1]) and not _has_number(text):
                self._head = self._head if self._head[0] else (self._number, text)  # units, or names that are none of ours
                return []
            return self._opened([self._head, (self._number, text)])
        if not self._begun:
            self._head = (self._number, text)
            return []
        if self._fresh and not _has_number(text):  # other names, whose rows may be as wide as those of the table
            self._table, self.head = None, ""
        raise refusal

    def _row(self, table: TextTable, text: str) -> list[float]:
        """Return the chosen numbers of a row. Where no number before had a decimal point, the first that has a comma shows the decimals."""
        try:
            row = table.row(self._number, text, self._columns)
        except InvalidInput:
            if self._pointed or table.separator == "," or table.decimal == ",":
                raise
            other = replace(table, decimal=",")
            row = other.row(self._number, text, self._columns)
            self._table = other
        self._pointed = self._pointed or "." in text
        return row

    def _opened(self, beginning: list[tuple[int, str]]) -> list[list[float]]:
        """Take the table that these lines show, and return the samples among them."""
        table = TextTable.of_lines(Path(self._name), beginning)
        self._columns = self._places(table)
        self._table, self._begun, self.head, self._head = table, True, beginning[0][1] if table.names else "", None
        return [self._row(table, text) for number, text in beginning if number > table.skipped]

    def _names_all(self, text: str) -> bool:
        return any(set(self._names) <= set(map(printable, fields_of(text, separator))) for separator in SEPARATORS)

    def _places(self, table: TextTable) -> list[int]:
        found = []
        for name in self._names:
            match = _COLUMN.match(name)
            if table.names is not None and name in table.names:
                found.append(table.names.index(name))
            elif table.names is None and match and int(match[1]) < table.width:
                found.append(int(match[1]))
            else:
                there = ", ".join(map(shorten, table.names)) if table.names else f"{table.width} columns without names, data[0] the first"
                raise InvalidInput(f"there is no column {shorten(name)}, expected one of: {there}")
        return found


def _has_number(text: str) -> bool:
    return any(number_in(field) is not None for separator in SEPARATORS for field in fields_of(text, separator))
