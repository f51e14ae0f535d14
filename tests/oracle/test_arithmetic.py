"""The oracle's arithmetic is tested: fields, polynomials, elimination, the reading of systems, the matrices of a window."""

from __future__ import annotations

from fractions import Fraction
from random import Random
from typing import Any

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.thorough import examples

from . import polynomials
from .families import FIELDS, SQRT2, Q, adversarial
from .fields import NotAField, is_irreducible, is_prime, parse_field
from .linear import Matrix, above, beside, column_of, identity, left_null_space, matrix, null_space, rank, rref, solve, unit_vector, zeros
from .strategies import field_descriptions, systems
from .structured import random_element
from .systems import parse_system, trajectory, write_system
from .windows import window_matrix

FEW = settings(max_examples=examples(60), deadline=None)
SEEDS = st.integers(0, 2**32)
REDUCIBLE: Any = {"minimal_polynomial": ["-1", "0", "1"]}


def random_matrix(rng: Random, description: Any) -> Matrix:
    field = parse_field(description)
    height, width, inner = rng.randint(0, 4), rng.randint(0, 4), rng.randint(0, 4)
    # A product through `inner` columns has a rank below full more often than not.
    left = matrix(field, height, inner, [[random_element(rng, field, 0.7) for _ in range(inner)] for _ in range(height)])
    right = matrix(field, inner, width, [[random_element(rng, field, 0.7) for _ in range(width)] for _ in range(inner)])
    return left @ right


@FEW
@given(field_descriptions(), SEEDS)
def test_elements_obey_the_laws_of_a_field(description: Any, seed: int) -> None:
    field, rng = parse_field(description), Random(seed)
    x, y, z = (random_element(rng, field, 0.9) for _ in range(3))
    assert x + y == y + x and (x + y) + z == x + (y + z)
    assert x * y == y * x and (x * y) * z == x * (y * z)
    assert x * (y + z) == x * y + x * z
    assert x - x == field.zero and x + field.zero == x and x * field.one == x and -x + x == field.zero
    assert bool(x) == (x != field.zero)
    if y:
        assert (x / y) * y == x
    else:
        with pytest.raises(ZeroDivisionError):
            x / y
    assert field.parse(field.write(x)) == x


@pytest.mark.parametrize("description", [d for d in FIELDS.values() if d != Q and "minimal_polynomial" in d])
def test_the_generator_is_a_root(description: Any) -> None:
    field = parse_field(description)
    a = field.parse(["0", "1"] + ["0"] * (len(description["minimal_polynomial"]) - 3))
    coefficients = [field.parse(c) for c in description["minimal_polynomial"]]
    assert not polynomials.evaluate(coefficients, a, field.zero)
    assert polynomials.evaluate(coefficients[1:], a, field.zero)
    assert is_irreducible(field)


def test_square_root_of_two() -> None:
    field = parse_field(SQRT2)
    assert field.parse([1, 1]) * field.parse([-1, 1]) == field.one
    assert field.one / field.parse(["0", "1"]) == field.parse(["0", "1/2"])


def test_a_reducible_polynomial_shows_when_a_zero_divisor_is_inverted() -> None:
    field = parse_field(REDUCIBLE)
    assert not is_irreducible(field)
    with pytest.raises(NotAField):
        field.one / field.parse(["1", "1"])


def test_multiples_of_a_minimal_polynomial_name_the_same_field() -> None:
    assert parse_field({"minimal_polynomial": ["-4", 0, "2"]}) == parse_field(SQRT2)
    assert parse_field(None) == parse_field("Q") != parse_field({"prime": 2})


@pytest.mark.parametrize(
    "description",
    [
        "R",
        7,
        {},
        {"prime": 4},
        {"prime": "2"},
        {"prime": True},
        {"prime": 2**64 + 13},
        {"prime": 2, "x": 1},
        {"minimal_polynomial": []},
        {"minimal_polynomial": ["1"]},
        {"minimal_polynomial": ["1", "2", "0"]},
        {"minimal_polynomial": ["1", "0.5"]},
        {"minimal_polynomial": [0] * 17 + [1]},
    ],
)
def test_malformed_fields(description: Any) -> None:
    with pytest.raises(ValueError):
        parse_field(description)


def test_malformed_entries() -> None:
    malformed: list[tuple[Any, list[Any]]] = [
        ("Q", ["", "1/0", "1/-2", " 1", "1.0", "+1", "1/02", 1.0, True, None, ["1"], "\u0661", "1\n"]),
        ({"prime": 3}, ["1/2", ["1"], 0.5, False]),
        (SQRT2, [[], ["1"], ["1", "2", "3"], [True, 0], [["1"], "0"]]),
    ]
    for description, entries in malformed:
        for entry in entries:
            with pytest.raises(ValueError):
                parse_field(description).parse(entry)


def test_primes() -> None:
    sieve = {k for k in range(2, 3000) if all(k % d for d in range(2, int(k**0.5) + 1))}
    assert {k for k in range(3000) if is_prime(k)} == sieve
    assert is_prime(2**61 - 1) and is_prime(2**64 - 59)
    # Carmichael numbers, a strong pseudoprime to the first nine prime bases, and the square of a prime.
    assert not any(is_prime(k) for k in (561, 825265, 3825123056546413051, 4294967291**2))


@FEW
@given(field_descriptions(), SEEDS)
def test_polynomial_division_and_gcd(description: Any, seed: int) -> None:
    field, rng = parse_field(description), Random(seed)
    a, b, c = (polynomials.trimmed([random_element(rng, field, 0.8) for _ in range(rng.randint(0, 4))]) for _ in range(3))
    if b:
        quotient, remainder = polynomials.divide(a, b)
        assert polynomials.add(polynomials.multiply(quotient, b), remainder) == a
        assert polynomials.degree(remainder) < polynomials.degree(b)
    common = polynomials.gcd(polynomials.multiply(a, c), polynomials.multiply(b, c))
    assert common == polynomials.monic(polynomials.multiply(polynomials.gcd(a, b), c))
    x = random_element(rng, field, 0.9)
    product = polynomials.evaluate(polynomials.multiply(a, b), x, field.zero)
    assert product == polynomials.evaluate(a, x, field.zero) * polynomials.evaluate(b, x, field.zero)


@FEW
@given(field_descriptions(), SEEDS)
def test_elimination(description: Any, seed: int) -> None:
    a = random_matrix(Random(seed), description)
    reduced, pivots = rref(a)
    assert len(pivots) == reduced.height == rank(a) == rank(a.T)
    for i, j in enumerate(pivots):
        assert reduced.column(j) == unit_vector(a.field, reduced.height, i)
        assert not any(reduced.rows[i][:j])
    # The rows of both generate the same space.
    assert rank(above(a, reduced)) == rank(a) and rref(reduced)[0] == reduced
    right, left = null_space(a), left_null_space(a)
    assert (a @ right.T).is_zero() and rank(right) == right.height == a.width - rank(a)
    assert (left @ a).is_zero() and rank(left) == left.height == a.height - rank(a)


@FEW
@given(field_descriptions(), SEEDS)
def test_solve(description: Any, seed: int) -> None:
    rng = Random(seed)
    a = random_matrix(rng, description)
    b = matrix(a.field, a.height, 2, [[random_element(rng, a.field, 0.5) for _ in range(2)] for _ in range(a.height)])
    x = solve(a, b)
    if x is None:
        assert rank(beside(a, b)) > rank(a)
    else:
        assert a @ x == b


@pytest.mark.parametrize("height, width", [(0, 0), (0, 3), (3, 0)])
def test_matrices_without_entries(height: int, width: int) -> None:
    field = parse_field("Q")
    a = zeros(field, height, width)
    assert rank(a) == 0 and (a.T.height, a.T.width) == (width, height)
    assert null_space(a) == identity(field, width) and left_null_space(a) == identity(field, height)
    assert a @ zeros(field, width, 2) == zeros(field, height, 2)
    assert beside(a, a) == zeros(field, height, 2 * width) and above(a, a) == zeros(field, 2 * height, width)
    assert solve(a, zeros(field, height, 1)) == zeros(field, width, 1)


def test_matrices_keep_their_shape() -> None:
    with pytest.raises(ValueError):
        matrix(parse_field("Q"), 1, 2, [[Fraction(1)]])


@settings(max_examples=examples(25), deadline=None)
@given(SEEDS)
def test_sympy_finds_the_same_echelon_forms(seed: int) -> None:
    a = random_matrix(Random(seed), "Q")
    theirs, pivots = sympy.Matrix(a.height, a.width, [sympy.Rational(str(x)) for x in a.entries()]).rref()
    reduced, ours = rref(a)
    assert ours == list(pivots)
    assert [str(x) for x in reduced.entries()] == [str(x) for x in list(theirs)[: reduced.height * a.width]]


@FEW
@given(systems())
def test_systems_are_read_as_they_are_written(json: Any) -> None:
    system = parse_system(json)
    assert parse_system(write_system(system)) == system
    assert (system.n, system.p, system.m) == (json["n"], json["p"], json["m"])


ONE = {"A": [["1"]], "F": [["1"]], "C": [["1"]], "G": [["1"]]}
NO_FAULT = {"A": [["1"]], "F": [[]], "C": [["1"]], "G": [[]]}


def test_spellings_of_one_system() -> None:
    spelled = [ONE, {**ONE, "n": 1}, {**ONE, "field": "Q", "B": [[1, 2]], "D": [["3", "4"]], "nu": 2}]
    assert len({parse_system(json) for json in spelled}) == 1
    assert parse_system({**NO_FAULT, "n": 1, "p": 1, "m": 0}) == parse_system({**NO_FAULT, "F": [], "G": [], "n": 1, "p": 1, "m": 0})


@pytest.mark.parametrize(
    "json",
    [
        [],
        {},
        {**ONE, "name": "x"},
        {**ONE, "n": 2},
        {**ONE, "n": True},
        {**ONE, "m": "1"},
        {**ONE, "field": None},
        {**ONE, "B": [["1"]]},
        {**ONE, "B": [[]], "D": [[]]},
        {**ONE, "B": [[]], "D": [[]], "nu": 0},
        {**ONE, "A": [["1", "2"]]},
        {**ONE, "A": [["x"]]},
        {**ONE, "C": [["1"], ["1"]]},
        {**ONE, "G": "1"},
        {**ONE, "A": [], "n": 1, "m": 1, "p": 1},
        NO_FAULT,
        {**NO_FAULT, "m": 0},
        {**NO_FAULT, "n": 1, "p": 1, "m": 1},
        {**NO_FAULT, "F": [[], []], "n": 1, "p": 1, "m": 0},
        {"A": [], "F": [], "C": [], "G": [], "n": 511, "p": 1, "m": 1},
    ],
)
def test_malformed_systems(json: Any) -> None:
    with pytest.raises(ValueError):
        parse_system(json)


@FEW
@given(systems(), st.integers(0, 4))
def test_columns_of_the_window_matrix_are_simulated_responses(json: Any, s: int) -> None:
    """The recursion, run from each unit vector, yields the columns of [O_s T_s]."""
    system = parse_system(json)
    field, size = system.field, system.n + s * system.m
    responses = [zeros(field, s * system.p, 0)]
    for i in range(size):
        unit = identity(field, size).rows[i]
        faults = [unit[system.n + k * system.m : system.n + (k + 1) * system.m] for k in range(s)]
        _, outputs = trajectory(system, unit[: system.n], faults)
        responses.append(column_of(field, [x for r in outputs for x in r.entries()]))
    assert beside(*responses) == window_matrix(system, s)


@pytest.mark.parametrize("description", FIELDS.values(), ids=FIELDS.keys())
def test_every_named_system_is_well_formed_and_none_is_listed_twice(description: Any) -> None:
    parsed = [parse_system(json) for json in adversarial(description).values()]
    distinct = set(parsed)
    # Doubling is zeroing in characteristic two; a shift register and a delay line of one state are also among the A = 0
    # systems.
    assert len(parsed) - len(distinct) <= 2
