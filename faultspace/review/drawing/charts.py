"""The charts of a page, each from plain numbers; every series has a shape of its own, so that none is told by its colour alone.

ranks         ranks over s, as they are and by formulas
closing_in    errors over the number of samples, both logarithmic
falling       singular values on a logarithmic scale, with a threshold and the rank that is right
strips        errors of methods over a bound, a row a method, a mark a record
word          the outputs of a word over its samples
Series        a label, values and the number of its colour and shape
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from statistics import median

from markupsafe import Markup, escape

from .axes import LEFT, Axis, Frame, picture, spanning

WIDTH, HEIGHT = 420, 260
ROW = 54  # pixels of a row of strips


@dataclass(frozen=True)
class Series:
    """Values that belong to the points of the other axis, None where there is none."""

    label: str
    values: Sequence[float | None]
    number: int


def ranks(windows: Sequence[int], series: Sequence[Series], title: str) -> Markup:
    """Return ranks over the number of samples s."""
    values = [value for one in series for value in one.values if value is not None]
    frame = Frame(Axis(windows[0] - 0.5, windows[-1] + 0.5), spanning([0, *values]), WIDTH, HEIGHT)
    body = frame.grid("samples s of the window", "rank", windows) + _drawn(frame, windows, series)
    return _with_legend(WIDTH, HEIGHT, title, series, body)


def closing_in(lengths: Sequence[int], series: Sequence[Series], title: str) -> Markup:
    """Return distances over N."""
    values = [value for one in series for value in one.values if value]
    frame = Frame(spanning(lengths, logarithmic=True), spanning(values, logarithmic=True), WIDTH, HEIGHT)
    body = frame.grid("samples N of the record", "distance") + _drawn(frame, lengths, series)
    return _with_legend(WIDTH, HEIGHT, title, series, body)


def falling(values: Sequence[float], right: int, threshold: float, title: str) -> Markup:
    """Return the values in falling order: those that the right rank keeps are filled."""
    frame = Frame(Axis(0.5, len(values) + 0.5), spanning([*values, threshold], logarithmic=True), WIDTH, HEIGHT)
    places = range(1, len(values) + 1)
    (left, y), (end, _) = frame.place(0.5, threshold), frame.place(len(values) + 0.5, threshold)
    body = frame.grid("number of the singular value", "size", places)
    body += f'<line class="mark" x1="{left:.1f}" x2="{end:.1f}" y1="{y:.1f}" y2="{y:.1f}"/>'
    kept = [value if place <= right else None for place, value in zip(places, values, strict=True)]
    rest = [None if place <= right else value for place, value in zip(places, values, strict=True)]
    series = [Series(f"the first {right}, as many as the exact rank", kept, 1), Series("the others", rest, 2)]
    body += "".join(_marks(frame, places, one) for one in series)
    return _with_legend(WIDTH, HEIGHT, title, [*series, Series(f"threshold {threshold:g}", [], 0)], body)


def strips(rows: Sequence[tuple[str, Sequence[float]]], title: str, label: str) -> Markup:
    """Return a row a method, a bar at the median, a line at 1."""
    values = [value for _, found in rows for value in found]
    width, height = 640, ROW * len(rows) + 54
    frame = Frame(spanning([0, 1, *values]), Axis(0, len(rows)), width, height)
    parts = []
    for tick in frame.x.ticks():
        x, y = frame.place(tick, 0)
        parts.append(f'<text x="{x:.1f}" y="{y + 16:.1f}" text-anchor="middle">{tick:g}</text>')
    (x, low), (_, high) = frame.place(1, 0), frame.place(1, len(rows))
    parts.append(f'<line class="mark" x1="{x:.1f}" x2="{x:.1f}" y1="{low:.1f}" y2="{high:.1f}"/>')
    for place, (name, found) in enumerate(rows):
        _, y = frame.place(0, len(rows) - place - 0.62)
        parts.append(f'<text x="{LEFT}" y="{y - 14:.1f}">{escape(name)}</text>')
        parts += [_shape(frame.place(value, 0)[0], y, place + 1) for value in found]
        if found:
            x = frame.place(median(found), 0)[0]
            parts.append(f'<line class="median" x1="{x:.1f}" x2="{x:.1f}" y1="{y - 10:.1f}" y2="{y + 10:.1f}"/>')
    parts.append(f'<text class="axis" x="{width / 2:.0f}" y="{height - 6}" text-anchor="middle">{escape(label)}</text>')
    said = "; ".join(f"{name}: median {median(found):.3g} of {len(found)}" for name, found in rows if found)
    return picture(width, height, title, said, "".join(parts))


def word(outputs: Sequence[Sequence[str]], title: str) -> Markup | None:
    """Return stems of each output over k; None where an output is no rational number, or there is nothing to draw."""
    try:
        numbers = [[float(Fraction(value)) for value in row] for row in outputs]
    except ValueError:
        return None
    if not numbers or not numbers[0]:
        return None
    count, channels = len(numbers), len(numbers[0])
    frame = Frame(Axis(-0.5, count - 0.5), spanning([0, *(value for row in numbers for value in row)]), WIDTH, 200)
    parts = [frame.grid("sample k", "r(k)", range(count))]
    (left, zero), (right, _) = frame.place(-0.5, 0), frame.place(count - 0.5, 0)
    parts.append(f'<line class="zero" x1="{left:.1f}" x2="{right:.1f}" y1="{zero:.1f}" y2="{zero:.1f}"/>')
    for channel in range(channels):
        for k, row in enumerate(numbers):
            x, y = frame.place(k + 0.16 * (channel - (channels - 1) / 2), row[channel])
            parts.append(
                f'<line class="stem c{channel % 3 + 1}" x1="{x:.1f}" x2="{x:.1f}" y1="{zero:.1f}" y2="{y:.1f}"/>{_shape(x, y, channel + 1)}'
            )
    series = [Series(f"output {channel + 1}", [row[channel] for row in numbers], channel + 1) for channel in range(channels)]
    return _with_legend(WIDTH, 200, title, series, "".join(parts))


def _drawn(frame: Frame, points: Sequence[float], series: Sequence[Series]) -> str:
    return "".join(_line(frame, points, one) + _marks(frame, points, one) for one in series)


def _line(frame: Frame, points: Sequence[float], one: Series) -> str:
    placed = [frame.place(x, y) for x, y in zip(points, one.values, strict=True) if y is not None]
    return f'<polyline class="line c{_colour(one.number)}" points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in placed)}"/>'


def _marks(frame: Frame, points: Sequence[float], one: Series) -> str:
    return "".join(_shape(*frame.place(x, y), one.number) for x, y in zip(points, one.values, strict=True) if y is not None)


def _colour(number: int) -> int:
    return (number - 1) % 3 + 1


def _shape(x: float, y: float, number: int) -> str:
    """Return a disc, a square or a triangle."""
    colour = _colour(number)
    if colour == 1:
        return f'<circle class="dot c1" cx="{x:.1f}" cy="{y:.1f}" r="4"/>'
    if colour == 2:
        return f'<rect class="dot c2" x="{x - 5.5:.1f}" y="{y - 5.5:.1f}" width="11" height="11"/>'
    return f'<path class="dot c3" d="M{x:.1f} {y - 7:.1f}l6.5 11h-13z"/>'


def _with_legend(width: int, height: int, title: str, series: Sequence[Series], body: str) -> Markup:
    """Return the picture with a line for each series below it, and the numbers in its description."""
    parts, said = [body], []
    for place, one in enumerate(series):
        y = height + 12 + 18 * place
        if one.number:
            parts.append(_shape(LEFT, y - 4, one.number))
            shown = ", ".join("none" if value is None else f"{value:.3g}" for value in one.values)
            said.append(f"{one.label}: {shown}")
        else:
            parts.append(f'<line class="mark" x1="{LEFT - 8}" x2="{LEFT + 8}" y1="{y - 4}" y2="{y - 4}"/>')
            said.append(one.label)
        parts.append(f'<text x="{LEFT + 14}" y="{y}">{escape(one.label)}</text>')
    return picture(width, height + 18 * len(series) + 6, title, "; ".join(said), "".join(parts))
