"""Claims about two systems: their quantities against slow ways, the box in its order, verdicts with certificates, what is refused."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import islice, product
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import faultspace as fs
from faultspace.base.errors import InvalidInput
from faultspace.cli.command_line import main
from faultspace.exact import ResidualSystem
from faultspace.packaged_examples import content
from faultspace.proofs.boxes.box import Sizes
from faultspace.proofs.boxes.pair_box import PairBox
from faultspace.proofs.brought.case_files import fitting, read_case
from faultspace.proofs.brought.claim_files import read_claims
from faultspace.proofs.brought.claiming import decide_claims, explain
from faultspace.proofs.brought.claims import Answered, make_claim
from faultspace.proofs.brought.known_cases import known_cases, smaller
from faultspace.proofs.language.by_batches import Table, true_of
from faultspace.proofs.language.evaluating import evaluate, exactly
from faultspace.proofs.language.grammar import read
from faultspace.proofs.language.vocabularies import ONE_A_AND_C, PAIR, VOCABULARIES
from faultspace.proofs.quantities.blocks import height
from faultspace.proofs.quantities.cases import Pair
from faultspace.proofs.quantities.pairs import OF_A_PAIR, OF_ONE_A_AND_C, Pairs
from faultspace.proofs.quantities.ranks import Numbers
from faultspace.proofs.trust.structure_certificates import accept
from tests.oracle import behaviours
from tests.oracle.systems import parse_system
from tests.proofs.case_checks import check_documents, check_example, check_order, check_refused, check_the_first, check_weights
from tests.thorough import every

KINDS = {PAIR: False, ONE_A_AND_C: True}
ONE: dict[str, Any] = {"n": [1, 1], "m": [1, 1], "p": [1, 1]}


def box_of(about: str = PAIR, field: str = "Q", **box: Any) -> PairBox:
    found = make_claim("x", {"about": about, "conclusion": "p >= 0", "fields": [field], "box": box}).boxes[field]
    assert isinstance(found, PairBox)
    return found


def all_pairs(box: PairBox, sizes: Sizes) -> Iterator[tuple[Pairs, int]]:
    for stretch in box.stretches(sizes, reduced=False):
        for i in range(len(stretch.batch)):
            yield stretch.batch, i


# -- the quantities ----------------------------------------------------------------------------------------------------


def by_definition(pair: Pair, samples: int) -> dict[str, Any]:
    """Return what column spaces of built matrices say of a pair."""
    first, second = (parse_system(one.to_json()) for one in (pair.first, pair.second))
    difference = behaviours.first_difference(first, second)
    return {
        "equal": behaviours.equivalent(first, second),
        "contained": behaviours.included(first, second),
        "first_difference": inf if difference is None else difference,
        "equal_on": [behaviours.equal_on(first, second, s) for s in range(samples)],
        "contained_on": [behaviours.included_on(first, second, s) for s in range(samples)],
        "p": first.p,
        "n": first.n,
    }


def material(about: str, field: str) -> Iterator[tuple[Pair, Numbers]]:
    """Yield pairs of every kind of sizes, zero among them, and what is found of many at once."""
    box = box_of(about, field, n=[0, 2], m=[0, 1], p=[0, 2], total=3, entries=[0, 1])
    for number, sizes in enumerate(box.sizes()):
        count = box.count(*sizes)
        step = every(max(1, count // 3)) if count > 20 else 1
        for batch in (stretch.batch for stretch in islice(box.stretches(sizes, reduced=False), 1)):
            rows = np.arange(number % step, len(batch), max(1, min(step, len(batch) // 2)))
            keys = [("first", "OT"), ("second", "OT"), "OT side by side"]
            tables = {key: batch.column(key, rows) for key in keys}
            for place, i in enumerate(rows):
                known: dict[object, tuple[int, ...]] = {key: tuple(map(int, table[place])) for key, table in tables.items()}
                yield batch.case(int(i)), Numbers(batch.sizes, known)


@pytest.mark.parametrize("about", list(KINDS))
@pytest.mark.parametrize("field", ["Q", "GF(2)"])
def test_a_quantity_of_a_pair_is_what_slow_ways_find(about: str, field: str) -> None:
    seen = dict.fromkeys(OF_A_PAIR, 0)
    for pair, numbers in material(about, field):
        samples = max(pair.first.n, pair.second.n) + 3
        told, knows = by_definition(pair, samples), exactly(pair)
        for name, one in (OF_ONE_A_AND_C if KINDS[about] else OF_A_PAIR).items():
            wanted = told[name]
            if one.windowed:
                assert [one.exact(knows.whole, s) for s in range(samples)] == wanted, (name, str(pair))
                assert [one.from_ranks(numbers, s) for s in range(samples)] == wanted, (name, str(pair))
            else:
                assert one.exact(knows.whole) == wanted == one.from_ranks(numbers), (name, str(pair))
            seen[name if name in seen else "p"] += 1
    assert min(seen.values()) > 40


@pytest.mark.parametrize("field", ["Q", "GF(2)", "GF(3)"])
def test_every_pair_of_one_state_is_told_apart_as_by_definition(field: str) -> None:
    """All pairs with one state, fault and output each, of which every text is true or false by the oracle."""
    box = box_of(PAIR, field, **ONE, **({"entries": [0, 1]} if field != "GF(2)" else {}))
    texts = {"equal": "equal", "contained": "contained", "equal_on(1)": "equal_on(1)", "first_difference <= 2": "first_difference"}
    for stretch in box.stretches((1, 1, 1, 1, 1, 1), reduced=False):
        rows = np.arange(0, len(stretch.batch), every())
        flags = {text: true_of(read(text, vocabulary=VOCABULARIES[PAIR]), stretch.batch, rows, Table()) for text in texts}
        for place, i in enumerate(rows):
            told = by_definition(stretch.batch.case(int(i)), 2)
            told |= {"equal_on(1)": told["equal_on"][1], "first_difference <= 2": told["first_difference"] <= 2}
            assert all(flags[text][place] == told[text] for text in texts), str(stretch.batch.case(int(i)))


def test_a_broken_quantity_of_a_pair_refutes_a_theorem(monkeypatch: pytest.MonkeyPatch) -> None:
    one: dict[str, Any] = {**ONE, "entries": [0, 1]}
    text = "iff(equal, first_difference == inf) and implies(equal_on(max(first.n, second.n) + 1), equal)"
    assert decided(text, **one).verdict == Answered.NOT_REFUTED
    right = OF_A_PAIR["equal_on"]
    late = replace(right, exact=lambda x, s: right.exact(x, s - 1), from_ranks=lambda r, s: right.from_ranks(r, s - 1))
    monkeypatch.setitem(OF_A_PAIR, "equal_on", late)
    assert decided(text, **one).verdict == Answered.REFUTED
    monkeypatch.setitem(OF_A_PAIR, "equal_on", replace(right, from_ranks=lambda r, s: right.from_ranks(r, s - 1)))
    with pytest.raises(ArithmeticError, match="disagree"):
        decided(text, **one)


# -- the box -----------------------------------------------------------------------------------------------------------


def in_order(box: PairBox) -> Iterator[Pair]:
    """Yield every pair of a box over Q in the order of the contract."""
    ranges = [range(low, high + 1) for low, high in (box.n, box.m, box.p)]
    single = [one for one in product(*ranges) if sum(one) <= box.total]
    for n, m, p, n2, m2, p2 in sorted(((*a, *b) for a in single for b in single), key=lambda one: (sum(one), one)):
        if p != p2 or (box.one_A_and_C and n != n2):
            continue
        free = (n + p) * (n + m), (n2 + p) * (m2 if box.one_A_and_C else n2 + m2)
        for entries in sorted(product(sorted(box.entries), repeat=sum(free)), key=lambda one: (max(map(height, one), default=0), one)):
            rest = iter(entries)

            def taken(shapes: list[tuple[int, int]], rest: Iterator[Fraction] = rest) -> list[list[list[Fraction]]]:
                return [[[next(rest) for _ in range(b)] for _ in range(a)] for a, b in shapes]

            A, F, C, G = taken([(n, n), (n, m), (p, n), (p, m)])
            first = ResidualSystem.of(A, F, C, G, n=n, m=m, p=p)
            if box.one_A_and_C:
                F2, G2 = taken([(n, m2), (p, m2)])
                yield Pair(first, ResidualSystem.of(A, F2, C, G2, n=n, m=m2, p=p), True)
            else:
                parts = taken([(n2, n2), (n2, m2), (p, n2), (p, m2)])
                yield Pair(first, ResidualSystem.of(*parts, n=n2, m=m2, p=p))


SMALL = [
    {**ONE, "entries": [0, 1]},
    {"n": [0, 1], "m": [0, 1], "p": [1, 1], "total": 3, "entries": [-1, 1]},
    {**ONE, "entries": [0, "1/2"]},
    {"n": [1, 1], "m": [0, 2], "p": [0, 1], "total": 3, "entries": [0, 2]},
]


@pytest.mark.parametrize("about", list(KINDS))
@pytest.mark.parametrize("given", SMALL, ids=str)
def test_a_box_of_pairs_is_gone_through_in_the_stated_order(about: str, given: dict[str, Any]) -> None:
    check_order(box_of(about, **given), in_order)


@pytest.mark.parametrize("about", list(KINDS))
@pytest.mark.parametrize("field", ["Q", "GF(2)", "GF(3)"])
def test_the_pairs_that_are_looked_at_stand_for_all(about: str, field: str) -> None:
    check_weights(box_of(about, field, n=[0, 2], m=[0, 1], p=[0, 2], total=3))


def test_every_pair_is_a_change_of_one_that_is_looked_at() -> None:
    """With one state and no fault each, and two outputs: changes are signs of either state, and orders and signs of the outputs of both."""
    seen: set[tuple[int, ...]] = set()
    for stretch in box_of(PAIR, n=[1, 1], m=[0, 0], p=[2, 2], total=3).stretches((1, 0, 2, 1, 0, 2), reduced=True):
        for i in range(len(stretch.batch)):
            pair = stretch.batch.case(i)
            A1, A2 = (int(one.A[0, 0]) for one in (pair.first, pair.second))
            C1, C2 = ([int(one.C[k, 0]) for k in range(2)] for one in (pair.first, pair.second))
            for t1, t2, a, b, turned in product((1, -1), (1, -1), (1, -1), (1, -1), (False, True)):
                first, second = [a * C1[0] * t1, b * C1[1] * t1], [a * C2[0] * t2, b * C2[1] * t2]
                seen.add((A1, *first[:: -1 if turned else 1], A2, *second[:: -1 if turned else 1]))
    assert len(seen) == 3**6


FAILING = [
    ("equal", []),
    ("implies(equal_on(max(first.n, second.n)), equal)", []),
    ("first_difference <= 1", ["not equal"]),
    ("equal", ["contained", "first.left_invertible"]),
    ("first.lag == second.lag", ["contained"]),
    ("rank(vstack(first.C, second.C)) == 1", ["not equal", "second.controllable"]),
    ("is_zero(first.F - second.F)", ["first.n == second.n", "equal", "contained_on(1)"]),
    (
        "is_zero(first.A @ second.F)",
        ["first.n == second.n", "first.observable", "equal"],
    ),  # of one (A, C) alone it stays as it is where states are renumbered
]


@pytest.mark.parametrize("about", list(KINDS))
@pytest.mark.parametrize(("conclusion", "hypotheses"), FAILING)
def test_the_pair_that_refutes_is_the_first_of_the_box(about: str, conclusion: str, hypotheses: list[str]) -> None:
    given: dict[str, Any] = {"n": [0, 1], "m": [1, 1], "p": [1, 1], "entries": [-1, 0, 1] if KINDS[about] else [0, 1]}
    check_the_first(about, conclusion, hypotheses, given, in_order)


# -- verdicts ----------------------------------------------------------------------------------------------------------


def decided(conclusion: Any, *hypotheses: Any, about: str = PAIR, fields: tuple[str, ...] = ("Q",), **box: Any) -> Any:
    return fs.claim(conclusion, hypotheses=hypotheses, about=about, box=box, fields=fields).answers[0]


EXAMPLES = {one.id: one for one in read_claims(content("example:pairs").decode())}


@pytest.mark.parametrize("name", list(EXAMPLES))
def test_an_example_about_pairs_is_answered_as_expected(name: str) -> None:
    check_example(EXAMPLES[name], lambda box: replace(box, n=(1, 1), total=3 if EXAMPLES[name].about == PAIR else 4))


def test_n_samples_are_refuted_by_a_pair_no_larger_than_the_published_one() -> None:
    published = [json.loads(content(f"example:theorem-1-{name}")) for name in ("first", "second")]
    largest = max(len(one["A"]) + len(one["F"][0]) + len(one["C"]) for one in published)
    for name in ("n-samples", "n-samples-one-a-and-c"):
        answer = decide_claims([EXAMPLES[name]], ablation=False).answers[0]
        assert answer.counterexample is not None and answer.counterexample.smallest
        case = answer.counterexample.case
        assert isinstance(case, Pair) and max(one.n + one.m + one.p for one in (case.first, case.second)) <= largest
        assert {one["kind"] for one in answer.counterexample.certificates} >= {"behaviour-difference", "window-equality"}


def test_what_a_claim_reads_of_a_pair_is_certified() -> None:
    texts = ["equal", "contained", "first_difference == inf", "equal_on(1)", "contained_on(1)", "contained_on(2)"]
    for text in texts:
        for negated in (f"not ({text})", text):
            answer = decided(f"{negated} and p == 7", **ONE, entries=[0, 1])
            assert answer.counterexample is not None and not answer.counterexample.computed
            for one in answer.counterexample.certificates:
                accept(one)
    # contained on one sample, and not for ever: a rank of both side by side says it
    answer = decided("contained or not contained_on(1)", **ONE)
    assert answer.counterexample.computed == ()
    assert {one["kind"] for one in answer.counterexample.certificates} >= {"behaviour-difference", "matrix-rank", "window-ranks"}


def test_hypotheses_about_pairs_are_dropped_in_turn() -> None:
    answer = decided("first.n_z == second.n_z", "equal", "first.n >= 1", about=ONE_A_AND_C, **ONE)
    assert answer.verdict == Answered.NOT_REFUTED
    assert [one.verdict for one in answer.dropped] == [Answered.REFUTED, Answered.NOT_REFUTED]
    assert isinstance(answer.dropped[0].case, Pair) and "first: " in answer.dropped[0].words
    written = answer.to_json()
    assert set(written["hypotheses"][0]["system"]) == {"first", "second"} and written["tried"]["of"] == "pairs of systems"
    assert decided("equal", "first.lag == 7", **ONE).verdict == Answered.VACUOUS


def test_a_pair_outside_the_box_is_made_smaller() -> None:
    answer = decided("implies(equal_on(2), equal)", **ONE)
    assert answer.verdict == Answered.REFUTED and not answer.counterexample.smallest
    case = answer.counterexample.case
    assert max(case.first.n, case.second.n) == 2 and "not from the box" in answer.summary()
    shared = decided("implies(equal_on(2), equal)", about=ONE_A_AND_C, **ONE).counterexample.case
    assert (shared.first.A, shared.first.C) == (shared.second.A, shared.second.C) and shared.one_A_and_C and shared.first.n == 2
    system = ResidualSystem.of([[3]], [[1, 2]], [[5], [1]], [[0, 9], [7, 1]])
    start = Pair(system, system, one_A_and_C=True)
    end = smaller(start, lambda one: isinstance(one, Pair) and one.first.n >= 1 and not one.second.A.is_zero())
    assert isinstance(end, Pair) and (end.first.n, end.first.m, end.first.p, end.second.m) == (1, 0, 0, 0) and end.first.A == end.second.A


@pytest.mark.parametrize("about", list(KINDS))
@pytest.mark.parametrize("field", ["Q", "GF(2)"])
def test_known_pairs_are_many_and_what_they_are_called(about: str, field: str) -> None:
    listed = known_cases(box_of(about, field))
    pairs = [one.case for one in listed if isinstance(one.case, Pair)]
    assert len(pairs) == len(listed) > 100 and {one.origin for one in listed} == {"corpus", "adversary"}
    assert all(one.first.p == one.second.p and one.first.field == one.second.field for one in pairs)
    if KINDS[about]:
        assert all((one.first.A, one.first.C) == (one.second.A, one.second.C) for one in pairs)
    equal = [exactly(one.case, one.subject).quantity("", "equal") for one in listed]
    assert sum(equal) > 20 and len(equal) - sum(equal) > 20


def test_a_predicate_of_python_speaks_of_both_systems() -> None:
    answer = decided(lambda s: s.equal or s.first_difference <= max(s.first.n, s.second.n), **ONE)
    text = decided("equal or first_difference <= max(first.n, second.n)", **ONE)
    assert answer.counterexample.case == text.counterexample.case
    for wrong, words in (
        (lambda s: s.lag == 1, "got lag, which is no quantity"),
        (lambda s: s.first.equal, "got equal, which is no quantity"),
        (lambda s: s.firsst.lag == 1, "the nearest is first"),
        (lambda s: s.second.obserable, "the nearest is observable"),
    ):
        with pytest.raises(InvalidInput, match=words):
            decided(wrong, **ONE)


def test_every_number_of_samples_is_decided_for_pairs() -> None:
    """What is asked of every s is what looking far ahead finds."""
    texts = [
        "all(equal_on(s) for s in windows(1))",
        "any(not contained_on(s + 1) for s in windows(0))",
        "all(iff(equal_on(s), first.rank_OT(s) == second.rank_OT(s)) for s in windows(0))",
        "least(s for s in windows(0) if not equal_on(s)) == first_difference",
        "all(implies(not equal_on(s - 1), first.rank_OT(s) + second.rank_OT(s - 1) <= 3 * s) for s in windows(1))",
    ]
    box = box_of(PAIR, n=[0, 2], m=[0, 1], p=[1, 1], total=3, entries=[0, 1])
    for sizes in box.sizes():
        for batch, i in islice(all_pairs(box, sizes), 0, 400, 71):
            knows = exactly(batch.case(i))
            for text in texts:
                near = text.replace("windows(0)", "windows(0, 12)").replace("windows(1)", "windows(1, 12)")
                far = (evaluate(read(one, vocabulary=VOCABULARIES[PAIR]), knows) for one in (text, near))
                assert len(set(far)) == 1, (text, str(batch.case(i)))


# -- what is refused ---------------------------------------------------------------------------------------------------

REFUSED = [
    ("lag == 1", "got lag alone, expected first.lag or second.lag"),
    ("rank_OT(3) == 1", "expected first.rank_OT(s) or second.rank_OT(s)"),
    ("A == 1", "got A alone, expected first.A or second.A"),
    ("first == second", "got first alone, expected a quantity of it, such as first.lag"),
    ("first.lagg == 1", "the nearest is lag"),
    ("frist.lag == 1", "expected .T of a matrix, or a name after first. or second."),
    ("frist.lag == 1", "the nearest is first.lag"),
    ("secnd.rank_OT(2) == 1", "the nearest is second.rank_OT"),
    ("x.rank_OT(2) == 1", "expected the name of a function, or a name after first. or second."),
    ("first.equal", "got 'first.equal', expected equal alone"),
    ("equl", "the nearest is equal"),
    ("equal(1)", "equal is no function"),
    ("equal_on", "expected equal_on(s)"),
    ("equal_on(first.A)", "expected an integer"),
    ("equal == contained", "iff(a, b) compares words"),
    ("first_difference", "which is an integer, expected true or false"),
    ("is_zero(first.A - equal)", "expected a matrix"),
    ("n == 1", "got n alone, expected first.n or second.n"),
    ("all(equal_on(2 * s) for s in windows(0))", "s + c or s - c"),
    ("all(equal for first in windows(0, 1))", "which is taken"),
]


@pytest.mark.parametrize(("text", "words"), REFUSED)
def test_what_is_refused_about_pairs_is_told_in_words(text: str, words: str) -> None:
    check_refused(text, words, PAIR)


def test_words_of_other_claims_are_named() -> None:
    with pytest.raises(InvalidInput, match="got equal, a word of claims about a pair, expected one of those about a system"):
        fs.claim("equal")
    with pytest.raises(InvalidInput, match="the nearest is pair"):
        fs.claim("n == 1", about="pairr")
    with pytest.raises(InvalidInput, match="got 3"):
        fs.claim("n == 1", about=3)  # type: ignore[arg-type]
    assert (
        fs.claim("n == first.n and is_zero(A - first.A) and is_zero(C - second.C)", about=ONE_A_AND_C, box=ONE).answers[0].verdict
        == "NOT REFUTED"
    )
    with pytest.raises(InvalidInput, match="no unit circle"):
        fs.claim("first.stable", about=PAIR, fields=["GF(2)"])
    with pytest.raises(InvalidInput, match="empty box"):
        fs.claim("equal", about=PAIR, box={"n": [2, 2], "total": 3})


def test_a_claim_about_pairs_without_a_value_names_the_pair() -> None:
    with pytest.raises(InvalidInput, match=r"on first: A=.*; second: A=.*guard it with len\(first.left_minimal_indices\)"):
        decided("first.left_minimal_indices[0] >= 0", **ONE)
    with pytest.raises(InvalidInput, match="shapes that agree"):
        decided("columns(first.F - second.F) >= 0", n=[1, 1], m=[1, 2], p=[1, 1], total=4)


def test_explaining_and_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    first, second = (json.loads(content(f"example:theorem-1-{name}")) for name in ("first", "second"))
    case = fitting(read_case({"first": first, "second": second}), PAIR)
    told = [(text, value) for _, text, value in explain(EXAMPLES["n-samples"], case)]
    assert ("equal_on(max(first.n, second.n))", "True") in told and ("equal", "False") in told and ("first.n", "1") in told
    pair, claims = tmp_path / "pair.json", tmp_path / "claims.toml"
    pair.write_text(json.dumps({"first": first, "second": second}))
    claims.write_text("[claim.x]\nabout = 'pair'\nconclusion = 'equal or first_difference == 2'\nbox = {n = [1, 1], total = 3}\n")
    assert main(["claim", str(claims), "--explain", str(pair), "--json"]) == 0
    written = json.loads(capsys.readouterr().out)
    assert written["first"]["A"] and {"level": 0, "text": "equal or first_difference == 2", "value": "True"} in written["explained"]["x"]
    assert main(["claim", str(claims), "--json", "--no-ablation", "--out", str(tmp_path / "out")]) == 0
    smallest = json.loads(capsys.readouterr().out)["claims"][0]["smallest"]
    assert set(smallest) == {"first", "second", "quantities", "computed", "in_box"}
    assert main(["check", *map(str, (tmp_path / "out").iterdir())]) == 0
    capsys.readouterr()
    documents = (
        ({"first": first}, "expected first and second"),
        ({"first": first, "second": second, "third": 1}, "expected first and second"),
        ({"first": first, "second": 3}, "second: got 3"),
        ({"first": first, "second": {**second, "field": {"prime": 5}}}, "expected one field"),
        ({"first": first, "second": {"A": [[1]], "F": [[1]], "C": [[1], [1], [1]], "G": [[1], [1], [1]]}}, "expected as many in both"),
        (first, 'got a system, expected a pair: {"first": SYSTEM, "second": SYSTEM}'),
    )
    check_documents(claims, documents, capsys)
    claims.write_text(f"[claim.x]\nabout = '{ONE_A_AND_C}'\nconclusion = 'equal'\n")
    check_documents(claims, [({"first": first, "second": {**second, "A": [["5"]]}}, "expected the same in both")], capsys)


def test_entries_over_a_denominator_are_decided_too() -> None:
    given: dict[str, Any] = {**ONE, "entries": [0, "1/2"]}
    squares = decided("implies(is_zero(first.A @ first.A - second.A), nilpotent(first.A))", "first.n == second.n", **given)
    assert squares.counterexample is None or not squares.counterexample.smallest
    for text in ("rank(first.A @ first.A - second.A) <= 0", "equal or not first.left_invertible"):
        claim = make_claim("x", {"about": PAIR, "conclusion": text, "box": given})
        answer = decided(text, **given)
        wanted = next(one for one in in_order(box_of(PAIR, **given)) if not evaluate(claim.conclusion, exactly(one)))
        assert answer.counterexample.case == wanted
