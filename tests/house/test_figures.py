"""The figures of the house are counted right: on calls and modules made here, whose figures are known."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from . import depth, figures
from .drawing import END, filled
from .import_graph import ROOT, Module

SOURCE = """
def outer(times):
    inner([0] * times)
    inner([0])
    return [inner([1]) for _ in range(2)]

def inner(values):
    return sorted(values, key=lambda one: leaf(one))

def leaf(one):
    import late
    return -one
"""


@pytest.fixture
def made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, object]:
    """The functions of a house of one file; the file imports another when it is run."""
    (tmp_path / "late.py").write_text("def loaded():\n    return 1\n\nloaded()\n", "utf-8")
    (tmp_path / "house.py").write_text(SOURCE, "utf-8")
    monkeypatch.setattr(depth, "ROOT", tmp_path)
    monkeypatch.setattr(depth, "ROOMS", (f"{tmp_path}/",))
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.delitem(sys.modules, "late", raising=False)
    names: dict[str, object] = {}
    exec(compile(SOURCE, str(tmp_path / "house.py"), "exec"), names)
    return names


def test_functions_are_counted_once_and_chains_go_through_code_of_others(made: dict[str, object]) -> None:
    found = depth.travelled(lambda: made["outer"](3))  # type: ignore[operator]
    assert found == depth.Journey(3, ("house.py: outer", "house.py: inner", "house.py: leaf")), "nor lambdas, nor what an import runs"


def test_an_error_ends_the_watch(made: dict[str, object]) -> None:
    with pytest.raises(TypeError):
        depth.travelled(lambda: made["inner"](3))  # type: ignore[operator]
    assert sys.getprofile() is None


def test_code_of_others_is_not_ours() -> None:
    assert depth.travelled(lambda: sorted([3, 1])) == depth.Journey(0, ())


def test_sizes_and_twins() -> None:
    body = "\n    if x:\n        return x\n    return -x\n"
    one = Module("faultspace.exact.algebra.one", f'class Word:\n    pass\n\ndef f(x):\n    """Words."""{body}')
    two = Module("faultspace.proofs.trust.two", f"class Word:\n    pass\n\nclass _Own:\n    pass\n\ndef g(x):{body}")
    other = Module("faultspace.proofs.trust.other", f"class _Own:\n    pass\n\ndef h(x, y):{body}\n\ndef k(x):\n    return x\n")
    names, functions = figures.twins([one, two, other])
    assert names == ["Word"] and functions == [("exact.algebra.one.f", "proofs.trust.two.g")]
    modules = [one, two, other, *(Module(f"faultspace.{room}", "") for room in ("base", "numeric.count")), Module("faultspace", "x = 1\n")]
    by_room = {size.room: size for size in figures.sizes(modules)}
    assert (by_room["proofs"].files, by_room["proofs"].fullest, by_room["proofs"].most) == (2, "proofs/trust", 2)
    assert by_room["exact"].lines == len(one.source.splitlines()) and by_room["faultspace"].lines == 1


def test_what_a_name_needs() -> None:
    (errors,) = figures.needs(["errors"])
    assert errors.home == "faultspace.errors" and errors.packages == () and 2 <= errors.modules <= 5


def test_the_page_has_a_place_for_them() -> None:
    text = (ROOT / figures.PAGE).read_text("utf-8")
    assert figures.BEGIN in text and filled(text, ["| new |"], figures.BEGIN, END).count("| new |") == 1
