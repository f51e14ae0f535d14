"""This follows a text file that grows, as a logger writes it: through pauses, rotations, truncations and rewritings.

Followed     iterates over the lines of the file, with a Break where another file, or another content, takes its place
Break        what stands in place of a line there
Place        how far the lines have come
bounded      the lines of a stream that ends, such as standard input

A file is held open until another one with content has its name and it has nothing more to say: what is written before, during and shortly
behind a rotation is read. While it is held open no other file has its inode. That a file has been rewritten shows by its first bytes, and
by the last ones before the place where reading stands: FINGERPRINT of each. No clock is asked, so that none can jump.

A line counts when its end has come. Of a line longer than LONGEST_LINE the beginning is given, which no table has.
"""

from __future__ import annotations

import hashlib
import os
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from enum import Enum
from typing import Any, BinaryIO, NamedTuple

from ...base.errors import InvalidInput, in_file, quote_path, shorten
from ...base.regular_files import open_regular
from ...base.writing import reason

PAUSE = 0.2  # seconds between looks at a file that has not grown
CHUNK = 1 << 20
LONGEST_LINE = 1 << 22
FINGERPRINT = 1 << 12


class Break(Enum):
    """What stands in place of a line where another table may begin: `rotated` goes on without loss, before `begun_anew` lines may lack."""

    rotated = "rotated"
    begun_anew = "begun anew"


class Place(NamedTuple):
    """Behind so many bytes, and lines, of the file that is the `table`-th since the beginning."""

    table: int
    bytes: int
    line: int


def bounded(stream: BinaryIO, heard: Callable[[str], None]) -> Iterator[bytes]:
    """Yield the lines of a stream of bytes that have an end; one that has none, at the end of the stream, is told."""
    line = b""
    while part := _part(stream):
        line = (line + part)[:LONGEST_LINE]
        if part.endswith(b"\n"):
            yield line
            line = b""
    if line:
        heard(f"standard input: the last line has no end, and is no sample: {shorten(line)}")


def _part(stream: BinaryIO) -> bytes:
    try:
        return stream.readline(LONGEST_LINE)
    except OSError as error:
        raise InvalidInput(f"standard input: cannot be read ({reason(error)}), expected lines of samples") from None


class Followed:
    """The file at `path` is followed from its beginning, until nothing has come for `idle` seconds (None: for ever).

    `after` is what `mark` returned earlier: where it fits the file, `begins` is the place where reading stood then; the lines before it
    come nevertheless, for they tell the columns. `heard` is told what a reader must know. Raises InvalidInput where there is no such file
    to begin with, and where it cannot be read any more.
    """

    def __init__(
        self, path: str, *, idle: float | None = None, after: Mapping[str, Any] | None = None, heard: Callable[[str], None] = lambda _: None
    ) -> None:
        self._path, self._idle, self._heard = path, idle, heard
        with _named(path):
            self._stream = open_regular(path, "a text table that grows")
        self._absent = ""
        self.place, self._read, self._first, self._last = Place(0, 0, 0), 0, b"", b""
        self.begins = self.place
        if after is not None and after["bytes"]:
            then = Place(0, after["bytes"], after["line"])
            if self.mark(then).items() <= after.items():
                self.begins = then
            else:
                heard(f"{quote_path(path)}: is not the file that was watched, or was rewritten: it is read from its beginning")

    def mark(self, place: Place) -> dict[str, Any]:
        """Return what a later run recognises the file by, JSON-ready: read up to this place, or up to its beginning where it is another."""
        read, line = (place.bytes, place.line) if place.table == self.place.table else (0, 0)
        first, last = (self._at(start, size) for start, size in ((0, min(read, FINGERPRINT)), _end(read)))
        return {"bytes": read, "line": line, "first": hashlib.sha256(first).hexdigest(), "last": hashlib.sha256(last).hexdigest()}

    def __iter__(self) -> Iterator[bytes | Break]:
        waited, rest = 0.0, b""
        while self._idle is None or waited <= self._idle:
            with _named(self._path):
                came = self._at(self._read, CHUNK)
                shorter = os.fstat(self._stream.fileno()).st_size < self._read
                anew = not self._is_as_read() if not (came and shorter) else False  # else it was cut behind what came
                other = None if came or anew else self._another()
            if anew:
                rest = b""
                self._begin(self.place.table + 1)
                yield Break.begun_anew
            elif came:
                waited = 0.0
                self._remember(came)
                *lines, end = came.split(b"\n")
                for line in lines:
                    line, rest = self._longer(rest, line), b""
                    self.place = Place(self.place.table, self.place.bytes + len(line) + 1, self.place.line + 1)
                    yield line
                rest = self._longer(rest, end)
            elif other is not None:
                waited, rest = 0.0, b""
                kept = os.fstat(self._stream.fileno()).st_nlink > 0  # a rotation gives the old file another name
                self._stream.close()
                self._stream = other
                self._begin(self.place.table + 1)
                yield Break.rotated if kept else Break.begun_anew
            else:
                time.sleep(PAUSE)
                waited += PAUSE

    def _begin(self, table: int) -> None:
        self.place, self._read, self._first, self._last = Place(table, 0, 0), 0, b"", b""

    def _longer(self, line: bytes, more: bytes) -> bytes:
        """Return the line with what follows, as far as it may go; what is left out counts as read."""
        whole = line + more[: LONGEST_LINE - len(line)]
        if left := len(line) + len(more) - len(whole):
            self.place = self.place._replace(bytes=self.place.bytes + left)
        return whole

    def _at(self, start: int, size: int) -> bytes:
        descriptor = self._stream.fileno()  # a buffer would tell what stood there earlier
        os.lseek(descriptor, start, os.SEEK_SET)
        return os.read(descriptor, size)

    def _remember(self, came: bytes) -> None:
        self._read += len(came)
        self._first = (self._first + came[:FINGERPRINT])[:FINGERPRINT]
        self._last = (self._last + came[-FINGERPRINT:])[-FINGERPRINT:]

    def _is_as_read(self) -> bool:
        """Say whether what was read before still stands where it stood."""
        return self._at(0, len(self._first)) == self._first and self._at(self._read - len(self._last), len(self._last)) == self._last

    def _another(self) -> BinaryIO | None:
        """Return the file that has the name now, None where it is ours, has no content yet, or ours has grown meanwhile."""
        try:
            there, ours = os.stat(self._path), os.fstat(self._stream.fileno())
            if (there.st_dev, there.st_ino) == (ours.st_dev, ours.st_ino):
                self._absent = ""
                return None
            other = open_regular(self._path, "a text table that grows")
        except (OSError, InvalidInput) as error:
            why = reason(error).partition(",")[0].removeprefix("cannot be read (").removesuffix(")")
            if why != self._absent:
                self._heard(f"{quote_path(self._path)}: {why}; waiting for it")
            self._absent = why
            return None
        if os.fstat(other.fileno()).st_size and not self._at(self._read, 1):
            self._absent = ""
            return other
        other.close()
        return None


def _end(read: int) -> tuple[int, int]:
    """Return where the last bytes of so many begin, and how many they are."""
    size = min(read, FINGERPRINT)
    return read - size, size


@contextmanager
def _named(path: str) -> Iterator[None]:
    """Within, refusals and errors of the operating system name the file."""
    with in_file(path):
        try:
            yield
        except OSError as error:
            raise InvalidInput(f"cannot be read ({reason(error)}), expected a text table that grows") from None
