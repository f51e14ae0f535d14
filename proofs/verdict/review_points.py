"""The public review of the paper, point by point in its order, and where it is to be had.

Point    what the review says, what is true, and the claims behind that
review   all points
source   author, title, date and address
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import Any

FILE = "review.toml"


@dataclass(frozen=True)
class Point:
    """One point: the `section` of the review, words of it to find the place by, what it `says`, what is `true`, and claims by their ids."""

    section: str
    quote: str
    says: str
    true: str
    cards: tuple[str, ...]


def review() -> tuple[Point, ...]:
    """Return all points."""
    return tuple(Point(**one | {"cards": tuple(one["cards"])}) for one in _contents()["point"])


def source() -> dict[str, str]:
    """Return author, title, how it was made, date, address, and the address of the paper."""
    return dict(_contents()["source"])


@lru_cache(maxsize=1)
def _contents() -> dict[str, Any]:
    return tomllib.loads(resources.files(__package__).joinpath(FILE).read_text("utf-8"))
