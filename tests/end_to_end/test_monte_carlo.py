"""`faultspace monte-carlo` on a handful of systems: files, JSON alone on standard output, bad arguments."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from tests.end_to_end.commands import call, command


def test_a_tiny_study_leaves_tables_cases_and_figures(tmp_path: Path) -> None:
    out = tmp_path / "study"
    run = command("monte-carlo", "--systems", "4", "--jobs", "2", "--seed", "3", "--out", str(out))
    assert run.code == 0, run.err
    assert "as published" in run.out and "as corrected" in run.out
    assert "1 of 4 cases are vacuous" in run.out
    names = {path.name for path in out.iterdir()}
    assert {"cases.csv", "studies.json", "summary.md"} <= names
    assert not [name for name in names if name.startswith(".")]
    rows = list(csv.DictReader((out / "cases.csv").open(encoding="utf-8")))
    assert [row["study"] for row in rows] == ["published"] * 4 + ["corrected"] * 4 + ["identified"] * 4
    assert [row["vacuous"] for row in rows] == ["True", "False", "False", "False"] + ["False"] * 4 + ["True", "False", "False", "False"]
    document = json.loads((out / "studies.json").read_text("utf-8"))
    for study in document["studies"]:
        for case, row in zip(study["cases"], [row for row in rows if row["study"] == study["name"]], strict=True):
            assert float(row["two_sided"]) == case["errors"]["two_sided"]
    pytest.importorskip("matplotlib")
    for name in ("published", "corrected", "identified"):
        assert (out / f"figure-{name}.png").read_bytes().startswith(b"\x89PNG")


def test_with_json_standard_output_holds_the_document_alone(tmp_path: Path) -> None:
    run = call("monte-carlo", "--systems", "2", "--jobs", "1", "--out", str(tmp_path), "--json")
    assert run.code == 0
    assert run.json == json.loads((tmp_path / "studies.json").read_text("utf-8"))
    assert run.json["format"] == "faultspace-monte-carlo/1"


def test_bad_arguments_are_one_line_and_leave_nothing(tmp_path: Path) -> None:
    occupied = tmp_path / "file"
    occupied.write_text("")
    wrong = ["--systems", "0", "--out", str(tmp_path / "a")], ["--seed", "-1", "--out", str(tmp_path / "b")], ["--out", str(occupied)]
    for arguments in wrong:
        run = call("monte-carlo", *arguments)
        assert run.code == 2
        assert run.out == "" and len(run.err.strip().splitlines()) == 1
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
