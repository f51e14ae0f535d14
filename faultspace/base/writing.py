"""Files that are there whole or not at all, in places that somebody else may have prepared: no link is ever followed.

A file has the mode 0644 less what the process's mask takes away, which the operating system applies as it makes the file.
"""

from __future__ import annotations

import errno
import os
import secrets
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any

from .errors import InvalidInput, quote_path

MODE = 0o644
UNFINISHED = ".unfinished-"  # so begin the names of files and folders that are there for a moment
NO_LINK = getattr(os, "O_NOFOLLOW", 0)


def write_text(path: Path, text: str) -> None:
    """Write the text beside the file at `path` and rename it, so that no half-written file is ever seen there.

    Raises InvalidInput where that cannot be, and for what is there and no file, such as a link.
    """
    with whole_file(path) as stream:
        stream.write(text.encode("utf-8", "backslashreplace"))


@contextmanager
def whole_file(path: Path) -> Iterator[IO[bytes]]:
    """Yield a stream of bytes, which is the file at `path` once the body has come to its end, on the disk before it has the name.

    Raises InvalidInput as `write_text` does.
    """
    unfinished = path.parent / f"{UNFINISHED}{secrets.token_hex(8)}"
    try:
        _replaceable(path)
        with new_file(unfinished, "xb") as stream:
            try:
                yield stream
                stream.flush()
                os.fsync(stream.fileno())
            except BaseException:
                unfinished.unlink()
                raise
        try:
            os.replace(unfinished, path)
        except BaseException:
            unfinished.unlink()
            raise
    except (OSError, ValueError) as error:
        if isinstance(error, InvalidInput):
            raise
        raise InvalidInput(f"{quote_path(str(path))}: cannot be written ({reason(error)}), expected another path") from None


def new_file(path: Path, mode: str = "x", **how: Any) -> IO[Any]:
    """Return a file that was not there, open as `open` does with the mode "x" or "xb". Raises FileExistsError for one that was, and for a
    link, wherever it leads."""
    return open(path, mode, opener=lambda name, flags: os.open(name, flags | NO_LINK, MODE), **how)


def reason(error: Exception) -> str:
    """Return what the operating system says of an error, or the error says of itself, with a small letter first."""
    text = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return text[:1].lower() + text[1:]


def _replaceable(path: Path) -> None:
    """Raise OSError for what is there and no file. What comes between this and the renaming is replaced, and not followed."""
    with suppress(FileNotFoundError):
        kind = os.lstat(path).st_mode
        if not stat.S_ISREG(kind):
            what = "a link" if stat.S_ISLNK(kind) else "a folder" if stat.S_ISDIR(kind) else "a pipe or a device"
            raise FileExistsError(errno.EEXIST, f"{what} is there", str(path))
