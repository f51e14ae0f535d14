"""A folder of Parquet files is the record that they are parts of: the same bytes come out, whoever does the work, and no part is lost."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from faultspace import example_data as made
from faultspace.base.errors import InvalidInput
from faultspace.base.tasks import in_order, shared
from faultspace.numeric.data import files
from faultspace.numeric.data.files import read_record, read_stretches
from faultspace.numeric.data.parts import parts_of
from faultspace.numeric.data.records import recorded
from faultspace.numeric.method.model import arx_windows as windows
from tests.clusters import Cluster
from tests.end_to_end.commands import Run, call
from tests.end_to_end.test_bad_input import refused

arrow = pytest.importorskip("pyarrow", reason="Parquet is read by pyarrow, which is not installed")
parquet = pytest.importorskip("pyarrow.parquet")

CHANNELS = ("--inputs", "valve,pump", "--outputs", "level1,level2,flow")
CHOSEN: dict[str, Any] = {"inputs": made.INPUTS, "outputs": made.OUTPUTS}
N = 1200


def table(samples: int = N, **others: Any) -> Any:
    """Return the packaged record of so many samples with its times, as a table of Arrow."""
    record = made.faulty_record(samples)
    columns = {"time": np.arange(samples) * 0.5}
    columns |= {name: record.u[:, j] for j, name in enumerate(made.INPUTS)} | {name: record.y[:, j] for j, name in enumerate(made.OUTPUTS)}
    return arrow.table(columns | others)


def write_parts(whole: Any, bounds: Sequence[int], folder: Path, name: str = "part-{}.parquet") -> Path:
    """Write the rows between neighbouring bounds as the parts of a folder."""
    folder.mkdir(parents=True)
    for number, (first, last) in enumerate(pairwise(bounds)):
        parquet.write_table(whole.slice(first, last - first), folder / name.format(number))
    return folder


def write_one(whole: Any, path: Path, rows: int) -> Path:
    """Write one file with so many rows in a group."""
    path.parent.mkdir(parents=True, exist_ok=True)
    parquet.write_table(whole, path, row_group_size=rows)
    return path


def identified(place: Path, *more: str) -> dict[str, bytes]:
    """Return what `identify` says and writes of record.parquet in this folder, by name."""
    run = call("identify", "record.parquet", *CHANNELS, "--out", "answer", "--order", "3", "--faults", "1", *more)
    assert run.code == 0, run.err
    return {path.name: path.read_bytes() for path in (place / "answer").iterdir()} | {"said": run.out.encode()}


AWKWARD = [0, 1, 1, 3, 10, 40, 40, 400, 401, N - 1, N, N]  # parts of one sample, of none, and shorter than the lags


def test_the_record_is_that_of_the_one_file_to_the_last_bit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An answer is made of the record alone."""
    monkeypatch.setattr(files, "PIECE", 100)
    whole = table()
    one = read_record(write_one(whole, tmp_path / "one.parquet", 77), **CHOSEN)
    parts = read_record(write_parts(whole, AWKWARD, tmp_path / "parts"), **CHOSEN)
    assert parts.store.read(0, N + 1).tobytes() == one.store.read(0, N + 1).tobytes() and len(one) == N
    assert {name: value.tobytes() for name, value in vars(parts.channels).items()} == {
        name: value.tobytes() for name, value in vars(one.channels).items()
    }
    for name in ("inputs", "outputs", "format", "single", "clock", "lengths"):
        assert getattr(parts, name) == getattr(one, name), name


@pytest.mark.slow
def test_the_bytes_of_the_answer_are_those_of_the_one_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Sections, too, are much shorter than the record."""
    monkeypatch.setattr(windows, "SECTION", 300)
    monkeypatch.setattr(files, "PIECE", 100)
    whole, answers = table(), {}
    write_one(whole, tmp_path / "one" / "record.parquet", 77)
    write_parts(whole, AWKWARD, tmp_path / "parts" / "record.parquet")
    for name in ("one", "parts"):
        monkeypatch.chdir(tmp_path / name)
        answers[name] = identified(tmp_path / name)
    assert answers["one"] == answers["parts"] and len(answers["one"]) > 5
    assert b"0.5 s" in answers["one"]["said"]


def test_parts_are_read_in_the_order_of_their_numbers(tmp_path: Path) -> None:
    whole = table(120)
    folder = write_parts(whole, list(range(0, 121, 10)), tmp_path / "record", "day{}of12.parquet")
    parquet.write_table(whole.slice(30, 10).select(whole.column_names[::-1]), folder / "day3of12.parquet")  # columns have names
    (folder / "_SUCCESS").touch()
    (folder / ".part-3.crc").touch()
    assert [path.name for path in parts_of(folder)] == [f"day{k}of12.parquet" for k in range(12)]
    record = read_record(folder, **CHOSEN)
    assert len(record) == 120 and np.array_equal(record.y[:, 2], whole["flow"].to_numpy())
    assert record.clock is not None and record.clock.regular and record.clock.dt == 0.5


def test_a_gap_in_the_times_is_one_wherever_the_parts_end(tmp_path: Path) -> None:
    whole = table(100)
    kept = arrow.concat_tables([whole.slice(0, 40), whole.slice(55)])
    for number, bounds in enumerate(([0, 40, 85], [0, 20, 85], [0, 60, 85])):
        folder = write_parts(kept, bounds, tmp_path / str(number))
        assert [len(part) for part in read_stretches(folder, **CHOSEN)] == [40, 45]
        clock = read_record(folder, **CHOSEN).clock
        assert clock is not None and clock.missing == 15


@pytest.mark.parametrize(
    ("names", "words"),
    [
        (["p0", "p1", "p3"], "part 2 is missing between 'p1.parquet' and 'p3.parquet'"),
        (["p1", "p5"], "parts 2 to 4 are missing"),
        (["p7", "p8", "p10"], "part 9 is missing"),
        (["p1", "p01"], "expected every number once"),
        (["p-0-of-9", "p-2-of-9"], "part 1 is missing"),
    ],
)
def test_a_part_that_is_lost_is_told(names: Sequence[str], words: str, tmp_path: Path) -> None:
    for name in names:
        (tmp_path / f"{name}.parquet").touch()
    with pytest.raises(InvalidInput, match=words):
        parts_of(tmp_path)


@pytest.mark.parametrize("names", [["p0"], ["p4"], ["a", "b"], ["1700000000", "1700003600", "1700010800"], ["p3", "p4"], ["a1", "b7"]])
def test_names_that_do_not_count_are_no_loss(names: Sequence[str], tmp_path: Path) -> None:
    for name in names:
        (tmp_path / f"{name}.parquet").touch()
    assert [path.stem for path in parts_of(tmp_path)] == names


def test_parts_with_unequal_columns_are_refused(tmp_path: Path) -> None:
    whole = table(60)
    others = {
        "lacks the column 'time'": whole.drop_columns(["time"]),
        "has the column 'more' as well": whole.append_column("more", whole["time"]),
        "column 'flow' holds values of type float and not double": whole.set_column(5, "flow", whole["flow"].cast(arrow.float32())),
        "column 'flow' holds values of type string and not double": whole.set_column(5, "flow", whole["flow"].cast(arrow.string())),
        "lacks the column 'flow'": whole.drop_columns(["flow"]),
    }
    for number, (words, other) in enumerate(others.items()):
        folder = write_parts(whole, [0, 60], tmp_path / str(number))
        parquet.write_table(other, folder / "part-1.parquet")
        run = call("identify", str(folder), *CHANNELS, "--out", str(tmp_path / "answer"))
        refused(run, words, "part-1.parquet")
    assert not (tmp_path / "answer").exists()


def test_folders_and_parts_that_are_none(tmp_path: Path) -> None:
    def said(folder: Path, *more: str) -> Run:
        return call("identify", str(folder), *CHANNELS, "--out", str(tmp_path / "answer"), *more)

    whole = table(60)
    (tmp_path / "empty").mkdir()
    refused(said(tmp_path / "empty"), "a directory without files", "folder of Parquet files")
    folder = write_parts(whole, [0, 30, 60], tmp_path / "record")
    refused(call("identify", str(folder), *CHANNELS, "--out", str(folder)), "is a folder of measurements")
    refused(call("identify", str(folder)), "choose, as in")
    content = (folder / "part-1.parquet").read_bytes()
    for harm in (b"", content[:-9], content[: len(content) // 2] + b"\xff" * 40 + content[len(content) // 2 + 40 :], bytes(100)):
        (folder / "part-1.parquet").write_bytes(harm)
        refused(said(folder), "part-1.parquet", "Parquet")
    (folder / "part-1.parquet").unlink()
    os.mkfifo(folder / "part-1.parquet")
    refused(said(folder), "part-1.parquet", "a pipe or a device")
    (folder / "part-1.parquet").unlink()
    (folder / "part-1.parquet").mkdir()
    refused(said(folder), "a directory with 'part-1.parquet' in it")
    zarr = tmp_path / "u.zarr"
    zarr.mkdir()
    (zarr / "0.0").touch()
    refused(said(zarr), "a directory with '0.0' in it")
    nothing = write_parts(whole, [0, 0, 0], tmp_path / "nothing")
    refused(said(nothing), "got no samples")
    wrong = whole.set_column(5, "flow", arrow.array([*range(40), float("nan"), *range(19)], type=arrow.float64()))
    refused(said(write_parts(wrong, [0, 30, 60], tmp_path / "wrong")), "flow", "sample 40")


def test_windows_in_sections_are_those_of_the_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    """The twin: one section. Lengths about the ends of sections, a channel that is constant, one that stands far from zero."""
    record = made.faulty_record(1000)
    y = record.y + np.array([0.0, 1e3, 0.0])
    u = np.column_stack([record.u, np.full(1000, 3.7)])
    for samples in (1, 5, 6, 105, 106, 205, 206, 207, 1000):
        pieces = list(recorded(y[:samples], u[:samples], outputs="abc", inputs="def"))
        monkeypatch.setattr(windows, "SECTION", 10**6)
        whole = windows.arx_windows(pieces, 5)
        monkeypatch.setattr(windows, "SECTION", 100)
        parts = windows.arx_windows(pieces, 5)
        assert (parts.windows, parts.samples, parts.constants) == (whole.windows, whole.samples, whole.constants)
        assert np.allclose(parts.means[0], whole.means[0], rtol=1e-13)
        sizes = np.linalg.norm(whole.factor, axis=0)
        assert np.array_equal(sizes == 0, np.linalg.norm(parts.factor, axis=0) == 0)
        gram, wanted = parts.factor.T @ parts.factor, whole.factor.T @ whole.factor
        assert np.all(np.abs(gram - wanted) <= 1e-9 * (np.outer(sizes, sizes) + 1e-300))


def squared(number: int, owner: int) -> int:
    """Three kills its process always, unless it is the owner."""
    if number == 3 and os.getpid() != owner:
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(0.01)
    return number * number


def fails(number: int) -> int:
    raise OSError(f"the {number}th")


def test_in_order_here() -> None:
    assert list(in_order(squared, ((k, os.getpid()) for k in range(5)))) == [0, 1, 4, 9, 16]
    assert list(in_order(squared, [])) == []
    with shared(None) as cluster:
        assert cluster is None and list(in_order(squared, [(7, 0)])) == [49]


@pytest.mark.slow
def test_workers_that_are_killed_and_a_scheduler_that_is_lost_lose_nothing() -> None:
    with Cluster() as cluster, shared(cluster.address) as there:
        assert there is not None
        asked = list(range(60))

        def numbered() -> Iterator[tuple[int, int]]:
            for k in asked:
                if k == 40:
                    cluster.processes[0].kill()
                yield k, os.getpid()

        with pytest.raises(OSError, match="the 7th"):
            list(in_order(fails, [(7,)]))
        assert not there.lost
        assert list(in_order(squared, numbered())) == [k * k for k in asked]
        assert "was lost" in there.lost


@pytest.mark.slow
def test_a_cluster_gives_the_same_bytes_with_little_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whole, with a worker killed, and with the scheduler killed; a section is all that a worker holds."""
    monkeypatch.setattr(windows, "SECTION", 1 << 15)
    samples = 3 * windows.SECTION + 5
    write_parts(table(samples), [0, 1, 1, 60_000, samples], tmp_path / "record.parquet")
    monkeypatch.chdir(tmp_path)
    alone = identified(tmp_path)
    distributed: Any = pytest.importorskip("distributed")
    with Cluster() as cluster:
        with distributed.Client(cluster.address) as client:
            client.wait_for_workers(2)
            before = client.run(peak)
        assert identified(tmp_path, "--scheduler", cluster.address) == alone
        with distributed.Client(cluster.address) as client:
            after = client.run(peak)
        assert all(after[worker] - before[worker] < 1 << 26 for worker in before), (before, after)
        cluster.processes[1].kill()
        assert identified(tmp_path, "--scheduler", cluster.address) == alone
        cluster.processes[0].kill()
        refused(call("identify", "record.parquet", *CHANNELS, "--out", "elsewhere", "--scheduler", cluster.address), "scheduler")
        assert not (tmp_path / "elsewhere").exists()


def peak() -> int:
    """Return the most bytes that this process has held, once it has loaded what the work needs."""
    import resource

    import faultspace.numeric.method.model.arx_windows  # noqa: F401

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss << 10
