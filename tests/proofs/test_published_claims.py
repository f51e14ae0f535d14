"""The examples, the statements of the field and the claims of the ledger, each decided and with the verdict that it should get."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

import faultspace as fs
from faultspace.base.progress import silent
from faultspace.exact.algebra.fields import QQ, PrimeField, field_from_json
from faultspace.packaged_examples import content
from faultspace.proofs.boxes.box import Box
from faultspace.proofs.boxes.record_box import RecordBox
from faultspace.proofs.brought import deciding, known_cases
from faultspace.proofs.brought.claim_files import read_claims
from faultspace.proofs.brought.claiming import decide_claims, explain
from faultspace.proofs.brought.claims import Answered, Claim, make_claim
from faultspace.proofs.language.vocabularies import SYSTEM
from faultspace.proofs.quantities.cases import size_of
from faultspace.proofs.trust.structure_certificates import accept
from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.verdicts import Verdict
from tests.thorough import every


def small_box(claim: Claim) -> Claim:
    """Return the claim with a box of at most n + m + p = 4."""
    return replace(claim, boxes={name: replace(box, total=min(box.total, 4)) for name, box in claim.boxes.items()})


EXAMPLES = {one.id: one for one in read_claims(content("example:claims").decode())}
LEDGER = {one.id: one for one in read_claims(content("example:ledger").decode())}


LITERATURE = {one.id: one for one in read_claims(content("example:literature").decode())}
PAPERS = {one.id: one for one in read_claims(content("example:papers").decode())}


def test_there_are_ten_examples_and_forty_statements() -> None:
    assert len(EXAMPLES) == 10 and len(LITERATURE) == 111
    assert all(one.source and one.statement and one.expected for one in LITERATURE.values())
    assert {one.expected["Q"] for one in LITERATURE.values()} == {Answered.REFUTED, Answered.NOT_REFUTED, Answered.PROVED}


def quick_box(claim: Claim) -> Box:
    """Return the box with at most two states, of records with at most four samples; of what is not refuted with a total of at most 4."""
    box = claim.boxes["Q"]
    if isinstance(box, RecordBox):
        return replace(box, N=(box.N[0], min(box.N[1], 4)))
    return replace(box, n=(1, 2), total=box.total if claim.expected["Q"] == Answered.REFUTED else min(box.total, 4))


@pytest.mark.searches
@pytest.mark.parametrize("name", list(LITERATURE)[:: every()] + list(PAPERS))
def test_a_statement_of_the_field_gets_its_verdict(name: str) -> None:
    """What is known to be true is not refuted, and what is known to be false is."""
    claim = (LITERATURE | PAPERS)[name]
    (answer,) = deciding.decide(replace(claim, boxes={"Q": quick_box(claim)}), ablation=False, most=10**9, jobs=1, progress=silent)
    assert answer.as_expected, answer.title


@pytest.mark.slow
@pytest.mark.parametrize("name", list(LITERATURE))
def test_a_statement_of_the_field_gets_its_verdict_in_its_whole_box(name: str) -> None:
    """What is known to be false is refuted by the smallest case of the box, with certificates; it has n + m + p of at most 5."""
    (answer,) = deciding.decide(LITERATURE[name], ablation=False, most=10**9, jobs=1, progress=silent)
    assert answer.as_expected and answer.tried.exhausted == (answer.verdict != Answered.REFUTED), answer.title
    if answer.counterexample is not None:
        assert answer.counterexample.smallest and size_of(answer.counterexample.case)[0] <= 5
        for one in answer.counterexample.certificates:
            accept(one)


@pytest.mark.parametrize("name", list(EXAMPLES))
def test_an_example_is_answered_as_expected(name: str) -> None:
    answers = decide_claims([small_box(EXAMPLES[name])])
    assert answers.as_expected, answers.title
    for one in answers.certificates:
        accept(one)


def ledger_verdicts() -> dict[str, Verdict]:
    return {f"{claim.id}--{reading.id}": Verdict(reading.expected) for claim in load() for reading in claim.readings}


OF_MORE = [name for name, claim in LEDGER.items() if claim.about != SYSTEM]


def test_the_ledger_s_words_are_those_of_its_texts() -> None:
    """A text is REFUTED just where the ledger says so of the reading with its name."""
    told = ledger_verdicts()
    assert len(LEDGER) - len(OF_MORE) == 31 and len(OF_MORE) == 21
    for name, claim in LEDGER.items():
        assert told[name] in (Verdict.REFUTED, Verdict.CERTIFIED, Verdict.PROVED)
        assert dict(claim.expected) == {"Q": Answered.REFUTED if told[name] == Verdict.REFUTED else Answered.NOT_REFUTED}


@pytest.mark.slow
@pytest.mark.parametrize("name", OF_MORE)
def test_a_claim_of_the_ledger_about_more_than_a_system_gets_its_verdict_in_its_whole_box(name: str) -> None:
    (answer,) = deciding.decide(LEDGER[name], ablation=False, most=10**9, jobs=1, progress=silent)
    assert answer.as_expected, answer.title


@pytest.mark.searches
@pytest.mark.parametrize("name", [name for name in LEDGER if name not in OF_MORE][:: every()] + OF_MORE[:: 2 * every()])
def test_a_claim_of_the_ledger_gets_its_verdict(name: str) -> None:
    claim = LEDGER[name]
    box, refuted = claim.boxes["Q"], claim.expected["Q"] == Answered.REFUTED
    smaller_box = replace(box, n=(1, 2) if claim.about == SYSTEM else (1, 1), total=box.total if refuted else min(box.total, 4))
    (answer,) = deciding.decide(replace(claim, boxes={"Q": smaller_box}), ablation=False, most=10**9, jobs=1, progress=silent)
    assert answer.as_expected, answer.title


def test_the_known_systems_are_many_and_of_every_kind() -> None:
    for field in (QQ, PrimeField(2), PrimeField(5), field_from_json({"minimal_polynomial": ["-2", "0", "1"]})):
        listed = known_cases.known_systems(field)
        assert len(listed) > 300 and {one.origin for one in listed} == {"corpus", "adversary"}
        assert {one.subject.system.field for one in listed} == {listed[0].subject.system.field}
    sizes = {(one.subject.system.n, one.subject.system.m, one.subject.system.p) for one in known_cases.known_systems(QQ)}
    assert {0, 1, 2, 3} <= {n for n, _, _ in sizes} and 0 in {m for _, m, _ in sizes} and 0 in {p for _, _, p in sizes}


def test_explaining_shows_every_part() -> None:
    claim = EXAMPLES["counting"]
    told = [(text, value) for _, text, value in explain(claim, fs.System(A=[["1/2"]], F=[["-3/2"]], C=[[1]], G=[[1]]))]
    assert ("zeta", "1") in told and ("left_minimal_indices", "()") in told
    assert any(re.fullmatch(r"gap\(s\), s = 0", text) for text, _ in told)
    one = make_claim("x", {"conclusion": "left_minimal_indices[0] == 1"})
    assert any("no value" in value for _, _, value in explain(one, fs.System(A=[[1]], F=[[1]], C=[[1]], G=[[1]])))
