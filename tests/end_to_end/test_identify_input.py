"""These tests are about what `faultspace identify` reads: every format, and every refusal heard in one line with nothing written.

write_tables    the same record in every way of writing it
TABLES          bad text tables and what is said of them
SELECTORS       bad choices of channels and what is said of them
"""

from __future__ import annotations

import importlib
import importlib.util
import inspect
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.io import savemat

from faultspace import example_data as made
from faultspace.base.errors import InvalidInput
from faultspace.cli import command_line, identifying
from faultspace.numeric.data import files as data_files
from faultspace.numeric.data.files import read_record
from faultspace.numeric.data.selectors import quoted, split_names
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.plant.pipeline import identify as whole_identify
from faultspace.numeric.plant.report import result_files as report
from tests.end_to_end.identify_runs import identified, refused, small_csv

Array = NDArray[np.float64]

needs_pyarrow = pytest.mark.skipif(importlib.util.find_spec("pyarrow") is None, reason="pyarrow is not installed")


# Formats


def write_tables(folder: Path, u: Array, y: Array) -> dict[str, tuple[Path, str, str]]:
    """Write the same record in every way of writing it, and return path, inputs and outputs of each."""
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
    np.save(folder / "f.npy", np.asfortranarray(np.hstack([u, y])))
    ways["npy"] = folder / "f.npy", "data[:,:2]", "data[:,2:]"
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


def test_every_format_is_tried_here_and_told_to_users(tmp_path: Path, record: made.FaultyRecord) -> None:
    """A reader that is added has a way of writing in `write_tables` (Parquet has a test of its own), and stands where people look."""
    tried = {data_files.FORMATS[path.suffix] for path, _, _ in write_tables(tmp_path, record.u[:9], record.y[:9]).values()}
    assert tried | {"Parquet"} == set(data_files.READERS) == set(data_files.FORMATS.values())
    assert [suffix for suffix in data_files.FORMATS if suffix not in (read_record.__doc__ or "")] == [], "the docstring of read_record"
    names = {"CSV" if name == "text" else name for name in data_files.READERS}
    page = (Path(__file__).parents[2] / "docs" / "your-data.md").read_text("utf-8")
    for place, text in ("docs/your-data.md", page), ("the help of DATA in command_line.py", inspect.getsource(command_line.identify)):
        assert [name for name in names if name not in text] == [], place


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
    heard: list[tuple[int, int]] = []
    got = read_record(str(path), inputs=made.INPUTS, outputs=made.OUTPUTS, on_progress=lambda stage, *pair: heard.append(pair))
    assert np.array_equal(got.u, record.u) and np.array_equal(got.y, record.y)
    assert heard[-1] == (made.SAMPLES, made.SAMPLES)
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

    monkeypatch.setattr("faultspace.numeric.data.parts.import_module", without)
    path = tmp_path / "d.parquet"
    path.write_bytes(b"PAR1")
    refused(identified(path, tmp_path / "out"), "pyarrow", "faultspace[parquet]")


def test_commas_in_brackets_do_not_separate() -> None:
    assert split_names(["a, b[:,1:3]", "c[0,2],d"]) == ["a", "b[:,1:3]", "c[0,2]", "d"]
    assert split_names('"flow, kg/s", T1,"5"" pipe"') == ["flow, kg/s", "T1", '5" pipe']
    assert split_names('5" pipe,6" pipe') == ['5" pipe', '6" pipe']  # inches, no quotes
    assert (quoted("T [degC]"), quoted("b[:,1:3]"), quoted("flow, kg/s")) == ("T [degC]", "b[:,1:3]", '"flow, kg/s"')


@given(st.lists(st.text(alphabet='ab ",[]:\n12', min_size=1, max_size=8), min_size=1, max_size=4))
def test_names_are_read_as_they_are_quoted(names: list[str]) -> None:
    assert split_names(",".join(map(quoted, names))) == names


def test_long_tables_are_read_in_pieces_and_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("faultspace.numeric.data.text_tables.PIECE", 64)
    path = small_csv(tmp_path, "u,y\n" + "".join(f"{k},{k * 0.5}\n" for k in range(1000)))
    heard: list[tuple[int, int]] = []
    got = read_record(str(path), inputs=["u"], outputs=["y"], on_progress=lambda stage, *pair: heard.append(pair))
    assert np.array_equal(got.u[:, 0], np.arange(1000.0)) and np.array_equal(got.y, got.u / 2)
    assert len(heard) == 16 and heard[-1] == (path.stat().st_size,) * 2


# Bad input

TABLES: dict[str, tuple[str, tuple[str, ...]]] = {
    "empty": ("", ("no line",)),
    "names alone": ("u,y\n", ("no samples",)),
    "missing column": ("u,z\n1,2\n3,4\n", ("no column", "'y'", "u, z")),
    "other case": ("U,y\n1,2\n3,4\n", ("did you mean 'U'?",)),
    "wrong delimiter": ("u|y\n1|2\n3|4\n", ("comma, semicolon, tab, blanks", "u|y")),
    "decimal comma, later a point": ("u;y\n1,5;2\n" + "3;4\n" * 60 + "1.5;2\n", ("line 63", "'1.5'", "comma")),
    "decimal point, later a comma": ("u;y\n1.5;2\n" + "3;4\n" * 60 + "1,5;2\n", ("line 63", "'1,5'", "point")),
    "word": ("u,y\n1,2\n3,four\n", ("line 3", "'y'", "'four'", "number", "mend it")),
    "empty field": ("u,y\n1,2\n3,\n5,6\n", ("'y'", "sample 1", "NaN or empty")),
    "NaN": ("u,y\n1,2\nnan,4\n5,6\n", ("'u'", "sample 1")),
    "infinity": ("u,y\n1,2\n3,inf\n", ("'y'", "infinite", "sample 1")),
    "short line": ("u,y\n" + "1,2\n" * 80 + "3\n", ("line 82", "1 field", "expected 2")),
    "long line": ("u,y,z\n1,2,3\n3,4,5,6\n", ("4 fields", "comma")),
    "names twice": ("u,y,y\n1,2,3\n", ("two columns named 'y'",)),
    "zero bytes": ("u,y\n1,2\n\0\0\n", ("zero byte",)),
    "constant output": ("u,y\n" + "".join(f"{(k * k) % 11},5\n" for k in range(400)), ("'y' is constant (5)", "leave it out")),
    "unexciting input": (
        "u,y\n" + "".join(f"{k % 2},{(k * k) % 11}\n" for k in range(400)),
        ("does not excite enough", "2 of 20 directions", "richer input"),
    ),
    "transposed": (
        "\n".join([",".join(["u", "y", *(f"t{k}" for k in range(60))]), ",".join("1" * 62)]),
        ("got 1 sample", "fewer samples than channels", "transposed?"),
    ),
    "quotes left open": ('u,y\n"1,2\n3,4\n', ("none of comma, semicolon, tab, blanks",)),
    "too few samples": (
        "u,y\n" + "".join(f"{(k * k) % 7},{k % 5}\n" for k in range(4)),
        ("got 4 samples, too few", "need at least 9", "record more"),
    ),
    "constant input": ("u,y\n" + "".join(f"1,{(k * k) % 11}\n" for k in range(400)), ("input 'u' is constant (1)", "leave it out")),
}


@pytest.mark.parametrize("name", TABLES)
def test_bad_tables_are_reported_in_one_line(name: str, tmp_path: Path) -> None:
    text, parts = TABLES[name]
    path = small_csv(tmp_path, text)
    refused(identified(path, tmp_path / "out", channels=("--inputs", "u", "--outputs", "y")), str(path), *parts)
    assert not (tmp_path / "out").exists()


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
    "unequal": ("u", "short", ("unequal length", "u 50, short 40", "cut them")),
    "both": ("u", "u", ("as input and as output",)),
    "twice": ("u,u", "y", ("'u' twice",)),
    "nothing": (" , ", "y", ("no inputs",)),
}


@pytest.mark.parametrize("name", SELECTORS)
def test_bad_selectors_are_reported_in_one_line(name: str, tmp_path: Path) -> None:
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
        ("d.csv", "é,y\n1,2\n".encode("latin-1"), ("no column", "expected one of: é, y")),
        ("d.csv", "u,y\n1,2\n".encode("utf-16") + b"\x00\xd8", ("UTF-16",)),
        ("d.csv", "u,y\n1,2\n".encode("utf-16-le"), ("zero byte", "UTF-16")),
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
    refused(identified(tmp_path, tmp_path / "out"), str(tmp_path), "is a directory", "data file")
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

    found: list[Any] = []

    def identify(*records: Any, **options: Any) -> Any:
        found.append(found[0] if found else whole_identify(*records, **options))
        return found[-1]

    monkeypatch.setattr(report, "_signal_table", full)
    monkeypatch.setattr(identifying, "identify", identify)
    refused(identified(csv_file, tmp_path / "out", "--order", "3"), "no space left")
    assert not (tmp_path / "out").exists()
    (tmp_path / "kept").mkdir()
    refused(identified(csv_file, tmp_path / "kept", "--order", "3"), "no space left")
    assert list((tmp_path / "kept").iterdir()) == [] and len(found) == 2


@pytest.mark.parametrize(
    ("options", "part"),
    [
        (("--order", "500"), "order = 500"),
        (("--faults", "9"), "9 for 3 outputs"),
        (("--order", "0"), "--order: got '0', expected a whole number from 1 on, try 3"),
        (("--block-rows", "1"), "--block-rows: got '1', expected a whole number from 2 on, try 20"),
    ],
)
def test_bad_numbers(options: tuple[str, str], part: str, csv_file: Path, tmp_path: Path) -> None:
    refused(identified(csv_file, tmp_path / "out", *options), part)


def test_a_wrong_sample_far_into_the_record_is_reported_by_its_number(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("faultspace.numeric.data.text_tables.PIECE", 64)
    path = small_csv(tmp_path, "u,y\n" + "".join(f"{k},{'inf' if k == 777 else k}\n" for k in range(1000)))
    with pytest.raises(InvalidInput, match="'y' is infinite at sample 777 "):
        read_record(str(path), inputs=["u"], outputs=["y"])


def test_large_arrays_are_mapped_and_read_the_same(tmp_path: Path, record: made.FaultyRecord, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(data_files, "MAPPED", 1000)
    monkeypatch.setattr(data_files, "PIECE", 64)
    both = np.hstack([record.u, record.y])
    np.savez_compressed(tmp_path / "c.npz", a=both, b=np.asfortranarray(both), wide=both.T)
    np.save(tmp_path / "d.npy", both)
    for name, array in (("c.npz", "a"), ("c.npz", "b"), ("d.npy", "data")):
        got = read_record(str(tmp_path / name), inputs=[f"{array}[:,:2]"], outputs=[f"{array}[:,2:]"])
        assert np.array_equal(got.u, record.u) and np.array_equal(got.y, record.y), (name, array)
    got = read_record(str(tmp_path / "c.npz"), inputs=["wide[0,:]"], outputs=["wide[4,:]"])
    assert np.array_equal(got.y[:, 0], record.y[:, 2])


@pytest.mark.parametrize("kind", [np.int16, np.float32, np.bool_, np.float16, np.uint8])
def test_every_type_of_number_is_read_and_not_changed(kind: Any, tmp_path: Path, record: made.FaultyRecord) -> None:
    both = (10 * np.hstack([record.u, record.y])).astype(kind)
    strided = np.zeros((2 * len(both), 10), dtype=kind)[::2, ::2]
    strided[:] = both
    np.savez(tmp_path / "t.npz", c=both, f=np.asfortranarray(both))
    np.save(tmp_path / "s.npy", strided)
    for path, name in (("t.npz", "c"), ("t.npz", "f"), ("s.npy", "data")):
        before = (tmp_path / path).read_bytes()
        got = read_record(str(tmp_path / path), inputs=[f"{name}[:,:2]"], outputs=[f"{name}[:,2:]"])
        assert np.array_equal(got.y, both[:, 2:].astype(np.float64)) and got.single == (kind in (np.float16, np.float32))
        assert (tmp_path / path).read_bytes() == before


def test_faults_are_counted_to_float32_rounding_where_the_data_are_no_better(tmp_path: Path) -> None:
    draw = np.random.default_rng(3)
    u, v = draw.standard_normal((2000, 2)), draw.standard_normal((2000, 1))
    driven = StateSpaceModel(made.A, np.hstack([made.B, made.F]), made.C, np.hstack([made.D, made.G]))
    np.savez(tmp_path / "s.npz", u=u, y=driven.simulate(np.hstack([u, v])).astype(np.float32))
    run = identified(tmp_path / "s.npz", tmp_path / "out", "--json", "--order", "3", channels=("--inputs", "u", "--outputs", "y"))
    assert (run.code, run.json["n_v"], run.json["regime"]) == (0, 1, "rounding")


def test_one_channel_of_each_is_enough_for_a_model(tmp_path: Path) -> None:
    u = np.random.default_rng(8).standard_normal(2000)
    y = StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]]).simulate(u[:, None])[:, 0]
    np.savez(tmp_path / "one.npz", u=u, y=y)
    run = identified(tmp_path / "one.npz", tmp_path / "out", "--json", channels=("--inputs", "u", "--outputs", "y"))
    assert (run.code, run.json["order"], run.json["n_v"]) == (0, 1, 0), run


def test_block_rows_at_or_below_the_lag(tmp_path: Path) -> None:
    A = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.3, -0.5, 0.9]])  # one output: the lag is 3
    u = np.random.default_rng(9).standard_normal((2000, 1))
    y = StateSpaceModel(A, [[1.0], [0.5], [2.0]], [[1.0, 0.0, 0.0]], [[0.0]]).simulate(u)
    np.savez(tmp_path / "lag.npz", u=u, y=y)
    channels = ("--inputs", "u", "--outputs", "y")
    run = identified(tmp_path / "lag.npz", tmp_path / "out", "--order", "3", "--block-rows", "3", channels=channels)
    refused(run, "order = 3 is above p (block_rows - 1) = 1 * 2 = 2", "block_rows >= 4")
    enough = identified(tmp_path / "lag.npz", tmp_path / "out", "--order", "3", "--block-rows", "4", "--json", channels=channels)
    assert (enough.code, enough.json["order"], enough.json["n_v"]) == (0, 3, 0)
    # PI-MOESP cannot choose an order there; an ARX model of three lags can, and holds this one.
    open_order = identified(tmp_path / "lag.npz", tmp_path / "open", "--block-rows", "3", "--json", channels=channels)
    assert (open_order.code, open_order.json["order"]) == (0, 3) and open_order.json["orders"]["least"] == 3


def test_windows_too_long_for_the_record_are_reported_with_those_that_fit(csv_file: Path, tmp_path: Path) -> None:
    refused(identified(csv_file, tmp_path / "out", "--block-rows", "500"), "got 4000 samples", "need at least 4499", "--block-rows 444")


@pytest.mark.slow  # other windows are answered daily, below and above
def test_windows_longer_than_the_default_are_answered(csv_file: Path, tmp_path: Path) -> None:
    assert identified(csv_file, tmp_path / "out", "--block-rows", "60", "--order", "3").code == 0


def test_a_full_disk_is_reported(csv_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Full:
        def seek(self, *_: object) -> None: ...

        def close(self) -> None: ...

        def write(self, _: object) -> None:
            raise OSError(28, "No space left on device")

    monkeypatch.setattr("faultspace.numeric.data.records.tempfile.SpooledTemporaryFile", lambda **_: Full())
    refused(identified(csv_file, tmp_path / "out"), "temporary files", "TMPDIR", "No space left")


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="permissions do not bind this user")
def test_a_folder_without_permission(csv_file: Path, tmp_path: Path) -> None:
    (tmp_path / "locked").mkdir(mode=0o500)
    refused(identified(csv_file, tmp_path / "locked"), "cannot be written into", "permission denied")


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="no /proc here")
def test_a_folder_that_nobody_can_write_into(csv_file: Path) -> None:
    refused(identified(csv_file, Path("/proc/answer")), "/proc/answer", "cannot be written into")


@needs_pyarrow
def test_parquet_with_two_columns_of_one_name(tmp_path: Path) -> None:
    pyarrow: Any = importlib.import_module("pyarrow")
    parquet: Any = importlib.import_module("pyarrow.parquet")
    columns = [pyarrow.array([1.0, 2.0, 3.0])] * 3
    parquet.write_table(pyarrow.Table.from_arrays(columns, names=["u", "y", "y"]), tmp_path / "t.parquet")
    refused(identified(tmp_path / "t.parquet", tmp_path / "out", channels=("--inputs", "u", "--outputs", "y")), "two columns named 'y'")
    (tmp_path / "no.parquet").write_bytes(b"u,y\n1,2\n")
    refused(identified(tmp_path / "no.parquet", tmp_path / "out", channels=("--inputs", "u", "--outputs", "y")), "Parquet")


@pytest.mark.parametrize(("place", "separator"), [(3, ","), (70, ","), (70, ";"), (70, " ")])
def test_a_quotation_mark_without_its_partner_is_refused(place: int, separator: str, tmp_path: Path) -> None:
    lines = [separator.join(("u", "y")), *(separator.join((str(k % 7), str(k % 5))) for k in range(100))]
    lines[place - 1] = separator.join(("1", '"2'))
    path = tmp_path / "record.csv"
    path.write_text("\n".join(lines) + "\n", "utf-8")
    with pytest.raises(InvalidInput, match=f"line {place} has a quotation mark without its partner.*take the mark away, or close it"):
        read_record(str(path), inputs=["u"], outputs=["y"])
    path.write_text(path.read_text("utf-8").replace('"2', '"2"'), "utf-8")
    assert len(read_record(str(path), inputs=["u"], outputs=["y"])) == 100


def test_a_quotation_mark_within_a_name_is_a_letter(tmp_path: Path) -> None:
    path = tmp_path / "record.csv"
    path.write_text('u,level (5")\n' + "".join(f"{k % 7},{k % 5}\n" for k in range(50)), "utf-8")
    assert read_record(str(path), inputs=["u"], outputs=['level (5")']).outputs == ('level (5")',)
