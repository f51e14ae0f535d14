"""The picture of the claims: a line a claim with its verdict, and a square a reading, first those of its words as stated, then ours.

Line     a claim's name and verdict, and the verdicts on its readings
draw     the lines into axes of matplotlib
COLOURS  verdict -> the colour of its squares
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

COLOURS = {
    "PROVED": "#1b7837",
    "IDENTITY": "#5aae61",
    "CERTIFIED": "#a6dba0",
    "REFUTED": "#e08214",
    "AMENDED": "#9970ab",
    "ERROR": "#d7191c",
}
ON_DARK = ("PROVED", "AMENDED", "ERROR")
IN_LEGEND = ("PROVED", "IDENTITY", "CERTIFIED", "REFUTED")
LEFT, GAP = 8.2, 0.6  # where the first square stands, and the space between the two groups, in squares


@dataclass(frozen=True)
class Line:
    """A claim's name and verdict, the verdicts on the readings of its words, and those on readings of ours."""

    name: str
    verdict: str
    stated: tuple[str, ...]
    ours: tuple[str, ...]


def draw(lines: Sequence[Line], ax: Any = None) -> Any:
    """Draw the lines into the matplotlib axes `ax`, new ones where None are given, and return them.

    Raises ImportError where there is no matplotlib.
    """
    axes = _axes(len(lines)) if ax is None else ax
    stated, ours = max((len(line.stated) for line in lines), default=0), max((len(line.ours) for line in lines), default=0)
    right = LEFT + stated + GAP
    for row, line in enumerate(lines):
        axes.text(0.1, row, line.name, va="center", fontsize=9)
        axes.text(4.9, row, line.verdict, va="center", fontsize=8, color="#333333")
        for start, group in ((LEFT, line.stated), (right, line.ours)):
            for column, verdict in enumerate(group):
                _square(axes, start + column, row, verdict)
    for place, heading in ((LEFT, "readings as stated"), (right, "readings of ours"), (0.1, "claim"), (4.9, "verdict")):
        axes.text(place, -1.0, heading, fontsize=9, weight="bold")
    patch = import_module("matplotlib.patches").Patch
    handles = [patch(facecolor=COLOURS[one], label=f"{one[0]}  {one}") for one in IN_LEGEND]
    axes.legend(handles=handles, loc="lower center", ncol=4, frameon=False, fontsize=8.5, bbox_to_anchor=(0.5, 0.0))
    axes.set(xlim=(0, right + ours + 0.2), ylim=(len(lines) + 0.8, -1.7))
    axes.axis("off")
    return axes


def _axes(count: int) -> Any:
    """Return the axes of a new figure of pyplot, which they fill."""
    try:
        pyplot: Any = import_module("matplotlib.pyplot")
    except ImportError:
        raise ImportError("plots need matplotlib: pip install 'faultspace[plots]'") from None
    return pyplot.figure(figsize=(9, 0.27 * count + 1.1)).add_axes((0.0, 0.0, 1.0, 1.0))


def _square(axes: Any, left: float, row: int, verdict: str) -> None:
    """Draw one reading, with the first letter of its verdict."""
    box = import_module("matplotlib.patches").FancyBboxPatch
    shape = box((left + 0.08, row - 0.36), 0.84, 0.72, boxstyle="round,pad=0,rounding_size=0.12")
    shape.set(facecolor=COLOURS[verdict], edgecolor="none")
    axes.add_patch(shape)
    colour = "white" if verdict in ON_DARK else "black"
    axes.text(left + 0.5, row, verdict[0], ha="center", va="center", fontsize=8, color=colour)
