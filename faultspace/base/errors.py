"""These are the errors of bad input, and what their one line is made of.

InvalidInput    input that cannot be used: the text is one line, what was got and what is needed
InvalidData     the same of measured data
    >>> import faultspace as fs
    >>> try:
    ...     fs.System(A=1, F=[[1]], C=[[1]], G=[[0]])
    ... except fs.errors.InvalidInput as error:
    ...     print(error)
    A: got 1, expected a list of rows, try [[1]]

`faultspace.errors` has those of the checker beside these. What errors are made of:

shorten         a value cut to a length that fits an error message
quote_path      a file name as it can be shown on one line
in_file         puts a file's name in front of the complaint about what is in it
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["InvalidData", "InvalidInput", "in_file", "quote_path", "shorten"]


def __dir__() -> list[str]:
    return __all__.copy()


class InvalidInput(ValueError):
    """The input cannot be used. The message is one line: the place, what was got, what is expected."""


class InvalidData(InvalidInput):
    """No answer can be had from the measured data, or from a setting that goes with them. The message is one line, as of InvalidInput."""


def shorten(value: object, width: int = 60) -> str:
    """Return `repr(value)`, cut to `width` characters and to one line."""
    try:
        text = repr(value)
    except (ValueError, RecursionError):  # integers beyond Python's printing limit, deep nesting
        text = f"a {type(value).__name__} too large to print"
    text = " ".join(text.split())
    return text if len(text) <= width else text[: width - 3] + "..."


def quote_path(name: str) -> str:
    """Return the name itself where it prints on one line without doubt, else quoted."""
    return name if name.isprintable() and name == name.strip() and name else repr(name)


@contextmanager
def in_file(name: str) -> Iterator[None]:
    """Complaints from within name the file; what is too deep or too large for the interpreter becomes a complaint."""
    try:
        yield
    except InvalidInput as error:
        raise InvalidInput(f"{quote_path(name)}: {error}") from None
    except RecursionError:
        raise InvalidInput(f"{quote_path(name)}: got lists nested too deeply, expected a few levels") from None
    except MemoryError:
        raise InvalidInput(f"{quote_path(name)}: does not fit into memory, expected a smaller file") from None
