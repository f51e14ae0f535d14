"""This reads tables in text files: which character separates the columns, whether a line names them, and their values, piece by piece.

TextTable          an opened table: separator, names, width, first line of values; `pieces` reads chosen columns, `row` those of a line
fields_of          the fields of a line; number_in: the number in one, None where there is none
SEPARATORS         the separators that are tried, with the names they have in messages
DECIMALS           what stands before the decimals
PIECE              lines parsed at once

The separator is the one that splits every line of the beginning into equally many fields, more than one; lines that begin with # and empty
lines do not count. The first line names the columns where one of its fields is no number; the second one has their units where none of its
fields is a number in a column of numbers. Where the separator is no comma and numbers of the beginning have one, decimals stand behind
a comma throughout, and a number with a point is refused then, for it could be a thousand. Text is UTF-8, or UTF-16 with its mark;
bytes that are neither are read as those of Windows (code page 1252), which only names and units have.

pandas.read_csv in chunks and pyarrow.csv.open_csv were tried instead: both take a column with a word, 1,5 or 1_000 in it for text, without
a complaint or the line's number, and "NA" for a missing value; pandas renames a name that stands twice and fills short lines with NaN, and
pyarrow keeps one of two columns of one name, reads 0x10 as 16 and knows no comments. Each of these would have to be looked for around the
call, so the reader would not become shorter, and neither package need be installed here.
"""

from __future__ import annotations

import codecs
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
from ...base.others_text import printable
from ...base.sheets import counted

DECIMALS = {".": "a point", ",": "a comma"}
SEPARATORS = {",": "comma", ";": "semicolon", "\t": "tab", " ": "blanks"}
PIECE = 1 << 15
LOOKED_AT = 50
LONGEST_LINE = 1 << 22


@dataclass(frozen=True)
class TextTable:
    """The table has `width` columns with these `names`, or None where no line names them, and their `units`, or None; `skipped` lines stand
    before the values, and `decimal` before the decimals of a number."""

    path: Path
    separator: str
    names: tuple[str, ...] | None
    width: int
    skipped: int
    units: tuple[str, ...] | None = None
    decimal: str = "."

    @property
    def separator_name(self) -> str:
        """Return the separator in words."""
        return SEPARATORS[self.separator]

    @classmethod
    def opened(cls, path: Path) -> TextTable:
        """Open a table by what the beginning of the file shows. Raises InvalidInput where that is no table."""
        with _stream(path) as stream:
            beginning = list(islice(_lines(stream), LOOKED_AT))
        return cls.of_lines(path, beginning)

    @classmethod
    def of_lines(cls, path: Path, beginning: Sequence[tuple[int, str]]) -> TextTable:
        """Return the table that begins with these lines, each with its number; the path is where they come from. Raises InvalidInput where
        they are no table."""
        if not beginning:
            raise InvalidInput("got no line of a table, expected a line of names and a line a sample")
        lines = [line for _, line in beginning]
        if len(lines) == 1 and all(number_in(field) is None for separator in SEPARATORS for field in fields_of(lines[0], separator)):
            raise InvalidInput("got a line of names and no samples, expected a record of many")
        separator = _separator(lines)
        _quotes_closed(beginning, separator)
        fields = fields_of(lines[0], separator)
        decimal = _decimal(lines[1:] or lines, separator)
        named = any(number_in(field, decimal) is None for field in fields)
        names = tuple(printable(_windows(field)) for field in fields) if named else None
        if names is None:
            return cls(path, separator, names, len(fields), beginning[0][0] - 1, None, decimal)
        _names_once(names)
        units = _units(lines, separator, decimal)
        return cls(path, separator, names, len(fields), beginning[0 if units is None else 1][0], units, decimal)

    def column(self, place: int) -> list[str] | Array:
        """Return one column as numbers, or as texts where one of them is no number."""
        try:
            parts = [self._parsed(piece, [place])[:, 0] for piece in self._pieces()]
            return np.concatenate(parts) if parts else np.zeros(0)
        except InvalidInput:
            rows = (fields_of(line, self.separator) for piece in self._pieces() for _, line in piece)
            return [fields[place] for fields in rows if len(fields) > place]

    def _pieces(self) -> Iterator[list[tuple[int, str]]]:
        """Yield the numbered lines of values, PIECE at a time."""
        with _stream(self.path) as stream:
            numbered = (pair for pair in _lines(stream) if pair[0] > self.skipped)
            while piece := list(islice(numbered, PIECE)):
                yield piece

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
            if self.decimal == ",":
                if any("." in line for line in lines):
                    raise ValueError
                lines = [line.replace(",", ".") for line in lines]
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
        fields = fields_of(line, self.separator)
        if len(fields) != self.width:
            raise InvalidInput(
                f"line {number} has {counted(len(fields), 'field')} separated by {self.separator_name}, expected {self.width} as in the "
                "first line: "
                "mend the line, or write the table with one separator throughout"
            )
        row = []
        for column in columns:
            value = float("nan") if fields[column] == "" else number_in(fields[column], self.decimal)
            if value is None:
                name = shorten(self.names[column]) if self.names else str(column)
                other = "," if self.decimal == "." else "."
                decimals = number_in(fields[column], other) is not None
                advice = f"write decimals with {DECIMALS[self.decimal]}" if decimals else "mend it, or cut the record before it"
                raise InvalidInput(f"line {number}, column {name}: got {shorten(fields[column])}, expected a number: {advice}")
            row.append(value)
        return row


def _stream(path: Path) -> TextIO:
    with open(path, "rb") as stream:
        wide = stream.read(2) in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
    # Bytes of other encodings are kept as they are: `_windows` reads them where they stand in a name.
    return open(path, encoding="utf-16") if wide else open(path, encoding="utf-8-sig", errors="surrogateescape")


def _windows(name: str) -> str:
    """Return the name with the bytes in it that are not UTF-8 as those of Windows."""
    try:
        name.encode()
    except UnicodeEncodeError:
        return name.encode("utf-8", "surrogateescape").decode("cp1252", "replace")
    return name


def _decimal(lines: Sequence[str], separator: str) -> str:
    """Return what stands before the decimals of these lines: a comma where no number has a point, some have a comma, and it separates
    nothing."""
    if separator == ",":
        return "."
    fields = [field for line in lines for field in fields_of(line, separator)]
    if any("." in field and number_in(field) is not None for field in fields):
        return "."
    return "," if any("," in field and number_in(field, ",") is not None for field in fields) else "."


def _units(lines: Sequence[str], separator: str, decimal: str) -> tuple[str, ...] | None:
    """Return the fields of the second line where they are no numbers in any column that has numbers in the third, None otherwise."""
    if len(lines) < 3:
        return None
    second, third = (fields_of(line, separator) for line in lines[1:3])
    numbers = [place for place, field in enumerate(third) if number_in(field, decimal) is not None]
    words = numbers and len(second) == len(third) and all(number_in(second[place], decimal) is None for place in numbers)
    return tuple(map(_windows, second)) if words and any(second[place] for place in numbers) else None


def _lines(stream: TextIO) -> Iterator[tuple[int, str]]:
    """Yield the lines that count, with their numbers from 1."""
    number = 0
    while line := _line(stream, number + 1):
        number += 1
        if len(line) >= LONGEST_LINE:
            raise InvalidInput(f"line {number} is longer than {LONGEST_LINE} characters, expected a line a sample")
        if "\0" in line:
            raise InvalidInput(f"line {number} holds a zero byte, expected text: is it a binary file, or saved as UTF-16?")
        text = line.rstrip("\r\n")
        if text.strip() and not text.lstrip().startswith("#"):
            yield number, text


def _line(stream: TextIO, number: int) -> str:
    """Return the next line of a stream, nothing at its end. Raises InvalidInput for bytes that are no text in UTF-16."""
    try:
        return stream.readline(LONGEST_LINE)
    except UnicodeDecodeError as error:
        got = f"byte {error.object[error.start]:#04x} in or shortly behind line {number} of UTF-16"
        raise InvalidInput(f"got {got} ({error.reason}), expected text: is the file cut? Save the table as UTF-8 CSV") from None


def _separator(lines: Sequence[str]) -> str:
    """Return the separator that makes a table of the lines, most columns first. Raises InvalidInput where none does."""
    tables = {}
    for separator in SEPARATORS:
        widths = {len(fields_of(line, separator)) for line in lines}
        if len(widths) == 1 and (width := widths.pop()) > 1:
            tables[separator] = width
    # Values must be numbers: a comma inside names or a decimal comma makes no column.
    sound = [separator for separator in tables if _numeric_share(lines[1:] or lines, separator) > 0.0]
    for separator in SEPARATORS:
        if separator in sound and (separator != " " or len(sound) == 1):
            if separator == "," and (";" in sound or "\t" in sound):
                continue  # 1,5;2,5: the semicolon separates, the comma is a decimal comma
            return separator
    if all(number_in(line) is not None for line in lines[1:] or lines):
        return ","  # a single column
    tried = ", ".join(SEPARATORS.values())
    for separator, name in SEPARATORS.items():
        widths_in_order = [len(fields_of(line, separator)) for line in lines]
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
    fields = [field for line in lines for field in fields_of(line, separator)]
    good = sum(number_in(field.replace(",", ".")) is not None for field in fields)
    return good / len(fields)


def fields_of(line: str, separator: str) -> list[str]:
    """Return the fields of a line, without the blanks around them."""
    if separator == " ":
        return line.replace('"', "").split()
    try:
        return [field.strip() for field in next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])]
    except csv.Error:  # the one thing that a lenient reader refuses
        got = f"a field of more than {csv.field_size_limit()} characters in the line that begins with {shorten(line[:40])}"
        raise InvalidInput(f"got {got}, expected names and numbers: is a quotation mark not closed, or is it no table?") from None


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


def number_in(field: str, decimal: str = ".") -> float | None:
    """Return the number in a field, None where there is none, or one of other decimals."""
    if decimal == ",":
        if "." in field:
            return None
        field = field.replace(",", ".")
    try:
        return None if "_" in field or not field.isascii() else float(field)
    except ValueError:
        return None


def _names_once(names: Sequence[str]) -> None:
    twice = [name for i, name in enumerate(names) if name and name in names[:i]]
    if twice:
        raise InvalidInput(f"got two columns named {shorten(twice[0])}, expected every name once: rename one")
