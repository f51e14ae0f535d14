"""These tests run `faultspace monte-carlo` on a handful of systems: files, JSON alone on standard output, bad arguments."""

from __future__ import annotations

import csv
import json
import sys
from importlib import resources
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from faultspace.cli import studying
from faultspace.numeric.plant.report import folders
from tests.end_to_end.commands import call

NAMES = ["published", "identified", "corrected", "corrected-identified"]


def validator() -> Any:
    """Return the validator of the schema that comes with the package, itself checked."""
    schema = json.loads((resources.files("faultspace.numeric") / "schemas" / "monte_carlo.schema.json").read_text("utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


@pytest.fixture
def without_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Drawing takes most of the time; one test looks at the figures."""
    monkeypatch.setattr(studying, "_draw", lambda studies, folder: None)


def test_a_tiny_study_leaves_tables_cases_and_figures_and_prints_a_document_alone(tmp_path: Path) -> None:
    """With --json; the schema accepts the document, and refuses other values and unknown keys."""
    out = tmp_path / "study"
    run = call("monte-carlo", "--systems", "4", "--samples", "200", "--jobs", "1", "--seed", "3", "--out", str(out), "--json")
    assert run.code == 0, run.err
    summary = (out / "summary.md").read_text("utf-8")
    assert "as published" in summary and "as corrected" in summary and "1 of 4 cases are vacuous" in summary
    names = {path.name for path in out.iterdir()}
    assert {"cases.csv", "studies.json", "summary.md"} <= names
    assert "95 % interval" in summary
    assert not [name for name in names if name.startswith(".unfinished")]
    rows = list(csv.DictReader((out / "cases.csv").open(encoding="utf-8")))
    vacuous = ["True", "False", "False", "False"]
    assert [row["vacuous"] for row in rows] == vacuous * 2 + ["False"] * (2 + 3) * 4
    document = json.loads((out / "studies.json").read_text("utf-8"))
    assert [study["name"] for study in document["studies"]] == NAMES
    left = iter(rows)
    for study in document["studies"]:
        for case in study["cases"]:
            for estimator, estimate in case["estimates"].items():
                row = next(left)
                assert (row["study"], row["index"], row["estimator"]) == (study["name"], str(case["index"]), estimator)
                assert float(row["two_sided"]) == estimate["errors"]["two_sided"]
    assert next(left, None) is None
    refuses_what_is_changed(run.json, document)
    pytest.importorskip("matplotlib")
    for name in NAMES:
        assert (out / f"figure-{name}.png").exists()  # that these are pictures is seen in `test_study.py`


def refuses_what_is_changed(document: Any, written: Any) -> None:
    """See that the document is the one in the folder, and that the schema accepts it as it is and in no other way."""
    assert [study["samples"] for study in document["studies"]] == [200] * 4
    validator().validate(document)
    assert document == written
    assert document["format"] == "faultspace-monte-carlo/2"
    for *path, last in (("format",), ("studies", 0, "cases", 0, "n_z"), ("studies", 2, "by_zeros", 1, "estimator")):
        place = document
        for key in path:
            place = place[key]
        kept, place[last] = place[last], "something else"
        assert not validator().is_valid(document)
        place[last], place["unknown"] = kept, 1
        assert not validator().is_valid(document)
        del place["unknown"]
        validator().validate(document)


@pytest.mark.usefixtures("without_figures")
def test_few_samples_are_a_refusal_in_the_table_and_no_traceback(tmp_path: Path) -> None:
    run = call("monte-carlo", "--systems", "4", "--samples", "30", "--jobs", "1", "--out", str(tmp_path))
    assert run.code == 0
    assert "as published" in run.out and "estimates were refused, the first because: 30 samples are too few" in run.out


@pytest.mark.usefixtures("without_figures")
def test_what_somebody_else_put_there_is_refused_and_stays(tmp_path: Path) -> None:
    """A second run replaces what the first wrote, and a file that was edited since stops the third."""
    out = tmp_path / "study"
    arguments = ("monte-carlo", "--systems", "2", "--samples", "30", "--jobs", "1", "--out", str(out))
    assert [call(*arguments).code for _ in range(2)] == [0, 0]
    (out / "cases.csv").write_text("mine", encoding="utf-8")
    before = {path.name: path.read_bytes() for path in out.iterdir()}
    run = call(*arguments)
    assert run.code == 2 and run.out == "" and len(run.err.strip().splitlines()) == 1
    assert "has cases.csv, which no earlier run wrote, or which was changed since; it is left as it is" in run.err
    assert before == {path.name: path.read_bytes() for path in out.iterdir()}


@pytest.mark.parametrize("name", ["cases.csv", "figure-identified.png"])
def test_a_file_of_our_names_is_refused_before_anything_is_computed(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(studying, "monte_carlo", None)
    (tmp_path / name).write_text("mine", encoding="utf-8")
    run = call("monte-carlo", "--out", str(tmp_path))
    assert run.code == 2 and f"has {name}, which no earlier run wrote" in run.err and len(run.err.strip().splitlines()) == 1
    assert [path.name for path in tmp_path.iterdir()] == [name] and (tmp_path / name).read_text("utf-8") == "mine"


def test_without_distributed_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    run = call("monte-carlo", "--systems", "2", "--dask", "tcp://127.0.0.1:8786", "--out", str(tmp_path / "out"))
    assert run.code == 2
    assert "faultspace[cluster]" in run.err and len(run.err.strip().splitlines()) == 1


def test_bad_arguments_are_one_line_and_leave_nothing(tmp_path: Path) -> None:
    occupied = tmp_path / "file"
    occupied.write_text("")
    wrong = ["--systems", "0", "--out", str(tmp_path / "a")], ["--seed", "-1", "--out", str(tmp_path / "b")], ["--out", str(occupied)]
    for arguments in wrong:
        run = call("monte-carlo", *arguments)
        assert run.code == 2
        assert run.out == "" and len(run.err.strip().splitlines()) == 1
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_a_folder_of_two_commands_knows_the_files_of_both(tmp_path: Path) -> None:
    made, out = tmp_path / "made", tmp_path / "out"
    made.mkdir()
    out.mkdir()
    for name in ("model.json", "cases.csv"):
        (made / name).write_text(name, encoding="utf-8")
        assert folders.replace(made, out, [name]) == [name]
    folders.refuse(out, ["model.json", "cases.csv"])
