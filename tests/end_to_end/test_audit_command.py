"""What `faultspace audit` prints: with results made here in place of a run, at every width.

result     of a check of a function, with its kind, verdict and ratio
made       puts results in the place of the run
"""

from __future__ import annotations

import contextlib
import io
import re
from collections.abc import Callable
from dataclasses import replace

import pytest

from faultspace.cli import auditing
from faultspace.cli.command_line import main
from faultspace.numeric.audit.outcome import Audit
from faultspace.numeric.audit.records import CheckResult, Demand, Severity, Status
from tests.end_to_end.commands import call


def result(function: str, vector: str, kind: Demand, verdict: Status, ratio: float | None) -> CheckResult:
    """A check of the slug "exact-recovery" with this outcome; its bound is 1e-9."""
    got = None if ratio is None else ratio * 1e-9
    asked = ("exact-recovery", function, vector, "proposition-1", "the model is wrong", str(Severity.SILENT), str(kind), str(verdict))
    return CheckResult(*asked, "relative error of A", got, 1e-9, ratio, "", 0.1)


RESULTS = (
    result("identify", "n2-u1-p1", Demand.MUST_HOLD, Status.PASS, 0.25),
    result("identify", "n3-u1-p2-with-a-very-long-name-of-a-vector", Demand.MUST_HOLD, Status.PASS, 0.5),
    result("fault_space", "delayed", Demand.MUST_HOLD, Status.FAIL, 300.0),
    result("fault_space", "zero-outside", Demand.MUST_HOLD, Status.FAIL, 20.0),
    result("fault_space", "one-fault", Demand.FREE, Status.FAIL, 1e6),
    result("fault_space", "two-faults", Demand.MUST_HOLD, Status.NOT_OFFERED, None),
)
Made = Callable[[tuple[CheckResult, ...]], None]


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> Made:
    """The test calls it with the results of the run."""
    return lambda results: monkeypatch.setattr(auditing, "audit", lambda adapter, **settings: Audit(str(adapter), results))


def test_a_function_has_a_line_and_failures_are_told_in_words(made: Made) -> None:
    made(RESULTS)
    run = call("audit")
    assert (run.code, run.err) == (1, "")
    lines = [" ".join(line.split()) for line in run.out.splitlines()]
    assert lines[0] == "! fault_space: fail: exact-recovery[delayed]", "what failed comes first"
    assert lines[1] == "relative error of A: off by 3e-07, bound 1e-09, ratio 300"
    assert lines[3] == "again: faultspace audit None --check 'exact-recovery[delayed]-fault_space'"
    table = lines.index("function checks pass fail free largest ratio")
    assert lines[table + 1 : table + 3] == ["! fault_space 4 0 2 2 3e+02", "identify 2 2 0 0 0.5"]
    assert lines[-1] == "6 checks of identify, fault_space: 2 failed" and len(lines) == 15


def test_without_a_failure_the_code_is_0(made: Made) -> None:
    made(RESULTS[:2])
    run = call("audit")
    assert run.code == 0 and "!" not in run.out
    assert run.out.endswith("2 checks of identify: 0 failed\n")


def test_every_check_is_printed_when_asked_for(made: Made) -> None:
    made(RESULTS)
    short, slugs, long = call("audit").out, call("audit", "-v").out, call("audit", "-vv").out
    assert all(one.name in long for one in RESULTS) and RESULTS[1].name not in short and RESULTS[1].name not in slugs
    assert "exact-recovery identify 2 2 0.5" in " ".join(slugs.split())
    assert long.splitlines()[-1] == slugs.splitlines()[-1] == short.splitlines()[-1]
    assert call("audit", "--json").json == call("audit", "-v", "--json").json


def test_a_verdict_that_nobody_knew_of_has_a_column_and_an_entry_of_its_own(made: Made) -> None:
    """Pages are drawn from the list of verdicts, not from two words."""
    made((*RESULTS[:2], replace(RESULTS[0], verdict=str(Status.UNEXPECTED), vector="n9")))
    run = call("audit")
    assert "! identify: unexpected pass: exact-recovery[n9]" in run.out
    assert "function checks pass unexpected pass free largest ratio" in " ".join(run.out.split())
    assert run.code == 1


def test_nothing_is_folded_where_nobody_looks(made: Made) -> None:
    long = "n3-" + "very-" * 60 + "long"
    made((replace(RESULTS[2], vector=long, detail="it said " + "word " * 80),))
    lines = call("audit", "-vv").out.splitlines()
    assert any(long in line and "relative error of A" in line for line in lines)
    assert any(line.strip() == ("it said " + "word " * 80).strip() for line in lines)


class Window(io.StringIO):
    """It says that it is a terminal."""

    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize("width", [60, 80, 140, 200])
def test_nothing_is_cut_on_a_terminal_of_any_width(made: Made, monkeypatch: pytest.MonkeyPatch, width: int) -> None:
    made(RESULTS)
    for name, value in (("TERM", "xterm"), ("COLUMNS", str(width))):
        monkeypatch.setenv(name, value)
    window = Window()
    with contextlib.redirect_stdout(window):
        assert main(["audit", "-vv"]) == 1
    printed = re.sub(r"\x1b\[[0-9;?]*m", "", window.getvalue())
    assert max(map(len, printed.splitlines())) <= width and "…" not in printed
    together = re.sub(r"\s", "", printed)
    wanted = [*(one.name for one in RESULTS), "proposition-1", "not offered", "ratio", "largest ratio", "3e+02", "2 failed"]
    assert [text for text in wanted if re.sub(r"\s", "", text) not in together] == []
