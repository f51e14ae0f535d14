"""The frame of a chart: what lies where, lines of the grid, labels; colours are classes, which the page's style sheet gives their values.

Axis     from values to places, linear or logarithmic, with its ticks
Frame    two axes in a picture; `grid` draws them
picture  an SVG with a title and a description in words
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor, log10

from markupsafe import Markup, escape

LEFT, RIGHT, TOP, BOTTOM = 52, 14, 14, 40  # pixels around the plot, for the labels


@dataclass(frozen=True)
class Axis:
    """`low` and `high` are the values at its ends."""

    low: float
    high: float
    logarithmic: bool = False

    def at(self, value: float) -> float:
        """Return where a value lies, 0 at the low end and 1 at the high one."""
        low, high, here = (log10(one) if self.logarithmic else one for one in (self.low, self.high, value))
        return (here - low) / (high - low)

    def ticks(self) -> list[float]:
        """Return the values that are labelled."""
        if self.logarithmic:
            return [10.0**k for k in range(ceil(log10(self.low) - 1e-9), floor(log10(self.high) + 1e-9) + 1)]
        step = _step((self.high - self.low) / 6)
        return [k * step for k in range(ceil(self.low / step - 1e-9), floor(self.high / step + 1e-9) + 1)]


def spanning(values: Sequence[float], *, logarithmic: bool = False) -> Axis:
    """Return an axis that holds all values: whole decades, or a little more than they need."""
    low, high = min(values), max(values)
    if logarithmic:
        first, last = floor(log10(low)), ceil(log10(high))
        return Axis(10.0**first, 10.0 ** max(last, first + 1), True)
    margin = 0.05 * (high - low) or 1.0
    return Axis(low - margin, high + margin)


@dataclass(frozen=True)
class Frame:
    """`x` runs to the right and `y` up, in a picture of `width` x `height` pixels."""

    x: Axis
    y: Axis
    width: int
    height: int

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Return the pixel of a point."""
        inner = self.width - LEFT - RIGHT, self.height - TOP - BOTTOM
        return LEFT + self.x.at(x) * inner[0], self.height - BOTTOM - self.y.at(y) * inner[1]

    def grid(self, x_label: str, y_label: str, x_ticks: Sequence[float] | None = None) -> str:
        """Return the lines and labels of both axes."""
        parts = []
        for value in self.y.ticks():
            _, y = self.place(self.x.low, value)
            parts.append(f'<line class="grid" x1="{LEFT}" x2="{self.width - RIGHT}" y1="{y:.1f}" y2="{y:.1f}"/>')
            parts.append(f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{_label(value, self.y.logarithmic)}</text>')
        for value in self.x.ticks() if x_ticks is None else x_ticks:
            x, _ = self.place(value, self.y.low)
            parts.append(
                f'<text x="{x:.1f}" y="{self.height - BOTTOM + 16}" text-anchor="middle">{_label(value, self.x.logarithmic)}</text>'
            )
        middle, centre = self.height - BOTTOM - (self.height - TOP - BOTTOM) / 2, (LEFT + self.width - RIGHT) / 2
        parts.append(f'<text class="axis" x="{centre:.0f}" y="{self.height - 6}" text-anchor="middle">{escape(x_label)}</text>')
        parts.append(f'<text class="axis" transform="translate(13 {middle:.0f}) rotate(-90)" text-anchor="middle">{escape(y_label)}</text>')
        return "".join(parts)


def picture(width: int, height: int, title: str, description: str, body: str, role: str = "img") -> Markup:
    """Return the SVG, which shrinks with its place; those who do not see it hear title and description.

    With links in it, its role is not "img", whose inside nobody hears, but "group".
    """
    return Markup(
        f'<svg class="chart" viewBox="0 0 {width} {height}" width="{width}" height="{height}" role="{role}" '
        f'aria-label="{escape(f"{title}. {description}")}">{body}</svg>'
    )


def _step(least: float) -> float:
    scale = 10.0 ** floor(log10(least))
    return next((m * scale for m in (1, 2, 5) if m * scale >= least), 10 * scale)


def _label(value: float, logarithmic: bool) -> str:
    if logarithmic:
        power = round(log10(value))
        return f"{value:g}" if -2 <= power <= 3 else f'10<tspan dy="-5" font-size="9">{power}</tspan>'
    return f"{value:g}"
