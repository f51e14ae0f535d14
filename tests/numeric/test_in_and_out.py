"""What engineers have their records in is read, with names and sample time, and what is written for other programs is read back equal.

Y, U, T     a small record of two outputs and one input, sampled every 50 ms
TEXTS       the same record in the dialects of text tables
"""

from __future__ import annotations

import datetime
import importlib
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.io import loadmat, savemat

from faultspace.base.errors import InvalidData, InvalidInput
from faultspace.numeric import StateSpaceModel, arx_reduction_experiments, identify, read_record, read_stretches, record_from
from faultspace.numeric.data.clocks import seconds_in, time_name

N, DT = 300, 0.05
PLANT = StateSpaceModel([[0.6, 0.5], [-0.5, 0.6]], [[1.0], [0.5]], [[1.0, 0.0], [0.3, 1.0]], [[0.0], [0.2]])
U = np.random.default_rng(1).standard_normal((N, 1))
Y = PLANT.simulate(U) + 0.1 * np.random.default_rng(2).standard_normal((N, 2))
T = DT * np.arange(N)
NAMES = ("valve", "level", "flow")
START = datetime.datetime(2024, 3, 1, 10)
ISO = [(START + datetime.timedelta(seconds=float(t))).isoformat(timespec="milliseconds") for t in T]


def table(separator: str, decimal: str, times: Callable[[int], str], *lines: str, names: tuple[str, ...] = ("t", *NAMES)) -> str:
    """Return the record as text; `lines` stand between the names and the values."""
    rows = [[times(k)] + [repr(float(x)).replace(".", decimal) for x in (*U[k], *Y[k])] for k in range(N)]
    return "\n".join([separator.join(names), *lines, *map(separator.join, rows)]) + "\n"


def seconds(decimal: str = ".", scale: float = 1.0) -> Callable[[int], str]:
    return lambda k: f"{scale * T[k]:.2f}".replace(".", decimal)


TEXTS: dict[str, bytes] = {
    "comma": table(",", ".", seconds()).encode(),
    "semicolon, decimal comma": table(";", ",", seconds(",")).encode(),
    "tab, decimal comma": table("\t", ",", seconds(",")).encode(),
    "byte order mark": table(",", ".", seconds()).encode("utf-8-sig"),
    "UTF-16": table(";", ",", seconds(",")).encode("utf-16"),
    "Windows": table(",", ".", seconds(), "s,°C,m,l/s").encode("cp1252"),
    "units": table(",", ".", seconds(scale=1000.0), "ms,V,m,l/s").encode(),
    "units in names": table(",", ".", seconds(scale=1000.0), names=("Time [ms]", *NAMES)).encode(),
    "dates": table(",", ".", ISO.__getitem__, names=("timestamp", *NAMES)).encode(),
    "dates with a blank, decimal comma": table(";", ",", lambda k: ISO[k].replace("T", " ")).encode(),
    "German dates": table(";", ",", lambda k: f"01.03.2024 {ISO[k][11:].replace('.', ',')}", names=("Zeit", *NAMES)).encode(),
    "line ends of Windows": table(",", ".", seconds()).replace("\n", "\r\n").encode(),
}


@pytest.mark.parametrize("name", TEXTS)
def test_text_tables_of_every_dialect_read_the_same(name: str, tmp_path: Path) -> None:
    path = tmp_path / "d.csv"
    path.write_bytes(TEXTS[name])
    got = read_record(path, inputs="valve", outputs="level,flow")
    assert np.array_equal(got.u, U) and np.array_equal(got.y, Y) and got.outputs == ("level", "flow")
    assert got.clock is not None and got.clock.regular and got.clock.dt == pytest.approx(DT, rel=1e-9)
    assert got.to_json()["dt"] == got.clock.dt and "0.05 s" in got.summary()


def test_days_and_times_of_the_day_in_columns_of_their_own(tmp_path: Path) -> None:
    path = tmp_path / "d.csv"
    lines = table(",", ".", lambda k: f"2024-03-01,{ISO[k][11:]}", names=("Date", "Time", *NAMES))
    path.write_text(lines)
    got = read_record(path, inputs="valve", outputs="level,flow")
    assert got.clock is not None and got.clock.name == "Time" and got.clock.dt == pytest.approx(DT)


def test_a_time_that_is_a_channel_or_no_time_is_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "d.csv"
    path.write_text(table(",", ".", seconds()))
    assert read_record(path, inputs="t", outputs="level").clock is None
    path.write_text(table(",", ".", lambda k: "morning" if k % 2 else "1"))
    assert read_record(path, inputs="valve", outputs="level").clock is None
    path.write_text("t,u,y\n,1,2\n,2,3\n")
    assert read_record(path, inputs="u", outputs="y").clock is None
    assert time_name(["temperature", "total", "t_out", "tilt", "time_constant"]) is None
    assert [time_name([name]) for name in ("Time (s)", "t_ms", "TIMESTAMP", "elapsed [min]")] == [
        "Time (s)",
        "t_ms",
        "TIMESTAMP",
        "elapsed [min]",
    ]
    assert [seconds_in(name)[0] for name in ("t", "t_ms", "time [min]", "Time (h)")] == [1.0, 1e-3, 60.0, 3600.0]


def test_missing_cells_are_refused_with_a_way_on(tmp_path: Path) -> None:
    path = tmp_path / "d.csv"
    lines = table(",", ".", seconds()).splitlines()
    for k in (100, 101, 250):
        lines[k + 1] = lines[k + 1].rpartition(",")[0] + ","
    path.write_text("\n".join(lines))
    with pytest.raises(InvalidInput, match=r"sample 100 .*read_stretches"):
        read_record(path, inputs="valve", outputs="level,flow")
    parts = read_stretches(path, inputs="valve", outputs="level,flow")
    assert [len(part) for part in parts] == [100, 148, 49]
    assert np.array_equal(np.vstack([part.y for part in parts]), np.delete(Y, [100, 101, 250], axis=0))
    model = arx_reduction_experiments(parts, order=2)
    assert np.array_equal(model.A, arx_reduction_experiments([(part.y, part.u) for part in parts], order=2).A)
    assert np.allclose(model.model.markov(4), PLANT.markov(4), atol=0.05)
    path.write_text("u,y\n1,\n,2\n")
    with pytest.raises(InvalidInput, match="no samples"):
        read_stretches(path, inputs="u", outputs="y")


def test_rows_missing_by_their_times_end_a_stretch(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("faultspace.numeric.data.text_tables.PIECE", 50)
    path = tmp_path / "d.csv"
    lines = table(",", ".", seconds()).splitlines()
    lines[120] = lines[120].rpartition(",")[0] + ","
    path.write_text("\n".join([*lines[:51], *lines[53:200], *lines[210:]]))
    whole = read_record(path, inputs="valve", outputs="level")
    assert whole.clock is not None and whole.clock.missing == 12 and whole.clock.gaps == (50, 197)
    parts = read_stretches(path, inputs="valve", outputs="level,flow")
    assert [len(part) for part in parts] == [50, 67, 79, 91]
    assert all(part.clock is not None and part.clock.regular and part.clock.dt == pytest.approx(DT) for part in parts)


def test_stretches_go_on_over_the_pieces_of_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("faultspace.numeric.data.text_tables.PIECE", 7)
    path = tmp_path / "d.csv"
    values = np.arange(60.0)
    values[[0, 6, 7, 30, 59]] = np.nan
    path.write_text("u,y\n" + "".join(f"{k},{value}\n" for k, value in enumerate(values)))
    assert [len(part) for part in read_stretches(path, inputs="u", outputs="y")] == [5, 22, 28]


def test_archives_and_matrices_have_times_too(tmp_path: Path) -> None:
    np.savez(tmp_path / "d.npz", u=U, y=Y, time=T)
    savemat(tmp_path / "d.mat", {"u": U, "y": Y, "t": T[:, None]})
    for path in (tmp_path / "d.npz", tmp_path / "d.mat"):
        got = read_record(path, inputs="u", outputs="y")
        assert np.array_equal(got.y, Y) and got.clock is not None and got.clock.dt == pytest.approx(DT)


def test_mat_files_of_version_73_are_read_the_same(tmp_path: Path) -> None:
    h5py: Any = pytest.importorskip("h5py")
    path = tmp_path / "d.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, values in {"u": U, "y": Y, "t": T[:, None], "wide": Y.T}.items():
            file[name] = values.T  # MATLAB has the axes the other way around
        file.create_group("structure")
    with open(path, "r+b") as stream:
        stream.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")
    got = read_record(path, inputs="u", outputs="y")
    assert np.array_equal(got.y, Y) and np.array_equal(got.u, U) and got.clock is not None and got.clock.dt == pytest.approx(DT)
    assert np.array_equal(read_record(path, inputs="u", outputs="wide[1,:]").y[:, 0], Y[:, 1])
    with pytest.raises(InvalidInput, match=r"no variable 'structure'.*one of: t, u, wide, y"):
        read_record(path, inputs="u", outputs="structure")


def test_without_h5py_it_is_said_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def without(name: str) -> Any:
        raise ImportError(name)

    monkeypatch.setattr("faultspace.numeric.data.hdf5.import_module", without)
    path = tmp_path / "d.mat"
    path.write_bytes(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM" + bytes(500))
    with pytest.raises(InvalidInput, match=r"version 7.3 .*faultspace\[mat73\].*'-v7'"):
        read_record(path, inputs="u", outputs="y")


def test_frames_keep_names_and_times() -> None:
    pandas: Any = pytest.importorskip("pandas")
    dates = pandas.DatetimeIndex(ISO)
    y, u = pandas.DataFrame(Y, columns=["level", "flow"], index=dates), pandas.DataFrame(U, columns=["valve"], index=dates)
    whole = pandas.concat([y, u], axis=1)
    column = whole.reset_index(drop=True).assign(time=T)
    spans = whole.set_index(pandas.TimedeltaIndex(dates - dates[0]))
    for got in (record_from(y, u), *(record_from(one, inputs="valve", outputs="level,flow") for one in (whole, column, spans))):
        assert np.array_equal(got.y, Y) and (got.inputs, got.outputs) == (("valve",), ("level", "flow"))
        assert got.clock is not None and got.clock.dt == pytest.approx(DT) and got.clock.regular
    assert record_from(Y, U).clock is None and record_from(pandas.DataFrame(Y), pandas.DataFrame(U)).clock is None
    with pytest.raises(InvalidData, match="unequal times"):
        record_from(y, u.set_index(dates + pandas.Timedelta(seconds=1)))


def test_parquet_has_dates(tmp_path: Path) -> None:
    pandas: Any = pytest.importorskip("pandas")
    pytest.importorskip("pyarrow")
    path = tmp_path / "d.parquet"
    pandas.DataFrame(np.hstack([U, Y]), columns=list(NAMES)).assign(when=pandas.DatetimeIndex(ISO)).rename(
        columns={"when": "time"}
    ).to_parquet(path)
    got = read_record(path, inputs="valve", outputs="level,flow")
    assert np.array_equal(got.y, Y) and got.clock is not None and got.clock.dt == pytest.approx(DT)


# Out


@pytest.fixture(scope="module")
def found() -> Any:
    fault = np.random.default_rng(3).standard_normal((N, 1)) * [1.0, -0.5]
    pandas: Any = pytest.importorskip("pandas")
    frame = pandas.DataFrame(np.hstack([U, Y + fault]), columns=list(NAMES), index=pandas.Index(T, name="time [s]"))
    return identify(frame[["level", "flow"]], frame[["valve"]], order=2, n_v=1)


def test_the_sample_time_of_the_data_goes_where_the_model_goes(found: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("faultspace.numeric.plant.report.result_files.pictures", lambda *_: [])  # they take long
    assert found.dt == pytest.approx(DT)
    assert found.to_scipy().dt == found.dt
    found.to_mat(tmp_path / "m.mat")
    assert loadmat(tmp_path / "m.mat")["dt"].item() == found.dt
    found.save(tmp_path / "out")
    written = json.loads((tmp_path / "out" / "model.json").read_text("utf-8"))
    assert written["dt"] == found.dt and (written["inputs"], written["outputs"]) == (["valve"], ["level", "flow"])
    assert np.array_equal(StateSpaceModel.from_json(written).A, found.model.A)


def test_a_frame_has_channels_residual_and_fault_by_time(found: Any, tmp_path: Path) -> None:
    pandas: Any = importlib.import_module("pandas")
    frame = found.to_pandas()
    assert frame.index.name == "time [s]" and np.allclose(frame.index, T) and len(frame) == N
    assert np.array_equal(frame["output"].to_numpy(), found.record.y) and list(frame["input"].columns) == ["valve"]
    assert np.array_equal(frame["residual"][["level", "flow"]].to_numpy(), found.residual.r)
    if found.signal is not None:
        first, last = found.signal.trusted
        v = frame["fault"].to_numpy()
        assert np.array_equal(v[first:last], found.signal.v[first:last]) and np.isnan(v[:first]).all() and np.isnan(v[last:]).all()
    # The frame is read back as a record with the same clock.
    again = record_from(frame["output"], frame["input"])
    assert np.array_equal(again.y, found.record.y) and again.clock is not None and again.clock.dt == pytest.approx(found.dt)
    text = pandas.read_csv(io.StringIO(frame["residual"].to_csv()), index_col=0)
    assert np.array_equal(text.to_numpy(), found.residual.r)
    unknown = identify(Y, U, order=2, operating_point="means").to_pandas()
    assert unknown.index.name == "sample" and np.array_equal(unknown["output"].to_numpy(), Y)


def test_control_gets_labels_and_the_sample_time_of_the_data(found: Any) -> None:
    pytest.importorskip("control")
    system = found.to_control()
    assert (system.input_labels, system.output_labels, system.dt) == (["valve"], ["level", "flow"], found.dt)
    assert all(np.array_equal(getattr(system, name), getattr(found.model, name)) for name in "ABCD")


def test_without_pandas_it_is_said_what_to_install(found: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def without(name: str) -> Any:
        raise ImportError(name)

    monkeypatch.setattr("faultspace.numeric.plant.report.other_programs.import_module", without)
    with pytest.raises(ImportError, match="pip install pandas"):
        found.to_pandas()
