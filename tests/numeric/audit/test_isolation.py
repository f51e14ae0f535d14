"""A named adapter that hangs, crashes, prints, forks or exhausts memory is told as that, and the next check goes on."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from faultspace.base.errors import InvalidData
from faultspace.numeric.audit.outcome import Audit
from faultspace.numeric.audit.records import Broken
from faultspace.numeric.audit.running import audit, parametrize_with_checks
from faultspace.numeric.audit.subjects import worker
from faultspace.numeric.audit.subjects.isolation import Isolated
from tests.numeric.audit.left_behind import child, ends

REFERENCE = "faultspace.numeric.audit.reference"
ONE, TWO = "fault-dimension[one-fault]", "fault-dimension[two-faults]"


def _adapter(tmp_path: Path, body: str, head: str = "") -> str:
    """Return an adapter that is right for three outputs and one fault after `body`, which runs for the vector of one fault alone."""
    lines = [
        "import ctypes, os, sys, time",
        "import numpy as np",
        head,
        "def fault_dimension(r):",
        "    from faultspace.numeric.audit.reference import fault_dimension as right",
        "    n_v = right(r)",
        "    if n_v == 1:",
        *(f"        {line}" for line in body.splitlines()),
        "    return n_v",
    ]
    file = tmp_path / "mine.py"
    file.write_text("\n".join(lines) + "\n", "utf-8")
    return str(file)


@pytest.mark.parametrize(
    ("body", "verdict", "words"),
    [  # limits of time and memory, streams and codes are questions of the program alone, of `test_subprocess.py` and `unseen`
        pytest.param("pass", "pass", "", marks=pytest.mark.slow),
        ("os.abort()", "broken", "SIGABRT"),
        pytest.param("ctypes.string_at(0)", "broken", "SIGSEGV", marks=pytest.mark.slow),
        ("sys.exit(0)", "broken", "SystemExit(0)"),
        ("print('garbage'); os.write(1, b'garbage\\n'); sys.stdout.flush()", "pass", ""),
        pytest.param("sys.stdin.readline()", "pass", "", marks=pytest.mark.slow),
        ("os.fork()", "broken", "forked"),
        pytest.param("np.ones(1 << 50)", "broken", "MemoryError", marks=pytest.mark.slow),
        pytest.param("raise KeyboardInterrupt", "broken", "ended without an answer", marks=pytest.mark.slow),
    ],
)
def test_what_breaks_is_told_and_the_run_goes_on(tmp_path: Path, body: str, verdict: str, words: str) -> None:
    name = _adapter(tmp_path, body)
    first, second = audit(name, only=[ONE, TWO], seconds=60.0, gibibytes=0.5)
    assert (first.name, first.verdict) == (ONE, verdict) and words in first.detail
    assert (second.name, second.verdict) == (TWO, "pass")


def test_a_process_left_behind_ends_with_the_audit(tmp_path: Path) -> None:
    number = tmp_path / "number"
    first, second = audit(_adapter(tmp_path, child(number)), only=[ONE, TWO])
    assert first.verdict == "broken" and "left 1 process behind" in first.detail and ends(number) and second.verdict == "pass"


def test_a_process_that_no_parent_and_no_session_leads_to_is_found_by_its_mark(tmp_path: Path) -> None:
    """It forks twice and leaves the session at once, as daemons do."""
    number = tmp_path / "number"
    written = f"open({str(number)!r}, 'w').write(str(os.getpid()))"
    grand = f"import os, time; os.setsid(); {written} if not os.fork() else os._exit(0); time.sleep(60)"
    body = f"import subprocess; subprocess.run([sys.executable, '-c', {grand!r}]); time.sleep(0.3)"
    (record,) = audit(_adapter(tmp_path, body), only=[ONE])
    assert record.verdict == "broken" and "left 1 process behind" in record.detail and ends(number)


def test_what_ends_soon_after_the_answer_is_not_left_behind(tmp_path: Path) -> None:
    body = "import subprocess; subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(0.1)'])"
    (record,) = audit(_adapter(tmp_path, body), only=[ONE])
    assert record.verdict == "pass"


def test_an_adapter_that_loads_once_only_breaks_what_comes_after(tmp_path: Path) -> None:
    mark = tmp_path / "once"
    head = f"import pathlib\nmark = pathlib.Path({str(mark)!r})\nassert not mark.exists(), 'one licence'\nmark.touch()"
    first, second = audit(_adapter(tmp_path, "os.abort()", head=head), only=[ONE, TWO])
    assert (first.verdict, second.verdict) == ("broken", "broken") and "one licence" in second.detail


def test_the_same_records_with_and_without_a_process_of_its_own() -> None:
    import faultspace.numeric.audit.reference as reference

    def parts(found: Audit) -> list[Any]:
        return [(one.name, one.function, one.verdict, one.got, one.bound) for one in found]

    only = ["fault-dimension", "normal-rank", "refuses-nan-output"]
    here, apart = audit(reference, only=only), audit(REFERENCE, only=only)
    assert parts(here) == parts(apart) and here.adapter == apart.adapter == audit(only=only).adapter == REFERENCE


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1 / 0", "ZeroDivisionError"),
        ("import no_such_package", "no_such_package"),
        ("from . import other", "name its module instead"),
        ("identity = 1", "none of the functions"),
    ],
)
def test_what_the_worker_cannot_load(tmp_path: Path, text: str, words: str) -> None:
    file = tmp_path / "broken.py"
    file.write_text(text + "\n", "utf-8")
    assert words in worker._loaded(str(file), {})["invalid"]


@pytest.mark.parametrize(("text", "words"), [("import no_such_package", "no_such_package"), ("import os; os._exit(1)", "ended without")])
def test_what_cannot_be_loaded(tmp_path: Path, text: str, words: str) -> None:
    file = tmp_path / "broken.py"
    file.write_text(text + "\n", "utf-8")
    with pytest.raises(InvalidData, match=words):
        Isolated(str(file))


def test_what_lies_beside_the_adapter_can_be_imported(tmp_path: Path) -> None:
    (tmp_path / "beside_it.py").write_text("ONE = 1\n", "utf-8")
    name = _adapter(tmp_path, "return beside_it.ONE", head="import beside_it")
    (record,) = audit(name, only=[ONE])
    assert record.verdict == "pass"


def test_a_module_in_the_present_folder_stands_in_for_none_of_ours(tmp_path: Path) -> None:
    (tmp_path / "json.py").write_text("raise RuntimeError('wrong json')\n", "utf-8")
    run = subprocess.run(
        [sys.executable, "-P", "-m", "faultspace", "audit", "--check", ONE], cwd=tmp_path, capture_output=True, text=True, timeout=60
    )
    assert run.returncode == 0, run.stderr


def test_the_pytest_face_takes_a_name(tmp_path: Path) -> None:
    decorated: Any = parametrize_with_checks(_adapter(tmp_path, "os.abort()"), seconds=20.0)
    cases = {case.id: case.values[0] for case in decorated.args[1]}
    # A crash is no AssertionError, which xfail would take for the failure that was expected.
    with pytest.raises(Broken, match="SIGABRT"):
        cases[f"{ONE}-fault_dimension"]()
    cases[f"{TWO}-fault_dimension"]()
