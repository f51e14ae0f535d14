"""A search of a large box goes on where it was stopped, and says the same as one that was not; so does one on a Dask cluster."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from faultspace.base.errors import InvalidData, InvalidInput
from faultspace.proofs.brought import kept
from faultspace.proofs.brought.claiming import decide_claims
from faultspace.proofs.brought.claims import Claim, make_claim
from faultspace.proofs.brought.kept import Kept, Sharing

BOX = {"n": [1, 1], "m": [1, 2], "p": [1, 2], "total": 4}
TRUE = make_claim("true", {"hypotheses": ["left_invertible", "observable"], "conclusion": "gap(n) == m", "box": BOX})
FALSE = make_claim("false", {"hypotheses": ["observable"], "conclusion": "m == 1 or gap(n) == m", "box": BOX})


@pytest.fixture(autouse=True)
def _small_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Boxes of a thousand systems are cut as those of many millions are, and their systems come in short stretches."""
    monkeypatch.setattr(kept, "WORTH_SHARING", 100)
    monkeypatch.setattr(kept, "SYSTEMS_A_PART", 200)
    monkeypatch.setattr("faultspace.proofs.boxes.box.AT_ONCE", 20)
    monkeypatch.setattr("faultspace.proofs.brought.deciding.proof_of", lambda hypotheses, conclusion: None)  # it takes a second each


def said(*claims: Claim, resume: Path | None = None) -> str:
    return json.dumps(decide_claims(claims, ablation=FALSE in claims, resume=resume).to_json(), sort_keys=True)


def test_what_was_stopped_goes_on_with_the_same_bytes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    whole, stopped = tmp_path / "whole.jsonl", tmp_path / "stopped.jsonl"
    expected = said(TRUE, FALSE, resume=whole)
    count = len(whole.read_text().splitlines())
    assert count > 4
    note, left = Kept.note, [3]

    def stop(self: Kept, name: str, **numbers: object) -> None:
        if not left[0]:
            raise KeyboardInterrupt
        left[0] -= 1
        note(self, name, **numbers)

    with monkeypatch.context() as patch:
        patch.setattr(Kept, "note", stop)
        with pytest.raises(KeyboardInterrupt):
            said(TRUE, FALSE, resume=stopped)
    assert len(stopped.read_text().splitlines()) == 3
    stopped.write_text(stopped.read_text() + '{"format": "faultspace-sea')  # the stop cut a line short
    assert said(TRUE, FALSE, resume=stopped) == expected
    assert stopped.read_bytes() == whole.read_bytes()


def test_what_was_gone_through_is_not_gone_through_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = said(TRUE, resume=tmp_path / "kept.jsonl")

    def again(*given: object, **named: object) -> None:
        raise AssertionError

    monkeypatch.setattr("faultspace.proofs.brought.trying._ask", again)
    with pytest.raises(AssertionError):
        said(TRUE)
    monkeypatch.setattr(kept, "WORTH_SHARING", 0)
    with pytest.raises(AssertionError):  # the smallest sizes were not worth keeping before
        said(TRUE, resume=tmp_path / "kept.jsonl")
    monkeypatch.undo()
    assert json.loads(first)["claims"][0]["verdict"] == "NOT REFUTED"


def test_another_question_or_box_is_not_answered_from_the_file(tmp_path: Path) -> None:
    file = tmp_path / "kept.jsonl"
    said(TRUE, resume=file)
    before = len(file.read_text().splitlines())
    other = make_claim("true", {"hypotheses": ["left_invertible"], "conclusion": "gap(n) == m", "box": BOX})
    assert said(other, resume=file) == said(other, resume=tmp_path / "alone.jsonl")
    wider = make_claim("true", {"hypotheses": ["left_invertible"], "conclusion": "gap(n) == m", "box": {**BOX, "entries": [0, 1]}})
    assert said(wider, resume=file) == said(wider, resume=tmp_path / "wider.jsonl")
    assert len(file.read_text().splitlines()) > before


def test_a_counterexample_is_the_same_with_and_without_the_file(tmp_path: Path) -> None:
    for _ in range(2):
        with_file = json.loads(said(FALSE, resume=tmp_path / "kept.jsonl"))["claims"][0]
        assert with_file["verdict"] == "REFUTED"
        assert with_file["smallest"] == json.loads(said(FALSE))["claims"][0]["smallest"]


def test_who_goes_through_the_parts_does_not_matter() -> None:
    assert Sharing().parts(10**9) == 1
    assert Sharing(jobs=2).parts(1000) == Sharing(cluster="tcp://x").parts(1000) == 5 and Sharing(jobs=9).parts(99) == 1


def test_a_predicate_of_python_is_not_kept(tmp_path: Path) -> None:
    one = make_claim("x", {"conclusion": lambda s: s.lag <= s.n, "box": BOX})
    decide_claims([one], resume=tmp_path / "kept.jsonl", ablation=False)
    assert (tmp_path / "kept.jsonl").read_text() == ""


@pytest.mark.parametrize(
    "text", ["n,m\n1,2\n", '{"format": "another/1"}\n', '{"format": "faultspace-searched/1", "part": "x", "met": [true]}\n']
)
def test_a_file_of_another_kind_is_refused_and_left_as_it_is(tmp_path: Path, text: str) -> None:
    file = tmp_path / "mine.csv"
    file.write_text(text)
    with pytest.raises(InvalidInput, match="expected a file that an earlier run kept its parts in"):
        said(TRUE, resume=file)
    assert file.read_text() == text
    with pytest.raises(InvalidInput, match="no such file or directory"):
        said(TRUE, resume=tmp_path / "nowhere" / "kept.jsonl")


def test_a_cluster_that_does_not_answer_is_told() -> None:
    pytest.importorskip("distributed")
    with pytest.raises(InvalidData, match="no Dask scheduler answers"):
        decide_claims([TRUE], cluster="tcp://127.0.0.1:1")


def test_a_cluster_says_the_same() -> None:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=False, dashboard_address=None) as cluster:
        found = decide_claims([TRUE, FALSE], cluster=cluster.scheduler_address).to_json()
    assert found == decide_claims([TRUE, FALSE], jobs=2).to_json()
