"""The public names: there, loaded when asked for, told in words with an example that runs, and not hidden by a module of their name.

PUBLIC      room -> its public names
records     the classes that the rooms export or that their functions return, but for values, by which records are made, and for errors
"""

from __future__ import annotations

import dataclasses
import doctest
import importlib
import inspect
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from types import UnionType
from typing import Any, get_args, get_type_hints

import pytest

from faultspace.base.sheets import Shown

ROOMS = ("faultspace", "faultspace.exact", "faultspace.numeric", "faultspace.proofs")
PUBLIC = {room: tuple(name for name in importlib.import_module(room).__all__ if f"{room}.{name}" not in ROOMS) for room in ROOMS}
CALLED = [(room, name) for room in ROOMS for name in PUBLIC[room] if name not in ("errors", "Malformed", "Rejected", "Unprovable")]
# They hold, read, check and judge what the others make; nobody's theorem stands behind them.
WITHOUT_SOURCE = {
    "faultspace": {"System", "read_record", "certify", "check"},
    "faultspace.exact": {
        *("Rationals", "PrimeField", "NumberField", "field_from_json", "from_float_exactly"),
        *("Matrix", "rank", "left_null_space", "right_null_space"),
        *("System", "ResidualSystem", "FaultySystem", "read_system", "Experiment", "read_experiment", "Filter", "read_filter"),
    },
    "faultspace.numeric": {"Record", "read_record", "read_stretches", "record_from", "StateSpaceModel"},
    "faultspace.proofs": {"certify", "check", "Checked", "CheckedFile", "check_file", "Verdict"},
}
# What goes into a question: numbers, fields, matrices and functions, not answers about something.
VALUES = {"Rationals", "PrimeField", "NumberField", "Matrix", "RowEchelon", "Filter", "Spectra", "FaultSpectra"}
# A command's answer with a page of Markdown for a summary; every other record says it by its sheet.
WITHOUT_SHEET = {"Identification"}
PICTURED = {
    *(
        "FaultDimension",
        "FaultDirection",
        "FaultSpaceEstimate",
        "FaultsAgainstHealthy",
        "Identification",
        "Isolation",
        "MoespModel",
        "OrderEvidence",
    ),
    *("Reconstruction", "ReducedModel", "Report", "ResidualSignal", "StateSpaceModel", "Study", "Uncertainty"),
}
HEAVY = ("numpy", "scipy", "sympy", "flint", "mpmath", "pandas", "matplotlib")


def loaded_after(statement: str) -> set[str]:
    """Return the heavy packages that a fresh interpreter has loaded after the statement."""
    source = f"import sys; {statement}; print(*(name for name in {HEAVY!r} if name in sys.modules))"
    return set(subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=True).stdout.split())


def classes() -> Iterator[type[Any]]:
    """Yield the classes that are exported, and those that exported functions return."""
    for room, name in CALLED:
        found = getattr(importlib.import_module(room), name)
        if inspect.isclass(found):
            yield found
        else:
            returned = get_type_hints(found)["return"]
            yield from (get_args(returned) if isinstance(returned, UnionType) else (returned,))


@cache
def records() -> dict[str, type[Any]]:
    """Return the classes of answers by name: those of ours that are exported or returned, but for VALUES."""
    return {
        found.__name__: found
        for found in classes()
        if found.__module__.startswith("faultspace.")
        and found.__name__ not in VALUES
        and (dataclasses.is_dataclass(found) or issubclass(found, Shown))
    }


def missing(record: type[Any]) -> list[str]:
    """Return what a person, a notebook or a program would miss of a record."""
    asked = ["summary", "to_json", "_repr_html_", *(["plot"] if record.__name__ in PICTURED else [])]
    lacks = [name for name in asked if not callable(getattr(record, name, None))]
    if record.__name__ not in WITHOUT_SHEET and not issubclass(record, Shown):
        lacks.append("the sheet that its summary is made of")
    if hasattr(record.__repr__, "__wrapped__"):  # as a repr is that dataclasses make
        lacks.append("a repr shorter than all its fields")
    return lacks


def test_records_are_read_by_people_notebooks_and_programs() -> None:
    assert {name: lacks for name, record in records().items() if (lacks := missing(record))} == {}


def test_the_records_are_found_and_what_one_lacks_is_noticed() -> None:
    assert len(records()) >= 40 and set(records()) >= PICTURED | {"Record", "FaultCount", "Structure", "Checked", "BadPair", "NoBadPair"}

    @dataclasses.dataclass(frozen=True)
    class Study:
        cases: tuple[int, ...]

    assert missing(Study) == [
        *("summary", "to_json", "_repr_html_", "plot"),
        *("the sheet that its summary is made of", "a repr shorter than all its fields"),
    ]


def unreadable(function: Callable[..., object]) -> list[str]:
    """Return what keeps a person from reading a signature: a default whose text is an address, and types longer than their argument's
    line, which is as wide as the house's lines less the four places before it."""
    shown = [str(argument) for argument in inspect.signature(function).parameters.values()]
    return [text for text in shown if " at 0x" in text or len(text) > 136]


def public(*rooms: str) -> Iterator[tuple[str, str, Any]]:
    """Yield (room, name, what it stands for) of all that can be called."""
    for room, name in CALLED:
        if room in rooms:
            yield room, name, getattr(importlib.import_module(room), name)


def test_signatures_can_be_read() -> None:
    assert {name: found for _, name, documented in public(*ROOMS) if (found := unreadable(documented))} == {}


def test_an_unreadable_signature_is_noticed() -> None:
    def deaf(on_progress: Callable[[str], None] = lambda name: None) -> None: ...

    assert len(unreadable(deaf)) == 1


def lacking(docstring: str, *, from_literature: bool) -> list[str]:
    """These are the things that a public docstring does not say."""
    first = docstring.strip().partition("\n")[0]
    asked = {
        "a first line of words": re.fullmatch(r"[A-Z].*[.:,]", first) and len(first.split()) >= 6,
        "shapes, types or units": re.search(r"\b[a-zN]\w* x [a-z(]\w*|\bdict\b|\blist\b|number of|\btype\b|samples|shape", docstring),
        "errors": re.search(r"\bRaises?\s", docstring),
        "an example": ">>> " in docstring,
        "a source": not from_literature or re.search(r"\[[A-Z][A-Za-z]*\d\d\]", docstring),
    }
    return [what for what, found in asked.items() if not found]


def test_import_loads_nothing_heavy() -> None:
    assert loaded_after("import faultspace, faultspace.exact, faultspace.proofs") == set()


def test_the_rooms_are_there_after_the_import_of_the_front_door() -> None:
    for room in ROOMS[1:]:
        assert loaded_after(f"import faultspace; assert {room!r} in repr({room})") == set()
    front = importlib.import_module("faultspace")
    assert {"exact", "numeric", "proofs", "errors", "__version__"} <= set(dir(front))
    assert set(dir(front.errors)) == {"InvalidInput", "InvalidData", "Malformed", "Rejected", "Unprovable"}


def test_import_is_fast() -> None:
    source = "import time; start = time.process_time(); import faultspace; print(time.process_time() - start)"
    runs = [float(subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=True).stdout) for _ in range(3)]
    assert min(runs) < 0.2


def test_the_method_in_floats_needs_nothing_exact() -> None:
    assert loaded_after("import faultspace; faultspace.identify; faultspace.read_record") & {"flint", "sympy"} == set()
    assert "flint" in loaded_after("import faultspace; faultspace.analyze")


def test_every_name_is_there_and_listed() -> None:
    for room in ROOMS:
        module = importlib.import_module(room)
        assert set(PUBLIC[room]) <= set(dir(module))
        assert [name for name in PUBLIC[room] if getattr(module, name) is None] == []
        with pytest.raises(AttributeError):
            _ = module.no_such_name


def shadowed(folder: Path, names: tuple[str, ...]) -> set[str]:
    """The names that a module or folder anywhere below the room's folder carries too."""
    files = {path.stem for path in folder.rglob("*.py")}
    return set(names) & (files | {path.name for path in folder.rglob("*") if path.is_dir()})


def test_no_module_carries_the_name_of_what_its_room_exports(root: Path) -> None:
    assert {name for room in ROOMS[1:] for name in shadowed(root / room.rpartition(".")[2], PUBLIC[room])} == set()


def test_no_module_of_the_front_door_carries_a_public_name(root: Path) -> None:
    inside = {path.stem for path in (root / "faultspace").iterdir()}
    assert inside & (set(PUBLIC["faultspace"]) - {"errors"}) == set()


def test_a_shadow_is_noticed(tmp_path: Path) -> None:
    (tmp_path / "deep").mkdir()
    (tmp_path / "deep" / "compare.py").write_text("")
    assert shadowed(tmp_path, ("compare", "limit", "deep")) == {"compare", "deep"}


def test_public_docstrings_say_what_is_needed() -> None:
    poor = {}
    for room, name, documented in public(*ROOMS):
        if lacks := lacking(inspect.getdoc(documented) or "", from_literature=name not in WITHOUT_SOURCE[room]):
            poor[f"{room}.{name}"] = lacks
    assert poor == {}


def undocumented(function: Callable[..., object]) -> list[str]:
    """Return the sections of numpydoc that a docstring lacks, and the arguments that its Parameters do not name."""
    text = inspect.getdoc(function) or ""
    parameters = text.partition("\nParameters\n----------\n")[2].partition("\n\n")[0]
    named = {name.strip() for line in parameters.splitlines() if not line.startswith(" ") for name in line.partition(" : ")[0].split(",")}
    wanted = [name for name in inspect.signature(function).parameters if name not in named]
    return [name for name in ("Returns", "Raises", "Examples") if f"\n{name}\n{'-' * len(name)}\n" not in text] + wanted


def test_public_functions_have_sections_that_editors_show() -> None:
    rooms = "faultspace.exact", "faultspace.numeric"
    functions = {f"{room}.{name}": found for room, name, found in public(*rooms) if inspect.isfunction(found)}
    assert len(functions) > 40
    assert {name: lacks for name, found in functions.items() if (lacks := undocumented(found))} == {}

    def bare(first: int, *, second: int) -> None: ...

    assert undocumented(bare) == ["Returns", "Raises", "Examples", "first", "second"]


def test_a_poor_docstring_is_noticed() -> None:
    assert lacking("of s", from_literature=True) == [
        "a first line of words",
        "shapes, types or units",
        "errors",
        "an example",
        "a source",
    ]


@pytest.mark.parametrize("room", ROOMS)
def test_the_examples_run(room: str) -> None:
    """Each public name has examples, and what they print is what stands there."""
    wrong = set()
    for _, name, documented in public(room):
        outcomes = [
            doctest.DocTestRunner(verbose=False).run(one) for one in doctest.DocTestFinder(recurse=False).find(documented, name, globs={})
        ]
        if not all(outcome.attempted and outcome.failed == 0 for outcome in outcomes):
            wrong.add(name)
    assert wrong == set()


def test_every_public_name_of_a_room_has_a_docstring() -> None:
    named = ((name, getattr(importlib.import_module(room), name)) for room in ROOMS[1:] for name in PUBLIC[room])
    assert [name for name, found in named if callable(found) and not (inspect.getdoc(found) or "").strip()] == []
