"""The house as a figure in letters, and as a table of its folders: `python -m tests.house.drawing` writes them into their pages.

figure      the rooms from the top down, in each its folders: whoever imports stands above what it imports
table       a row a folder, with the first sentence of its docstring
PAGES       page -> what is drawn there, from the graph of the files
filled      a page with these rows between its two marks
"""

import ast
from collections.abc import Callable, Sequence
from graphlib import TopologicalSorter

from .import_graph import ROOT, Graph, counted, file_graph, house, place_graph

BEGIN, END = "<!-- tests/house/drawing.py draws what stands here -->", "<!-- as far as here -->"
ROOMS = ("faultspace", "proofs", "numeric", "exact", "base")
SAID = {
    "faultspace": "the front door: the public names, one file a command",
    "proofs": "claims, verdicts, certificates, the checker, Rocq",
    "numeric": "the method in floats; numeric/audit is the one folder that imports exact/",
    "exact": "the truth in exact arithmetic",
    "base": "faultspace/base: errors, how results are shown, programs under limits; for every room",
}
WIDTH = 100


def room_of(place: str) -> str:
    """This is the room that a place lies in."""
    return place.partition("/")[0]


def ordered(places: Graph, room: str) -> list[str]:
    """The places of the room, each above those it imports, else by name."""
    inside = {name: {one for one in imported if room_of(one) == room} for name, imported in places.items() if room_of(name) == room}
    sorter = TopologicalSorter(inside)
    sorter.prepare()
    result: list[str] = []
    while ready := sorted(sorter.get_ready(), reverse=True):
        result.extend(ready)
        sorter.done(*ready)
    return [name for name in reversed(result) if name != room]


def figure(files: Graph) -> list[str]:
    """Return the drawing's lines. Arrows within a room lead to folders, arrows out of it to rooms."""
    places = place_graph(files)
    lines = ["```text"]
    for room in ROOMS:
        lines.append(f"+-- {room}: {SAID[room]} ".ljust(WIDTH, "-"))
        for name in ordered(places, room):
            near = sorted(one.partition("/")[2] for one in places[name] if room_of(one) == room and one != room)
            far = [other for other in ROOMS if other != room and any(room_of(one) == other for one in places[name])]
            targets = " ".join([*near, *far])
            lines.append(f"|   {name.partition('/')[2]:<22}{f'-> {targets}' if targets else ''}".rstrip())
        lines.append("+".ljust(WIDTH, "-"))
    return [*lines, "```"]


def table(files: Graph) -> list[str]:
    """Return the table's rows. A file at the top of a room is a place of its own."""
    places = place_graph(files)
    rows = ["| place | import name | what it holds |", "|---|---|---|"]
    for room in ROOMS:
        for name in [room, *sorted(ordered(places, room))]:
            path = f"faultspace/{name}" if room == "base" else name
            dotted = path.removesuffix(".py").replace("/", ".")
            imported = dotted if dotted.startswith("faultspace") else f"faultspace.{dotted}"
            source = (ROOT / path) if path.endswith(".py") else ROOT / path / "__init__.py"
            link = path if path.endswith(".py") else f"{path}/"
            rows.append(f"| [`{link}`](../{link}) | `{imported}` | {opening(source.read_text('utf-8'))} |")
    return rows


def opening(source: str) -> str:
    """Return the first paragraph of a module's docstring, on one line."""
    text = ast.get_docstring(ast.parse(source)) or ""
    return " ".join(text.partition("\n\n")[0].split()).replace("|", "\\|")


def filled(page: str, rows: Sequence[str], begin: str = BEGIN, end: str = END) -> str:
    """The page with the rows between its marks."""
    before, _, rest = page.partition(begin)
    _, mark, after = rest.partition(end)
    if not mark:
        raise ValueError(f"the page has no place for a drawing: {begin}")
    return f"{before}{begin}\n" + "\n".join(["", *rows, ""]) + f"\n{end}{after}"


PAGES: dict[str, Callable[[Graph], list[str]]] = {"docs/extending.md": figure, "docs/house.md": table}


def main() -> None:
    """This draws every page again."""
    graph = counted(file_graph(house()))
    for page, made in PAGES.items():
        path = ROOT / page
        path.write_text(filled(path.read_text("utf-8"), made(graph)), "utf-8")


if __name__ == "__main__":
    main()
