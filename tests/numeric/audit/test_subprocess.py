"""Programs behind JSON lines: what works, and what hangs, crashes, prints garbage or forks, each told as that while the run goes on."""

from __future__ import annotations

import shutil
import sys
import time
from collections import Counter
from importlib.resources import as_file, files
from pathlib import Path
from typing import Any

import psutil
import pytest

from faultspace.base.errors import InvalidData
from faultspace.base.processes import Limits
from faultspace.numeric.audit.checks.catalogue import all_checks
from faultspace.numeric.audit.making.kinds_of_trouble import COUNT
from faultspace.numeric.audit.running import audit
from faultspace.numeric.audit.subjects.subprocess_adapter import Exec
from faultspace.numeric.audit.vectors.shipped_vectors import shipped
from faultspace.numeric.audit.vectors.trouble import default_troubles
from tests.end_to_end.commands import call, command
from tests.numeric.audit.left_behind import child, ends
from tests.thorough import THOROUGH

EXAMPLES = files("faultspace.numeric.audit").joinpath("examples")
LONG = set[str]() if THOROUGH else {"memory-grows-with-N", "time-grows-with-N"}
PREAMBLE = "import json, os, sys, time\nfor line in sys.stdin:\n    q = json.loads(line)\n    a = {}\n"
OFFER = "    if q['call'] == 'functions':\n        a = {'functions': ['fault_dimension']}\n"


def _program(tmp_path: Path, body: str) -> list[str]:
    """Return a Python program that answers by `body`, which sets `a` from `q`."""
    file = tmp_path / "program.py"
    file.write_text(f"{PREAMBLE}{OFFER}    else:\n        {body}\n    print(json.dumps(a), flush=True)\n", "utf-8")
    return [sys.executable, str(file)]


def _verdict(command: list[str], check: str = "fault-dimension[one-fault]", timeout: float = 10.0) -> Any:
    with Exec(command, Limits(seconds=timeout)) as program:
        (record,) = audit(program, only=[check])
    return record


@pytest.mark.parametrize(
    ("body", "verdict", "words"),
    [
        ("a = {'n_v': 1}", "pass", ""),
        ("a = {'n_v': 2}", "fail", "n_v"),
        ("a = {'refused': 'not today'}", "refused", "not today"),
        ("a = {'m': 1}", "broken", "lacks n_v"),
        ("print('garbage', flush=True)", "broken", "no JSON line"),
        ("a = [1]", "broken", "no JSON object"),
        ("sys.exit('out of luck')", "broken", "out of luck"),
        ("os.abort()", "broken", "ended without an answer"),
        ("while True: os.write(2, b'noise' * 100000)", "broken", "to standard error"),
        ("a = {'n_v': float('nan')}", "fail", "n_v"),
    ],
)
def test_verdicts(tmp_path: Path, body: str, verdict: str, words: str) -> None:
    record = _verdict(_program(tmp_path, body))
    assert record.verdict == verdict and words in record.detail


def test_a_program_that_hangs_is_killed_with_all_that_it_started(tmp_path: Path) -> None:
    number = tmp_path / "number"
    begun = time.monotonic()
    record = _verdict(_program(tmp_path, f"{child(number)}; time.sleep(60)"), timeout=2.0)
    assert record.verdict == "broken" and "no answer within 2 s" in record.detail
    assert time.monotonic() - begun < 10
    assert ends(number)


def test_the_run_goes_on_after_a_crash(tmp_path: Path) -> None:
    with Exec(_program(tmp_path, "a = {'n_v': 1} if len(q['r'][0]) == 3 else sys.exit(1)")) as program:
        records = audit(program, only=["fault-dimension"])
    verdicts = {record.vector: record.verdict for record in records}
    assert verdicts["longest-lag"] == "broken" and verdicts["one-fault"] == verdicts["delayed"] == "pass"


def test_what_grows_faster_than_anyone_looks_meets_the_limit_of_the_kernel(tmp_path: Path) -> None:
    with Exec(_program(tmp_path, "b = bytearray(3 << 30); a = {'n_v': 1}"), Limits(seconds=30.0, memory=200 << 20)) as program:
        (record,) = audit(program, only=["fault-dimension[one-fault]"])
    assert record.verdict == "broken" and "MemoryError" in record.detail


def test_a_process_that_is_becoming_another_program_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """For a moment after it has been started it has no environment, which was taken for that of somebody else."""
    number, read, looks = tmp_path / "number", psutil.Process.environ, Counter[int]()

    def environ(process: psutil.Process) -> dict[str, str]:
        looks[process.pid] += 1
        becoming = number.exists() and number.read_text() == str(process.pid) and looks[process.pid] <= 2
        return {} if becoming else read(process)

    monkeypatch.setattr(psutil.Process, "environ", environ)
    record = _verdict(_program(tmp_path, f"{child(number)}; a = {{'n_v': 1}}"))
    assert record.verdict == "broken" and "left 1 process behind" in record.detail and ends(number)


def test_nan_crosses_as_a_string(tmp_path: Path) -> None:
    """Strict JSON both ways: the program sees "NaN" and refuses."""
    body = "a = {'refused': 'NaN'} if any('NaN' in row for row in q['r']) else {'n_v': 1}"
    assert _verdict(_program(tmp_path, body), "refuses-nan-residual").verdict == "pass"


def test_what_does_not_speak_the_protocol() -> None:
    for program in ("no-such-program-anywhere", [sys.executable, "-c", "print('hello')"], [sys.executable, "-c", ""]):
        with pytest.raises(InvalidData, match="the program"):
            Exec(program, Limits(seconds=5.0))
    silly = [sys.executable, "-c", 'input(); print(\'{"functions": ["sing"]}\', flush=True); input()']
    with pytest.raises(InvalidData, match="sing"):
        Exec(silly, Limits(seconds=5.0))


@pytest.mark.programs
@pytest.mark.parametrize(("shell", "name"), [("octave-cli", "adapter.m"), ("sh", "adapter.sh")])
def test_the_examples_pass(shell: str, name: str) -> None:
    found = shutil.which(shell)
    if found is None:
        pytest.skip(f"no {shell} here")
    with as_file(EXAMPLES.joinpath(name)) as path, Exec([found, *(["--quiet"] if name.endswith(".m") else []), str(path)]) as program:
        # How long awk takes for long records is nothing to look at every day.
        asked = {check.slug for check in all_checks() if hasattr(program, check.function)}
        records = audit(program, only=sorted(asked - LONG if name == "adapter.sh" else asked))
    assert len(records) > 20 and [record.name for record in records if record.failed] == []


def test_the_command(tmp_path: Path) -> None:
    mine = tmp_path / "mine.py"
    mine.write_text("class Mine:\n    def fault_dimension(self, r):\n        return 1\n", "utf-8")
    run = command("audit", f"{mine}:Mine", "--check", "fault-dimension", "--json")  # the others run in this process
    document = run.json
    several = {one.slug for one in shipped("faults") if one.n_v > 1}
    several |= {one.kind for one in default_troubles() if COUNT in one.asks and one.faults and one.faults.n_v != 1}
    assert run.code == 1 and document["failed"] == len(several)
    assert {one["vector"] for one in document["records"] if one["failed"]} == several > {"two-faults", "bad-units", "nearly-one-fault"}
    run = call("audit", "--check", "fault-dimension")
    assert run.code == 0 and "checks of fault_dimension: 0 failed" in run.out and "Traceback" not in run.err
    run = call("audit", f"{mine}:Mine", "--check", "fault-dimension[two-faults]")
    assert run.code == 1 and f"faultspace audit {mine}:Mine --check 'fault-dimension[two-faults]-fault_dimension'" in run.out
    run = call("audit", f"{mine}:Mine", "--check", "fault-space")
    assert run.code == 2 and "asks fault_space" in run.err


@pytest.mark.parametrize(
    "arguments",
    [
        ("no.module:x",),
        ("math",),
        ("--check", "zork"),
        ("math", "--exec", "cat"),
        ("--exec", "cat"),
        ("--exec", ""),
        ("--exec", "'"),
        ("",),
        ("--peer", "none"),
    ],
)
def test_bad_input_is_told_in_one_line(arguments: tuple[str, ...]) -> None:
    run = call("audit", *arguments)
    assert run.code == 2 and run.out == ""
    *progress, complaint = run.err.splitlines()
    assert complaint.startswith("faultspace: ") and all(line.endswith(" ...") for line in progress)


@pytest.mark.parametrize(("passed", "faults"), [((), 1), (("SECRET_KEY",), 2), ("SECRET_KEY", 2), (("*",), 2)])
def test_a_program_sees_of_the_environment_what_it_needs_and_what_is_passed_on(
    passed: tuple[str, ...], faults: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SECRET_KEY", "1")
    program = _program(tmp_path, "a = {'n_v': 2 if 'SECRET_KEY' in os.environ else 1}")
    (record,) = audit(command=program, only=["fault-dimension[one-fault]"], environment=passed)
    assert record.verdict == ("pass" if faults == 1 else "fail")


def test_an_adapter_in_python_sees_no_more_of_the_environment_unless_asked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SECRET_KEY", "1")
    file = tmp_path / "adapter.py"
    file.write_text("import os\ndef fault_dimension(r):\n    return 2 if 'SECRET_KEY' in os.environ else 1\n", "utf-8")
    for more, code in ((), 0), (("--env", "SECRET_KEY"), 1):
        assert call("audit", str(file), "--check", "fault-dimension[one-fault]", *more).code == code


def test_names_of_variables_are_texts() -> None:
    nonsense: Any = [3]
    with pytest.raises(InvalidData, match="environment: got"):
        audit(environment=nonsense)
