"""A network that is lost, so that nothing comes and nothing is refused: a study on a cluster ends with one line and keeps its cases.

The scheduler and its worker live in a network of their own, on the far end of a cable whose end is then put down. That needs Linux, `ip`,
and the right to make networks.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from faultspace.numeric.study.keeping import UNFINISHED
from tests.end_to_end.commands import PROGRESS, ROOT, command, environment

NEAR, FAR = "10.231.7.1", "10.231.7.2"
STUDY = ("monte-carlo", "--samples", "30", "--seed", "5", "--systems", "100")
# The system gives up a connection when nothing has been answered for so long; 30 s where nobody says otherwise.
SOON = {"DASK_DISTRIBUTED__COMM__TIMEOUTS__TCP": "12s", "DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT": "4s"}


def ip(*words: str) -> None:
    subprocess.run(["ip", *words], check=True, capture_output=True)


@contextmanager
def cluster_beyond_a_cable() -> Iterator[tuple[str, Callable[[], None]]]:
    """The address of a scheduler with one worker, and what puts the far end of the cable down."""
    away, ends, port = f"away{os.getpid()}", (f"fs{os.getpid()}a"[:15], f"fs{os.getpid()}b"[:15]), "8786"
    inside = ("ip", "netns", "exec", away)
    started: list[subprocess.Popen[bytes]] = []
    try:
        ip("netns", "add", away)
    except (OSError, subprocess.CalledProcessError) as error:
        pytest.skip(f"no network can be made here: {error}")
    try:
        ip("link", "add", ends[0], "type", "veth", "peer", "name", ends[1])
        ip("link", "set", ends[1], "netns", away)
        ip("addr", "add", f"{NEAR}/30", "dev", ends[0])
        ip("link", "set", ends[0], "up")
        for words in (f"addr add {FAR}/30 dev {ends[1]}", f"link set {ends[1]} up", "link set lo up"):
            subprocess.run([*inside, "ip", *words.split()], check=True)
        address = f"tcp://{FAR}:{port}"
        for line in (
            ["distributed.cli.dask_scheduler", "--host", FAR, "--port", port, "--no-dashboard"],
            ["distributed.cli.dask_worker", address, "--nthreads", "1", "--no-dashboard"],
        ):
            started.append(subprocess.Popen([*inside, sys.executable, "-m", *line], cwd=ROOT, env=environment(), stderr=subprocess.DEVNULL))
        yield address, lambda: ip("netns", "exec", away, "ip", "link", "set", ends[1], "down")
    finally:
        for process in reversed(started):
            process.terminate()
            process.wait(30)
        subprocess.run(["ip", "netns", "delete", away], check=False, capture_output=True)
        subprocess.run(["ip", "link", "delete", ends[0]], check=False, capture_output=True)


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("ip") is None, reason="there is no command ip here")
def test_a_network_that_is_lost_is_one_line_and_the_study_goes_on_without_it(tmp_path: Path) -> None:
    pytest.importorskip("distributed")
    assert command(*STUDY, "--jobs", "1", "--out", str(tmp_path / "whole")).code == 0
    out = tmp_path / "lost"
    with cluster_beyond_a_cable() as (address, lose):
        line = [sys.executable, "-m", "faultspace", *STUDY, "--scheduler", address, "--out", str(out)]
        study = subprocess.Popen(line, cwd=ROOT, env=environment(**SOON), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 120
        while not ((out / UNFINISHED).is_file() and (out / UNFINISHED).read_bytes().count(b"\n") > 70):
            assert study.poll() is None and time.monotonic() < deadline, "no cases come"
            time.sleep(0.01)
        lose()
        said = [one for one in study.communicate(timeout=120)[1].splitlines() if not PROGRESS.fullmatch(one)]
    assert study.returncode == 2
    # Between two plans of the study it is a scheduler that does not answer.
    assert len(said) == 1 and address in said[0] and re.search("was lost|no Dask scheduler answers", said[0])
    assert "the same command with --resume goes on" in said[0]
    assert command(*STUDY, "--jobs", "1", "--out", str(out), "--resume").code == 0
    assert {one.name: one.read_bytes() for one in out.iterdir() if one.suffix != ".png"} == {
        one.name: one.read_bytes() for one in (tmp_path / "whole").iterdir() if one.suffix != ".png"
    }
