"""The arguments of `faultspace.identify` as the options of the command, in messages that name them.

as_options      a message of the library in the words of the command line
OPTIONS         argument -> option
"""

from __future__ import annotations

import re

OPTIONS = {
    "order": "--order", "block_rows": "--block-rows", "n_v": "--faults", "healthy": "--healthy-until", "remove_means": "--remove-means",
}  # fmt: skip
_ARGUMENT = re.compile(r"\b(" + "|".join(OPTIONS) + r")=(?:True\b|(\w+))?")
_SUBJECT = re.compile(r"^(" + "|".join(OPTIONS) + "): ")


def as_options(message: str) -> str:
    """`order=3` as `--order 3`, `remove_means=True` as `--remove-means`, and a message that begins with `n_v: ` as one about `--faults`."""
    message = _SUBJECT.sub(lambda found: f"{OPTIONS[found[1]]}: ", message)
    return _ARGUMENT.sub(lambda found: OPTIONS[found[1]] + (f" {found[2]}" if found[2] else ""), message)
