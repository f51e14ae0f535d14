"""The comparison at the bound counts failures, calls every tool rightly, and shows what its file says."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from benchmarks.at_the_bound_cells import CELLS, Trial
from benchmarks.identification_cells import environment
from benchmarks.peers_at_the_bound import PAGE, PICTURE, STORED, measured, model_of, pages
from benchmarks.peers_at_the_bound_picture import _label, picture
from benchmarks.peers_at_the_bound_results import (
    INFINITE,
    CellResults,
    Comparison,
    Result,
    from_json,
    names,
    notes,
    sheets,
    summary,
    to_json,
    updated,
)
from benchmarks.peers_at_the_bound_spaces import WAYS, bound, distance
from benchmarks.peers_at_the_bound_tools import IDENTIFY, OURS, PAPER, TOOLS, Tool, _realised, answer
from faultspace.base.errors import InvalidData
from faultspace.base.processes import Limits
from faultspace.numeric.audit.records import Refused
from faultspace.numeric.audit.subjects.subprocess_adapter import Exec
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.study.information_bound import cramer_rao, relative_error

TINY = next(cell for cell in CELLS if cell.name == "1in1out white")
STUDY = next(cell for cell in CELLS if cell.name == "paper white")


def stored() -> Comparison:
    return from_json(json.loads(STORED.read_text("utf-8")))


def healthy(samples: int = 400) -> Trial:
    """A record of a system with two inputs and two outputs and no fault at all, which every consistent method identifies."""
    trial = TINY.trial(3, 0, samples)
    rng = np.random.default_rng(4)
    model = StateSpaceModel(np.diag([0.5, -0.4]), rng.standard_normal((2, 2)), rng.standard_normal((2, 2)), rng.standard_normal((2, 2)))
    u = rng.standard_normal((samples, 2))
    return Trial(model.simulate(u) + 1e-6 * rng.standard_normal((samples, 2)), u, model, trial.spectra)


@pytest.mark.parametrize("tool", [tool for tool in TOOLS if tool.name in IDENTIFY], ids=lambda tool: tool.name)
def test_every_python_tool_is_called_so_that_it_finds_a_healthy_system(tool: Tool) -> None:
    if tool.version() is None:
        pytest.skip(f"{tool.needs} is not installed")
    trial = healthy()
    question = {"call": "identify", "y": trial.y.tolist(), "u": trial.u.tolist(), "order": 2, "block_rows": 10}
    found = answer(IDENTIFY[tool.name], json.dumps(question))
    model = model_of([found[name] for name in "ABCD"], 2, 2)
    size = np.linalg.norm(trial.model.markov(20))
    assert np.linalg.norm(model.markov(20) - trial.model.markov(20)) < 1e-2 * size


def test_polynomials_are_realised_one_sample_earlier() -> None:
    A, B, C, D = _realised([[[0.0, 2.0], [0.0, 1.0]]], [[[1.0, -0.5], [1.0, 0.25]]], 1, 2)
    assert StateSpaceModel(A, B, C, D).markov(3)[:, 0] == pytest.approx(np.array([[2.0, 1.0], [1.0, -0.25], [0.5, 0.0625]]))


def test_an_answer_may_flatten_rows_and_columns_and_wrong_sizes_are_no_model() -> None:
    model = model_of([0.5, [2.0], [3.0], 1.0], 1, 1)
    assert model.markov(2).ravel().tolist() == [1.0, 6.0]
    with pytest.raises(InvalidData, match="no model"):
        model_of([[[0.5]], [[2.0]], [[3.0], [1.0]], [[1.0]]], 1, 1)


class Fails:
    """A program that finds the true model at first, then refuses, then answers with less than a model."""

    def __init__(self, trial: Trial) -> None:
        self.trial, self.calls = trial, 0

    def identify(self, y: Any, u: Any, order: int, block_rows: int) -> Sequence[Any]:
        self.calls += 1
        if self.calls == 2:
            raise Refused("why not")
        model = self.trial.model
        return (model.A, model.B, model.C, model.D) if self.calls == 1 else (model.A, model.B, model.C, [])


def test_a_failure_is_an_infinite_error_with_its_reason() -> None:
    trial = TINY.trial(3, 0, 200)
    trials = [(trial, cramer_rao(trial.model, trial.spectra, 200))] * 3
    (result,) = measured(Tool("x", "", "", windowed=False), Fails(trial), [10, 20], trials)  # type: ignore[arg-type]
    assert result.errors == (0.0, INFINITE, INFINITE)
    assert result.failed == 2 and result.failures["why not"] == 1 and result.block_rows is None
    assert "fails" in summary([1.0, INFINITE, INFINITE]) and "fails" not in summary([1.0, 2.0, 3.0])


def test_one_record_through_the_processes_gives_the_error_of_the_function(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in environment().items():
        monkeypatch.setenv(name, value)
    trial = TINY.trial(3, 0, 300)
    least = cramer_rao(trial.model, trial.spectra, 300)
    tool = next(tool for tool in TOOLS if tool.name == PAPER)
    with Exec(tool.command(), Limits(60.0, 4 << 30)) as program:
        (result,) = measured(tool, program, [10], [(trial, least)])
    model = StateSpaceModel(*IDENTIFY[PAPER](trial.y, trial.u, 4, 10))
    assert result.errors == pytest.approx([relative_error(model, trial.model, least)], rel=1e-6)
    assert tool.command()[0] == sys.executable


@pytest.mark.parametrize("name", ["Octave moen4"])
def test_octave_answers_through_its_script(name: str) -> None:
    tool = next(tool for tool in TOOLS if tool.name == name)
    if tool.version() is None:
        pytest.skip("GNU Octave with its package control is not installed")
    trial = healthy()
    with Exec(tool.command(), Limits(60.0, 4 << 30)) as program:
        (result,) = measured(tool, program, [10], [(trial, cramer_rao(trial.model, healthy_spectra(), 400))])
    assert result.failures == {} and result.errors[0] < 100


def healthy_spectra() -> Any:
    from faultspace.numeric.study.driving_spectra import Spectra, white

    return Spectra(white(np.eye(2)), white(1e-12 * np.eye(2)))


def test_the_true_fault_space_is_at_no_distance_in_any_basis_of_the_state() -> None:
    trial = STUDY.trial(3, 1, 500)
    assert trial.faults is not None
    T = np.random.default_rng(1).standard_normal((5, 5))
    Z = trial.faults.Z
    turned = np.vstack([np.linalg.inv(T) @ Z[:5], Z[5:]]), np.linalg.inv(T) @ trial.model.A @ T, trial.model.C @ T
    assert distance(trial, turned) < 1e-6
    assert distance(trial, (np.eye(8)[:, :3], trial.model.A, trial.model.C)) > 0.1
    assert 0 < bound(trial) < 0.5


def test_both_ways_to_the_fault_space_are_judged_in_the_true_states() -> None:
    trial = STUDY.trial(3, 3, 1000)  # of the trials 1 to 8 ours is within three bounds in all but the second, where it is at 11
    assert distance(trial, WAYS[OURS](trial, 0)) < 3 * bound(trial) < 0.1
    assert distance(trial, WAYS[PAPER](trial, 20)) < 0.5


def cells(errors: tuple[float, ...], failures: Mapping[str, int]) -> tuple[CellResults, ...]:
    results = tuple(Result(tool.name, 10, errors, failures) for tool in TOOLS)
    return tuple(CellResults(cell.name, 1000, results) for cell in CELLS)


def comparison() -> Comparison:
    each = cells((1.0, 2.0, 3.0), {})
    return Comparison(1, 3, {}, ("x",), each, each[:2])


def test_the_file_keeps_everything_and_the_best_window_counts() -> None:
    failing = Result("slow", 20, (1.0, INFINITE), {"why": 1})
    whole = replace(comparison(), cells=(CellResults("paper white", 1000, (failing, Result("slow", 10, (0.5, 0.7), {}))),))
    assert from_json(json.loads(json.dumps(to_json(whole)))) == whole
    best = whole.cells[0].best("slow")
    assert best is not None and best.block_rows == 10 and whole.cells[0].best("other") is None
    assert any("x: absent" in line for line in notes(whole)) and any("slow fails 1 times" in line for line in notes(whole))
    with pytest.raises(ValueError, match="format"):
        from_json({"format": "another"})
    assert sheets(whole)[0].rows[0][1].startswith("0.60 [0.50, 0.70] 0.70 (10)")


def test_new_results_replace_those_of_the_same_tool_and_leave_the_others() -> None:
    old = cells((1.0,), {})
    (tool, *others) = names(old)
    new = CellResults(old[0].cell, 1000, (Result(tool, 20, (2.0,), {}),))
    again = updated(old, new)
    assert names(again) == [tool, *others] and again[1:] == old[1:] and again[0].results == (*new.results, *old[0].results[1:])
    assert updated(old, replace(new, samples=200)) == (*old, replace(new, samples=200))


def drawn(svg: str) -> tuple[list[str], list[tuple[float, float]]]:
    """The words of a picture, and the places of its marks."""
    words = re.findall(r">([^<>\s][^<>]*)</text>", svg)
    return words, [(float(x), float(y)) for x, y in re.findall(r'<use [^>]*x="([\d.]+)" y="([\d.]+)"', svg)]


def test_the_picture_has_a_row_for_each_tool_and_moves_with_the_errors() -> None:
    words, marks = drawn(picture(comparison()))
    assert all(any(_label(tool.name) == word for word in words) for tool in TOOLS)
    better = replace(comparison(), cells=cells((0.5, 0.5, 0.5), {}))
    assert drawn(picture(better))[1] != marks
    failing = replace(comparison(), cells=cells((INFINITE,) * 3, {"x": 3}))
    assert "fails on all 3" in drawn(picture(failing))[0]


def test_page_and_picture_are_made_of_the_file() -> None:
    again = "make it again: python benchmarks/peers_at_the_bound.py --pages"
    text = PAGE.read_text("utf-8")
    assert pages(stored(), text) == text, again
    words, marks = drawn(PICTURE.read_text("utf-8"))
    new_words, new_marks = drawn(picture(stored()))
    assert words == new_words, again
    assert np.allclose(marks, new_marks, atol=0.5), again


def test_the_file_is_of_the_tools_that_there_are() -> None:
    whole = stored()
    assert sorted([*whole.tools, *whole.absent]) == sorted(tool.name for tool in TOOLS)
    for cell in (*whole.cells, *whole.spaces):
        assert all(len(result.errors) == whole.systems for result in cell.results)
