"""These tests give `faultspace identify` several files, and a file with missing samples."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tests.end_to_end.commands import call
from tests.end_to_end.identify_runs import refused, small_csv, valid


def table(seed: int, samples: int, *, without: tuple[int, ...] = ()) -> str:
    u = np.random.default_rng(seed).standard_normal(samples)
    y = np.zeros(samples)
    for k in range(samples - 1):
        y[k + 1] = 0.5 * y[k] + u[k]
    rows = [f"{a!r},{'' if k in without else repr(b)}" for k, (a, b) in enumerate(zip(u.tolist(), y.tolist(), strict=True))]
    return "\n".join(["u,y", *rows])


CHANNELS = ("--inputs", "u", "--outputs", "y", "--json")


def test_several_files_and_the_parts_of_one_are_experiments(tmp_path: Path) -> None:
    first, second = small_csv(tmp_path, table(1, 80), "a.csv"), small_csv(tmp_path, table(2, 60, without=(30,)), "b.csv")
    run = call("identify", str(first), str(second), "--gaps", *CHANNELS, "--out", str(tmp_path / "answer"))
    found = valid("identify", run.json)
    assert run.code == 0 and [one["samples"] for one in found["experiments"]] == [80, 30, 29] and found["samples"] == 139
    assert found["order"] == 1 and found["n_v"] == 0 and found["data"].endswith("a.csv and 1 file more")
    assert len((tmp_path / "answer" / "residual.csv").read_text().splitlines()) == 140
    refused(call("identify", str(first), str(second), *CHANNELS, "--out", str(tmp_path / "other")), "channel 'y' is no number", "--gaps")
    assert not (tmp_path / "other").exists()


def test_an_answer_does_not_replace_a_file_it_is_made_of(tmp_path: Path) -> None:
    first, second = small_csv(tmp_path, table(1, 80), "a.csv"), small_csv(tmp_path, table(2, 60), "residual.csv")
    refused(call("identify", str(first), str(second), *CHANNELS, "--out", str(tmp_path)), "would be overwritten")
