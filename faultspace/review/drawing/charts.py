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
