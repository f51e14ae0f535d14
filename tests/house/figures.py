"""The house in figures: `python -m tests.house.figures` measures it and writes the tables into docs/house.md.

sizes        files and lines of each room, and its largest folder
twins        classes of one name in two files, and functions whose statements are equal
needs        what the first use of a public name loads: modules of ours, packages of others, CPU seconds
tables       all of it as Markdown
"""

from __future__ import annotations

import argparse
import ast
import json
import subprocess
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from datetime import date
from pathlib import Path

import faultspace

from .depth import ERRANDS, travelled
from .drawing import END, ROOMS, filled, room_of
from .import_graph import ROOT, Module, circle, counted, file_graph, house, place, place_graph

PAGE = "docs/house.md"
BEGIN = "<!-- python -m tests.house.figures writes what stands here -->"
STATEMENTS = 3  # shorter bodies are equal by chance
PACKAGES = ("numpy", "scipy", "sympy", "flint", "mpmath", "pandas", "matplotlib", "joblib")


@dataclass(frozen=True)
class Size:
    """Of a room: Python files, their lines, its places, and the place with the most files."""

    room: str
    files: int
    lines: int
    places: int
    fullest: str
    most: int


@dataclass(frozen=True)
class Need:
    """Of a public name: the module it lives in, how many modules of ours and which packages it loads, the CPU seconds of that."""

    name: str
    home: str
    modules: int
    packages: tuple[str, ...]
    seconds: float


def sizes(modules: Iterable[Module]) -> Iterator[Size]:
    """Yield one row for each room, in the order of the drawing."""
    by_place: dict[str, list[Module]] = defaultdict(list)
    for module in modules:
        by_place[place(module.name)].append(module)
    for room in ROOMS:
        places = {name: found for name, found in by_place.items() if room_of(name) == room}
        inside = [module for found in places.values() for module in found]
        fullest = max(places, key=lambda name: len(places[name]))
        lines = sum(len(module.source.splitlines()) for module in inside)
        yield Size(room, len(inside), lines, len(places), fullest, len(places[fullest]))


def twins(modules: Iterable[Module]) -> tuple[list[str], list[tuple[str, ...]]]:
    """The class names that more than one module defines, and the groups of functions with equal statements, docstrings apart."""
    classes: Counter[str] = Counter()
    bodies: dict[str, list[str]] = defaultdict(list)
    for module in modules:
        tree = ast.parse(module.source)
        classes.update(node.name for node in tree.body if isinstance(node, ast.ClassDef) and not node.name.startswith("_"))
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef):
                statements = node.body[1:] if ast.get_docstring(node) is not None else node.body
                if sum(isinstance(inner, ast.stmt) for one in statements for inner in ast.walk(one)) >= STATEMENTS:
                    key = ast.dump(node.args) + "".join(map(ast.dump, statements))
                    bodies[key].append(f"{module.name.removeprefix('faultspace.')}.{node.name}")
    return sorted(name for name, times in classes.items() if times > 1), [tuple(names) for names in bodies.values() if len(names) > 1]


def needs(names: Iterable[str]) -> Iterator[Need]:
    """Each is asked for in a fresh interpreter."""
    for name in names:
        source = (
            "import json, sys, time; begun = time.process_time(); import faultspace; value = faultspace." + name + "; "
            "spent = time.process_time() - begun; ours = [one for one in sys.modules if one.partition('.')[0] == 'faultspace']; "
            f"others = [one for one in {PACKAGES!r} if one in sys.modules]; "
            "print(json.dumps([getattr(value, '__module__', None) or value.__name__, len(ours), others, spent]))"
        )
        run = subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=True, cwd=ROOT)
        home, modules, packages, seconds = json.loads(run.stdout)
        yield Need(name, home, modules, tuple(packages), seconds)


def tables(*, errands: bool = True) -> list[str]:
    """These are the rows of the page."""
    modules = list(house())
    graph = counted(file_graph(modules))
    rows = [f"Measured on {date.today().isoformat()}.", ""]
    rows += ["| room | files | lines | folders, or files at its top | fullest folder |", "|---|---|---|---|---|"]
    rows += [f"| {one.room} | {one.files} | {one.lines} | {one.places} | {one.fullest}: {one.most} files |" for one in sizes(modules)]
    around = [" -> ".join(found) or "none" for found in (circle(graph), circle(place_graph(graph)))]
    names, functions = twins(modules)
    equal = "; ".join(" = ".join(one) for one in functions)
    rows += ["", f"Circles of files: {around[0]}; of folders: {around[1]}. Functions with equal statements: {equal or 'none'}."]
    rows += [f"Public classes that share a name with one of another file: {', '.join(names) or 'none'}."]
    rows += ["", "| `faultspace.` | lives in | modules of ours that it loads | packages | CPU seconds |", "|---|---|---|---|---|"]
    for one in needs(name for name in dir(faultspace) if not name.startswith("_")):
        rows.append(f"| `{one.name}` | `{one.home}` | {one.modules} | {', '.join(one.packages) or 'none'} | {one.seconds:.2f} |")
    if errands:
        rows += ["", "| errand, from the question to the answer | functions of ours | greatest depth |", "|---|---|---|"]
        for errand in ERRANDS:
            with tempfile.TemporaryDirectory() as folder:
                found = travelled(errand.prepared(Path(folder)))
            rows.append(f"| `{errand.name}` | {found.functions} | {found.depth} |")
    return rows


def main(arguments: list[str] | None = None) -> int:
    """This writes the page."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--show", action="store_true", help="print the tables and leave the page alone")
    parser.add_argument("--without-errands", action="store_true", help="leave out the depth, which takes a minute")
    options = parser.parse_args(arguments)
    rows = tables(errands=not options.without_errands)
    if options.show:
        print("\n".join(rows))
    else:
        page = ROOT / PAGE
        page.write_text(filled(page.read_text("utf-8"), rows, BEGIN, END), "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
