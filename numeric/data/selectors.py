"""The channels of a file by their names: columns of a table, or parts of the arrays that it holds.

split_names     'a,b[:,1:3],"c, kW"' -> ["a", "b[:,1:3]", "c, kW"]: commas inside brackets and quotes do not separate
quoted          a name as split_names takes it for one: "c, kW" in quotes, others as they are
named_once      the refusal of a channel that is named more than once
labels_of       the names of the channels that a selector stands for
picked          what a selector stands for, out of arrays by name
missing         the refusal of a name that is not there, a Missing

Of an array, NAME is all columns, NAME[:,j] or NAME[j] column j, NAME[:,i:j] several, NAME[i,:] row i, NAME[i,j] channel (i, j) of an array
whose first of three axes is time. Indices count from 0. Everything wrong raises InvalidInput or InvalidData.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...base.errors import InvalidData, InvalidInput, shorten

MOST_NAMED = 12  # names that a refusal lists
MOST_COMPARED = 1000  # names that one which is not there is compared with
_QUOTED = re.compile(r'\s*"((?:[^"]|"")*)"\s*')
_PART = re.compile(rf"{_QUOTED.pattern}(?=,|$)|(?:\[[^\[\]]*\]|[^,])+")
_PLAIN = re.compile(r'(?:[^",\[\]]|\[[^"\[\]]*\])+')
_SELECTOR = re.compile(r"^(?P<name>.+?)\[(?P<indices>[0-9:,\s]+)\]$")


def split_names(given: str | Sequence[str]) -> list[str]:
    """Return the names in a text, or in texts, that may each hold several, separated by commas outside brackets. A name with a comma of its
    own stands in double quotes, and a quote within it twice, as in CSV. Raises InvalidData for what is no text."""
    given = [given] if isinstance(given, str) else list(given)
    wrong = [name for name in given if not isinstance(name, str)]
    if wrong:
        raise InvalidData(f"got {shorten(wrong[0])} as the name of a channel, expected text: a matrix's columns are data[:,0], data[:,1:3]")
    parts = [part[0] for text in given for part in _PART.finditer(text)]
    names = [whole[1].replace('""', '"') if (whole := _QUOTED.fullmatch(part)) else part.strip() for part in parts]
    return [name for name in names if name]


def quoted(name: str) -> str:
    """Return the name in the form that `split_names` reads as this one name."""
    return name if _PLAIN.fullmatch(name) and name.strip() == name else '"{}"'.format(name.replace('"', '""'))


def named_once(inputs: Sequence[str], outputs: Sequence[str]) -> None:
    """Raise InvalidData for a channel named more than once."""
    both = [name for name in inputs if name in outputs]
    if both:
        raise InvalidData(f"got channel {shorten(both[0])} as input and as output, expected it to be one of them")
    for names in (inputs, outputs):
        twice = [name for i, name in enumerate(names) if name in names[:i]]
        if twice:
            raise InvalidData(f"got channel {shorten(twice[0])} twice, expected every channel once")


def labels_of(selector: str, count: int) -> list[str]:
    """Return the channels that a selector stands for: itself, or for several its last range replaced by each number."""
    if count == 1:
        return [selector]
    match = _SELECTOR.match(selector)
    name, indices = (match["name"], match["indices"].split(",")) if match else (selector, [":", ":"])
    place = max(i for i, index in enumerate(indices) if ":" in index)
    start = indices[place].partition(":")[0].strip()
    first = int(start) if start else 0
    return [f"{name}[{','.join([*indices[:place], str(first + j), *indices[place + 1 :]])}]" for j in range(count)]


def picked(arrays: Mapping[str, Any], selector: str, what: str) -> Any:
    """Return what the selector stands for: an array itself, or NAME[...] of one."""
    there = list(arrays)
    if selector in there:
        return arrays[selector]
    match = _SELECTOR.match(selector)
    if match is None or match["name"] not in there:
        raise missing(match["name"] if match else selector, there, what)
    array = np.asarray(arrays[match["name"]])
    parts = [part.strip() for part in match["indices"].split(",")]
    try:
        index = tuple(int(part) if ":" not in part else _range(part) for part in parts)
    except (ValueError, TypeError):
        raise InvalidInput(f"got {shorten(selector)}, expected NAME[:,j] with j an integer counted from 0 or a range i:j") from None
    name, shape = match["name"], " x ".join(map(str, array.shape))
    if len(index) == array.ndim - 1 and not (len(index) == 1 and isinstance(index[0], slice)):
        index = (slice(None), *index)  # the axis not spoken of is time
    if len(index) != array.ndim:
        pattern = ",".join([":", *"j" * (array.ndim - 1)])
        raise InvalidInput(f"got {shorten(selector)} of a {shape} array, expected {array.ndim} indices, as in {name}[{pattern}]")
    try:
        values = array[index]
    except IndexError:
        raise InvalidInput(f"got {shorten(selector)}, but {name} is {shape}: indices count from 0") from None
    if values.ndim == 0:
        advice = f"{name}[:,{parts[-1]}] is column {parts[-1]}"
        raise InvalidInput(f"got {shorten(selector)}, one number of a {shape} array; expected a channel: {advice}")
    return values


def _range(text: str) -> slice:
    first, last = (int(number) if number.strip() else None for number in text.split(":"))
    return slice(first, last)


class Missing(InvalidInput):
    """The refusal of a name that is not among those that are `there`, which are `columns` or whole arrays."""

    def __init__(self, message: str, there: Sequence[str], *, columns: bool) -> None:
        super().__init__(message)
        self.there, self.columns = tuple(there), columns


def missing(name: str, there: Sequence[str], what: str) -> Missing:
    """Return the refusal of a name that is not among those that are there, which `what` calls columns, arrays or variables."""
    if not there:
        return Missing(f"got no {what} at all, expected {shorten(name)}", there, columns=what.startswith("column"))
    listed = ", ".join(map(quoted, there[:MOST_NAMED])) + (f", ... ({len(there)} in all)" if len(there) > MOST_NAMED else "")
    near = [other for other in there if other.lower().strip() == name.lower().strip()]
    near = near or difflib.get_close_matches(name, there[:MOST_COMPARED], n=1)
    advice = f"; did you mean {shorten(near[0])}?" if near else ""
    return Missing(f"there is no {what} {shorten(name)}, expected one of: {listed}{advice}", there, columns=what.startswith("column"))
