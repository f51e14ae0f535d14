"""These tests use `faultspace limit` as a person and as a script meet it."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

import jsonschema
import pytest

import faultspace.proofs
from faultspace.packaged_examples import DESCRIPTIONS, EXPERIMENTS
from tests.end_to_end.commands import Run, call, command, example, validator

SOUND: dict[str, Any] = {
    "A": [["1/2"]],
    "B": [["1"]],
    "C": [["1"]],
    "D": [["0"]],
    "F": [["1"]],
    "G": [["0"]],
    "s": 2,
    "past": 2,
    "u_filter": [[["1", "0"]]],
    "v_filter": [[["0", "1"]]],
}
LARGE = "9" * 6000 + "/" + "1" + "0" * 6000


def limit_of(folder: Path, change: dict[str, Any], *arguments: str) -> Run:
    path = folder / "experiment.json"
    path.write_text(json.dumps({key: value for key, value in (SOUND | change).items() if value is not ...}), "utf-8")
    return call("limit", str(path), *arguments)


@pytest.mark.parametrize("name", list(EXPERIMENTS))
def test_packaged_experiments_are_valid_and_answered(name: str) -> None:
    validator("experiment").validate(example(name))
    run = command("limit", f"example:{name}", "--json")
    assert (run.code, run.err, run.out.count("\n")) == (0, "", 1)
    validator("limit").validate(run.json)


def test_packaged_experiments_are_what_their_descriptions_say() -> None:
    leads, follows, independent = (call("limit", f"example:{name}", "--json").json for name in EXPERIMENTS)
    data = example("fault-leads-input")
    assert leads["equals_observability_range"] and leads["A_characteristic_polynomial"] == ["11/48", "-5/6", "1"]
    # AF and CF by hand, for A = [[1/2, 1/4], [-1/4, 1/3]], F = [1; 1/2], C = I.
    assert (data["A"], data["F"]) == ([["1/2", "1/4"], ["-1/4", "1/3"]], [["1"], ["1/2"]])
    for regression in ("true_AC", "moesp"):
        assert leads[regression]["bias"] == {"B": [["5/8"], ["-1/12"]], "D": [["1"], ["1/2"]]}
        assert independent[regression]["bias"] == {"B": [["0"], ["0"]], "D": [["0"], ["0"]]}
    assert (follows["limit_rank"], follows["contains_observability_range"], follows["markov"]) == (3, True, None)
    assert not follows["leading_vectors_span_observability_range"]
    assert independent["equals_observability_range"] and not independent["past_outputs"]["equals_observability_range"]
    truth = [[["0"], ["1/2"]], [["1"], ["-1"]], [["1/4"], ["-7/12"]]]
    assert independent["markov"][:3] == truth and len(independent["markov"]) == 5


def test_several_experiments_make_an_array_that_names_them(tmp_path: Path) -> None:
    names = [f"example:{name}" for name in EXPERIMENTS]
    run = call("limit", *names, "--json")
    assert run.code == 0 and [document["file"] for document in run.json] == names
    validator("limit").validate(run.json)
    # A bad one is told, the others are answered, the code is the largest.
    run = call("limit", names[0], str(tmp_path / "none.json"), names[1])
    assert run.code == 2 and run.err.count("\n") == 1
    assert run.out.count("rank of the limit") == 4


def test_a_person_reads_verdicts_and_numbers() -> None:
    run = command("limit", "example:fault-follows-input")
    assert (run.code, run.err) == (0, "")
    for text in ("1 input; s = 4, past = 4", "3; of O_s 2", "that of O_s and 1 more: the rank does not tell the order 2", "about", "none"):
        assert text in run.out
    assert "that of O_s: A and C are consistent" in call("limit", "example:independent-fault").out


def test_columns_that_are_missing_are_told(tmp_path: Path) -> None:
    lead = {"u_filter": [[["0"]], [["1"]]], "v_filter": [[["1"]]], "B": [["-1/2"]]}
    assert "smaller: states are missing" in limit_of(tmp_path, lead).out
    # One block row: the columns are those of O_s, and their shift is not seen.
    assert "s is too small to tell A" in limit_of(tmp_path, {"s": 1}).out
    assert "not unique" in limit_of(tmp_path, {"s": 1}).out


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"A": [["1"]]}, ("A:", "unit circle", "inside", "try")),
        ({"u_filter": [[["0", "0"]]]}, ("u_filter", "identically zero", "expected")),
        ({"u_filter": {"num": [[["1", "0"]]], "den": ["1", "-1"]}}, ("u_filter.den", "unstable", "unit circle")),
        ({"v_filter": {"num": [[["0", "1"]]], "den": ["1", "0", "4"]}}, ("v_filter.den", "unstable")),
        ({"u_filter": {"num": [[["1", "0"]]], "den": ["2", "1"]}}, ("den[0]", "got 2", "divide")),
        ({"u_filter": {"num": [[["1", "0"]]], "den": []}}, ("den", "got []")),
        ({"u_filter": {"num": [[["1", "0"]]]}}, ("'num'", '"den"')),
        ({"u_filter": []}, ("u_filter", "got []", "matrices over lag")),
        ({"u_filter": "white"}, ("u_filter", "'white'")),
        ({"u_filter": [[["1", "0"], ["1", "0"]]]}, ("u_filter[0]", "got 2 rows", "expected 1")),
        ({"u_filter": [[["1", "0"]], [["1"]]]}, ("u_filter[1]", "1 x 1", "1 x 2")),
        ({"v_filter": [[["1"]]]}, ("v_filter", "1 column,", "2 as in u_filter", "same white noise")),
        ({"v_filter": [[["0", 0.5]]]}, ("v_filter[0][0][1]", "0.5", "--floats-exactly")),
        ({"w_filter": [[["1"], ["1"]]]}, ("w_filter[0]", "got 2 rows", "expected 1")),
        ({"u_filter": [[["1"]]] * 300}, ("u_filter", "300 lags", "256")),
        ({"u_filter": [[["1"] * 20]] * 200, "v_filter": [[["0"] * 20]]}, ("3981 states", "at most 2048", "try")),
        ({"B": [["1", "0"]], "D": [["0", "0"]], "u_filter": [[["1", "0"], ["1", "0"]]]}, ("u_filter", "rank 4", "expected 8", "try")),
        ({"B": [["1", "1"]]}, ("D", "1 x 1", "1 x 2")),
        ({"B": ..., "D": ...}, ('"B"', "missing")),
        ({"D": ...}, ('"D"', "missing")),
        ({"s": ...}, ('"s"', "missing")),
        ({"v_filter": ...}, ('"v_filter"', "missing")),
        ({"s": 0}, ("s:", "got 0", ">= 1")),
        ({"past": -1}, ("past:", "got -1", ">= 1")),
        ({"s": "2"}, ("s:", "got '2'", "integer")),
        ({"s": True}, ("s:", "got True", "integer")),
        ({"s": 10**9}, ("(s + past)(nu + p)", "at most 2048")),
        ({"field": {"prime": 3}, "A": [["0"]]}, ("field", "GF(3)", "expected Q")),
        ({"horizon": 3}, ("'horizon'", "unknown", "u_filter")),
        ({"n": 1, "m": 1, "p": 1, "nu": 0, "B": [[]], "D": [[]], "u_filter": [[]]}, ("B:", "no input")),
    ],
    ids=str,
)
def test_bad_experiments_are_refused_in_one_line(tmp_path: Path, change: dict[str, Any], words: tuple[str, ...]) -> None:
    run = limit_of(tmp_path, change)
    assert (run.code, run.out, run.err.count("\n")) == (2, "", 1), run.err
    assert "experiment.json: " in run.err
    assert [word for word in words if word not in run.err] == []


def test_bad_files_are_refused(tmp_path: Path) -> None:
    for name, words in ((str(tmp_path), "directory"), ("example:none", "fault-leads-input"), ("example:zeros", "`faultspace inspect`")):
        run = call("limit", name, "--json")
        assert (run.code, run.out, run.err.count("\n")) == (2, "", 1) and words in run.err
    run = limit_of(tmp_path, {})
    assert run.code == 0
    (tmp_path / "list.json").write_text("[]", "utf-8")
    assert "expected an object" in call("limit", str(tmp_path / "list.json")).err
    assert "`faultspace limit` takes experiments" in call("inspect", f"example:{next(iter(EXPERIMENTS))}").err
    assert not set(EXPERIMENTS) & set(DESCRIPTIONS)


@pytest.mark.parametrize(
    "change", [{"s": 0}, {"u_filter": []}, {"u_filter": {"num": [[["1", "0"]]]}}, {"field": "R"}, {"more": 1}], ids=str
)
def test_the_schema_of_an_experiment_refuses(change: dict[str, Any]) -> None:
    validator("experiment").validate(SOUND)
    with pytest.raises(jsonschema.ValidationError):
        validator("experiment").validate(SOUND | change)


def test_floats_are_taken_on_request_only(tmp_path: Path) -> None:
    run = limit_of(tmp_path, {"v_filter": [[[0.0, 0.5]]]}, "--floats-exactly", "--json")
    assert run.code == 0 and run.json == limit_of(tmp_path, {"v_filter": [[["0", "1/2"]]]}, "--json").json


def test_numbers_of_thousands_of_digits_are_answered(tmp_path: Path) -> None:
    change = {"A": [[LARGE]], "v_filter": [[["1", "0"]]]}
    for arguments in ((), ("--json",)):
        run = limit_of(tmp_path, change, *arguments)
        assert (run.code, run.err) == (0, "")


@pytest.mark.parametrize(
    ("name", "rank", "told", "leading"),
    [
        ("following-fault", 2, "its leading left singular vector spans that of O_s all the same", True),
        ("following-fault-two-states", 3, "its 2 leading left singular vectors span that of O_s all the same", True),
        ("seasonal-input", 1, "inside that of O_s, and smaller: states are missing", False),
        ("observable-late", 2, "that of O_s, but s is too small to tell A", True),
    ],
)
def test_what_the_rank_of_the_limit_does_not_tell(name: str, rank: int, told: str, leading: bool) -> None:
    """A larger rank than n need not spoil A and C, a smaller one does though u and v are uncorrelated, and n may not be enough."""
    path = str(Path(faultspace.proofs.__file__).parent / "counterexamples" / f"{name}.json")
    assert told in call("limit", path).out
    answer = call("limit", path, "--json").json
    validator("limit").validate(answer)
    assert answer["limit_rank"] == rank and answer["leading_vectors_span_observability_range"] == leading


@pytest.mark.slow
def test_ten_states_four_inputs_twelve_block_rows_in_ten_seconds(tmp_path: Path) -> None:
    from benchmarks.limits import experiment

    path = tmp_path / "large.json"
    path.write_text(json.dumps(experiment(n=10, nu=4, m=2, p=3, s=12, seed=1).to_json()), "utf-8")
    start = time.process_time()
    run = call("limit", str(path), "--json")
    assert run.code == 0 and time.process_time() - start < 10
    validator("limit").validate(run.json)
