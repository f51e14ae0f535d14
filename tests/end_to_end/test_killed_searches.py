"""Searches that are killed at any moment lose nothing: the same command goes on with what was kept, and says the same in the end."""

from __future__ import annotations

import random
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.end_to_end.commands import ROOT, environment

KILLS = 50
# A box of 4 * 10^7 systems has two parts, each of which takes some seconds and is kept.
CLAIM = """
[claim.gap]
hypotheses = ["left_invertible"]
conclusion = "gap(n) == m"
box = { n = [2, 2], m = [2, 2], p = [2, 2], total = 6 }
"""


def claim(folder: Path) -> tuple[str, ...]:
    (folder / "claim.toml").write_text(CLAIM)
    return ("faultspace", "claim", str(folder / "claim.toml"), "--no-ablation", "--jobs", "2", "--json", "--resume")


def finished(line: list[str]) -> bytes:
    done = subprocess.run(line, cwd=ROOT, env=environment(), capture_output=True, timeout=900)
    assert done.returncode == 0, done.stderr[-500:]
    return done.stdout


@pytest.mark.slow
def test_fifty_kills_lose_nothing(tmp_path: Path) -> None:
    """What ends before it is killed is compared with what was never killed, and begun again."""
    seed = random.randrange(2**32)
    chance, line = random.Random(seed), [sys.executable, "-m", *claim(tmp_path)]
    whole = finished([*line, str(tmp_path / "whole")])
    kills, runs = 0, 0
    while kills < KILLS:
        kept = str(tmp_path / f"kept-{runs}")
        process = subprocess.Popen([*line, kept], cwd=ROOT, env=environment(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(chance.uniform(0.5, 9.0))
        if process.poll() is None:
            process.kill()
            kills += 1
        elif process.returncode == 0:
            assert finished([*line, kept]) == whole, f"run {runs} of seed {seed}"
            runs += 1
        else:
            pytest.fail(f"exit {process.returncode} after {kills} kills of seed {seed}")
        process.wait()
    assert finished([*line, kept]) == whole, f"seed {seed}"
