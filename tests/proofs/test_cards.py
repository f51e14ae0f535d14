"""Each claim has a card, of readings that the ledger has, in short sentences; it says them of a run that is as expected."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from faultspace.proofs.verdict.cards import UNCHECKED, card, hold
from faultspace.proofs.verdict.ledger import Claim, load, sentences
from faultspace.proofs.verdict.verdicts import ClaimResult, Outcome, ReadingResult, Verdict
from faultspace.proofs.verification import verify

CLAIMS = {claim.id: claim for claim in load()}
LONGEST = 25  # words, formulas left out


def found(claim: Claim, verdicts: dict[str, Verdict]) -> ClaimResult:
    """Return the claim with these verdicts on its readings, those that the ledger expects on the others."""
    outcomes = [(one, Outcome(verdicts.get(one.id, Verdict(one.expected)), "")) for one in claim.readings]
    return ClaimResult(claim, tuple(ReadingResult(one, outcome, 0.0) for one, outcome in outcomes))


@pytest.mark.parametrize("name", CLAIMS)
def test_every_claim_has_a_card_of_readings_that_are_refuted(name: str) -> None:
    said = sentences()[name]
    refuted = {one.id for one in CLAIMS[name].readings if one.expected == "REFUTED"}
    assert set(said) <= {"verdict", "instead", "wrong"} and set(said.get("wrong", {})) <= refuted
    for text in (said["verdict"], *said.get("wrong", {}).values()):
        assert all(len(re.findall(r"[A-Za-z-]{2,}", sentence)) <= LONGEST for sentence in re.split(r"(?<=[.:;]) ", text)), text


def test_no_card_is_of_another_claim() -> None:
    assert set(sentences()) == set(CLAIMS)


@pytest.mark.parametrize("name", CLAIMS)
def test_a_card_says_nothing_where_a_verdict_is_another_one(name: str) -> None:
    claim = CLAIMS[name]
    first = claim.readings[0]
    other = Verdict.ERROR if first.expected == "REFUTED" else Verdict.REFUTED
    shown = card(found(claim, {first.id: other}))
    assert shown.verdict.startswith(f"NOT as expected: {first.id} is {other}, ") and (shown.instead, shown.wrong) == ("", ())
    assert card(found(claim, {})).verdict == sentences()[name]["verdict"]


def test_a_card_says_where_no_theorem_was_checked() -> None:
    """Its sentence says more than certificates show; in a run without Rocq it is not said alone."""
    whole = found(CLAIMS["theorem-1"], {})
    locked = replace(whole, readings=tuple(replace(one, locks={"a": "0" * 64}) for one in whole.readings))
    assert card(locked).verdict == f"{sentences()['theorem-1']['verdict']} {UNCHECKED}" and "in this run it has not" in card(locked).why[0]
    checked = [(one, replace(one.outcome, verdict=Verdict(one.reading.proved))) for one in locked.readings]
    proved = tuple(replace(one, outcome=outcome, machine_checked=True) for one, outcome in checked)
    assert card(replace(locked, readings=proved)).verdict == sentences()["theorem-1"]["verdict"]


def test_the_numbers_are_those_of_the_certificates() -> None:
    (claim,) = verify(["example-v"], jobs=1).claims
    (wrong,) = card(claim).wrong
    assert "rank R5 = 7 and rank R6 = 8" in wrong.sentence and "F = (1, a, a^2)'" in wrong.system
    last = claim.readings[-2]
    assert last.reading.id == wrong.reading
    changed = [{**one, "statement": one["statement"] | {"rank": one["statement"]["rank"] + 1}} for one in last.outcome.certificates]
    other = replace(last, outcome=replace(last.outcome, certificates=tuple(changed)))
    readings = tuple(other if one is last else one for one in claim.readings)
    assert "rank R5 = 8 and rank R6 = 9" in card(replace(claim, readings=readings)).wrong[0].sentence
    assert hold(claim) == "readings that hold: 5 of 7"
