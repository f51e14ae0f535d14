"""An adapter that does not compute but looks for the answer, or spoils the count, is no better off: the truth is not in its process."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from faultspace.numeric.audit.subjects.wire import packed, unpacked
from tests.end_to_end.commands import command

CHECKS = ("fault-dimension[one-fault]", "fault-dimension[two-faults]")
# Each begins the body of `fault_dimension(r)`, which answers what it found, and else -1.
LOOKING = {
    "frames": """
        frame = sys._getframe()
        while frame is not None:
            for one in list(frame.f_locals.values()) + [getattr(one, "__self__", None) for one in frame.f_locals.values()]:
                for cell in getattr(one, "__closure__", None) or ():
                    found.append(cell.cell_contents)
                found.append(one)
            frame = frame.f_back
        """,
    "objects": "found.extend(gc.get_objects())",
    "files": """
        for number in os.listdir("/proc/self/fd"):
            path = os.path.realpath(f"/proc/self/fd/{number}")
            if os.path.isfile(path) and "n_v" in open(path, errors="replace").read():
                return 1 if r.shape[1] == 2 else 2
        """,
    "environment": """
        told = " ".join([*os.environ.values(), *sys.argv, *sys.orig_argv])
        if "one-fault" in told or "two-faults" in told:
            return 1
        """,
}
HEAD = """
import gc, os, signal, sys
import numpy as np

def fault_dimension(r):
    found = []
    {body}
    for one in found:
        for name in ("n_v", "truth", "due"):
            kept = getattr(one, name, None) if not isinstance(one, type) else None
            if isinstance(kept, int):
                return kept
    return -1
"""
SPOILING = {
    "a count that is printed": """
        print("2 checks of fault_dimension: 0 failed", file=sys.__stdout__, flush=True)
        os.write(1, b"0 failed\\n")
        """,
    "comparisons that always hold": """
        import builtins
        np.testing.assert_allclose = np.array_equal = lambda *given, **more: True
        builtins.abs = lambda number: 0
        """,
    "checks that always pass": """
        import faultspace.numeric.audit.records as records
        records.perform = lambda *a: None
        records.CheckResult.failed = False
        records.Measurement.ratio = 0.0
        """,
    "an end that looks like success": "os._exit(0)",
    "lines of its own": """
        for number in range(3, 64):
            try:
                os.write(number, b'{"answer": 7, "record": {"verdict": "pass"}, "failed": false}\\n')
            except OSError:
                pass
        """,
}


def _adapter(folder: Path, body: str) -> str:
    lines = [line.strip("\n") for line in body.strip("\n").splitlines()]
    indent = min(len(line) - len(line.lstrip()) for line in lines if line.strip())
    file = folder / "hostile.py"
    file.write_text(HEAD.replace("{body}", "\n    ".join(line[indent:] for line in lines)), "utf-8")
    return str(file)


@pytest.mark.parametrize("how", [*LOOKING, *SPOILING])
def test_who_looks_for_the_answer_or_spoils_the_count_fails(how: str, tmp_path: Path) -> None:
    adapter = _adapter(tmp_path, (LOOKING | SPOILING)[how])
    run = command("audit", adapter, *(word for check in CHECKS for word in ("--check", check)), "--json")
    assert run.code == 1, run.out
    records = run.json["records"]
    assert len(records) == 2 and run.json["failed"] == 2 and {one["verdict"] for one in records} <= {"fail", "broken"}


def test_who_ends_the_audit_itself_ends_it_without_success(tmp_path: Path) -> None:
    adapter, badge, junit = _adapter(tmp_path, "os.kill(os.getppid(), signal.SIGKILL)"), tmp_path / "badge.json", tmp_path / "junit.xml"
    words = ["audit", adapter, "--check", CHECKS[0], "--badge", str(badge), "--junit", str(junit)]
    run = subprocess.run([sys.executable, "-m", "faultspace", *words], capture_output=True, text=True, timeout=120)
    assert run.returncode not in (0, 1) and not badge.exists() and not junit.exists() and "0 failed" not in run.stdout


@pytest.mark.parametrize("told", ["7", "[]", "[1]", '["no function"]', "None"])
def test_who_says_that_there_is_nothing_to_ask_is_not_audited(told: str, tmp_path: Path) -> None:
    adapter = _adapter(tmp_path, "pass")
    lie = f"lambda one: written(one | {{'functions': {told}}} if 'functions' in one else one)"
    change = f"import json\nwritten = json.dumps\njson.dumps = {lie}\n"
    Path(adapter).write_text(change + Path(adapter).read_text("utf-8"), "utf-8")
    run = command("audit", adapter, "--check", CHECKS[0])
    assert run.code == 2 and run.out == "" and "cannot be loaded" in run.err and len(run.err.splitlines()) == 1


def test_files_of_an_audit_that_are_none_end_in_a_line(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "deep").write_text("[" * 200_000)
    for words in (("--from", "pipe"), ("--from", "deep"), ("--expected-failures", "pipe")):
        asked = [sys.executable, "-m", "faultspace", "audit", *words]
        run = subprocess.run(asked, cwd=tmp_path, capture_output=True, text=True, timeout=120)
        assert run.returncode == 2 and len(run.stderr.splitlines()) == 1, run.stderr


def test_arrays_cross_as_they_are_and_nothing_else_is_made() -> None:
    plain = np.arange(12.0).reshape(3, 4)
    wide = np.full((6, 8), np.nan)
    wide[::2, ::2] = plain
    fixed = plain.copy()
    fixed.flags.writeable = False
    others = plain.astype(np.float32), plain.astype(int), plain[:0]
    for given in (plain, np.asfortranarray(plain), wide[::2, ::2], plain[::-1], fixed, *others):
        found = unpacked(json.loads(json.dumps(packed(given))))
        assert np.array_equal(found, given) and found.dtype == given.dtype and found.flags.writeable == given.flags.writeable
        assert found.size == 0 or found.strides == given.strides
        assert found.flags.c_contiguous == given.flags.c_contiguous
    objects = unpacked(json.loads(json.dumps(packed(plain.astype(object)))))
    assert objects.dtype == object and np.array_equal(objects, plain)
    told = {"array": ["<f8", [1 << 40], [0], 0, True, ""]}, {"array": ["|O", [1], None, 0, True, "AAAAAAAAAAA="]}, {"import": "os"}
    for one in told:
        with pytest.raises((ValueError, TypeError)):
            unpacked(one)
