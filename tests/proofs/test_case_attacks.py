"""Expressions drawn at random about pairs, choices and records: what is found of many at once is what each says by itself."""

from __future__ import annotations

import itertools
import random
from typing import Any

import numpy as np
import pytest

import faultspace as fs
from faultspace.proofs.brought import kept
from faultspace.proofs.brought.claims import make_claim
from faultspace.proofs.language.by_batches import Table, UndefinedAt, true_of
from faultspace.proofs.language.evaluating import evaluate, exactly
from faultspace.proofs.language.nodes import Node, Undefined
from faultspace.proofs.language.vocabularies import CHOICE, ONE_A_AND_C, PAIR, RECORD
from tests.thorough import examples

_PAIR_NUMBERS = [
    "first.n",
    "second.m",
    "p",
    "first.lag",
    "second.n_z",
    "first_difference",
    "first.rank_OT(2)",
    "second.rank_T(p)",
    "rank(first.G)",
    "nullity(second.A)",
    "rank(hstack(first.C,second.C))",
    "first.delay_known",
    "second.zeta",
    "len(first.left_minimal_indices)",
    "first.left_minimal_indices[0]",
]
_PAIR_WORDS = [
    *("equal", "contained", "equal_on(1)", "contained_on(first.n)", "equal_on(second.lag)", "first.observable", "second.left_invertible"),
    *("is_zero(first.G - second.G)", "is_zero(first.C @ power(first.A, 2))", "nilpotent(second.A)", "all(equal_on(s) for s in windows(1))"),
    "any(contained_on(s + 1) and first.gap(s) == 1 for s in windows(0))",
]
NUMBERS = {
    PAIR: _PAIR_NUMBERS,
    ONE_A_AND_C: [*_PAIR_NUMBERS, "n", "rank(A)"],
    CHOICE: [
        "n",
        "m",
        "p",
        "k",
        "n_z",
        "chosen.lag",
        "chosen.n_z",
        "rank(P)",
        "rows(P)",
        "rank(hstack(F,chosen.F))",
        "rank(vstack(chosen.F,chosen.G))",
        "chosen.finite_zeros",
        "first_difference",
        "nullity(P.T@P)",
        "rank(I(n_z))",
    ],
    RECORD: [
        "n",
        "m",
        "N",
        "nu",
        "p",
        "u_rank(1)",
        "u_rank(N)",
        "w_rank(2)",
        "x_rank(n)",
        "x_rank(0)",
        "inputs.lag",
        "rank(u)",
        "rank(x0)",
        "rank(hstack(B,A@B))",
        "rank(vstack(B,D))",
        "inputs.n_z",
        "rank_O(2)",
        "w_rank(N+1)",
        "w_rank(N-1)",
    ],
}
WORDS = {
    PAIR: _PAIR_WORDS,
    ONE_A_AND_C: [*_PAIR_WORDS, "is_zero(C @ first.F)"],
    CHOICE: [
        *("equal", "contained", "equal_on(2)", "chosen.left_invertible", "is_zero(P)", "is_zero(chosen.G)", "chosen.controllable"),
        *("nilpotent(P @ P.T)", "all(chosen.gap(s) == gap(s) for s in windows(n))"),
    ],
    RECORD: [
        *("exciting(1)", "exciting(n)", "exciting(N)", "inputs.controllable", "observable", "is_zero(u)", "is_zero(A @ x0)"),
        *("all(x_rank(s) <= n + nu * s for s in windows(0))", "any(exciting(s) and u_rank(s) > 1 for s in windows(1))"),
        "least(s for s in windows(0) if not exciting(s)) > 1",
    ],
}
BOXES: dict[str, dict[str, Any]] = {
    PAIR: {"n": [0, 2], "m": [0, 1], "p": [0, 1], "total": 3},
    ONE_A_AND_C: {"n": [0, 2], "m": [0, 2], "p": [0, 1], "total": 3},
    CHOICE: {"n": [0, 2], "m": [0, 1], "p": [0, 2], "total": 3, "k": [0, 2]},
    RECORD: {"n": [0, 2], "m": [0, 1], "p": [0, 1], "total": 3, "nu": [0, 2], "N": [0, 3]},
}
FIELDS = (
    ("Q", [-1, 0, 1]),
    ("Q", [0, "1/2", -2]),
    ("GF(2)", [0, 1]),
    ("GF(3)", [-1, 0, 1]),
    ("Q(a) with a^2 - 2 = 0", [0, 1, "a"]),
    ("Q(a) with a^2 - 2 = 0", ["-1", "1 + a"]),
)


def drawn(about: str, rng: random.Random, depth: int = 0) -> str:
    kind = rng.random()
    if depth < 2 and kind < 0.35:
        return f"{rng.choice(['implies', 'iff'])}({drawn(about, rng, depth + 1)}, {drawn(about, rng, depth + 1)})"
    if depth < 2 and kind < 0.5:
        return f"({drawn(about, rng, depth + 1)} {rng.choice(['and', 'or'])} not {drawn(about, rng, depth + 1)})"
    if kind < 0.75:
        return rng.choice(WORDS[about])
    numbers = NUMBERS[about]
    return f"{rng.choice(numbers)} {rng.choice(['<=', '==', '<', '!='])} {rng.choice(numbers)} + {rng.randint(-1, 1)}"


def of_each(node: Node, cases: list[Any]) -> list[bool | None]:
    found: list[bool | None] = []
    for case in cases:
        try:
            found.append(bool(evaluate(node, exactly(case))))
        except Undefined:
            found.append(None)
    return found


@pytest.mark.parametrize("about", list(BOXES))
@pytest.mark.parametrize(("field", "entries"), FIELDS, ids=str)
def test_many_at_once_say_what_each_says(about: str, field: str, entries: list[Any]) -> None:
    rng = random.Random(f"{about} {field} {entries}")
    box = make_claim("x", {"about": about, "conclusion": "True", "fields": [field], "box": {**BOXES[about], "entries": entries}}).boxes[
        field
    ]
    for _ in range(examples(60) // 10):
        sizes = rng.choice(box.sizes())
        stretch = next(itertools.islice(box.stretches(sizes, reduced=rng.random() < 0.5), 1))
        rows = np.array(sorted(rng.sample(range(len(stretch.batch)), min(6, len(stretch.batch)))), dtype=np.intp)
        cases = [stretch.batch.case(int(i)) for i in rows]
        for _ in range(3):
            text = drawn(about, rng)
            node = make_claim("x", {"about": about, "conclusion": text, "fields": [field]}).conclusion
            wanted = of_each(node, cases)
            try:
                found: Any = [bool(x) for x in true_of(node, stretch.batch, rows, Table())]
            except UndefinedAt as error:
                assert wanted[list(rows).index(error.index)] is None, (text, sizes)
            else:
                assert found == wanted, (text, sizes, [str(case) for case in cases])


@pytest.mark.parametrize(
    ("about", "text", "box"),
    [
        (PAIR, "implies(equal_on(1), equal)", {"n": [1, 1], "m": [1, 1], "p": [1, 1], "entries": [0, 1]}),
        (ONE_A_AND_C, "equal", {"n": [1, 1], "m": [1, 1], "p": [1, 1], "entries": [0, 1]}),
        (CHOICE, "equal", {"n": [1, 1], "m": [1, 1], "p": [1, 1], "entries": [0, 1]}),
        (RECORD, "exciting(1)", {"n": [1, 1], "N": [1, 2], "entries": [0, 1]}),
    ],
)
def test_processes_find_the_same_case(about: str, text: str, box: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    one = fs.claim(text, about=about, box=box, ablation=False).answers[0]
    monkeypatch.setattr(kept, "WORTH_SHARING", 10)
    two = fs.claim(text, about=about, box=box, ablation=False, jobs=2).answers[0]
    assert one.counterexample is not None and two.counterexample is not None and one.counterexample.case == two.counterexample.case


@pytest.mark.parametrize("about", list(BOXES))
def test_boxes_too_large_for_a_table_are_left_out_and_say_so(about: str) -> None:
    box = {"n": [5, 5], "m": [1, 1], "p": [1, 1], "total": 8}
    found = fs.claim("True", about=about, box=box, ablation=False).answers[0]
    assert found.tried.systems == 0 and not found.tried.exhausted


def test_seconds_that_fit_no_table_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    from faultspace.proofs.boxes import pair_box

    monkeypatch.setattr(pair_box, "LARGEST_TABLE", 20)
    found = fs.claim("True", about=PAIR, box={"n": [1, 1], "m": [1, 1], "p": [1, 1]}, ablation=False).answers[0]
    assert found.tried.systems == 0 and not found.tried.exhausted
