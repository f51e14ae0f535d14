"""The ledger names what there is: a check for every reading, a reading for every check, verdicts from the closed list."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import faultspace.proofs.claims
from faultspace.proofs.brought.readings import readings
from faultspace.proofs.claims import TOPICS, check_of
from faultspace.proofs.verdict.ledger import IN_LANGUAGE, load
from faultspace.proofs.verdict.verdicts import Verdict

ROOM = Path(faultspace.proofs.claims.__file__).parent


def checks(path: Path) -> set[str]:
    """The public functions of a file of claims/ that take a Workbench alone."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    named = (f for f in tree.body if isinstance(f, ast.FunctionDef) and [a.arg for a in f.args.args] == ["bench"])
    return {f.name for f in named if f.name[0] != "_"}


def test_every_reading_has_its_check_and_every_check_its_reading() -> None:
    every = {reading.check for claim in load() for reading in claim.readings}
    named = {check for check in every if not check.startswith(f"{IN_LANGUAGE}.")}
    listed = [check for path in ROOM.glob("*.py") for check in checks(path)]
    assert sorted(check_of(check).__name__ for check in named) == sorted(listed) == sorted(name.replace(".", "_") for name in named)
    assert {check.partition(".")[2] for check in every - named} <= readings().keys()
    assert {one for claims in TOPICS.values() for one in claims} <= {claim.id.replace("-", "_") for claim in load()}
    assert all((ROOM / f"{topic}.py").exists() for topic in TOPICS)


def test_a_check_is_where_its_claim_is_unless_the_ledger_says_so() -> None:
    readings = {(claim.id, reading.id): reading.check for claim in load() for reading in claim.readings}
    assert readings["theorem-1", "n-samples"] == "theorem_1.n_samples"
    assert readings["settle-2", "n"] == readings["assumption-4", "n-known"] == "language.assumption-4--n-known"


def test_expected_verdicts_are_of_the_closed_list() -> None:
    for claim in load():
        assert claim.expected in set(Verdict)
        assert all(reading.expected in set(Verdict) and reading.expected != "AMENDED" for reading in claim.readings)


def test_used_claims_exist() -> None:
    names = {claim.id for claim in load()}
    assert all(set(claim.uses) <= names for claim in load())


def test_the_claims_of_the_review_are_there() -> None:
    names = {claim.id for claim in load()}
    assert {"theorem-1", "theorem-2", "assumption-4", "proposition-3", "problem-11", "theorem-3-i", "theorem-3-ii"} <= names
    assert {"settle-2", "objection-3", "example-v"} <= names


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("[claim.a\n", "ledger.toml: "),
        ("[claim.a]\nstatement = 'S'\nexpected = 'PROVED'\nreference = 'ours'\n", "claim.a: key 'readings' is missing"),
        ("[claim.a]\nstatment = 'S'\n", "claim.a: unknown key 'statment', expected reference, statement"),
        (
            "[claim.a]\nstatement = 'S'\nexpected = 'PROVED'\nreference = 'ours'\n[claim.a.readings.b]\nstatement = 'S'\ntheorem = ['x']\n",
            "claim.a.readings.b: unknown key 'theorem', expected statement",
        ),
    ],
)
def test_a_slip_in_the_ledger_is_said_with_its_place(text: str, says: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "ledger.toml").write_text(text, "utf-8")
    monkeypatch.setattr("faultspace.proofs.verdict.ledger.resources.files", lambda package: tmp_path)
    with pytest.raises(ValueError, match=r"^proofs/verdict/ledger\.toml: ") as caught:
        load()
    assert says in str(caught.value)
