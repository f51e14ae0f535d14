"""A run of a benchmark that was stopped goes on: what is there stays, a line that was cut short comes anew, other code is refused."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from benchmarks.changes import cells, lines
from benchmarks.changes_records import KINDS, SETTINGS, record
from benchmarks.kept_cases import Cases, interval


def test_cases_are_kept_and_a_line_cut_short_is_written_anew(tmp_path: Path) -> None:
    path = tmp_path / "cases.jsonl"
    cases = Cases(path)
    cases.begin()
    cases.add("a", {"n": 1})
    cases.add("b", {"n": 2})
    path.write_text(path.read_text(encoding="utf-8")[:-5], encoding="utf-8")
    again = Cases(path)
    assert set(again.found) == {"a"}
    again.begin()
    again.add("b", {"n": 2})
    assert [case["n"] for case in Cases(path).found.values()] == [1, 2]
    head, *rest = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join([json.dumps(json.loads(head) | {"version": "another"}), *rest, ""]), encoding="utf-8")
    with pytest.raises(SystemExit, match="another version"):
        Cases(path).begin()


def test_intervals_are_those_of_clopper_and_pearson() -> None:
    assert interval(0, 10) == pytest.approx((0.0, 0.30850), abs=1e-5)
    assert interval(10, 10) == pytest.approx((0.69150, 1.0), abs=1e-5)
    assert interval(3, 600) == pytest.approx((0.00103, 0.01454), abs=1e-5)


@pytest.mark.parametrize("kind", KINDS)
def test_a_change_begins_where_it_is_said_and_at_no_other_channel(kind: str) -> None:
    for loop in (False, True):
        drawn, clean = (record(each, 10.0, SETTINGS["middle"], np.random.default_rng(5), loop) for each in (kind, "none"))
        assert drawn.begins is not None and drawn.channel is not None and drawn.begins >= drawn.healthy == 300
        if kind not in ("white fault", "coloured fault", "sinusoid", "freezing", "stuck"):  # these draw more numbers
            assert np.array_equal(drawn.y[: drawn.begins], clean.y[: drawn.begins])
        if not loop and kind not in ("input gain", "white fault", "coloured fault", "sinusoid", "freezing", "stuck"):
            others = [i for i in range(3) if f"y{i + 1}" != drawn.channel]
            assert np.array_equal(drawn.y[:, others], clean.y[:, others]) and not np.array_equal(drawn.y, clean.y)


def test_a_line_counts_what_was_told() -> None:
    case = {"outcome": "right", "n_v": 1, "begins": 300, "onsets": [[302, 299, 304]], "seconds": 1.0, "space cause": "right"}
    wrong = {"outcome": "zero", "n_v": 0, "begins": 300, "onsets": [[200, 190, 210]], "seconds": 3.0, "allowed": False}
    told = cells([case, wrong])
    assert told[:5] == ["2", "1", "0", "0", "1"] and told[7:9] == ["1 / 0 / 0", "0 / 0 / 0"]
    assert told[9:] == ["1", "1", "1", "2", "1", "2.00"]
    assert len(list(lines())) == 2 + 6 * len(KINDS)
