"""Each program of `programs` is told as broken, or its wrong answers are; nothing that it started is there afterwards."""

from __future__ import annotations

import sys
import time
from pathlib import Path

import psutil
import pytest

from faultspace.base.processes import Limits
from faultspace.numeric.audit.running import audit
from faultspace.numeric.audit.subjects.subprocess_adapter import Exec
from tests.numeric.audit.unseen.programs import PROGRAMS, Program, source

DAILY = ("forks-in-a-chain", "trickles-and-eats-memory", "answers-in-text", "closes-its-output")
MANY = ("ends-after-ten",)  # these are asked more than two questions


def marked(program: Exec) -> list[psutil.Process]:
    """Return what is left of what the program started."""
    return sorted(program._program._marked(), key=lambda one: one.pid)


@pytest.mark.parametrize("one", [pytest.param(one, id=one.name, marks=() if one.name in DAILY else pytest.mark.slow) for one in PROGRAMS])
def test_nothing_gets_away(tmp_path: Path, one: Program) -> None:
    file = tmp_path / "program.py"
    file.write_text(source(one), "utf-8")
    asked = ["window-ranks"] if one.name in MANY else ["window-ranks[one-fault]", "window-ranks[two-faults]"]
    with Exec([sys.executable, str(file)], Limits(seconds=3.0, memory=1 << 30)) as program:
        found = audit(program, only=asked)
    assert found.failed, f"{one.wrong} Nobody noticed."
    time.sleep(0.3)
    assert marked(program) == []


def test_programs_are_told_apart_and_the_honest_one_passes(tmp_path: Path) -> None:
    assert len({one.name for one in PROGRAMS}) == len(PROGRAMS) >= 26
    file = tmp_path / "program.py"
    file.write_text(source(Program("honest", "Nothing.")), "utf-8")
    with Exec([sys.executable, str(file)], Limits(seconds=20.0)) as program:
        assert not audit(program, only=["window-ranks[one-fault]", "window-ranks[two-faults]"]).failed
