"""From the paper to the proofs: what a statement supposes is read from its text, and a case that meets a reading does meet it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from docs.tools.instances import meeting, supposed
from docs.tools.paper_to_proof import NONE, of_the_paper, page
from docs.tools.premises import premises
from faultspace.proofs.brought.readings import readings
from faultspace.proofs.language.evaluating import Exactly, evaluate, exactly
from faultspace.proofs.rocq.statements import Headline
from faultspace.proofs.verdict.ledger import load

ROOT = Path(__file__).parents[2]


def sections() -> dict[str, str]:
    """Return claim -> its section of the page."""
    _, *found = re.split(r"^## ", page(), flags=re.MULTILINE)
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
    told = re.findall(r"^- `(\w+)`, \[\w+\.v\]\(\.\./\.\./([^)]+)\), line (\d+)\.", page(), re.MULTILINE)
    assert {name for name, _, _ in told} == {name for claim in of_the_paper() for one in claim.readings for name in one.theorems}
    for name, file, line in told:
        assert (ROOT / file).read_text("utf-8").splitlines()[int(line) - 1].startswith(f"Theorem {name} ")


def test_the_page_counts_what_it_says() -> None:
    text = page()
    told = " ".join(text.split())
    empty = re.findall(rf"^\*\*([\w-]+)\*\*(?:(?!^\*\*)[\s\S])*?^- Met by: {NONE}\.", text, re.MULTILINE)
    assert f"; of {len(empty)} {NONE}: {', '.join(f'`{one}`' for one in empty)}." in told if empty else NONE not in told.partition("## ")[2]
    theorems = dict(re.findall(r"^- `(\w+)`, \[\w+\.v\].*?line \d+\. (.*)$", text, re.MULTILINE))
    proved = [name for name, said in theorems.items() if f"`{name}_instance`" in said]
    nothing = len(theorems) - len(proved)
    assert proved and f"{nothing} theorems suppose nothing of what they are about; of each of the other {len(proved)} it is" in told


STATEMENTS = [
    (" (K : fieldType) n : P n -> (0 < n)%N -> Q n", ("P n", "(0 < n)%N")),
    (" n : (forall k, P k -> Q k) -> let a := n in [/\\ Q a, R n -> S n & ~ T n]", ("forall k, P k -> Q k", "R n")),
    (" n : exists k, [/\\ P k, forall r, Q r <-> S r & exists2 g, T g & U g -> R g]", ("U g",)),
    (" n : [/\\ P n & ~ exists B, Q B /\\ R B]", ()),
    (" n : let S := System 0 1 1 0 in P S /\\ Q S", ()),
    (" n : P n <-> (Q n -> R n)", ()),
    (" n : P n /\\ Q n -> R n \\/ P n", ("P n /\\ Q n",)),
]


@pytest.mark.parametrize(("statement", "supposes"), STATEMENTS)
def test_what_a_statement_supposes(statement: str, supposes: tuple[str, ...]) -> None:
    assert premises(Headline("made_up", statement, "", "Headlines.v")) == supposes


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
