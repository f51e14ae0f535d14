"""Dropping hypotheses: the engine on subjects whose truth is known, and the experiments against the ledger."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product

import pytest

from faultspace.proofs import corpus
from faultspace.proofs.ablation import Experiment, Found, ablate
from faultspace.proofs.hypotheses import experiments
from faultspace.proofs.hypotheses.facets import flags
from faultspace.proofs.hypotheses.systems import gap, range_of_f, rank_formula
from faultspace.proofs.ledger import expected_without, load
from faultspace.proofs.search import Box, chunks
from faultspace.proofs.verdicts import Row, Verdict
from faultspace.proofs.workbench import Workbench
from tests.oracle import inspect_slowly


def quiet(stage: str, done: int, total: int) -> None:
    """Progress that nobody watches."""


@dataclass(frozen=True)
class Triple:
    """A subject with three properties, and whether the conclusion holds."""

    a: bool
    b: bool
    c: bool
    conclusion: bool
    weight: int = 1
    field: str = "Q"
    accepted: int = 2

    @property
    def size(self) -> tuple[int, ...]:
        return (self.a + self.b + self.c,)


def experiment(subjects: Sequence[Triple]) -> Experiment[Triple]:
    def search(bench: Workbench, dropped: Sequence[str]) -> Found[Triple]:
        failing = [s for s in subjects if not s.conclusion and all(getattr(s, name) for name in "abc" if name not in dropped)]
        return Found(min(failing, key=lambda s: s.size) if failing else None, "a box")

    return Experiment(
        "toy", "theorem-1", "it holds", {name: (lambda s, name=name: getattr(s, name)) for name in "abc"},  # type: ignore[misc]
        lambda s: s.conclusion, lambda bench: iter(subjects), search, lambda s: iter(()),
    )  # fmt: skip


def rows(subjects: Sequence[Triple], full: bool = False) -> dict[str, Row]:
    bench = Workbench("full" if full else "quick", 1, quiet)
    return {" ".join(row.dropped): row for row in ablate(bench, experiment(subjects), {})}


EVERY = [(a, b, c) for a, b, c in product((True, False), repeat=3)]


def test_a_hypothesis_is_needed_exactly_when_something_fails_without_it() -> None:
    found = rows([Triple(a, b, c, a) for a, b, c in EVERY])
    assert {name: row.verdict for name, row in found.items()} == {
        "a": "REFUTED", "b": "CERTIFIED", "c": "CERTIFIED", "a b": "REFUTED", "a c": "REFUTED", "b c": "CERTIFIED",
    }  # fmt: skip
    assert found["a b"].already == "a" and found["a"].already is None
    assert "4 tried" not in found["a"].evidence and "all 4 tried" in found["b c"].evidence and "3 of them" in found["b c"].evidence


def test_two_hypotheses_can_be_needed_only_together() -> None:
    found = rows([Triple(a, b, c, a or b) for a, b, c in EVERY])
    assert {name: row.verdict for name, row in found.items() if row.verdict == Verdict.REFUTED} == {"a b": Verdict.REFUTED}
    assert found["a b"].already is None


def test_a_claim_that_fails_with_all_its_hypotheses_is_an_error() -> None:
    found = rows([Triple(a, b, c, False) for a, b, c in EVERY])
    assert [row.verdict for row in found.values()] == ["ERROR"]
    assert not next(iter(found.values())).as_expected


def test_nothing_tried_is_an_error_and_not_a_verdict() -> None:
    assert {row.verdict for row in rows([]).values()} == {"ERROR"}
    assert rows([Triple(True, True, True, True)])["a"].verdict == "CERTIFIED"
    assert "none of these lacks it" in rows([Triple(True, True, True, True)])["a"].evidence


def test_what_fails_over_a_finite_field_alone_is_told() -> None:
    odd = [Triple(a, b, c, a, field="GF(2)") for a, b, c in EVERY]
    made = experiment(odd)
    made = replace(made, over_q=lambda bench, dropped: Found(None, "a box"))
    found = {" ".join(row.dropped): row for row in ablate(Workbench("quick", 1, quiet), made, {})}
    assert found["a"].verdict == "REFUTED" and "over GF(2), and none over Q" in found["a"].evidence


@pytest.fixture(scope="module")
def bench() -> Workbench:
    """A workbench with every ninth system of the quick corpus."""
    made = Workbench("quick", 1, quiet)
    sources = list(corpus._sources("quick"))[::9]
    made.corpus = corpus.Corpus(tuple(corpus.examine(*source) for source in sources))
    return made


def test_the_ledger_and_the_experiments_name_the_same() -> None:
    expected = expected_without()
    claims = {claim.id for claim in load()}
    assert list(expected) == [e.name for e in experiments()]
    for e in experiments():
        assert list(expected[e.name]) == list(e.hypotheses), e.name
        assert set(expected[e.name].values()) <= {"REFUTED", "CERTIFIED"} and e.claim in claims


@pytest.mark.parametrize("make", [rank_formula, gap, range_of_f])
def test_every_needed_hypothesis_has_a_counterexample_that_meets_the_others(make: object, bench: Workbench) -> None:
    e = make()  # type: ignore[operator]
    for row in ablate(bench, e, {}):
        if row.verdict == Verdict.REFUTED and row.already is None:
            found = e.over_q(bench, row.dropped).subject
            assert found is not None and e.violated(found) <= set(row.dropped) and not e.holds(found)
            assert row.certificates and str(found) in row.evidence


def test_a_conclusion_broken_on_purpose_is_noticed(bench: Workbench) -> None:
    expected = expected_without()["gap"]
    unsought = replace(gap(), over_q=lambda bench, dropped: Found(None, "no box"))
    assert all(row.as_expected for row in ablate(bench, unsought, expected))
    blind = ablate(bench, replace(unsought, holds=lambda subject: True), expected)
    assert not all(row.as_expected for row in blind)
    wrong = ablate(bench, replace(unsought, holds=lambda subject: subject.dossier.gap(subject.window) <= 1), expected)
    assert not all(row.as_expected for row in wrong)


def test_first_looks_are_the_definitions() -> None:
    """The vectorised hypotheses about one system against the slow oracle, on every system of a small box."""
    for facts in chunks(Box(total=4, largest_n=2, largest_m=1, largest_p=1)):
        for name in ("observable", "controllable", "left-invertible"):
            found = flags({name})(facts)
            for index in range(0, len(facts.A), 199):
                known = inspect_slowly(facts.system(index).to_json())
                assert found[index] == known[name.replace("-", "_")], (name, facts.system(index))
