"""From the paper to the proofs: what a statement supposes is read from its text, and a case that meets a reading does meet it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from faultspace.proofs.brought.instances import meeting, supposed
from faultspace.proofs.brought.readings import readings
from faultspace.proofs.language.evaluating import Exactly, evaluate, exactly
from faultspace.proofs.paper_page import NONE, of_the_paper
from faultspace.proofs.rocq.premises import examples, parts
from faultspace.proofs.rocq.sources import sources
from faultspace.proofs.rocq.statements import Headline, read
from faultspace.proofs.verdict.ledger import load

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "paper-to-proof.md"


def sections() -> dict[str, str]:
    """Return claim -> its section of the page."""
    _, *found = re.split(r"^## ", PAGE.read_text("utf-8"), flags=re.MULTILINE)
    return {text.partition("\n")[0]: text for text in found}


def test_every_claim_of_the_paper_is_on_the_page_with_its_readings() -> None:
    found = sections()
    assert list(found) == [claim.id for claim in load() if "[G25]" in claim.reference and not claim.reference.startswith("ours")]
    assert len(found) > 11
    for claim in of_the_paper():
        told = re.findall(r"^\*\*([\w-]+)\*\*(?: \(ours\))?, ([A-Z]+)\.", found[claim.id], re.MULTILINE)
        assert told == [(one.id, one.proved) for one in claim.readings]
        assert f"> {claim.statement}" in found[claim.id]


def test_every_theorem_of_the_page_is_a_headline_and_stands_on_that_line() -> None:
    told = re.findall(r"^- `(\w+)`, \[\w+\.v\]\(\.\./([^)]+)\), line (\d+)\.", PAGE.read_text("utf-8"), re.MULTILINE)
    assert {name for name, _, _ in told} == {name for claim in of_the_paper() for one in claim.readings for name in one.theorems}
    for name, file, line in told:
        assert (ROOT / file).read_text("utf-8").splitlines()[int(line) - 1].startswith(f"Theorem {name} ")
    headlines = read(sources()).headlines
    assert all(name in headlines for name in re.findall(r"`([a-z]\w+_\w+)` (?:and|says?|say)\b", PAGE.read_text("utf-8")))


def test_the_page_counts_what_it_says() -> None:
    text = PAGE.read_text("utf-8")
    readings_without = len(re.findall(rf"^- Met by: {NONE}\.", text, re.MULTILINE))
    assert f"of {readings_without} {NONE}. " in " ".join(text.split())
    theorems = dict(re.findall(r"^- `(\w+)`, \[\w+\.v\].*?line \d+\. (.*)$", text, re.MULTILINE))
    lacking = [name for name, told in theorems.items() if NONE in told]
    listed = re.search(rf"of (\d+) {NONE}: ([^.]+)\.", " ".join(text.split()))
    assert listed is not None
    assert int(listed[1]) == len(lacking) and set(re.findall(r"`(\w+)`", listed[2])) == set(lacking)


STATEMENTS = [
    (" (K : fieldType) n : P n -> (0 < n)%N -> Q n", ("P n", "(0 < n)%N"), ("Q n",), False),
    (" n : (forall k, P k -> Q k) -> let a := n in [/\\ Q a, R n -> S n & ~ T n]", ("forall k, P k -> Q k", "R n"), ("Q a", "S n"), False),
    (" n : exists k, [/\\ P k, forall r, Q r <-> S r & exists2 g, T g & R g]", (), ("P k", "T g", "R g"), True),
    (" n : [/\\ P n & ~ exists B, Q B /\\ R B]", (), ("P n",), False),
    (" n : let S := System 0 1 1 0 in P S /\\ Q S", (), ("P S", "Q S"), True),
    (" n : P n <-> (Q n -> R n)", (), (), False),
    (" n : P n /\\ Q n -> R n \\/ P n", ("P n /\\ Q n",), (), False),
]


@pytest.mark.parametrize(("statement", "premises", "plainly", "example"), STATEMENTS)
def test_a_statement_is_taken_apart(statement: str, premises: tuple[str, ...], plainly: tuple[str, ...], example: bool) -> None:
    found = parts(Headline("made_up", statement, "", "Headlines.v"))
    assert (found.premises, found.plainly, found.example) == (premises, plainly, example)


TINY = {
    "Vocabulary.v": "Definition one := 1.\nDefinition two := 2.\nDefinition three := 3.\n",
    "Headlines.v": "From faultspace Require Import Vocabulary.\n"
    "Theorem there : exists k, one k.\nProof. by []. Qed.\n"
    "Theorem not_there k : ~ two k.\nProof. by []. Qed.\n"
    "Theorem always (S : system K n m p) : one S -> two S.\nProof. by []. Qed.\n"
    "Theorem elsewhere k : one k -> three k.\nProof. by []. Qed.\n",
}


def test_words_are_said_by_an_example_and_by_what_is_about_all_systems() -> None:
    found = examples(read(TINY))
    one, two, three = (f"Vocabulary.{name}" for name in ("one", "two", "three"))
    assert found.given == {"there": {one}} and list(found.of_all) == ["always"]
    assert found.saying(frozenset({one})).names == ("there",)
    assert found.saying(frozenset({one, two})).names == ("there", "always")
    assert found.saying(frozenset({one, three})).lacking == {three}


def test_what_a_conclusion_supposes_itself() -> None:
    assert supposed("implies(equal_on(n), equal)") == ["equal_on(n)"]
    assert supposed("all(implies(exciting(s), gap(s) == m)\n for s in windows(n))") == ["any((exciting(s) for s in windows(n)))"]
    assert supposed("all(gap(s) == m for s in windows(n)) and p == m") == []


@pytest.mark.parametrize(
    ("name", "refuted"),
    [
        ("theorem-1--n-samples", True),
        ("theorem-1--either-lag", False),
        ("problem-11--window-n", True),
        ("assumption-4--n-unknown", False),
        ("assumption-4--persistency-suffices", False),
    ],
)
def test_a_case_meets_the_reading_and_fails_it_where_that_is_refuted(name: str, refuted: bool) -> None:
    *hypotheses, conclusion = readings()[name].nodes
    case = meeting(name, refuted=refuted)
    assert case is not None
    knows: Exactly = exactly(case)
    assert all(evaluate(one, knows) for one in hypotheses)
    assert bool(evaluate(conclusion, knows)) is not refuted
