"""These tests are about pairs with zeros where they are wanted, and pairs that need no initial state."""

from __future__ import annotations

from itertools import product
from typing import Any

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from faultspace.base.errors import InvalidInput
from faultspace.exact.algebra.fields import QQ
from faultspace.exact.pairs.assignment import assign_zeros, recoverable_pair
from faultspace.exact.pairs.polynomial import judge
from faultspace.exact.structure.inversion import ambiguous_word
from faultspace.exact.structure.record import analyze
from tests.exact import pair_checks
from tests.exact.test_broken_on_purpose import Broken, noticed
from tests.exact.test_exceptional import chains
from tests.oracle.families import CUBIC, FIELDS, adversarial, paper_example
from tests.oracle.strategies import SEEDS, systems
from tests.thorough import examples, sampled

Json = Any
Q = adversarial("Q")


@pytest.mark.parametrize("field", list(FIELDS.values()), ids=list(FIELDS))
def test_named_systems(field: Json) -> None:
    for number, system in enumerate([*adversarial(field).values(), *([paper_example()] if field == CUBIC else [])]):
        pair_checks.check_assignment(system, number)


@settings(max_examples=examples(40))
@given(systems(), SEEDS)
def test_any_system(given: Json, seed: int) -> None:
    pair_checks.check_assignment(given, seed)


@settings(max_examples=examples(20))
@given(st.lists(st.integers(0, 2), min_size=1, max_size=3).map(sorted), SEEDS)
def test_several_faults_of_several_degrees(lengths: list[int], seed: int) -> None:
    pair_checks.check_assignment(chains(*lengths), seed)


def test_every_polynomial_over_two_elements() -> None:
    """Every polynomial of degree at most zeta, for all systems with n <= 2, p = 1, m <= 2, is reached iff the fixed zeros divide it."""
    reached = refused = 0
    seen = set()
    for dimensions in ((1, 1, 1), (2, 1, 1), (1, 1, 2)):
        for system in pair_checks.small_systems(*dimensions):
            found = pair_checks.pencil_of(system)
            key = (found.system.A, found.system.C, found.space.basis, found.columns)
            if key in seen:
                continue
            seen.add(key)
            good = {judge(found, P).polynomial for P in pair_checks.all_matrices(found.system.field, found.n_z, found.columns)}
            for bits in product((0, 1), repeat=found.zeta + 1):
                if not any(bits):
                    continue
                desired = tuple(found.system.field.element(b) for b in bits[: max(i for i, b in enumerate(bits) if b) + 1])
                try:
                    result = assign_zeros(found, list(desired))
                except InvalidInput:
                    refused += 1
                    assert desired not in good
                else:
                    reached += 1
                    assert result.verdict.polynomial == desired and desired in good
    assert reached > 100 and refused > 100


def test_the_example_gets_a_zero_at_five() -> None:
    """Its own fault model has one infinite zero; another pair of the same behaviour has the finite zero 5."""
    found = pair_checks.pencil_of(paper_example())
    assert (found.zeta, found.columns) == (1, 1)
    result = assign_zeros(found, ["-5", "1"])
    assert analyze(result.system).invariant_zero_polynomial == tuple(found.system.field.element(c) for c in ("-5", "1"))


def test_sympy_polynomials_are_taken() -> None:
    q, x = sympy.symbols("q x")
    found = pair_checks.pencil_of(chains(1, 2))
    result = assign_zeros(found, (q - 2) * (q**2 + 1))
    assert result.desired == tuple(QQ.element(c) for c in (-2, 1, -2, 1))
    assert assign_zeros(found, sympy.Poly(3 * x - 1, x)).desired == (QQ.element(-1), QQ.element(3))
    assert assign_zeros(found, sympy.Integer(1)).free == (QQ.element(1),)
    assert result.to_json()["desired"] == ["-2", "1", "-2", "1"]


def test_recovery_without_the_initial_state() -> None:
    """A = 2, F = C = G = 1 has the zero 1, and no samples recover v; an equivalent pair has none and they do."""
    found = pair_checks.pencil_of({"A": [[2]], "F": [[1]], "C": [[1]], "G": [[1]], "n": 1, "p": 1, "m": 1, "field": "Q"})
    assert ambiguous_word(found.system, 5, known_state=False) is not None
    recovery = recoverable_pair(found)
    pair = recovery.assignment.system
    assert ambiguous_word(pair, recovery.delay + 1, known_state=False) is None
    assert recovery.to_json()["delay"] == recovery.delay == 1
    assert recovery.left_inverse.shape == (1, 2)


def test_what_cannot_be_had_is_told() -> None:
    found = pair_checks.pencil_of(chains(1, 1))
    with pytest.raises(InvalidInput, match=r"got the zero polynomial"):
        assign_zeros(found, [0, 0])
    with pytest.raises(InvalidInput, match=r"got degree 3, expected at most zeta = 2"):
        assign_zeros(found, [0, 0, 0, 1])
    with pytest.raises(InvalidInput, match=r"expected coefficients by ascending power"):
        assign_zeros(found, "q^2")
    with pytest.raises(InvalidInput, match=r"a polynomial in 2 symbols"):
        assign_zeros(found, sympy.Symbol("x") * sympy.Symbol("y"))
    with pytest.raises(InvalidInput, match=r"desired\[1\]: got 0\.5"):
        assign_zeros(found, [1, 0.5])
    with pytest.raises(InvalidInput, match=r"got q \+ 1, expected a multiple of q - 1: \(A, C\) is not observable"):
        assign_zeros(pair_checks.pencil_of(Q["unobservable"]), [1, 1])
    with pytest.raises(InvalidInput, match=r"expected a polynomial in one symbol"):
        assign_zeros(found, sympy.sin(sympy.Symbol("x")))


BROKEN: dict[str, Broken] = {
    "the chain has no link": Broken("_realising", "-one", "zero", pair_checks.check_assignment, (chains(1, 1), 3)),
    "the exponents overlap": Broken(
        "_realising",
        "sum(degrees[:j])",
        "sum(degrees[:j]) + 1 if j else 0",
        pair_checks.check_assignment,
        (chains(1, 1), 3),
    ),
    "fixed zeros are not divided out": Broken(
        "assign_zeros",
        "polynomials.divide(polynomial, fixed)",
        "(polynomial, ())",
        pair_checks.check_assignment,
        (Q["unobservable"], 1),
    ),
    "recovery asks for a zero": Broken(
        "recoverable_pair",
        "assign_zeros(pencil, pencil.fixed)",
        "assign_zeros(pencil, [0] * pencil.zeta + [1])",
        pair_checks.check_assignment,
        (chains(1), 1),
    ),
}


@pytest.mark.parametrize("name", sampled(BROKEN, 4))
def test_it_is_noticed(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    noticed(monkeypatch, BROKEN[name], (AssertionError, ArithmeticError, ValueError, IndexError))
