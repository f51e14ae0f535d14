"""This draws the comparison at the bound: a row a tool, a column a kind of systems, errors over the bound on a logarithmic axis.

    picture     the SVG of a comparison
    draw        the figure of matplotlib

Of each tool and cell it shows the median as a mark, half of the records as a thick line and four fifths of them as a thin one; filled
circles are white inputs, open diamonds are coloured ones. Failures stand in words. A result that has more than half of its records beyond
the axis is an arrow. Colours repeat what the names of the rows say.
"""

from __future__ import annotations

import io
from typing import Any

from benchmarks.peers_at_the_bound_results import CellResults, Comparison, Result, quantile
from benchmarks.peers_at_the_bound_tools import AUTHOR, OURS, PAPER, PAST_DATA, PAST_INPUTS, TOOLS

INK, FAINT = "#222222", "#9a9a9a"
COLOURS = {OURS: "#0072b2", PAPER: "#d55e00", AUTHOR: "#d55e00"}  # of the palette that the colour-blind tell apart
HEADINGS = {PAST_INPUTS: "past inputs as instruments", PAST_DATA: "past outputs as instruments"}
WITHOUT = "no instruments"
LABELS = {OURS: "ours", PAPER: "the paper's way (PI-MOESP)", AUTHOR: "the author's program"}
PACKAGES = {"SLICOT": "SLICOT (ctrlsys)", "Octave": "Octave control", "sippy": "sippy_unipi", "control": "python-control"}
MODELS = {
    "paper": "Model, paper's study:\n5 states, 1 input, 3 outputs",
    "2in3out": "Model: 4 states,\n2 inputs, 3 outputs",
    "1in1out": "Model: 4 states,\n1 input, 1 output",
}
SPACES = "Fault space,\npaper's study"
AXIS = (0.3, 40.0)
TICKS = (0.5, 1, 2, 5, 10, 20)
WIDTH, ROW, TOP, BOTTOM, LEFT, RIGHT = 10.5, 0.225, 1.42, 0.84, 2.2, 0.08  # inches


def picture(comparison: Comparison) -> str:
    """Return the SVG, the same for the same comparison."""
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams |= {"svg.hashsalt": "faultspace", "svg.fonttype": "none", "font.family": "sans-serif"}
    stream = io.StringIO()
    draw(comparison).savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return stream.getvalue()


def draw(comparison: Comparison) -> Any:
    """Return a figure of the shortest records that were measured."""
    from matplotlib.figure import Figure

    samples = min(cell.samples for cell in comparison.cells)
    panels: dict[str, list[CellResults]] = {}
    for title, part in (("", comparison.cells), (SPACES, comparison.spaces)):
        for cell in part:
            if cell.samples == samples:
                panels.setdefault(title or MODELS[cell.cell.split()[0]], []).append(cell)
    rows = _rows(comparison.tools)
    height = TOP + BOTTOM + ROW * len(rows)
    figure = Figure(figsize=(WIDTH, height), facecolor="white")
    width = (WIDTH - LEFT - RIGHT) / len(panels)
    for column, (title, cells) in enumerate(panels.items()):
        place = (LEFT + column * width, BOTTOM, 0.95 * width, ROW * len(rows))
        axes = figure.add_axes((place[0] / WIDTH, place[1] / height, place[2] / WIDTH, place[3] / height))
        _panel(axes, title, rows)
        for cell in cells:
            _marks(axes, rows, cell)
        middle = (place[0] + place[2] / 2) / WIDTH
        figure.text(middle, (BOTTOM - 0.42) / height, "error / bound", fontsize=9.5, ha="center", color=INK)
        if title == SPACES:
            _silent(axes, rows, cells)
        if column == 0:
            _names(axes, rows)
    for line, words in enumerate(
        (
            "How near to the truth does each tool come, from the same faulty records?",
            "1 is the Cramér-Rao bound: no unbiased method has a smaller root mean square error. A method at the bound has a median of",
            f"about 0.9 for models and 1 for fault spaces. {comparison.systems} systems a mark, {samples} samples each, "
            "strong coloured faults, the order told.",
        )
    ):
        style = {"fontsize": 13, "weight": "bold"} if line == 0 else {"fontsize": 9.5}
        figure.text(0.012, 1 - (0.14 + 0.07 * (line > 0) + 0.22 * line) / height, words, color=INK, va="top", **style)
    _legend(figure)
    return figure


def _rows(tools: list[str]) -> list[tuple[str, bool]]:
    """Return the names of the tools, each group of instruments below a heading; True says that it is one."""
    rows: list[tuple[str, bool]] = []
    for tool in TOOLS:
        if tool.name in tools:
            heading = "" if tool.name == OURS else HEADINGS.get(tool.basis, WITHOUT)
            if heading and (heading, True) not in rows:
                rows.append((heading, True))
            rows.append((tool.name, False))
    return rows


def _panel(axes: Any, title: str, rows: list[tuple[str, bool]]) -> None:
    axes.set_xscale("log")
    axes.set(xlim=AXIS, ylim=(len(rows) - 0.4, -0.6), yticks=[])
    axes.set_title(title, fontsize=9.5, color=INK, pad=5)
    axes.set_xticks(TICKS, [f"{tick:g}" for tick in TICKS], fontsize=9, color=INK)
    axes.tick_params(axis="x", which="minor", bottom=False)
    axes.tick_params(axis="x", length=3, color=FAINT)
    for tick in TICKS:
        axes.axvline(tick, color="#e4e4e4", linewidth=0.8, zorder=0)
    axes.axvline(1.0, color=INK, linewidth=1.3, zorder=1)
    axes.axhspan(-0.6, 0.5, color="#eaf3fa", zorder=-1, linewidth=0)
    for side in ("top", "left", "right"):
        axes.spines[side].set_visible(False)
    axes.spines["bottom"].set_color(FAINT)


def _silent(axes: Any, rows: list[tuple[str, bool]], cells: list[CellResults]) -> None:
    """Say in the middle of the rows that have no fault space that they have none."""
    without = [row for row, (name, heading) in enumerate(rows) if not heading and cells[0].best(name) is None]
    if without:
        words = "these tools give\nno fault space"
        axes.text(6.5, (without[0] + without[-1]) / 2, words, fontsize=9, style="italic", color="#555555", ha="center", va="center")


def _names(axes: Any, rows: list[tuple[str, bool]]) -> None:
    """Write the names of the rows left of the axes."""
    across = axes.get_yaxis_transform()
    for row, (name, heading) in enumerate(rows):
        if heading:
            axes.text(-0.04, row + 0.12, name, transform=across, fontsize=8.5, style="italic", color="#555555", ha="right", va="center")
        else:
            weight = "bold" if name == OURS else "normal"
            axes.text(-0.04, row, _label(name), transform=across, fontsize=9.5, weight=weight, ha="right", va="center", color=_colour(name))


def _marks(axes: Any, rows: list[tuple[str, bool]], cell: CellResults) -> None:
    coloured = cell.cell.endswith("coloured")
    for row, (name, heading) in enumerate(rows):
        result = None if heading else cell.best(name)
        if result is not None:
            _mark(axes, row + (0.19 if coloured else -0.19), result, coloured)


def _mark(axes: Any, height: float, result: Result, coloured: bool) -> None:
    colour = _colour(result.tool)
    low, quarter, three, high = (min(quantile(result.errors, share), 2 * AXIS[1]) for share in (0.1, 0.25, 0.75, 0.9))
    if result.failed:
        words = f"fails on all {result.failed}" if result.failed == len(result.errors) else f"{result.failed} fail"
        axes.text(AXIS[1] * 0.95, height, words, fontsize=7, ha="right", va="center", color=INK, zorder=4)
    if result.median <= AXIS[1]:
        axes.plot([low, high], [height] * 2, color=colour, linewidth=0.9, zorder=2, solid_capstyle="butt")
        axes.plot([quarter, three], [height] * 2, color=colour, linewidth=2.8, zorder=2, solid_capstyle="butt")
        face = "white" if coloured else colour
        style = {"marker": "D" if coloured else "o", "markersize": 4.2 if coloured else 5, "markerfacecolor": face}
        axes.plot([result.median], [height], linestyle="none", markeredgecolor=colour, markeredgewidth=1.1, zorder=3, **style)
    elif result.failed < len(result.errors):
        axes.plot([AXIS[1] * 0.9], [height], linestyle="none", marker=">", color=colour, markersize=5, zorder=3)


def _label(name: str) -> str:
    """Return the name with the package spelt out."""
    if name in LABELS:
        return LABELS[name]
    package, _, method = name.partition(" ")
    return f"{PACKAGES.get(package, package)} {method}"


def _colour(name: str) -> str:
    return COLOURS.get(name, "#444444")


def _legend(figure: Any) -> None:
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], marker="o", markersize=5, linestyle="none", color=INK, label="white input: median"),
        Line2D([], [], marker="D", markersize=5, linestyle="none", color=INK, markerfacecolor="white", label="coloured input: median"),
        Line2D([], [], color=INK, linewidth=2.8, label="the middle half of the systems"),
        Line2D([], [], color=INK, linewidth=0.9, label="all but the best and worst tenth"),
    ]
    figure.legend(handles=handles, loc="lower center", ncol=4, frameon=False, fontsize=8.5, bbox_to_anchor=(0.5, 0.0), handletextpad=0.4)
