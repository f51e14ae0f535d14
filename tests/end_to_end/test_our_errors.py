"""An error of ours is told as one: a line asks for a report and says what belongs into it, code 70, no traceback unless asked for."""

from __future__ import annotations

import re

import pytest

from faultspace import __version__
from faultspace.cli import failures
from tests.end_to_end.commands import Run, call


def broken(*_: object, **__: object) -> object:
    """This does what a function of ours does that has an error in it."""
    raise KeyError("no such\nkey")


BROKEN = {
    "inspect": ("faultspace.cli.inspecting.analyze", ["inspect", "example:zeros"]),
    "inspect --json": ("faultspace.cli.inspecting.analyze", ["inspect", "example:zeros", "--json"]),
    "compare": ("faultspace.cli.comparing.compare", ["compare", "example:zeros", "example:zeros"]),
    "limit": ("faultspace.cli.limiting.limit", ["limit", "example:independent-fault"]),
    "audit": ("faultspace.cli.auditing.audit", ["audit"]),
    "verify": ("faultspace.cli.verifying.verify", ["verify"]),
    "examples": ("faultspace.cli.example_listing.answers", ["examples"]),
    "before a command": ("faultspace.cli.command_line.parser", ["--version"]),
}


def asks_for_a_report(run: Run) -> bool:
    """Return one line on standard error with what broke, where, the version, and what to send; nothing on standard output."""
    (line,) = run.err.splitlines()
    parts = ("KeyError", "no such", "in broken", "test_our_errors.py", "report", "command line", f"faultspace {__version__}", "Python 3")
    return run.code == 70 and run.out == "" and all(part in line for part in parts) and failures.TRACEBACK in line


@pytest.mark.parametrize("name", list(BROKEN))
def test_a_broken_command_asks_for_a_report(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.delenv(failures.TRACEBACK, raising=False)
    place, arguments = BROKEN[name]
    monkeypatch.setattr(place, broken)
    assert asks_for_a_report(call(*arguments))


def test_the_traceback_comes_where_it_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(failures.TRACEBACK, "1")
    monkeypatch.setattr("faultspace.cli.inspecting.analyze", broken)
    run = call("inspect", "example:zeros")
    assert run.code == 70 and run.err.startswith("Traceback") and re.search(r"line \d+, in broken", run.err)
    assert "please report it" in run.err.splitlines()[-1]


def test_a_file_of_ours_that_is_missing_is_no_trouble_with_the_output(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(*_: object, **__: object) -> object:
        return open("/no/such/file/of/ours")

    monkeypatch.setattr("faultspace.cli.inspecting.analyze", missing)
    run = call("inspect", "example:zeros")
    assert run.code == 70 and "FileNotFoundError" in run.err and "standard output" not in run.err


def test_a_long_message_leaves_room_for_the_request(monkeypatch: pytest.MonkeyPatch) -> None:
    def talkative(*_: object, **__: object) -> object:
        raise RuntimeError("x" * 10_000)

    monkeypatch.setattr("faultspace.cli.inspecting.analyze", talkative)
    run = call("inspect", "example:zeros")
    assert run.code == 70 and "please report it" in run.err and __version__ in run.err and len(run.err) < 1300
