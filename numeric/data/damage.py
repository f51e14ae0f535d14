"""This turns what libraries say of damaged files into complaints about the file, and refuses files that unpack to what no disk holds."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from ...base.errors import InvalidInput
from ...base.sheets import counted

DEFLATE_MOST = 1032
"""No byte of a packed file stands for more bytes than this: two codes of one bit each are 258 bytes [D96, section 3.2.5]. Only runs of one
byte come near."""
RUN = DEFLATE_MOST - 32
"""From here on a packed array is taken for one run of equal bytes: what surrounds a run of some MiB costs it less than this, which a test
measures on 64 MiB of zeros, and bytes that vary at all stay far below."""


@contextmanager
def from_library(read_as: str, expected: str) -> Iterator[None]:
    """Make InvalidInput of whatever is raised within, which must be calls of a library alone: over damaged bytes these raise what comes.

    zlib.error, struct.error, TokenError and KeyError have been seen. Errors of the operating system, and of memory, pass as they are.
    """
    try:
        yield
    except (InvalidInput, OSError, EOFError, MemoryError, ImportError):
        raise
    except Exception as error:
        line = (str(error).strip().splitlines() or [type(error).__name__])[0]
        raise InvalidInput(f"cannot be read as {read_as} data ({line}), expected {expected}") from None


def unpacks_to(size: int, packed: int, room: int, where: str) -> None:
    """Raise InvalidInput where `packed` bytes say that they are `size` bytes, which they cannot be or which is more than the `room`, in
    bytes, that `where` has."""
    if size > RUN * packed:
        got = f"{counted(size, 'byte')} packed into {packed}"
        raise InvalidInput(f"got {got}, which is one value over and over or damaged, expected measured signals")
    if size > room:
        raise InvalidInput(f"got {counted(size, 'byte')} to unpack, more than the {room} that {where} has, expected a smaller file, or CSV")


@contextmanager
def readable(read_as: str) -> Iterator[None]:
    """Raise InvalidInput where what is read turns out to be damaged."""
    try:
        yield
    except (OSError, EOFError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise InvalidInput(f"cannot be read as {read_as} data ({reason[:1].lower()}{reason[1:]}), expected a data file") from None
