"""Each program of `programs` is told as broken, in the words of its cause, or its wrong answers are; nothing that it started stays."""

from __future__ import annotations

import re
import sys
import time
from pathlib import Path

import psutil
import pytest

from faultspace.base.processes import Limits
from faultspace.numeric.audit.running import audit
from faultspace.numeric.audit.subjects.subprocess_adapter import Exec
from tests.numeric.audit.unseen.programs import PROGRAMS, Program, source

# What a report says of each: the cause, and no other trouble that comes of it.
TOLD = {
    "hangs": "no answer within",
    "trickles-and-hangs": "no answer within",
    "trickles-lines-and-hangs": "printed what is no JSON line",
    "trickles-and-eats-memory": "memory",
    "eats-memory-in-a-child": "memory",
    "floods-standard-output": "without an end of line",
    "floods-standard-error": "bytes to standard error",
    "forks-many": "processes",
    "forks-in-a-chain": "left .* behind",
    "leaves-a-daemon": "left .* behind",
    "leaves-a-child": "left .* behind",
    "ignores-the-end": "no answer within",
    "stops-itself": "no answer within",
    "closes-its-output": "ended without an answer",
    "ends-in-silence": "ended without an answer",
    "ends-after-ten": "ended without an answer",
    "answers-the-question-before": "rank",
    "answers-twice": "nobody asked for",
    "answers-half-a-line": "no answer within",
    "answers-in-another-word": "lacks ranks",
    "answers-in-text": "a number is due",
    "answers-in-fractions": "beyond the bound",
    "refuses-and-answers": "perhaps",
    "refuses-everything": "not today",
    "answers-nothing": "lacks ranks",
    "answers-null": "no JSON object",
}
# These come to the end of their memory, or to too many bytes, before the end of a longer time.
EATS = ("trickles-and-eats-memory", "eats-memory-in-a-child", "floods-standard-output", "floods-standard-error")
DAILY = (
    *("forks-in-a-chain", "forks-many", "trickles-and-eats-memory", "trickles-and-hangs"),
    *("answers-in-text", "answers-twice", "closes-its-output"),
)
SILENT = [name for name, words in TOLD.items() if words == "no answer within"]
TWO = ["window-ranks[one-fault]", "window-ranks[two-faults]"]
ASKED = {
    "ends-after-ten": ["window-ranks"],
    "answers-the-question-before": TWO,
    "answers-twice": TWO,
}  # the others show it at the first question


def marked(program: Exec) -> list[psutil.Process]:
    """Return what is left of what the program started."""
    return sorted(program._program._marked(), key=lambda one: one.pid)


@pytest.mark.parametrize(
    "one", [pytest.param(one, id=one.name, marks=() if one.name in DAILY else pytest.mark.programs) for one in PROGRAMS]
)
def test_nothing_gets_away(tmp_path: Path, one: Program) -> None:
    file = tmp_path / "program.py"
    file.write_text(source(one), "utf-8")
    seconds = 20.0 if one.name in EATS else 1.0 if one.name in SILENT else 3.0
    with Exec([sys.executable, str(file)], Limits(seconds, memory=1 << 30)) as program:
        found = audit(program, only=ASKED.get(one.name, TWO[:1]))
    assert found.failed, f"{one.wrong} Nobody noticed."
    assert any(re.search(TOLD[one.name], each.detail) for each in found.failed), found.failed
    time.sleep(0.3)
    assert marked(program) == []


def test_programs_are_told_apart_and_the_honest_one_passes(tmp_path: Path) -> None:
    assert {one.name for one in PROGRAMS} == set(TOLD) and len(PROGRAMS) == len(TOLD) >= 26
    file = tmp_path / "program.py"
    file.write_text(source(Program("honest", "Nothing.")), "utf-8")
    with Exec([sys.executable, str(file)], Limits(seconds=20.0)) as program:
        assert not audit(program, only=["window-ranks[one-fault]", "window-ranks[two-faults]"]).failed
