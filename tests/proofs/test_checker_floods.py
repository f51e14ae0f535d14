"""No file makes the checker hang, fill the memory or trace back: an answer or a refusal within 5 seconds and 400 MB.

FAULTSPACE_FLOODS=all   tries every file of `floods`; without it one in `every(40)`, and the WORST; those that cost most of all, the
                        DEAREST, are tried by a test of their own

Seconds are of the processor, measured in a process of its own for each file; on a machine that does many other things a second of it does
less, so that the test asks for no more than twice the time.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

from faultspace.proofs.rocq import export as rocq_export
from faultspace.proofs.rocq.listed import NotCovered
from faultspace.proofs.trust import checker, checker_limits, checker_structure
from tests.proofs.examples import NORMAL, RANKS, K, S, spoiled
from tests.proofs.floods import Flood, floods
from tests.thorough import every

resource = pytest.importorskip("resource")

SECONDS, MEGABYTES = 10, 400
WORST = ("window 0 0 0 4096 0", "many {},", "many keys")
DEAREST = ("stability, 80 states of 60 digits as {0}",)


class Cost(NamedTuple):
    """What the checker said about one file, its exit code, and what that took."""

    said: str
    code: int
    seconds: float
    megabytes: float


# The peak that is told of a process includes what its parent held when it forked: a small one in between starts the checker and reports.
BETWEEN = """
import json, os, subprocess, sys
running = subprocess.Popen(sys.argv[2:])
_, status, used = os.wait4(running.pid, 0)
with open(sys.argv[1], "w") as report:
    json.dump([os.waitstatus_to_exitcode(status), used.ru_utime + used.ru_stime, used.ru_maxrss], report)
"""


def cost(file: Path) -> Cost:
    """Of the checker as a command."""
    report = file.with_suffix(".cost")
    checking = [sys.executable, "-I", "-O", str(checker_limits.__file__), str(file)]
    between = [sys.executable, "-I", "-c", BETWEEN, str(report), *checking]
    said = subprocess.run(between, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=True).stdout
    code, seconds, peak = json.loads(report.read_text())
    unit = 1 if sys.platform == "darwin" else 1024
    return Cost(said, code, seconds, peak * unit / 1e6)


def code_in_time(one: Flood, file: Path) -> int:
    """Return the exit code of the checker, which has answered or refused within its bounds."""
    file.write_bytes(one.made())
    found = cost(file)
    assert "Traceback" not in found.said and found.said.startswith(str(file)), one.name
    assert found.code in (0, 1, 2, 3) and found.seconds < SECONDS and found.megabytes < MEGABYTES, (one.name, found)
    return found.code


@pytest.mark.programs
@pytest.mark.timeout(3000)
def test_floods_are_answered_or_refused_in_time(tmp_path: Path) -> None:
    step = 1 if os.environ.get("FAULTSPACE_FLOODS") == "all" else every(40)
    codes, kinds = [], set[str]()
    for i, one in enumerate(floods()):
        kinds.add(one.kind)
        if (i % step == 0 or one.name in WORST) and one.name not in DEAREST:
            codes.append(code_in_time(one, tmp_path / "flood.json"))
    assert len(codes) > 8 and set(codes) >= {0, 1, 2}
    assert kinds >= set(checker.KINDS), "every kind must be asked for more than it may do"


@pytest.mark.slow  # that the checker charges for such work, the next test sees as well
@pytest.mark.parametrize("name", DEAREST)
def test_the_dearest_floods_are_answered_or_refused_in_time(name: str, tmp_path: Path) -> None:
    code_in_time(next(one for one in floods() if one.name == name), tmp_path / "flood.json")


def test_blocks_that_have_rows_and_no_column_are_charged_for(tmp_path: Path) -> None:
    file = tmp_path / "flood.json"
    file.write_bytes(next(one for one in floods() if one.name == "toeplitz 0 0 512 600 0").made())
    assert "units of work" in cost(file).said  # 184 million steps: eight seconds, when they cost nothing


@pytest.mark.programs
def test_a_checker_that_does_not_charge_is_flooded(tmp_path: Path) -> None:
    """The measure sees what it is to see: without the bounds the same files cost more."""
    own = Path(checker_structure.__file__)
    lavish = tmp_path / own.name
    for name in (own.name, "checker_fields.py"):
        shutil.copy(own.with_name(name), tmp_path / name)
    text = Path(checker.__file__).read_text("utf-8")
    unbound = "MAX_WORK, MAX_MEMORY = 10**15, 2**60"
    (tmp_path / "checker.py").write_text(text.replace("MAX_WORK, MAX_MEMORY = 3 * 10**9, 2**27", unbound), "utf-8")
    content = next(one for one in floods() if one.name == "toeplitz 0 0 512 600 0").made()
    (tmp_path / "x.json").write_bytes(content.replace(b'"window":600', b'"window":4000'))
    limits = f"import resource as r; r.setrlimit(r.RLIMIT_AS, ({MEGABYTES}000000,) * 2); r.setrlimit(r.RLIMIT_CPU, (5, 5))\n"
    command = [sys.executable, "-I", "-c", limits]
    command[-1] += f"import sys, runpy; sys.argv[1:] = ['x.json']; runpy.run_path('{lavish}', run_name='__main__')"
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode < 0 or "not enough memory" in done.stdout
    command[-1] = command[-1].replace(str(lavish), str(own))
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert "checking takes more than" in done.stdout


def test_the_exporter_counts_its_own_work(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checker, "verify", lambda certificate: None)  # as if it had done so within its own bounds
    monkeypatch.setattr(checker, "MAX_WORK", 10_000)
    with pytest.raises(NotCovered, match="too large to be written"):
        rocq_export.exported(RANKS)
    monkeypatch.undo()
    monkeypatch.setattr(rocq_export, "MAX_TEXT", 10)
    with pytest.raises(NotCovered, match="longer than 10 characters"):
        rocq_export.exported(RANKS)


# -- numbers that are none, or look like others ---------------------------------------------------------------------------


NUMBERLIKE: tuple[str, ...] = ("\u0661", "\u00b2", "\uff11", "1_0", "0x1", "1e0", " 1", "1 ", "1\n", "1\0", "\0")
NUMBERLIKE += ("+1", "1/-1", "1/0", "1/01", "", "-", "/1", "1/")


@pytest.mark.parametrize("number", NUMBERLIKE)
def test_what_only_looks_like_a_number_is_none(number: str) -> None:
    for path in (f"{S}.A.0.0", f"{K}.0.coefficients.0.0"):
        with pytest.raises(checker.Malformed, match="expected"):
            checker.verify(spoiled(RANKS, (path, number)))


@pytest.mark.parametrize("number", ["0", "-0", "00", "-00", "0/7", "-0/7", 0, -0])
def test_zero_is_zero_however_written(number: object) -> None:
    assert checker.verify(spoiled(RANKS, (f"{S}.A.0.0", number)), [RANKS["statement"]["system"]]).assumes == []


@pytest.mark.parametrize("value", [True, False, 1.0, "1", None, [1], {"1": 1}, -1, 2**70])
def test_an_index_is_a_small_integer_and_nothing_that_equals_one(value: object) -> None:
    for path in ("witness.prime", f"{K}.0.pivot", "statement.normal_rank", "statement.left_minimal_indices.0", f"{S}.n"):
        with pytest.raises(checker.Malformed):
            checker.verify(spoiled(RANKS, (path, value)))
    with pytest.raises(checker.Malformed):
        checker.verify(spoiled(NORMAL, ("statement.experiment.s", value)))


def test_keys_that_look_alike_are_other_keys() -> None:
    text = b'{"format":"faultspace-certificate/1","kind":"window-ranks","statement":{},"witness":{},"witness\\u0000":{}}'
    with pytest.raises(checker.Malformed, match="expected an object with the keys"):
        checker.verify(checker.parse(text))
    with pytest.raises(checker.Malformed, match="a key stands twice"):
        checker.parse(b'{"a":1,"\\u0061":2}')
