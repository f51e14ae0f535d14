"""This reads tables in text files: which character separates the columns, whether a line names them, and their values, piece by piece.

TextTable          an opened table: separator, names, width, first line of values; `pieces` reads chosen columns, `row` those of a line
SEPARATORS         the separators that are tried, with the names they have in messages
PIECE              lines parsed at once

The separator is the one that splits every line of the beginning into equally many fields, more than one; lines that begin with # and empty
lines do not count. The first line names the columns where one of its fields is no number.

pandas.read_csv in chunks and pyarrow.csv.open_csv were tried instead: both take a column with a word, 1,5 or 1_000 in it for text, without
a complaint or the line's number, and "NA" for a missing value; pandas renames a name that stands twice and fills short lines with NaN, and
pyarrow keeps one of two columns of one name, reads 0x10 as 16 and knows no comments. Each of these would have to be looked for around the
call, so the reader would not become shorter, and neither package need be installed here.
"""

from __future__ import annotations

import csv
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import TextIO

import numpy as np

from ...base.arrays import Array
from ...base.errors import InvalidInput, shorten
from ...base.sheets import counted

SEPARATORS = {",": "comma", ";": "semicolon", "\t": "tab", " ": "blanks"}
PIECE = 1 << 15
LOOKED_AT = 50
LONGEST_LINE = 1 << 22


@dataclass(frozen=True)
class TextTable:
    """The table has `width` columns with these `names`, or None where no line names them; `skipped` lines stand before the values."""

    path: Path
    separator: str
    names: tuple[str, ...] | None
    width: int
    skipped: int

    @property
    def separator_name(self) -> str:
        """Return the separator in words."""
        return SEPARATORS[self.separator]

    @classmethod
    def opened(cls, path: Path) -> TextTable:
        """Open a table by what the beginning of the file shows. Raises InvalidInput where that is no table."""
        try:
            with _stream(path) as stream:
                beginning = list(islice(_lines(stream), LOOKED_AT))
        except UnicodeDecodeError as error:
            raise InvalidInput(f"got byte {error.object[error.start]:#04x}, expected text in UTF-8: save the table as UTF-8 CSV") from None
        return cls.of_lines(path, beginning)

    @classmethod
    def of_lines(cls, path: Path, beginning: Sequence[tuple[int, str]]) -> TextTable:
        """Return the table that begins with these lines, each with its number; the path is where they come from. Raises InvalidInput where
        they are no table."""
        if not beginning:
            raise InvalidInput("got no line of a table, expected a line of names and a line a sample")
        lines = [line for _, line in beginning]
        if len(lines) == 1 and all(_number(field) is None for separator in SEPARATORS for field in _fields(lines[0], separator)):
            raise InvalidInput("got a line of names and no samples, expected a record of many")
        separator = _separator(lines)
        _quotes_closed(beginning, separator)
        fields = _fields(lines[0], separator)
        named = any(_number(field) is None for field in fields)
        names = tuple(fields) if named else None
        if named:
            _names_once(fields)
        return cls(path, separator, names, len(fields), beginning[0][0] if named else beginning[0][0] - 1)

    def pieces(self, columns: Sequence[int], on_read: Callable[[int, int], None]) -> Iterator[Array]:
        """Yield the chosen columns, (any, len(columns)), PIECE lines at a time; NaN where a line says so. `on_read` hears bytes read and
        bytes in all. Raises InvalidInput for a field that is no number, and where there is no line of values."""
        size = self.path.stat().st_size
        with _stream(self.path) as stream:
            numbered = (pair for pair in _lines(stream) if pair[0] > self.skipped)
            empty = True
            while piece := list(islice(numbered, PIECE)):
                empty = False
                _quotes_closed(piece, self.separator)
                yield self._parsed(piece, columns)
                on_read(min(stream.buffer.tell(), size), size)
        if empty:
            raise InvalidInput(f"got no samples after line {self.skipped}, expected a record of many")

    def _parsed(self, piece: Sequence[tuple[int, str]], columns: Sequence[int]) -> Array:
        delimiter = None if self.separator == " " else self.separator
        lines = [line for _, line in piece]
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                values = np.loadtxt(lines, delimiter=delimiter, usecols=list(columns), ndmin=2, comments=None, quotechar='"')
            widths = {line.count(self.separator) for line in lines} if delimiter and '"' not in "".join(lines[:1]) else {self.width - 1}
            if len(values) == len(lines) and widths == {self.width - 1}:
                return np.asarray(values, dtype=np.float64)
        except (ValueError, Warning):
            pass
        return np.array([self.row(number, line, columns) for number, line in piece], dtype=np.float64)

    def row(self, number: int, line: str, columns: Sequence[int]) -> list[float]:
        """Parse one line, slowly, so that the complaint names the line and the column."""
        fields = _fields(line, self.separator)
        if len(fields) != self.width:
            raise InvalidInput(
                f"line {number} has {counted(len(fields), 'field')} separated by {self.separator_name}, expected {self.width} as in the "
                "first line: "
                "mend the line, or write the table with one separator throughout"
            )
        row = []
        for column in columns:
            value = float("nan") if fields[column] == "" else _number(fields[column])
            if value is None:
                name = shorten(self.names[column]) if self.names else str(column)
                comma = _number(fields[column].replace(",", ".")) is not None
                advice = "write decimals with a point" if comma else "mend it, or cut the record before it"
                raise InvalidInput(f"line {number}, column {name}: got {shorten(fields[column])}, expected a number: {advice}")
            row.append(value)
        return row


def _stream(path: Path) -> TextIO:
    return open(path, encoding="utf-8-sig", newline=None)


def _lines(stream: TextIO) -> Iterator[tuple[int, str]]:
    """Yield the lines that count, with their numbers from 1."""
    number = 0
    while line := stream.readline(LONGEST_LINE):
        number += 1
        if len(line) >= LONGEST_LINE:
            raise InvalidInput(f"line {number} is longer than {LONGEST_LINE} characters, expected a line a sample")
        if "\0" in line:
            raise InvalidInput(f"line {number} holds a zero byte, expected text: is it a binary file, or saved as UTF-16?")
        text = line.rstrip("\r\n")
        if text.strip() and not text.lstrip().startswith("#"):
            yield number, text


def _separator(lines: Sequence[str]) -> str:
    """Return the separator that makes a table of the lines, most columns first. Raises InvalidInput where none does."""
    tables = {}
    for separator in SEPARATORS:
        widths = {len(_fields(line, separator)) for line in lines}
        if len(widths) == 1 and (width := widths.pop()) > 1:
            tables[separator] = width
    # Values must be numbers: a comma inside names or a decimal comma makes no column.
    sound = [separator for separator in tables if _numeric_share(lines[1:] or lines, separator) > 0.0]
    for separator in SEPARATORS:
        if separator in sound and (separator != " " or len(sound) == 1):
            if separator == "," and ";" in sound:
                continue  # 1,5;2,5: the semicolon separates, the comma is a decimal comma
            return separator
    if all(_number(line) is not None for line in lines[1:] or lines):
        return ","  # a single column
    tried = ", ".join(SEPARATORS.values())
    for separator, name in SEPARATORS.items():
        widths_in_order = [len(_fields(line, separator)) for line in lines]
        if separator != " " and len(set(widths_in_order)) > 1 and min(widths_in_order[:2]) > 1:
            odd = next(i for i, width in enumerate(widths_in_order) if width != widths_in_order[0])
            raise InvalidInput(
                f"line {odd + 1} of the table has {widths_in_order[odd]} fields separated by {name} where the first has "
                f"{widths_in_order[0]}: expected as many in every line"
            )
    raise InvalidInput(
        f"got lines that none of {tried} splits into equally many numbers, the first is {shorten(lines[0][:80])}: write the table with "
        "commas between columns and points in decimals"
    )


def _numeric_share(lines: Sequence[str], separator: str) -> float:
    """Return the share of fields that are numbers, a decimal comma allowed: such a table is told apart and then complained about."""
    fields = [field for line in lines for field in _fields(line, separator)]
    good = sum(_number(field.replace(",", ".")) is not None for field in fields)
    return good / len(fields)


def _fields(line: str, separator: str) -> list[str]:
    if separator == " ":
        return line.replace('"', "").split()
    return [field.strip() for field in next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])]


def _quotes_closed(numbered: Sequence[tuple[int, str]], separator: str) -> None:
    """Raise InvalidInput for a line with a field that begins with a quotation mark and does not end with one."""
    for number, line in numbered:
        if '"' not in line:
            continue
        try:
            closed = separator != " " or line.count('"') % 2 == 0
            next(csv.reader([line], delimiter=separator, skipinitialspace=True, strict=separator != " "), [])
        except csv.Error:
            closed = False
        if not closed:
            raise InvalidInput(
                f"line {number} has a quotation mark without its partner, expected a field in quotes to end with one on its line: "
                f"take the mark away, or close it; the line begins with {shorten(line[:40])}"
            )


def _number(field: str) -> float | None:
    try:
        return None if "_" in field else float(field)
    except ValueError:
        return None


def _names_once(names: Sequence[str]) -> None:
    twice = [name for i, name in enumerate(names) if name and name in names[:i]]
    if twice:
        raise InvalidInput(f"got two columns named {shorten(twice[0])}, expected every name once: rename one")
