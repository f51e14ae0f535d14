"""`faultspace identify`: every format, every refusal, and whole runs on data whose answer is known.

csv_file        the packaged record as a table
identified      a run in this process into a folder
response        what a fault column does to the outputs, whatever the basis of the states
"""

from __future__ import annotations

import csv
import hashlib
import importlib
import importlib.util
import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.io import savemat

from faultspace import example_data as made
from faultspace import identification_report as report
from faultspace import identifying
from faultspace.data_files import Record, read_record, split_names
from faultspace.exact.input_rules import InvalidInput
from faultspace.numeric.distances import containment_distance, subspace_distance
from faultspace.numeric.fault_space import fault_space
from faultspace.numeric.models import StateSpaceModel
from faultspace.numeric.reconstruction import reconstruct_fault
from tests.end_to_end.commands import Run, call, command, validator

Array = NDArray[np.float64]

CHANNELS = ("--inputs", ",".join(made.INPUTS), "--outputs", ",".join(made.OUTPUTS))
needs_pyarrow = pytest.mark.skipif(importlib.util.find_spec("pyarrow") is None, reason="pyarrow is not installed")
needs_matplotlib = pytest.mark.skipif(importlib.util.find_spec("matplotlib") is None, reason="matplotlib is not installed")


@pytest.fixture(scope="module")
def record() -> made.FaultyRecord:
    return made.faulty_record()


@pytest.fixture
def csv_file(tmp_path: Path, record: made.FaultyRecord) -> Path:
    path = tmp_path / made.FILE_NAME
    path.write_text(made.csv_text(record), encoding="utf-8")
    return path


def small_csv(folder: Path, text: str, name: str = "data.csv") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def identified(path: Path, out: Path, *options: str, channels: tuple[str, ...] = CHANNELS) -> Run:
    """A run with the packaged record's channels unless others are given."""
    return call("identify", str(path), *channels, "--out", str(out), *options)


def refused(run: Run, *parts: str) -> None:
    """One line on standard error behind the progress, with these parts; nothing on standard output; exit code 2."""
    assert (run.code, run.out) == (2, ""), run
    last = run.err.strip().splitlines()[-1]
    assert last.startswith("faultspace: ") and "Traceback" not in run.err
    for part in parts:
        assert part in last, last


def response(A: Any, F: Any, C: Any, G: Any, count: int = 8) -> Array:
    """G, CF, CAF, ... of each column, stacked (count p, m)."""
    columns = np.asarray(F, dtype=float).shape[1]
    return StateSpaceModel(A, F, C, G).markov(count).reshape(-1, columns)


# The known answer


def test_the_packaged_record_gives_the_fault_that_made_it(csv_file: Path, record: made.FaultyRecord, tmp_path: Path) -> None:
    before = hashlib.sha256(csv_file.read_bytes()).hexdigest()
    run = identified(csv_file, tmp_path / "out", "--json")
    assert run.code == 0, run.err
    answer = run.json
    assert (answer["order"], answer["n_v"], answer["fault_space"]["n_z"]) == (3, 1, 1)
    assert answer["order_gap_clean"] and answer["stable"] and answer["samples"] == made.SAMPLES
    truth = sorted(np.linalg.eigvals(made.A), key=lambda z: (z.real, z.imag))
    poles = sorted((complex(*pair) for pair in answer["poles"]), key=lambda z: (z.real, z.imag))
    assert np.allclose(poles, truth, atol=0.03)

    model = json.loads((tmp_path / "out" / report.MODEL).read_text("utf-8"))
    found = StateSpaceModel.from_json(model)
    true_model = StateSpaceModel(made.A, made.B, made.C, made.D)
    assert np.allclose(found.markov(8), true_model.markov(8), atol=0.06)
    space = answer["fault_space"]
    true_response = response(made.A, made.F, made.C, made.G)
    assert subspace_distance(response(found.A, space["F"], found.C, space["G"]), true_response) < 0.06
    assert subspace_distance(response(found.A, model["F"], found.C, model["G"]), true_response) < 0.06

    with open(tmp_path / "out" / report.SIGNAL, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert [int(row["sample"]) for row in rows] == list(range(made.SAMPLES))
    first, last = answer["fault_signal"]["trusted"]
    assert [int(row["determined"]) for row in rows] == [int(first <= k < last) for k in range(made.SAMPLES)]
    v = np.array([float(row["v1"]) for row in rows])
    assert abs(np.corrcoef(v[first:last], record.v[first:last, 0])[0, 1]) > 0.98
    assert hashlib.sha256(csv_file.read_bytes()).hexdigest() == before


def test_people_read_a_summary_and_find_the_files(csv_file: Path, tmp_path: Path) -> None:
    out = tmp_path / "deep" / "out"
    run = command("identify", str(csv_file), *CHANNELS, "--out", str(out))
    assert run.code == 0, run.err
    assert "order 3" in run.out and "n_v: **1**" in run.out
    text = (out / report.SUMMARY).read_text("utf-8")
    assert "## Fault space" in text and "n_v: **1**" in text
    listed = run.out.strip().splitlines()[-1].partition(": ")[2].split(", ")
    assert sorted(listed) == sorted(path.name for path in out.iterdir())
    assert "identifying the model" in run.err and "Traceback" not in run.err


@needs_matplotlib
def test_the_plots_are_pictures(csv_file: Path, tmp_path: Path) -> None:
    run = identified(csv_file, tmp_path / "out", "--json")
    assert set(report.PICTURES) <= set(run.json["files"])
    for name in report.PICTURES:
        assert (tmp_path / "out" / name).read_bytes().startswith(b"\x89PNG"), name


def test_without_matplotlib_it_says_so_and_goes_on(csv_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def without(name: str) -> Any:
        raise ImportError(name)

    monkeypatch.setattr("faultspace.identification_report.import_module", without)
    run = identified(csv_file, tmp_path / "out", "--json")
    assert run.code == 0 and "matplotlib is not installed" in run.err
    assert run.json["files"] == [report.MODEL, report.SPACE, report.SIGNAL, report.SUMMARY]
    assert "matplotlib" in (tmp_path / "out" / report.SUMMARY).read_text("utf-8")


def test_inspect_reads_the_model_where_floats_are_taken_exactly(csv_file: Path, tmp_path: Path) -> None:
    assert identified(csv_file, tmp_path / "out").code == 0
    model = tmp_path / "out" / report.MODEL
    validator("model").validate(json.loads(model.read_text("utf-8")))
    run = call("inspect", str(model), "--floats-exactly", "--json")
    assert run.code == 0, run.err
    # Exactly: G has full column rank, so there is neither a delay nor, generically, any zero.
    got = {key: run.json[key] for key in ("n", "m", "p", "normal_rank", "zeta", "fault_space_dimension", "delay_known_state")}
    assert got == {"n": 3, "m": 1, "p": 3, "normal_rank": 1, "zeta": 0, "fault_space_dimension": 1, "delay_known_state": 0}
    refused(call("inspect", str(model)), "floats", "--floats-exactly")


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
    answer = identifying.identify(Record(y, u, made.OUTPUTS, made.INPUTS, "arrays"), order=3)
    assert answer.dimension is not None and answer.dimension.n_v != 1  # what the residual alone would say
    assert answer.count == 1 and "n_u + 1" in answer.count_reason


def test_a_space_with_zeros_gives_a_pair_that_explains_the_residual() -> None:
    v = np.random.default_rng(2).standard_normal((1500, 1))
    r = StateSpaceModel(made.A, made.F, made.C, np.zeros((3, 1))).simulate(v)
    space = fault_space(r, made.A, made.C)
    assert (space.n_v, space.n_z) == (1, 2)  # without G there is a zero at infinity
    F, G = identifying.choose_pair(r, made.A, made.C, space, 1)
    assert F.shape == (3, 1) and containment_distance(np.vstack([F, G]), space.basis) < 1e-12
    signal = reconstruct_fault(r, made.A, F, made.C, G)
    assert signal.misfit < 1e-9 and signal.trusted[1] - signal.trusted[0] > 1400


def test_without_a_fault_there_is_none() -> None:
    u = np.random.default_rng(4).standard_normal((1000, 2))
    y = StateSpaceModel(made.A, made.B, made.C, made.D).simulate(u)
    answer = identifying.identify(Record(y, u, made.OUTPUTS, made.INPUTS, "arrays"))
    assert answer.identification is not None and answer.identification.order == 3
    assert answer.count == 0 and answer.space is None and answer.signal is None


def test_an_open_order_is_an_answer_and_old_files_go(csv_file: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    assert identified(csv_file, out).code == 0 and (out / report.MODEL).exists()
    draw = np.random.default_rng(5)
    path = tmp_path / "noise.npz"
    np.savez(path, u=draw.standard_normal(600), y=draw.standard_normal((600, 2)))
    (out / "mine.txt").write_text("kept", encoding="utf-8")
    run = identified(path, out, "--json", channels=("--inputs", "u", "--outputs", "y"))
    assert run.code == 0, run.err
    assert run.json["order"] is None and run.json["n_v"] is None and run.json["fault_space"] is None
    assert any("no clean gap" in note for note in run.json["notes"])
    assert not (out / report.MODEL).exists() and not (out / report.SIGNAL).exists()
    assert (out / "mine.txt").read_text("utf-8") == "kept"
    assert "undecided" in (out / report.SUMMARY).read_text("utf-8")


def test_faults_given_override_the_count_and_are_told(csv_file: Path, tmp_path: Path) -> None:
    run = identified(csv_file, tmp_path / "out", "--json", "--faults", "3")
    assert (run.code, run.json["n_v"]) == (0, 3)
    assert run.json["n_v_reason"].startswith("3 given; the data say 1")
    assert not run.json["fault_space"]["meaningful"] and run.json["fault_space"]["basis"] is None
    assert run.json["fault_signal"] is None and report.SIGNAL not in run.json["files"]


def test_means_far_from_zero_are_told_and_removed(tmp_path: Path, record: made.FaultyRecord) -> None:
    path = tmp_path / "lifted.npz"
    np.savez(path, u=record.u + 20, y=record.y - 100)
    channels = ("--inputs", "u", "--outputs", "y")
    plain = identified(path, tmp_path / "a", "--json", "--order", "3", channels=channels)
    assert plain.code == 0 and any("--remove-means" in note for note in plain.json["notes"])
    run = identified(path, tmp_path / "b", "--json", "--remove-means", channels=channels)
    assert (run.code, run.json["order"], run.json["n_v"]) == (0, 3, 1)
    assert not any("--remove-means" in note for note in run.json["notes"])


# Formats


def write_tables(folder: Path, u: Array, y: Array) -> dict[str, tuple[Path, str, str]]:
    """The same record in every way of writing it: path, inputs, outputs."""
    rows = np.hstack([u, y]).tolist()
    names = ["a", "b", "p", "q", "r"]
    ways = {}
    for name, separator, suffix in (("comma", ",", ".csv"), ("semicolon", ";", ".csv"), ("tab", "\t", ".tsv"), ("blanks", "  ", ".dat")):
        text = "\n".join([separator.join(names), *(separator.join(map(repr, row)) for row in rows)])
        ways[name] = small_csv(folder, "# measured\n\n" + text + "\n", name + suffix), "a,b", "p,q,r"
    quoted = "\n".join(['"a","b","p","q, far","r"', *(",".join(f'"{x!r}"' for x in row) for row in rows)])
    bare = "\ufeff" + ways["comma"][0].read_text("utf-8").strip()
    ways["byte order mark and no newline"] = small_csv(folder, bare, "bom.csv"), "a,b", "p,q,r"
    ways["quoted"] = small_csv(folder, quoted + "\n", "quoted.csv"), "a,b", "p,r"
    ways["no names"] = small_csv(folder, "\n".join(",".join(map(repr, row)) for row in rows), "bare.txt"), "data[:,0:2]", "data[:,2:5]"
    cube = y[:, :, np.newaxis] * [1.0, 2.0]
    np.savez(folder / "n.npz", all=np.hstack([u, y]), y=np.asfortranarray(y), wide=y.T, cube=cube)
    ways["npz matrix"] = folder / "n.npz", "all[:,0],all[1]", "all[:,2:]"
    ways["npz arrays"] = folder / "n.npz", "all[:,0:2]", "y"
    ways["npz rows"] = folder / "n.npz", "all[:,0:2]", "wide[0,:],wide[1,:],wide[2,:]"
    ways["npz cube"] = folder / "n.npz", "all[:,0:2]", "cube[0,0],cube[1,0],cube[2,0]"
    savemat(folder / "m.mat", {"u": u, "y": y, "row": u[:, 0]})
    ways["mat"] = folder / "m.mat", "u", "y[:,0:3]"
    ways["mat row"] = folder / "m.mat", "row,u[:,1]", "y"
    return ways


def test_every_way_of_writing_a_record_reads_the_same(tmp_path: Path, record: made.FaultyRecord) -> None:
    u, y = record.u[:300], record.y[:300]
    for name, (path, inputs, outputs) in write_tables(tmp_path, u, y).items():
        before = path.read_bytes()
        got = read_record(str(path), inputs=[inputs], outputs=[outputs])
        wanted = y[:, [0, 2]] if name == "quoted" else y
        assert np.array_equal(got.u, u), name
        assert np.array_equal(got.y, wanted), name
        assert len(got.inputs) == 2 and len(set(got.inputs + got.outputs)) == 2 + wanted.shape[1], name
        assert path.read_bytes() == before


def test_labels_of_a_range_select_the_channels_themselves(tmp_path: Path, record: made.FaultyRecord) -> None:
    np.savez(tmp_path / "d.npz", all=np.hstack([record.u, record.y])[:50])
    got = read_record(str(tmp_path / "d.npz"), inputs=["all[:,0:2]"], outputs=["all[:,2:]"])
    assert got.outputs == ("all[:,2]", "all[:,3]", "all[:,4]")
    again = read_record(str(tmp_path / "d.npz"), inputs=got.inputs, outputs=got.outputs)
    assert np.array_equal(again.y, got.y)


@needs_pyarrow
def test_parquet_reads_the_same(tmp_path: Path, record: made.FaultyRecord) -> None:
    pyarrow: Any = importlib.import_module("pyarrow")
    parquet: Any = importlib.import_module("pyarrow.parquet")
    names = [*made.INPUTS, *made.OUTPUTS]
    columns = dict(zip(names, np.hstack([record.u, record.y]).T, strict=True))
    path = tmp_path / "d.parquet"
    parquet.write_table(pyarrow.table(columns | {"when": ["now"] * len(record.y)}), path, row_group_size=700)
    told: list[tuple[int, int]] = []
    got = read_record(str(path), inputs=made.INPUTS, outputs=made.OUTPUTS, tell=lambda *pair: told.append(pair))
    assert np.array_equal(got.u, record.u) and np.array_equal(got.y, record.y)
    assert told[-1] == (6, 6)
    for name, part in (("when", "type string"), ("nothing", "no column 'nothing'")):
        with pytest.raises(InvalidInput, match=part):
            read_record(str(path), inputs=[name], outputs=made.OUTPUTS)
    holed = tmp_path / "holed.parquet"
    parquet.write_table(pyarrow.table({"u": [1.0, None, 2.0], "y": [1, 2, 3]}), holed)
    with pytest.raises(InvalidInput, match=r"'u' is no number .* at sample 1 "):
        read_record(str(holed), inputs=["u"], outputs=["y"])


def test_parquet_without_pyarrow_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def without(name: str) -> Any:
        raise ImportError(name)

    monkeypatch.setattr("faultspace.data_files.import_module", without)
    path = tmp_path / "d.parquet"
    path.write_bytes(b"PAR1")
    refused(identified(path, tmp_path / "out"), "pyarrow", "faultspace[parquet]")


def test_commas_in_brackets_do_not_separate() -> None:
    assert split_names(["a, b[:,1:3]", "c[0,2],d"]) == ["a", "b[:,1:3]", "c[0,2]", "d"]


def test_long_tables_are_read_in_pieces_and_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("faultspace.text_tables.PIECE", 64)
    path = small_csv(tmp_path, "u,y\n" + "".join(f"{k},{k * 0.5}\n" for k in range(1000)))
    told: list[tuple[int, int]] = []
    got = read_record(str(path), inputs=["u"], outputs=["y"], tell=lambda *pair: told.append(pair))
    assert np.array_equal(got.u[:, 0], np.arange(1000.0)) and np.array_equal(got.y, got.u / 2)
    assert len(told) == 16 and told[-1] == (path.stat().st_size,) * 2


# Bad input

TABLES: dict[str, tuple[str, tuple[str, ...]]] = {
    "empty": ("", ("no line",)),
    "names alone": ("u,y\n", ("no samples",)),
    "missing column": ("u,z\n1,2\n3,4\n", ("no column", "'y'", "u, z")),
    "other case": ("U,y\n1,2\n3,4\n", ("did you mean 'U'?",)),
    "wrong delimiter": ("u|y\n1|2\n3|4\n", ("comma, semicolon, tab, blanks", "u|y")),
    "decimal comma": ("u;y\n1,5;2\n3;4\n", ("line 2", "'1,5'", "point")),
    "word": ("u,y\n1,2\n3,four\n", ("line 3", "'y'", "'four'", "number")),
    "empty field": ("u,y\n1,2\n3,\n5,6\n", ("'y'", "sample 1", "NaN or empty")),
    "NaN": ("u,y\n1,2\nnan,4\n5,6\n", ("'u'", "sample 1")),
    "infinity": ("u,y\n1,2\n3,inf\n", ("'y'", "infinite", "sample 1")),
    "short line": ("u,y\n" + "1,2\n" * 80 + "3\n", ("line 82", "1 field", "expected 2")),
    "long line": ("u,y,z\n1,2,3\n3,4,5,6\n", ("4 fields", "comma")),
    "names twice": ("u,y,y\n1,2,3\n", ("two columns named 'y'",)),
    "zero bytes": ("u,y\n1,2\n\0\0\n", ("zero byte",)),
    "too few samples": ("u,y\n" + "".join(f"{(k * k) % 7},{k % 5}\n" for k in range(4)), ("samples are too few", "needed")),
    "constant input": ("u,y\n" + "".join(f"1,{(k * k) % 11}\n" for k in range(400)), ("constant",)),
}


@pytest.mark.parametrize("name", TABLES)
def test_bad_tables_are_told_in_one_line(name: str, tmp_path: Path) -> None:
    text, parts = TABLES[name]
    path = small_csv(tmp_path, text)
    refused(identified(path, tmp_path / "out", channels=("--inputs", "u", "--outputs", "y")), str(path), *parts)
    assert not any((tmp_path / "out").iterdir())


def arrays(folder: Path) -> Path:
    np.savez(
        folder / "a.npz", u=np.arange(50.0), y=np.arange(50.0), short=np.arange(40.0), wide=np.ones((3, 50)), cube=np.ones((50, 2, 2)),
        words=np.array(["a", "b"]), z=np.arange(50) + 1j,
    )  # fmt: skip
    return folder / "a.npz"


SELECTORS: dict[str, tuple[str, str, tuple[str, ...]]] = {
    "no such array": ("nope", "y", ("no array 'nope'", "u, y, short")),
    "no such column": ("u", "wide[:,60]", ("wide is 3 x 50", "from 0")),
    "one number": ("u", "wide[1,2]", ("one number", "wide[:,2]")),
    "cube": ("u", "cube", ("50 x 2 x 2", "NAME[i,j]")),
    "too many indices": ("u", "y[1,2,3]", ("expected 1 indices",)),
    "words": ("u", "words", ("type <U1",)),
    "complex": ("u", "z", ("real and imaginary",)),
    "transposed": ("u", "wide", ("looks transposed", "wide[i,:]")),
    "unequal": ("u", "short", ("inputs of 50", "outputs of 40")),
    "both": ("u", "u", ("as input and as output",)),
    "twice": ("u,u", "y", ("'u' twice",)),
    "nothing": (" , ", "y", ("no inputs",)),
}


@pytest.mark.parametrize("name", SELECTORS)
def test_bad_selectors_are_told_in_one_line(name: str, tmp_path: Path) -> None:
    inputs, outputs, parts = SELECTORS[name]
    refused(identified(arrays(tmp_path), tmp_path / "out", channels=("--inputs", inputs, "--outputs", outputs)), *parts)


@pytest.mark.parametrize(
    ("name", "content", "parts"),
    [
        ("d.npz", b"PK\x03\x04 broken", ("NPZ",)),
        ("d.npz", b"no archive", ("NPZ",)),
        ("d.mat", b"MATLAB 5.0 MAT-file" + bytes(40), ("MAT",)),
        ("d.mat", b"", ("MAT",)),
        ("d.xlsx", b"PK", ("'.xlsx'", ".csv", ".parquet")),
        ("d.csv", "é,y\n1,2\n".encode("latin-1"), ("0xe9", "UTF-8")),
        ("d.csv", "u,y\n1,2\n".encode("utf-16"), ("0xff", "UTF-8")),
    ],
)
def test_files_that_are_something_else(name: str, content: bytes, parts: tuple[str, ...], tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    refused(identified(path, tmp_path / "out", channels=("--inputs", "u", "--outputs", "y")), str(path), *parts)


def test_pickled_arrays_are_not_executed(tmp_path: Path) -> None:
    np.savez(tmp_path / "p.npz", u=np.array([{"a": 1}], dtype=object), y=np.ones(1))
    refused(identified(tmp_path / "p.npz", tmp_path / "out", channels=("--inputs", "u", "--outputs", "y")), "NPZ")


def test_missing_files_and_folders(csv_file: Path, tmp_path: Path) -> None:
    refused(identified(tmp_path / "none.csv", tmp_path / "out"), "none.csv", "no such file")
    refused(identified(tmp_path, tmp_path / "out"), str(tmp_path))
    refused(identified(csv_file, csv_file), "cannot be written into")


def test_a_folder_that_cannot_be_written_is_refused_before_the_work(csv_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(identifying, "read_record", lambda *_, **__: pytest.fail("the work had begun"))
    refused(identified(csv_file, csv_file / "out"), "cannot be written into")


def test_the_data_are_not_overwritten(tmp_path: Path, record: made.FaultyRecord) -> None:
    path = tmp_path / report.SIGNAL
    path.write_text(made.csv_text(record), encoding="utf-8")
    refused(identified(path, tmp_path), "overwritten")
    assert path.read_text("utf-8") == made.csv_text(record)


def test_a_failure_in_writing_leaves_no_half_answer(csv_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(report, "_signal_table", full)
    refused(identified(csv_file, tmp_path / "out"), "no space left")
    assert list((tmp_path / "out").iterdir()) == []


@pytest.mark.parametrize(
    ("options", "part"),
    [
        (("--order", "500"), "order = 500"),
        (("--faults", "9"), "9 for 3 outputs"),
        (("--order", "0"), "'--order'"),
        (("--block-rows", "1"), "'--block-rows'"),
    ],
)
def test_bad_numbers(options: tuple[str, str], part: str, csv_file: Path, tmp_path: Path) -> None:
    refused(identified(csv_file, tmp_path / "out", *options), part)


# Measured data


def test_the_hair_dryer(tmp_path: Path) -> None:
    if "FAULTSPACE_DATA" not in os.environ:
        pytest.skip("FAULTSPACE_DATA does not name the folder of measured data")
    lines = (Path(os.environ["FAULTSPACE_DATA"]) / "hairdryer_SLICOT_IB01BD.dat").read_text("utf-8").split("\n", 3)
    values = np.array(lines[3].split(), dtype=float)[:2000].reshape(2, 1000).T
    path = tmp_path / "hairdryer.csv"
    np.savetxt(path, values, delimiter=",", header="voltage,temperature", comments="", fmt="%.10g")
    channels = ("--inputs", "voltage", "--outputs", "temperature")
    run = identified(path, tmp_path / "out", "--json", "--remove-means", "--order", "4", "--block-rows", "15", channels=channels)
    assert run.code == 0, run.err
    assert run.json["order"] == 4 and 88 < run.json["fit"][0] < 96
    # A slow mode lies about the unit circle: an unstable estimate is told, never altered.
    assert run.json["stable"] == (max(abs(complex(*pole)) for pole in run.json["poles"]) < 1)
    assert run.json["stable"] != any("not stable" in note for note in run.json["notes"])
    assert run.json["n_v"] is None and run.json["fault_space"] is None  # one output: a fault cannot be told from noise
    assert run.json["n_v_reason"]
    remembered = identified(path, tmp_path / "means", "--json", "--order", "4", channels=channels)
    assert any("--remove-means" in note for note in remembered.json["notes"])


def test_examples_write_the_record(tmp_path: Path, record: made.FaultyRecord) -> None:
    run = call("examples", str(tmp_path / "x"))
    assert run.code == 0 and "faultspace identify" in run.err
    path = tmp_path / "x" / made.FILE_NAME
    assert path.stat().st_size < 200_000
    got = read_record(str(path), inputs=made.INPUTS, outputs=made.OUTPUTS)
    assert np.allclose(got.y, record.y, atol=1e-3) and np.allclose(got.u, record.u, atol=1e-3)
