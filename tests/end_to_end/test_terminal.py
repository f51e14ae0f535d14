"""These tests are about what a person sees while a command works, and tables at every width.

Terminal    a stream that says it is one
"""

from __future__ import annotations

import contextlib
import io
import os
import pty
import re
import subprocess
import sys
import time
from typing import Any

import pytest
from rich.console import Console
from rich.table import Table
from rich.text import Text

import faultspace as fs
from faultspace.base import messages, progress
from faultspace.base.sheets import Sheet
from faultspace.cli import consoles
from faultspace.cli.command_line import main
from faultspace.cli.file_by_file import FileAnswer, answer_each
from faultspace.exact.structure.record import analyze
from tests.end_to_end.commands import ROOT, call, environment


class Terminal(io.StringIO):
    """This stream says that it is a terminal."""

    def isatty(self) -> bool:
        return True


def test_long_work_is_told_and_short_work_is_not(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(progress, "PATIENCE", 3600.0)
    with progress.working("short"):
        pass
    assert capsys.readouterr() == ("", "")
    monkeypatch.setattr(progress, "PATIENCE", 0.1)
    with progress.working("long"):
        time.sleep(0.5)
    assert capsys.readouterr() == ("", "faultspace: long ...\n")


def test_without_a_terminal_a_line_comes_at_times_and_says_something_new(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(progress, "PATIENCE", 0.05)
    monkeypatch.setattr(progress, "EVERY", 0.5)
    with progress.working("starting") as tell:
        begun = time.monotonic()
        for done in range(1000):
            tell("counting", done, 1000, 60.0)
            time.sleep(0.001)
        tell("resting")
        time.sleep(1.6)
        passed = time.monotonic() - begun
    out, err = capsys.readouterr()
    lines = err.splitlines()
    assert out == "" and 2 <= len(lines) <= 2 + passed / 0.5
    assert all(line.startswith("faultspace: counting (") and line.endswith("of 1000, about 60 s left)") for line in lines[:-1])
    assert lines[-1] == "faultspace: resting ...", "and once, though it rested long"


def test_on_a_terminal_one_line_moves_and_is_gone_in_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress, "PATIENCE", 0.05)
    for name, value in (("TERM", "xterm"), ("COLUMNS", "60"), ("LINES", "20")):
        monkeypatch.setenv(name, value)
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    with progress.working("starting") as tell:
        tell("counting [faults] of a system whose name is much too long for the line", 7, 83)
        time.sleep(0.6)
        messages.say("a remark")
    printed = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", stream.getvalue())
    frames = [frame for frame in re.split(r"[\r\n]", printed) if "7 of 83" in frame]
    assert frames and all(len(frame) <= 60 and "counting [faults]" in frame for frame in frames)
    assert "faultspace: a remark" in printed and stream.getvalue().rstrip("\n").endswith("\x1b[2K")


def test_a_terminal_that_cannot_go_back_gets_plain_lines(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress, "PATIENCE", 0.05)
    monkeypatch.setenv("TERM", "dumb")
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    with progress.working("counting"):
        time.sleep(0.6)
    assert stream.getvalue() == "faultspace: counting ...\n"


def test_the_time_that_is_left_is_that_of_the_stage(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = iter([0.0, 0.0, 10.0, 100.0, 100.0, 101.0]).__next__
    monkeypatch.setattr("faultspace.base.progress.time.monotonic", clock)
    remaining: list[float | None] = []
    tell = progress.evenly(lambda stage, done=0, total=0, left=None, /: remaining.append(left))
    for call_of in (("reading", 0, 40), ("reading", 10, 40), ("counting", 5, 10), ("counting", 6, 10)):
        tell(*call_of)
    assert remaining == [None, 30.0, None, None], "a second is too short to tell from"


@pytest.mark.parametrize("width", [20, 60, 80, 140, 200])
def test_no_cell_is_cut_at_any_width(width: int) -> None:
    table = Table("name", "a value", "another")
    cells = [("one", "an-entry-that-has-no-place-to-break-it-1234567890", "3"), ("[two]", "", "x" * 70)]
    for row in cells:
        table.add_row(*map(Text, row))
    for stream in (io.StringIO(), Terminal()):
        console = Console(width=width, file=stream, markup=False, color_system=None)
        consoles.print_table(console, table)
        lines = stream.getvalue().splitlines()
        together = re.sub(r"[\s│┃]", "", stream.getvalue())
        assert all(cell in together for row in cells for cell in row) and "…" not in together
        assert "avalue" in together and "another" in together
        assert not isinstance(stream, Terminal) or max(map(len, lines)) <= width


WORDS = {
    "inspect": ["inspect", "example:paper", "example:theorem-3"],
    "compare": ["compare", "example:theorem-1-first", "example:theorem-1-second", "--word"],
    "limit": ["limit", "example:fault-follows-input"],
    "examples": ["examples"],
    "a complaint": ["verify", "--claim", "theorem-99"],
    "help": ["--help"],
}


@pytest.mark.parametrize("width", [60, 80, 120])
@pytest.mark.parametrize("name", list(WORDS))
def test_lines_are_broken_between_words(monkeypatch: pytest.MonkeyPatch, name: str, width: int) -> None:
    piped = call(*WORDS[name])
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", str(width))
    monkeypatch.setattr(progress, "PATIENCE", 3600.0)
    out, err = Terminal(), Terminal()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        assert main(WORDS[name]) == piped.code
    for stream, plain in ((out, piped.out), (err, piped.err)):
        printed = re.sub(r"\x1b\[[0-9;?]*m", "", stream.getvalue())
        assert printed.split() == plain.split(), "a word is broken"
        assert max(map(len, printed.splitlines()), default=0) <= width
        assert not any(line.endswith(" ") for line in printed.splitlines() if line not in plain.splitlines())


def test_the_lines_below_begin_below_the_first_where_there_is_room() -> None:
    def printed(width: int, label: str, text: str) -> list[str]:
        stream = Terminal()
        consoles.paragraph(Console(width=width, file=stream, markup=False, color_system=None), text, label)
        return stream.getvalue().splitlines()

    assert printed(20, "  name: ", "one two three four") == ["  name: one two", "        three four"]
    assert printed(16, "  a long name: ", "one two") == ["  a long name:", "      one two"]
    assert printed(10, "", "- one two three") == ["- one two", "  three"]
    assert printed(8, "", "0123456789 ab") == ["01234567", "89 ab"]


def test_no_color_is_respected_on_a_terminal() -> None:
    seen = {}
    for name, changes in (("plain", {"NO_COLOR": "1"}), ("coloured", {})):
        master, slave = pty.openpty()
        line = [sys.executable, "-m", "faultspace", "compare", "example:theorem-1-first", "example:theorem-1-second"]
        run = subprocess.Popen(line, stdout=slave, stderr=subprocess.DEVNULL, cwd=ROOT, env=environment(TERM="xterm", **changes))
        os.close(slave)
        seen[name] = b""
        with contextlib.suppress(OSError):  # the other end is closed
            while part := os.read(master, 4096):
                seen[name] += part
        os.close(master)
        assert run.wait() == 0
    assert b"\x1b[33m" in seen["coloured"]
    assert b"\x1b[3" not in seen["plain"] and b"different: first on 2 samples" in seen["plain"]


class Slow:
    """It is what is known of a file, whose last lines take their time."""

    def sheet(self) -> Sheet:
        time.sleep(0.3)
        return [("lag", "1")]

    def to_json(self) -> dict[str, Any]:
        time.sleep(0.3)
        return {"lag": 1}


@pytest.mark.parametrize("as_json", [True, False])
def test_what_is_computed_as_the_answer_is_written_is_told_too(
    as_json: bool, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(progress, "PATIENCE", 0.1)
    assert answer_each(["x.json"], "inspecting {}", lambda *_: FileAnswer("1 state", Slow()), as_json=as_json) == 0
    assert "faultspace: x.json: writing the answer ..." in capsys.readouterr().err


def test_the_zeros_of_a_large_system_are_counted() -> None:
    told: list[tuple[str, int, int]] = []
    system = fs.System(A=[[0, 1, 0], [0, 0, 1], [1, 0, 0]], F=[[1], [2], [1]], C=[[1, 0, 0]], G=[[0]])
    assert analyze(system, on_progress=lambda *one: told.append(one)).finite_zeros == 2
    assert told[:4] == [("zeros", k, 4) for k in (1, 2, 3, 4)]
