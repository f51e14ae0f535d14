"""The points of the review: all that it counts, in its order, with claims of the ledger behind them."""

from __future__ import annotations

import os
from collections import Counter
from pathlib import Path

import pytest

from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.review_points import review, source

# What the review says of itself: "3 major comments / 5 minor", "2 free parameters, 7 assumptions", and lists to count.
COUNTED = {
    "Major comments": 3,
    "Minor comments": 5,
    "Free parameters": 2,
    "Assumptions": 7,
    "If this is right": 5,
    "Reading between the lines": 3,
    "What would settle it": 2,
}


def test_nothing_that_the_review_counts_is_left_out() -> None:
    sections = Counter(point.section for point in review())
    assert {name: sections[name] for name in COUNTED} == COUNTED
    assert set(sections) - set(COUNTED) == {"Core claim", "Load-bearing premise", "Circularity check"}


def test_the_claims_behind_it_are_in_the_ledger_and_none_of_the_papers_is_left_out() -> None:
    claims = {claim.id for claim in load()}
    named = {name for point in review() for name in point.cards}
    assert named <= claims and claims - named == {"past-outputs"}, "ours, and no point of the review"


def test_each_point_stands_in_the_review_in_this_order() -> None:
    data = os.environ.get("FAULTSPACE_DATA")
    text = Path(data).parent / "paper-review.txt" if data else None
    if text is None or not text.exists():
        pytest.skip("FAULTSPACE_DATA does not name a folder beside paper-review.txt, the review's text")
    said = text.read_text("utf-8")
    points = [point for point in review() if point.section != "Free parameters"]
    places = [said.find(point.quote) for point in points]
    assert -1 not in places and places == sorted(places)
    assert all(point.quote in said for point in review()) and source()["address"] in said
