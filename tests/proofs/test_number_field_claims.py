"""Claims over a number field Q(a): what is read, what lies inside the unit circle at a root, many systems at once against each alone."""

from __future__ import annotations

import cmath
import random
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import faultspace as fs
from faultspace.base.errors import InvalidInput
from faultspace.exact.algebra.embeddings import RealField, inside_the_circle, one_modulus, sign, stable_there
from faultspace.exact.algebra.fields import QQ, NumberField, PrimeField
from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.brought.claiming import explain
from faultspace.proofs.brought.claims import make_claim
from faultspace.proofs.brought.fields import in_a, read_entries, read_field, usual_entries
from faultspace.proofs.evidence.subjects import Subject
from faultspace.proofs.language.by_batches import Table, true_of
from faultspace.proofs.language.evaluating import evaluate, exactly
from faultspace.proofs.language.grammar import read
from faultspace.proofs.quantities.ranks import CHARACTERISTIC, FAMILIES, MINORS, Ranks
from faultspace.proofs.quantities.registry import quantities
from faultspace.proofs.trust.structure_certificates import accept
from tests.oracle.words import by_definition, windows_by_definition
from tests.thorough import examples

ROOT, OTHER, NONE = "Q(a) with a^2 - 2 = 0 and 1 < a < 2", "Q(a) with a^2 - 2 = 0 and -2 < a < -1", "Q(a) with a^2 - 2 = 0"
CUBIC, EISENSTEIN, HALF = "Q(a) with a^3 - a - 1 = 0 and 1 < a < 2", "Q(a) with a^2 + a + 1 = 0", "Q(a) with 2 a^2 - 1 = 0 and 1/2 < a < 1"
VALUE = {ROOT: 2**0.5, OTHER: -(2**0.5), CUBIC: 1.324717957244746, EISENSTEIN: cmath.exp(2j * cmath.pi / 3), HALF: 0.5**0.5}


@pytest.mark.parametrize("text", ["Q", "GF(5)", ROOT, OTHER, NONE, CUBIC, EISENSTEIN, "Q(a) with a^4 - 1/2 a + 3 = 0"])
def test_a_field_is_read_as_it_is_written(text: str) -> None:
    assert str(read_field(text)) == text


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Q(a)", 'expected "Q", "GF(q)", "Q(a) with a^2 - 2 = 0"'),
        ("Q(a) with a^2 - 4 = 0", "reducible"),
        ("Q(a) with a^2 + b = 0", "expected a polynomial in a"),
        ("Q(a) with a^2 2 = 0", "expected a polynomial in a"),
        ("Q(a) with 3 = 0", "got the degree 0"),
        ("Q(a) with a^9 - 2 = 0", "got the degree 9"),
        ("Q(a) with a^2 - 2 = 0 and 2 < a < 3", "got 0 roots of a^2 - 2 = 0 between 2 and 3"),
        ("Q(a) with a^2 - 2 = 0 and -2 < a < 2", "got 2 roots"),
        ("Q(a) with a^2 - 2 = 0 and 2 < a < 1", "got 0 roots"),
        ("Q(a) with a^2 + 1 = 0 and 0 < a < 1", "got 0 roots"),
        ("Q(a) with a - 2 = 0 and 1 < a < 2", "got 0 roots"),
    ],
)
def test_a_field_that_is_none_is_refused_in_words(text: str, words: str) -> None:
    with pytest.raises(InvalidInput, match=r"^fields: ") as error:
        read_field(text)
    assert words in str(error.value)


def test_polynomials_in_a_and_the_entries_of_a_box() -> None:
    told = [list(map(str, in_a(text))) for text in ("a^2 - 1/2a + 1", "- a", "a - a", "2*a")]
    assert told == [["1", "-1/2", "1"], ["0", "-1"], ["0"], ["0", "2"]]
    field = read_field(ROOT)
    assert list(map(str, usual_entries(field))) == ["-a", "-1", "0", "1", "a"]
    assert list(map(str, read_entries(["1 + a", 1, "1", "-1/2 a", "a+1"], field))) == ["-1/2 a", "1", "a + 1"]
    assert list(map(str, usual_entries(read_field("Q(a) with 2 a - 1 = 0")))) == ["-1", "-1/2", "0", "1/2", "1"]
    for bad, words in (
        (["b"], "such as"),
        (["a^2"], "of degree 2"),
        (["a a"], "expected a polynomial"),
        ([0.5], "got 0.5"),
        (["1/0 a"], "a"),
    ):
        with pytest.raises(InvalidInput, match=r"^box.entries: ") as error:
            read_entries(bad, field)
        assert words in str(error.value)
    with pytest.raises(InvalidInput, match=r"^box\.entries: got 'a'"):
        read_entries(["a"], QQ)


def drawn_matrix(field: NumberField, n: int, rng: random.Random) -> list[list[list[str]]]:
    def number() -> list[str]:
        return [str(Fraction(rng.randint(-2, 2), rng.choice([1, 2, 3]))) for _ in range(field.degree)]

    return [[number() for _ in range(n)] for _ in range(n)]


@pytest.mark.parametrize("text", list(VALUE))
def test_stable_at_a_root_is_what_floats_say_away_from_the_circle(text: str) -> None:
    field, rng, seen = read_field(text), random.Random(text), set[bool]()
    assert isinstance(field, NumberField)
    for _ in range(60):
        n = rng.randint(0, 3)
        rows = drawn_matrix(field, n, rng)
        numbers = [[sum(float(Fraction(c)) * VALUE[text] ** k for k, c in enumerate(x)) for x in row] for row in rows]
        radius = max(abs(np.linalg.eigvals(np.array(numbers, dtype=complex).reshape(n, n))), default=0.0)
        if abs(radius - 1) < 1e-6:
            continue
        found = stable_there(Matrix.of(rows, field, shape=(n, n)))
        assert found == (radius < 1), (rows, radius)
        seen.add(found)
    assert seen == {True, False}


def test_signs_roots_and_the_circle_itself() -> None:
    field, other = read_field(ROOT), read_field(OTHER)
    assert isinstance(field, RealField) and isinstance(other, RealField)
    near = field.element(["-665857/470832", 1])  # the root, to twelve digits
    assert sign(near) == -1 and sign(other.element(["665857/470832", 1])) == 1 and sign(field.element(0)) == 0
    assert field != other and field != field.without_root and field.without_root != field and field == read_field(ROOT)
    assert len({field, other, field.without_root, read_field(ROOT)}) == 3
    half = field.element([0, "1/2"])
    assert not inside_the_circle([-half * half * field.element(2), field.element(1)], field)  # q = 1
    assert inside_the_circle([-half, field.element(1)], field) and inside_the_circle([field.element(3)], field)
    with pytest.raises(InvalidInput, match="zero polynomial"):
        inside_the_circle([field.element(0)], field)
    assert [one_modulus(one) for one in (QQ, PrimeField(2), field, field.without_root, read_field(EISENSTEIN))] == [
        True,
        False,
        True,
        False,
        True,
    ]
    with pytest.raises(InvalidInput, match="real root"):
        inside_the_circle([1, 1], field.without_root)


def test_whether_a_system_is_stable_depends_on_the_root() -> None:
    """1 + a lies inside the circle for one root of two, and the claim's counterexample says which."""
    box = {"n": [1, 1], "m": [1, 1], "p": [1, 1], "total": 3, "entries": [0, "1 + a"]}
    at, elsewhere = fs.claim("stable", fields=[OTHER, ROOT], box=box).answers
    assert at.counterexample is not None and not at.counterexample.smallest  # nothing of the box fails
    assert elsewhere.counterexample is not None and elsewhere.counterexample.smallest
    assert str(elsewhere.counterexample.system).endswith(f"over {ROOT}")
    for text in ("stable", "minimum_phase", "strongly_detectable", "schur_stable(A)"):
        with pytest.raises(
            InvalidInput, match=f"reads {text.partition('(')[0]} and {NONE.replace('(', '.').replace(')', '.').replace('^', '.')}"
        ):
            fs.claim(text, fields=[NONE])
        assert (
            fs.claim(f"{text} or not {text}", fields=[EISENSTEIN], box=box | {"entries": [0, "a"]}, ablation=False).answers[0].tried.systems
        )


def systems_of(text: str, sizes: tuple[int, int, int], count: int, entries: list[Any] | None = None) -> tuple[Any, list[int]]:
    given: dict[str, Any] = {"conclusion": "True", "fields": [text]}
    box = make_claim("x", given | {"box": {"n": [0, 3], "m": [0, 2], "p": [0, 2]} | ({"entries": entries} if entries else {})}).boxes[text]
    stretch = next(box.stretches(sizes, reduced=False))
    return stretch.batch, sorted(random.Random(text).sample(range(len(stretch.batch)), min(count, len(stretch.batch))))


@pytest.mark.parametrize(
    ("text", "sizes"), [(ROOT, (2, 1, 1)), (EISENSTEIN, (1, 1, 2)), (CUBIC, (1, 2, 1)), (NONE, (0, 1, 2)), (NONE, (2, 1, 0))]
)
def test_every_quantity_over_a_number_field_is_what_slow_ways_find(text: str, sizes: tuple[int, int, int]) -> None:
    batch, rows = systems_of(text, sizes, examples(15) // 2)
    every = np.array(rows)
    tables = {name: batch.column(name, every) for name in FAMILIES if name not in (CHARACTERISTIC, MINORS)}
    for k, row in enumerate(rows):
        system = batch.system(row)
        subject, ranks = Subject(system), Ranks(*sizes, {name: tuple(map(int, table[k])) for name, table in tables.items()})
        told, windows = by_definition(system.to_json()), windows_by_definition(system.to_json(), sizes[0] + 3)
        for name, one in quantities().items():
            if one.circle:
                continue
            for s in range(len(windows[name])) if one.windowed else [None]:
                given = () if s is None else (s,)
                wanted = told.get(name, one.exact(subject, *given)) if s is None else windows[name][s]  # dim S* is counted over GF(q) alone
                assert one.exact(subject, *given) == one.from_ranks(ranks, *given) == wanted, (name, s, str(system))


TEXTS = [
    "rank(A - I(n)) + nullity(C @ F) == 1",
    "is_zero(C.T @ G.T - zeros(n, m) @ zeros(m, p)) or rank(hstack(F, A @ F)) == 1",
    "nilpotent(A) or is_zero(F @ C)",
    "all(gap(s) == m for s in windows(n)) and rows(vstack(C, C @ A)) == 2 * p",
    "stable or rank_OT(n + 1) > 2",
    "implies(minimum_phase, schur_stable(A - F @ C)) and lag < 2",
    "rank(power(A, 2) + power(A, 0)) <= lag",
]


@pytest.mark.parametrize("expression", TEXTS)
@pytest.mark.parametrize(("text", "entries"), [(ROOT, None), (EISENSTEIN, ["a", "1/2 - a", 0])])
def test_expressions_of_many_systems_are_those_of_each(expression: str, text: str, entries: list[Any] | None) -> None:
    batch, rows = systems_of(text, (2, 1, 1), examples(18), entries)
    node = read(expression)
    wanted = [bool(evaluate(node, exactly(batch.case(i)))) for i in rows]
    assert [bool(x) for x in true_of(node, batch, np.array(rows), Table())] == wanted


def test_a_counterexample_over_a_number_field_is_certified_and_explained() -> None:
    found = fs.claim("rank_OT(2) > n or lag < n", fields=[NONE], box={"n": [1, 1], "m": [1, 1], "p": [1, 1], "total": 3}).answers[0]
    assert found.counterexample is not None and found.counterexample.certificates and not found.counterexample.computed
    for one in found.counterexample.certificates:
        accept(one)
    assert found.to_json()["field"] == NONE and found.to_json()["smallest"]["system"]["field"] == {"minimal_polynomial": ["-2", "0", "1"]}
    system = ResidualSystem.of([[[1, 1]]], [[1]], [[1]], [[0]], field=read_field(NONE))
    told = {
        field: dict((text, value) for _, text, value in explain(make_claim("x", {"conclusion": "stable", "fields": [field]}), system))
        for field in (ROOT, OTHER)
    }
    assert told == {ROOT: {"stable": "False"}, OTHER: {"stable": "True"}}
    ((_, _, value),) = explain(make_claim("x", {"conclusion": "stable"}), system)
    assert value.startswith("no value: got stable over") and "one of its real roots" in value


@pytest.mark.slow
def test_bounds_are_sought_over_a_number_field_too() -> None:
    found = fs.conjecture("lag", by=["n"], field=NONE, box={"n": [1, 1], "m": [1, 1], "p": [1, 1], "total": 3})
    assert "lag <= n" in [one.text for one in found.above] and found.tried.sums > 0 and found.tried.drawn > 0
