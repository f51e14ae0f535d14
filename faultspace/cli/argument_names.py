"""Write the arguments of the library as the options of the commands, in messages that name them.

as_options      a message of the library in the words of the command line
OPTIONS         argument -> option
"""

from __future__ import annotations

import re

OPTIONS = {
    "order": "--order", "block_rows": "--block-rows", "n_v": "--faults", "healthy": "--healthy-until", "remove_means": "--remove-means",
    "dt": "--dt", "noise_level": "--noise-level",
    "command": "--exec", "peer": "--peer",
}  # fmt: skip
_ARGUMENT = re.compile(r"\b(" + "|".join(OPTIONS) + r")=(?:True\b|(\w+))?")
_SUBJECT = re.compile(r"(?:^|(?<=: ))(" + "|".join(OPTIONS) + "): ")


def as_options(message: str) -> str:
    """Return the message in options: `order=3` becomes `--order 3`, and `remove_means=True` becomes `--remove-means`.

    What begins with `n_v: `, be it after a file's name, is about `--faults`.
    """
    message = _SUBJECT.sub(lambda found: f"{OPTIONS[found[1]]}: ", message)
    return _ARGUMENT.sub(lambda found: OPTIONS[found[1]] + (f" {found[2]}" if found[2] else ""), message)
