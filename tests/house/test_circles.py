"""No file imports itself by way of others, and the folders of a room import each other one way; the drawings of the house are current."""

import pytest

from . import drawing
from .import_graph import ROOT, Graph, Module, circle, counted, file_graph, house, inside, place, place_graph


def files(*more: Module) -> Graph:
    """The graph has every file of the house, and these."""
    return file_graph([*house(), *more])


def test_the_house_was_seen() -> None:
    graph = files()
    assert "faultspace.exact.system.systems" in graph["faultspace.exact.structure.record"]
    assert sum(map(len, graph.values())) > 500
    assert "exact/algebra" in place_graph(graph)["exact/system"]


def test_no_file_imports_itself_by_way_of_others() -> None:
    assert circle(files()) == []


def test_folders_import_each_other_one_way() -> None:
    assert circle(place_graph(counted(files()))) == []


@pytest.mark.parametrize(
    "sources",
    [
        {"exact.made_up": "from .system import other", "exact.system.other": "from ..made_up import something"},
        {"numeric.method.space.one": "from .two import f", "numeric.method.space.two": "def late():\n    from .one import g"},
        {"proofs.a": "from . import b", "proofs.b": "from .c import f", "proofs.c": "import faultspace.proofs.a"},
        {
            "numeric.data.one": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from .two import T",
            "numeric.data.two": "from .one import f",
        },
    ],
)
def test_a_circle_of_files_is_noticed(sources: dict[str, str]) -> None:
    found = circle(files(*(Module(f"faultspace.{name}", source) for name, source in sources.items())))
    assert set(found) == {f"faultspace.{name}" for name in sources}


@pytest.mark.parametrize(
    ("name", "source", "folders"),
    [
        ("exact.algebra.made_up", "from ..structure import relations", {"exact/algebra", "exact/structure"}),
        ("numeric.data.made_up", "from ..method.signal.pair_zeros import finite_zeros", {"numeric/data", "numeric/method/signal"}),
        ("proofs.trust.made_up", "def late():\n    from ..verdict.ledger import load", {"proofs/trust", "proofs/verdict"}),
    ],
)
def test_an_arrow_back_between_folders_is_noticed(name: str, source: str, folders: set[str]) -> None:
    """There is no circle of files, and yet a circle of folders."""
    graph = files(Module(f"faultspace.{name}", source))
    assert circle(graph) == []
    assert folders & set(circle(place_graph(counted(graph))))


def test_the_folders_of_the_audit_import_each_other_one_way() -> None:
    audit = "faultspace.numeric.audit"
    graph = inside(audit, counted(files()))
    assert graph["checks"] >= {"vectors", "records"} and graph["records"] == set()
    assert circle(graph) == []
    back = Module(f"{audit}.vectors.made_up", "from ..checks.faults import with_input")
    assert {"vectors", "checks"} <= set(circle(inside(audit, counted(files(back)))))


def test_a_place_is_a_folder_or_a_file_at_the_top_of_a_room() -> None:
    assert place("faultspace.numeric.audit.peers.harold") == "numeric/audit"
    assert place("faultspace.numeric.plant.pipeline") == "numeric/plant/pipeline.py"
    assert place("faultspace.numeric.method.rows.degree") == place("faultspace.numeric.method.rows") == "numeric/method/rows"
    assert place("faultspace.numeric.study.studies") == "numeric/study"
    assert place("faultspace.exact.algebra") == "exact/algebra"
    assert place("faultspace.exact") == "exact"
    with pytest.raises(ValueError, match=r"numpy\.linalg is no module of the house"):
        place("numpy.linalg")


def test_the_drawings_are_current() -> None:
    graph = counted(files())
    for page, drawn in drawing.PAGES.items():
        text = (ROOT / page).read_text("utf-8")
        assert drawing.filled(text, drawn(graph)) == text, f"draw {page} again: python -m tests.house.drawing"
        assert drawing.filled(text, ["something else"]) != text


def test_another_arrow_changes_the_drawing() -> None:
    new = Module("faultspace.exact.limits.made_up", "import flint\nfrom ..structure import record")
    assert drawing.figure(counted(files())) != drawing.figure(counted(files(new)))


def test_every_arrow_of_the_drawing_leads_down() -> None:
    seen: list[str] = []
    for line in reversed(drawing.figure(counted(files()))):
        name, arrow, targets = line.partition("->")
        if arrow:
            assert set(targets.split()) <= set(seen) | {"exact", "numeric", "proofs", "base", "numeric/audit"}, line
        seen.append(name.strip(" |"))
