"""The graph of the claims, an arrow from each to those that it rests on: its border tells of the statement, its fill of the proof.

Node     a claim with the two classes that colour it
graph    the SVG; `layers` says in which column a claim stands: one more than the last that it uses
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup, escape

from .axes import picture

HEAD = (
    '<defs><marker id="head" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
    '<path class="head" d="M0 0L8 4L0 8z"/></marker></defs>'
)
BOX, TALL, ACROSS, DOWN, EDGE = 168, 40, 64, 16, 10


@dataclass(frozen=True)
class Node:
    """`statement` is "stands", "amended", "falls" or "open"; `proof` is a verdict in small letters; `words` say both."""

    name: str
    uses: tuple[str, ...]
    statement: str
    proof: str
    words: str


def layers(nodes: Sequence[Node]) -> dict[str, int]:
    """Return the column of each claim. A claim that is used and not among the nodes counts as none; a circle does not grow."""
    uses = {node.name: [one for one in node.uses if one in {each.name for each in nodes}] for node in nodes}
    found = dict.fromkeys(uses, 0)
    for _ in nodes:
        found = {name: max((found[one] + 1 for one in used), default=0) for name, used in uses.items()}
        found = {name: min(column, len(nodes) - 1) for name, column in found.items()}
    return found


def graph(nodes: Sequence[Node]) -> Markup:
    """Return the graph, the columns from left to right."""
    columns = layers(nodes)
    order: dict[int, list[Node]] = {}
    for node in nodes:
        order.setdefault(columns[node.name], []).append(node)
    place: dict[str, tuple[int, int]] = {}
    for column in sorted(order):
        # Beside what it rests on, as far as that is free.
        wanted = sorted(order[column], key=lambda node: _mean([place[one][1] for one in node.uses if one in place]))
        place |= {node.name: (EDGE + column * (BOX + ACROSS), EDGE + row * (TALL + DOWN)) for row, node in enumerate(wanted)}
    width = 2 * EDGE + len(order) * (BOX + ACROSS) - ACROSS
    height = 2 * EDGE + max(map(len, order.values()), default=1) * (TALL + DOWN) - DOWN
    arrows = [_arrow(place[node.name], place[one]) for node in nodes for one in node.uses if one in place]
    boxes = [_box(node, *place[node.name]) for node in nodes]
    return picture(
        width,
        height,
        "Graph of the claims",
        "The list below the picture says the same in words.",
        HEAD + "".join([*arrows, *boxes]),
        "group",
    )


def _mean(values: Sequence[int]) -> float:
    return sum(values) / len(values) if values else 1e9


def _arrow(start: tuple[int, int], end: tuple[int, int]) -> str:
    x0, y0, x1, y1 = start[0], start[1] + TALL / 2, end[0] + BOX + 2, end[1] + TALL / 2
    bend = max(24.0, (x0 - x1) / 2)
    return (
        f'<path class="arrow" marker-end="url(#head)" d="M{x0} {y0:.0f}C{x0 - bend:.0f} {y0:.0f} {x1 + bend:.0f} {y1:.0f} {x1} {y1:.0f}"/>'
    )


def _box(node: Node, x: int, y: int) -> str:
    name = escape(node.name)
    return (
        f'<a href="#claim-{name}"><g class="node {node.statement} {node.proof}"><title>{escape(node.words)}</title>'
        f'<rect x="{x}" y="{y}" width="{BOX}" height="{TALL}" rx="7"/>'
        f'<text x="{x + BOX / 2:.0f}" y="{y + 17}" text-anchor="middle">{name}</text>'
        f'<text class="small" x="{x + BOX / 2:.0f}" y="{y + 32}" text-anchor="middle">{escape(_short(node))}</text></g></a>'
    )


def _short(node: Node) -> str:
    return f"{node.statement}, {node.proof}"
