"""Bad input is refused with InvalidInput: one line that begins with the place.

BAD_SYSTEMS     what is wrong -> (changes to a good system, how the message begins)
BAD_CALLS       what is wrong -> (a call, how the message begins)
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st
from sympy.polys.matrices import DomainMatrix

from faultspace.base.errors import InvalidInput, shorten
from faultspace.exact.algebra.fields import QQ, NumberField, PrimeField, field_from_json
from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.algebra.validation import MAX_BITS, MAX_DIMENSION, parse_rational
from faultspace.exact.system.systems import FaultySystem, ResidualSystem, from_float_exactly, read_system

Json = Any
GOOD: Json = {"A": [["0"]], "F": [["1"]], "C": [["1"], ["0"]], "G": [["0"], ["1"]]}
INPUTS: Json = {"B": [["1"]], "D": [["0"], ["0"]]}
ABSENT = object()
SQRT_TWO = NumberField((Fraction(-2), Fraction(0), Fraction(1)))
SQRT_THREE = sympy.QQ.algebraic_field(sympy.sqrt(3))

BAD_SYSTEMS: dict[str, tuple[Json, str]] = {
    "ragged rows": ({"C": [["1"], ["0", "1"]]}, "system.C[1]: got 2 entries, expected 1 as in the first row"),
    "A not square": ({"A": [["1", "2"]]}, "system.A: got shape 1 x 2, expected 1 x 1"),
    "F too tall": ({"F": [["1"], ["2"]]}, "system.F: got shape 2 x 1, expected 1 x 1"),
    "C too wide": ({"C": [["1", "0"], ["0", "0"]]}, "system.C: got shape 2 x 2, expected 2 x 1"),
    "G too wide": ({"G": [["0", "0"], ["1", "1"]]}, "system.G: got shape 2 x 2, expected 2 x 1"),
    "G too short": ({"G": [["0"]]}, "system.G: got shape 1 x 1, expected 2 x 1"),
    "n that does not agree": ({"n": 2}, "system.A: got shape 1 x 1, expected 2 x 2"),
    "m that does not agree": ({"m": 3}, "system.F: got shape 1 x 1, expected 1 x 3"),
    "p that does not agree": ({"p": 1}, "system.C: got shape 2 x 1, expected 1 x 1"),
    "negative n": ({"n": -1}, "system.n: got -1, expected an integer >= 0"),
    "n as a string": ({"n": "1"}, "system.n: got '1', expected an integer >= 0"),
    "n as a float": ({"n": 1.0}, "system.n: got 1.0, expected an integer >= 0"),
    "n as a truth value": ({"n": True}, "system.n: got True, expected an integer >= 0"),
    "n explicitly nothing": ({"n": None}, "system.n: got None, expected an integer >= 0"),
    "a float": ({"A": [[0.5]]}, "system.A[0][0]: got 0.5, expected a rational string"),
    "a truth value": ({"A": [[True]]}, "system.A[0][0]: got True, expected a rational string"),
    "null": ({"A": [[None]]}, "system.A[0][0]: got None, expected a rational string"),
    "a decimal": ({"G": [["0"], ["0.5"]]}, "system.G[1][0]: got '0.5', expected a rational string"),
    "an exponent": ({"A": [["1e3"]]}, "system.A[0][0]: got '1e3', expected a rational string"),
    "a plus sign": ({"A": [["+1"]]}, "system.A[0][0]: got '+1', expected a rational string"),
    "white space": ({"A": [[" 1"]]}, "system.A[0][0]: got ' 1', expected a rational string"),
    "a newline": ({"A": [["1\n"]]}, "system.A[0][0]: got '1\\n', expected a rational string"),
    "other digits": ({"A": [["\u0661"]]}, "system.A[0][0]: got '\u0661', expected a rational string"),
    "a zero denominator": ({"A": [["1/0"]]}, "system.A[0][0]: got '1/0', expected a rational string"),
    "a negative denominator": ({"A": [["1/-2"]]}, "system.A[0][0]: got '1/-2', expected a rational string"),
    "a row that is a string": ({"A": ["1"]}, "system.A: got ['1'], expected a list of rows"),
    "a row that is a number": ({"A": [0]}, "system.A: got [0], expected a list of rows"),
    "a matrix that is a string": ({"A": "1"}, "system.A: got '1', expected a list of rows"),
    "a matrix that is nothing": ({"G": None}, "system.G: got None, expected a list of rows"),
    "no G": ({"G": ABSENT}, 'system: key "G" is missing'),
    "an unknown key": ({"H": [["1"]]}, "system: unknown key 'H', expected A, F, C, G, B, D"),
    "B without D": ({"B": [["1"]]}, "system: got only one of B and D, expected both or neither"),
    "D without B": ({"D": [["1"]]}, "system: got only one of B and D, expected both or neither"),
    "nu without B": ({"nu": 1}, "system: got nu without B and D, expected all three or none"),
    "B too tall": ({**INPUTS, "B": [["1"], ["1"]]}, "system.B: got shape 2 x 1, expected 1 x 1"),
    "D too wide": ({**INPUTS, "D": [["1", "1"], ["1", "1"]]}, "system.D: got shape 2 x 2, expected 2 x 1"),
    "nu that does not agree": ({**INPUTS, "nu": 2}, "system.B: got shape 1 x 1, expected 1 x 2"),
    "nu explicitly nothing": ({**INPUTS, "nu": None}, "system.nu: got None, expected an integer >= 0"),
    "a composite prime": ({"field": {"prime": 4}}, "field.prime: got 4, expected a prime below 2^64"),
    "one as a prime": ({"field": {"prime": 1}}, "field.prime: got 1, expected a prime below 2^64"),
    "a prime that is too large": ({"field": {"prime": 2**64 + 13}}, "field.prime: got 18446744073709551629, expected a prime"),
    "a prime as a string": ({"field": {"prime": "5"}}, "field.prime: got '5', expected a prime"),
    "a truth value as a prime": ({"field": {"prime": True}}, "field.prime: got True, expected a prime"),
    "a reducible polynomial": (
        {"field": {"minimal_polynomial": ["-1", "0", "1"]}},
        "field.minimal_polynomial: a^2",
    ),
    "a square": ({"field": {"minimal_polynomial": ["4", "0", "-4", "0", "1"]}}, "field.minimal_polynomial: a^4"),
    "a constant polynomial": ({"field": {"minimal_polynomial": ["1"]}}, "field.minimal_polynomial: got degree 0"),
    "no polynomial": ({"field": {"minimal_polynomial": []}}, "field.minimal_polynomial: got degree -1"),
    "degree 17": ({"field": {"minimal_polynomial": ["-2", *["0"] * 16, "1"]}}, "field.minimal_polynomial: got degree 17"),
    "a leading zero": ({"field": {"minimal_polynomial": ["1", "1", "0"]}}, "field.minimal_polynomial: the leading coefficient is 0"),
    "a polynomial in floats": ({"field": {"minimal_polynomial": ["-2", 0.0, "1"]}}, "field.minimal_polynomial: got 0.0"),
    "a field of another name": ({"field": "R"}, 'field: got \'R\', expected "Q", {"minimal_polynomial": [...]} or {"prime": p}'),
    "a field with two names": ({"field": {"prime": 2, "minimal_polynomial": ["1", "1"]}}, "field: got {'prime': 2"),
    "no field": ({"field": None}, "field: got None"),
    "a fraction over GF(p)": (
        {"field": {"prime": 3}, "A": [["1/2"]]},
        "system.A[0][0]: got '1/2', expected an integer (the field is GF(3))",
    ),
    "a fraction over GF(p) that cancels": (
        {"field": {"prime": 3}, "A": [["4/2"]]},
        "system.A[0][0]: got '4/2', expected an integer (the field is GF(3))",
    ),
    "coordinates over Q": ({"A": [[["1", "2"]]]}, "system.A[0][0]: got ['1', '2'], expected a rational string"),
    "too few coordinates": (
        {"field": {"minimal_polynomial": ["-2", "0", "1"]}, "A": [[["1"]]]},
        "system.A[0][0]: got a list of 1 coordinates, expected 2",
    ),
    "a float coordinate": (
        {"field": {"minimal_polynomial": ["-2", "0", "1"]}, "A": [[["1", 0.5]]]},
        "system.A[0][0]: got 0.5, expected a rational string",
    ),
    "no faults and no dimensions": ({"F": [[]], "G": [[], []]}, "system.F: is empty; with a zero dimension n, m, p are required, got no n"),
    "no faults and no m": (
        {"F": [[]], "G": [[], []], "n": 1, "p": 2},
        "system.F: is empty; with a zero dimension n, m, p are required, got no m",
    ),
    "no faults, inputs, no dimensions": ({**INPUTS, "F": [[]], "G": [[], []], "nu": 1}, "system.F: is empty; with a zero dimension"),
    "no inputs and no nu": ({"B": [[]], "D": [[], []]}, "system.B: is empty; with a zero dimension"),
    "nothing at all": ({"A": [], "F": [], "C": [], "G": []}, "system.A: is empty; with a zero dimension"),
    "one row too many for zero rows": (
        {"A": [[]], "F": [], "C": [], "G": [], "n": 0, "m": 0, "p": 0},
        "system.A: got shape 1 x 0, expected 0 x 0",
    ),
    "too many dimensions": (
        {"A": [], "F": [], "C": [], "G": [], "n": 0, "m": 0, "p": MAX_DIMENSION + 1},
        "system.n + m + p: got 513, at most 512 is supported",
    ),
    "enormous dimensions": (
        {"A": [], "F": [], "C": [], "G": [], "n": 0, "m": 10**30, "p": 0},
        "system.n + m + p: got 1000000000000000000000000000000, at most 512",
    ),
    "an entry of too many digits": ({"A": [["9" * 50000]]}, "system.A[0][0]: got 50000 characters, a numerator or"),
    "an entry of too many bits": ({"A": [[2**MAX_BITS]]}, f"system.A[0][0]: got an integer of {MAX_BITS + 1} bits, at most {MAX_BITS}"),
    "a numerator of too many bits": ({"A": [["9" * 19729]]}, "system.A[0][0]: a numerator or denominator has more"),
}

BAD_CALLS: dict[str, tuple[Callable[[], Any], str]] = {
    "a float": (lambda: Matrix.of([[1, 0.5]]), "matrix[0][1]: got 0.5, expected a rational string"),
    "floats have a door": (lambda: Matrix.of([[1.0]]), 'matrix[0][0]: got 1.0, expected a rational string such as "-3/4" (floats are not'),
    "a numpy array": (lambda: Matrix.of(np.eye(2), where="A"), "A: got array([[1., 0.], [0., 1.]]), expected a list of rows"),
    "a numpy float": (lambda: Matrix.of([[np.float64(1)]]), "matrix[0][0]: got np.float64(1.0), expected a rational string"),
    "a sympy float": (lambda: Matrix.of(sympy.Matrix([[0.5]])), "matrix[0][0]: got 0.5"),
    "a symbol": (lambda: Matrix.of(sympy.Matrix([[sympy.Symbol("x")]])), "matrix[0][0]: got x, expected a rational string"),
    "a root over Q": (lambda: Matrix.of([[sympy.sqrt(2)]]), "matrix[0][0]: got sqrt(2), expected a rational string"),
    "sympy infinity": (lambda: Matrix.of([[sympy.oo]]), "matrix[0][0]: got oo, expected a rational string"),
    "a matrix of another shape": (lambda: Matrix.of(Matrix.of([[1]]), shape=(2, 1)), "matrix: got shape 1 x 1, expected 2 x 1"),
    "a negative dimension": (lambda: ResidualSystem.of([], [], [], [], n=-1, m=0, p=0), "n: got -1, expected an integer >= 0"),
    "a shape that differs": (lambda: Matrix.of([[1, 2]], shape=(2, 1)), "matrix: got shape 1 x 2, expected 2 x 1"),
    "a matrix over another field": (lambda: Matrix.of(Matrix.of([[1]]), PrimeField(2)), "matrix: got entries over Q, expected GF(2)"),
    "an empty sympy matrix of another shape": (
        lambda: Matrix.of(sympy.zeros(0, 3), shape=(0, 2)),
        "matrix: got shape 0 x 3, expected 0 x 2",
    ),
    "a DomainMatrix over another QQ<a>": (
        lambda: Matrix.of(DomainMatrix([[SQRT_THREE([1, 0])]], (1, 1), SQRT_THREE), SQRT_TWO),
        "matrix",
    ),
    "A over another field than C": (
        lambda: ResidualSystem(Matrix.zero(QQ, 1, 1), Matrix.zero(QQ, 1, 1), Matrix.zero(PrimeField(2), 1, 1), Matrix.zero(QQ, 1, 1)),
        "C: got entries over GF(2), expected Q as for A",
    ),
    "A not square": (
        lambda: ResidualSystem(Matrix.zero(QQ, 1, 2), Matrix.zero(QQ, 1, 1), Matrix.zero(QQ, 1, 1), Matrix.zero(QQ, 1, 1)),
        "A: got shape 1 x 2, expected 1 x 1",
    ),
    "too many dimensions": (
        lambda: ResidualSystem(*(Matrix.zero(QQ, *shape) for shape in ((0, 0), (0, 513), (0, 0), (0, 513)))),
        "n + m + p: got 513, at most 512 is supported",
    ),
    "a dimension that nothing shows": (
        lambda: ResidualSystem.of([], [], [], []),
        "n: every matrix that shows this dimension is empty; say n=...",
    ),
    "B of another height": (
        lambda: FaultySystem(ResidualSystem.of([[0]], [[1]], [[1]], [[0]]), Matrix.zero(QQ, 2, 1), Matrix.zero(QQ, 1, 1)),
        "B: got shape 2 x 1, expected 1 x 1",
    ),
    "not a dict": (lambda: read_system([GOOD]), "system: got [{'A'"),
    "another name for the place": (lambda: read_system({}, where="first"), 'first: key "A" is missing'),
    "NaN": (lambda: from_float_exactly(float("nan")), "entry: got nan, expected a finite float"),
    "infinity": (lambda: from_float_exactly(float("-inf"), where="x"), "x: got -inf, expected a finite float"),
    "a string as a float": (lambda: from_float_exactly("1.5"), "entry: got '1.5', expected a finite float"),  # type: ignore[arg-type]
    "a truth value as a float": (lambda: from_float_exactly(True), "entry: got True, expected a finite float"),
    "a residue of another prime": (lambda: PrimeField(3).element(PrimeField(5).element(1)), "entry: got an element of GF(5), expected"),
    "an element of another number field": (
        lambda: NumberField((Fraction(-3), Fraction(0), Fraction(1))).element(SQRT_TWO.element([0, 1])),
        "entry: got AlgebraicNumber(",
    ),
}


def one_line(problem: InvalidInput) -> str:
    """The result is the message, which must be one line."""
    text = str(problem)
    assert text and "\n" not in text and text == text.strip()
    return text


def test_the_system_that_is_spoiled_is_good() -> None:
    assert read_system(GOOD).to_json() == GOOD
    faulty = read_system({**GOOD, **INPUTS, "nu": 1, "n": 1, "m": 1, "p": 2, "field": "Q"})
    assert isinstance(faulty, FaultySystem) and faulty.to_json() == {**GOOD, **INPUTS}


@pytest.mark.parametrize("name", list(BAD_SYSTEMS))
def test_bad_systems(name: str) -> None:
    changes, beginning = BAD_SYSTEMS[name]
    spoiled = {key: value for key, value in {**GOOD, **changes}.items() if value is not ABSENT}
    with pytest.raises(InvalidInput) as caught:
        read_system(spoiled)
    assert one_line(caught.value).startswith(beginning)


@pytest.mark.parametrize("name", list(BAD_CALLS))
def test_bad_calls(name: str) -> None:
    call, beginning = BAD_CALLS[name]
    with pytest.raises(InvalidInput) as caught:
        call()
    assert one_line(caught.value).startswith(beginning)
    assert "None over" not in str(caught.value)


def test_invalid_input_is_a_value_error() -> None:
    assert issubclass(InvalidInput, ValueError)


@given(st.integers(), st.integers(min_value=1))
def test_rationals_are_read(top: int, bottom: int) -> None:
    found = parse_rational(f"{top}/{bottom}", "x")
    assert Fraction(int(found.p), int(found.q)) == Fraction(top, bottom)
    assert parse_rational(str(top), "x") == parse_rational(top, "x") == top


@given(st.text(alphabet="0123456789/-+. eE_", max_size=8))
def test_whatever_is_no_rational_is_refused(text: str) -> None:
    """The grammar is written again, by hand: an optional minus, digits, and perhaps a slash and digits that do not begin with 0."""
    top, slash, bottom = text.partition("/")
    digits = top.removeprefix("-")
    good = digits.isdecimal() and (not slash or (bottom.isdecimal() and bottom[0] != "0"))
    if good:
        assert parse_rational(text, "x") == parse_rational(top, "x") / parse_rational(bottom or "1", "x")
    else:
        with pytest.raises(InvalidInput, match=r"^x: "):
            parse_rational(text, "x")


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=4) | st.sampled_from(["1", "1/2"]),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(["A", "n", "prime", "x"]), inner, max_size=2),
    max_leaves=6,
)


@given(
    st.dictionaries(
        st.sampled_from(["A", "F", "C", "G", "B", "D", "n", "m", "p", "nu", "field"]),
        json_values,
        max_size=2,
    )
)
def test_no_value_brings_it_down(changes: Json) -> None:
    """Any JSON value in any place gives a system or one line, never another exception."""
    try:
        read_system({**GOOD, **changes})
    except InvalidInput as problem:
        one_line(problem)


@given(json_values)
def test_no_field_brings_it_down(value: Json) -> None:
    for candidate in (value, {"prime": value}, {"minimal_polynomial": value}):
        try:
            field_from_json(candidate)
        except InvalidInput as problem:
            assert one_line(problem).startswith("field")


def test_what_is_shown_is_short() -> None:
    assert shorten("x" * 1000) == "'" + "x" * 56 + "..."
    assert shorten("a\nb") == "'a\\nb'" and shorten([1, 2]) == "[1, 2]"
    assert shorten(10**25000) == "a int too large to print"
    nested: list[Any] = []
    for _ in range(100000):
        nested = [nested]
    assert shorten(nested) == "a list too large to print"
