"""How people name checks: by slug, slug[vector], slug[vector]-function, or a pattern of one of them.

named      whether a check or a result has a name that fits
patterned  whether a name is a pattern
"""

from __future__ import annotations

import re
from functools import cache

from .records import Named


def patterned(name: str) -> bool:
    """This tells whether the name holds * or ?; brackets are part of names."""
    return "*" in name or "?" in name


def named(one: Named, name: str) -> bool:
    """This tells whether one of the names of a check or a result is `name`, in which * stands for any characters and ? for one."""
    return any(_pattern(name).fullmatch(known) for known in one.names)


@cache
def _pattern(name: str) -> re.Pattern[str]:
    return re.compile("".join({"*": ".*", "?": "."}.get(letter, re.escape(letter)) for letter in name))
