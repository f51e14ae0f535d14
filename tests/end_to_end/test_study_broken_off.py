"""Whatever stops `faultspace monte-carlo`, its cases are kept, --resume ends with the same bytes, and nothing is left behind."""

from __future__ import annotations

import json
import os
import random
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress
from pathlib import Path

import numpy as np
import psutil
import pytest

from faultspace.base.errors import InvalidInput
from faultspace.cli import studying
from faultspace.numeric.study.groups import Plan
from faultspace.numeric.study.keeping import LOCK, TEMPORARY, UNFINISHED, Settings, keeping
from faultspace.numeric.study.studies import PUBLISHED, STUDIES
from faultspace.numeric.study.study_cases import Case, published_case
from tests.end_to_end.commands import PROGRESS, ROOT, Run, call, environment
from tests.end_to_end.test_monte_carlo import validator

# Thirty samples are refused by most estimators, which is quick, and not by all, so that there are numbers, too.
ARGUMENTS = ("monte-carlo", "--samples", "30", "--seed", "5")
FEW, ENOUGH = "8", "24"  # systems; of these as corrected two processes are started
PATIENCE = 120.0


@pytest.fixture
def without_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(studying, "_draw", lambda studies, folder: None)


def study(out: Path, *more: str, systems: str = FEW) -> Run:
    return call(*ARGUMENTS, "--systems", systems, "--jobs", "1", "--out", str(out), *more)


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def started(out: Path, *more: str, systems: str = FEW) -> subprocess.Popen[str]:
    line = [sys.executable, "-m", "faultspace", *ARGUMENTS, "--systems", systems, "--out", str(out), *more]
    return subprocess.Popen(
        line, cwd=ROOT, env=environment(), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, preexec_fn=hear_signals
    )


def hear_signals() -> None:
    """What a shell starts in the background ignores SIGINT, and so would what the tests start there."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def wait_for_cases(out: Path, process: subprocess.Popen[str], count: int) -> None:
    """Wait until so many cases are kept."""
    deadline = time.monotonic() + PATIENCE
    while process.poll() is None and time.monotonic() < deadline:
        with suppress(OSError):
            if (out / UNFINISHED).read_bytes().count(b"\n") > count:
                return
        time.sleep(0.005)
    pytest.fail(f"{count} cases did not come; the code is {process.returncode}")


def gone(processes: list[psutil.Process]) -> bool:
    return not psutil.wait_procs(processes, timeout=20)[1]


def complaints(process: subprocess.Popen[str]) -> list[str]:
    return [line for line in process.communicate(timeout=PATIENCE)[1].splitlines() if not PROGRESS.fullmatch(line)]


@pytest.mark.usefixtures("without_figures")
def test_a_run_that_was_killed_goes_on_and_its_children_end(tmp_path: Path) -> None:
    """Two processes at work, the one that directs them killed at a random number of cases; finished by one process."""
    assert study(tmp_path / "whole", systems=ENOUGH).code == 0
    out = tmp_path / "killed"
    process = started(out, "--jobs", "2", systems=ENOUGH)
    wait_for_cases(out, process, random.randrange(50, 70))
    children = psutil.Process(process.pid).children(recursive=True)
    process.kill()
    process.communicate()
    assert children and gone(children)
    assert (out / UNFINISHED).exists()
    (out / f"{TEMPORARY}-of-a-dead-run").mkdir()
    kept = (out / UNFINISHED).read_bytes()
    again = study(out, systems=ENOUGH)
    assert again.code == 2 and "--resume goes on with it" in again.err and (out / UNFINISHED).read_bytes() == kept
    assert study(out, "--resume", systems=ENOUGH).code == 0
    assert contents(out) == contents(tmp_path / "whole")


@pytest.mark.usefixtures("without_figures")
@pytest.mark.parametrize("name", ["SIGTERM", *(pytest.param(name, marks=pytest.mark.slow) for name in ("SIGINT", "SIGHUP"))])
def test_a_signal_ends_the_run_and_its_children_with_one_line_more(name: str, tmp_path: Path) -> None:
    number = getattr(signal, name)
    systems, jobs, count = (ENOUGH, "2", 52) if name == "SIGTERM" else (FEW, "1", 8)
    process = started(tmp_path / "out", "--jobs", jobs, systems=systems)
    wait_for_cases(tmp_path / "out", process, count)
    children = psutil.Process(process.pid).children(recursive=True)
    process.send_signal(number)
    said = complaints(process)
    assert process.returncode == 128 + number
    assert len(said) == 2 and "the same command with --resume goes on" in said[0]
    assert gone(children) and (name != "SIGTERM" or children)
    assert {path.name for path in (tmp_path / "out").iterdir()} == {LOCK, UNFINISHED}


@pytest.mark.slow
def test_a_signal_that_is_ignored_stays_so(tmp_path: Path) -> None:
    """As `nohup` wants it."""
    line = [
        "/bin/sh",
        "-c",
        'trap "" HUP; exec "$@"',
        "sh",
        sys.executable,
        "-m",
        "faultspace",
        *ARGUMENTS,
        "--jobs",
        "1",
        "--out",
        str(tmp_path),
    ]
    with subprocess.Popen(line, cwd=ROOT, env=environment(), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        wait_for_cases(tmp_path, process, 8)
        process.send_signal(signal.SIGHUP)
        wait_for_cases(tmp_path, process, 16)
        process.kill()


@pytest.mark.slow
@pytest.mark.parametrize("part", range(5))
def test_fifty_kills_at_random_moments_lose_nothing(part: int, tmp_path: Path) -> None:
    """Each run is killed within the time that a whole one takes, by turns with one process and two, and begun again until one is whole:
    ten kills a part."""
    seed = random.randrange(2**32)
    chance, kills, whole = random.Random(seed), 0, tmp_path / "whole"
    begun = time.monotonic()
    assert started(whole, "--jobs", "2", systems=ENOUGH).wait(PATIENCE) == 0
    longest = time.monotonic() - begun
    while kills < 10:
        out = tmp_path / f"killed-{kills}"
        for attempt in range(200):
            process = started(out, "--jobs", str(1 + attempt % 2), "--resume", systems=ENOUGH)
            try:
                code = process.wait(chance.uniform(0.0, longest) if kills < 10 else PATIENCE)
                assert code == 0, (seed, process.communicate())
                break
            except subprocess.TimeoutExpired:
                process.kill()
                kills += 1
            finally:
                process.communicate()
        assert contents(out) == contents(whole), seed


@contextmanager
def file_size(limit: int) -> Iterator[None]:
    """Let no file become larger: to whoever writes it, the disk is full."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a study that nothing stopped."""
    folder = tmp_path_factory.mktemp("study") / "whole"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(studying, "_draw", lambda studies, folder: None)
        assert study(folder).code == 0
    return folder


@pytest.mark.usefixtures("without_figures")
@pytest.mark.parametrize("limit", [50, 9_000, 12_345, 40_000])
def test_a_full_disk_is_one_line_and_what_was_kept_is_whole(limit: int, tmp_path: Path, whole: Path) -> None:
    """It fills before the first case, among the cases, and where the tables are written."""
    out = tmp_path / "out"
    assert max(map(len, contents(whole).values())) > 40_000
    with file_size(limit):
        run = study(out)
    assert run.code == 2 and len(run.err.splitlines()) == 1 and "file too large" in run.err.lower(), run.err
    assert ("--resume goes on" in run.err) == (limit > 50)
    kept = [path.read_bytes() for path in out.iterdir() if path.name == UNFINISHED]
    assert all(each.endswith(b"\n") for each in kept)
    assert study(out, "--resume").code == 0
    assert contents(out) == contents(whole)


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """Give a file system of 32 kB, where this user may mount one."""
    place = tmp_path / "disk"
    place.mkdir()
    made = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=32k", "tmpfs", str(place)], capture_output=True, check=False)
    if made.returncode:
        pytest.skip("no file system can be mounted here")
    try:
        yield place
    finally:
        subprocess.run(["umount", str(place)], check=True)


@pytest.mark.usefixtures("without_figures")
def test_a_small_file_system_that_is_full_or_may_not_be_written_loses_nothing(small_disk: Path) -> None:
    run = study(small_disk / "out")
    assert run.code == 2 and len(run.err.splitlines()) == 1 and "no space left" in run.err.lower() and "--resume goes on" in run.err
    kept = (small_disk / "out" / UNFINISHED).read_bytes()
    assert kept.endswith(b"\n")
    for options in ("remount,ro", "remount,rw,size=1m"):
        subprocess.run(["mount", "-o", options, str(small_disk)], check=True)
        run = study(small_disk / "out", "--resume")
        if options == "remount,ro":
            assert run.code == 2 and len(run.err.splitlines()) == 1 and "cannot be written into" in run.err
            assert (small_disk / "out" / UNFINISHED).read_bytes() == kept
    assert run.code == 0 and not (small_disk / "out" / UNFINISHED).exists()


@pytest.mark.skipif(os.geteuid() == 0, reason="nothing is forbidden to this user")
def test_a_folder_that_may_not_be_written_is_one_line(tmp_path: Path) -> None:
    tmp_path.chmod(0o555)
    run = study(tmp_path)
    assert run.code == 2 and len(run.err.splitlines()) == 1 and "cannot be written into" in run.err


def test_two_runs_do_not_share_a_folder(tmp_path: Path) -> None:
    with keeping(tmp_path, Settings(1, 30), resume=False):
        run = study(tmp_path)
    assert run.code == 2 and len(run.err.splitlines()) == 1 and "another run works in this folder" in run.err


def keep_some(folder: Path, seed: int = 5) -> Path:
    numbered = list(enumerate(np.random.SeedSequence(seed).spawn(8)))
    with keeping(folder, Settings(seed, 30), resume=False) as kept:
        kept.add("published", [published_case(*each, 30) for each in numbered[:4]])
    return folder / UNFINISHED


@pytest.mark.usefixtures("without_figures")
def test_a_line_that_is_not_whole_does_not_count(tmp_path: Path, whole: Path) -> None:
    file = keep_some(tmp_path)
    lines = file.read_bytes()
    no_case = b'{"plan": "published", "case": {"index": 5}}\n'
    for end in (no_case[:25], b"\0\0\0\0\n\0", no_case, b"[]\n", b"[" * 10**5 + b"\n"):
        file.write_bytes(lines + end)
        with keeping(tmp_path, Settings(5, 30), resume=True) as kept:
            assert kept.count == 4 and file.read_bytes() == lines, end[:50]
    assert study(tmp_path, "--resume").code == 0
    assert contents(tmp_path) == contents(whole)


@pytest.mark.parametrize("first", [b"", b'{"plan": "published", "case": {"a": '])
def test_a_line_without_an_end_is_not_read_to_its_end(first: bytes, tmp_path: Path) -> None:
    whole = keep_some(tmp_path).read_bytes() if first else b""
    (tmp_path / UNFINISHED).write_bytes(whole + first)
    os.truncate(tmp_path / UNFINISHED, 10**12)  # a terabyte of zeros
    with (
        nullcontext() if first else pytest.raises(InvalidInput, match="is not ours"),
        keeping(tmp_path, Settings(5, 30), resume=True) as kept,
    ):
        assert kept.count == 4 and (tmp_path / UNFINISHED).read_bytes() == whole


def test_cases_of_other_settings_and_files_of_others_are_left_as_they_are(tmp_path: Path) -> None:
    file = keep_some(tmp_path, seed=6)
    for content, words in ((file.read_bytes(), "with seed 6, but 5 is asked for"), (b"mine\n", "is not ours"), (b"", "is not ours")):
        file.write_bytes(content)
        run = study(tmp_path, "--resume")
        assert run.code == 2 and len(run.err.splitlines()) == 1 and words in run.err
        assert file.read_bytes() == content
    made = {"numpy": "0.1", "scipy": "0.1", "machine": "abacus"}
    file.write_text(json.dumps({"format": "faultspace-unfinished-study/1", "seed": 5, "samples": 30, "made_by": made}) + "\n")
    assert "numpy" in study(tmp_path, "--resume").err


def fails_at_two(index: int, seed: np.random.SeedSequence, samples: int) -> Case:
    if index == 2:
        raise RuntimeError("the third\nsystem")
    return published_case(index, seed, samples)


@pytest.mark.usefixtures("without_figures")
def test_a_case_that_fails_is_a_row_with_its_reason(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plan = Plan(**{**vars(PUBLISHED), "case": fails_at_two})
    monkeypatch.setitem(STUDIES, "published", plan)
    run = study(tmp_path, "--json")
    assert run.code == 1
    validator().validate(run.json)
    assert run.json["studies"][0]["failed"] == [{"index": 2, "reason": "RuntimeError: the third system"}]
    assert [case["index"] for case in run.json["studies"][0]["cases"]] == [0, 1, 3, 4, 5, 6, 7]
    assert "1 case of 8 failed, and no table has them; system 2, the first, because: RuntimeError" in " ".join(run.json["remarks"])
    rows = [line for line in (tmp_path / "cases.csv").read_text("utf-8").splitlines() if line.startswith("published,2,")]
    assert len(rows) == 1 and rows[0].endswith(",RuntimeError: the third system")


@pytest.mark.usefixtures("without_figures")
def test_a_study_of_which_nothing_is_left_is_told_as_well(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(index: int, seed: np.random.SeedSequence, samples: int) -> Case:
        raise MemoryError

    for name, plan in STUDIES.items():
        monkeypatch.setitem(STUDIES, name, Plan(**{**vars(plan), "case": fails}))
    run = study(tmp_path, "--json")
    assert run.code == 1
    validator().validate(run.json)
