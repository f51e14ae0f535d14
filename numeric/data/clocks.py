"""This recognises the time of a record: a column of seconds or dates, its step, and what is odd about it.

Clock             what a time column says: the step dt, and where steps differ
clock_from        the Clock of a column; clock_of: of times in seconds
first_clock       the Clock of the first column that holds times
whole_clock       that of a stretch without gaps
time_name         which of some names is that of a time column
seconds_in        how many seconds the unit of a name has: "t [ms]" -> 0.001
seconds_of        times of any kind (numbers, dates, texts) in seconds

A step is one of the record where all times lie on a line to what their digits can say. Else, where most steps are equal and all others are
whole multiples of them, rows are missing. All else is jitter. With steps of one or two digits both readings may fit, as 1, 2, 4, 5 s may be
1.3 s rounded; where a step in four or more is longer, it is rounding that is believed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...base.arrays import Array

NAMES = (
    "time", "t", "timestamp", "date", "datetime", "date_time", "date time", "time stamp", "time_stamp", "clock", "elapsed",
    "zeit", "datum", "uhrzeit", "zeitstempel", "temps", "tiempo", "fecha", "tempo",
)  # fmt: skip
UNITS = {
    "ns": 1e-9, "us": 1e-6, "\u00b5s": 1e-6, "\u03bcs": 1e-6, "ms": 1e-3, "s": 1.0, "sec": 1.0, "seconds": 1.0,
    "min": 60.0, "minutes": 60.0, "h": 3600.0, "hours": 3600.0, "d": 86400.0, "days": 86400.0,
}  # fmt: skip
WORDS = ("dates", "durations")  # units that need no name
ODD = 0.25
"""The share of longer steps from which they are put down to rounding and not to rows that are missing."""
DIGITS_TRIED = range(10)
_NAME = re.compile(r"^(?P<name>[^\[\](),]*?)[\s_]*(?:[\[(]\s*(?P<bracket>[^\[\]()]+?)\s*[\])]|(?<=_)(?P<tail>ns|us|ms|s|sec|min|h))?$")


@dataclass(frozen=True)
class Clock:
    """The times of a record step by `dt` seconds: the mean step, or where rows are missing the least one.

    `name` is the column's, and its numbers were taken as `unit`, a word. `least` and `greatest` are steps in seconds, `resolution` is what
    the digits of the times can tell apart. `regular` says that all steps are dt to that; `missing` counts rows that are not there,
    `backwards` steps that do not go on, `first_odd` is the first sample that is not where it should be, and `gaps` are those with rows
    missing before them.
    """

    name: str
    dt: float
    least: float
    greatest: float
    resolution: float
    unit: str = "seconds"
    regular: bool = True
    missing: int = 0
    backwards: int = 0
    first_odd: int | None = None
    gaps: tuple[int, ...] = ()

    @property
    def source(self) -> str:
        """Return what the times were taken for, in words."""
        return f"{self.unit} in {self.name}" if self.unit in WORDS else f"column {self.name}, its unit taken as {self.unit}"


def time_name(names: Iterable[str]) -> str | None:
    """Return the first of these names that is one of a time column, None where none is."""
    for name in names:
        found = _NAME.match(str(name).strip())
        bare = found["name"].strip().lower() if found else ""
        unit = ((found["bracket"] or found["tail"]) if found else None) or "s"
        if bare in NAMES and unit.strip().lower() in UNITS:
            return name
    return None


def first_clock(names: Iterable[str], column: Callable[[str], Any], units: Mapping[str, str] | None = None) -> Clock | None:
    """Return the Clock of the first of these names that is a time's and whose `column` holds times that move; `units` may have its unit."""
    for name in names:
        if time_name([name]) is not None:
            clock = clock_from(column(name), name, (units or {}).get(name, ""))
            if clock is not None:
                return clock
    return None


def seconds_in(name: str) -> tuple[float, str]:
    """Return how many seconds the unit in a name has, and its word; seconds where it names none."""
    found = _NAME.match(name.strip())
    unit = ((found["bracket"] or found["tail"]) if found else None) or ""
    known = UNITS.get(unit.strip().lower())
    return (1.0, "seconds") if known is None else (known, unit.strip())


def seconds_of(values: Any, name: str) -> tuple[Array, str] | None:
    """Return times (N,), numbers in the unit of their name, dates or texts of dates, in seconds from the first, and the unit's word; None
    where they are none of these."""
    array = np.asarray(values)
    if array.ndim != 1 or len(array) < 2:
        return None
    if array.dtype.kind in "OUST":
        try:
            array = np.array([_plain_date(text) for text in array], dtype="datetime64[ns]")
        except (TypeError, ValueError):
            return None
    if array.dtype.kind in "Mm":
        kind = "datetime64[ns]" if array.dtype.kind == "M" else "timedelta64[ns]"
        whole = array.astype(kind)
        if np.any(np.isnat(whole)):
            return None
        return (whole - whole[0]).astype(np.int64) * 1e-9, WORDS[kind[0] != "d"]
    if array.dtype.kind not in "fiu" or not np.all(np.isfinite(array.astype(np.float64))):
        return None
    factor, unit = seconds_in(name)
    # Differences first: the digits of a large starting time are those of the differences too.
    return np.asarray(array - array[0], dtype=np.float64) * factor, unit


def _plain_date(text: Any) -> str:
    """Return a date as numpy reads it: with a T, and without a zone, which is the same for all where steps are regular. Days come as
    2024-03-01, 2024/03/01 or 01.03.2024, with or without a time of the day, or are left out."""
    word = str(text).strip().replace(" ", "T", 1).replace("/", "-")
    if re.match(r"\d{2}:\d{2}", word):
        word = f"1970-01-01T{word}"
    if day := re.match(r"(\d{2})\.(\d{2})\.(\d{4})", word):
        word = f"{day[3]}-{day[2]}-{day[1]}{word[day.end() :]}"
    if not re.match(r"\d{4}-\d{2}-\d{2}(T\d{2}:\d{2}|$)", word):
        raise ValueError(word)
    word = re.sub(r"(?<=:\d{2}),(?=\d)", ".", word)
    return re.sub(r"(?:Z|[+-]\d{2}:?\d{2})$", "", word) if "T" in word else word


def clock_from(values: Any, name: str, unit: str = "") -> Clock | None:
    """Return the Clock of a column's values (N,), numbers, dates or texts of dates; `unit` is that of a line of units, where there is one.
    None for what is no time."""
    titled = f"{name} [{unit}]" if unit.strip().lower() in UNITS else name
    found = seconds_of(values, titled)
    if found is None:
        return None
    times, unit_word = found
    factor, array = seconds_in(titled)[0], np.asarray(values)
    # What a float has lost of a large starting time.
    rounding = float(np.spacing(np.abs(array).max())) * factor if array.dtype.kind == "f" else 0.0
    return clock_of(times, name, unit_word, factor=factor, rounding=rounding)


def clock_of(times: Array, name: str, unit: str = "seconds", *, factor: float = 1.0, rounding: float = 0.0) -> Clock | None:
    """Return what times (N,) in seconds say, N >= 2; `factor` seconds make one unit of the numbers that were written, and `rounding`
    seconds are what each has lost. None where they do not move at all."""
    steps = np.diff(times)
    if not len(steps) or not np.any(steps):
        return None
    resolution = max(_resolution(times / factor) * factor, 2 * rounding)
    mean = float(times[-1] - times[0]) / len(steps)
    found = Clock(name, mean, float(steps.min()), float(steps.max()), resolution, unit)
    typical = float(np.median(steps))
    tiny = 1e-9 * max(abs(typical), float(np.abs(times).max())) + np.finfo(np.float64).eps * float(np.abs(times).max())
    back = np.flatnonzero(steps < 0) if resolution >= typical else np.flatnonzero(steps <= 0)
    if len(back):
        forward = max(typical, mean) if max(typical, mean) > 0 else max(-typical, -mean)  # a record may stand in reverse order
        return replace(found, dt=forward, regular=False, backwards=len(back), first_odd=int(back[0]) + 1)
    multiples = np.round(steps / typical) if typical > 0 else np.zeros(len(steps))
    longer = multiples > 1
    if longer.any() and longer.mean() < ODD and np.all(multiples >= 1) and np.all(np.abs(steps - multiples * typical) <= resolution + tiny):
        gone = int(np.sum(multiples - 1))
        gaps = tuple(int(k) + 1 for k in np.flatnonzero(longer))
        return replace(found, dt=typical, regular=False, missing=gone, first_odd=gaps[0], gaps=gaps)
    line = times - times[0] - mean * np.arange(len(times))
    odd = np.flatnonzero(np.abs(line - (line.max() + line.min()) / 2) > resolution + tiny)
    return replace(found, regular=not len(odd), first_odd=int(odd[0]) if len(odd) else None)


def whole_clock(clock: Clock) -> Clock | None:
    """Return the clock of a stretch between the gaps of this one, None where its steps are odd in other ways."""
    if clock.regular:
        return clock
    return replace(clock, regular=True, missing=0, first_odd=None, gaps=(), greatest=clock.dt) if clock.gaps else None


def _resolution(numbers: Array) -> float:
    """Return the place of the last decimal that the numbers have, 10^-d; 0 where they have more than can be told."""
    sizes = float(np.abs(numbers).max())
    for digits in DIGITS_TRIED:
        scaled = numbers * 10.0**digits
        if np.all(np.abs(scaled - np.round(scaled)) <= 1e-6 + 4 * np.finfo(np.float64).eps * sizes * 10.0**digits):
            return float(10.0**-digits)
    return 0.0
