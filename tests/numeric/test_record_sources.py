"""However a record comes, as arrays, frames, a file, pieces or a Record, `identify` gives the same answer to the last bit."""

from __future__ import annotations

import importlib
import importlib.util
import json
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from faultspace import example_data as made
from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidData, InvalidInput
from faultspace.numeric import StateSpaceModel, arx_reduction, count_faults, fault_space_by_rows, identify, pi_moesp, read_record, residual
from faultspace.numeric.data import files
from faultspace.numeric.data.records import Record
from faultspace.numeric.data.validation import PIECE
from faultspace.numeric.method.model import arx_windows
from faultspace.numeric.plant import pipeline
from faultspace.numeric.plant.report.folders import MANIFEST

N = 2500


@pytest.fixture(scope="module")
def data() -> tuple[Array, Array]:
    record = made.faulty_record(N)
    return record.y, record.u


def by_file(y: Array, u: Array, folder: Path) -> Any:
    np.savez(folder / "data.npz", y=y, u=u)
    return identify(folder / "data.npz", inputs=["u"], outputs=["y"], order=3)


def by_read_record(y: Array, u: Array, folder: Path) -> Any:
    np.savez(folder / "data.npz", y=y, u=u)
    return identify(read_record(str(folder / "data.npz"), inputs=["u"], outputs=["y"]), order=3)


def by_chunks(y: Array, u: Array, folder: Path) -> Any:
    edges = [0, 1, 700, 701, N]

    def pieces() -> Iterator[tuple[Array, Array]]:
        for first, last in pairwise(edges):
            yield y[first:last], u[first:last]

    return identify(pieces(), order=3)


def by_frames(y: Array, u: Array, folder: Path) -> Any:
    pandas = pytest.importorskip("pandas")
    return identify(pandas.DataFrame(y, columns=list(made.OUTPUTS)), pandas.DataFrame(u, columns=list(made.INPUTS)), order=3)


def by_one_frame(y: Array, u: Array, folder: Path) -> Any:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(np.hstack([y, u]), columns=[*made.OUTPUTS, *made.INPUTS])
    return identify(frame, inputs=made.INPUTS, outputs=made.OUTPUTS, order=3)


def by_lists(y: Array, u: Array, folder: Path) -> Any:
    return identify(y.tolist(), np.asfortranarray(u), order=3)


Way = Callable[[Array, Array, Path], Any]
# The slow ones are known by the record that they make, below.
WAYS = [by_file, by_chunks, by_frames, *(pytest.param(way, marks=pytest.mark.slow) for way in (by_read_record, by_one_frame, by_lists))]


@pytest.fixture(scope="module")
def wanted(data: tuple[Array, Array]) -> Any:
    return identify(*data, order=3)


@pytest.fixture(scope="module")
def found_by(data: tuple[Array, Array], tmp_path_factory: pytest.TempPathFactory) -> Callable[[Way], Any]:
    """What each way finds, once for all tests."""
    return cache(lambda way: way(*data, tmp_path_factory.mktemp("record")))


@pytest.mark.parametrize("way", WAYS)
def test_every_way_gives_the_same_bytes(way: Way, found_by: Callable[[Way], Any], wanted: Any) -> None:
    found = found_by(way)
    for name in ("A", "B", "C", "D", "x0", "innovation_covariance"):
        assert getattr(found.model, name).tobytes() == getattr(wanted.model, name).tobytes()
    assert found.model.uncertainty.root.tobytes() == wanted.model.uncertainty.root.tobytes()
    assert found.residual.covariance.tobytes() == wanted.residual.covariance.tobytes()
    assert found.singular_values.tobytes() == wanted.singular_values.tobytes() and found.reason == wanted.reason
    assert (found.n_v, found.fault_space.n_z) == (wanted.n_v, wanted.fault_space.n_z) == (1, 1)
    assert found.fault_space.basis.tobytes() == wanted.fault_space.basis.tobytes()
    assert found.residual.r.tobytes() == wanted.residual.r.tobytes() and found.signal.v.tobytes() == wanted.signal.v.tobytes()


@pytest.mark.parametrize("way", [by_file, by_read_record, by_chunks, by_frames, by_one_frame, by_lists])
def test_every_way_makes_the_same_record(
    way: Way, data: tuple[Array, Array], wanted: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made_of: list[Record] = []

    def findings(record: Record, *arguments: Any) -> Any:
        made_of.append(record)
        raise InvalidData("seen")

    monkeypatch.setattr(pipeline, "_in_range", findings)
    with pytest.raises(InvalidData, match="seen"):
        way(*data, tmp_path)
    (record,) = made_of
    assert record.y.tobytes() == wanted.record.y.tobytes() and record.u.tobytes() == wanted.record.u.tobytes()
    assert record.bounds == wanted.record.bounds and np.array_equal(record.channels.greatest, wanted.record.channels.greatest)


def test_frames_and_arguments_name_the_channels(found_by: Callable[[Way], Any]) -> None:
    assert found_by(by_frames).record.names == (*made.INPUTS, *made.OUTPUTS)
    found = found_by(by_chunks)
    assert found.record.names == ("u1", "u2", "y1", "y2", "y3") and f"{N} samples, inputs u1, u2" in found.summary()


def test_identify_calls_the_functions_that_are_public(data: tuple[Array, Array], wanted: Any) -> None:
    y, u = data
    found = arx_reduction(y, u, order=3, lags=wanted.block_rows)
    assert found.A.tobytes() == wanted.model.A.tobytes() and found.B.tobytes() == wanted.model.B.tobytes()
    assert residual(y, u, found.model, x0=found.x0).r.tobytes() == wanted.residual.r.tobytes()
    about = y - y.mean(axis=0), u - u.mean(axis=0)
    count = count_faults(*about, order=3, model=found)
    assert (count.n_v, count.reason) == (wanted.n_v, wanted.reason) and count.noise_power is not None
    space = fault_space_by_rows(*about, found.A, found.C, n_v=1, noise_level=np.sqrt(count.noise_power))
    assert space.basis.tobytes() == wanted.fault_space.basis.tobytes()


def test_a_record_without_noise_has_the_model_of_the_paper(data: tuple[Array, Array]) -> None:
    u = data[1]
    y = StateSpaceModel(made.A, made.B, made.C, made.D).simulate(u)
    found = identify(y, u, order=3)
    assert (
        found.exact
        and found.model is not None
        and found.model.A.tobytes() == pi_moesp(y, u, order=3, block_rows=found.block_rows).A.tobytes()
    )


@pytest.mark.parametrize("changed", ["y", "u"])
def test_one_changed_bit_is_seen(changed: str, data: tuple[Array, Array], wanted: Any) -> None:
    y, u = (values.copy() for values in data)
    (y if changed == "y" else u)[1000, 0] *= 1 + 1e-12
    assert arx_reduction(y, u, order=3, lags=wanted.block_rows).A.tobytes() != wanted.model.A.tobytes()


REFUSED: list[tuple[Callable[[Array, Array], Any], str]] = [
    (lambda y, u: identify(y), "u is missing"),
    (lambda y, u: identify(y.tolist()), "a pair"),
    (lambda y, u: identify(iter([])), "is empty"),
    (lambda y, u: identify(iter([(y, u), (y[:, :2], u)])), "all need the same"),
    (lambda y, u: identify(iter([(y, u), (y * np.nan, u)])), f"NaN at sample {N}"),
    (lambda y, u: identify(y, u[:-1]), "equal numbers"),
    (lambda y, u: identify(y, u, outputs=["a", "b"]), "2 names for 3"),
    (lambda y, u: identify("data.csv"), "names of both"),
    (lambda y, u: identify("data.csv", u), "leave u out"),
    (lambda y, u: identify(y, u, n_v=4), "n_v: got 4 for 3 outputs"),
    (lambda y, u: identify(y, u, healthy=N), "healthy: got"),
    (lambda y, u: pi_moesp(y, block_rows=5), "u is missing"),
    (lambda y, u: pi_moesp(iter([(y, u)]), block_rows=5), "only once"),
]


@pytest.mark.parametrize(("call", "says"), REFUSED)
def test_what_holds_no_record_is_refused(call: Callable[[Array, Array], Any], says: str, data: tuple[Array, Array]) -> None:
    with pytest.raises(InvalidData, match=says):
        call(*data)


def test_the_record_shows_itself(wanted: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if importlib.util.find_spec("matplotlib") is not None:  # what is rendered is looked at in `test_identify.py`
        monkeypatch.setattr("matplotlib.figure.Figure.savefig", lambda figure, file, **options: file.write(b"not rendered"))
    assert repr(wanted) == f"<Identification of {N} samples: order 3, n_v 1, n_z 1, with a signal>"
    assert wanted._repr_html_().startswith("<pre># ") and "<script" not in wanted._repr_html_()
    assert "--" not in "\n".join([*wanted.notes, wanted.summary().partition("What to try next")[2]])
    document = wanted.to_json()
    assert json.loads(json.dumps(document))["n_v"] == 1
    names = wanted.save(tmp_path / "new" / "folder")
    assert {"model.json", "fault-signal.csv", "summary.md"} <= set(names)
    assert {path.name for path in (tmp_path / "new" / "folder").iterdir()} == {*names, MANIFEST}
    (tmp_path / "file").write_text("")
    with pytest.raises(InvalidInput, match="cannot be made"):
        wanted.save(tmp_path / "file")


def test_the_record_draws_its_signal_into_the_axes_given(wanted: Any) -> None:
    figure = pytest.importorskip("matplotlib.figure").Figure()
    ax = figure.add_subplot()
    assert wanted.plot(ax) is ax and len(ax.lines[0].get_ydata()) == N
    importlib.import_module("matplotlib").use("Agg")
    drawn = wanted.plot()
    assert [drawn.get_title(loc=place) for place in ("left", "center", "right")].count("Fault signal") == 1
    without = replace(wanted, model=None, residual=None, signal=None)
    assert "order undecided" in repr(without)
    with pytest.raises(InvalidData, match="nothing to draw"):
        without.plot()


def copied(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return the rows that each call of `concatenate` copies from now on."""
    rows, plain = list[int](), np.concatenate

    def counting(parts: Any, *rest: Any, **more: Any) -> Any:
        found = plain(parts, *rest, **more)
        rows.append(len(found))
        return found

    monkeypatch.setattr(np, "concatenate", counting)
    return rows


@pytest.mark.parametrize("length", [1, 7, PIECE - 1, PIECE, 3 * PIECE + 5, 6 * PIECE])
def test_rows_come_in_even_pieces_and_none_is_copied_often(length: int, monkeypatch: pytest.MonkeyPatch) -> None:
    numbered = np.arange(5 * PIECE + 3.0)[:, None]
    came = [numbered[start : start + length] for start in range(0, len(numbered), length)]
    rows = copied(monkeypatch)
    even = list(files._even(iter([numbered[:0], *came])))
    assert [len(one) for one in even] == [PIECE] * 5 + [3]
    assert sum(rows) <= 2 * len(numbered)
    monkeypatch.undo()
    assert np.array_equal(np.concatenate(even), numbered)


def test_of_a_long_piece_no_more_than_a_section_is_copied_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(arx_windows, "SECTION", 2 * PIECE)
    lags, y = 3, np.arange(20 * PIECE + 1.0)[:, None]
    rows = copied(monkeypatch)
    sections = list(arx_windows._sections([(y, -y)], lags))
    assert [len(one) for one, _, _ in sections] == [arx_windows.SECTION + lags] * 9 + [2 * PIECE + 1]
    assert max(rows) <= arx_windows.SECTION + PIECE + lags
    assert all(np.array_equal(before[-lags:], after[:lags]) for (before, _, _), (after, _, _) in pairwise(sections))
