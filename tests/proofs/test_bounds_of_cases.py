"""Bounds about pairs, choices and records: what lies outside the box by its definition, known bounds found, false ones refuted."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

import faultspace as fs
from faultspace.base.errors import InvalidInput
from faultspace.base.progress import silent
from faultspace.cli.command_line import main
from faultspace.exact import FaultySystem, Matrix, PrimeField, Rationals, ResidualSystem, fault_space, kernel_representation, with_pair
from faultspace.proofs.brought import sparse_systems, tables
from faultspace.proofs.brought.claims import Answered, make_box, make_claim
from faultspace.proofs.brought.conjectures import Conjectures, Sharpened
from faultspace.proofs.brought.conjecturing import default_columns, sharpen
from faultspace.proofs.brought.direct_sums import direct_sums, sum_sizes
from faultspace.proofs.brought.drawn_cases import drawn
from faultspace.proofs.brought.known_bounds import known_as
from faultspace.proofs.language.evaluating import Exactly, evaluate, exactly
from faultspace.proofs.language.grammar import read
from faultspace.proofs.language.vocabularies import CHOICE, ONE_A_AND_C, PAIR, RECORD, SYSTEM, VOCABULARIES
from faultspace.proofs.quantities.cases import Choice, Pair, Record
from faultspace.proofs.quantities.choices import OF_A_CHOICE
from faultspace.proofs.quantities.pairs import OF_A_PAIR
from faultspace.proofs.quantities.records import OF_A_RECORD
from faultspace.proofs.quantities.registry import Kind, Subject
from faultspace.proofs.trust.structure_certificates import accept
from tests.thorough import every

ROOT = Path(__file__).parents[2]
ONE: dict[str, Any] = {"n": [1, 1], "m": [1, 1], "p": [1, 1], "total": 3}
BOXES: dict[str, dict[str, Any]] = {
    PAIR: ONE,
    ONE_A_AND_C: ONE,
    CHOICE: ONE | {"k": [1, 1]},
    RECORD: {"n": [1, 1], "m": [0, 0], "p": [1, 1], "total": 2, "nu": [1, 1], "N": [1, 3]},
}
COLUMNS = {
    PAIR: ["first.lag", "second.n_z", "rank(second.F)", "p"],
    ONE_A_AND_C: ["n", "first.lag", "second.m"],
    CHOICE: ["lag", "chosen.normal_rank", "rank(P)", "k"],
    RECORD: ["lag", "inputs.controllability_index", "x_rank(1)", "w_rank(n + 1)", "y_rank(1)", "N"],
}


@pytest.fixture(autouse=True)
def few_outside(monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> None:
    """Most tests have enough in few cases outside the box, and in no known ones, which take most of the time."""
    if "all_outside" not in request.fixturenames:
        monkeypatch.setattr(tables, "MOST_SUMS", 100)
        monkeypatch.setattr(tables, "MOST_MET", 100)
        monkeypatch.setattr(tables, "DRAWS", 10)
        monkeypatch.setattr(tables, "known_cases", lambda box: ())


@pytest.fixture
def all_outside() -> None:
    """A test that asks for it has as many as users have."""


def conjectured(about: str, target: str, *hypotheses: str, by: list[str], **given: Any) -> Conjectures:
    return fs.conjecture(target, about=about, hypotheses=hypotheses, by=by, **({"box": BOXES[about]} | given))


def sharpened(about: str, conclusion: str, *hypotheses: str, box: dict[str, Any] | None = None) -> Sharpened:
    given = {"about": about, "conclusion": conclusion, "hypotheses": list(hypotheses), "box": BOXES[about] if box is None else box}
    return sharpen(make_claim("x", given))[0]


# -- outside the box ---------------------------------------------------------------------------------------------------


def system_sum(one: ResidualSystem, other: ResidualSystem) -> ResidualSystem:
    """Return the direct sum of two systems, entry by entry."""

    def block(a: Matrix, b: Matrix) -> list[list[Any]]:
        rows = [[*row, *[0] * b.ncols] for row in a.elements()] + [[*[0] * a.ncols, *row] for row in b.elements()]
        return rows

    parts = (block(getattr(one, name), getattr(other, name)) for name in "AFCG")
    return ResidualSystem.of(*parts, field=one.field, n=one.n + other.n, m=one.m + other.m, p=one.p + other.p)


LEFT = ResidualSystem.of([[0, 2], [0, 0]], [[0], [1]], [[1, 0], [0, 0]], [[0], [3]])
RIGHT = ResidualSystem.of([[1]], [[2]], [[1]], [[3]])


def test_the_sum_of_two_pairs_is_that_of_the_firsts_and_of_the_seconds() -> None:
    one, other = Pair(LEFT, RIGHT), Pair(RIGHT, RIGHT)
    found = direct_sums([(one, other), (one, other)], make_box(ONE, Rationals(), PAIR)).case(1)
    assert found == Pair(system_sum(LEFT, RIGHT), system_sum(RIGHT, RIGHT))
    assert sum_sizes(one, other) == found.size


def test_the_sum_of_two_records_has_the_data_of_both() -> None:
    def record(B: Any, D: Any, u: Any, x0: Any, system: ResidualSystem) -> Record:
        return Record(FaultySystem(system, Matrix.of(B), Matrix.of(D)), Matrix.of(u), Matrix.of(x0))

    one = record([[1], [5]], [[2], [0]], [[1], [2]], [[1], [7]], LEFT)
    other = record([[3]], [[4]], [[8], [9]], [[6]], RIGHT)
    found = direct_sums([(one, other)], make_box(BOXES[RECORD], Rationals(), RECORD)).case(0)
    driven = FaultySystem(system_sum(LEFT, RIGHT), Matrix.of([[1, 0], [5, 0], [0, 3]]), Matrix.of([[2, 0], [0, 0], [0, 4]]))
    assert found == Record(driven, Matrix.of([[1, 8], [2, 9]]), Matrix.of([[1], [7], [6]])) and sum_sizes(one, other) == found.size
    assert sum_sizes(one, replace(other, u=Matrix.of([[8]]))) is None  # data of other lengths have no sum


@pytest.mark.parametrize("prime", [None, 3])
def test_the_sum_of_two_choices_has_the_sum_of_the_chosen_systems(prime: int | None) -> None:
    field = Rationals() if prime is None else PrimeField(prime)

    def moved(system: ResidualSystem) -> ResidualSystem:
        parts = ([[int(x) for x in row] for row in getattr(system, name).elements()] for name in "AFCG")
        return ResidualSystem.of(*parts, field=field, n=system.n, m=system.m, p=system.p)

    halves = 0
    wide = ResidualSystem.of([], [], [[], []], [[2], [1]], n=0, m=1, p=2)  # its fault space has the basis [1, 1/2]
    for left, right in ((LEFT, RIGHT), (RIGHT, LEFT), (wide, RIGHT), (LEFT, wide)):
        one, other = (Choice(s, small(s)) for s in (moved(left), moved(right)))
        batch = direct_sums([(one, other)], make_box(BOXES[CHOICE], field, CHOICE))
        found = batch.case(0)
        whole = system_sum(one.system, other.system)
        chosen = [with_pair(fault_space(kernel_representation(s.system)), s.P) for s in (one, other)]
        assert found.system == whole and with_pair(fault_space(kernel_representation(whole)), found.P) == system_sum(*chosen)  # type: ignore[union-attr]
        assert sum_sizes(one, other) == found.size  # type: ignore[union-attr]
        second, scale = batch.second.system(0), int(batch.scales[0])  # type: ignore[attr-defined]
        halves += scale > 1
        expected = system_sum(*chosen)
        for name in "FG":
            assert [[x * scale for x in row] for row in getattr(expected, name).elements()] == getattr(second, name).elements()
    assert (halves > 0) == (prime is None)


def small(system: ResidualSystem) -> Matrix:
    """Return a P (n_z x 2) of small integers of which no two rows are the same."""
    n_z = fault_space(kernel_representation(system)).dimension
    return Matrix.of([[k + 1, k % 2] for k in range(n_z)], system.field, shape=(n_z, 2))


@pytest.mark.parametrize("about", [PAIR, ONE_A_AND_C, CHOICE, RECORD])
@pytest.mark.parametrize("prime", [None, 2])
def test_a_table_is_what_exact_functions_say_of_its_cases(about: str, prime: int | None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tables, "MOST_SUMS", 30)
    box = make_box(BOXES[about], Rationals() if prime is None else PrimeField(prime), about)
    nodes = [read(one, Kind.INTEGER, VOCABULARIES[about]) for one in COLUMNS[about]]
    table = tables.tabulate(box, [], nodes, most=10**9, jobs=1, progress=silent)
    outside = [row for row in table.rows if not row.in_box]
    assert table.sums_met == table.sums > 0 and table.drawn_met >= 100 and len(outside) > 2
    assert sum(row.others for row in table.rows) == table.sums + table.drawn and table.met == table.systems
    for row in table.rows[:: 9 * every()]:
        knows = exactly(row.case)
        assert tuple(evaluate(node, knows) for node in nodes) == row.values, row.case


def test_drawn_pairs_agree_for_a_while() -> None:
    """Otherwise they would say nothing about late differences."""
    box, rng = make_box(ONE, Rationals(), PAIR), np.random.default_rng(3)
    difference = read("first_difference", Kind.INTEGER, VOCABULARIES[PAIR])
    found = []
    for _ in range(8):
        batch = drawn(box, rng)
        found += [evaluate(difference, exactly(batch.case(k))) for k in range(0, len(batch), 9)]
    assert {1.0, 2.0, 3.0} <= set(found) and float("inf") in found
    free = [
        one for _ in range(30) if (one := drawn(box, rng)) and any(makes_every_output(one.case(0), name) for name in ("first", "second"))
    ]
    assert len(free) > 2
    shared = drawn(make_box(ONE, Rationals(), ONE_A_AND_C), rng).case(0)
    assert isinstance(shared, Pair) and (shared.first.A, shared.first.C) == (shared.second.A, shared.second.C)


def makes_every_output(pair: Any, name: str) -> bool:
    system: ResidualSystem = getattr(pair, name)
    return system.n > 0 and system.F.is_zero() and Matrix.identity(system.field, system.p) == system.G


# -- what is answered --------------------------------------------------------------------------------------------------

KNOWN = [
    (PAIR, "first_difference", ["not equal"], ["first.lag", "second.lag"], "first_difference <= max(first.lag, second.lag) + 1"),
    (ONE_A_AND_C, "first_difference", ["not equal"], ["n", "first.lag"], "first_difference <= n + 1"),
    (CHOICE, "chosen.normal_rank", [], ["normal_rank", "k"], "chosen.normal_rank <= normal_rank"),
    (RECORD, "x_rank(1)", [], ["n", "u_rank(1)"], "x_rank(1) <= n + u_rank(1)"),
]


def check(found: Conjectures) -> None:
    """Hold every bound against `claim`: it is not refuted, and the sharper ones are, by the same smallest case."""
    for bound in (*found.above, *found.below):
        for text, case in ((bound.text, None), *((one.text, one.counterexample) for one in bound.sharper)):
            answer = fs.claim(text, about=found.about, hypotheses=found.hypotheses, box=BOXES[found.about], ablation=False).answers[0]
            if case is None:
                assert answer.verdict != Answered.REFUTED or not answer.counterexample.smallest, text  # type: ignore[union-attr]
            elif case.smallest:
                assert answer.counterexample is not None and answer.counterexample.case == case.case, text
        assert bound.systems > 0 and bound.sharper[0].counterexample is not None and bound.sharper[0].counterexample.case == bound.case
    for certificate in found.certificates:
        accept(certificate)


@pytest.mark.parametrize(("about", "target", "hypotheses", "by", "known"), KNOWN, ids=[one[0] for one in KNOWN])
def test_a_known_bound_is_found_and_attained(about: str, target: str, hypotheses: list[str], by: list[str], known: str) -> None:
    found = conjectured(about, target, *hypotheses, by=by)
    assert known in [one.text for one in found.above] and (found.about, found.tried.drawn_met > 0) == (about, True)
    told = "\n".join(value for _, value in found.sheet())
    assert f"{found.tried.of} of the box" in told and "proved" not in told and "holds" not in told


@pytest.mark.slow
@pytest.mark.parametrize(("about", "target", "hypotheses", "by", "known"), KNOWN, ids=[one[0] for one in KNOWN])
def test_every_bound_is_what_claim_says_of_it(
    about: str, target: str, hypotheses: list[str], by: list[str], known: str, all_outside: None
) -> None:
    found = conjectured(about, target, *hypotheses, by=by)
    assert known in [one.text for one in found.above] and found.tried.corpus_met > 0
    check(found)


@pytest.mark.parametrize(
    ("about", "conclusion", "hypotheses", "own"),
    [
        (PAIR, "first_difference <= max(first.lag, second.lag)", ["not equal"], "first_difference <= max(first.lag, second.lag) + 1"),
        (ONE_A_AND_C, "first_difference <= n + 3", ["not equal"], "first_difference <= n + 1"),
        (CHOICE, "chosen.normal_rank <= k - 1", [], "chosen.normal_rank <= k"),
        (RECORD, "x_rank(1) < n + u_rank(1)", [], "x_rank(1) <= n + u_rank(1)"),
    ],
)
def test_a_claim_is_sharpened(about: str, conclusion: str, hypotheses: list[str], own: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("faultspace.proofs.brought.conjecturing.default_columns", lambda target, about: [])
    found = sharpened(about, conclusion, *hypotheses)
    assert found.own is not None and found.own.text == own
    claimed = fs.claim(conclusion, about=about, hypotheses=hypotheses, box=BOXES[about], ablation=False).answers[0]
    refuted = conclusion != "first_difference <= n + 3"
    assert (claimed.verdict == Answered.REFUTED, found.counterexample is not None) == (refuted, refuted)
    if refuted:
        assert claimed.counterexample is not None and claimed.counterexample.case == found.counterexample


def test_a_false_bound_that_was_answered_once_falls(monkeypatch: pytest.MonkeyPatch) -> None:
    """A chain of n states without a fault and a system that makes every output, of which lag and n_z are small, differ at n + 1 samples."""
    chain = ResidualSystem.of([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0], [0], [0]], [[0, 0, 1]], [[0]])
    free = ResidualSystem.of([[0]], [[0]], [[0]], [[1]])
    knows = exactly(Pair(chain, free))
    said = [
        evaluate(read(text, Kind.INTEGER, VOCABULARIES[PAIR]), knows) for text in ("first_difference", "max(second.lag, second.n_z) + 1")
    ]
    assert said == [4, 3]
    monkeypatch.setattr(tables, "MOST_MET", 1000)
    monkeypatch.setattr(tables, "DRAWS", 40)
    found = conjectured(PAIR, "first_difference", "not equal", by=["second.lag", "second.n_z"])
    assert "first_difference <= max(second.lag, second.n_z) + 1" not in [one.text for one in found.above]


@pytest.mark.parametrize(
    ("about", "own", "name", "given"),
    [
        (PAIR, OF_A_PAIR, "first_difference", ["first_difference", ["not equal"], ["first.n"]]),
        (CHOICE, OF_A_CHOICE, "first_difference", ["first_difference", ["not equal"], ["n"]]),
        (RECORD, OF_A_RECORD, "x_rank", ["x_rank(1)", [], ["n"]]),
    ],
)
def test_a_broken_quantity_is_noticed(about: str, own: Any, name: str, given: list[Any], monkeypatch: pytest.MonkeyPatch) -> None:
    right = own[name]
    monkeypatch.setitem(own, name, replace(right, from_ranks=lambda ranks, *s: right.from_ranks(ranks, *s) + 1))
    target, hypotheses, by = given
    with pytest.raises(ArithmeticError, match="two ways"):
        conjectured(about, target, *hypotheses, by=by)


@pytest.mark.parametrize("about", [PAIR, CHOICE, RECORD])
def test_nothing_meets_the_hypotheses(about: str) -> None:
    size = "first.n" if about == PAIR else "n"
    found = conjectured(about, size, f"{size} > 99", by=[size])
    assert (found.above, found.below, found.tried.rows) == ((), (), 0) and "that were tried meets the hypotheses" in found.title
    assert found.tried.of in found.title


@pytest.mark.parametrize(
    ("about", "box"),
    [
        (PAIR, {"n": [0, 1], "m": [0, 1], "p": [0, 1], "total": 2}),
        (CHOICE, {"n": [0, 1], "m": [0, 1], "p": [0, 1], "k": [0, 1], "total": 2}),
        (RECORD, {"n": [0, 1], "m": [0, 1], "p": [0, 1], "nu": [0, 1], "N": [0, 1], "total": 2}),
    ],
)
def test_cases_without_states_faults_outputs_or_samples(about: str, box: dict[str, Any]) -> None:
    target, bound = {
        PAIR: ("first.lag", "first.n"),
        CHOICE: ("rank(P)", "k"),
        RECORD: ("u_rank(1)", "nu"),
    }[about]
    found = conjectured(about, target, by=[bound], box=box)
    assert f"{target} <= {bound}" in [one.text for one in found.above] and found.tried.exhausted


def test_infinite_and_undefined_quantities() -> None:
    with pytest.raises(InvalidInput, match=r'which is inf on first: .*the hypothesis "first_difference < inf" makes it so'):
        conjectured(PAIR, "first_difference", by=["first.n"])
    found = conjectured(PAIR, "first.lag", by=["first.n", "first_difference"])
    assert found.by == ("first.n",) and isinstance(found.left_out["first_difference"], Pair)
    with pytest.raises(InvalidInput, match=r"in the box: on first: .*guard it with len"):
        conjectured(PAIR, "second.left_minimal_indices[0]", by=["first.n"])


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: fs.conjecture("lag", about="pairs"), "about: got 'pairs'; the nearest is pair"),
        (lambda: fs.conjecture("lag", about="pair"), "target: column 1: got lag alone, expected first.lag or second.lag"),
        (lambda: fs.conjecture("first.lag"), "target: column 1: got 'first.lag', a word of claims about a pair"),
        (lambda: fs.conjecture("first.lag", about="pair", by=["lag"]), "by[0]: column 1: got lag alone"),
        (lambda: fs.conjecture("lag", about="choice", box={"N": [1, 2]}), "box.N: got an unknown key"),
        (lambda: sharpened(PAIR, "implies(not equal, first.n <= 2)"), "what is before the bound in implies(...) can stand among"),
        (lambda: sharpened(PAIR, "iff(equal, contained)"), "expected a bound to sharpen"),
    ],
)
def test_what_is_wrong_is_told(call: Any, words: str) -> None:
    with pytest.raises(InvalidInput) as error:
        call()
    assert words in str(error.value) and "\n" not in str(error.value)


def test_the_default_columns_are_words_of_the_kind_and_name_nothing_twice() -> None:
    for about, vocabulary in VOCABULARIES.items():
        node = read("n" if "n" in vocabulary.names() else "first.n", Kind.INTEGER, vocabulary)
        names = default_columns(node, about)
        assert node.text not in names and len(set(names)) == len(names) > 9
        for name in names:
            read(name, Kind.INTEGER, vocabulary)
    assert "first_difference" in default_columns(read("first.lag", Kind.INTEGER, VOCABULARIES[PAIR]), PAIR)


def test_there_are_direct_sums_however_many_sets_of_values_there_are(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tables, "MOST_SUMS", 3)
    found = conjectured(RECORD, "x_rank(1)", by=["u_rank(1)", "w_rank(1)", "N"])
    assert found.tried.rows > 3 == found.tried.sums


def test_a_statement_about_something_else_is_not_what_is_known() -> None:
    text = "lag <= n"
    assert known_as(read("n_z >= zeta + rank(F)"), [], CHOICE) == ()
    assert all(not known_as(read(text, vocabulary=VOCABULARIES[about]), [], about) or about == SYSTEM for about in (SYSTEM, CHOICE, RECORD))


def test_the_answers_are_as_the_schema_says() -> None:
    checker = jsonschema.Draft202012Validator(json.loads((ROOT / "proofs/schemas/conjectures.schema.json").read_text()))
    told: list[Any] = [
        conjectured(PAIR, "first.lag", by=["first.n", "first_difference"]).to_json(),
        conjectured(CHOICE, "chosen.lag", by=["n", "delay_known"], field="GF(2)").to_json(),
        conjectured(RECORD, "w_rank(1)", by=["n", "u_rank(1)"]).to_json(),
    ]
    for one in told:
        assert one["above"] and [error.message for error in checker.iter_errors(json.loads(json.dumps(one)))] == []
    assert {"first", "second", "systems"} == set(told[0]["above"][0]["attained"]) and told[0]["left_out"][0]["first"]["A"]
    del told[0]["above"][0]["attained"]["second"]
    assert list(checker.iter_errors(told[0]))


def test_the_command_says_what_it_bounds(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    box = ["--box", "n=1", "--box", "m=0", "--box", "p=1", "--box", "N=1:2", "--box", "total=2"]
    assert main(["conjecture", "u_rank(1)", "--about", "record", "--by", "nu", *box]) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert "u_rank(1) <= " in out and "records of the box, first by" in out and "drawn records" in out
    assert main(["conjecture", "u_rank(1)", "--about", "recod", "--by", "nu"]) == 2
    assert "the nearest is record" in capsys.readouterr().err


@pytest.mark.parametrize("bound", ["n >= p + 2", "rank(G) >= p", "delay_known <= lag + 1", "m >= rank(A) - lag"])
def test_sparse_systems_of_one_size_give_no_answer_for_those_of_another(bound: str) -> None:
    box = make_claim("x", {"conclusion": "n >= 0"}).boxes["Q"]
    node, answers = read(bound), dict[Any, Any]()
    for number in range(6):
        batch = sparse_systems._drawn(box, np.random.default_rng((2, number))).part(np.arange(25))
        failing = sparse_systems._failing([node], batch, np.arange(25), answers).tolist()
        assert failing == [k for k in range(25) if not evaluate(node, Exactly({"": Subject(batch.case(k))}))]
