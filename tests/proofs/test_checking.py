"""These tests check from Python: certificates as dicts and as files, systems insisted on in every form, and what Rocq is asked about."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from faultspace.base.errors import InvalidInput
from faultspace.proofs import Malformed, Rejected, checking
from faultspace.proofs.checking import ask_rocq, check, check_file
from faultspace.proofs.rocq.build import BrokenTheory, NoRocq
from faultspace.proofs.rocq.recompute import ACCEPTED, Recomputed
from faultspace.proofs.trust import checker
from tests.proofs.examples import CUBED, GONE, RANKS, ZERO, seen, spoiled

FALSE = spoiled(RANKS, ("witness.prime", 4))
ASSUMED = spoiled(CUBED, ("witness.irreducible", GONE))


@pytest.fixture
def files(tmp_path: Path) -> dict[str, Path]:
    """Return one file of each result."""
    contents = {"verified": RANKS, "verified under an assumption": ASSUMED, "rejected": FALSE, "malformed": []}
    for name, content in contents.items():
        (tmp_path / f"{name}.json").write_text(json.dumps(content), "utf-8")
    return {name: tmp_path / f"{name}.json" for name in contents}


def test_a_file_is_checked_as_what_it_holds(files: dict[str, Path]) -> None:
    for path in (files["verified"], str(files["verified"])):
        assert check(path) == check(RANKS) and check(path).statement == checker.verify(RANKS).statement
    assert check(files["verified under an assumption"]).assumes == checker.verify(ASSUMED).assumes != []
    with pytest.raises(Rejected, match="4 is not a prime"):
        check(files["rejected"])
    for path in (files["malformed"], files["malformed"].parent, files["malformed"].parent / "none.json"):
        with pytest.raises(Malformed):
            check(path)


def test_a_system_is_insisted_on_in_every_form(files: dict[str, Path], tmp_path: Path) -> None:
    own, foreign = seen(), ZERO
    for system, accepts in ((own, True), (foreign, False)):
        place = tmp_path / "system.json"
        place.write_text(json.dumps(system.to_json()), "utf-8")
        for form in (system, system.to_json(), place, str(place), checker.subject(system.to_json())):
            assert check_file(files["verified"], [form]).result == ("verified" if accepts else "rejected")
            if accepts:
                assert check(RANKS, [form]).assumes == []
            else:
                with pytest.raises(Rejected, match="not about"):
                    check(RANKS, [form])


def test_a_file_answers_as_the_checker_writes_it(files: dict[str, Path]) -> None:
    for result, path in files.items():
        file = check_file(path)
        assert file.result == result and file.to_json() == checker.result_of(str(path), [])
        assert file.summary().startswith(f"{path}: {result}") and repr(file) == f"<CheckedFile: {file.title}>"
        assert file.rocq is None


def test_rocq_is_asked_about_verified_certificates_alone(files: dict[str, Path], monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []

    def recomputed(certificates: Sequence[Any], progress: object) -> list[Recomputed]:
        asked.extend(certificates)
        return [ACCEPTED] * len(certificates)

    monkeypatch.setattr(checking, "recomputed", recomputed)
    checked = [check_file(path) for path in files.values()]
    answers = [None if file.rocq is None else file.rocq["result"] for file in ask_rocq(checked)]
    assert answers == ["accepted", "accepted", "not asked", None] and asked == [RANKS, ASSUMED]
    assert check(RANKS, rocq=True).rocq == ACCEPTED and check(RANKS, rocq=True).to_json()["rocq"]["result"] == "accepted"
    with pytest.raises(Rejected):
        check(FALSE, rocq=True)
    files["verified"].write_text(json.dumps(CUBED), "utf-8")
    (changed,) = ask_rocq(checked[:1])
    assert changed.rocq is not None and "has changed" in changed.rocq["reason"]


@pytest.mark.parametrize("error", [NoRocq("coqc is not there"), BrokenTheory("a lemma fails")])
def test_rocq_that_cannot_be_asked_is_bad_input(error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    def recomputed(certificates: Sequence[Any], progress: object) -> list[Recomputed]:
        raise error

    monkeypatch.setattr(checking, "recomputed", recomputed)
    with pytest.raises(InvalidInput, match=f"^rocq: .*{error}"):
        check(RANKS, rocq=True)
