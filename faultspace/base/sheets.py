"""What a person reads of a record: pairs of a name and a value, and the forms they are shown in.

Sheet      (name, value) pairs; a pair without a value is a heading, one without a name goes on with the value above it
line       one pair as a line of text
counted    a number with its noun: 1 sample, 2 samples
decibels   the natural logarithm of a ratio of powers in dB, which people know
told       some attributes of a record as JSON has them
Shown      gives a record with `title` and `sheet` its `summary()`, a short `repr` and the table that a notebook shows
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from math import log
from textwrap import fill
from typing import Any

from .others_text import lines, printable

Sheet = Iterable[tuple[str, str]]

NAME_WIDTH = 36
WIDTH = 80


def line(name: str, value: str) -> str:
    """Return one pair of a sheet on one line, the values of a sheet below each other."""
    return f"    {name:<{NAME_WIDTH}}{value}" if value else f"  {name}"


def counted(count: int, noun: str, plural: str = "") -> str:
    """Return the number with its noun, in the plural unless it is one; `plural` is needed where it is not the noun with an s."""
    return f"{count} {noun if count == 1 else plural or noun + 's'}"


def or_undecided(number: int | None) -> str:
    """Return the number, or that it is undecided."""
    return "undecided" if number is None else str(number)


def several(names: Sequence[str], most: int) -> str:
    """Return the names on one line, the first ones of many."""
    return ", ".join(names[:most]) + (f", ... ({len(names)} in all)" if len(names) > most else "")


def decibels(logarithm: float, unit: str = " dB") -> str:
    """Return the natural logarithm of a ratio of powers in dB: 4.34 times as much, with three digits."""
    return f"{10.0 / log(10.0) * logarithm:.3g}{unit}"


def _broken(name: str, value: str) -> str:
    """Return the pair on one line, or where that is wider than WIDTH, on lines whose values stand below each other."""
    whole, margin = line(name, value), " " * len(line("", " ")[:-1])
    if len(whole) <= WIDTH or not value:
        return whole
    return fill(value, WIDTH, initial_indent=line(name, " ")[:-1], subsequent_indent=margin, break_long_words=False, break_on_hyphens=False)


class Shown(ABC):
    """People can read the record: as text, as a line, as a table."""

    @property
    @abstractmethod
    def title(self) -> str:
        """What the record is about, on one short line."""

    @abstractmethod
    def sheet(self) -> Sheet:
        """These pairs are what there is to say of the record."""

    def summary(self) -> str:
        """Return the record in words: the title, then a line for each pair of the sheet, or more where 80 columns are not enough for it.
        These are the words that the command of the same name prints."""
        return lines("\n".join([self.title, *(_broken(name, value) for name, value in self.sheet())]))

    def __repr__(self) -> str:
        return printable(f"<{type(self).__name__}: {self.title}>")

    def _repr_html_(self) -> str:
        """Notebooks show the sheet as this table."""
        rows = "".join(
            f"<tr><td>{escape(name)}</td><td style='white-space: pre; text-align: left'>{escape(value)}</td></tr>"
            if value
            else f"<tr><th colspan='2' style='text-align: left'>{escape(name)}</th></tr>"
            for name, value in self.sheet()
        )
        return f"<table><caption>{escape(self.title)}</caption>{rows}</table>"


def told(record: object, *names: str) -> dict[str, Any]:
    """Return these attributes of a record as JSON has them: records by their own `to_json`, tuples as lists, other numbers as texts."""
    return {name: _as_json(getattr(record, name)) for name in names}


def _as_json(value: Any) -> Any:
    if hasattr(value, "to_json"):
        return value.to_json()
    if isinstance(value, Mapping):
        return {name: _as_json(one) for name, one in value.items()}
    if isinstance(value, (tuple, list)):
        return [_as_json(one) for one in value]
    return value if value is None or isinstance(value, (str, int, float)) else str(value)
