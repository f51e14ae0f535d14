"""Bounds on a quantity by others: the table against one system at a time, the fit against plain enumeration, known results found again."""

from __future__ import annotations

import json
import random
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations, product
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

import faultspace as fs
from faultspace.base.errors import InvalidInput
from faultspace.base.progress import silent
from faultspace.exact import PrimeField, Rationals, ResidualSystem
from faultspace.proofs.boxes.box import Box
from faultspace.proofs.brought import conjecturing, sparse_systems, tables
from faultspace.proofs.brought.bounds import ABOVE, BELOW, Fit, Fitted, Form, Grammar, Term, fit, forms
from faultspace.proofs.brought.claims import Answered, make_box, make_claim
from faultspace.proofs.brought.conjectures import Bound, Conjectures, Sharpened
from faultspace.proofs.brought.conjecturing import default_columns, sharpen
from faultspace.proofs.brought.direct_sums import direct_sums
from faultspace.proofs.brought.known_bounds import at_most_zero, known_as
from faultspace.proofs.brought.known_cases import known_systems
from faultspace.proofs.language.evaluating import Exactly, evaluate
from faultspace.proofs.language.grammar import read
from faultspace.proofs.language.linear import Linear, linear, words
from faultspace.proofs.quantities.registry import Kind, Subject, quantities
from faultspace.proofs.trust.structure_certificates import accept
from tests.thorough import THOROUGH, every

ROOT = Path(__file__).parents[2]
SMALL = {"total": 3}
COLUMNS = ("lag", "zeta", "delay_known", "n_z", "rank(G)")


@pytest.fixture(autouse=True)
def few_outside(monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> None:
    """Most tests have enough in fewer systems outside the box, which take most of the time."""
    all_there = "all_outside" in request.fixturenames
    if not all_there:
        monkeypatch.setattr(tables, "MOST_SUMS", 300)
        monkeypatch.setattr(tables, "MOST_MET", 100)
    monkeypatch.setattr(sparse_systems, "BATCHES", (60 if THOROUGH else 8) if all_there else 1)


@pytest.fixture
def all_outside() -> None:
    """A test that asks for it has as many as users have, but for sparse ones, of which each seed draws 8 batches of 60."""


def sharpened(conclusion: str, *hypotheses: str, box: dict[str, Any] | None = None) -> Sharpened:
    given = {"conclusion": conclusion, "hypotheses": list(hypotheses), "box": {"total": 4} if box is None else box}
    return sharpen(make_claim("x", given))[0]


# -- the table ---------------------------------------------------------------------------------------------------------


def one_at_a_time(box: Box, hypothesis: str, columns: Sequence[str]) -> dict[tuple[Any, ...], tuple[int, ResidualSystem]]:
    """Return how many systems of the box have each set of values and the first of them, by exact functions on every system, in order."""
    field = Rationals() if box.prime is None else PrimeField(box.prime)
    found: dict[tuple[Any, ...], tuple[int, ResidualSystem]] = {}
    for n, m, p in box.sizes():
        every_system = sorted(
            product(sorted(box.entries), repeat=(n + p) * (n + m)), key=lambda one: (max(map(abs, one), default=0) > 1, one)
        )
        for entries in every_system:
            rest = iter(entries)
            parts = ([[int(next(rest)) for _ in range(b)] for _ in range(a)] for a, b in ((n, n), (n, m), (p, n), (p, m)))
            system = ResidualSystem.of(*parts, field=field, n=n, m=m, p=p)
            exactly = Exactly({"": Subject(system)})
            if evaluate(read(hypothesis), exactly):
                values = tuple(evaluate(read(one, Kind.INTEGER), exactly) for one in columns)
                count, first = found.get(values, (0, system))
                found[values] = count + 1, first
    return found


@pytest.mark.parametrize(
    ("bounds", "prime", "hypothesis"),
    [
        ({"total": 3}, None, "n >= 0"),
        ({"n": [1, 2], "m": [1, 1], "p": [1, 1], "total": 4}, 2, "left_invertible"),
        ({"n": [0, 1], "m": [0, 1], "p": [0, 1], "total": 3}, 3, "observable"),
        (
            {"n": [1, 1], "m": [1, 1], "p": [1, 1], "total": 3},
            None,
            "m == p and rank(F @ C) == 1",
        ),  # not invariant: every system is looked at
    ],
)
def test_the_table_is_what_one_system_at_a_time_says(bounds: dict[str, Any], prime: int | None, hypothesis: str) -> None:
    box = make_box(bounds, Rationals() if prime is None else PrimeField(prime))
    nodes = [read(one, Kind.INTEGER) for one in COLUMNS]
    table = tables.tabulate(box, [read(hypothesis)], nodes, most=10**9, jobs=1, progress=silent)
    found = {row.values: (row.systems, row.case) for row in table.rows if row.in_box}
    assert found == one_at_a_time(box, hypothesis, COLUMNS)
    assert table.met == sum(count for count, _ in found.values()) > 0 and table.exhausted
    assert [row.place for row in table.rows] == sorted(row.place for row in table.rows)


def test_what_is_outside_the_box_is_as_exact_functions_say() -> None:
    nodes = [read(one, Kind.INTEGER) for one in COLUMNS]
    table = tables.tabulate(
        make_box({"total": 4, "n": [1, 2], "m": [1, 1]}, Rationals()), [read("left_invertible")], nodes, most=10**9, jobs=1, progress=silent
    )
    outside = [row for row in table.rows if not row.in_box]
    assert len(outside) > 20 and table.sums_met > 3 and table.corpus_met > 50
    for row in outside[:: 5 * every()]:
        assert isinstance(row.case, ResidualSystem)
        exactly = Exactly({"": Subject(row.case)})
        assert tuple(evaluate(node, exactly) for node in nodes) == row.values and evaluate(read("left_invertible"), exactly)
    listed = {one.subject.system for one in known_systems(Rationals())}
    assert sum(row.others for row in table.rows) == table.sums_met + table.drawn_met + table.corpus_met + table.adversary_met
    assert table.drawn_met >= 100
    assert any(row.case not in listed for row in outside)


def test_a_direct_sum_is_one() -> None:
    one = ResidualSystem.of([[1]], [[2]], [[3]], [[4]])
    other = ResidualSystem.of([[5, 0], [6, 7]], [[8], [9]], [[1, 2]], [[3]])
    batch = direct_sums([(one, other)], Box())
    assert batch.case(0) == ResidualSystem.of(
        [[1, 0, 0], [0, 5, 0], [0, 6, 7]], [[2, 0], [0, 8], [0, 9]], [[3, 0, 0], [0, 1, 2]], [[4, 0], [0, 3]]
    )


def test_processes_change_no_table_and_a_search_can_be_short(monkeypatch: pytest.MonkeyPatch) -> None:
    given: dict[str, Any] = {"by": ["n", "p", "zeta"], "box": {"total": 4}}
    alone = fs.conjecture("lag", **given)
    monkeypatch.setattr(tables, "WORTH_SHARING", 1)
    assert fs.conjecture("lag", **given, jobs=2).to_json() == alone.to_json()
    short = fs.conjecture("lag", **given, most=50)
    assert not short.tried.exhausted and short.tried.systems < alone.tried.systems and "the first" in short.tried.words


# -- the fit -----------------------------------------------------------------------------------------------------------


def value(form: Form, row: Sequence[int]) -> int:
    """Return what a form is on a row of the table, in plain words."""
    ops = {"min": min, "max": max}
    return sum(one.coefficient * (ops[one.op](row[k] for k in one.columns) if one.op else row[one.columns[0]]) for one in form.terms)


def plainly(columns: int, grammar: Grammar, side: str) -> list[Form]:
    """Return every form of the grammar, by going through all vectors of coefficients."""
    found = []
    for vector in product(range(-grammar.largest, grammar.largest + 1), repeat=columns):
        if sum(map(bool, vector)) <= grammar.terms:
            found.append(Form(tuple(Term(c, (k,)) for k, c in enumerate(vector) if c)))
    for one, other in combinations(range(columns), 2):
        for plus in (True, False):
            op = "max" if plus == (side == ABOVE) else "min"
            pair = Term(1 if plus else -1, (one, other), op)
            found.append(Form((pair,)))
            if grammar.terms > 1:
                found += [Form((pair, Term(c, (k,)))) for k in range(columns) if k not in (one, other) for c in (1, -1)]
    return found


def complaints(given: Fit, target: list[int], rows: list[list[int]], in_box: list[bool], grammar: Grammar, side: str) -> list[str]:
    """Return what is wrong with a fit, by the definition of a bound, of redundancy and of sharpness."""
    sign = 1 if side == ABOVE else -1
    wrong = []
    attained = []
    for one in given.kept:
        gaps = [sign * (t - value(one.form, row) - one.constant) for t, row in zip(target, rows, strict=True)]
        wrong += ["refuted"] if max(gaps) > 0 else []
        wrong += ["beyond the grammar"] if abs(one.constant) > grammar.constant else []
        attained.append({k for k, gap in enumerate(gaps) if gap == 0 and in_box[k]})
        wrong += ["not attained"] if not attained[-1] else []
        wrong += ["flags are wrong"] if [gap == 0 for gap in gaps] != one.attained.tolist() else []
    for k, mine in enumerate(attained):
        wrong += ["redundant"] if mine <= set().union(*(other for i, other in enumerate(attained) if i != k)) else []
    for form in plainly(len(rows[0]), grammar, side):
        gaps = [sign * (t - value(form, row)) for t, row in zip(target, rows, strict=True)]
        here = {k for k, gap in enumerate(gaps) if gap == max(gaps) and in_box[k]}
        if abs(max(gaps)) > grammar.constant or not here or min(gaps) == max(gaps):
            continue
        wrong += ["missed"] if not here <= set().union(*attained) else []
        wrong += ["not the sharpest"] if any(mine < here for mine in attained) else []
    return wrong


def drawn(seed: int) -> tuple[list[int], list[list[int]], list[bool]]:
    """Return a target, a table of three columns, and which rows are in the box."""
    rng = random.Random(seed)
    rows = [[rng.randint(0, 4) for _ in range(3)] for _ in range(rng.randint(2, 25))]
    target = [max(0, min(a, b + rng.randint(0, 1)) - rng.randint(0, 1) * c) for a, b, c in rows]
    return target, rows, [k == 0 or rng.random() < 0.6 for k in range(len(rows))]


GRAMMARS = [Grammar(1, 1, 0), Grammar(2, 1, 2), Grammar(2, 2, 2), Grammar(3, 2, 1)]


def fitted(target: list[int], rows: list[list[int]], in_box: list[bool], grammar: Grammar, side: str) -> Fit:
    return fit(np.array(target), np.array(rows), np.array(in_box), grammar, side)


@pytest.mark.parametrize("side", [ABOVE, BELOW])
@pytest.mark.parametrize("grammar", GRAMMARS, ids=str)
def test_a_fit_is_what_plain_enumeration_says(grammar: Grammar, side: str) -> None:
    kept = 0
    for seed in range(0, 12, every()):
        target, rows, in_box = drawn(seed)
        found = fitted(target, rows, in_box, grammar, side)
        assert complaints(found, target, rows, in_box, grammar, side) == [], seed
        assert found.looked_at == len(plainly(3, grammar, side))
        for one in found.equal:
            assert {t - value(one.form, row) for t, row in zip(target, rows, strict=True)} == {one.constant}
        kept += len(found.kept)
    assert kept > 0


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda kept: kept[1:], "missed"),
        (lambda kept: [*kept, kept[0]], "redundant"),
        (lambda kept: [replace(kept[0], constant=kept[0].constant - 1), *kept[1:]], "refuted"),
        (lambda kept: [replace(kept[0], constant=kept[0].constant + 1), *kept[1:]], "not attained"),
        (lambda kept: [replace(kept[0], attained=~kept[0].attained), *kept[1:]], "flags are wrong"),
    ],
)
def test_a_broken_fit_is_noticed(change: Any, words: str) -> None:
    grammar = Grammar(2, 1, 2)
    target, rows, in_box = drawn(3)
    found = fitted(target, rows, in_box, grammar, ABOVE)
    assert len(found.kept) > 1
    assert words in complaints(replace(found, kept=tuple(change(found.kept))), target, rows, in_box, grammar, ABOVE)


def test_a_bound_that_is_not_the_sharpest_is_noticed() -> None:
    target, rows, in_box = [1, 1, 2], [[1, 1], [2, 1], [2, 2]], [True] * 3
    grammar = Grammar(1, 1, 0)
    blunt = Fitted(Form((Term(1, (0,)),)), 0, np.array([True, False, True]))
    assert "not the sharpest" not in complaints(fitted(target, rows, in_box, grammar, ABOVE), target, rows, in_box, grammar, ABOVE)
    target = [1, 1, 1]
    rows = [[1, 1], [2, 1], [2, 2]]
    blunt = Fitted(Form((Term(1, (0,)),)), 0, np.array([True, False, False]))
    assert "not the sharpest" in complaints(Fit((blunt,), (), 0), target, rows, in_box, grammar, ABOVE)


def test_large_numbers_do_not_overflow() -> None:
    found = fit(np.array([10**6, 2 * 10**6]), np.array([[10**6 - 1], [2 * 10**6]]), np.array([True, True]), Grammar(1, 2, 2), ABOVE)
    assert [(one.form.terms, one.constant) for one in found.kept] == [((Term(1, (0,)),), 1)]


def test_without_a_row_in_the_box_there_is_no_bound() -> None:
    assert fit(np.array([1]), np.array([[1]]), np.array([False]), Grammar(), ABOVE) == Fit((), (), 0)
    assert fit(np.zeros(0, dtype=int), np.zeros((0, 2), dtype=int), np.zeros(0, dtype=bool), Grammar(), BELOW) == Fit((), (), 0)


def test_forms_are_told_in_the_language() -> None:
    form = Form((Term(-2, (0,)), Term(1, (1, 2), "max")))
    assert form.words(("a", "b", "c"), 1) == "max(b, c) - 2 * a + 1" and form.cost == 5
    assert Form(()).words((), -1) == "-1" and Form((Term(-1, (0,)),)).words(("a",), 0) == "-a"
    assert len({form.words("abcd", 0) for form in forms(4, Grammar(), ABOVE)}) == sum(1 for _ in forms(4, Grammar(), ABOVE))


# -- sums --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "multiples", "constant"),
    [
        ("n - nullity( G ) + 1", {"n": 1, "nullity(G)": -1}, 1),
        ("2 * (n - m) - (n - 3) + m * 2", {"n": 1}, 3),
        ("-(lag - max(n, m))", {"lag": -1, "max(n, m)": 1}, 0),
        ("n * m // 2", {"n * m // 2": 1}, 0),
        ("lag + inf", {"lag": 1, "inf": 1}, 0),
    ],
)
def test_an_expression_as_a_sum(text: str, multiples: dict[str, int], constant: int) -> None:
    assert linear(read(text, Kind.INTEGER)) == Linear(multiples, constant)
    again = words(multiples.items(), constant)
    assert linear(read(again, Kind.INTEGER)) == Linear(multiples, constant)


# -- what is answered --------------------------------------------------------------------------------------------------


def claimed(bound: str, hypotheses: Sequence[str], box: dict[str, Any]) -> Any:
    return fs.claim(bound, hypotheses=hypotheses, box=box, ablation=False).answers[0]


def check(listed: Sequence[Bound], hypotheses: Sequence[str], box: dict[str, Any]) -> None:
    """Hold bounds against the other engine: each is not refuted as a claim, and the sharper ones are, by the same smallest system."""
    for bound in listed:
        assert claimed(bound.text, hypotheses, box).verdict != Answered.REFUTED, bound.text
        assert bound.sharper[0].counterexample is not None and bound.sharper[0].counterexample.system == bound.first
        for certificate in bound.certificates:
            accept(certificate)
        for one in bound.sharper:
            answer = claimed(one.text, hypotheses, box)
            if one.counterexample is None:
                assert answer.verdict != Answered.REFUTED, one.text
            elif one.counterexample.smallest:
                assert answer.counterexample.system == one.counterexample.system, one.text
            else:
                assert answer.counterexample is None or not answer.counterexample.smallest, one.text


@pytest.mark.parametrize(
    ("target", "hypotheses", "by"),
    [
        ("lag", [], ["n", "zeta", "weakly_unobservable_dimension"]),
        ("delay_unknown", ["delay_unknown < inf"], ["lag", "delay_known", "n"]),
        ("zeta - finite_zeros", ["left_invertible"], ["n", "rank(G)", "delay_known"]),
        ("normal_rank", ["observable"], ["m", "p", "rank(G)"]),
    ][:: every()],
)
def test_every_bound_is_what_claim_says_of_it(target: str, hypotheses: list[str], by: list[str]) -> None:
    found = fs.conjecture(target, hypotheses=hypotheses, by=by, box={"total": 4})
    assert found.above and found.below
    check([*found.above, *found.below], hypotheses, {"total": 4})
    assert all(claimed(text, hypotheses, {"total": 4}).verdict != Answered.REFUTED for text in found.equal)


@pytest.mark.searches
def test_a_claim_is_sharpened_to_what_willsky_shows() -> None:
    found = sharpened("delay_known <= n - nullity(G)", "left_invertible", "nullity(G) >= 1")
    assert found.own is not None and found.own.text == "delay_known <= n - nullity(G) + 1" in [one.text for one in found.words]
    assert found.counterexample == found.own.first == found.own.sharper[0].counterexample.system  # type: ignore[union-attr]
    assert [one.partition(" (")[0] for one in found.own.known] == ["literature: inverse-bound"]
    check([found.own, *found.words, *found.others], ["left_invertible", "nullity(G) >= 1"], {"total": 4})


@pytest.mark.parametrize(
    ("conclusion", "hypotheses", "own", "refuted"),
    [
        ("lag <= 2 * n + 3", [], "lag <= 2 * n", False),  # attained without states, outside the box
        ("lag < n", [], "lag <= n", True),
        ("n > lag - 1", [], "n >= lag", False),
        ("n + m > lag - 1", [], "n + m >= lag", False),
        ("n_z >= zeta + rank(F) + 1", [], "n_z >= zeta + rank(F)", True),
        ("lag - n <= 3", [], "lag - n <= 0", False),
        ("lag <= max(n, m)", [], "lag <= max(n, m)", False),
    ][:: every()],
)
def test_the_least_constant(conclusion: str, hypotheses: list[str], own: str, refuted: bool) -> None:
    found = sharpened(conclusion, *hypotheses, box=SMALL)
    assert found.own is not None and (found.own.text, found.counterexample is not None) == (own, refuted)
    assert (claimed(conclusion, hypotheses, SMALL).verdict == Answered.REFUTED) == refuted


@pytest.mark.searches
def test_known_results_are_found_again(all_outside: None) -> None:
    """The lag from the solutions of problem (11), the delay from the infinite zeros, and that knowing x(0) helps; no false one comes."""
    lag = fs.conjecture("lag", by=["n", "normal_rank", "n_z"], box={"total": 4})
    assert [one.text for one in lag.above] == ["lag <= n + normal_rank - n_z"]
    delay = fs.conjecture("delay_known", hypotheses=["left_invertible"], by=["n", "infinite_zeros", "lag"], box={"total": 4})
    assert [one.text for one in delay.above] == ["delay_known <= infinite_zeros"]
    late = fs.conjecture("delay_unknown", hypotheses=["delay_unknown < inf"], by=["delay_known", "lag"], box={"total": 4})
    above, below = ([one.text for one in bounds] for bounds in (late.above, late.below))
    assert above == ["delay_unknown <= max(delay_known, lag)"] and "delay_unknown >= delay_known" in below
    zeros = fs.conjecture("n_z", by=["normal_rank", "weakly_unobservable_dimension", "infinite_zeros"], box={"total": 4})
    assert zeros.equal == ("n_z == normal_rank + weakly_unobservable_dimension + infinite_zeros",)


@pytest.mark.searches
def test_what_is_a_bound_in_the_box_alone_falls(all_outside: None) -> None:
    """This one has no counterexample in the default box, on the known systems or on direct sums; a drawn system refutes it."""
    false = "lag <= normal_rank + observability_index + rank(G)"
    found = fs.conjecture("lag", by=["normal_rank", "observability_index", "rank(G)"], box={"total": 4})
    assert false not in [one.text for one in found.above] and claimed(false, [], {"total": 4}).verdict != Answered.REFUTED


def test_a_broken_quantity_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    right = quantities()["lag"]
    monkeypatch.setitem(quantities(), "lag", replace(right, from_ranks=lambda ranks: right.from_ranks(ranks) + ranks.n))
    with pytest.raises(ArithmeticError, match="two ways"):
        fs.conjecture("lag", by=["n"], box=SMALL)


def test_nothing_meets_the_hypotheses() -> None:
    found = fs.conjecture("lag", hypotheses=["n > 99"], box=SMALL)
    assert (found.above, found.below, found.tried.rows) == ((), (), 0) and "none of the systems that were tried meets" in found.title
    assert "none of the systems that were tried meets" in sharpened("lag <= n", "n > 99", box=SMALL).title


def test_hypotheses_may_be_predicates_of_python_and_the_field_finite() -> None:
    words = fs.conjecture("lag", hypotheses=["observable"], by=["n", "zeta"], box=SMALL, field="GF(2)")
    python = fs.conjecture("lag", hypotheses=[lambda s: s.observable], by=["n", "zeta"], box=SMALL, field="GF(2)")
    assert [one.text for one in words.above] == [one.text for one in python.above] != []
    assert "modulo 2" in words.tried.box and "over GF(2)" in words.title


def test_entries_with_denominators_have_no_direct_sums() -> None:
    found = fs.conjecture("lag", by=["n"], box={"n": [1, 1], "m": [1, 1], "p": [1, 1], "entries": ["-1/2", 0, "1/2"]})
    assert found.tried.sums == 0 and [one.text for one in found.above] == ["lag <= n"]


def test_infinite_quantities_are_left_out_and_named() -> None:
    found = fs.conjecture("lag", by=["n", "delay_known", " n", "n"], box=SMALL)
    assert found.by == ("n",) and list(found.left_out) == ["delay_known"]
    assert claimed("delay_known < inf", [], SMALL).counterexample.system == found.left_out["delay_known"]


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: fs.conjecture("lagg"), "target: column 1: got 'lagg', which is no name of the language; the nearest is lag"),
        (lambda: fs.conjecture("observable"), "target: column 1: got 'observable', which is true or false, expected an integer"),
        (lambda: fs.conjecture(3), "target: got 3, expected an expression as a string"),  # type: ignore[arg-type]
        (lambda: fs.conjecture("lag", by="n"), "by: got 'n', expected a list"),
        (lambda: fs.conjecture("lag", by=[]), "by: got [], expected a list"),
        (lambda: fs.conjecture("lag", by=["n", "zetta"]), "by[1]: column 1: got 'zetta'"),
        (lambda: fs.conjecture("lag", terms=4), "terms: got 4, expected an integer from 1 to 3"),
        (lambda: fs.conjecture("lag", constant=True), "constant: got True, expected an integer"),
        (lambda: fs.conjecture("lag", box={"total": 0}), "box: got an empty box"),
        (lambda: fs.conjecture("lag", hypotheses=["stable"], field="GF(2)"), "finite field, which has no unit circle"),
        (lambda: fs.conjecture("delay_known", box=SMALL), 'the hypothesis "delay_known < inf" makes it so'),
        (lambda: fs.conjecture("left_minimal_indices[0]", box=SMALL), "in the box: on A=[[-1]]"),
        (lambda: sharpened("iff(observable, minimal)"), "claim.x.conclusion: got 'iff(observable, minimal)', expected a bound to sharpen"),
        (lambda: sharpened("lag == n"), "expected a bound to sharpen"),
        (lambda: sharpened("delay_known <= n", box=SMALL), "claim.x.conclusion: got 'delay_known', which is inf on"),
    ],
)
def test_what_is_wrong_is_told(call: Any, words: str) -> None:
    with pytest.raises(InvalidInput) as error:
        call()
    assert words in str(error.value) and "\n" not in str(error.value)


def test_a_bound_is_known_by_what_it_says() -> None:
    bound = read("delay_known + nullity(G) < n + 2")
    assert known_as(bound, ["left_invertible", "nullity( G )>=1"])[0].startswith("literature: inverse-bound (Willsky")
    assert known_as(read("delay_known <= n + 1 - m + rank(G)"), ["left_invertible", "nullity(G) >= 1"])
    assert known_as(bound, ["left_invertible"]) == ()  # one hypothesis less is another statement
    assert known_as(read("delay_known <= n - nullity(G)"), ["left_invertible", "nullity(G) >= 1"]) == ()  # refuted in the file
    assert at_most_zero(read("n == m")) == (Linear({"n": 1, "m": -1}, 0), Linear({"n": -1, "m": 1}, 0))
    assert at_most_zero(read("n != m")) == () == at_most_zero(read("observable"))


def test_the_default_columns_do_not_name_the_target() -> None:
    names = default_columns(read("zeta - n", Kind.INTEGER))
    assert "zeta" not in names and {"n", "lag", "rank(G)"} <= set(names)
    assert "n" not in default_columns(read("n", Kind.INTEGER))


def test_the_answers_are_as_the_schema_says() -> None:
    schema = json.loads((ROOT / "proofs/schemas/conjectures.schema.json").read_text())
    checker = jsonschema.Draft202012Validator(schema)
    found: list[Conjectures | Sharpened] = [
        fs.conjecture("lag", by=["n", "delay_known", "n_z", "zeta"], box=SMALL),
        fs.conjecture("lag", hypotheses=["n > 99"], box=SMALL),
        sharpened("lag <= n", box=SMALL),
    ]
    for one in found:
        told = one.to_json() if isinstance(one, Conjectures) else {"sharpened": [one.to_json()]}
        assert [error.message for error in checker.iter_errors(json.loads(json.dumps(told)))] == []
    broken = found[0].to_json()
    broken["above"][0]["sharper"] = []
    assert list(checker.iter_errors(broken))
    assert conjecturing.MOST == 10**9 and "tried" in found[0].summary()


# -- what sparse systems refute ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("by", "false", "seed", "batches"),
    [
        (["delay_known", "lag"], "controllability_index >= min(delay_known, lag)", 5, 22),
        (["delay_known", "rank(C @ F)"], "controllability_index >= delay_known - rank(C @ F)", 2, 4),
    ],
)
def test_a_bound_that_sparse_systems_refute_is_not_offered(
    by: list[str], false: str, seed: int, batches: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each stands without the attack; the draws given are the first of users that refute it."""

    def offered() -> Conjectures:
        return fs.conjecture("controllability_index", hypotheses=["left_invertible"], by=by, box={"total": 4})

    monkeypatch.setattr(sparse_systems, "BATCHES", 0)
    assert false in [one.text for one in offered().below]
    assert seed in sparse_systems.SEEDS
    for name, value in (("SEEDS", (seed,)), ("BATCHES", batches), ("SECONDS", 600.0)):
        monkeypatch.setattr(sparse_systems, name, value)
    found = offered()
    assert found.tried.sparse == 250 * batches > found.tried.sparse_met > 0 and f"; {found.tried.sparse} sparse ones" in found.tried.words
    assert false not in [one.text for one in found.below]


def test_a_bound_says_that_it_is_no_theorem_or_which_one_it_is() -> None:
    found = fs.conjecture("lag", by=["n", "zeta", "normal_rank"], box=SMALL)
    assert all(one.standing.startswith("not refuted up to 6 states by what was tried; ") for one in (*found.above, *found.below))
    by_n = fs.conjecture("lag", by=["n"], box=SMALL).above[0]
    assert (by_n.text, by_n.theorems) == ("lag <= n", ("lag_at_most_n",)) and by_n.standing.endswith("; it follows from lag_at_most_n")
    assert by_n.to_json()["theorems"] == ["lag_at_most_n"] and ("  standing", by_n.standing) in list(by_n.sheet("above 1"))
    assert any(one.standing.endswith("; no theorem") for one in fs.conjecture("n_z", by=["n", "p"], box=SMALL).below)
