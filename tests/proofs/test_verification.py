"""A run computes its verdicts: they follow from what is found, and change when what is found is broken on purpose.

What Rocq says raises a verdict, its failure is an error, and without it the verdict rests on certificates and says so.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path

import pytest

from faultspace.base.errors import InvalidInput
from faultspace.base.progress import silent
from faultspace.proofs import verification
from faultspace.proofs.brought.readings import decide_reading
from faultspace.proofs.claims import check_of
from faultspace.proofs.evidence.corpus import CORPUS, examine
from faultspace.proofs.evidence.questions import RANKS
from faultspace.proofs.rocq import theorems as machine_checked
from faultspace.proofs.rocq.build import BrokenTheory, NoRocq, NotProved
from faultspace.proofs.rocq.sources import THEORY, sources
from faultspace.proofs.rocq.statements import read
from faultspace.proofs.rocq.theorems import Theorems, answers
from faultspace.proofs.trust import checker
from faultspace.proofs.verdict import workbench
from faultspace.proofs.verdict.ledger import IN_LANGUAGE, Claim, Reading, load
from faultspace.proofs.verdict.verdicts import ClaimResult, Outcome, ReadingResult, Verdict
from faultspace.proofs.verdict.workbench import Workbench, accepted, certify
from faultspace.proofs.verification import verify
from tests.oracle import truth


@pytest.fixture(scope="module")
def bench() -> Workbench:
    """A workbench with a corpus small enough for tests: every fifteenth system of the quick one."""
    made = Workbench("quick", 1, silent)
    made.put_answers(CORPUS, [examine(*item) for item in list(CORPUS[RANKS].items(made))[::15]])
    return made


def result(verdict: Verdict, *, repair: bool = False, expected: str = "CERTIFIED") -> ReadingResult:
    return ReadingResult(Reading("r", "s", (), expected, repair), Outcome(verdict, ""), 0.0)


def claim(*readings: ReadingResult) -> ClaimResult:
    return ClaimResult(Claim("c", "", "", "AMENDED", (), False, tuple(r.reading for r in readings)), readings)


@pytest.mark.parametrize(
    "readings, verdict",
    [
        ([result(Verdict.REFUTED), result(Verdict.CERTIFIED, repair=True)], Verdict.AMENDED),
        ([result(Verdict.REFUTED), result(Verdict.IDENTITY, repair=True)], Verdict.AMENDED),
        ([result(Verdict.REFUTED)], Verdict.REFUTED),
        ([result(Verdict.REFUTED), result(Verdict.REFUTED, repair=True)], Verdict.REFUTED),
        ([result(Verdict.REFUTED), result(Verdict.CERTIFIED)], Verdict.CERTIFIED),
        ([result(Verdict.PROVED), result(Verdict.CERTIFIED)], Verdict.CERTIFIED),
        ([result(Verdict.CERTIFIED), result(Verdict.ERROR, repair=True)], Verdict.ERROR),
        ([], Verdict.ERROR),
    ],
)
def test_the_verdict_on_a_claim_follows_from_its_readings(readings: list[ReadingResult], verdict: Verdict) -> None:
    assert claim(*readings).verdict == verdict


def test_one_part_refuted_amends_a_claim_made_of_parts() -> None:
    readings = (result(Verdict.REFUTED), result(Verdict.CERTIFIED), result(Verdict.CERTIFIED, repair=True))
    parts = Claim("c", "", "", "AMENDED", (), True, tuple(r.reading for r in readings))
    assert ClaimResult(parts, readings).verdict == Verdict.AMENDED
    assert claim(*readings).verdict == Verdict.CERTIFIED


def test_of_every_part_one_alternative_must_stand() -> None:
    """Two windows are alternatives, excitation is a part of its own: refuted, it amends the claim, whatever becomes of the windows."""

    def part(name: str, verdict: Verdict) -> ReadingResult:
        return ReadingResult(Reading(name, "s", (), "CERTIFIED", False, part=name), Outcome(verdict, ""), 0.0)

    repair = result(Verdict.PROVED, repair=True)
    windows = [part("window", Verdict.REFUTED), part("window", Verdict.PROVED)]
    assert claim(*windows, part("excitation", Verdict.REFUTED), repair).verdict == Verdict.AMENDED
    assert claim(*windows, part("excitation", Verdict.REFUTED)).verdict == Verdict.REFUTED
    assert claim(*windows, part("excitation", Verdict.CERTIFIED), repair).verdict == Verdict.CERTIFIED
    assert claim(windows[0], part("excitation", Verdict.CERTIFIED), repair).verdict == Verdict.AMENDED


def test_a_claim_is_as_expected_only_with_all_its_readings() -> None:
    good = [result(Verdict.REFUTED, expected="REFUTED"), result(Verdict.CERTIFIED, repair=True)]
    assert claim(*good).as_expected
    assert not claim(result(Verdict.REFUTED, expected="CERTIFIED"), good[1]).as_expected


def test_unknown_names_are_bad_input() -> None:
    with pytest.raises(InvalidInput, match="expected one of assumption-2"):
        verify(["theorem-9"])
    with pytest.raises(InvalidInput, match="effort"):
        verify(effort="medium")


def test_a_check_that_does_not_finish_is_an_error_and_the_others_go_on(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(bench: Workbench) -> Outcome:
        raise RuntimeError("interrupted")

    monkeypatch.setattr("faultspace.proofs.claims.example_v.example_v_one_fault", broken)
    report = verify(["example-v"], jobs=1)
    verdicts = {r.reading.id: r.outcome for c in report.claims for r in c.readings}
    assert verdicts["one-fault"].verdict == Verdict.ERROR and "interrupted" in verdicts["one-fault"].evidence
    assert verdicts["two-columns"].verdict in (Verdict.CERTIFIED, Verdict.PROVED)  # the latter where Rocq is
    assert not report.as_expected


def test_certificates_of_the_example_are_accepted_and_true() -> None:
    report = verify(["example-v"], jobs=1)
    assert report.as_expected
    for certificate in report.certificates():
        checker.verify(certificate)
        if certificate["statement"].get("matrix") not in ("residual-hankel", "excitation"):
            assert truth(certificate["kind"], certificate["statement"]), certificate["kind"]


def test_certify_turns_to_refuted_when_the_statement_fails(bench: Workbench) -> None:
    always = certify(bench, (RANKS,), lambda e: True, lambda e: e.kernel.rank(1) <= e.system.p, lambda s: ())
    assert always.verdict == Verdict.CERTIFIED and always.accepted > 0
    too_strong = certify(bench, (RANKS,), lambda e: True, lambda e: e.kernel.gap(e.system.n) == e.system.m, lambda s: ())
    assert too_strong.verdict == Verdict.REFUTED and "smallest of the corpus" in too_strong.evidence
    nothing = certify(bench, (RANKS,), lambda d: False, lambda d: True, lambda s: ())
    assert nothing.verdict == Verdict.ERROR


def test_only_accepted_certificates_are_shown() -> None:
    report = verify(["example-v"], jobs=1)
    forged = dict(report.certificates()[0])
    forged["statement"] = {**forged["statement"], "normal_rank": 2}
    with pytest.raises(checker.Rejected):
        accepted([forged])


@pytest.mark.parametrize("reading", ["n-known", "n-unknown", "lag"])
def test_assumption_4_on_the_small_corpus(bench: Workbench, reading: str) -> None:
    assert decide_reading(bench, f"assumption-4--{reading}").verdict == Verdict.CERTIFIED


def test_a_wrong_shape_of_the_rows_does_not_go_unnoticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the fault left out of the state, certificates of the example are no longer accepted: ERROR, not a wrong verdict."""
    from faultspace.exact.algebra.matrices import Matrix
    from faultspace.exact.structure import kernel_rows as kernel_representation
    from faultspace.exact.structure import modular_rows
    from faultspace.exact.system.systems import ResidualSystem
    from faultspace.proofs.evidence.subjects import kernel_once

    def without_fault(system: ResidualSystem) -> modular_rows.ModularRows | None:
        return modular_rows.rows_modulo(system.with_faults(Matrix.zero(system.field, system.n, system.m), system.G))

    monkeypatch.setattr(kernel_representation, "rows_modulo", without_fault)
    monkeypatch.setattr(kernel_representation, "image", lambda system, largest=0: _first_image(system, largest))
    kernel_once.cache_clear()
    report = verification.verify(["example-v"], jobs=1)
    kernel_once.cache_clear()
    assert {r.outcome.verdict for c in report.claims for r in c.readings} == {Verdict.ERROR}


def _first_image(system: object, largest: int) -> object:
    """The image at the first prime only: where the shape is refuted there, the search for another prime ends in an error."""
    from faultspace.exact.system.modular import LARGEST_PRIME, image

    if largest:
        raise ArithmeticError("no prime agrees with the recursion")
    return image(system, largest=LARGEST_PRIME)  # type: ignore[arg-type]


def test_a_check_that_several_readings_share_is_run_once(monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[Workbench] = []

    def found(bench: Workbench) -> Outcome:
        calls.append(bench)
        return Outcome(Verdict.IDENTITY, "shared")

    names = {reading.check for claim in load() if claim.id in ("proposition-3", "settle-2") for reading in claim.readings}
    for name in names:
        if not name.startswith(f"{IN_LANGUAGE}."):
            check = check_of(name)
            monkeypatch.setattr(f"{check.__module__}.{check.__name__}", found)
    monkeypatch.setattr("faultspace.proofs.brought.readings.decide_reading", lambda bench, _: found(bench))
    monkeypatch.setattr(verification, "ablations", tuple)
    report = verify(["proposition-3", "settle-2"], jobs=1)
    readings = [reading for one in report.claims for reading in one.readings]
    assert len(calls) == len(names) < len(readings)
    assert all(reading.outcome.evidence.endswith("shared") for reading in readings)


@pytest.mark.parametrize(
    "found, opposite", [(Verdict.REFUTED, Verdict.CERTIFIED), (Verdict.CERTIFIED, Verdict.REFUTED), (Verdict.ERROR, Verdict.ERROR)]
)
def test_a_counterexample_witnesses_the_opposite_and_an_error_stays_one(found: Verdict, opposite: Verdict) -> None:
    outcome = workbench.witnessed(Outcome(found, "evidence", (), frozenset("abc")))
    assert outcome.verdict == opposite and "evidence" in outcome.evidence and outcome.accepted == 3


@pytest.mark.parametrize("verdict", [Verdict.CERTIFIED, Verdict.REFUTED])
def test_a_verdict_without_an_accepted_certificate_is_an_error(verdict: Verdict, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("faultspace.proofs.claims.example_v.example_v_one_fault", lambda bench: Outcome(verdict, "on nothing"))
    report = verify(["example-v"], jobs=1)
    (found,) = (r.outcome for c in report.claims for r in c.readings if r.reading.id == "one-fault")
    assert found.verdict == Verdict.ERROR and "no certificate was accepted" in found.evidence
    assert not report.as_expected


NAMED = Reading("r", "s", (), "CERTIFIED", False, ("one", "two"))


def _result(reading: Reading, verdict: Verdict = Verdict.CERTIFIED) -> ReadingResult:
    return ReadingResult(reading, Outcome(verdict, "on 3 systems"), 0.0)


def _machine(monkeypatch: pytest.MonkeyPatch, answer: Callable[[Iterable[str]], Theorems]) -> verification._Machine:
    monkeypatch.setattr(verification, "machine_checked", lambda names, progress: answer(names))
    claim = Claim("c", "", "", "CERTIFIED", (), False, (NAMED,))
    return verification._theorems([claim], lambda stage, done, total: None, rocq=True)


def _raising(error: Exception) -> Callable[[Iterable[str]], Theorems]:
    def answer(names: Iterable[str]) -> Theorems:
        raise error

    return answer


def test_no_theorem_is_compiled_unasked(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where none is compiled, the answer says so and how to have it; asked for, or compiled before, Rocq checks them."""
    claim = Claim("c", "", "", "CERTIFIED", (), False, (NAMED,))
    asked: list[bool] = []

    def checked(names: Iterable[str], progress: object) -> Theorems:
        asked.append(True)
        return Theorems("8.16.1", dict.fromkeys(names, "statement"))

    monkeypatch.setattr(verification, "machine_checked", checked)
    monkeypatch.setattr(verification, "found", lambda: object())
    for kept, rocq, called in ((None, False, False), (None, True, True), (Path("there"), False, True)):
        asked.clear()
        monkeypatch.setattr(verification, "kept_theory", lambda texts, kept=kept: kept)
        machine = verification._theorems([claim], lambda stage, done, total: None, rocq=rocq)
        assert bool(asked) == called and (machine.theorems is not None) == called
        assert ("--rocq compiles them" in machine.message) == (not called)


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
