"""The checker is tested as a command, in an empty folder, its core alone or all files: exit codes, what it prints, no certificates."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from faultspace.exact.algebra.fields import QQ, PrimeField
from faultspace.proofs.trust import checker
from faultspace.proofs.trust import structure_certificates as make
from tests.proofs.examples import (
    CUBED,
    GENERIC,
    GONE,
    HINTED,
    HUGE,
    INVERTIBLE,
    LEADING,
    RANKS,
    SAME,
    SPACE,
    ZERO,
    base,
    seen,
    spoiled,
    systems,
)

SOURCE = Path(checker.__file__)
FILES = ("checker.py", "checker_fields.py", "checker_structure.py", "checker_limits.py")  # each needs those before it


class Lone:
    """This is the core of the checker alone in an empty folder or, with its name, another file with those that it needs."""

    def __init__(self, folder: Path, program: str = "checker.py") -> None:
        self.folder, self.program = folder, program
        for name in FILES[: FILES.index(program) + 1]:
            shutil.copy(SOURCE.with_name(name), folder / name)

    def file(self, name: str, content: object) -> str:
        """Return a file in the folder: bytes as they are, the rest as JSON."""
        (self.folder / name).write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())
        return name

    def __call__(self, *arguments: str | bytes) -> subprocess.CompletedProcess[str]:
        command: list[str | bytes] = [sys.executable, "-I", "-O", self.program, *arguments]
        environment = {**os.environ, "LC_ALL": "C.UTF-8"}
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, env=environment, check=False)
        assert "Traceback" not in done.stderr and "Exception" not in done.stderr
        return done


@pytest.fixture
def lone(tmp_path: Path) -> Lone:
    return Lone(tmp_path)


@pytest.fixture
def whole(tmp_path: Path) -> Lone:
    return Lone(tmp_path, FILES[-1])


def test_exit_codes(lone: Lone) -> None:
    good, bad = lone.file("good.json", HINTED), lone.file("bad.json", spoiled(HINTED, ("witness.prime", 4)))
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
    assert f"good.json: verified: window-ranks: {checker.verify(HINTED).statement}" in done.stdout
    assert f"SHA-256 {make.sha256(HINTED)}" in done.stdout
    assert "bad.json: rejected: 4 is not a prime" in done.stdout


def test_results_as_json(whole: Lone) -> None:
    done = whole("--json", whole.file("good.json", CUBED), whole.file("bad.json", []))
    good, bad = json.loads(done.stdout)
    words = checker.verify(CUBED).statement
    verified = {"file": "good.json", "result": "verified", "kind": "window-ranks", "statement": words, "assumes": []}
    verified |= {"sha256": make.sha256(CUBED)}
    assert good == verified
    assert bad["result"] == "malformed" and "expected an object" in bad["reason"]
    assert done.returncode == 2


def test_files_that_are_no_certificates(lone: Lone) -> None:
    text = json.dumps(HINTED)
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
        ("long", text.replace('"normal_rank": 1', f'"normal_rank": {HUGE}').encode(), " digits"),
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
        (lone.folder / os.fsdecode(name)).write_text(json.dumps(HINTED))
    except OSError as problem:
        pytest.skip(f"no such name here: {problem}")
    assert lone(name).returncode == lone("--json", name).returncode == 0


def test_long_numbers_are_read_and_written(lone: Lone) -> None:
    large, odd = 10**19000 + 7, 10**5000 + 1
    # Beyond Python's own limit of digits, as a JSON integer and as a string.
    text = json.dumps(HINTED).replace('"A": [["0"]]', f'"A": [[{large}]]').replace('"F": [["1"]]', f'"F": [["{odd}/{large}"]]')
    kept = json.loads(json.dumps(INVERTIBLE)) | {"statement": json.loads(text)["statement"]}
    kept["statement"] = {"system": kept["statement"]["system"]}
    done = lone("--json", lone.file("large.json", kept))
    assert done.returncode == 0, done
    assert json.loads(done.stdout)[0]["sha256"] == make.sha256(kept)


ASSUMED = spoiled(CUBED, ("witness.irreducible", GONE))


def test_what_is_verified_under_an_assumption_names_it_and_exits_with_3(whole: Lone) -> None:
    lone, good = whole, whole.file("good.json", HINTED)
    assumed = lone.file("assumed.json", ASSUMED)
    bad, ugly = lone.file("bad.json", spoiled(HINTED, ("witness.prime", 4))), lone.file("ugly.json", b"{")
    for arguments, code in [([assumed], 3), ([good, assumed], 3), ([assumed, good], 3), ([assumed, bad], 1), ([assumed, ugly], 2)]:
        assert lone(*arguments).returncode == code, arguments
    (found,) = json.loads(lone("--json", assumed).stdout)
    assert found["result"] == "verified under an assumption"
    assert found["assumes"] == ["f is irreducible, with the coefficients [1,-3,-1,4] (ascending)"]
    assert "assumed.json: verified under an assumption: window-ranks: assuming f irreducible: " in lone(assumed).stdout


def test_pipes_devices_and_directories_are_refused_without_waiting(lone: Lone) -> None:
    os.mkfifo(lone.folder / "pipe")
    os.symlink("pipe", lone.folder / "link")
    good = lone.file("good.json", HINTED)
    for name in ("pipe", "link", "/dev/zero", "/dev/stdin", "/dev/tty", "/proc/self/mem", "/proc/self/task", "."):
        if not name.startswith("/") or Path(name).exists():
            done = lone(name, good)  # the checker would be ended by the limit of the test, were it to wait
            assert done.returncode == 2 and ": malformed: " in done.stdout and ": verified: " in done.stdout, name
            assert lone("--system", name, good).returncode == 2, name
    assert "no regular file, but a pipe or a device" in lone("pipe").stdout
    assert "is a directory" in lone(".").stdout


@pytest.mark.parametrize("arguments", [[], ["--json"]])
def test_output_that_nobody_takes_is_no_rejection(lone: Lone, arguments: list[str]) -> None:
    names = [lone.file(f"{i}.json", HINTED) for i in range(3)]
    command = [sys.executable, "-I", "-O", "checker.py", *arguments, *names]
    read, write = os.pipe()
    os.close(read)
    closed = subprocess.run(command, cwd=lone.folder, stdout=write, stderr=subprocess.PIPE, text=True, check=False)
    os.close(write)
    assert (closed.returncode, closed.stderr) == (74, "")
    none = subprocess.run(["sh", "-c", f"{' '.join(command)} >&-"], cwd=lone.folder, stderr=subprocess.PIPE, text=True, check=False)
    assert (none.returncode, none.stderr) == (74, "")
    if Path("/dev/full").exists():
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run(command, cwd=lone.folder, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        assert (done.returncode, done.stderr) == (74, "")


def test_names_of_files_cannot_pass_for_answers(lone: Lone) -> None:
    for name in ("a\x1b[2J", "a\nb: verified: window-ranks", "b.json: verified: all is well", "\u202egnp", "a b", "'", "\x7f"):
        lone.file(name, b"{")
        done = lone(name)
        assert done.returncode == 2
        (line,) = done.stdout.splitlines()
        assert line.isprintable() and line.startswith(f"{name!a}: malformed: "), line
        assert json.loads(lone("--json", name).stdout)[0]["file"] == name
    for arguments in (["--\x1b[2J"], ["--system", "\x1b[2J", "x"]):
        done = lone(*arguments)
        assert done.returncode == 2 and done.stdout == "" and "\x1b" not in done.stderr


def test_no_two_systems_are_told_by_the_same_words() -> None:
    words = set()
    dense = [[(7 * i + 3 * j) % 10 for j in range(20)] for i in range(20)]
    for i, j in ((0, 0), (10, 10), (19, 19)):
        for change in (0, 1, 2):
            G = [list(row) for row in dense]
            G[i][j] = 10 + change
            about = checker.subject({"A": [], "F": [], "C": [[]] * 20, "G": G, "n": 0, "m": 20, "p": 20})
            words.add(about.words)
            assert len(about.words) < 2000
    assert len(words) == 9
    small = [system.to_json() for system in systems(QQ)]
    assert len({checker.subject(system).words for system in small}) == len({json.dumps(system) for system in small})


def test_each_file_has_the_whole_of_the_work(lone: Lone, monkeypatch: pytest.MonkeyPatch) -> None:
    large, good = spoiled(HINTED, ("statement.system.A.0.0", "7" * 19_000)), lone.file("good.json", HINTED)
    names = [lone.file("large.json", large), good, good]
    paths = [str(lone.folder / name) for name in names]
    checker.verify(HINTED)
    monkeypatch.setattr(checker, "MAX_WORK", int(checker._meter.get().work * 1.5))
    insisted = [checker.subject(seen().to_json())]
    assert [checker.result_of(path, insisted)["result"] for path in paths] == ["rejected", "verified", "verified"]
    for _ in range(3):  # what is read outside of a certificate is charged to itself
        checker.subject(seen().to_json())
        assert checker.verify(HINTED, [seen().to_json()]).assumes == []


def test_a_kind_carries_its_proof() -> None:
    for name, kind in checker.KINDS.items():
        assert kind.proof.endswith(".") and 40 < len(kind.proof) < 200, name


NULLED = spoiled(GENERIC, ("witness.nulling", {"states": [], "faults": [], "motion": []}))
OTHER = "here: {} decides it, which is another file"
# A certificate, the file that decides it, and what the files before that one say of it.
BELONGS: dict[str, tuple[Any, int, str]] = {
    "ranks": (HINTED, 0, ""),
    "point": (INVERTIBLE, 0, ""),
    "no-hints": (RANKS, 1, "without a point it is for checker_fields.py, which is another file"),
    "no-point": (base("left-invertible"), 1, "without a point it is for checker_fields.py"),
    "nulling": (NULLED, 2, "nulling is for checker_structure.py, which is another file"),
    "prime-field": (base("window-ranks", PrimeField(3)), 1, "GF(p) and Q(a) are read by checker_fields.py, which is another file"),
    "number-field": (CUBED, 1, "GF(p) and Q(a) are read by checker_fields.py, which is another file"),
    "window": (SAME, 1, OTHER.format(FILES[1])),
    "space": (SPACE, 2, OTHER.format(FILES[2])),
    "line": (base("left-invertible-line"), 2, OTHER.format(FILES[2])),
    "zeros": (base("finite-zeros"), 3, OTHER.format(FILES[3])),
    "limit": (LEADING, 3, OTHER.format(FILES[3])),
}


@pytest.mark.parametrize("program", FILES)
def test_each_file_of_the_checker_decides_its_kinds_beside_those_before_it(program: str, tmp_path: Path) -> None:
    lone = Lone(tmp_path, program)
    answers = json.loads(lone("--json", *(lone.file(name, one) for name, (one, _, _) in BELONGS.items())).stdout)
    for answer, (_, first, words) in zip(answers, BELONGS.values(), strict=True):
        if first <= FILES.index(program):
            assert answer["result"] == "verified", answer
        else:
            assert answer["result"] == "malformed" and words in answer["reason"], answer


def test_every_kind_is_named_with_its_file() -> None:
    named = [name for names in checker.ELSEWHERE.values() for name in names.split()]
    assert len(named) == len({*named}) and {*named} < {*checker.KINDS}
    core = {"window-ranks", "left-invertible", "behaviour-inclusion", "behaviour-equality"}
    assert {*checker.KINDS} - {*named} == core
