"""These tests check from Python: certificates as dicts and as files, systems insisted on in every form, and what Rocq is asked about.

`certify` makes every kind that the checker decides, and refuses what is not true.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from itertools import product
from pathlib import Path
from typing import Any

import pytest

from faultspace.base.errors import InvalidInput
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs import Malformed, Rejected, Unprovable, checking
from faultspace.proofs.checking import ask_rocq, check, check_file
from faultspace.proofs.rocq.build import BrokenTheory, NoRocq
from faultspace.proofs.rocq.recompute import ACCEPTED, Recomputed
from faultspace.proofs.trust import checker
from faultspace.proofs.trust.certifying import MAKERS, certify
from faultspace.proofs.trust.checker import KINDS
from tests.oracle.statements import truth
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


def test_every_kind_of_the_checker_can_be_made() -> None:
    assert {*MAKERS} == {*KINDS}, "MAKERS of proofs/trust/certifying.py has a line for each kind of the checker"


def test_the_words_of_certify_name_every_kind_and_option() -> None:
    quoted = set(re.findall(r'"([\w-]+)"', certify.__doc__ or ""))
    assert {*MAKERS} <= quoted
    named = set(re.findall(r"^ *(\w+) : ", certify.__doc__ or "", re.MULTILINE))
    assert {name for maker in MAKERS.values() for name in (*maker.needed, *maker.optional)} <= named


@pytest.mark.parametrize(
    "system",
    [
        ResidualSystem.of([[0]], [[1]], [[1], [0]], [[0], [1]]),
        ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 0], [0, 0]], [[0], [1]]),
    ],
)
def test_columns_of_which_the_first_block_alone_is_annihilated(system: ResidualSystem) -> None:
    made = 0
    for window, column in product(range(4), product((-1, 0, 1), repeat=system.n + system.p)):
        statement = {"system": system.to_json(), "window": window, "column": list(column)}
        try:
            certificate = certify(system, "first-column-only", window=window, column=column)
        except Unprovable:
            assert not truth("first-column-only", statement)
        else:
            assert truth("first-column-only", statement)
            checker.verify(certificate)
            made += 1
    assert made


@pytest.mark.parametrize("column", [[1, 0], "100", 1, [1, 0, "x"], [1, 0, 0.5]])
def test_what_is_no_column_is_refused(column: object) -> None:
    with pytest.raises(InvalidInput, match=r"^column"):
        certify(ResidualSystem.of([[0]], [[1]], [[1], [0]], [[0], [1]]), "first-column-only", window=2, column=column)
