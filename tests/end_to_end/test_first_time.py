"""What a new user meets first: a file whose channels are not chosen yet, a name that is not there, a folder that was not named."""

from __future__ import annotations

import csv
import shlex
from pathlib import Path

import numpy as np
import pytest

from .commands import call

NAMED = "time,u1,u 2,temp,flow\n0,1,2,3,4\n1,2,3,4,5\n2,1,1,1,2\n"


@pytest.mark.parametrize(
    ("content", "options", "words"),
    [
        (NAMED, "", "* the file has u1, u 2, temp, flow, and times in time: * --inputs 'u1,u 2' --outputs temp,flow"),
        (NAMED, "--outputs temp", "* left are u1, u 2, flow, and times in time: * --inputs 'u1,u 2,flow' --outputs temp --out"),
        (NAMED, "--inputs 'u1,u 2,temp,flow'", "got no outputs, and no channel is left of 5 channels; a model needs an input"),
        (NAMED, "--inputs u1 --outputs tmp --out x", "there is no column (separated by comma) 'tmp', * did you mean 'temp'?"),
        (NAMED, "--inputs u1 --outputs temp", "--out: got none, expected a folder for the answer: try --out answer"),
        ("1,2,3\n2,3,4\n", "", "there is one matrix, data, with columns data[:,j] * --inputs 'data[:,0]' --outputs 'data[:,1:]'"),
        ("x\n1\n2\n", "", "and the file has x; a model needs an input"),
        ("data\n1\n2\n", "", "and the file has data; a model needs an input"),
        ("t,x\n0,1\n1,2\n", "", "and the file has x, and times in t; a model needs an input"),
    ],
)  # fmt: skip
def test_what_is_not_chosen_is_told_with_a_command(
    content: str, options: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("plant.csv").write_text(content)
    run = call("identify", "plant.csv", *shlex.split(options))
    assert (run.code, run.out) == (2, "") and run.err.count("\n") == 1
    place = 0
    for part in words.split("* "):
        place = run.err.find(part, place)
        assert place >= 0, (part, run.err)


def test_the_command_that_is_proposed_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    u, e = np.random.default_rng(1).standard_normal((2, 300, 1))
    np.savetxt("a plant.csv", np.hstack([u, np.roll(u, 1) + 0.1 * e]), delimiter=",", header='"u, kW","y ""a"", m"', comments="")
    proposed = call("identify", "a plant.csv").err.partition("faultspace identify ")[2]
    run = call("identify", *shlex.split(proposed))
    assert run.code == 0, run.err
    assert Path("answer/report.html").exists()
    with open("answer/residual.csv", newline="") as file:
        assert 'y "a", m' in next(csv.reader(file))
