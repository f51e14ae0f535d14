"""Run `faultspace monitor`, which holds a model against lines of samples as they come, and prints a line for each alarm.

run         the command's body
Watching    how the stream is watched
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..base.errors import InvalidInput, in_file, quote_path, shorten
from ..base.messages import say
from ..base.progress import evenly, working
from ..base.sheets import counted
from ..numeric.data.files import read_record
from ..numeric.data.records import Record, recorded
from ..numeric.data.selectors import split_names
from ..numeric.data.streams import RESTARTED, TableStream, followed
from ..numeric.model.models import StateSpaceModel
from ..numeric.monitor.alarms import Alarm
from ..numeric.monitor.monitoring import Monitor
from ..numeric.report.files import MODEL
from .failures import ANSWERED, INTERRUPTED
from .reading_files import read_json

STDIN = "standard input"


@dataclass(frozen=True)
class Watching:
    """`healthy` names a record without fault, or `healthy_until` says how many samples of the stream are one.

    `follow` names a file that grows, watched until nothing came for `idle` seconds; `level` and `window` are those of the Monitor.
    """

    healthy: str | None
    healthy_until: int | None
    follow: str | None
    idle: float | None
    level: float
    window: int


def run(model: str, watching: Watching, *, inputs: Sequence[str], outputs: Sequence[str], as_json: bool) -> int:
    """Watch to the end of the stream; the exit code is 0 whatever the alarms. An interrupt ends with the summary, too."""
    if (watching.healthy is None) == (watching.healthy_until is None):
        got = "neither" if watching.healthy is None else "both"
        raise InvalidInput(
            f"--healthy, --healthy-until: got {got}, expected one: the file of a record without fault, by which alarms are calibrated, or "
            "how many samples of the stream are one"
        )
    if watching.idle is not None and watching.follow is None:
        raise InvalidInput("--idle: got no --follow, expected the file that is watched for so long")
    plant, u_names, y_names = _model(model, split_names(inputs), split_names(outputs))
    if watching.follow is not None and not Path(watching.follow).is_file():
        raise InvalidInput(f"{quote_path(watching.follow)}: is no file, expected a text table that grows")
    lines = iter(sys.stdin.buffer.readline, b"") if watching.follow is None else followed(watching.follow, idle=watching.idle)
    samples = iter(TableStream(lines, [*u_names, *y_names], watching.follow or STDIN))
    watch: Monitor | None = None
    try:
        if watching.healthy is not None:
            with working(f"reading {quote_path(watching.healthy)}") as telling:
                healthy = read_record(watching.healthy, inputs=u_names, outputs=y_names, on_progress=evenly(telling))
        else:
            healthy = _first(samples, watching.healthy_until or 0, u_names, y_names)
        with working("calibrating"), in_file(watching.healthy or watching.follow or STDIN):
            watch = Monitor(plant, healthy, level=watching.level, window=watching.window)
        if watching.healthy is None:
            watch.samples = len(healthy)  # samples are numbered as they stand in the stream
            watch.restart()
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
    _conclude(watch, as_json)
    return ANSWERED


def _model(name: str, inputs: list[str], outputs: list[str]) -> tuple[StateSpaceModel, list[str], list[str]]:
    """Return the model of a file, or of a folder that `identify` wrote, with the names of its channels, those of the file unless given."""
    path = str(Path(name) / MODEL) if Path(name).is_dir() else name
    document = read_json(path)
    with in_file(path):
        plant = StateSpaceModel.from_json(document)
        if not plant.n_u:
            raise InvalidInput("got a model without inputs, expected one with inputs; fs.Monitor in Python takes such models")
        found = []
        for kind, given, count in (("inputs", inputs, plant.n_u), ("outputs", outputs, plant.p)):
            names = given or list(document.get(kind, ()))
            if len(names) != count or not all(isinstance(one, str) for one in names):
                got = ", ".join(map(shorten, names)) or "no names"
                raise InvalidInput(
                    f"got {got} for {counted(count, kind[:-1])} of the model, expected a name for each: try --{kind} NAME,NAME"
                )
            found.append(names)
    return plant, found[0], found[1]


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
    sys.stdout.write((json.dumps({"alarm": alarm.to_json()}) if as_json else alarm.line) + "\n")
    sys.stdout.flush()


def _conclude(watch: Monitor, as_json: bool) -> None:
    sys.stdout.write((json.dumps({"summary": watch.to_json()}) if as_json else f"\n{watch.summary()}") + "\n")
    sys.stdout.flush()
