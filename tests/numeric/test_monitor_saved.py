"""A monitor in a file: goes on as without the break, is refused where the file is none, and comes from an Identification's own record.

plant     y and u of a plant of two outputs, a fault of the mean from `onset` on
"""

from __future__ import annotations

import json
import re
from copy import deepcopy
from functools import lru_cache
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

import faultspace as fs
from faultspace.base.errors import InvalidData, InvalidInput
from faultspace.exact.algebra.validation import MAX_FILE_BYTES
from faultspace.numeric import identify
from faultspace.numeric.plant.monitor import saving
from faultspace.numeric.plant.report.result_files import MODEL, of_monitor
from tests.numeric.test_monitor import PLANT, made, record, same

SCHEMA = json.loads((Path(fs.numeric.__file__).parent / "schemas" / "monitor.schema.json").read_text())


def plant(samples: int = 700, onset: int | None = None) -> tuple[Any, Any]:
    draw = np.random.default_rng(4)
    u = draw.standard_normal((samples, 1))
    y = PLANT.simulate(u) + 0.1 * draw.standard_normal((samples, 2)) + [5.0, -100.0]
    if onset is not None:
        y[onset:, 0] += 1.0
    return y, u


def holes() -> tuple[Any, Any]:
    """Return a stream with a fault, missing outputs, missing inputs and an output that is silent for long."""
    y, u = record(2, 160)
    y[100:, 0] += 0.6
    draw = np.random.default_rng(0)
    y[draw.random(y.shape) < 0.1] = np.nan
    u[40], y[60:85, 1] = np.nan, np.nan
    return y, u


@pytest.mark.parametrize("after", [0, 1, 41, 70, 84, 85, 101, 105, 150])
def test_a_break_changes_no_byte(tmp_path: Path, after: int) -> None:
    y, u = holes()
    whole = made(seed=3)
    broken = deepcopy(whole)
    expected = whole.extend(y, u)
    first = broken.extend(y[:after], u[:after])
    broken.save(tmp_path / "watch.json")
    second = fs.Monitor.load(tmp_path / "watch.json").extend(y[after:], u[after:])
    assert expected.alarms and first.alarms + second.alarms == expected.alarms and second.first == after
    assert same(np.vstack([first.statistics, second.statistics]), expected.statistics)
    assert same(np.vstack([first.innovations, second.innovations]), expected.innovations)


def test_summary_and_notes_come_back_and_the_schema_holds(tmp_path: Path) -> None:
    watch = made(seed=3)
    watch.extend(*holes())
    watch.save(tmp_path / "watch.json")
    again = fs.Monitor.load(tmp_path / "watch.json")
    assert again.summary() == watch.summary() and again.to_json() == watch.to_json()
    document = json.loads((tmp_path / "watch.json").read_text())
    jsonschema.validate(document, SCHEMA)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(document | {"window": 1}, SCHEMA)
    stricter = fs.Monitor.load(tmp_path / "watch.json", level=1e-5)
    assert np.all(stricter.calibration.threshold > again.calibration.threshold) and stricter.samples == again.samples


@lru_cache
def saved() -> str:
    watch = made(seed=3)
    watch.extend(*holes())
    return json.dumps(watch._learned.to_json() | {"level": 1e-3, "state": watch._state()})


@pytest.mark.parametrize(
    ("place", "value", "words"),
    [
        ((), [], "got format"),
        (("format",), "faultspace-monitor/2", "got format 'faultspace-monitor/2', expected a monitor"),
        (("format",), "faultspace-model/1", 'the model has no "monitoring"'),
        (("outputs",), [], "outputs: got no name"),
        (("outputs",), ["a", 2], "outputs: got ['a', 2], expected a list of texts"),
        (("inputs",), ["a", "b"], "B: got shape"),
        (("window",), 1, "window: got 1"),
        (("window",), 11, "maxima: got 15 blocks of 55 samples in 780 healthy samples"),
        (("window",), 10**30, "window: got 1000000000000000000000000000000; needed 1677721 samples at most for 2 outputs"),
        (("samples",), 10**30, "maxima: got 15 blocks of 50 samples in 1000000000000000000000000000000"),
        (("shift",), 1e300, "shift: got 1e+300, expected numbers whose squares a float holds"),
        (("form", "A"), [[1e300] * 2] * 2, "A: got 1e+300, expected"),
        (("state", "bank", "sums"), [[1e300, 0.0]], "sums: got 1e+300, expected"),
        (("state", "bank", "direction"), [[0.0] * 20], "direction: got numbers of size 0, expected"),
        (("state", "bank", "column"), [[1e150] * 20], "column: got numbers of size 1e+150, expected"),
        (("state", "bank", "moments"), [[[1e150] * 20] * 20], "moments: got numbers of size 1e+150, expected"),
        (("shift",), 100.0, "shift: got 100; needed a smaller change of mean"),
        (("state", "samples"), -1, "samples: got -1, expected counts"),
        (("state", "missing"), [-1, 0], "missing: got [-1, 0], expected counts"),
        (("state", "root"), [[0.0]], "root: got shape (1, 1)"),
        (("stream",), {"bytes": -1, "line": 0, "first": "", "last": "", "head": ""}, "bytes: got -1"),
        (("stream",), 3, "stream: got 3, expected how far a file was read"),
        (("shift",), 0.0, "shift: got 0.0"),
        (("level",), 2.0, "level: got 2.0"),
        (("form",), None, "form: got None, expected an object"),
        (("form", "A"), [["x"]], "A: got what is no array of numbers"),
        (("form", "A"), [[10**400] * 2] * 2, "A: got what is no array of numbers"),
        (("form", "push"), [0.0], "A: got shape"),
        (("form", "covariance"), [[1.0, 2.0], [2.0, 1.0]], "expected symmetric ones without negative variances"),
        (("form", "covariance"), [[1.0, 0.5], [0.0, 1.0]], "expected symmetric ones without negative variances"),
        (("form", "level"), [None, 0.0], "level: got a number that is missing or not finite"),
        (("units", "scale"), [0.0, 1.0], "scale: got [0.0, 1.0], expected positive numbers"),
        (("maxima",), [], "maxima: got 0 blocks"),
        (("state",), 3, "state: got 3"),
        (("state", "recent"), [], "recent: got shape"),
        (("state", "samples"), 0.5, "samples: got 0.5, expected counts, integers"),
        (("state", "bank", "place"), 10, "place: got 10"),
        (("state", "bank", "moments"), None, "moments: got"),
        (("state", "alarms", "cusum"), "many", "cusum: got what is no array"),
    ],
)
def test_a_file_that_is_no_monitor_is_refused(tmp_path: Path, place: tuple[str, ...], value: Any, words: str) -> None:
    document = json.loads(saved())
    inside: Any = document
    for key in place[:-1]:
        inside = inside[key]
    if place:
        inside[place[-1]] = value
    else:
        document = value
    (tmp_path / "watch.json").write_text(json.dumps(document))
    with pytest.raises(InvalidData, match=re.escape(words)):
        fs.Monitor.load(tmp_path / "watch.json")


def test_a_file_is_as_long_as_one_of_json_may_be(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    watch = made(seed=3)
    watch.save(tmp_path / "watch.json")
    with open(tmp_path / "huge.json", "wb") as file:
        file.truncate(10**13)
    with pytest.raises(InvalidInput, match=f"huge.json: got more than {MAX_FILE_BYTES} bytes"):
        fs.Monitor.load(tmp_path / "huge.json")
    assert saving.MOST == MAX_FILE_BYTES
    monkeypatch.setattr(saving, "MOST", (tmp_path / "watch.json").stat().st_size - 1)
    with pytest.raises(InvalidInput, match="the monitor takes"):
        watch.save(tmp_path / "second.json")
    assert not (tmp_path / "second.json").exists()


def test_no_file_of_anybody_else_is_overwritten(tmp_path: Path) -> None:
    watch = made(seed=3)
    (tmp_path / "mine.json").write_text("{}")
    (tmp_path / "bytes").write_bytes(b"\xff\xfe")
    for name in ("mine.json", "bytes", "."):
        with pytest.raises(InvalidInput, match="is there, and no saved monitor"):
            watch.save(tmp_path / name)
    with pytest.raises(InvalidInput, match="cannot be written"):
        watch.save(tmp_path / "no" / "where.json")
    assert (tmp_path / "mine.json").read_text() == "{}" and not (tmp_path / "no").exists()
    watch.save(tmp_path / "watch.json")
    watch.save(tmp_path / "watch.json")
    for name, words in (("none.json", "cannot be read"), ("bytes", "got no JSON")):
        with pytest.raises(InvalidInput, match=words):
            fs.Monitor.load(tmp_path / name)


@pytest.mark.parametrize(
    ("healthy", "onset", "words", "window"),
    [
        (300, None, ["so few samples allow a window of 18"], 18),
        (None, 500, ["the first 497 count as such, before the residual changes, though it changes before, at sample 7"], 20),
        (None, None, ["all that the model is from count as such"], 20),
    ],
)
def test_the_model_of_identify_is_enough(healthy: int | None, onset: int | None, words: list[str], window: int) -> None:
    y, u = plant(onset=onset)
    found = identify(y, u, order=2, healthy=healthy)
    learned, remarks = of_monitor(found)
    document = json.loads(json.dumps({"format": "faultspace-model/1", "monitoring": learned}))
    jsonschema.validate(document["monitoring"], SCHEMA)
    watch = fs.Monitor.from_json(document, level=1e-3)
    own = watch.notes[: len(words)]
    assert not remarks and all(word in note for word, note in zip(words, own, strict=True)), watch.notes
    assert watch.to_json()["window"] == window and watch.calibration.samples <= (healthy or 497 if onset else 700)
    new, pushed = record(7, 300)
    same_seen = fs.Monitor(found, level=1e-3, window=window).extend(new, pushed)
    assert same(watch.extend(new, pushed).statistics, same_seen.statistics)
    new[150:, 0] += 1.0
    first = fs.Monitor.from_json(document, level=1e-4).extend(new, pushed).alarms[0]
    assert first.sample in range(150, 156) and first.outputs == ("y1",)


def test_a_record_without_noise_says_what_the_model_lacks() -> None:
    u = np.random.default_rng(1).standard_normal((400, 1))
    learned, remarks = of_monitor(identify(PLANT.simulate(u), u))
    assert learned is None and "model.json, what `monitor` needs: " in remarks[0] and "no noise" in remarks[0]
    with pytest.raises(InvalidData, match='the model has no "monitoring"'):
        fs.Monitor.from_json(PLANT.to_json())
    assert saving.MODEL == MODEL
