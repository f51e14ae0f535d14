"""The picture of the claims: a line a claim with its verdict in a sentence, in three groups.

Line     a claim's name, whose it is, its verdict, and the sentence
draw     the lines into axes of matplotlib
COLOURS  verdict -> its colour
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

TITLE = "What is true of the claims of one paper"
GROUPS = {"paper": "Claims of the paper, as its review states them", "review": "Claims of the review", "ours": "Claims of ours"}
COLOURS = {
    "PROVED": "#1b7837",
    "IDENTITY": "#5aae61",
    "CERTIFIED": "#a6dba0",
    "REFUTED": "#e08214",
    "AMENDED": "#9970ab",
    "ERROR": "#d7191c",
}
MEANINGS = {
    "PROVED": "proved, in the reading that the sentence names",
    "IDENTITY": "proved at stated dimensions",
    "CERTIFIED": "no counterexample found",
    "REFUTED": "false",
    "AMENDED": "false as stated, and repaired",
    "ERROR": "not decided",
}
NAMES, SENTENCES = 0.35, 5.2  # where these begin, in heights of a line


@dataclass(frozen=True)
class Line:
    """A claim's name, whose it is (a key of GROUPS), the verdict on it, and that in a sentence."""

    name: str
    group: str
    verdict: str
    sentence: str


def draw(lines: Sequence[Line], ax: Any = None) -> Any:
    """Draw the lines into the matplotlib axes `ax`, new ones where None are given, and return them.

    Raises ImportError where there is no matplotlib.
    """
    groups = {group: [line for line in lines if line.group == group] for group in GROUPS}
    groups = {group: of_group for group, of_group in groups.items() if of_group}
    height = len(lines) + 1.3 * len(groups)
    axes = _axes(height) if ax is None else ax
    axes.text(0, -1.2, TITLE, fontsize=12, weight="bold")
    row = 0.0
    for group, of_group in groups.items():
        axes.text(0, row, GROUPS[group], va="center", fontsize=9, weight="bold")
        for line in of_group:
            row += 1
            axes.plot(0.1, row, marker="s", markersize=7, color=COLOURS[line.verdict], clip_on=False)
            axes.text(NAMES, row, line.name, va="center", fontsize=8.5)
            axes.text(SENTENCES, row, line.sentence, va="center", fontsize=8)
        row += 1.3
    marker = import_module("matplotlib.lines").Line2D
    there = [verdict for verdict in COLOURS if any(line.verdict == verdict for line in lines)]
    handles = [marker([], [], marker="s", linestyle="", color=COLOURS[one], label=MEANINGS[one]) for one in there]
    if handles:
        axes.legend(handles=handles, loc="lower left", ncol=len(handles), frameon=False, fontsize=8.5, bbox_to_anchor=(0.0, 0.0))
    axes.set(xlim=(0, 33), ylim=(height + 1.0, -2.0))
    axes.axis("off")
    return axes


def _axes(height: float) -> Any:
    """Return the axes of a new figure of pyplot, which they fill."""
    try:
        pyplot: Any = import_module("matplotlib.pyplot")
    except ImportError:
        raise ImportError("plots need matplotlib: pip install 'faultspace[plots]'") from None
    return pyplot.figure(figsize=(10.5, 0.25 * height + 0.9)).add_axes((0.01, 0.0, 0.98, 1.0))
