"""`faultspace identify`: whole runs on data whose answer is known, and what it says where the data cannot tell.

answered        a run with pictures, and with order, number of faults and sample time given, and its folder, of which tests make a copy
as_printed      a run of the command that `faultspace examples` prints, its folder, and the answer
response        what a fault column does to the outputs, whatever the basis of the states
"""

from __future__ import annotations

import csv
import importlib.util
import json
import os
import shlex
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace import example_data as made
from faultspace.cli import identifying as command
from faultspace.cli.reading_files import _MODEL_KEYS, MODEL_FORMAT
from faultspace.numeric.data.files import read_record
from faultspace.numeric.data.records import recorded
from faultspace.numeric.method.model.models import FORMAT, StateSpaceModel
from faultspace.numeric.method.ranks.rank_gap import fault_dimension
from faultspace.numeric.method.signal.reconstruction import reconstruct_fault
from faultspace.numeric.method.space.by_ranks import fault_space
from faultspace.numeric.method.space.distances import containment_distance, subspace_distance
from faultspace.numeric.plant import pipeline as identifying
from faultspace.numeric.plant.answer import Identification
from faultspace.numeric.plant.report import folders
from faultspace.numeric.plant.report import result_files as report
from faultspace.numeric.plant.report.causes_told import RESIDUAL
from faultspace.numeric.plant.report.folders import MANIFEST
from faultspace.numeric.plant.report.result_pictures import PICTURES
from faultspace.numeric.plant.report.summary import advice
from faultspace.numeric.plant.steps import choice as identification_signal
from tests.end_to_end.commands import Run, call, validator
from tests.end_to_end.identify_runs import identified, refused, small_csv, valid

Array = NDArray[np.float64]

needs_matplotlib = pytest.mark.skipif(importlib.util.find_spec("matplotlib") is None, reason="matplotlib is not installed")


@pytest.fixture(scope="module")
def answered(tmp_path_factory: pytest.TempPathFactory, record: made.FaultyRecord) -> tuple[Run, Path]:
    # Fixtures of a module come before those of a test, so that these pictures are rendered, in few points.
    folder = tmp_path_factory.mktemp("answered")
    path = small_csv(folder, made.csv_text(record), made.FILE_NAME)
    with pytest.MonkeyPatch.context() as patch:
        if importlib.util.find_spec("matplotlib") is not None:
            from matplotlib.figure import Figure

            whole = Figure.savefig
            patch.setattr(Figure, "savefig", lambda figure, file, **options: whole(figure, file, **{**options, "dpi": 20}))
        run = identified(path, folder / "out", "--json", "--order", "3", "--faults", "1", "--dt", "0.25")
    assert run.code == 0, run.err
    return run, folder / "out"


@pytest.fixture(scope="module")
def as_printed(tmp_path_factory: pytest.TempPathFactory) -> tuple[Run, Path, Identification]:
    folder = tmp_path_factory.mktemp("examples") / "x"
    listed = call("examples", str(folder))
    assert listed.code == 0
    found: list[Identification] = []

    def kept(*records: Any, **options: Any) -> Identification:
        found.append(identifying.identify(*records, **options))
        return found[-1]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(command, "identify", kept)
        if importlib.util.find_spec("matplotlib") is not None:
            patch.setattr("matplotlib.figure.Figure.savefig", lambda figure, file, **options: file.write(b"not rendered"))
        run = call("identify", *shlex.split(listed.err.partition("find it with: faultspace identify ")[2].replace("\n", " ")))
    assert run.code == 0, run.err
    return run, folder, found[0]


def response(A: Any, F: Any, C: Any, G: Any, count: int = 8) -> Array:
    """Return G, CF, CAF, ... of each column, stacked (count p, m)."""
    columns = np.asarray(F, dtype=float).shape[1]
    return StateSpaceModel(A, F, C, G).markov(count).reshape(-1, columns)


# The known answer


def test_the_packaged_record_gives_the_fault_that_made_it(as_printed: tuple[Run, Path, Identification], record: made.FaultyRecord) -> None:
    _, folder, found_answer = as_printed
    out = folder / "result"
    answer = valid("identify", report.document(found_answer, made.FILE_NAME) | {"files": []})
    assert (answer["order"], answer["n_v"], answer["fault_space"]["n_z"]) == (3, 1, 1)
    assert (answer["orders"]["least"], answer["orders"]["most"]) == (3, 3) and not answer["exact"]
    assert answer["stable"] and answer["samples"] == made.SAMPLES
    assert (answer["n_v_from"], answer["n_v_possible"], answer["fault_space"]["method"]) == ("outputs and inputs", [1], "kernel rows")
    truth = sorted(np.linalg.eigvals(made.A), key=lambda z: (z.real, z.imag))
    poles = sorted((complex(*pair) for pair in answer["poles"]), key=lambda z: (z.real, z.imag))
    assert np.allclose(poles, truth, atol=0.01)
    assert len(answer["standard_errors"]["markov"]) == len(answer["standard_errors"]["markov_deviations"]) == 20
    for pole, error in zip(answer["poles"], answer["standard_errors"]["pole_deviations"], strict=True):
        nearest = min(truth, key=lambda z: abs(z - complex(*pole)))
        assert abs(pole[0] - nearest.real) <= 4 * error[0] and abs(pole[1] - nearest.imag) <= 4 * error[1]

    model = json.loads((out / report.MODEL).read_text("utf-8"))
    found = StateSpaceModel.from_json(model)
    true_model = StateSpaceModel(made.A, made.B, made.C, made.D)
    assert np.allclose(found.markov(8), true_model.markov(8), atol=0.06)
    space = answer["fault_space"]
    assert valid("fault-space", json.loads((out / report.SPACE).read_text("utf-8"))) == space
    assert space["equations"] + space["n_z"] == space["unknowns"] == found.n + 3
    true_response = response(made.A, made.F, made.C, made.G)
    assert subspace_distance(response(found.A, space["F"], found.C, space["G"]), true_response) < 0.06
    assert subspace_distance(response(found.A, model["F"], found.C, model["G"]), true_response) < 0.06

    with open(out / report.SIGNAL, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert [int(row["sample"]) for row in rows] == list(range(made.SAMPLES))
    first, last = answer["fault_signal"]["trusted"]
    assert [int(row["determined"]) for row in rows] == [int(first <= k < last) for k in range(made.SAMPLES)]
    v = np.array([float(row["v1"]) for row in rows])
    assert abs(np.corrcoef(v[first:last], record.v[first:last, 0])[0, 1]) > 0.98
    assert (folder / made.FILE_NAME).read_text("utf-8") == made.csv_text(record)


def test_the_first_screen_answers_what_people_ask(as_printed: tuple[Run, Path, Identification]) -> None:
    run, out = as_printed[0], as_printed[1] / "result"
    lines = run.out.splitlines()
    assert len(lines) <= 15 and run.err == ""
    said = {line.partition(":")[0]: line.partition(":")[2].strip() for line in lines[1:]}
    assert list(said) == ["Model", "Faults", "Since", "Where", "Size", "Sure", "Doubt", "Next", "Files"]
    assert said["Model"].startswith("order 3, the only one that the data leave open; stable")
    assert said["Faults"] == (
        "1. 2 equations between inputs and outputs hold up to noise, a third does not: 3 outputs - 2 equations = 1 fault"
    )
    assert said["Where"].startswith("neither: ") and "the fault signal is determined" in said["Sure"]
    assert f"beside {len(list(out.iterdir())) - 2} more files" in said["Files"]


def test_people_read_a_summary_and_find_the_files(
    as_printed: tuple[Run, Path, Identification], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(command, "identify", lambda *_, **__: as_printed[2])
    monkeypatch.setattr("faultspace.numeric.plant.report.result_pictures.pictures", lambda *_: [])
    run, out = identified(as_printed[1] / made.FILE_NAME, tmp_path / "out", "-v"), tmp_path / "out"
    assert "order **3**, chosen from the data: the only one left open" in run.out and "n_v: **1**" in run.out
    for part in (
        "poles, +- standard error: ",
        "static gains: ",
        "<- taken",
        "angle to the true space",
        "stable, largest modulus",
        "fit",
        "why: ",
        "5 independent ones for the 6",
        "meaning: ",
        "delay until",
        "leave noise alone (probability",
    ):
        assert part in run.out, part
    assert "determined: " in run.out and "## What to try next" in run.out and "given" not in run.out
    text = (out / report.SUMMARY).read_text("utf-8")
    assert "## Fault space" in text and "n_v: **1**" in text
    listed = run.out.strip().splitlines()[-1].partition(": ")[2].split(", ")
    assert sorted([*listed, MANIFEST]) == sorted(path.name for path in out.iterdir())


@needs_matplotlib
def test_the_plots_are_pictures(answered: tuple[Run, Path]) -> None:
    run, out = answered
    drawn = set(PICTURES) - {"shift-causes.png"}  # no mean has moved; the data are noisy, so that the levels are pictured too
    assert drawn == set(PICTURES) & set(run.json["files"])
    for name in drawn:
        assert (out / name).read_bytes().startswith(b"\x89PNG"), name
    assert (out / report.PAGE).read_text("utf-8").count('<img src="data:image/png;base64,') == len(drawn)


def test_without_matplotlib_it_says_so_and_goes_on(
    as_printed: tuple[Run, Path, Identification], csv_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def without(name: str) -> Any:
        raise ImportError(name)

    monkeypatch.setattr("faultspace.numeric.plant.report.result_pictures.import_module", without)
    monkeypatch.setattr(command, "identify", lambda *_, **__: as_printed[2])
    run, out = identified(csv_file, tmp_path / "out", "--json"), tmp_path / "out"
    assert "matplotlib is not installed" in run.err
    assert run.json["files"] == [report.MODEL, report.SPACE, report.SIGNAL, RESIDUAL, report.SUMMARY, report.PAGE]
    assert "<img" not in (out / report.PAGE).read_text("utf-8")
    assert "matplotlib" in (out / report.SUMMARY).read_text("utf-8")


def test_inspect_reads_the_model_where_floats_are_taken_exactly(answered: tuple[Run, Path]) -> None:
    model = answered[1] / report.MODEL
    validator("model", "faultspace.numeric").validate(json.loads(model.read_text("utf-8")))
    run = call("inspect", str(model), "--floats-exactly", "--json")
    assert run.code == 0, run.err
    assert "confirms nothing about the plant" in run.err
    # Exactly: G has full column rank, so there is neither a delay nor, generically, any zero.
    got = {key: run.json[key] for key in ("n", "m", "p", "normal_rank", "zeta", "fault_space_dimension", "delay_known_state")}
    assert got == {"n": 3, "m": 1, "p": 3, "normal_rank": 1, "zeta": 0, "fault_space_dimension": 1, "delay_known_state": 0}
    refused(call("inspect", str(model)), "floats", "--floats-exactly")


def test_who_reads_a_model_knows_the_format_and_the_keys_of_who_writes_it() -> None:
    assert MODEL_FORMAT == FORMAT
    assert set(_MODEL_KEYS) == set(validator("model", "faultspace.numeric").schema["properties"])


def test_the_sample_time_goes_into_the_model_that_is_inspected(answered: tuple[Run, Path], csv_file: Path, tmp_path: Path) -> None:
    run, out = answered
    model = tmp_path / report.MODEL
    content = json.loads((out / report.MODEL).read_text("utf-8"))
    assert content["dt"] == 0.25
    validator("model", "faultspace.numeric").validate(content)
    # Exact zeros of floats that were estimated say nothing, so that nobody is sent to look for them.
    assert not any("inspect" in line for line in run.json["next"])
    refused(identified(csv_file, tmp_path / "none", "--dt", "0"), "--dt", "got '0'")
    for wrong in (0, -0.5, True, None, "fast"):
        model.write_text(json.dumps(content | {"dt": wrong}), encoding="utf-8")
        refused(call("inspect", str(model), "--floats-exactly"), "dt")


def test_the_summary_has_one_measure_of_what_is_explained(answered: tuple[Run, Path]) -> None:
    text = (answered[1] / report.SUMMARY).read_text("utf-8")
    assert "explained of the residual: 99.68 %" in text and "unexplained" not in text
    for said in (
        "share of the sum of squares",
        "fit means 100 (1 - |y - simulated y| / |y - mean of y|)",
        "from the ranks of the residual, for comparison: 1",
        "dB: of the power of what it leaves",
    ):
        assert said in text, said


@pytest.mark.parametrize("change", [{"x": 1}, {"F": None}, {"A": None}, {"n": 2}])
def test_inspect_refuses_a_model_that_is_none(change: dict[str, Any], tmp_path: Path) -> None:
    model = StateSpaceModel(np.eye(1) / 2, np.ones((1, 1)), np.ones((1, 1)), np.zeros((1, 1))).to_json()
    model |= {"n_v": 1, "F": [[1.0]], "G": [[0.0]]}
    path = tmp_path / "model.json"
    path.write_text(json.dumps(model), encoding="utf-8")
    assert call("inspect", str(path), "--floats-exactly").code == 0
    path.write_text(json.dumps({key: value for key, value in (model | change).items() if value is not None}), encoding="utf-8")
    refused(call("inspect", str(path), "--floats-exactly"), str(path))


def test_a_model_without_faults_is_inspected(tmp_path: Path) -> None:
    path = tmp_path / "model.json"
    path.write_text(json.dumps(StateSpaceModel(made.A, made.B, made.C, made.D).to_json()), encoding="utf-8")
    run = call("inspect", str(path), "--floats-exactly", "--json")
    assert (run.code, run.json["m"], run.json["fault_space_dimension"]) == (0, 0, 0)


# What the data cannot tell


def test_noise_free_data_count_faults_without_the_error_of_the_model() -> None:
    draw = np.random.default_rng(3)
    u, v = draw.standard_normal((2000, 2)), draw.standard_normal((2000, 1))
    driven = StateSpaceModel(made.A, np.hstack([made.B, made.F]), made.C, np.hstack([made.D, made.G]))
    y = driven.simulate(np.hstack([u, v]))
    answer = identifying.identify(recorded(y, u, outputs=made.OUTPUTS, inputs=made.INPUTS), order=3)
    assert answer.residual is not None and answer.dimension is not None
    assert fault_dimension(answer.residual.store.read(0, 2000)).n_v != 1  # what the residual alone would say
    assert (answer.n_v, answer.dimension.regime) == (1, "rounding")
    assert answer.fault_space is not None and "given" not in answer.fault_space.reason and "as counted" in answer.fault_space.reason


def test_a_space_with_zeros_gives_a_pair_that_explains_the_residual() -> None:
    v = np.random.default_rng(2).standard_normal((1500, 1))
    r = StateSpaceModel(made.A, made.F, made.C, np.zeros((3, 1))).simulate(v)
    space = fault_space(r, made.A, made.C)
    assert (space.n_v, space.n_z) == (1, 2)  # without G there is a zero at infinity
    F, G = identification_signal.choose_pair(r, made.A, made.C, space, 1)
    assert F.shape == (3, 1) and containment_distance(np.vstack([F, G]), space.basis) < 1e-12
    signal = reconstruct_fault(r, made.A, F, made.C, G)
    assert signal.misfit < 1e-9 and signal.trusted[1] - signal.trusted[0] > 1400


def test_without_a_fault_there_is_none() -> None:
    u = np.random.default_rng(4).standard_normal((1000, 2))
    y = StateSpaceModel(made.A, made.B, made.C, made.D).simulate(u)
    answer = identifying.identify(recorded(y, u, outputs=made.OUTPUTS, inputs=made.INPUTS))
    assert answer.model is not None and answer.model.order == 3
    assert answer.n_v == 0 and answer.fault_space is None and answer.signal is None


def test_an_open_order_is_an_answer_and_old_files_go(answered: tuple[Run, Path], tmp_path: Path) -> None:
    out = shutil.copytree(answered[1], tmp_path / "out")
    assert (out / report.SIGNAL).exists()
    draw = np.random.default_rng(5)
    path = tmp_path / "noise.npz"
    np.savez(path, u=draw.standard_normal(600), y=draw.standard_normal((600, 2)))
    (out / "mine.txt").write_text("kept", encoding="utf-8")
    run = identified(path, out, "--json", channels=("--inputs", "u", "--outputs", "y"))
    assert run.code == 0, run.err
    answer = valid("identify", run.json)
    # What does not follow the inputs has no state, and noise alone shows no fault.
    assert answer["order"] == answer["orders"]["least"] == 0 and answer["n_v"] in (0, None) and answer["fault_space"] is None
    assert answer["orders"]["rows"][0]["order"] == 0 and any("no state" in note for note in answer["notes"])
    assert (out / report.MODEL).exists() and not (out / report.SIGNAL).exists()
    assert (out / "mine.txt").read_text("utf-8") == "kept"
    assert "chosen from the data" in (out / report.SUMMARY).read_text("utf-8")


@pytest.mark.parametrize("name", report.NAMES)
def test_a_file_of_somebody_else_is_refused_and_stays(name: str, csv_file: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / name).write_text("mine", encoding="utf-8")
    refused(identified(csv_file, out), name, "no earlier run wrote", "new folder")
    assert [path.name for path in out.iterdir()] == [name] and (out / name).read_text("utf-8") == "mine"


def test_a_file_edited_since_is_its_owners(answered: tuple[Run, Path], csv_file: Path, tmp_path: Path) -> None:
    out = shutil.copytree(answered[1], tmp_path / "out")
    before = {path.name: path.read_bytes() for path in out.iterdir() if path.name != report.SUMMARY}
    (out / report.SUMMARY).write_text("my remarks", encoding="utf-8")
    refused(identified(csv_file, out, "--order", "2"), report.SUMMARY, "no earlier run wrote")
    assert (out / report.SUMMARY).read_text("utf-8") == "my remarks"
    assert before == {path.name: path.read_bytes() for path in out.iterdir() if path.name != report.SUMMARY}


@pytest.mark.parametrize("content", ["{}", "no json", '{"format": "faultspace-files/1", "files": {"model.json": "x"}}'])
def test_a_manifest_of_somebody_else_is_refused_and_stays(content: str, csv_file: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / MANIFEST).write_text(content, encoding="utf-8")
    refused(identified(csv_file, out), MANIFEST, "not ours")
    assert [path.read_text("utf-8") for path in out.iterdir()] == [content]


def test_an_interrupted_run_leaves_files_that_the_next_one_knows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made, out = tmp_path / "made", tmp_path / "out"
    made.mkdir()
    out.mkdir()
    names = ("a", "b")
    for version in ("old", "new"):
        for name in names:
            (made / name).write_text(version + name, encoding="utf-8")
        if version == "old":
            assert folders.replace(made, out, names) == ["a", "b"]
    real = os.replace

    def stopping(source: Path, target: Path, **descriptors: int) -> None:
        if Path(target).name == "b":
            raise KeyboardInterrupt
        real(source, target, **descriptors)

    monkeypatch.setattr("os.replace", stopping)
    with pytest.raises(KeyboardInterrupt):
        folders.replace(made, out, names)
    assert [(out / name).read_text("utf-8") for name in names] == ["newa", "oldb"]
    monkeypatch.undo()
    (made / "a").write_text("third", encoding="utf-8")
    (made / "b").unlink()
    assert folders.replace(made, out, names) == ["a"] and not (out / "b").exists()


def test_faults_given_override_the_count_and_are_reported(csv_file: Path, tmp_path: Path) -> None:
    run = identified(csv_file, tmp_path / "out", "--json", "--faults", "3", "--order", "3")
    assert (run.code, run.json["n_v"], run.json["n_v_given"]) == (0, 3, True)
    valid("identify", run.json)
    assert run.json["n_v_reason"].startswith("3 given; the data say 1")
    assert not run.json["fault_space"]["meaningful"] and run.json["fault_space"]["basis"] is None
    assert run.json["fault_signal"] is None and report.SIGNAL not in run.json["files"]


def late_faults(folder: Path, loudness: float, number: int) -> Path:
    """Return 1500 samples without fault, then 1500 with so many, under noise of very unequal and coloured levels."""
    draw = np.random.default_rng(8)
    truth = StateSpaceModel(made.A, np.hstack([made.B, np.eye(3)[:, :number]]), made.C, np.zeros((3, 2 + number)))
    u, v = draw.standard_normal((3000, 2)), loudness * draw.standard_normal((3000, number))
    v[:1500] = 0.0
    noise = draw.standard_normal((3001, 3))
    y = truth.simulate(np.hstack([u, v])) + (noise[1:] + 0.7 * noise[:-1]) * [0.3, 0.1, 0.02]
    path = folder / "late.npz"
    np.savez(path, u=u, y=y)
    return path


@pytest.mark.parametrize("number", [pytest.param(1, marks=pytest.mark.slow), 2])
def test_faults_are_counted_against_healthy_samples(number: int, tmp_path: Path) -> None:
    path, channels = late_faults(tmp_path, 1.0, number), ("--inputs", "u", "--outputs", "y")
    alone = identified(path, tmp_path / "alone", "--json", "--order", "3", channels=channels).json
    # Of two faults in three outputs the last one cannot be told from noise, unless its level is known.
    assert (alone["n_v"], alone["healthy_until"], "against_healthy" in alone) == ({1: 1, 2: None}[number], None, False)
    assert number in alone["n_v_possible"] and (number == 1) == (len(alone["n_v_possible"]) == 1)
    assert number == 1 or any("--healthy-until" in line for line in alone["next"])
    assert number == 1 or any("--noise-level SIGMA" in line for line in alone["next"])
    run = identified(path, tmp_path / "out", "--json", "--order", "3", "--healthy-until", "1500", channels=channels)
    answer = valid("identify", run.json)
    assert (answer["n_v"], answer["n_v_from"], answer["n_v_given"]) == (number, "healthy samples", False)
    assert answer["against_healthy"]["n_v"] == number and answer["against_healthy"]["healthy"] == [0, 1500]
    assert answer["residual_dimension"] is None and answer["counted_on"] == [1500, 3000]
    assert answer["fault_space"]["meaningful"] and answer["fault_space"]["n_v"] == number
    summary = (tmp_path / "out" / report.SUMMARY).read_text("utf-8")
    assert f"against the healthy samples 0 to 1499: {number} (" in summary
    assert "from the residual alone: undecided (" in summary and "taken: healthy samples" in summary


def test_without_a_fault_nothing_stands_out_of_healthy_samples(tmp_path: Path) -> None:
    path, channels = late_faults(tmp_path, 0.0, 1), ("--inputs", "u", "--outputs", "y", "--order", "3", "--json")
    answer = identified(path, tmp_path / "out", "--healthy-until", "1500", channels=channels).json
    assert (answer["n_v"], answer["n_v_from"]) == (0, "healthy samples") and answer["against_healthy"]["visible"] > 1
    valid("identify", answer)


def test_healthy_samples_that_are_too_few_are_reported(tmp_path: Path, csv_file: Path) -> None:
    answer = identified(csv_file, tmp_path / "out", "--json", "--healthy-until", "200", "--order", "3").json
    assert (answer["n_v_from"], answer["healthy_until"]) in ((None, 200), ("residual alone", 200)) and answer["n_v"] != 0
    assert any("faults were not counted against samples 0 to 199: healthy has 200 samples" in note for note in answer["notes"])
    valid("identify", answer)
    # The model is from these samples alone: too few for one are refused.
    refused(identified(csv_file, tmp_path / "none", "--healthy-until", "12"), "--healthy-until", "got 12 samples, too few")
    beyond = str(made.SAMPLES)
    refused(identified(csv_file, tmp_path / "none", "--healthy-until", beyond), "--healthy-until", f"got {beyond} for {beyond} samples")
    assert not (tmp_path / "none").exists()


def test_means_far_from_zero_are_told(tmp_path: Path, record: made.FaultyRecord) -> None:
    """That they are removed where nothing else is stated is asked in `test_operating_point.py`."""
    path = tmp_path / "lifted.npz"
    np.savez(path, u=record.u + 20, y=record.y - 100)
    channels = ("--inputs", "u", "--outputs", "y")
    plain = identified(path, tmp_path / "a", "--json", "--order", "3", "--operating-point", "zero", channels=channels)
    assert plain.code == 0 and any("--operating-point means" in row["advice"] for row in plain.json["doubts"]["rows"])


def test_as_given_is_said_of_what_was_given_only(answered: tuple[Run, Path]) -> None:
    run, out = answered
    assert "n_v as given" in run.json["fault_space"]["reason"] and run.json["n_v_reason"].startswith("1 given; as the data say")
    assert (run.json["order_given"], run.json["n_v_given"]) == (True, True)
    summary = (out / report.SUMMARY).read_text("utf-8")
    assert "order **3**, as given" in summary


def test_an_order_that_leaves_the_model_open_is_not_taken() -> None:
    draw = np.random.default_rng(1)
    u, v = draw.standard_normal((1000, 2)), draw.standard_normal((1000, 1))
    driven = StateSpaceModel(made.A, np.hstack([made.B, made.F]), made.C, np.zeros((3, 3)))
    # Without noise the largest gap lies where the faults end, far beyond the order: the evidence of an ARX model chooses in its place.
    answer = identifying.identify(recorded(driven.simulate(np.hstack([u, v])), u, outputs=made.OUTPUTS, inputs=made.INPUTS))
    assert answer.exact and any("leaves A undetermined" in note for note in answer.notes)
    assert answer.orders is not None and answer.orders.least <= 3 <= answer.orders.most
    assert answer.model is not None and (answer.dimension is None or answer.dimension.regime == "rounding")


def test_an_unstable_model_is_answered_and_reported() -> None:
    draw = np.random.default_rng(6)
    A = np.diag([1.02, 0.5])
    u, v = draw.standard_normal((1200, 1)), draw.standard_normal((1200, 1))
    B, C = np.ones((2, 1)), np.array([[1.0, 1.0], [0.0, 1.0], [1.0, -1.0]])
    y = StateSpaceModel(A, np.hstack([B, [[0.3], [0.8]]]), C, np.zeros((3, 2))).simulate(np.hstack([u, v]))
    answer = identifying.identify(recorded(y, u, outputs=made.OUTPUTS, inputs=("u",)), order=2)
    assert answer.model is not None and not answer.model.model.is_stable and answer.residual is not None
    assert any("run backward" in note for note in answer.notes) and any("not stable" in line for line in advice(answer))
    valid("identify", report.document(answer, "y") | {"files": []})


# Measured data


def test_the_hair_dryer(tmp_path: Path) -> None:
    if "FAULTSPACE_DATA" not in os.environ:
        pytest.skip("FAULTSPACE_DATA does not name the folder of measured data")
    lines = (Path(os.environ["FAULTSPACE_DATA"]) / "hairdryer_SLICOT_IB01BD.dat").read_text("utf-8").split("\n", 3)
    values = np.array(lines[3].split(), dtype=float)[:2000].reshape(2, 1000).T
    path = tmp_path / "hairdryer.csv"
    np.savetxt(path, values, delimiter=",", header="voltage,temperature", comments="", fmt="%.10g")
    channels = ("--inputs", "voltage", "--outputs", "temperature")
    run = identified(
        path, tmp_path / "out", "--json", "--operating-point", "means", "--order", "4", "--block-rows", "15", channels=channels
    )
    assert run.code == 0, run.err
    assert run.json["order"] == 4 and 88 < run.json["fit"][0] < 96
    # A slow mode lies about the unit circle: an unstable estimate is told, never altered.
    assert run.json["stable"] == (max(abs(complex(*pole)) for pole in run.json["poles"]) < 1)
    assert run.json["stable"] != any("not stable" in note for note in run.json["notes"])
    assert run.json["n_v"] is None and run.json["fault_space"] is None  # one output: a fault cannot be told from noise
    assert run.json["n_v_reason"]
    remembered = identified(path, tmp_path / "means", "--json", "--order", "4", "--operating-point", "zero", channels=channels)
    assert any("--operating-point means" in row["advice"] for row in remembered.json["doubts"]["rows"])


def test_examples_write_the_record(as_printed: tuple[Run, Path, Identification], record: made.FaultyRecord) -> None:
    assert (as_printed[1] / "result" / report.MODEL).exists()
    path = as_printed[1] / made.FILE_NAME
    assert path.stat().st_size < 200_000
    got = read_record(str(path), inputs=made.INPUTS, outputs=made.OUTPUTS)
    assert np.allclose(got.y, record.y, atol=1e-3) and np.allclose(got.u, record.u, atol=1e-3)
