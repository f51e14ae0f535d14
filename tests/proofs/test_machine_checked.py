"""What Rocq says raises a verdict, its failure is an error, and without it the verdict rests on certificates and says so."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import replace

import pytest

from faultspace.proofs import verification
from faultspace.proofs.rocq import theorems as machine_checked
from faultspace.proofs.rocq.build import BrokenTheory, NoRocq, NotProved
from faultspace.proofs.rocq.sources import THEORY, sources
from faultspace.proofs.rocq.statements import read
from faultspace.proofs.rocq.theorems import Theorems, answers
from faultspace.proofs.verdict.ledger import Claim, Reading, load
from faultspace.proofs.verdict.verdicts import ClaimResult, Outcome, ReadingResult, Verdict

NAMED = Reading("r", "s", (), "CERTIFIED", False, ("one", "two"))


def _result(reading: Reading, verdict: Verdict = Verdict.CERTIFIED) -> ReadingResult:
    return ReadingResult(reading, Outcome(verdict, "on 3 systems"), 0.0)


def _machine(monkeypatch: pytest.MonkeyPatch, answer: Callable[[Iterable[str]], Theorems]) -> verification._Machine:
    monkeypatch.setattr(verification, "machine_checked", lambda names, progress: answer(names))
    claim = Claim("c", "", "", "CERTIFIED", (), False, (NAMED,))
    return verification._theorems([claim], lambda stage, done, total: None)


def _raising(error: Exception) -> Callable[[Iterable[str]], Theorems]:
    def answer(names: Iterable[str]) -> Theorems:
        raise error

    return answer


def test_a_reading_whose_theorems_were_checked_is_proved(monkeypatch: pytest.MonkeyPatch) -> None:
    machine = _machine(monkeypatch, lambda names: Theorems("8.16.1", dict.fromkeys(names, "statement")))
    found = verification._with_theorems(_result(NAMED), machine)
    assert found.outcome.verdict == found.expected == "PROVED" and found.as_expected
    assert "one, two" in found.outcome.evidence and "on 3 systems" in found.outcome.evidence
    assert "8.16.1: 2 theorems" in machine.message
    assert found.to_json()["theorems"] == ["one", "two"]


def test_a_refuted_reading_stays_refuted_and_names_its_counterexample(monkeypatch: pytest.MonkeyPatch) -> None:
    machine = _machine(monkeypatch, lambda names: Theorems("8.16.1", dict.fromkeys(names, "statement")))
    found = verification._with_theorems(_result(replace(NAMED, expected="REFUTED"), Verdict.REFUTED), machine)
    assert found.outcome.verdict == found.expected == "REFUTED" and "one, two" in found.outcome.evidence


@pytest.mark.parametrize(("expected", "verdict"), [("CERTIFIED", Verdict.REFUTED), ("REFUTED", Verdict.CERTIFIED)])
def test_theorems_and_systems_that_disagree_are_an_error(monkeypatch: pytest.MonkeyPatch, expected: str, verdict: Verdict) -> None:
    """A counterexample to a theorem, or a system that a counterexample in Rocq does not speak of: the theorem says something else."""
    machine = _machine(monkeypatch, lambda names: Theorems("8.16.1", dict.fromkeys(names, "statement")))
    found = verification._with_theorems(_result(replace(NAMED, expected=expected), verdict), machine)
    assert found.outcome.verdict == "ERROR" and not found.as_expected and "the systems say" in found.outcome.evidence


def test_without_rocq_the_certificates_stand_and_it_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    machine = _machine(monkeypatch, _raising(NoRocq("coqc is not on the path; install it")))
    found = verification._with_theorems(_result(NAMED), machine)
    assert found.outcome.verdict == found.expected == "CERTIFIED" and found.as_expected
    assert "install it" in machine.message and "rest on their certificates" in machine.message


@pytest.mark.parametrize("error", [BrokenTheory("Lag.v does not compile"), NotProved("the theorem one rests on more")])
def test_a_theory_that_fails_is_an_error(monkeypatch: pytest.MonkeyPatch, error: Exception) -> None:
    machine = _machine(monkeypatch, _raising(error))
    found = verification._with_theorems(_result(NAMED), machine)
    assert found.outcome.verdict == "ERROR" and str(error) in found.outcome.evidence and not found.as_expected
    unnamed = _result(replace(NAMED, theorems=()))
    assert verification._with_theorems(unnamed, machine) is unnamed


def test_a_claim_is_expected_to_be_proved_where_its_standing_readings_are() -> None:
    repair = Reading("q", "s", (), "CERTIFIED", True)
    claim = Claim("c", "", "", "CERTIFIED", (), False, (NAMED, repair))
    proved = replace(_result(NAMED, Verdict.PROVED), machine_checked=True)
    assert ClaimResult(claim, (proved, _result(repair))).expected == "PROVED"
    assert ClaimResult(claim, (proved, _result(repair))).verdict == "PROVED"
    assert ClaimResult(claim, (_result(NAMED), _result(repair))).expected == "CERTIFIED"


def test_only_a_closed_proof_counts() -> None:
    def said(rest: str, *names: str) -> str:
        return "".join(f"== {name}\nHeadlines.{name}\n     : forall n, n = n\n" for name in names) + f"== all together\n{rest}\n"

    closed = "Closed under the global context"
    assert answers(["a"], said(closed, "a").replace("n = n", "n == n\n       == m"))["a"] == "forall n, n == n == m"
    assert answers(["a", "b"], said(closed, "a", "b")) == {"a": "forall n, n = n", "b": "forall n, n = n"}
    for text in (said("Axioms:\nb : False", "a"), said(f"{closed}\nAxioms:\nb : False", "a"), said("", "a"), said(closed, "b"), ""):
        with pytest.raises(NotProved, match=r"rest on more|nothing was said"):
            answers(["a"], text)


def test_what_holds_without_a_theorem_says_what_is_missing() -> None:
    for claim in load():
        for reading in claim.readings:
            wanted = reading.expected != "REFUTED" and not reading.theorems
            assert bool(reading.missing) == wanted, f"{claim.id}.{reading.id}: `missing` in the ledger says what a proof for all lacks"


def test_the_ledger_names_theorems_of_readings_alone() -> None:
    names = [name for claim in load() for reading in claim.readings for name in reading.theorems]
    assert all(name.isidentifier() for name in names)
    statements = read(sources())
    lines = machine_checked.question([statements.headlines[name] for name in sorted(set(names))], statements.openings)
    for name in names:
        assert f"Check Headlines.{name}." in lines and f"(@Headlines.{name})" in lines[-2]
        assert any(line.startswith("Goal ") and line.endswith(f"exact (@Headlines.{name}). Qed.") for line in lines)


def test_the_readme_of_the_theorems_counts_them() -> None:
    texts = [text for name, text in sources().items() if name.startswith("Headlines")]
    headlines = sum(len(re.findall(r"^Theorem ", text, re.M)) for text in texts)
    readings = [reading for claim in load() for reading in claim.readings]
    named = sum(bool(reading.theorems) for reading in readings)
    readme = THEORY.joinpath("README.md").read_text("utf-8")
    for words in f"\n{headlines} headlines", f"They prove {named} of the {len(readings)} readings":
        assert words in readme, f"the first lines of proofs/theory/README.md should say: {words.strip()}"
