"""Who imports whom: the modules of the house, their imports, files and folders as graphs.

Module          a module's dotted name, whether it is a package, its source
house           every module of the house
imports         every name that a source imports, relative ones resolved, literal `import_module("...")` included
file_graph      module -> the modules it imports
place           the folder a module lies in, or its file where it lies at the top of its room
place_graph     place -> the places that its modules import
inside          the same within one folder: its folders, and the files at its top
counted         a graph of files without LEFT, arrows for type checkers alone that the order of the folders does not count
circle          modules or places that import each other in a circle; empty where there are none

Imports for type checkers alone and imports within functions count like all others.
"""

import ast
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

FOLDERS = ("exact", "numeric", "proofs")
Graph = dict[str, set[str]]
ROOT = Path(__file__).resolve().parents[2]
# (importing module, imported module); nothing may be added here
LEFT: set[tuple[str, str]] = set()


@dataclass(frozen=True)
class Module:
    """A module goes by its import name."""

    name: str
    source: str
    is_package: bool = False


@cache
def imports(module: Module) -> tuple[str, ...]:
    """Dotted names imported anywhere in the module; `from a import b` gives `a.b`, as b may be a module. A source is read once only."""
    return tuple(_imports(module))


def _imports(module: Module) -> Iterator[str]:
    package = module.name if module.is_package else module.name.rpartition(".")[0]
    for node in ast.walk(ast.parse(module.source)):
        match node:
            case ast.Import(names=names):
                yield from (alias.name for alias in names)
            case ast.ImportFrom(module=base, names=names, level=level):
                if level:
                    parts = package.split(".")
                    base = ".".join([*parts[: len(parts) - level + 1], *filter(None, [base])])
                yield from (f"{base}.{alias.name}" for alias in names)
            case ast.Call(
                func=ast.Name(id="__import__" | "import_module") | ast.Attribute(attr="import_module"),
                args=[ast.Constant(value=str(name)), *_],
            ):
                yield name if not name.startswith(".") else f"{package}{name}"


def house() -> Iterator[Module]:
    """Every module of the house, once: rglob does not enter the linked folders in faultspace/."""
    for folder in ("faultspace", *FOLDERS):
        for path in sorted((ROOT / folder).rglob("*.py")):
            parts = path.relative_to(ROOT).with_suffix("").parts
            if {"reproducers", "readers"} & set(parts):  # scripts for those who do not have the house
                continue
            dotted = parts if folder == "faultspace" else ("faultspace", *parts)
            is_package = dotted[-1] == "__init__"
            yield Module(".".join(dotted[:-1] if is_package else dotted), path.read_text("utf-8"), is_package)


def file_graph(modules: Iterable[Module]) -> Graph:
    """Return the modules that each module imports. A name within a module leads to that module; what is not ours leads nowhere."""
    known = {module.name: module for module in modules}

    def target(name: str) -> str | None:
        while name and name not in known:
            name = name.rpartition(".")[0]
        return name or None

    return {name: {found for one in imports(module) if (found := target(one))} - {name} for name, module in known.items()}


def place(name: str) -> str:
    """Return `exact/pairs` for a module in that folder, `proofs/deciding.py` for a file at the top of a room, `exact` for the room itself;
    in numeric/method and numeric/plant one folder more.
    """
    match name.split("."):
        case ["faultspace"]:
            return "faultspace"
        case ["faultspace", ("exact" | "numeric" | "proofs" | "base") as room]:
            return room
        case ["faultspace", "base", *_]:
            return "base"
        case ["faultspace", "numeric", ("method" | "plant") as hall, inner, *_]:
            return f"numeric/{hall}/{inner}" if (ROOT / "numeric" / hall / inner).is_dir() else f"numeric/{hall}/{inner}.py"
        case ["faultspace", ("exact" | "numeric" | "proofs") as room, inner]:
            return f"{room}/{inner}" if (ROOT / room / inner).is_dir() else f"{room}/{inner}.py"
        case ["faultspace", ("exact" | "numeric" | "proofs") as room, folder, *_]:
            return f"{room}/{folder}"
        case ["faultspace", inner]:
            return f"faultspace/{inner}" if (ROOT / "faultspace" / inner).is_dir() else f"faultspace/{inner}.py"
        case ["faultspace", folder, *_]:
            return f"faultspace/{folder}"
    raise ValueError(f"{name} is no module of the house")


def place_graph(files: Mapping[str, set[str]]) -> Graph:
    """The places that each place imports, itself apart."""
    found: Graph = {}
    for name, imported in files.items():
        here = place(name)
        found.setdefault(here, set()).update(place(one) for one in imported if place(one) != here)
    return found


def inside(folder: str, files: Mapping[str, set[str]]) -> Graph:
    """The folders of a package, and the files at its top, with those of them that each imports; the package's own name is left out."""

    def part(name: str) -> str:
        return name.removeprefix(f"{folder}.").partition(".")[0] if name.startswith(f"{folder}.") else ""

    found: Graph = {}
    for name, imported in files.items():
        if here := part(name):
            found.setdefault(here, set()).update({part(one) for one in imported} - {"", here})
    return found


def counted(graph: Graph) -> Graph:
    """The graph comes without what is left."""
    return {name: {one for one in imported if (name, one) not in LEFT} for name, imported in graph.items()}


def circle(graph: Mapping[str, set[str]]) -> list[str]:
    """Return one circle, its first member again at the end."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return [str(one) for one in error.args[1]]
    return []
