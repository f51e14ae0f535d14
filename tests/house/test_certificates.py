"""What makes the headline certificates anew locks their names, keeps in the tree those that it has, and removes nothing where none was
made."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from faultspace.proofs.trust.structure_certificates import sha256

from .certificates import HEADLINES, NAMES, PATTERN, replaced

REFUTE_THEOREM_1 = {"window-equality-1bdd683440f3", "behaviour-difference-9c1c392258e1"}


def test_new_certificates_take_the_place_of_the_old(tmp_path: Path) -> None:
    made, kept = tmp_path / "made", tmp_path / "kept"
    for folder, names in (made, ("a-1.json", "b-2.json", "verdicts.json")), (kept, ("a-1.json", "c-3.json")):
        folder.mkdir()
        for name in names:
            (folder / name).write_text(f"{folder.name} {name}", "utf-8")
    (kept / NAMES).write_text("a-1\nc-3\nd-4\n", "utf-8")
    assert replaced(made, kept) == ({"b-2"}, {"c-3", "d-4"})
    found = {path.name: path.read_text("utf-8") for path in kept.iterdir()}
    assert found == {"a-1.json": "made a-1.json", NAMES: "a-1\nb-2\n"}


def test_where_nothing_was_made_nothing_is_removed(tmp_path: Path) -> None:
    made, kept = tmp_path / "made", tmp_path / "kept"
    made.mkdir()
    kept.mkdir()
    (made / "verdicts.json").write_text("{}", "utf-8")
    (kept / "c-3.json").write_text("{}", "utf-8")
    with pytest.raises(ValueError, match="no certificate"):
        replaced(made, kept)
    assert [path.name for path in kept.iterdir()] == ["c-3.json"]


def test_the_certificates_of_the_tree_are_locked_and_few() -> None:
    """Each kind has one, those that refute theorem-1 are there, and a name ends with the digest of what stands in the file."""
    locked = (HEADLINES / NAMES).read_text("utf-8").split()
    assert locked == sorted(set(locked)) and len(locked) > 300
    here = {path.stem: json.loads(path.read_text("utf-8")) for path in HEADLINES.glob(PATTERN)}
    assert {path.name for path in HEADLINES.iterdir()} == {*(f"{name}.json" for name in here), NAMES}
    assert REFUTE_THEOREM_1 <= here.keys() <= set(locked) and len(here) < 50
    assert {name.rpartition("-")[0] for name in here} == {name.rpartition("-")[0] for name in locked}
    assert [name for name, one in here.items() if name != f"{one['kind']}-{sha256(one)[:12]}"] == []
