"""Damaged files get one line and the code of bad input, or an answer: no traceback, no error of ours, no hang, no flood of memory.

A run of the tests tries a part, `FAULTSPACE_THOROUGH=1` ten thousand. What `identify` makes of numbers that it could read is the work of
other tests: here it goes no further than reading, but for one record in a hundred.
"""

from __future__ import annotations

import random
import signal
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from faultspace.base.errors import InvalidInput
from faultspace.cli import identifying
from faultspace.numeric.plant import pipeline
from tests.end_to_end.commands import Run, call
from tests.end_to_end.damaged import arguments, damaged, sound
from tests.thorough import THOROUGH

resource = pytest.importorskip("resource", reason="peaks of memory are told by the module resource, which Windows lacks")

COUNT = 10_000 if THOROUGH else 400
LONGEST = 20  # seconds
MOST = 1 << 30  # bytes
READ = "the record is read; no more is asked for"


@contextmanager
def within(seconds: int) -> Iterator[None]:
    """Raise TimeoutError when that takes longer."""

    def late(*_: object) -> None:
        raise TimeoutError(f"more than {seconds} s")

    before = signal.signal(signal.SIGALRM, late)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def peak() -> int:
    """Return the most bytes that this process has held."""
    return int(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss) << 10


def wrong(run: Run) -> str:
    """Return what is wrong with how a run ended, nothing where it is an answer or a complaint of one line."""
    if run.code not in (0, 1, 2, 3):
        return f"code {run.code}: {run.err[:400]}"
    lines = [line for line in run.err.splitlines() if not line.startswith("faultspace: ")]
    if "Traceback" in run.err or lines:
        return f"standard error: {run.err[:400]}"
    if run.code == 2 and (not run.err or len(run.err) > 2000):
        return f"{len(run.err)} characters on standard error"
    return ""


@pytest.mark.skipif(not hasattr(signal, "SIGALRM"), reason="a hang is ended by SIGALRM, which Windows lacks")
@pytest.mark.parametrize("part", range(4))
def test_damaged_files_are_told_in_a_line(part: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = pipeline.identify
    source = random.Random(part)

    def mostly_read(*given: Any, **settings: Any) -> Any:
        if source.random() < 0.01:
            return whole(*given, **settings)
        raise InvalidInput(READ)

    monkeypatch.setattr(identifying, "identify", mostly_read)
    names = list(sound())
    others = [name for name in names if not name.startswith("certificate")]
    found: list[str] = []
    for number in range(COUNT // 4):
        name = source.choice(names if number % 4 == 0 else others)
        path = tmp_path / name
        path.write_bytes(damaged(source, sound()[name]))
        line = arguments(source, name, path, tmp_path / "out")
        held, start = peak(), time.monotonic()
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            try:
                with within(LONGEST):
                    ended = wrong(call(*line))
            except TimeoutError as error:
                ended = str(error)
        if peak() - held > MOST:
            ended = f"{(peak() - held) >> 20} MiB more"
        if ended:
            found.append(f"part {part}, number {number}, {' '.join(line)}, {time.monotonic() - start:.1f} s: {ended}")
    assert not found, "\n".join(found)


def test_each_kind_is_read_before_it_is_damaged(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Otherwise everything would be refused for another reason, and the test above could not fail."""
    monkeypatch.setattr(identifying, "identify", lambda *_, **__: (_ for _ in ()).throw(InvalidInput(READ)))
    source = random.Random(0)
    for name, content in sound().items():
        path = tmp_path / name
        path.write_bytes(content)
        run = call(*arguments(source, name, path, tmp_path / "out"))
        read = run.code == 0 or READ in run.err or "choose, as in" in run.err or "expected the same field" in run.err
        assert read, f"{name}: {run.err}"


def test_an_error_of_ours_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise KeyError("ours")

    monkeypatch.setattr("faultspace.cli.inspecting.analyze", broken)
    assert wrong(call("inspect", "example:zeros")).startswith("code 70")


@pytest.mark.skipif(not hasattr(signal, "SIGALRM"), reason="a hang is ended by SIGALRM, which Windows lacks")
def test_a_hang_is_seen() -> None:
    with pytest.raises(TimeoutError), within(1):
        time.sleep(5)
