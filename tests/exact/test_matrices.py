"""These tests compare exact linear algebra on flint with sympy's, over every field; polynomials likewise.

sympy_domain the domain of sympy that is this field to_domain_matrix a Matrix as a DomainMatrix, entry by entry matrices random matrices
of both, biased to zeros, to low rank and to empty shapes Schur stability is tested against roots known by construction, and against
eigenvalues in floats away from the circle.
"""

from __future__ import annotations

import operator
import re
from fractions import Fraction
from functools import cache
from random import Random
from typing import Any

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy.polys.matrices import DomainMatrix

from faultspace.base.errors import InvalidInput
from faultspace.exact.algebra import polynomials
from faultspace.exact.algebra.fields import QQ, Field, NumberField, PrimeField, field_from_json
from faultspace.exact.algebra.matrices import (
    Matrix,
    beside,
    column_basis,
    left_null_space,
    rank,
    right_null_space,
    row_echelon,
    row_profile,
    solve_left,
    stacked,
)
from faultspace.exact.algebra.stability import is_schur, is_stable, rational_characteristic_polynomial
from faultspace.exact.algebra.writing import sum_of_powers
from faultspace.exact.structure.kernel_rows import KernelRow, annihilates
from faultspace.exact.structure.pencil import characteristic_polynomial
from faultspace.exact.structure.relations import coefficients_of, integer_relations, relations_over_prime_field
from faultspace.exact.system.systems import ResidualSystem
from tests.oracle.families import FIELDS
from tests.oracle.strategies import SEEDS
from tests.thorough import examples

Json = Any
OVER_EACH_FIELD = pytest.mark.parametrize("field", [field_from_json(f) for f in FIELDS.values()], ids=list(FIELDS))
SOME = settings(max_examples=examples(30))


@cache
def sympy_domain(field: Field) -> Any:
    """sympy calls the field QQ, GF(p) or QQ<a>."""
    if isinstance(field, PrimeField):
        return sympy.GF(field.p, symmetric=False)
    if isinstance(field, NumberField):
        x = sympy.Symbol("x")
        polynomial = sum(sympy.Rational(c.numerator, c.denominator) * x**k for k, c in enumerate(field.minimal_polynomial))
        return sympy.QQ.algebraic_field(sympy.CRootOf(polynomial, 0))
    return sympy.QQ


def to_sympy(field: Field, element: Any) -> Any:
    """The result is a field element as an element of the domain."""
    domain = sympy_domain(field)
    if isinstance(field, PrimeField):
        return domain(int(element))
    if isinstance(field, NumberField):
        return domain([sympy.QQ(int(c.p), int(c.q)) for c in reversed(field.coordinates(element))])
    return domain(int(element.p), int(element.q))


def to_domain_matrix(matrix: Matrix) -> Any:
    """The result is the DomainMatrix with the same entries."""
    rows = [[to_sympy(matrix.field, x) for x in row] for row in matrix.elements()]
    return DomainMatrix(rows, matrix.shape, sympy_domain(matrix.field))


def random_element(rng: Random, field: Field) -> Any:
    """The element is zero half of the time."""
    if rng.random() < 0.5:
        return field.element(0)
    if isinstance(field, PrimeField):
        return field.element(rng.randrange(field.p))
    if isinstance(field, NumberField):
        return field.element([f"{rng.randint(-3, 3)}/{rng.randint(1, 3)}" for _ in range(field.degree)])
    return field.element(f"{rng.randint(-5, 5)}/{rng.randint(1, 4)}")


def random_matrix(rng: Random, field: Field, nrows: int, ncols: int) -> Matrix:
    """The matrix is full of zeros, or of low rank."""

    def dense(height: int, width: int) -> Matrix:
        rows = [[random_element(rng, field) for _ in range(width)] for _ in range(height)]
        return Matrix.from_elements(field, height, width, rows)

    if rng.random() < 0.5:
        return dense(nrows, ncols)
    middle = rng.randint(0, max(min(nrows, ncols) - 1, 0))
    return dense(nrows, middle) @ dense(middle, ncols)


@st.composite
def matrices(draw: st.DrawFn, field: Field, square: bool = False) -> Matrix:
    """The matrices have 0 to 4 rows and columns."""
    nrows = draw(st.integers(0, 4))
    ncols = nrows if square else draw(st.integers(0, 4))
    return random_matrix(Random(draw(SEEDS)), field, nrows, ncols)


@OVER_EACH_FIELD
@SOME
@given(data=st.data())
def test_rank_and_echelon_form(field: Field, data: st.DataObject) -> None:
    matrix = data.draw(matrices(field))
    known = to_domain_matrix(matrix)
    reduced, pivots = known.rref()
    found = row_echelon(matrix)
    assert rank(matrix) == len(pivots)
    assert found.pivots == tuple(pivots)
    assert found.matrix.shape == (len(pivots), matrix.ncols)
    assert to_domain_matrix(found.matrix).to_list() == reduced.to_list()[: len(pivots)]
    _, row_pivots = known.transpose().rref()
    assert row_profile(matrix) == tuple(row_pivots)
    assert column_basis(matrix).transposed() == row_echelon(matrix.transposed()).matrix


@OVER_EACH_FIELD
@SOME
@given(data=st.data())
def test_null_spaces(field: Field, data: st.DataObject) -> None:
    matrix = data.draw(matrices(field))
    found = right_null_space(matrix)
    assert found.shape == (matrix.ncols, matrix.ncols - rank(matrix))
    assert (matrix @ found).is_zero() and rank(found) == found.ncols
    known = to_domain_matrix(matrix).nullspace()
    assert known.shape[0] == found.ncols
    if found.ncols and matrix.nrows:
        reduced, _ = known.rref()
        assert to_domain_matrix(row_echelon(found.transposed()).matrix).to_list() == reduced.to_list()
    assert left_null_space(matrix) == right_null_space(matrix.transposed()).transposed()


@OVER_EACH_FIELD
@SOME
@given(data=st.data())
def test_arithmetic(field: Field, data: st.DataObject) -> None:
    rng = Random(data.draw(SEEDS))
    height, middle, width = (rng.randint(0, 3) for _ in range(3))
    a, b, c = (random_matrix(rng, field, *shape) for shape in ((height, middle), (height, middle), (middle, width)))
    one, two, three = map(to_domain_matrix, (a, b, c))
    assert to_domain_matrix(a + b) == one + two
    assert to_domain_matrix(a - b) == one - two
    assert to_domain_matrix(-a) == -one
    if middle:
        assert to_domain_matrix(a @ c) == one * three
    else:
        assert (a @ c) == Matrix.zero(field, height, width)
    assert to_domain_matrix(a.transposed()) == one.transpose()
    assert a.transposed().transposed() == a
    assert (a @ Matrix.identity(field, middle)) == a
    assert a.is_zero() == all(x == 0 for row in a.elements() for x in row)
    assert [[a[i, j] for j in range(middle)] for i in range(height)] == a.elements()
    assert beside(a, b).shape == (height, 2 * middle) and stacked(a, b).shape == (2 * height, middle)
    assert beside(a, b).transposed() == stacked(a.transposed(), b.transposed())
    assert beside(a, b).columns(range(middle, 2 * middle)) == b and stacked(a, b).rows(range(height)) == a
    chosen = [rng.randrange(middle) for _ in range(3)] if middle else []
    assert a.columns(chosen).elements() == [[row[j] for j in chosen] for row in a.elements()]
    assert a.columns(chosen) == a.transposed().rows(chosen).transposed()
    assert Matrix.of(a.to_json(), field, shape=a.shape) == a


@OVER_EACH_FIELD
@SOME
@given(data=st.data())
def test_solving_from_the_left(field: Field, data: st.DataObject) -> None:
    """There is a solution where the right side is in the row space, None exactly where the rank grows."""
    rng = Random(data.draw(SEEDS))
    matrix = data.draw(matrices(field))
    known = random_matrix(rng, field, 2, matrix.nrows) @ matrix
    solution = solve_left(matrix, known)
    assert solution is not None and solution @ matrix == known
    unknown = random_matrix(rng, field, 2, matrix.ncols)
    solution = solve_left(matrix, unknown)
    assert (solution is None) == (rank(stacked(matrix, unknown)) > rank(matrix))
    assert solution is None or solution @ matrix == unknown


@OVER_EACH_FIELD
@SOME
@given(data=st.data())
def test_characteristic_polynomials(field: Field, data: st.DataObject) -> None:
    matrix = data.draw(matrices(field, square=True))
    found = characteristic_polynomial(matrix)
    assert [to_sympy(field, c) for c in reversed(found)] == to_domain_matrix(matrix).charpoly()


@OVER_EACH_FIELD
@SOME
@given(data=st.data())
def test_elements(field: Field, data: st.DataObject) -> None:
    rng = Random(data.draw(SEEDS))
    x, y, z = (random_element(rng, field) for _ in range(3))
    one, two = to_sympy(field, x), to_sympy(field, y)
    for found, wanted in ((x + y, one + two), (x - y, one - two), (x * y, one * two), (-x, -one)):
        assert to_sympy(field, found) == wanted
    assert (x + y) * z == x * z + y * z
    if y == 0:
        with pytest.raises(ZeroDivisionError):
            x / y
    else:
        assert to_sympy(field, x / y) == one / two and x / y * y == x
    assert field.element(field.write(x)) == x
    assert Matrix.from_elements(field, 1, 1, [[x]])[0, 0] == x
    assert field.from_coordinates(field.block(x)[0]) == x
    # the blocks are a ring homomorphism
    product = Matrix.from_elements(field, 1, 1, [[x]]) @ Matrix.from_elements(field, 1, 1, [[y]])
    assert product.flint.tolist() == field.block(x * y)


@OVER_EACH_FIELD
@SOME
@given(data=st.data())
def test_polynomials(field: Field, data: st.DataObject) -> None:
    """They agree with sympy's dense polynomials, and identities hold where both sides are ours."""
    from sympy.polys.densearith import dup_add, dup_div, dup_mul
    from sympy.polys.euclidtools import dup_gcd

    rng = Random(data.draw(SEEDS))
    f, g = (polynomials.trimmed(random_element(rng, field) for _ in range(rng.randint(0, 5))) for _ in range(2))
    domain = sympy_domain(field)

    def dense(h: polynomials.Poly) -> list[Any]:
        return [to_sympy(field, c) for c in reversed(h)]

    assert dense(polynomials.add(f, g)) == dup_add(dense(f), dense(g), domain)
    assert dense(polynomials.multiply(f, g)) == dup_mul(dense(f), dense(g), domain)
    assert dense(polynomials.gcd(f, g)) == dup_gcd(dense(f), dense(g), domain)
    assert polynomials.add(polynomials.add(f, g), polynomials.negative(g)) == f
    if g:
        quotient, remainder = polynomials.divide(f, g)
        assert (dense(quotient), dense(remainder)) == dup_div(dense(f), dense(g), domain)
    else:
        with pytest.raises(ZeroDivisionError):
            polynomials.divide(f, g)
    point = random_element(rng, field)
    assert evaluate(polynomials.multiply(f, g), point) == evaluate(f, point) * evaluate(g, point)
    assert field_written_back(field, f) == f


def evaluate(f: polynomials.Poly, point: Any) -> Any:
    """The result is f(point), by Horner's rule."""
    value: Any = point * 0
    for coefficient in reversed(f):
        value = value * point + coefficient
    return value


def field_written_back(field: Field, f: polynomials.Poly) -> polynomials.Poly:
    """The field is written as files hold it, and read again."""
    return tuple(field.element(c) for c in polynomials.written(f, field))


@SOME
@given(st.lists(st.sampled_from(["0", "1", "-1", "3/2", "-7", "a", "-a", "a - 1", "-a + 2"]), max_size=5))
def test_polynomials_in_print(coefficients: list[str]) -> None:
    """sympy reads back what is printed for people."""
    text = sum_of_powers(coefficients, "q")
    read = sympy.sympify(re.sub(r"(?<=[\da)]) (?=q)", " * ", text), convert_xor=True)
    wanted = sum(sympy.sympify(c) * sympy.Symbol("q") ** k for k, c in enumerate(coefficients))
    assert sympy.expand(read - wanted) == 0
    assert text and text == text.strip()


@SOME
@given(st.lists(st.fractions(max_denominator=9), max_size=6), st.integers(0, 3))
def test_interpolation(values: list[Any], more: int) -> None:
    f = polynomials.trimmed(QQ.element(c) for c in values)
    points = [QQ.element(k) for k in range(len(values) + more)]
    assert polynomials.interpolate(points, [evaluate(f, x) for x in points]) == f


def test_smith_diagonal_of_a_full_matrix() -> None:
    """det of the matrix up to a unit: [[q, 1], [q^2, q + 1]] has determinant q."""
    one, zero = QQ.element(1), QQ.element(0)
    q = (zero, one)
    form = polynomials.smith_diagonal([[q, (one,)], [(zero, zero, one), (one, one)]], 2, 2, one)
    product = polynomials.multiply(*form.diagonal)
    assert polynomials.monic(product) == q


OTHERS: list[Field] = [QQ, PrimeField(3), PrimeField(5), *(field_from_json(FIELDS[k]) for k in ("Q(sqrt 2)", "Q(cubic)"))]
OTHERS.append(NumberField((Fraction(-3), Fraction(0), Fraction(1))))


@pytest.mark.parametrize("one, two", [(a, b) for a in OTHERS for b in OTHERS if a != b], ids=str)
def test_fields_do_not_mix(one: Field, two: Field) -> None:
    """Blocks over two number fields of the same degree would fit each other, and mean nothing."""
    first, second = Matrix.identity(one, 2), Matrix.identity(two, 2)
    for operation in (operator.matmul, operator.add, operator.sub):
        with pytest.raises(ValueError, match=r"do not mix"):
            operation(first, second)


def test_a_lead_too_early_has_no_relation() -> None:
    """The shape comes from the recursion; a wrong one is an error over a prime field, and no answer over Q."""
    for field in (QQ, PrimeField(3)):
        system = ResidualSystem.of([[0]], [[1]], [[1]], [[0]], field=field)
        if isinstance(field, PrimeField):
            with pytest.raises(ArithmeticError, match="disagree"):
                relations_over_prime_field(system, [(1, 0)])
        else:
            found = integer_relations(system, [(1, 0)], 101)
            assert found is not None and not annihilates(KernelRow(0, coefficients_of(found[0], system)), system)


rationals = st.fractions(-2, 2, max_denominator=6)


def product(*factors: list[Fraction]) -> list[Fraction]:
    result = [Fraction(1)]
    for factor in factors:
        result = [
            sum((result[i] * factor[k - i] for i in range(len(result)) if 0 <= k - i < len(factor)), Fraction(0))
            for k in range(len(result) + len(factor) - 1)
        ]
    return result


@given(st.lists(rationals, max_size=4), st.lists(st.tuples(rationals, rationals), max_size=2))
def test_roots_by_construction(real: list[Fraction], complex_pairs: list[tuple[Fraction, Fraction]]) -> None:
    """The factors (q - a) and ((q - a)^2 + b^2) have moduli |a| and sqrt(a^2 + b^2), those on the circle included."""
    factors = [[-a, Fraction(1)] for a in real] + [[a * a + b * b, -2 * a, Fraction(1)] for a, b in complex_pairs]
    inside = all(abs(a) < 1 for a in real) and all(a * a + b * b < 1 for a, b in complex_pairs)
    assert is_schur(product([Fraction(-3)], *factors)) == inside


@given(st.integers(0, 4).flatmap(lambda n: st.lists(st.lists(rationals, min_size=n, max_size=n), min_size=n, max_size=n)))
def test_matrices_against_eigenvalues(rows: list[list[Fraction]]) -> None:
    n = len(rows)
    moduli = np.abs(np.linalg.eigvals(np.array(rows, dtype=float))) if n else np.zeros(0)
    if n and np.min(np.abs(moduli - 1)) < 1e-6:
        return
    assert is_stable(Matrix.of(rows, shape=(n, n))) == bool((moduli < 1).all())


def test_on_the_circle_is_not_stable() -> None:
    for rows in ([[1]], [[-1]], [[0, -1], [1, 0]], [["3/5", "-4/5"], ["4/5", "3/5"]]):
        assert not is_stable(Matrix.of(rows))
    assert is_stable(Matrix.of([["999999999999/1000000000000"]]))


def test_a_number_field_is_judged_in_every_embedding() -> None:
    sqrt2 = NumberField(("-2", "0", "1"))  # type: ignore[arg-type]
    assert is_stable(Matrix.of([[["0", "1/2"]]], sqrt2))
    assert not is_stable(Matrix.of([[["0", "1"]]], sqrt2))
    # 1 - sqrt 2 lies inside, its conjugate 1 + sqrt 2 does not
    assert not is_stable(Matrix.of([[["1", "-1"]]], sqrt2))


def test_characteristic_polynomial() -> None:
    assert [int(c) for c in rational_characteristic_polynomial(Matrix.of([[0, 1], [-6, 5]]))] == [6, -5, 1]
    assert [int(c) for c in rational_characteristic_polynomial(Matrix.of([], shape=(0, 0)))] == [1]


def test_bad_input() -> None:
    with pytest.raises(InvalidInput, match="no unit circle"):
        is_stable(Matrix.of([[1]], PrimeField(3)))
    with pytest.raises(InvalidInput, match="square"):
        rational_characteristic_polynomial(Matrix.of([[1, 2]]))
    with pytest.raises(InvalidInput, match="zero polynomial"):
        is_schur([0, 0])
