"""Claims that are brought: files, boxes, verdicts, counterexamples with certificates, and the ledger's claims in the language."""

from __future__ import annotations

import json
import time
import tomllib
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

import faultspace as fs
from faultspace.base.errors import InvalidInput
from faultspace.exact import ResidualSystem
from faultspace.packaged_examples import CLAIMS, content
from faultspace.proofs.boxes import box as boxes
from faultspace.proofs.boxes.box import Box
from faultspace.proofs.brought.answers import ClaimAnswer, Counterexample
from faultspace.proofs.brought.claim_files import read_claims
from faultspace.proofs.brought.claims import Answered, make_claim
from faultspace.proofs.brought.known_cases import smaller
from faultspace.proofs.language.evaluating import Exactly, evaluate
from faultspace.proofs.quantities.blocks import height
from faultspace.proofs.quantities.registry import Subject, quantities
from faultspace.proofs.trust.structure_certificates import accept

SMALL = {"total": 4}


def decided(conclusion: Any, *hypotheses: Any, box: dict[str, Any] | None = None, **options: Any) -> ClaimAnswer:
    return fs.claim(conclusion, hypotheses=hypotheses, box=SMALL if box is None else box, **options).answers[0]


def found(answer: ClaimAnswer) -> Counterexample:
    assert answer.verdict == Answered.REFUTED and answer.counterexample is not None
    return answer.counterexample


# -- the box -----------------------------------------------------------------------------------------------------------


def in_order(box: Box) -> Iterator[ResidualSystem]:
    """Yield every system of a box over Q, sorted as the contract says."""
    for n, m, p in sorted(product(*(range(low, high + 1) for low, high in (box.n, box.m, box.p))), key=lambda one: (sum(one), one)):
        if n + m + p > box.total:
            continue
        every = list(product(sorted(box.entries), repeat=(n + p) * (n + m)))
        for entries in sorted(every, key=lambda one: (max((height(x) for x in one), default=0), one)):
            rest = iter(entries)
            parts = ([[next(rest) for _ in range(b)] for _ in range(a)] for a, b in ((n, n), (n, m), (p, n), (p, m)))
            yield ResidualSystem.of(*parts, n=n, m=m, p=p)


BOXES = [
    Box(total=3),
    Box(n=(0, 1), m=(0, 1), p=(0, 1), total=3),
    Box(n=(1, 1), m=(1, 1), p=(1, 1), entries=tuple(Fraction(x) for x in ("-2", "-1/2", "0", "1/2", "1"))),
    Box(n=(1, 1), m=(1, 1), p=(1, 1), entries=(Fraction(0), Fraction(1), Fraction(3))),
    Box(n=(1, 1), m=(1, 2), p=(1, 2), total=3),
    Box(n=(0, 0), m=(0, 1), p=(0, 2), total=3, entries=(Fraction(-1), Fraction(0), Fraction(2))),
]


@pytest.mark.parametrize("box", BOXES, ids=str)
def test_a_box_is_gone_through_in_the_stated_order(box: Box) -> None:
    listed = []
    for sizes in box.sizes():
        for stretch in box.stretches(sizes, reduced=False):
            order = range(len(stretch.batch))
            listed += [stretch.batch.system(int(i)) for i in order]
    assert listed == list(in_order(box))


@pytest.mark.parametrize("sizes", [(1, 1, 1), (1, 2, 2), (2, 1, 1), (0, 1, 2), (2, 1, 2), (3, 1, 1)])
@pytest.mark.parametrize("prime", [None, 2, 3])
def test_the_systems_that_are_looked_at_stand_for_all(sizes: tuple[int, int, int], prime: int | None) -> None:
    box = make_claim("x", {"conclusion": "n == 1", "fields": ["Q" if prime is None else f"GF({prime})"]}).boxes
    one = next(iter(box.values()))
    total = sum(int(stretch.weights.sum()) for stretch in one.stretches(sizes, reduced=True))
    assert total == one.count(*sizes)


def orbit(system: tuple[Any, ...]) -> set[tuple[tuple[int, ...], ...]]:
    """Return every system that renumbering and changes of sign make of A, F, C, G, as tuples of entries."""
    A, F, C, G = system
    changes = [boxes._changes(size, True) for size in (A.shape[0], C.shape[0], F.shape[1])]
    return {
        tuple(tuple(int(x) for x in part.ravel()) for part in (T.T @ A @ T, T.T @ F @ V, U.T @ C @ T, U.T @ G @ V))
        for T, U, V in product(*changes)
    }


@pytest.mark.parametrize("sizes", [(1, 1, 1), (1, 2, 1), (2, 1, 1)])
def test_the_first_of_each_orbit_is_looked_at_and_no_other(sizes: tuple[int, int, int]) -> None:
    box, n, m, p = Box(total=4), *sizes
    firsts, seen = set(), set()
    for numbers in product((-1, 0, 1), repeat=(n + p) * (n + m)):
        if numbers not in seen:
            A, F, C, G = np.split(np.array(numbers), np.cumsum([n * n, n * m, p * n]))
            images = orbit((A.reshape(n, n), F.reshape(n, m), C.reshape(p, n), G.reshape(p, m)))
            firsts.add(min(images))
            seen |= {sum(one, ()) for one in images}
    looked_at = set()
    for stretch in box.stretches(sizes, reduced=True):
        batch = stretch.batch
        for i, weight in enumerate(stretch.weights):
            parts = tuple(part[i] for part in (batch.A, batch.F, batch.C, batch.G))
            looked_at.add(tuple(tuple(int(x) for x in part.ravel()) for part in parts))
            assert weight == len(orbit(parts))
    assert looked_at == firsts


# -- verdicts ----------------------------------------------------------------------------------------------------------

REFUTED = [
    ("delay_known <= n - nullity(G)", ["left_invertible"]),
    ("all(gap(s) == m for s in windows(n - 1))", ["left_invertible", "observable"]),
    ("finite_zeros == 0", ["minimal"]),
    ("rank(F @ C) <= 0", ["m == p"]),  # not invariant: all systems are looked at
    ("strongly_observable", ["observable", "rank(F) == m"]),
    ("minimum_phase", ["left_invertible", "stable"]),
    ("controllability_index <= 1", []),
]


@pytest.mark.parametrize(("conclusion", "hypotheses"), REFUTED)
def test_the_counterexample_is_the_first_of_the_box(conclusion: str, hypotheses: list[str]) -> None:
    answer = decided(conclusion, *hypotheses, ablation=False)
    claim = make_claim("x", {"conclusion": conclusion, "hypotheses": hypotheses, "box": SMALL})

    def fails(system: ResidualSystem) -> bool:
        exactly = Exactly({"": Subject(system)})
        return all(evaluate(one.that, exactly) for one in claim.hypotheses) and not evaluate(claim.conclusion, exactly)

    assert found(answer).system == next(one for one in in_order(claim.boxes["Q"]) if fails(one))
    assert found(answer).smallest


def test_a_rational_box_is_decided_too() -> None:
    box = {"n": [1, 1], "m": [1, 1], "p": [1, 1], "entries": ["-1/2", 0, "1/2", 2]}
    answer = decided("implies(left_invertible, minimum_phase)", box=box)
    system = found(answer).system
    assert system == next(one for one in in_order(make_claim("x", {"conclusion": "n == 1", "box": box}).boxes["Q"]) if fails_phase(one))


def fails_phase(system: ResidualSystem) -> bool:
    exactly = Exactly({"": Subject(system)})
    return bool(exactly.quantity("", "left_invertible")) and not exactly.quantity("", "minimum_phase")


@pytest.mark.parametrize("jobs", [1, 2])
def test_processes_change_nothing(jobs: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("faultspace.proofs.brought.kept.WORTH_SHARING", 10)
    answer = decided("delay_known <= n - nullity(G) or n == 1", "left_invertible", box={"total": 4}, jobs=jobs)
    assert found(answer).system == ResidualSystem.of([[-1, -1], [-1, -1]], [[-1], [0]], [[-1, -1]], [[0]]) or found(answer).smallest
    assert found(answer).system == found(decided("delay_known <= n - nullity(G) or n == 1", "left_invertible")).system


def test_what_a_claim_reads_comes_with_certificates() -> None:
    answer = decided("delay_known <= n - nullity(G)", "left_invertible", "stable or not stable")
    seen = found(answer)
    assert dict(seen.quantities) == {"left_invertible": True, "stable": False, "delay_known": 1, "n": 1, "nullity(G)": 1}
    assert seen.computed == ("stable",)  # no kind of certificate says that a system is not stable
    assert {one["kind"] for one in seen.certificates} == {"left-invertible", "inversion-delay", "matrix-rank"}
    for one in seen.certificates:
        accept(one)
    assert "computed, not certified" in answer.summary()


@pytest.mark.searches
def test_every_quantity_of_a_counterexample_is_certified_or_named() -> None:
    for name, one in quantities().items():
        text = f"{name}(2)" if one.windowed else name
        wrong = f"{text} == {text} and n == 2" if one.kind != "true or false" else f"({text} or not {text}) and n == 2"
        seen = found(decided(wrong, ablation=False))
        assert text in seen.quantities
        assert (text in seen.computed) == (one.certificates is None or (name == "stable" and not seen.quantities[text])), text


def test_vacuous_is_told_and_what_makes_it_so() -> None:
    answer = decided("lag == 7", "strongly_observable", "unobservable_dimension >= 1")
    assert answer.verdict == Answered.VACUOUS and answer.tried.met == 0
    assert answer.dropped is not None and [one.verdict for one in answer.dropped] == [Answered.REFUTED, Answered.REFUTED]


def test_a_hypothesis_that_is_not_needed_is_not_called_needed() -> None:
    answer = decided("all(gap(s) == m for s in windows(n))", "left_invertible", "observable")
    assert answer.verdict == Answered.PROVED and answer.dropped is not None
    needed, unneeded = answer.dropped
    assert needed.verdict == Answered.REFUTED and needed.case is not None and "needed" in needed.words
    assert unneeded.verdict == Answered.PROVED and "not needed" in unneeded.words
    shown = decided("delay_unknown >= delay_known", "observable", box={"total": 3}).dropped
    assert shown is not None and shown[0].verdict == Answered.NOT_REFUTED and "not shown to be needed" in shown[0].words


def test_counts_are_those_of_all_systems() -> None:
    answer = decided("n >= 1", "left_invertible", box={"n": [1, 1], "m": [1, 1], "p": [1, 2]})
    listed = list(in_order(Box(n=(1, 1), m=(1, 1), p=(1, 2))))
    assert answer.tried.systems == len(listed) == 81 + 729
    assert answer.tried.met == sum(fs.analyze(one).left_invertible for one in listed)


def test_a_box_that_is_not_exhausted_says_so() -> None:
    answer = decided("lag <= n", box={"total": 5}, most=1000)
    assert answer.verdict == Answered.PROVED and not answer.tried.exhausted and 1000 <= answer.tried.systems < 10**6
    assert "the first" in answer.tried.words
    huge = decided("lag <= n", box={"n": [6, 6], "m": [1, 1], "p": [1, 1], "total": 8})
    assert huge.tried.systems == 0 and not huge.tried.exhausted


def test_a_counterexample_outside_the_box_is_made_smaller() -> None:
    answer = decided("n <= 2 or not observable", box={"n": [1, 2], "m": [1, 1], "p": [1, 1]})
    seen = found(answer)
    assert not seen.smallest and seen.system.n == 3
    assert answer.counterexample is not None and "not from the box" in answer.summary()
    entries = [x for name in "AFCG" for row in getattr(seen.system, name).elements() for x in row]
    assert set(map(int, entries)) <= {-1, 0, 1}


def test_making_smaller_ends_where_no_step_fails() -> None:
    start = ResidualSystem.of([[3, 2], ["1/2", 5]], [[1, 2], [3, 4]], [[5, 6], [7, 8]], [[0, 9], [1, "7/3"]])
    end = smaller(start, lambda one: isinstance(one, ResidualSystem) and one.n >= 1 and not one.A.is_zero())
    assert isinstance(end, ResidualSystem)
    assert (end.n, end.m, end.p) == (1, 0, 0) and end.A[0, 0] == 1


def test_a_predicate_of_python_is_a_claim() -> None:
    answer = decided(lambda s: s.delay_known <= s.n - 1, lambda s: s.left_invertible and s.rank_OT(2) >= 1)
    text = decided("delay_known <= n - 1", "left_invertible and rank_OT(2) >= 1")
    assert found(answer).system == found(text).system and answer.tried.systems == text.tried.systems
    with pytest.raises(InvalidInput, match="no quantity; the nearest is lag"):
        decided(lambda s: s.lagg == 1)
    with pytest.raises(InvalidInput, match="matrices stand in text alone"):
        decided(lambda s: s.A)
    with pytest.raises(InvalidInput, match="returned 1"):
        decided(lambda s: s.n)
    with pytest.raises(InvalidInput, match="ZeroDivisionError"):
        decided(lambda s: 1 // (s.n - 1) > 0)


def test_a_claim_without_a_value_names_the_system_and_the_guard() -> None:
    with pytest.raises(InvalidInput, match=r"on A=\[\[-1\]\].*guard it with len\(left_minimal_indices\)"):
        decided("left_minimal_indices[0] >= 0")
    answer = decided("left_minimal_indices[0] >= 0", "p > normal_rank")
    assert answer.verdict == Answered.NOT_REFUTED and answer.dropped is not None
    assert answer.dropped[0].verdict is None and "no value" in answer.dropped[0].words


@pytest.mark.searches
@pytest.mark.parametrize("field", ["GF(2)", "GF(3)", "GF(5)"])
def test_over_prime_fields_the_same_is_found(field: str) -> None:
    box = {"n": [1, 1], "m": [1, 1], "p": [1, 1]}
    answer = decided("finite_zeros == 0", "minimal", fields=[field], box=box)
    assert found(answer).system.field == fs.System(A=[[1]], F=[[1]], C=[[1]], G=[[1]], field={"prime": int(field[3])}).field
    assert decided("all(gap(s) == m for s in windows(n))", "left_invertible", fields=[field], box=box).verdict == Answered.PROVED


def test_two_ways_that_disagree_are_an_error_of_ours(monkeypatch: pytest.MonkeyPatch) -> None:
    right = quantities()["lag"]
    monkeypatch.setitem(quantities(), "lag", replace(right, from_ranks=lambda r: right.from_ranks(r) + 1))
    with pytest.raises(ArithmeticError, match="disagree"):
        decided("lag <= n")


def test_a_broken_quantity_refutes_a_theorem(monkeypatch: pytest.MonkeyPatch) -> None:
    """A quantity that is wrong in both of its ways is noticed by a claim that Rocq has proved: an error of ours, and red."""
    right = quantities()["finite_zeros"]
    wrong = replace(right, exact=lambda x: right.exact(x) + (x.system.n > 1), from_ranks=lambda r: right.from_ranks(r) + (r.n > 1))
    monkeypatch.setitem(quantities(), "finite_zeros", wrong)
    conclusion = "sum(left_minimal_indices) + sum(right_minimal_indices) + finite_zeros + infinite_zeros == n"
    with pytest.raises(ArithmeticError, match=r"follows from window_ranks_indices.* and yet A=.* refutes it"):
        decided(conclusion, ablation=False)
    monkeypatch.setitem(quantities(), "finite_zeros", right)
    assert decided(conclusion, ablation=False).verdict == Answered.PROVED


def test_a_one_line_claim_takes_seconds() -> None:
    """The default box has 44157069 systems; two cores are to take less than ten seconds for it, and one takes a few."""
    began = time.process_time()
    answer = fs.claim("all(gap(s) == m for s in windows(n))", hypotheses=["left_invertible"], ablation=False).answers[0]
    assert answer.verdict == Answered.PROVED and answer.tried.exhausted and answer.tried.systems == 44157069
    assert time.process_time() - began < 20  # twice the ten seconds, of one core


# -- files -------------------------------------------------------------------------------------------------------------

GOOD = """
format = "faultspace-claims/1"
[claim.first]
conclusion = "lag <= n"
[claim.second]
statement = "said"
source = "somewhere"
about = "system"
hypotheses = ["left_invertible", { that = "n >= 1", label = "states" }]
conclusion = '''
lag <= n
and n >= 0'''
fields = ["Q", "GF(2)"]
box = { n = [0, 2], m = [1, 2], p = [1, 2], total = 4, entries = [-1, "1/3", 0] }
expected = { Q = "NOT REFUTED", "GF(2)" = "NOT REFUTED" }
"""

BAD = [
    ("", "no claim"),
    ("x = 1", "line 1: got the key 'x' at the top"),
    ("[claim", "no TOML"),
    ("[claims.x]\nconclusion = 'n == 1'", "the nearest is claim"),
    ("format = 'faultspace-claims/2'\n[claim.x]\nconclusion = 'n == 1'", "line 1: got the format 'faultspace-claims/2'"),
    ("[claim.x]\nstatement = 'y'", "claim.x.conclusion: got none"),
    ("[claim.x]\nconclusion = 'n == 1'\nhypothesis = []", "line 3: claim.x.hypothesis: got an unknown key; the nearest is hypotheses"),
    ("[claim.x]\nconclusion = 'lagg == 1'", "line 2: claim.x.conclusion: column 1: got 'lagg'"),
    ("[claim.x]\nconclusion = 3", "line 2: claim.x.conclusion: got 3, expected an expression as a string"),
    ("[claim.x]\nconclusion = 'n == 1'\n[claim.y]\n\nconclusion = 'n = 1'", "line 5: claim.y.conclusion: column"),
    ("[claim.x]\nhypotheses = [\n  'n == 1',\n  'm',\n]\nconclusion = 'n == 1'", "line 4: claim.x.hypotheses[1]: column 1: got 'm'"),
    ("[claim.x]\nhypotheses = [{that = 'n == 1', name = 'y'}]\nconclusion = 'n == 1'", "line 2: claim.x.hypotheses[0]: got"),
    ("[claim.x]\nhypotheses = 'n == 1'\nconclusion = 'n == 1'", "expected a list of at most"),
    ("[claim.x]\nconclusion = 'n == 1'\nabout = 'pairs'", "line 3: claim.x.about: got 'pairs'; the nearest is pair"),
    ("[claim.x]\nconclusion = 'n == 1'\nabout = 'recrod'", "line 3: claim.x.about: got 'recrod'; the nearest is record"),
    ("[claim.x]\nconclusion = 'n == 1'\nfields = ['Q(a)']", 'expected "Q", "GF(q)"'),
    ("[claim.x]\nconclusion = 'n == 1'\nfields = ['GF(4)']", "with a prime q"),
    ("[claim.x]\nconclusion = 'n == 1'\nfields = ['Q', 'Q']", "none twice"),
    ("[claim.x]\nconclusion = 'n == 1'\nfields = []", "expected a list such as"),
    ("[claim.x]\nconclusion = 'stable'\nfields = ['GF(2)']", "no unit circle"),
    ("[claim.x]\nconclusion = 'schur_stable(A)'\nfields = ['GF(2)']", "no unit circle"),
    ("[claim.x]\nconclusion = 'n == 1'\nbox = {n = [3, 1]}", "line 3: claim.x.box.n: got [3, 1], expected [first, last]"),
    ("[claim.x]\nconclusion = 'n == 1'\nbox = {n = [1, 99]}", "expected [first, last]"),
    ("[claim.x]\nconclusion = 'n == 1'\nbox = {total = 2}", "got an empty box"),
    ("[claim.x]\nconclusion = 'n == 1'\nbox = {totl = 2}", "the nearest is total"),
    ("[claim.x]\nconclusion = 'n == 1'\nbox = {total = true}", "expected an integer"),
    ("[claim.x]\nconclusion = 'n == 1'\nbox = 3", "expected a table"),
    ("[claim.x]\nconclusion = 'n == 1'\nbox = {entries = [0.5]}", "got 0.5"),
    ("[claim.x]\nconclusion = 'n == 1'\nbox = {entries = []}", "at most"),
    ("[claim.x]\nconclusion = 'n == 1'\nbox = {entries = ['1/2']}\nfields = ['GF(2)']", "denominators that 2 does not divide"),
    ("[claim.x]\nconclusion = 'n == 1'\nexpected = 'TRUE'", "expected one of REFUTED, NOT REFUTED, VACUOUS, PROVED"),
    ("[claim.x]\nconclusion = 'n == 1'\nexpected = 'IDENTITY'", "expected one of REFUTED, NOT REFUTED, VACUOUS, PROVED"),
    ("[claim.x]\nconclusion = 'n == 1'\nexpected = {'GF(2)' = 'REFUTED'}", "a field that the claim does not list"),
    ("[claim.x]\nconclusion = 'n == 1'\nstatement = 3", "line 3: claim.x.statement: got 3"),
    ("[claim.'a b']\nconclusion = 'n == 1'", "line 1: got the name 'a b'"),
    ("[claim]\nx = 3", "expected a table [claim.x]"),
    ("claim = 3", "tables [claim.NAME]"),
]


def test_a_file_is_read() -> None:
    first, second = read_claims(GOOD)
    assert (first.id, second.id, second.statement, second.source) == ("first", "second", "said", "somewhere")
    assert first.boxes == {"Q": Box()} and set(second.boxes) == {"Q", "GF(2)"}
    assert [one.label for one in second.hypotheses] == ["left_invertible", "states"]
    assert list(map(str, second.boxes["Q"].entries)) == ["-1", "0", "1/3"] and list(map(str, second.boxes["GF(2)"].entries)) == ["0", "1"]
    assert second.boxes["Q"].n == (0, 2) and second.boxes["Q"].total == 4
    assert second.expected == {"Q": Answered.NOT_REFUTED, "GF(2)": Answered.NOT_REFUTED}


def test_an_answer_says_what_was_decided_whatever_it_is_called() -> None:
    """ "Observable" was all that was told of what is PROVED here, and of observable systems is false."""
    called = {"that": "m == 0 and left_invertible", "label": "observable"}
    for hypothesis, words in (called, "observable: m == 0 and left_invertible"), ("observable", "observable"):
        (answer,) = fs.claim("n_z == zeta + m", hypotheses=[hypothesis], box={"total": 3}, ablation=False).answers  # type: ignore[list-item]
        assert answer.verdict == (Answered.PROVED if hypothesis is called else Answered.REFUTED)
        assert ("hypotheses", words) in answer.sheet()

    def observable(system: Any) -> bool:
        return bool(system.m == 0)

    (answer,) = fs.claim("lag <= n", hypotheses=[observable], box={"total": 3}, ablation=False).answers
    assert ("hypotheses", "observable, a predicate of Python") in answer.sheet()


@pytest.mark.parametrize(("text", "words"), BAD)
def test_what_is_wrong_in_a_file_is_told_with_its_line(text: str, words: str) -> None:
    with pytest.raises(InvalidInput) as error:
        read_claims(text)
    assert words in str(error.value)
    assert "\n" not in str(error.value)


def schema(root: Path) -> dict[str, Any]:
    loaded: dict[str, Any] = json.loads((root / "proofs/schemas/claims.schema.json").read_text())
    return loaded


def test_the_schema_for_editors_takes_what_the_reader_takes() -> None:
    checker = jsonschema.Draft202012Validator(schema(Path(__file__).parents[2]))
    for text in (GOOD, *(content(f"example:{name}").decode() for name in CLAIMS)):
        assert [error.message for error in checker.iter_errors(tomllib.loads(text))] == []


def test_the_schema_refuses_what_has_the_wrong_form() -> None:
    checker = jsonschema.Draft202012Validator(schema(Path(__file__).parents[2]))
    told_by_words_alone = (
        "column",
        "empty box",
        "no unit circle",
        "no TOML",
        "no claim",
        "denominators",
        "does not list",
        "with a prime",
        "got [3, 1]",
        "a field that",
    )
    for text, words in BAD:
        if not any(one in words for one in told_by_words_alone) and "got 'm'" not in words:
            assert list(checker.iter_errors(tomllib.loads(text))), text
