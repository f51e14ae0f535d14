"""This watches a long stream twice, undisturbed and through outages, rotations, truncations of what was read, kills and restores.

    python benchmarks/long_watch.py [--samples 10000000] [--every 10000] [--seed 1]

A plant of one input and three outputs writes a table, a piece of EVERY samples at a time. Outputs are missing for a while in each piece, in
some all of them, and faults come and go. Undisturbed, one Monitor takes the samples as arrays. Disturbed, they are lines of a file that is
followed (`Followed`, `TableStream`) to the end of each piece; behind it, in turn, the file is renamed and another one begins, with its line
of names or without; the logger is started again and writes its line of names again; a line is torn by a rotation; or the watch is killed
at a random sample and restored from what it saved last, so that what lies between is watched again. The alarms must be the same.

What is printed: alarms of both, microseconds of CPU a sample with all files written and read, and the memory after a tenth and at the end.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import psutil
from numpy.typing import NDArray

from faultspace.base.threads import one_thread
from faultspace.numeric import Alarm, Monitor, StateSpaceModel
from faultspace.numeric.data.following import Followed
from faultspace.numeric.data.streams import TableStream

Array = NDArray[np.float64]
NAMES = ("u1", "y1", "y2", "y3")
PLANT = StateSpaceModel([[0.9, 0.2], [-0.2, 0.7]], [[1.0], [0.5]], [[1.0, 0.0], [0.3, 1.0], [0.5, -0.5]], [[0.0], [0.1], [0.0]])
NOISE, FAULT = 0.1, 0.3


@dataclass(frozen=True)
class Compared:
    """The alarms of both watches, microseconds of CPU a sample of the disturbed one, kills, and MiB after a tenth and at the end."""

    undisturbed: list[Alarm]
    disturbed: list[Alarm]
    microseconds: float
    kills: int
    early: float
    late: float


def pieces(samples: int, every: int, seed: int) -> Iterator[Array]:
    """Yield the rows (every, 4) of NAMES; NaN where a field is empty. The plant rests between two pieces, which only costs a transient."""
    for number in range(samples // every):
        draw = np.random.default_rng((seed, number))
        u = draw.standard_normal((every, 1))
        y = PLANT.simulate(u) + NOISE * draw.standard_normal((every, 3))
        start, length = int(draw.integers(every)), int(draw.integers(1, 60))
        y[start : start + length, int(draw.integers(3))] = np.nan
        if number % 3 == 1:
            start = int(draw.integers(every))
            y[start : start + length] = np.nan
        if number % 5 == 4:
            start = int(draw.integers(every))
            y[start : start + 200, int(draw.integers(3))] += FAULT
        yield np.hstack([u, y]).round(6)


def lines(rows: Array) -> str:
    """Return the rows as lines of a table, an empty field for NaN."""
    return "".join(",".join("" if value != value else repr(float(value)) for value in row) + "\n" for row in rows)


def compared(samples: int, every: int, seed: int, folder: Path) -> Compared:
    """Return what both watches made of the same samples."""
    draw = np.random.default_rng(seed)
    u = draw.standard_normal((20_000, 1))
    model = Monitor(PLANT, PLANT.simulate(u) + NOISE * draw.standard_normal((20_000, 3)), u, level=1e-4)
    path, saved = folder / "log.csv", folder / "watch.json"
    model.save(saved)
    whole, watch = Monitor.load(saved), Monitor.load(saved)
    undisturbed: list[Alarm] = []
    told: dict[tuple[int, str, tuple[str, ...]], Alarm] = {}
    seconds, kills, early = 0.0, 0, 0.0
    path.write_text(",".join(NAMES) + "\n")
    stream = _opened(path, watch)
    for number, rows in enumerate(pieces(samples, every, seed)):
        undisturbed += whole.extend(rows[:, 1:], rows[:, :1]).alarms
        with open(path, "a") as file:
            file.write(lines(rows))
        begun, end = time.process_time(), (number + 1) * every
        kill = watch.samples + int(draw.integers(1, every)) if number % 2 else -1
        with one_thread():
            while watch.samples < end:
                sample = next(stream.samples)
                assert sample is not None
                for alarm in watch.update(sample[1:], sample[:1]):
                    told[alarm.sample, alarm.test, alarm.outputs] = alarm
                if watch.samples == kill:  # nothing is saved here: what was saved at the end of the last piece is all that is left
                    kills, kill = kills + 1, -1
                    watch = Monitor.load(saved)
                    stream = _opened(path, watch)
        watch.mark = stream.followed.mark(stream.followed.place) | {"head": stream.table.head}
        watch.save(saved)
        seconds += time.process_time() - begun
        _disturb(path, number)
        early = early or (_held() if number >= samples // every // 10 else 0.0)
    return Compared(undisturbed, list(told.values()), 1e6 * seconds / samples, kills, early, _held())


@dataclass(frozen=True)
class _Open:
    followed: Followed
    table: TableStream
    samples: Iterator[Array | None]


def _opened(path: Path, watch: Monitor) -> _Open:
    followed = Followed(str(path), idle=1.0, after=watch.mark)
    head = "" if watch.mark is None else watch.mark["head"]
    table = TableStream(followed, NAMES, str(path), after=followed.begins.line, head=head)
    return _Open(followed, table, iter(table))


def _disturb(path: Path, number: int) -> None:
    """Do to the file what loggers, and those who tidy up behind them, do."""
    kind, head = number % 4, ",".join(NAMES) + "\n"
    if kind == 0:  # the logger is started again
        with open(path, "a") as file:
            file.write(f"# started again\n\n{head}")
        return
    if kind == 3:  # what it was writing is torn
        with open(path, "a") as file:
            file.write("1.5,2")
    os.replace(path, path.with_suffix(".1"))
    path.write_text(head if kind != 2 else "# goes on\n")


def _held() -> float:
    return float(psutil.Process().memory_info().rss / 2**20)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--samples", type=int, default=10_000_000)
    parser.add_argument("--every", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        found = compared(given.samples, given.every, given.seed, Path(folder))
    same = found.undisturbed == found.disturbed
    print(
        f"{given.samples} samples, {given.samples // given.every} disturbances, {found.kills} kills: {len(found.undisturbed)} alarms "
        f"undisturbed, {len(found.disturbed)} disturbed, {'the same' if same else 'OTHERS'}; {found.microseconds:.0f} us of CPU a sample, "
        f"{found.early:.0f} MiB after a tenth, {found.late:.0f} MiB at the end"
    )
    sys.exit(not same)
