"""`faultspace identify --healthy FILE`: another record says what the plant does without a fault."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from faultspace.numeric.method.model.models import StateSpaceModel
from tests.end_to_end.identify_runs import identified, refused, small_csv, valid

CHANNELS = ("--inputs", "u", "--outputs", "a,b")
PLANT = StateSpaceModel([[0.7]], [[1.0]], [[1.0], [0.5]], [[0.0], [0.0]])


def written(folder: Path, name: str, seed: int, bias: float, samples: int = 300) -> Path:
    draw = np.random.default_rng(seed)
    u = draw.standard_normal((samples, 1))
    y = PLANT.simulate(u) + 0.1 * draw.standard_normal((samples, 2)) + [0.0, bias]
    return small_csv(folder, "\n".join(["u,a,b", *(",".join(map(repr, row)) for row in np.hstack([u, y]).tolist())]), name)


def test_a_bias_is_seen_against_a_record_without_it(tmp_path: Path) -> None:
    healthy, faulty = written(tmp_path, "healthy.csv", 1, 0.0), written(tmp_path, "faulty.csv", 2, 0.2)
    out = tmp_path / "out"
    answer = valid("identify", identified(faulty, out, "--healthy", str(healthy), "--order", "1", "--json", channels=CHANNELS).json)
    assert (answer["healthy_until"], answer["healthy_record"], answer["n_v"], answer["n_v_at_least"]) == (300, True, None, 1)
    (row,) = (row for row in answer["changes"]["rows"] if row["seen"])
    assert (row["kind"], row["channel"]) == ("mean shift", "b") and abs(row["size"] - 0.2) < 0.05
    summary = (out / "summary.md").read_text("utf-8")
    assert "those of the healthy record" in summary and "| mean shift" not in summary and "mean shift" in summary


def test_what_cannot_be_is_refused(tmp_path: Path) -> None:
    healthy, faulty = written(tmp_path, "healthy.csv", 1, 0.0), written(tmp_path, "faulty.csv", 2, 0.2)
    both = identified(faulty, tmp_path / "no", "--healthy", str(healthy), "--healthy-until", "100", channels=CHANNELS)
    refused(both, "--healthy: got --healthy-until as well")
    refused(identified(faulty, tmp_path / "no", "--healthy", str(tmp_path / "none.csv"), channels=CHANNELS), "none.csv")
    other = small_csv(tmp_path, "u,c\n1,2\n", "other.csv")
    refused(identified(faulty, tmp_path / "no", "--healthy", str(other), channels=CHANNELS), "other.csv")
    assert not (tmp_path / "no").exists()
