"""What a long run has found is kept in a file of lines of JSON, so that the same command goes on where it was stopped.

KeptLines    the lines of a file, which this run has for itself; `note` appends one at once
append       a content to a file, whole or not at all
cut          leave the first bytes of a file alone
lock_of      the lock for which a file of ours stands

A line that a stop cut short, which can be the last alone, is taken out. What the operating system has been handed survives the death of our
process.
"""

from __future__ import annotations

import errno
import json
import os
import stat
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from filelock import FileLock, Timeout

from .errors import InvalidInput, quote_path
from .regular_files import open_own
from .writing import MODE, NO_LINK, reason

Line = Mapping[str, Any]


class KeptLines:
    """The lines are objects of JSON with the same `format`."""

    def __init__(self, path: Path, format: str, lines: list[Line]) -> None:
        self.path, self.format, self.lines = path, format, lines

    def note(self, **entries: Any) -> None:
        """Append a line, whole or not at all. Raises InvalidInput where that cannot be."""
        line = {"format": self.format, **dict(sorted(entries.items()))}
        append(self.path, (json.dumps(line) + "\n").encode())
        self.lines.append(line)


def append(path: Path, content: bytes) -> None:
    """Append the content to a file, or leave it as it was. Raises InvalidInput where that cannot be, and for a link."""
    try:
        descriptor = os.open(path, os.O_WRONLY | os.O_APPEND | NO_LINK | getattr(os, "O_NONBLOCK", 0))
        try:
            before, written = os.fstat(descriptor).st_size, 0
            try:
                while written < len(content):
                    written += os.write(descriptor, content[written:])
            except BaseException:
                with suppress(OSError):
                    os.ftruncate(descriptor, before)
                raise
        finally:
            os.close(descriptor)
    except OSError as error:
        raise InvalidInput(f"{quote_path(str(path))}: cannot be written ({reason(error)}), expected another path") from None


def cut(path: Path, size: int) -> None:
    """Leave the first `size` bytes of the file. Raises OSError, also for a link that has come to stand there since it was read."""
    descriptor = os.open(path, os.O_WRONLY | NO_LINK | getattr(os, "O_NONBLOCK", 0))
    try:
        os.ftruncate(descriptor, size)
    finally:
        os.close(descriptor)


def lock_of(path: Path) -> FileLock:
    """Return the lock for which the file at `path` stands, which is made, to be taken at once or not at all. Raises OSError for what is
    there and is no empty file of its own: to take a lock empties its file."""
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | NO_LINK | getattr(os, "O_NONBLOCK", 0), MODE)
    try:
        found = os.fstat(descriptor)
    finally:
        os.close(descriptor)
    if not stat.S_ISREG(found.st_mode) or found.st_size or found.st_nlink > 1:
        raise FileExistsError(errno.EEXIST, f"{quote_path(path.name)} is there and no lock", str(path))
    return FileLock(path, timeout=0)


@contextmanager
def keeping_lines(path: Path, format: str, good: Callable[[Line], bool], option: str) -> Iterator[KeptLines]:
    """Lock the file against other runs, make it where it is not there, and yield its lines, for which `good` says whether they are ours.

    Raises InvalidInput, which names the `option` that the path came by, for a file that another run has, that cannot be read and written,
    or that has other lines.
    """
    name = quote_path(str(path))
    try:
        lock = lock_of(path.with_name(f".{path.name}.lock"))
        lock.acquire()
    except Timeout:
        raise InvalidInput(f"{option}: another run works with {name}; wait for its end, or name another file") from None
    except OSError as error:
        raise _refused(option, name, reason(error)) from None
    try:
        yield KeptLines(path, format, _read(path, format, good, option, name))
    finally:
        lock.release()


def _read(path: Path, format: str, good: Callable[[Line], bool], option: str, name: str) -> list[Line]:
    try:
        os.close(os.open(path, os.O_RDWR | os.O_CREAT | NO_LINK | getattr(os, "O_NONBLOCK", 0), MODE))
        with open_own(path, "a file of lines") as stream:
            content = stream.read()
        whole = content[: content.rfind(b"\n") + 1]
        lines = [json.loads(line) for line in whole.splitlines()]
        if not all(isinstance(line, dict) and line.get("format") == format and good(line) for line in lines):
            raise ValueError
        if rest := content[len(whole) :].rstrip(b"\0"):  # which a loss of power may leave
            begins = json.dumps({"format": format})[:-1].encode()
            if not (rest.startswith(begins) or begins.startswith(rest)):
                raise ValueError
        if whole != content:
            cut(path, len(whole))
    except InvalidInput as error:
        raise _refused(option, name, str(error)) from None
    except OSError as error:
        raise _refused(option, name, reason(error)) from None
    except (ValueError, KeyError, TypeError, RecursionError):
        raise _refused(option, name, "this one is no such file") from None
    return lines


def _refused(option: str, name: str, why: str) -> InvalidInput:
    return InvalidInput(f"{option}: got {name}, expected a file that an earlier run kept its parts in, or a new name ({why})")
