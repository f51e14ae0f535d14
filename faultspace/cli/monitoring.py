"""Run `faultspace monitor`, which holds a model against lines of samples as they come, and prints a line for each alarm.

run         the command's body
Watching    how the stream is watched
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import InvalidInput, in_file, quote_path, shorten
from ..base.messages import say
from ..base.others_text import lines, printable
from ..base.progress import evenly, working
from ..base.regular_files import standard_input
from ..base.sheets import counted
from ..base.threads import one_thread
from ..numeric.data.files import read_record
from ..numeric.data.following import Followed, bounded
from ..numeric.data.records import Record, recorded
from ..numeric.data.selectors import split_names
from ..numeric.data.streams import RESTARTED, TableStream, seldom
from ..numeric.method.model.models import FORMAT as MODEL_FORMAT
from ..numeric.method.model.models import StateSpaceModel
from ..numeric.plant.monitor.alarms import Alarm
from ..numeric.plant.monitor.learned import FORMAT, MONITORING
from ..numeric.plant.monitor.monitoring import ALARM_LEVEL, WINDOW, Monitor
from ..numeric.plant.monitor.saving import refuse
from ..numeric.plant.report.result_files import MODEL
from .argument_names import as_options, naming, of_file
from .failures import ANSWERED, BAD_INPUT, Held, holding
from .reading_files import read_json

STDIN = "standard input"
SAVING = 60.0  # seconds between savings on the way, which are what a loss of power, or a kill, costs at most


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
    if watching.follow is not None and not Path(watching.follow).is_file():
        raise InvalidInput(f"{quote_path(watching.follow)}: is no file, expected a text table that grows")
    watch = _Watch(_ready(model, split_names(inputs), split_names(outputs), watching), watching, as_json)
    with holding() as held, one_thread():
        try:
            watch.begin()
            watch.go_on(held)
        finally:  # an interrupt, and an error of ours, end with what was seen, too
            saved = watch.conclude(held)
    return ANSWERED if saved else BAD_INPUT


class _Watch:
    """A watch from its first line to its last.

    A signal may come anywhere: what belongs together is done while it is `held`. So a monitor that is saved has seen each sample whole or
    not at all, stands where `_place` says, and no alarm is told twice or never.
    """

    def __init__(self, ready: _Ready, watching: Watching, as_json: bool) -> None:
        self._ready, self._watching, self._as_json, self._monitor = ready, watching, as_json, ready.watch
        self._followed = None
        if watching.follow is not None:
            mark = None if ready.watch is None else ready.watch.mark
            self._followed = Followed(watching.follow, idle=watching.idle, after=mark, heard=say)
            self._place = self._followed.begins
        lines = bounded(standard_input(), say) if self._followed is None else self._followed
        head = "" if ready.watch is None or ready.watch.mark is None else ready.watch.mark["head"]
        after = 0 if self._followed is None else self._place.line
        if after:
            say(f"{quote_path(watching.follow or '')}: goes on behind line {after}, where the monitor was saved")
        self._table = TableStream(lines, [*ready.inputs, *ready.outputs], watching.follow or STDIN, after=after, head=head, heard=say)
        self._samples = iter(self._table)
        self._untold: list[Alarm] = []
        self._due, self._unsaved = time.monotonic() + SAVING, 0

    def begin(self) -> None:
        """Calibrate where the model's file does not hold it, and say what the monitor rests on."""
        if self._monitor is None:
            self._monitor = _calibrated(self._ready, self._samples, self._watching)
            self._move()
        for note in self._monitor.notes:
            say(note)

    def go_on(self, held: Held) -> None:
        """Watch to the end of the stream."""
        watch, n_u = self._monitor, len(self._ready.inputs)
        assert watch is not None
        for sample in self._samples:
            known = watch.begun_anew
            with held:
                if sample is RESTARTED:
                    watch.restart()
                else:
                    self._untold += watch.update(sample[n_u:], sample[:n_u])
                self._move()
            self._tell(held)
            if sample is RESTARTED:
                say("the file begins anew: the state of the plant is forgotten")
            if watch.begun_anew > known and seldom(watch.begun_anew):
                say(
                    f"sample {watch.samples - 1}: too much was missing for an unstable model, whose state is as unknown as at the start "
                    f"({counted(watch.begun_anew, 'time')} so far)"
                )
            if self._watching.save is not None and time.monotonic() >= self._due:
                self._save(self._watching.save)
                self._due = time.monotonic() + SAVING

    def conclude(self, held: Held) -> bool:
        """Save the monitor and print the summary; say whether what was to be saved is."""
        watch, save = self._monitor, self._watching.save
        if watch is None:
            return True
        saved = save is None or self._save(save)
        self._tell(held)
        if save is not None and saved:
            line = f", line {self._place.line + 1} of {quote_path(self._watching.follow or '')}" if self._followed is not None else ""
            say(f"{quote_path(str(save))}: goes on with sample {watch.samples} of the stream, counted from 0{line}")
        bad = self._table.bad
        if self._as_json:
            text = json.dumps({"summary": watch.to_json() | {"bad_lines": bad}})
        else:
            lost = "was no sample" if bad == 1 else "were no samples"
            text = lines(f"\n{watch.summary()}") + (f"\n{counted(bad, 'line')} that {lost}" if bad else "")
        sys.stdout.write(text + "\n")
        sys.stdout.flush()
        return saved

    def _move(self) -> None:
        """Note that all the lines so far are in the monitor."""
        if self._followed is not None:
            self._place = self._followed.place

    def _tell(self, held: Held) -> None:
        """Print the alarms that have not been printed."""
        if self._untold:
            with held:
                for alarm in self._untold:
                    sys.stdout.write((json.dumps({"alarm": alarm.to_json()}) if self._as_json else printable(alarm.line)) + "\n")
                self._untold.clear()
            sys.stdout.flush()

    def _save(self, path: Path) -> bool:
        """Write the monitor; where that cannot be, the watch goes on, and this is said."""
        assert self._monitor is not None
        self._monitor.mark = None if self._followed is None else self._followed.mark(self._place) | {"head": self._table.head}
        try:
            self._monitor.save(path)
        except InvalidInput as error:
            self._unsaved += 1
            if seldom(self._unsaved):
                say(str(error))
            return False
        return True


@dataclass(frozen=True)
class _Ready:
    """What the model's file gives: the names of its channels, and a monitor, or the model to make one by a healthy record."""

    inputs: list[str]
    outputs: list[str]
    plant: StateSpaceModel | None
    watch: Monitor | None


def _ready(name: str, inputs: list[str], outputs: list[str], watching: Watching) -> _Ready:
    """Return what is in the file of a model or a saved monitor, or in the folder that `identify` wrote; the names are those of the file
    unless given."""
    path = str(Path(name) / MODEL) if Path(name).is_dir() else name
    if path != name and not Path(path).exists():
        raise InvalidInput(f"{quote_path(name)}: has no {MODEL}, expected a folder that identify wrote; try: faultspace identify --help")
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
        with working("setting thresholds") as telling:
            watch = Monitor.from_json(document, level=watching.level, on_progress=evenly(telling))
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
        healthy, seen = _first(samples, watching.healthy_until or 0, ready.inputs, ready.outputs)
    level, window = ALARM_LEVEL if watching.level is None else watching.level, WINDOW if watching.window is None else watching.window
    worded = as_options if watching.healthy is None else of_file
    with working("calibrating the thresholds") as telling, naming(worded), in_file(watching.healthy or watching.follow or STDIN):
        watch = Monitor(ready.plant, healthy, level=level, window=window, on_progress=evenly(telling))
    if watching.healthy is None:
        watch.samples = seen  # samples are numbered as they stand in the stream
        watch.restart()
    return watch


def _first(samples: Iterator[np.ndarray | None], count: int, inputs: Sequence[str], outputs: Sequence[str]) -> tuple[Record, int]:
    """Return the first so many samples of the stream without a gap as a record, and how many have come until then."""
    rows: list[np.ndarray] = []
    seen, gaps = 0, 0
    for row in samples:
        seen += row is not RESTARTED
        if row is RESTARTED or not np.all(np.isfinite(row)):
            gaps += 1
            if seldom(gaps):
                missing = "samples" if row is RESTARTED else shorten([*inputs, *outputs][int(np.flatnonzero(~np.isfinite(row))[0])])
                say(f"--healthy-until: {missing} missing behind sample {seen - 1}: the {count} healthy samples begin anew")
            rows = []
            continue
        rows.append(row)
        if len(rows) == count:
            break
    if len(rows) < count:
        raise InvalidInput(f"--healthy-until: got {counted(len(rows), 'sample')} without a gap, expected {count} and some to watch")
    values = np.array(rows)
    return recorded(values[:, len(inputs) :], values[:, : len(inputs)], outputs=outputs, inputs=inputs), seen
