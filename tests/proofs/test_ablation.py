"""These tests drop hypotheses: the engine on subjects whose truth is known, and the ablations against the ledger."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product

import pytest

from faultspace.base.progress import silent
from faultspace.proofs.boxes.box import Box, in_order, rows_where
from faultspace.proofs.evidence.corpus import CORPUS, examine
from faultspace.proofs.evidence.questions import RANKS
from faultspace.proofs.hypotheses import ablations, trajectories
from faultspace.proofs.hypotheses.facets import AIMED, HIDDEN_ZEROS, POOR, aimed_systems, degenerate, expressions, facets
from faultspace.proofs.hypotheses.systems import gap, range_of_f, rank_formula
from faultspace.proofs.quantities.batches import Batch
from faultspace.proofs.rocq.sources import sources
from faultspace.proofs.verdict.ablation import Ablation, Found, Proof, ablate, first_found
from faultspace.proofs.verdict.ledger import expected_without, load
from faultspace.proofs.verdict.verdicts import Row, Verdict
from faultspace.proofs.verdict.workbench import Workbench
from faultspace.proofs.verification import _Machine, _row_with_theorems
from tests.oracle import inspect_slowly


@dataclass(frozen=True)
class Triple:
    """This is a subject with three properties, and whether the conclusion holds."""

    a: bool
    b: bool
    c: bool
    conclusion: bool
    weight: int = 1
    field: str = "Q"
    accepted: frozenset[str] = frozenset({"one", "two"})
    degenerate: str = ""

    @property
    def size(self) -> tuple[int, ...]:
        return (self.a + self.b + self.c,)


def ablation(subjects: Sequence[Triple]) -> Ablation[Triple]:
    def search(bench: Workbench, dropped: Sequence[str]) -> Found[Triple]:
        failing = [s for s in subjects if not s.conclusion and all(getattr(s, name) for name in "abc" if name not in dropped)]
        return first_found(lambda poor: sorted((s for s in failing if bool(s.degenerate) == poor), key=lambda s: s.size), "a box")

    return Ablation(
        "toy", "theorem-1", "it holds", {name: (lambda s, name=name: getattr(s, name)) for name in "abc"},  # type: ignore[misc]
        lambda s: s.conclusion, lambda bench: iter(subjects), search, lambda s: iter(()),
    )  # fmt: skip


def rows_of(made: Ablation[Triple], expected: dict[str, str] | None = None) -> dict[str, Row]:
    return {" ".join(row.dropped): row for row in ablate(Workbench("quick", 1, silent), made, expected or {})}


def rows(subjects: Sequence[Triple]) -> dict[str, Row]:
    return rows_of(ablation(subjects))


EVERY = [(a, b, c) for a, b, c in product((True, False), repeat=3)]


def test_a_hypothesis_is_needed_exactly_when_something_fails_without_it() -> None:
    found = rows([Triple(a, b, c, a) for a, b, c in EVERY])
    assert {name: row.verdict for name, row in found.items()} == {
        "a": "REFUTED", "b": "CERTIFIED", "c": "CERTIFIED", "a b": "REFUTED", "a c": "REFUTED", "b c": "CERTIFIED",
    }  # fmt: skip
    assert found["a b"].already == "a" and found["a"].already is None
    assert found["b c"].evidence == "no counterexample among 4 tried that meet the others, 3 of which lack one of the two"
    assert (found["b c"].tried, found["b c"].lacking, found["b"].tried, found["b"].lacking) == (4, 3, 2, 1)
    assert found["b"].meaning == "not seen to be needed" and found["a"].meaning == "needed"


def test_what_was_tried_is_never_said_to_hold() -> None:
    for row in rows([Triple(a, b, c, True) for a, b, c in EVERY]).values():
        assert row.verdict == Verdict.CERTIFIED and "no counterexample among" in row.evidence and "holds" not in row.evidence


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
    alone = rows([Triple(True, True, True, True)])["a"]
    assert alone.verdict == "CERTIFIED" and "none of which lacks it; why, is not known" in alone.evidence
    assert not replace(alone, ledger="CERTIFIED").as_expected, "a row that rests on nothing"


def test_what_fails_over_a_finite_field_alone_is_told() -> None:
    odd = [Triple(a, b, c, a, field="GF(2)") for a, b, c in EVERY]
    made = replace(ablation(odd), over_q=lambda bench, dropped: Found(None, "a box"))
    found = rows_of(made)
    assert found["a"].verdict == "REFUTED" and "over GF(2), and none over Q" in found["a"].evidence


def test_a_witness_that_is_not_degenerate_comes_first_and_a_degenerate_one_is_told() -> None:
    poor, sound = Triple(False, False, False, False, degenerate="C = 0"), Triple(False, True, True, False)
    meets = [Triple(True, b, c, True) for b, c in product((True, False), repeat=2)]
    smaller = replace(poor, b=True, c=True)
    found = rows([*meets, smaller, sound])["a"]
    assert found.evidence.startswith(str(sound)) and "degenerate ones left out" in found.evidence
    row = rows([*meets, smaller])["a"]
    assert row.verdict == "REFUTED" and row.evidence.endswith("every counterexample found is degenerate: C = 0")


def test_a_hypothesis_follows_from_the_others_where_a_reason_is_given_and_no_subject_lacks_it() -> None:
    follows = [Triple(a, a or b, c, a) for a, b, c in EVERY]  # b wherever a is
    reason = {"b": "a makes it so"}
    found = rows_of(replace(ablation(follows), implied=reason), {"b": "IMPLIED", "c": "CERTIFIED", "a": "REFUTED"})
    assert found["b"].meaning == "follows from the others" and "a makes it so; of the 2 subjects" in found["b"].evidence
    assert all(found[name].as_expected for name in "abc")
    assert found["b"].to_json()["follows_from_the_others"] == "a makes it so"
    assert not rows_of(replace(ablation(follows), implied=reason), {"b": "CERTIFIED"})["b"].as_expected
    assert not rows_of(ablation(follows), {"b": "IMPLIED"})["b"].as_expected, "a reason is wanted"
    wrong = rows_of(replace(ablation([Triple(a, b, c, a) for a, b, c in EVERY]), implied=reason), {"b": "IMPLIED"})["b"]
    assert wrong.verdict == "ERROR" and "1 of the 2 subjects that meet the others lack it" in wrong.evidence


def test_a_row_is_proved_where_the_theorems_do_without_what_is_dropped() -> None:
    proved = replace(ablation([Triple(a, b, c, a) for a, b, c in EVERY]), proof=Proof(("some_theorem",), frozenset({"a"})))
    found = rows_of(proved, {"a": "REFUTED", "b": "CERTIFIED", "c": "CERTIFIED"})
    assert {name for name, row in found.items() if row.theorems} == {"b", "c", "b c"}
    checked = _Machine(object(), None, "")  # type: ignore[arg-type]
    decided = {name: _row_with_theorems(row, checked) for name, row in found.items()}
    assert [decided[name].verdict for name in ("a", "b", "c", "b c", "a b")] == ["REFUTED", "PROVED", "PROVED", "PROVED", "REFUTED"]
    assert all(row.as_expected for row in decided.values()) and decided["b"].expected == "PROVED" and decided["b"].meaning == "not needed"
    assert "some_theorem" in decided["b"].evidence and decided["b"].to_json()["theorems"] == ["some_theorem"]
    without_rocq = _row_with_theorems(found["b"], _Machine(None, None, ""))
    assert without_rocq == found["b"] and without_rocq.expected == "CERTIFIED" and without_rocq.to_json()["theorems"] == []
    broken = _row_with_theorems(found["b"], _Machine(None, "Rocq: broken", ""))
    assert broken.verdict == "ERROR" and not broken.as_expected


def test_a_counterexample_to_what_is_proved_is_an_error() -> None:
    made = replace(ablation([Triple(a, b, c, a) for a, b, c in EVERY]), proof=Proof(("some_theorem",)))
    assert rows_of(made)["a"].verdict == "ERROR" and "some_theorem prove it without" in rows_of(made)["a"].evidence


@pytest.fixture(scope="module")
def bench() -> Workbench:
    """Return a workbench with every ninth system of the quick corpus and every fourth of the aimed ones, twenty for each hypothesis."""
    made = Workbench("quick", 1, silent)
    made.put_answers(CORPUS, [examine(*item) for item in list(CORPUS[RANKS].items(made))[::9]])
    few = [*HIDDEN_ZEROS, *list(aimed_systems(80))[::4]]
    made.put_answers(AIMED, [examine("aimed", system) for system in few])
    return made


def test_the_ledger_and_the_experiments_name_the_same() -> None:
    expected = expected_without()
    claims = {claim.id for claim in load()}
    assert list(expected) == [e.name for e in ablations()]
    for e in ablations():
        assert list(expected[e.name]) == list(e.hypotheses), e.name
        assert set(expected[e.name].values()) <= {"REFUTED", "CERTIFIED", "IMPLIED"} and e.claim in claims
        assert {name for name, entry in expected[e.name].items() if entry == "IMPLIED"} == set(e.implied), e.name


def test_the_proofs_name_theorems_that_are_there_and_use_no_more_than_what_is_needed() -> None:
    texts = [text for file, text in sources().items() if file.startswith("Headlines")]
    there = {name for text in texts for name in re.findall(r"^Theorem (\w+)", text, re.MULTILINE)}
    for e in ablations():
        if e.proof is None:
            continue
        entries = expected_without()[e.name]
        assert set(e.proof.theorems) <= there and e.proof.hypotheses <= set(e.hypotheses), e.name
        needed = {name for name, entry in entries.items() if entry == "REFUTED"}
        assert needed <= e.proof.hypotheses <= needed | set(e.implied), e.name


@pytest.mark.parametrize("make", [rank_formula, gap, range_of_f])
def test_every_needed_hypothesis_has_a_counterexample_that_meets_the_others(make: object, bench: Workbench) -> None:
    e = make()  # type: ignore[operator]
    for row in ablate(bench, e, {}):
        if row.verdict == Verdict.REFUTED and row.already is None:
            found = e.over_q(bench, row.dropped).subject
            assert found is not None and e.violated(found) <= set(row.dropped) and not e.holds(found)
            assert row.certificates and str(found) in row.evidence and not found.degenerate


def test_a_conclusion_broken_on_purpose_is_noticed(bench: Workbench) -> None:
    expected = expected_without()["gap"]
    unsought = replace(gap(), over_q=lambda bench, dropped: Found(None, "no box"))
    assert all(row.as_expected for row in ablate(bench, unsought, expected))
    blind = ablate(bench, replace(unsought, holds=lambda subject: True), expected)
    assert not all(row.as_expected for row in blind)
    wrong = ablate(bench, replace(unsought, holds=lambda subject: subject.evidence.kernel.gap(subject.window) <= 1), expected)
    assert not all(row.as_expected for row in wrong)


@pytest.mark.parametrize("too_little", [{"left-invertible"}, {"s >= n"}, set()])
def test_a_proof_that_is_said_to_use_too_little_is_noticed(too_little: set[str], bench: Workbench) -> None:
    unsought = replace(gap(), over_q=lambda bench, dropped: Found(None, "no box"), proof=Proof(("proposition_3",), frozenset(too_little)))
    assert any(row.verdict == Verdict.ERROR for row in ablate(bench, unsought, expected_without()["gap"]))


def test_a_reason_why_a_hypothesis_follows_is_held_against_the_subjects(bench: Workbench) -> None:
    unsought = replace(gap(), over_q=lambda bench, dropped: Found(None, "no box"), implied={"observable": "it is said to"})
    found = next(row for row in ablate(bench, unsought, expected_without()["gap"]) if row.dropped == ("observable",))
    assert found.verdict == Verdict.ERROR and "lack it, although it is said to follow" in found.evidence


def batches(box: Box) -> Iterator[Batch]:
    for sizes in box.sizes():
        yield from (stretch.batch for stretch in box.stretches(sizes, reduced=False))


def test_first_looks_are_the_definitions() -> None:
    """What the hypotheses about one system say in the language agrees with the slow oracle, on every system of a small box."""
    for batch in batches(Box(n=(1, 2), m=(1, 1), p=(1, 1), total=4)):
        for name in ("observable", "controllable", "left-invertible"):
            found = set(rows_where(expressions({name}), batch))
            for index in range(0, len(batch), 199):
                known = inspect_slowly(batch.system(index).to_json())
                assert (index in found) == known[name.replace("-", "_")], (name, batch.system(index))


def test_the_first_look_at_a_poor_witness_is_what_is_said_of_it() -> None:
    """Of all systems with one fault or two; that the columns depend is no reason with one fault alone unless both are zero."""
    for batch in batches(Box(n=(1, 1), m=(1, 2), p=(1, 1), total=4)):
        poor = set(rows_where((POOR,), batch))
        assert [index in poor for index in range(len(batch))] == [bool(degenerate(batch.system(index))) for index in range(len(batch))]


def test_a_look_for_trajectories_leaves_out_what_cannot_fail() -> None:
    """With excitation kept these are left-invertible systems of lag 1 at most; without it, it is nothing but what violates what is kept."""
    for batch in batches(Box(n=(1, 2), m=(1, 1), p=(1, 2), total=4)):
        for kept in ((), (trajectories.PERSISTENT,), ("left-invertible", trajectories.FULL_ROW_RANK)):
            looks = {one: set(rows_where(tuple(trajectories._open_still(kept, one)), batch)) for one in (False, True)}
            for index in range(0, len(batch), max(1, len(batch) // 60)):
                system = batch.system(index)
                known = facets(system)
                settled = len(kept) > 0 and known.left_invertible and known.lag <= 1
                still = not settled and (known.left_invertible or "left-invertible" not in kept)
                poor = bool(degenerate(system))
                assert [index in looks[one] for one in (False, True)] == [still and poor == one for one in (False, True)]


def test_what_a_poor_witness_is() -> None:
    *_, sound = in_order(Box(n=(1, 1), m=(1, 1), p=(1, 1), total=3))
    assert degenerate(sound) == ""
    assert degenerate(sound.with_faults(sound.F - sound.F, sound.G)) == "F = 0"
    assert "dependent" in degenerate(sound.with_faults(sound.F - sound.F, sound.G - sound.G))
