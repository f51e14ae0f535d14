"""This opens files that people name; what may never end, or would wait for somebody who writes, is refused at once."""

from __future__ import annotations

import os
import stat
import sys
from typing import BinaryIO

from .errors import InvalidInput
from .writing import NO_LINK, reason


def open_regular(path: str | os.PathLike[str], expected: str) -> BinaryIO:
    """Return the file at `path`, open for reading bytes; `expected` is what it should be, as "a JSON file".

    A pipe is not opened for reading, which would wait until somebody writes. Raises InvalidInput for what cannot be opened and for what is
    no regular file.

    >>> import os
    >>> open_regular(os.devnull, "a JSON file")
    Traceback (most recent call last):
    faultspace.base.errors.InvalidInput: is a pipe or a device, expected a JSON file
    """
    return _opened(path, expected, 0)


def open_own(path: str | os.PathLike[str], expected: str) -> BinaryIO:
    """Return the file at `path` as `open_regular` does. Raises InvalidInput for a link, too, wherever it leads."""
    return _opened(path, expected, NO_LINK)


def _opened(path: str | os.PathLike[str], expected: str, flags: int) -> BinaryIO:
    try:
        # What is not there on Windows is not needed there: no pipe has a name in a folder.
        descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0) | flags)
    except (OSError, ValueError) as error:
        raise InvalidInput(f"cannot be read ({reason(error)}), expected {expected}") from None
    kind = os.fstat(descriptor).st_mode
    if not stat.S_ISREG(kind):
        os.close(descriptor)
        what = "is a directory" if stat.S_ISDIR(kind) else "is a pipe or a device"
        raise InvalidInput(f"{what}, expected {expected}")
    return os.fdopen(descriptor, "rb")


def standard_input() -> BinaryIO:
    """Return standard input as a stream of bytes. Raises InvalidInput where whoever started us has closed it."""
    if sys.stdin is None:
        raise InvalidInput("standard input: is closed, expected one to read from")
    return sys.stdin.buffer
