"""Write the arguments of the library as the options of the commands, in messages that name them.

as_options      a message of the library in the words of the command line
of_file         the same where the healthy samples come from --healthy FILE, not from --healthy-until K
naming          a context in which what is refused is told in the words of one of these
OPTIONS         argument -> option
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ..base.errors import InvalidInput

OPTIONS = {
    "order": "--order", "block_rows": "--block-rows", "n_v": "--faults", "healthy": "--healthy-until",
    "operating_point": "--operating-point", "dt": "--dt", "noise_level": "--noise-level",
    "command": "--exec", "peer": "--peer", "pdf": "--pdf",
}  # fmt: skip
_ARGUMENT = re.compile(r"\b(" + "|".join(OPTIONS) + r")=(?:True\b|\"?(\w+)\"?)?")
_SUBJECT = re.compile(r"(?:^|(?<=: ))(" + "|".join(OPTIONS) + "): ")

_HEALTHY = re.compile(r"(?:^|(?<=: ))healthy: ")


def as_options(message: str) -> str:
    """Return the message in options: `order=3` becomes `--order 3`, and `operating_point="means"` becomes
    `--operating-point means`.

    What begins with `n_v: `, be it after a file's name, is about `--faults`.
    """
    message = _SUBJECT.sub(lambda found: f"{OPTIONS[found[1]]}: ", message)
    return _ARGUMENT.sub(lambda found: OPTIONS[found[1]] + (f" {found[2]}" if found[2] else ""), message)


def of_file(message: str) -> str:
    """Return the message in options where the healthy record is a file: what is said of `healthy` is about --healthy FILE."""
    return as_options(_HEALTHY.sub("--healthy: ", message).replace("healthy=True", "--healthy FILE"))


@contextmanager
def naming(worded: Callable[[str], str]) -> Iterator[None]:
    """Word what is refused within."""
    try:
        yield
    except InvalidInput as error:
        raise type(error)(worded(str(error))) from None
