"""Claims about a choice P: its quantities against slow ways, the box in its order, verdicts with certificates, what is refused."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import product
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import faultspace as fs
from faultspace.base.errors import InvalidInput
from faultspace.cli.command_line import main
from faultspace.exact import Matrix, ResidualSystem
from faultspace.packaged_examples import content
from faultspace.proofs.boxes.choice_box import ChoiceBox
from faultspace.proofs.brought.claim_files import read_claims
from faultspace.proofs.brought.claiming import decide_claims, explain
from faultspace.proofs.brought.claims import Answered, make_claim
from faultspace.proofs.brought.known_cases import known_cases, smaller
from faultspace.proofs.language.by_batches import Table, true_of
from faultspace.proofs.language.evaluating import exactly
from faultspace.proofs.language.grammar import read
from faultspace.proofs.language.vocabularies import CHOICE, VOCABULARIES
from faultspace.proofs.quantities.blocks import height
from faultspace.proofs.quantities.cases import Choice
from faultspace.proofs.quantities.choices import OF_A_CHOICE
from tests.oracle import behaviours, fault_space
from tests.oracle.systems import parse_system
from tests.proofs.case_checks import check_documents, check_example, check_order, check_refused, check_the_first, check_weights
from tests.thorough import every

ONE: dict[str, Any] = {"n": [1, 1], "m": [1, 1], "p": [1, 1], "k": [1, 1]}


def box_of(field: str = "Q", **box: Any) -> ChoiceBox:
    found = make_claim("x", {"about": CHOICE, "conclusion": "k >= 0", "fields": [field], "box": box}).boxes[field]
    assert isinstance(found, ChoiceBox)
    return found


def decided(conclusion: Any, *hypotheses: Any, fields: tuple[str, ...] = ("Q",), **box: Any) -> Any:
    return fs.claim(conclusion, hypotheses=hypotheses, about=CHOICE, box=box, fields=fields).answers[0]


def by_definition(choice: Choice) -> dict[str, Any]:
    """Return what problem (11) solved on a long window, and column spaces, say of a choice."""
    system = choice.system
    slow = parse_system(system.to_json())
    rows = fault_space.fault_space_limit(slow).rows
    write = slow.field.write
    basis = Matrix.of([[write(x) for x in row] for row in rows], system.field, shape=(len(rows), system.n + system.p))
    columns = basis.transposed() @ choice.P
    F, G = columns.rows(range(system.n)), columns.rows(range(system.n, system.n + system.p))
    chosen = parse_system(system.with_faults(F, G).to_json())
    difference = behaviours.first_difference(slow, chosen)
    return {
        "equal": behaviours.equivalent(slow, chosen),
        "contained": behaviours.included(slow, chosen),
        "first_difference": inf if difference is None else difference,
        "equal_on": [behaviours.equal_on(slow, chosen, s) for s in range(4)],
        "contained_on": [behaviours.included_on(slow, chosen, s) for s in range(4)],
        "k": choice.P.ncols,
        "F": F,
    }


TEXTS: dict[str, Callable[[dict[str, Any]], bool]] = {
    "equal": lambda told: told["equal"],
    "contained": lambda told: told["contained"],
    "first_difference <= 1": lambda told: told["first_difference"] <= 1,
    "equal_on(1)": lambda told: told["equal_on"][1],
    "contained_on(2)": lambda told: told["contained_on"][2],
    "k == 1": lambda told: told["k"] == 1,
    "is_zero(chosen.F)": lambda told: told["F"].is_zero(),
    "rank(F - chosen.F) == 0 or k != m": lambda told: True,
}


@pytest.mark.parametrize("field", ["Q", "GF(2)"])
def test_a_quantity_of_a_choice_is_what_slow_ways_find(field: str) -> None:
    box = box_of(field, n=[0, 2], m=[0, 1], p=[0, 2], total=3, k=[0, 2], entries=[0, 1])
    seen = 0
    for sizes in box.sizes():
        for stretch in box.stretches(sizes, reduced=False):
            rows = np.arange(0, len(stretch.batch), max(every(5), len(stretch.batch) // 4))
            flags = {text: true_of(read(text, vocabulary=VOCABULARIES[CHOICE]), stretch.batch, rows, Table()) for text in list(TEXTS)[:-1]}
            for place, i in enumerate(rows):
                case = stretch.batch.case(int(i))
                told, knows = by_definition(case), exactly(case)
                assert {text: flags[text][place] for text in flags} == {text: TEXTS[text](told) for text in flags}, str(case)
                for name, one in OF_A_CHOICE.items():
                    value = [one.exact(knows.whole, s) for s in range(4)] if one.windowed else one.exact(knows.whole)
                    assert value == told[name], (name, str(case))
                assert knows.matrix("chosen", "F") == told["F"] and knows.matrix("", "P") == case.P
                seen += 1
    assert seen > 40


def in_order(box: ChoiceBox) -> Iterator[Choice]:
    """Yield every choice of a box over Q in the order of the contract."""
    ranges = [range(low, high + 1) for low, high in (box.n, box.m, box.p, box.k)]
    for n, m, p, k in sorted(product(*ranges), key=lambda one: (sum(one[:3]), one[3], one[:3])):
        if n + m + p > box.total:
            continue
        found = []
        for entries in product(sorted(box.entries), repeat=(n + p) * (n + m)):
            rest = iter(entries)
            parts = ([[next(rest) for _ in range(b)] for _ in range(a)] for a, b in ((n, n), (n, m), (p, n), (p, m)))
            system = ResidualSystem.of(*parts, n=n, m=m, p=p)
            n_z = fault_space.fault_space_limit(parse_system(system.to_json())).height
            for own in product(sorted(box.entries), repeat=n_z * k):
                P = Matrix.of([list(own[i * k : (i + 1) * k]) for i in range(n_z)], shape=(n_z, k))
                found.append(((max(map(height, (*entries, *own)), default=0), entries, own), Choice(system, P)))
        yield from (case for _, case in sorted(found, key=lambda one: one[0]))


BOXES = [
    {**ONE, "entries": [0, 1]},
    {**ONE, "m": [0, 1], "k": [0, 2], "entries": [0, 2]},
    {**ONE, "entries": [0, "1/2"]},
]


@pytest.mark.parametrize("given", BOXES, ids=str)
def test_a_box_of_choices_is_gone_through_in_the_stated_order(given: dict[str, Any]) -> None:
    check_order(box_of(**given), in_order)


def test_the_choices_that_are_looked_at_stand_for_all() -> None:
    for field in ("Q", "GF(2)"):
        entries = [-1, 0, 1] if field == "Q" else [0, 1]
        check_weights(box_of(field, n=[0, 1], m=[1, 2], p=[0, 1], total=3, k=[1, 2], entries=entries))


def test_no_order_of_states_or_outputs_is_left_out() -> None:
    """Another order of the states moves the basis by which P is written, so that all systems without a fault are looked at."""
    for sizes, count in (((2, 0, 1, 1), 3**6), ((1, 0, 2, 1), 3**3)):
        box = box_of(n=[1, 2], m=[0, 0], p=[1, 2], total=3, k=[1, 1])
        systems = {str(one.batch.case(i).system) for one in box.stretches(sizes, reduced=True) for i in range(len(one.batch))}
        assert len(systems) == count


FAILING = [
    ("equal", ["left_invertible", "k == m", "rank(P) == k"]),
    ("iff(chosen.normal_rank == normal_rank, equal_on(1))", []),
    ("is_zero(F - chosen.F)", ["k == m", "equal"]),
    ("rank(P) <= 0 or rows(P) == 2", []),
    ("is_zero(P.T @ P)", ["lag == 1"]),
]


@pytest.mark.parametrize(("conclusion", "hypotheses"), FAILING)
@pytest.mark.parametrize("entries", [[0, 1], [-1, "1/2"]])
def test_the_choice_that_refutes_is_the_first_of_the_box(conclusion: str, hypotheses: list[str], entries: list[Any]) -> None:
    check_the_first(CHOICE, conclusion, hypotheses, {**ONE, "entries": entries}, in_order)


EXAMPLES = {one.id: one for one in read_claims(content("example:choices").decode())}


@pytest.mark.parametrize("name", list(EXAMPLES))
def test_an_example_about_choices_is_answered_as_expected(name: str) -> None:
    check_example(EXAMPLES[name], lambda box: replace(box, n=(1, 1), m=(1, 1), p=(1, 2)))


def test_the_bad_choice_is_no_larger_than_the_published_one() -> None:
    published = json.loads(content("example:theorem-3"))
    answer = decide_claims([EXAMPLES["independent-columns"]], ablation=False).answers[0]
    assert answer.counterexample is not None and answer.counterexample.smallest
    case = answer.counterexample.case
    assert isinstance(case, Choice)
    assert case.system.n + case.system.m + case.system.p <= len(published["A"]) + len(published["F"][0]) + len(published["C"])
    assert "behaviour-difference" in {one["kind"] for one in answer.counterexample.certificates}
    written = answer.to_json()["smallest"]
    assert set(written) == {"system", "P", "k", "quantities", "computed", "in_box"}


def test_a_choice_outside_the_box_is_made_smaller() -> None:
    answer = decided("n <= 1 or equal", **ONE)
    assert answer.verdict == Answered.REFUTED and not answer.counterexample.smallest
    case = answer.counterexample.case
    assert case.system.n == 2 and case.P.nrows == exactly(case).quantity("", "n_z")
    start = Choice(ResidualSystem.of([[3]], [[5]], [[7]], [[2]]), Matrix.of([[3, 4], [5, 6]]))
    end = smaller(start, lambda one: isinstance(one, Choice) and not one.P.is_zero())
    assert isinstance(end, Choice) and end.P.to_json() == [["1"]] and end.system.n + end.system.m + end.system.p == 2


def test_known_choices_are_good_and_bad() -> None:
    for field in ("Q", "GF(2)"):
        listed = known_cases(box_of(field))[:: every(8)]
        equal = [exactly(one.case, one.subject).quantity("", "equal") for one in listed]
        assert sum(equal) > 5 and len(equal) - sum(equal) > 5 and len({one.origin for one in known_cases(box_of(field))}) == 2


REFUSED = [
    ("lagg == 1", "the nearest is lag"),
    ("chosen == 1", "got chosen alone, expected a quantity of it, such as chosen.lag"),
    ("chosen.P == 1", "got 'chosen.P', expected P alone"),
    ("P == 1", "a matrix == an integer"),
    ("first.lag == 1", "a word of claims about a pair, expected one of those about a choice"),
    ("k", "which is an integer"),
    ("choosen.lag == 1", "a name after chosen."),
]


@pytest.mark.parametrize(("text", "words"), REFUSED)
def test_what_is_refused_about_choices_is_told_in_words(text: str, words: str) -> None:
    check_refused(text, words, CHOICE)


def test_boxes_of_choices_are_checked() -> None:
    with pytest.raises(InvalidInput, match=r"box\.k: got an unknown key"):
        fs.claim("n == 1", box={"k": [1, 1]})
    with pytest.raises(InvalidInput, match=r"box\.k: got \[2, 1\]"):
        fs.claim("k == 1", about=CHOICE, box={"k": [2, 1]})
    assert decided("rows(P) == n_z and columns(P) == k", n=[0, 1], m=[0, 1], p=[0, 1], k=[0, 1]).verdict == Answered.NOT_REFUTED
    assert decided(lambda s: s.equal == (s.chosen.normal_rank == s.normal_rank), **ONE).verdict == Answered.NOT_REFUTED


def test_explaining_a_choice(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, claims = tmp_path / "choice.json", tmp_path / "claims.toml"
    claims.write_text("[claim.x]\nabout = 'choice'\nconclusion = 'equal or chosen.lag == 0'\nbox = {total = 3, k = [1, 1]}\n")
    system = {"A": [["1/2"]], "F": [[1]], "C": [[1]], "G": [[0]]}
    file.write_text(json.dumps({"system": system, "P": [[3], [2]]}))
    assert main(["claim", str(claims), "--explain", str(file), "--json"]) == 0
    assert {"level": 1, "text": "equal", "value": "True"} in json.loads(capsys.readouterr().out)["explained"]["x"]
    documents = (
        ({"system": system, "P": [[3]]}, "expected 2 rows"),
        ({"system": system, "P": 3}, "expected 2 rows"),
        ({"system": system, "P": [[1], [2, 3]]}, "P"),
        ({"P": [[1]]}, "expected system and P"),
        (system, "got a system, expected a choice"),
        ({"first": system, "second": system}, "got a pair of systems, expected a choice"),
    )
    check_documents(claims, documents, capsys)
    assert [text for _, text, _ in explain(EXAMPLES["independent-columns"], Choice(fs.System(**system).residual, Matrix.of([[1], [0]])))]  # type: ignore[arg-type]
