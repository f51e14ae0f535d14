"""Records longer than memory: the same answers as from arrays, memory that does not grow with them, and progress that is told.

long_record     the packaged system's record as y, u and a Record
peak            the most memory (MiB) of a process that identifies a file, with little held
"""

from __future__ import annotations

import importlib
import importlib.util
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace import example_data as made
from faultspace.base.errors import InvalidData
from faultspace.numeric.data import records
from faultspace.numeric.data.records import Passes, Record, RecordWriter, SampleStore, recorded, stored
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.model.past_inputs import pi_moesp
from faultspace.numeric.method.model.residuals import residual
from faultspace.numeric.method.signal import reconstruction
from faultspace.numeric.method.signal import residual_sizes as sizes_of_residuals
from faultspace.numeric.method.signal.reconstruction import reconstruct_fault
from faultspace.numeric.method.signal.residual_sizes import PART, loudest, residual_sizes
from faultspace.numeric.method.signal.smoother import smoothed
from faultspace.numeric.plant import pipeline as identifying
from faultspace.numeric.plant.steps import explaining
from tests.end_to_end.commands import ROOT, environment
from tests.end_to_end.identify_runs import CHANNELS
from tests.thorough import THOROUGH

Array = NDArray[np.float64]

N = 40_000


@pytest.fixture
def long_record(monkeypatch: pytest.MonkeyPatch) -> tuple[Array, Array, Record]:
    monkeypatch.setattr(records, "IN_MEMORY", 1000)
    made_record = made.faulty_record(N)
    record = recorded(made_record.y, made_record.u, outputs=made.OUTPUTS, inputs=made.INPUTS)
    assert record.store._file._rolled  # type: ignore[attr-defined]
    return made_record.y, made_record.u, record


def test_a_store_gives_back_what_it_took(monkeypatch: pytest.MonkeyPatch) -> None:
    rows = np.random.default_rng(1).standard_normal((1000, 3))
    for limit in (1 << 20, 5000):
        monkeypatch.setattr(records, "IN_MEMORY", limit)
        store = SampleStore(3)
        for part in np.array_split(np.asfortranarray(rows), 7):
            store.append(part)
            assert np.array_equal(store.read(0, len(store)), rows[: len(store)])
            assert np.array_equal(store.read(1, 2), rows[1:2])  # reading does not disturb what is written next
        assert np.array_equal(np.vstack(list(store.pieces(10, 900))), rows[10:900])
        assert len(store.read(999, 2000)) == 1 and not store.read(0, 5).flags.writeable


def test_what_is_known_of_channels_is_that_of_the_arrays(long_record: tuple[Array, Array, Record]) -> None:
    y, u, record = long_record
    writer = RecordWriter(5)
    for part in np.array_split(np.hstack([u, y + 1e6]) + np.arange(N)[:, np.newaxis] / N, 7):
        writer.append(part)
    y = y + np.arange(N)[:, np.newaxis] / N
    lifted = writer.record(outputs=made.OUTPUTS, inputs=made.INPUTS, format="arrays")
    assert np.allclose(lifted.channels.mean[2:], (y + 1e6).mean(axis=0), rtol=1e-12)
    assert np.allclose(lifted.channels.deviation[2:], y.std(axis=0), rtol=1e-6)
    y = long_record[0]
    assert np.array_equal(record.channels.least, np.hstack([u, y]).min(axis=0))
    about = record.about_means()
    assert np.allclose(about.y, y - y.mean(axis=0), atol=1e-12) and np.array_equal(record.y, y)


def test_model_and_residual_are_those_of_the_arrays(long_record: tuple[Array, Array, Record]) -> None:
    y, u, record = long_record
    whole = pi_moesp(y, u, block_rows=15)
    messages: list[str] = []
    data = Passes(record, "model", lambda stage, done, total: messages.append(f"{stage} {done}/{total}"))
    found = pi_moesp(data, block_rows=15)
    assert found.order == whole.order == 3
    assert all(np.array_equal(getattr(found, name), getattr(whole, name)) for name in ("A", "B", "C", "D", "x0", "singular_values"))
    assert f"model, pass 1 {N}/{N}" in messages and f"model, pass 2 {N}/{N}" in messages
    rest, wanted = residual(record, None, found.model, x0=found.x0), residual(y, u, whole.model)
    assert np.array_equal(residual(y, u, found.model, x0=found.x0).r, rest.r)
    assert np.array_equal(residual(record, None, found.model).r, wanted.r)
    sizes = residual_sizes(rest.store, N)
    r = rest.store.read(0, N)
    assert np.allclose(r[0], y[0] - found.C @ rest.x0 - found.D @ u[0])
    assert np.allclose(r[100:], wanted.r[100:], atol=1e-9)  # before, the initial states differ by the weights of the outputs
    assert np.all(np.abs(rest.x0 - wanted.x0) < 5 * np.sqrt(np.diag(wanted.x0_covariance)))
    assert np.allclose(sizes.norm, np.linalg.norm(r, axis=0)) and np.allclose(sizes.peak, np.abs(r).max(axis=0))
    assert np.allclose(rest.covariance, wanted.covariance, rtol=1e-3)
    with pytest.raises(InvalidData, match="only once"):
        pi_moesp(iter(record), block_rows=15)


@pytest.mark.parametrize("G", [[[0.4], [0.0], [1.0]], [[1.0], [0.0], [0.0]], [[0.0], [0.0], [0.0]]], ids=["generic", "one", "delayed"])
@pytest.mark.parametrize("p", [1, 3])
def test_a_fault_signal_in_pieces_is_that_of_the_whole(G: list[list[float]], p: int, monkeypatch: pytest.MonkeyPatch) -> None:
    # With one output the fault has finite zeros, inside and outside the unit circle: their traces fade from both ends.
    G_p, C, samples = np.array(G)[:p], made.C[:p], 9_000
    draw = np.random.default_rng(2)
    v = draw.standard_normal((samples, 1))
    r = StateSpaceModel(made.A, made.F, C, G_p).simulate(v) + 1e-3 * draw.standard_normal((samples, p))
    whole = smoothed(r, made.A, made.F, C, G_p)
    monkeypatch.setattr(reconstruction, "LONGEST", 6000)
    got = reconstruct_fault(stored(r), made.A, made.F, C, G_p)
    of_array = reconstruct_fault(r, made.A, made.F, C, G_p)
    assert np.array_equal(of_array.v, got.v) and of_array.misfit == got.misfit and of_array.mismatch == got.mismatch > 0
    first, last = whole.trusted
    assert got.trusted == whole.trusted and len(got.store) == samples and last - first > samples - 1000
    difference = np.linalg.norm(got.store.read(first, last) - whole.v[first:last]) / np.linalg.norm(whole.v[first:last])
    assert difference < 1e-4 and got.mismatch < 1e-4  # the refinement of the regularised solution stops at different points
    assert abs(got.misfit - whole.misfit) < 1e-6


def test_a_stretch_without_any_residual_is_a_stretch_without_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    v = np.zeros((30_000, 1))
    v[20_000:24_000] = np.random.default_rng(5).standard_normal((4000, 1))
    G = [[0.4], [0.0], [1.0]]
    r = StateSpaceModel(made.A, made.F, made.C, G).simulate(v)
    assert not np.any(r[:20_000])
    monkeypatch.setattr(reconstruction, "LONGEST", 6000)
    for given in (r, stored(r)):
        assert np.allclose(reconstruct_fault(given, made.A, made.F, made.C, G).v, v, atol=1e-9)
        with pytest.raises(InvalidData, match="zero throughout"):
            reconstruct_fault(stored(0 * r) if given is not r else 0 * r, made.A, made.F, made.C, G)


def test_a_known_state_is_used_on_a_long_record(monkeypatch: pytest.MonkeyPatch) -> None:
    G, x0 = np.array([[0.4], [0.0], [1.0]]), np.array([5.0, -3.0, 2.0])
    v = np.random.default_rng(6).standard_normal((9000, 1))
    r = StateSpaceModel(made.A, made.F, made.C, G).simulate(v, x0)
    monkeypatch.setattr(reconstruction, "LONGEST", 6000)
    found = reconstruct_fault(r, made.A, made.F, made.C, G, x0=x0)
    assert np.allclose(found.v, v, atol=1e-8) and np.allclose(found.x[0], x0) and np.allclose(found.simulated, r, atol=1e-8)


def test_faults_of_a_part_of_the_record_are_looked_for_there() -> None:
    energies = np.ones(40)
    energies[30:33] = 5.0
    assert loudest(energies, 40 * PART - 7, 3 * PART) == (30 * PART, 33 * PART)
    assert loudest(energies, 40 * PART - 7, 50 * PART) == (0, 40 * PART - 7)
    energies[39] = 100.0
    assert loudest(energies, 40 * PART - 7, 2 * PART + 5)[1] == 40 * PART - 7


def test_a_late_fault_is_counted_and_the_stretch_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    samples, begins, lasts, part = 1200, 900, 180, 32
    draw = np.random.default_rng(4)
    u, v = draw.standard_normal((samples, 2)), np.zeros((samples, 1))
    v[begins : begins + lasts] = draw.standard_normal((lasts, 1))
    driven = StateSpaceModel(made.A, np.hstack([made.B, made.F]), made.C, np.hstack([made.D, made.G]))
    y = driven.simulate(np.hstack([u, v])) + 0.02 * draw.standard_normal((samples, 3))
    monkeypatch.setattr(explaining, "HELD", 5 * lasts)
    monkeypatch.setattr(sizes_of_residuals, "PART", part)
    answer = identifying.identify(recorded(y, u, outputs=made.OUTPUTS, inputs=made.INPUTS), order=3)
    first, last = answer.held
    assert last - first == lasts and abs(first - begins) <= part
    assert answer.n_v == 1 and any(f"on samples {first} to {last - 1}" in note for note in answer.notes)
    assert answer.signal is not None
    got = answer.signal.store.read(begins, begins + lasts)[:, 0]
    assert abs(np.corrcoef(got, v[begins : begins + lasts, 0])[0, 1]) > 0.98


# Memory

# The pictures are drawn, but not rendered, which takes longer than all that is computed.
SCRIPT = """
import contextlib, sys
from pathlib import Path
from faultspace.cli import command_line
from faultspace.numeric.plant.steps import explaining
from faultspace.numeric.data import records
from faultspace.numeric.plant.monitor import monitoring
from faultspace.numeric.method.signal import reconstruction
explaining.HELD, records.IN_MEMORY, reconstruction.LONGEST, monitoring.NUMBERS = 1 << 15, 1 << 20, 1 << 13, 1 << 20
with contextlib.suppress(ImportError):
    from matplotlib.figure import Figure
    Figure.savefig = lambda figure, file, **options: file.write(b"not rendered")
code = command_line.main(sys.argv[1:])
with open("/proc/self/status") as status:
    print(code, *[line.split()[1] for line in status if line.startswith("VmHWM")], file=sys.stderr)
"""


def peak(path: Path, channels: tuple[str, ...]) -> float:
    line = [sys.executable, "-c", SCRIPT, "identify", str(path), *channels, "--order", "3", "--out", f"{path}.answer"]
    run = subprocess.run(line, capture_output=True, cwd=ROOT, env=environment(), timeout=1200, text=True)
    code, most = run.stderr.split()[-2:]
    assert code == "0", run.stderr
    return int(most) / 1024


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="no /proc to read the peak of memory from")
@pytest.mark.parametrize(
    "format",
    [
        pytest.param("csv", marks=pytest.mark.slow),
        pytest.param("parquet", marks=pytest.mark.slow),
        pytest.param("npy", marks=pytest.mark.programs),
    ],
)
def test_memory_does_not_grow_with_the_record(format: str, tmp_path: Path) -> None:
    if format == "parquet" and importlib.util.find_spec("pyarrow") is None:
        pytest.skip("pyarrow is not installed")
    peaks, sizes = [], (40_000, 800_000 if THOROUGH else 400_000)
    for samples in sizes:
        path = tmp_path / f"d{samples}.{format}"
        record = made.faulty_record(samples)
        channels = CHANNELS
        if format == "csv":
            path.write_text(made.csv_text(record), encoding="utf-8")
        elif format == "npy":
            np.save(path, np.hstack([record.u, record.y]))
            channels = ("--inputs", "data[:,:2]", "--outputs", "data[:,2:]")
        else:
            pyarrow: Any = importlib.import_module("pyarrow")
            columns = dict(zip([*made.INPUTS, *made.OUTPUTS], np.hstack([record.u, record.y]).T, strict=True))
            importlib.import_module("pyarrow.parquet").write_table(pyarrow.table(columns), path, row_group_size=20_000)
        peaks.append(peak(path, channels))
    numbers = 8 * 5 * (sizes[1] - sizes[0]) / 2**20  # MiB of the record alone, the residual and the signal not counted
    print(f"{format}: {peaks[0]:.0f} MiB at {sizes[0]} samples, {peaks[1]:.0f} at {sizes[1]}; {numbers:.0f} MiB more numbers")
    # What the C library keeps differs by 10 MiB from run to run. Were the record held in memory, so would be the residual: 22 MiB together.
    assert peaks[1] - peaks[0] < numbers, peaks
