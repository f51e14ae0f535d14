"""Claims about a record: ranks of data matrices against slow ways, the box in its order, verdicts with certificates, what is refused."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from itertools import islice, product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import faultspace as fs
from faultspace.base.errors import InvalidInput
from faultspace.cli.command_line import main
from faultspace.exact import Matrix, ResidualSystem
from faultspace.exact.system.systems import FaultySystem
from faultspace.packaged_examples import content
from faultspace.proofs.boxes.record_box import RecordBox
from faultspace.proofs.brought.claim_files import read_claims
from faultspace.proofs.brought.claims import Answered, make_claim
from faultspace.proofs.brought.known_cases import known_cases, smaller
from faultspace.proofs.language.by_batches import Table, true_of, values_of
from faultspace.proofs.language.evaluating import evaluate, exactly
from faultspace.proofs.language.grammar import read
from faultspace.proofs.language.vocabularies import RECORD, VOCABULARIES
from faultspace.proofs.quantities.blocks import height
from faultspace.proofs.quantities.cases import Record
from faultspace.proofs.quantities.records import OF_A_RECORD
from faultspace.proofs.quantities.registry import Kind
from faultspace.proofs.trust.structure_certificates import accept
from tests.oracle import behaviours, windows
from tests.oracle.linear import above, column_of, rank
from tests.oracle.systems import parse_system, trajectory
from tests.proofs.case_checks import check_documents, check_example, check_order, check_refused, check_the_first, check_weights
from tests.thorough import every

ONE: dict[str, Any] = {"n": [1, 1], "m": [0, 0], "p": [1, 1], "nu": [1, 1], "N": [1, 2]}


def box_of(field: str = "Q", **box: Any) -> RecordBox:
    found = make_claim("x", {"about": RECORD, "conclusion": "N >= 0", "fields": [field], "box": box}).boxes[field]
    assert isinstance(found, RecordBox)
    return found


def decided(conclusion: Any, *hypotheses: Any, fields: tuple[str, ...] = ("Q",), **box: Any) -> Any:
    return fs.claim(conclusion, hypotheses=hypotheses, about=RECORD, box=box, fields=fields).answers[0]


def by_definition(record: Record) -> dict[str, Any]:
    """Return the ranks of Hankel matrices that are built sample by sample, for k = 0, ..., N + 2; beyond N they are 0."""
    system = record.system
    slow = parse_system(system.residual.with_faults(system.B, system.D).to_json())
    field = slow.field
    u = [[field.parse(x) for x in row] for row in record.u.to_json()]
    x0 = [field.parse(row[0]) for row in record.x0.to_json()]
    samples, inputs = len(u), [column_of(field, row) for row in u]
    _, outputs = trajectory(slow, x0, u)
    both = [above(one, other) for one, other in zip(inputs, outputs, strict=True)]

    def ranks(signal: list[Any], width: int) -> list[int]:
        return [rank(windows.hankel(field, signal, width, k)) if k <= samples else 0 for k in range(samples + 3)]

    u_rank = ranks(inputs, system.nu)
    return {
        "N": samples,
        "nu": system.nu,
        "u_rank": u_rank,
        "y_rank": ranks(outputs, system.p),
        "w_rank": ranks(both, system.nu + system.p),
        "x_rank": [rank(behaviours.excitation(slow, x0, u, k)) if k <= samples else 0 for k in range(samples + 3)],
        "exciting": [k <= samples and u_rank[k] == system.nu * k for k in range(samples + 3)],
    }


@pytest.mark.parametrize("field", ["Q", "GF(2)"])
def test_a_quantity_of_a_record_is_what_slow_ways_find(field: str) -> None:
    box = box_of(field, n=[0, 2], m=[0, 1], p=[0, 1], total=2, nu=[0, 2], N=[0, 3], entries=[0, 1] if field == "GF(2)" else [-1, 1])
    seen = 0
    for sizes in box.sizes():
        for stretch in islice(box.stretches(sizes, reduced=False), 1):
            rows = np.arange(0, len(stretch.batch), max(1, len(stretch.batch) // (9 // every() + 1)))
            nodes = {}
            for name, one in OF_A_RECORD.items():
                for text in [f"{name}({k})" for k in range(sizes[4] + 3)] if one.windowed else [name]:
                    nodes[text] = read(text, one.kind, VOCABULARIES[RECORD])
            values: dict[int, Any] = {}
            for found, places in values_of(list(nodes.values()), stretch.batch, rows, Table()):
                values |= {int(place): dict(zip(nodes, found, strict=True)) for place in places}
            for i in rows:
                case = stretch.batch.case(int(i))
                told, knows = by_definition(case), exactly(case)
                for text, value in values[int(i)].items():
                    name, _, k = text.rstrip(")").partition("(")
                    wanted = told[name][int(k)] if k else told[name]
                    exact = knows.windowed("", name, int(k)) if k else knows.quantity("", name)
                    assert value == wanted == exact, (text, str(case))
                seen += 1
    assert seen > 100


def test_words_about_both_systems_of_a_record() -> None:
    system = FaultySystem(ResidualSystem.of([[0]], [[1]], [[1]], [[0]]), Matrix.of([[0]]), Matrix.of([[2]]))
    case = Record(system, Matrix.of([[1], [0], [3]]), Matrix.of([[5]]))

    def value(text: str, kind: Kind = Kind.WORD) -> Any:
        return evaluate(read(text, kind, VOCABULARIES[RECORD]), exactly(case))

    assert value("controllable and not inputs.controllable and m == 1 and nu == 1 and N == 3")
    assert value("is_zero(B) and rank(D - inputs.G) == 0 and rank(u) == 1 and rows(u) == N and rank(hstack(x0, B)) == 1")
    assert value("all(u_rank(s) == 0 for s in windows(4)) and exciting(2) and not exciting(3) and not exciting(9)")
    assert value("least(s for s in windows(0) if not exciting(s)) == 3 and all(w_rank(s) <= nu * s + n for s in windows(0))")


def in_order(box: RecordBox) -> Iterator[Record]:
    """Yield every record of a box over Q in the order of the contract."""
    ranges = [range(low, high + 1) for low, high in (box.n, box.m, box.p, box.nu, box.N)]
    for n, m, p, nu, N in sorted(product(*ranges), key=lambda one: (sum(one[:3]), one[3], one[4], one[:3])):
        if n + m + p > box.total:
            continue
        shapes = (n, n), (n, m), (p, n), (p, m), (n, nu), (p, nu), (N, nu), (n, 1)
        count = sum(a * b for a, b in shapes)
        for entries in sorted(product(sorted(box.entries), repeat=count), key=lambda one: (max(map(height, one), default=0), one)):
            rest = iter(entries)
            A, F, C, G, B, D, u, x0 = (Matrix.of([[next(rest) for _ in range(b)] for _ in range(a)], shape=(a, b)) for a, b in shapes)
            yield Record(FaultySystem(ResidualSystem(A, F, C, G), B, D), u, x0)


BOXES: list[dict[str, Any]] = [
    {**ONE, "entries": [0, 1]},
    {**ONE, "n": [0, 1], "p": [0, 1], "N": [0, 1], "nu": [0, 2], "entries": [-1, 2]},
    {**ONE, "m": [0, 1], "N": [1, 1], "entries": [0, "1/2"]},
]


@pytest.mark.parametrize("given", BOXES, ids=str)
def test_a_box_of_records_is_gone_through_in_the_stated_order(given: dict[str, Any]) -> None:
    check_order(box_of(**given), in_order)


def test_the_records_that_are_looked_at_stand_for_all() -> None:
    for field in ("Q", "GF(2)", "GF(3)"):
        check_weights(box_of(field, n=[0, 1], m=[0, 1], p=[0, 1], total=2, nu=[0, 2], N=[0, 2]))


FAILING = [
    ("x_rank(1) == n + nu", ["exciting(n)", "inputs.controllable"]),
    ("w_rank(1) == nu + inputs.rank_O(1)", ["exciting(1)"]),
    ("exciting(1)", ["x_rank(0) == 1"]),
    ("rank(hstack(x0, B)) == 1", ["N == 2"]),
    ("is_zero(A @ B)", ["u_rank(2) == 1"]),
    ("x_rank(1) <= w_rank(1)", []),
]


@pytest.mark.parametrize(("conclusion", "hypotheses"), FAILING)
@pytest.mark.parametrize("entries", [[0, 1], [-1, "1/2"]])
def test_the_record_that_refutes_is_the_first_of_the_box(conclusion: str, hypotheses: list[str], entries: list[Any]) -> None:
    check_the_first(RECORD, conclusion, hypotheses, {**ONE, "entries": entries}, in_order)


def test_signs_decide_nothing_that_an_invariant_claim_asks() -> None:
    """The first of all records, and the first of those that stand for them, are the same where signs are exchanged."""
    given = {**ONE, "N": [2, 2], "nu": [1, 2], "entries": [-1, 1]}
    for text in ("x_rank(1) == n + nu", "w_rank(1) <= 1"):
        claim = make_claim("x", {"about": RECORD, "conclusion": text, "box": given})
        wanted = next(one for one in in_order(box_of(**given)) if not evaluate(claim.conclusion, exactly(one)))
        assert decided(text, **given).counterexample.case == wanted


EXAMPLES = {one.id: one for one in read_claims(content("example:records").decode())}


@pytest.mark.parametrize("name", list(EXAMPLES))
def test_an_example_about_records_is_answered_as_expected(name: str) -> None:
    few = "lemma" in name

    def smaller_box(box: Any) -> RecordBox:
        assert isinstance(box, RecordBox)
        return replace(box, N=(1, min(4 if few else 3, box.N[1])), entries=box.entries[-2:] if few else box.entries)

    answers = check_example(EXAMPLES[name], smaller_box)
    if name == "fundamental-lemma":  # four samples excite no order of three
        assert answers.answers[0].verdict == Answered.NOT_REFUTED and answers.answers[0].tried.met == 0


def test_what_a_claim_reads_of_a_record_is_certified() -> None:
    for text in ("u_rank(1) == 9", "w_rank(2) == 9", "x_rank(1) == 9", "exciting(1) and nu == 9", "u_rank(7) == 9", "x_rank(0) == 9"):
        found = decided(text, **{**ONE, "N": [2, 2]}).counterexample
        assert found.computed == () and len(found.certificates) == (0 if "7" in text else 1)
        for one in found.certificates:
            accept(one)


def test_a_broken_rank_of_data_refutes_the_lemma(monkeypatch: pytest.MonkeyPatch) -> None:
    text, given = "implies(exciting(n + 1), x_rank(1) == n + nu)", {**ONE, "N": [3, 3], "entries": [0, 1]}
    assert decided(text, "inputs.controllable", **given).verdict == Answered.NOT_REFUTED
    right = OF_A_RECORD["x_rank"]
    less = replace(right, exact=lambda x, k: right.exact(x, k + 1), from_ranks=lambda r, k: right.from_ranks(r, k + 1))
    monkeypatch.setitem(OF_A_RECORD, "x_rank", less)
    assert decided(text, "inputs.controllable", **given).verdict == Answered.REFUTED
    monkeypatch.setitem(OF_A_RECORD, "x_rank", replace(right, from_ranks=lambda r, k: right.from_ranks(r, k + 2)))
    with pytest.raises(ArithmeticError, match="disagree"):
        decided(text, "inputs.controllable", **given)


def test_a_record_outside_the_box_is_made_smaller() -> None:
    answer = decided("n <= 1 or not exciting(2)", "nu >= 1", **ONE)
    assert answer.verdict == Answered.REFUTED and not answer.counterexample.smallest
    case = answer.counterexample.case
    assert case.system.n == 2 and case.system.nu == 1 and 3 <= case.u.nrows <= 6 and case.system.m == case.system.p == 0
    system = FaultySystem(ResidualSystem.of([[3]], [[5]], [[7]], [[2]]), Matrix.of([[3, 4]]), Matrix.of([[5, 6]]))
    end = smaller(
        Record(system, Matrix.of([[3, 4], [5, 6]]), Matrix.of([[7]])), lambda one: isinstance(one, Record) and not one.u.is_zero()
    )
    assert isinstance(end, Record) and end.u.to_json() == [["1"]] and (end.system.n, end.system.m, end.system.p) == (0, 0, 0)


def test_known_records_excite_and_do_not() -> None:
    for field in ("Q", "GF(2)"):
        listed = known_cases(box_of(field))
        node = read("exciting(n + 1)", vocabulary=VOCABULARIES[RECORD])
        excite = [evaluate(node, exactly(one.case, one.subject)) for one in listed[:: every(3)]]
        assert sum(excite) > 5 and len(excite) - sum(excite) > 5 and {one.origin for one in listed} == {"corpus", "adversary"}


REFUSED = [
    ("exciting", "expected exciting(s)"),
    ("exciting(u)", "which is a matrix, expected an integer"),
    ("u == 1", "a matrix == an integer"),
    ("inputs == 1", "got inputs alone, expected a quantity of it, such as inputs.lag"),
    ("inputs.N == 1", "got 'inputs.N', expected N alone"),
    ("inputs.B == 1", "got 'inputs.B', expected B alone"),
    ("urank(1) == 1", "the nearest is u_rank"),
    ("equal", "a word of claims about a pair"),
    ("all(u_rank(2 * s) == 1 for s in windows(0))", "s + c or s - c"),
    ("any(exciting(s) for N in windows(0))", "which is taken"),
]


@pytest.mark.parametrize(("text", "words"), REFUSED)
def test_what_is_refused_about_records_is_told_in_words(text: str, words: str) -> None:
    check_refused(text, words, RECORD)


def test_degenerate_records_have_values() -> None:
    given: dict[str, Any] = {"n": [0, 1], "m": [0, 0], "p": [0, 1], "total": 2, "nu": [0, 1], "N": [0, 2], "entries": [1]}
    text = "u_rank(0) == 0 and w_rank(0) == 0 and exciting(0) and x_rank(0) <= n and all(x_rank(s) <= n + nu * s for s in windows(0))"
    answer = decided(text, **given)
    assert answer.verdict == Answered.NOT_REFUTED and answer.tried.exhausted
    with pytest.raises(InvalidInput, match="number of samples"):
        decided("u_rank(N - 9) == 0", **ONE)
    with pytest.raises(InvalidInput, match=r"box\.N: got \[1, 9\]"):
        decided("N == 1", N=[1, 9])
    with pytest.raises(InvalidInput, match="no unit circle"):
        decided("inputs.stable", fields=("GF(2)",))
    flags = [
        true_of(read("exciting(1)", vocabulary=VOCABULARIES[RECORD]), one.batch, np.arange(0), Table())
        for one in islice(box_of(**ONE).stretches((1, 0, 1, 1, 1), reduced=True), 1)
    ]
    assert flags[0].shape == (0,)


def test_explaining_a_record(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, claims = tmp_path / "record.json", tmp_path / "claims.toml"
    claims.write_text("[claim.x]\nabout = 'record'\nconclusion = 'exciting(2) and x_rank(1) == 7'\nbox = {n = [1, 1], N = [3, 3]}\n")
    system = {"A": [["1/2"]], "F": [[1]], "C": [[1]], "G": [[0]], "B": [[1]], "D": [[0]]}
    record = {"system": system, "u": [[1], [0], ["1/3"]], "x0": [2]}
    file.write_text(json.dumps(record))
    assert main(["claim", str(claims), "--explain", str(file), "--json"]) == 0
    written = json.loads(capsys.readouterr().out)
    assert {"level": 1, "text": "exciting(2)", "value": "True"} in written["explained"]["x"] and written["u"] == [["1"], ["0"], ["1/3"]]
    assert main(["claim", str(claims), "--json", "--out", str(tmp_path / "out")]) == 0
    assert set(json.loads(capsys.readouterr().out)["claims"][0]["smallest"]) == {"system", "u", "x0", "quantities", "computed", "in_box"}
    documents = (
        ({**record, "x0": [1, 2]}, "expected a list of 1 numbers"),
        ({**record, "u": [[1, 2]]}, "u"),
        ({**record, "u": 3}, "expected a list of rows"),
        ({"u": [[1]], "system": system}, "expected system, u and x0"),
        ({**record, "system": {key: system[key] for key in "AFCG"}}, "expected one with inputs"),
        (system, "got a system, expected a record"),
        ({"first": system, "second": system}, "got a pair of systems, expected a record"),
    )
    check_documents(claims, documents, capsys)
