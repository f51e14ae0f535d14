"""Run `faultspace monitor`, which holds a model against lines of samples as they come, and prints a line for each alarm.

run         the command's body
Watching    how the stream is watched
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import InvalidInput, in_file, quote_path, shorten
from ..base.messages import say
from ..base.others_text import lines, printable
from ..base.progress import evenly, working
from ..base.sheets import counted
from ..numeric.data.files import read_record
from ..numeric.data.records import Record, recorded
from ..numeric.data.selectors import split_names
from ..numeric.data.streams import RESTARTED, TableStream, followed
from ..numeric.method.model.models import FORMAT as MODEL_FORMAT
from ..numeric.method.model.models import StateSpaceModel
from ..numeric.plant.monitor.alarms import Alarm
from ..numeric.plant.monitor.learned import FORMAT, MONITORING
from ..numeric.plant.monitor.monitoring import ALARM_LEVEL, WINDOW, Monitor
from ..numeric.plant.monitor.saving import refuse
from ..numeric.plant.report.result_files import MODEL
from .argument_names import as_options, naming, of_file
from .failures import ANSWERED, INTERRUPTED
from .reading_files import read_json

STDIN = "standard input"


@dataclass(frozen=True)
class Watching:
    """`healthy` names a record without fault, or `healthy_until` says how many samples of the stream are one.

    Where neither is given, the model's file says what its errors are like. `follow` names a file that grows, watched until nothing came for
    `idle` seconds; `level` and `window` are those of the Monitor, None where nobody stated them. `save` names a file for the monitor.
    """

    healthy: str | None
    healthy_until: int | None
    follow: str | None
    idle: float | None
    level: float | None
    window: int | None
    save: Path | None


def run(model: str, watching: Watching, *, inputs: Sequence[str], outputs: Sequence[str], as_json: bool) -> int:
    """Watch to the end of the stream; the exit code is 0 whatever the alarms. An interrupt ends with the summary, too."""
    if watching.healthy is not None and watching.healthy_until is not None:
        raise InvalidInput(
            "--healthy, --healthy-until: got both, expected one at most: the file of a record without fault, by which alarms are "
            "calibrated, or how many samples of the stream are one"
        )
    if watching.idle is not None and watching.follow is None:
        raise InvalidInput("--idle: got no --follow, expected the file that is watched for so long")
    if watching.save is not None:
        refuse(watching.save)
    ready = _ready(model, split_names(inputs), split_names(outputs), watching)
    u_names, y_names = ready.inputs, ready.outputs
    if watching.follow is not None and not Path(watching.follow).is_file():
        raise InvalidInput(f"{quote_path(watching.follow)}: is no file, expected a text table that grows")
    lines = iter(sys.stdin.buffer.readline, b"") if watching.follow is None else followed(watching.follow, idle=watching.idle)
    samples = iter(TableStream(lines, [*u_names, *y_names], watching.follow or STDIN))
    watch = ready.watch
    try:
        if watch is None:
            watch = _calibrated(ready, samples, watching)
        for note in watch.notes:
            say(note)
        for sample in samples:
            if sample is RESTARTED:
                say("the file begins anew: the state of the plant is forgotten")
                watch.restart()
                continue
            for alarm in watch.update(sample[len(u_names) :], sample[: len(u_names)]):
                _tell(alarm, as_json)
    except KeyboardInterrupt:
        if watch is not None:
            _conclude(watch, as_json)
        return INTERRUPTED
    finally:
        if watch is not None and watching.save is not None:
            watch.save(watching.save)
    _conclude(watch, as_json)
    return ANSWERED


@dataclass(frozen=True)
class _Ready:
    """This is what the model's file gives: the names of its channels, and a monitor, or the model to make one by a healthy record."""

    inputs: list[str]
    outputs: list[str]
    plant: StateSpaceModel | None
    watch: Monitor | None


def _ready(name: str, inputs: list[str], outputs: list[str], watching: Watching) -> _Ready:
    """Return what is in the file of a model or a saved monitor, or in the folder that `identify` wrote; the names are those of the file
    unless given."""
    path = str(Path(name) / MODEL) if Path(name).is_dir() else name
    document = read_json(path)
    calibrating = watching.healthy is not None or watching.healthy_until is not None
    with in_file(path):
        if isinstance(document, dict) and document.get("format") == FORMAT and calibrating:
            raise InvalidInput("got a saved monitor, which is calibrated: leave --healthy and --healthy-until out, or name the model")
        if calibrating:
            plant = StateSpaceModel.from_json(document)
            if not plant.n_u:
                raise InvalidInput("got a model without inputs, expected one with inputs; fs.Monitor in Python takes such models")
            named = [_channels(document, kind, given, count) for kind, given, count in _kinds(inputs, outputs, plant.n_u, plant.p)]
            return _Ready(named[0], named[1], plant, None)
        if isinstance(document, dict) and document.get("format") == MODEL_FORMAT and MONITORING not in document:
            raise InvalidInput(
                'the model has no "monitoring", which says what its errors are like without fault: it is of an earlier version, or of a '
                "record that was too short or without noise: try --healthy FILE, a record without fault, or --healthy-until K"
            )
        with working("setting thresholds"):
            watch = Monitor.from_json(document, level=watching.level)
        if watching.window not in (None, watch.to_json()["window"]):
            raise InvalidInput(
                f"--window: got {watching.window}, but the file is calibrated for windows of {watch.to_json()['window']} samples: leave it "
                "out, or give --healthy FILE, a record without fault"
            )
        known = {"inputs": list(watch.inputs), "outputs": list(watch.outputs)}
        named = [
            _channels(known, kind, given, count) for kind, given, count in _kinds(inputs, outputs, len(watch.inputs), len(watch.outputs))
        ]
        watch.inputs, watch.outputs = tuple(named[0]), tuple(named[1])
        return _Ready(named[0], named[1], None, watch)


def _kinds(inputs: list[str], outputs: list[str], n_u: int, p: int) -> tuple[tuple[str, list[str], int], ...]:
    return (("inputs", inputs, n_u), ("outputs", outputs, p))


def _channels(document: Mapping[str, Any], kind: str, given: list[str], count: int) -> list[str]:
    """Return the names of the channels of this kind, those of the document unless given."""
    names = given or list(document.get(kind, ()))
    if len(names) != count or not all(isinstance(one, str) for one in names):
        got = ", ".join(map(shorten, names)) or "no names"
        raise InvalidInput(f"got {got} for {counted(count, kind[:-1])} of the model, expected a name for each: try --{kind} NAME,NAME")
    return names


def _calibrated(ready: _Ready, samples: Iterator[np.ndarray | None], watching: Watching) -> Monitor:
    """Return a monitor of the model by the healthy record, which is a file or the beginning of the stream."""
    if watching.healthy is not None:
        with working(f"reading {quote_path(watching.healthy)}") as telling:
            healthy = read_record(watching.healthy, inputs=ready.inputs, outputs=ready.outputs, on_progress=evenly(telling))
    else:
        healthy = _first(samples, watching.healthy_until or 0, ready.inputs, ready.outputs)
    level, window = ALARM_LEVEL if watching.level is None else watching.level, WINDOW if watching.window is None else watching.window
    worded = as_options if watching.healthy is None else of_file
    with working("calibrating the thresholds"), naming(worded), in_file(watching.healthy or watching.follow or STDIN):
        watch = Monitor(ready.plant, healthy, level=level, window=window)
    if watching.healthy is None:
        watch.samples = len(healthy)  # samples are numbered as they stand in the stream
        watch.restart()
    return watch


def _first(samples: Iterator[np.ndarray | None], count: int, inputs: Sequence[str], outputs: Sequence[str]) -> Record:
    """Return the first samples of the stream as a record."""
    rows: list[np.ndarray] = []
    for row in samples:
        if row is RESTARTED:
            rows = []
            continue
        if not np.all(np.isfinite(row)):
            missing = [*inputs, *outputs][int(np.flatnonzero(~np.isfinite(row))[0])]
            raise InvalidInput(
                f"--healthy-until: channel {shorten(missing)} is no number at sample {len(rows)}, expected healthy samples without gaps"
            )
        rows.append(row)
        if len(rows) == count:
            break
    if len(rows) < count:
        raise InvalidInput(f"--healthy-until: got {counted(len(rows), 'sample')} in all, expected {count} and some to watch")
    values = np.array(rows)
    return recorded(values[:, len(inputs) :], values[:, : len(inputs)], outputs=outputs, inputs=inputs)


def _tell(alarm: Alarm, as_json: bool) -> None:
    sys.stdout.write((json.dumps({"alarm": alarm.to_json()}) if as_json else printable(alarm.line)) + "\n")
    sys.stdout.flush()


def _conclude(watch: Monitor, as_json: bool) -> None:
    sys.stdout.write((json.dumps({"summary": watch.to_json()}) if as_json else lines(f"\n{watch.summary()}")) + "\n")
    sys.stdout.flush()
