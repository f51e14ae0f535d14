"""What makes the headline certificates anew removes the old ones, takes certificates alone, and removes nothing where none was made."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from faultspace.proofs.trust.structure_certificates import sha256

from .certificates import HEADLINES, PATTERN, replaced
from .import_graph import ROOT


def test_new_certificates_take_the_place_of_the_old(tmp_path: Path) -> None:
    made, kept = tmp_path / "made", tmp_path / "kept"
    for folder, names in (made, ("a-1.json", "b-2.json", "verdicts.json")), (kept, ("a-1.json", "c-3.json")):
        folder.mkdir()
        for name in names:
            (folder / name).write_text(f"{folder.name} {name}", "utf-8")
    assert replaced(made, kept) == ({"b-2.json"}, {"c-3.json"})
    assert {path.name: path.read_text("utf-8") for path in kept.iterdir()} == {"a-1.json": "made a-1.json", "b-2.json": "made b-2.json"}


def test_where_nothing_was_made_nothing_is_removed(tmp_path: Path) -> None:
    made, kept = tmp_path / "made", tmp_path / "kept"
    made.mkdir()
    kept.mkdir()
    (made / "verdicts.json").write_text("{}", "utf-8")
    (kept / "c-3.json").write_text("{}", "utf-8")
    with pytest.raises(ValueError, match="no certificate"):
        replaced(made, kept)
    assert [path.name for path in kept.iterdir()] == ["c-3.json"]


def test_certificates_alone_lie_among_the_certificates() -> None:
    assert {path.name for path in HEADLINES.iterdir()} == {path.name for path in HEADLINES.glob(PATTERN)} != set()


def test_the_certificates_that_the_history_names_are_there() -> None:
    words = " ".join((ROOT / "docs" / "history.md").read_text("utf-8").split())
    named = set(re.findall(r"\b[0-9a-f]{64}\b", words))
    assert named
    assert named <= {
        sha256(json.loads(path.read_text("utf-8"))) for path in (ROOT / "proofs").rglob("*.json") if path.parent.name == "certificates"
    }
