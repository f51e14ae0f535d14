"""The checker as a command, alone in an empty folder: exit codes, what it prints, files that are no certificates."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from faultspace.proofs import certificate as make
from faultspace.proofs import checker
from tests.proofs.examples import (
    CUBED,
    HUGE,
    RANKS,
    ZERO,
    base,
    seen,
    spoiled,
)

SOURCE = Path(checker.__file__)


class Lone:
    """The checker alone in an empty folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        shutil.copy(SOURCE, folder / "checker.py")

    def file(self, name: str, content: object) -> str:
        """A file in the folder: bytes as they are, the rest as JSON."""
        (self.folder / name).write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())
        return name

    def __call__(self, *arguments: str | bytes) -> subprocess.CompletedProcess[str]:
        command: list[str | bytes] = [sys.executable, "-I", "-O", "checker.py", *arguments]
        environment = {**os.environ, "LC_ALL": "C.UTF-8"}
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, env=environment, check=False)
        assert "Traceback" not in done.stderr
        return done


@pytest.fixture
def lone(tmp_path: Path) -> Lone:
    return Lone(tmp_path)


def test_exit_codes(lone: Lone) -> None:
    good, bad = lone.file("good.json", RANKS), lone.file("bad.json", spoiled(RANKS, ("witness.prime", 4)))
    ugly = lone.file("ugly.json", b"{")
    own, foreign = lone.file("own.json", seen().to_json()), lone.file("foreign.json", ZERO.to_json())
    for arguments, code in [
        ([good], 0),
        ([good, good], 0),
        ([bad], 1),
        ([good, bad], 1),
        ([ugly], 2),
        ([ugly, bad, good], 2),
        (["--system", own, good], 0),
        (["--system", foreign, good], 1),
        (["--system", own, "--system", foreign, good], 1),
        (["--system", ugly, good], 2),
        (["--system", good, good], 2),
        (["--system"], 2),
        (["--unknown", good], 2),
        ([], 2),
        (["missing.json"], 2),
        (["."], 2),
    ]:
        assert lone(*arguments).returncode == code, arguments
    done = lone(good, bad)
    assert f"good.json: verified: window-ranks: {checker.verify(RANKS).statement}" in done.stdout
    assert f"SHA-256 {make.sha256(RANKS)}" in done.stdout
    assert "bad.json: rejected: 4 is not a prime" in done.stdout


def test_results_as_json(lone: Lone) -> None:
    done = lone("--json", lone.file("good.json", CUBED), lone.file("bad.json", []))
    good, bad = json.loads(done.stdout)
    words = checker.verify(CUBED).statement
    verified = {"file": "good.json", "result": "verified", "kind": "window-ranks", "statement": words, "assumes": []}
    verified |= {"sha256": make.sha256(CUBED)}
    assert good == verified
    assert bad["result"] == "malformed" and "expected an object" in bad["reason"]
    assert done.returncode == 2


def test_files_that_are_no_certificates(lone: Lone) -> None:
    text = json.dumps(RANKS)
    for name, content, reason in [
        ("empty", b"", "not JSON"),
        ("latin", b'{"format": "\xff"}', "not JSON"),
        ("mark", b"\xef\xbb\xbf" + text.encode(), "not JSON"),
        ("nested", b"[" * 200000, "not JSON"),
        ("nested-closed", b"[" * 200000 + b"]" * 200000, "not JSON"),
        ("float", text.replace('"normal_rank": 1', '"normal_rank": 1.0').encode(), "expected an integer"),
        ("exponent", text.replace('"normal_rank": 1', '"normal_rank": 1e0').encode(), "expected an integer"),
        ("nan", text.replace('"normal_rank": 1', '"normal_rank": NaN').encode(), "expected an integer"),
        ("infinite", text.replace('"normal_rank": 1', '"normal_rank": -Infinity').encode(), "expected an integer"),
        ("long", text.replace('"normal_rank": 1', f'"normal_rank": {HUGE}').encode(), "more digits than a number may have"),
        ("twice", text.replace('"normal_rank": 1', '"normal_rank": 1, "normal_rank": 1').encode(), "a key stands twice"),
        ("surrogate", text.replace("window-ranks", "\\ud800").encode(), "kind: unknown"),
        ("surrogate-key", text.replace('"kind"', '"\\udfff"').encode(), "expected an object"),
        ("spaces", b" " * (checker.MAX_BYTES + 1), "more than 2097152 bytes"),
    ]:
        done = lone(lone.file(name, content))
        assert done.returncode == 2, name
        assert done.stdout.startswith(f"{name}: malformed: ") and reason in done.stdout, name


def test_names_of_files_need_not_be_text(lone: Lone) -> None:
    name = b"\xff\xc3\xa9.json"
    try:
        (lone.folder / os.fsdecode(name)).write_text(json.dumps(RANKS))
    except OSError as problem:
        pytest.skip(f"no such name here: {problem}")
    assert lone(name).returncode == lone("--json", name).returncode == 0


def test_long_numbers_are_read_and_written(lone: Lone) -> None:
    large, odd = 10**19000 + 7, 10**5000 + 1
    # Beyond Python's own limit of digits, as a JSON integer and as a string.
    text = json.dumps(RANKS).replace('"A": [["0"]]', f'"A": [[{large}]]').replace('"F": [["1"]]', f'"F": [["{odd}/{large}"]]')
    kept = json.loads(json.dumps(base("left-invertible"))) | {"statement": json.loads(text)["statement"]}
    kept["statement"] = {"system": kept["statement"]["system"]}
    done = lone("--json", lone.file("large.json", kept))
    assert done.returncode == 0, done
    assert json.loads(done.stdout)[0]["sha256"] == make.sha256(kept)
