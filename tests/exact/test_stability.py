"""Schur stability is tested against roots known by construction, and against eigenvalues in floats away from the circle."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from faultspace.base.errors import InvalidInput
from faultspace.exact.algebra.fields import NumberField, PrimeField
from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.algebra.stability import is_schur, is_stable, rational_characteristic_polynomial

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
