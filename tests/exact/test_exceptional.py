"""D(q; P) and the exceptional set are tested against the gcd of all maximal minors, over all of GF(2), and with each line broken."""

from __future__ import annotations

import json
from fractions import Fraction
from itertools import combinations_with_replacement
from random import Random
from typing import Any

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from faultspace.base.errors import InvalidInput
from faultspace.exact.algebra.fields import QQ, PrimeField
from faultspace.exact.algebra.matrices import Matrix, rank
from faultspace.exact.pairs.assignment import recoverable_pair
from faultspace.exact.pairs.bad_variety import bad_equations, bad_set
from faultspace.exact.pairs.linear_determinants import by_values, determinant, linear_determinant
from faultspace.exact.pairs.pluecker import coefficient_forms, forms_of_determinant
from faultspace.exact.pairs.polynomial import exceptional, judge, polynomial_at
from faultspace.exact.pairs.witnesses import BadPair, NoBadPair, bad_pair, good_columns
from faultspace.exact.structure.fault_columns import fault_space
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import ResidualSystem
from tests.exact import pair_checks, slow_pairs
from tests.exact.checks import random_matrix, read
from tests.exact.test_broken_on_purpose import Broken, noticed
from tests.oracle.families import CUBIC, FIELDS, SQRT2, adversarial, delay_line, paper_example
from tests.oracle.strategies import SEEDS, systems
from tests.thorough import examples, sampled

Json = Any
Q, TWO, THREE = adversarial("Q"), adversarial({"prime": 2}), adversarial({"prime": 3})
SOME = settings(max_examples=examples(60))


def chains(*lengths: int) -> Json:
    """(A, C) is observable with these observability indices, m = p, and G = I: Z is everything and the k_j are the lengths."""
    n, r = sum(lengths), len(lengths)
    a, c = [[0] * n for _ in range(n)], [[0] * n for _ in range(r)]
    start = 0
    for j, length in enumerate(lengths):
        if length:
            c[j][start] = 1
        for i in range(start, start + length - 1):
            a[i][i + 1] = 1
        start += length
    unit = [[int(i == j) for j in range(r)] for i in range(r)]
    return {"A": a, "F": [[0] * r for _ in range(n)], "C": c, "G": unit, "n": n, "p": r, "m": r, "field": "Q"}


@pytest.mark.parametrize("field", list(FIELDS.values()), ids=list(FIELDS))
@settings(max_examples=examples(25))
@given(data=st.data())
def test_against_all_minors(field: Json, data: st.DataObject) -> None:
    pair_checks.check_polynomial(data.draw(systems(field=field)), data.draw(SEEDS))


@pytest.mark.parametrize("field", list(FIELDS.values()), ids=list(FIELDS))
def test_named_systems(field: Json) -> None:
    """Every check holds on the named systems: no state, no output, no fault, not left-invertible, not observable, p = r."""
    for number, system in enumerate([*adversarial(field).values(), *([paper_example()] if field == CUBIC else [])]):
        pair_checks.check_space(system)
        pair_checks.check_polynomial(system, number)
        pair_checks.check_forms(system, number)
        pair_checks.check_witnesses(system)
        pair_checks.check_bad_set(system)


@SOME
@given(systems(), SEEDS)
def test_spaces_forms_and_witnesses(given: Json, seed: int) -> None:
    pair_checks.check_space(given)
    pair_checks.check_forms(given, seed)
    pair_checks.check_witnesses(given)


@pytest.mark.parametrize("dimensions", [(0, 2, 1), (1, 1, 1), (1, 2, 1), (1, 2, 2), (1, 1, 2), (2, 1, 1)])
def test_every_pair_of_every_system_over_two_elements(dimensions: tuple[int, int, int]) -> None:
    """All systems, all P: bad iff the behaviour changes; a bad P of full column rank exists iff the construction finds one."""
    counts = {True: 0, False: 0}
    seen = {}
    for system in pair_checks.small_systems(*dimensions):
        found = pair_checks.pencil_of(system)
        key = (found.system.A, found.system.C, found.space.basis, found.columns)
        if key in seen:
            continue
        seen[key] = found
        verdicts = [judge(found, P) for P in pair_checks.all_matrices(PrimeField(2), found.n_z, found.columns)]
        for verdict in verdicts:
            pair_checks.check_pair(found, verdict.P)
            counts[verdict.good] += 1
        exists = any(not v.good and v.rank == found.columns for v in verdicts)
        assert isinstance(bad_pair(found), BadPair) == exists
    assert min(counts.values()) >= 3


@pytest.mark.parametrize("field", [QQ, PrimeField(2), PrimeField(7), PrimeField(2**61 - 1)], ids=str)
def test_determinants(field: Any) -> None:
    rng = Random(5)
    for _ in range(60):
        size, inner = rng.randint(0, 5), rng.randint(0, 5)
        dummy = ResidualSystem.of([], [], [], [], field=field, n=0, m=0, p=0)
        slope = random_matrix(rng, dummy, size, inner) @ random_matrix(rng, dummy, inner, size)
        pair_checks.check_determinants(random_matrix(rng, dummy, size, size), slope)


@pytest.mark.parametrize("field", [CUBIC, SQRT2])
def test_determinants_over_number_fields(field: Json) -> None:
    """The product of two determinants is the determinant of the product; the norm is that of the block matrix."""
    rng = Random(6)
    dummy = read({"A": [], "F": [], "C": [], "G": [], "n": 0, "m": 0, "p": 0, "field": field})
    a = dummy.field.element(["0", "1"] + ["0"] * (dummy.field.degree - 2))
    for _ in range(30):
        one, two = (random_matrix(rng, dummy, 3, 3) for _ in range(2))
        one = one + Matrix.from_elements(dummy.field, 3, 3, [[a * x for x in row] for row in two.elements()])
        assert determinant(one @ two) == determinant(one) * determinant(two)
        assert (determinant(one) == 0) == (rank(one) < 3)
        x, y = linear_determinant(one, two), linear_determinant(one @ one, one @ two)
        assert y == (() if determinant(one) == 0 else tuple(determinant(one) * c for c in x))


@pytest.mark.parametrize("lengths", [(0,), (2,), (0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (0, 3), (0, 0, 0)])
def test_the_dimension_of_the_bad_set(lengths: tuple[int, ...]) -> None:
    found = pair_checks.pencil_of(chains(*lengths))
    assert found.left_degrees == lengths
    expanded = bad_equations(found)
    counted = bad_set(found)
    assert slow_pairs.dimension_of(expanded.equations, expanded.entries) == counted.dimension
    assert counted.codimension == found.n_z * found.columns - (counted.dimension or 0)
    for equation in expanded.equations:  # linear in each single entry, homogeneous of degree r
        poly = sympy.Poly(equation, *expanded.entries)
        assert poly.is_zero or (poly.total_degree() == expanded.degree and max(max(m) for m in poly.monoms()) <= 1)


def test_the_codimension_is_at_least_two() -> None:
    """For (A, C) observable, r >= 2, zeta >= 1 it is between 2 and zeta + 1, which is reached where the degrees differ by at most one."""
    for r in (2, 3, 4):
        for degrees in combinations_with_replacement(range(4), r):
            found = bad_set(pair_checks.pencil_of(chains(*degrees)))
            zeta = sum(degrees)
            assert found.codimension is not None
            assert (found.codimension == 1) == (zeta == 0)
            assert zeta == 0 or 2 <= found.codimension <= zeta + 1
            if degrees[-1] - degrees[0] <= 1:
                assert found.codimension == zeta + 1


def test_a_codimension_below_that_of_deficient_rank() -> None:
    """k = (0, 2): a zero row of L(q) P costs two conditions, a rank-deficient P three."""
    found = bad_set(pair_checks.pencil_of(chains(0, 2)))
    assert (found.codimension, found.rank_deficient_codimension) == (2, 3)
    assert found.strata[0].indices == (2,)


def test_no_feedthrough_and_one_fault() -> None:
    """One fault, observable: every P but 0 is good, and the coefficients of D are n_z independent linear forms."""
    found = pair_checks.pencil_of(delay_line("Q", 3))
    assert (found.n_z, found.columns, found.zeta) == (4, 1, 3)
    _, forms = coefficient_forms(forms_of_determinant(found))
    assert rank(forms) == found.n_z
    reason = bad_pair(found)
    assert isinstance(reason, NoBadPair) and "observable" in reason.reason


def test_a_bad_pair_of_full_column_rank() -> None:
    """A = 0, F = [1 0], C = [1; 0], G = [[0, 0], [0, 1]]: the columns [1; 0; 0] and [0; 1; 0] of Z = K^3 are bad together."""
    found = pair_checks.pencil_of(Q["a0-two-faults"])
    verdict = judge(found, [[1, 0], [0, 1], [0, 0]])
    assert (verdict.rank, verdict.good) == (2, False)
    assert "full column rank" in verdict.reason
    assert judge(found, [[1, 0], [0, 0], [0, 1]]).good


def test_a_hypersurface_of_bad_pairs_where_not_observable() -> None:
    """A = F = G = 1, C = 0: D = (q - 1) p2, so that (1, 0) is bad with one fault."""
    found = pair_checks.pencil_of(Q["unobservable"])
    assert found.fixed == (QQ.element(-1), QQ.element(1)) and not found.observable
    assert not judge(found, [[1], [0]]).good and judge(found, [[0], [1]]).good
    counted = bad_set(found)
    assert (counted.codimension, counted.dimension) == (1, 1)
    (p1, p2), equations = bad_equations(found).entries, bad_equations(found).equations
    assert all(sympy.rem(f, p2, p1, p2) == 0 for f in equations)
    assert bad_equations(found).factors[1][-1] == (p2, 1)


def test_zeta_zero_is_the_determinant() -> None:
    found = pair_checks.pencil_of(Q["shift-register-3"])
    assert found.zeta == 0
    assert polynomial_at(found, Matrix.of([["-7/3"]])) == (QQ.element("-7/3"),)
    none = bad_pair(found)
    assert isinstance(none, NoBadPair) and none.to_json()["zeta"] == 0


def test_equations_over_a_prime_field() -> None:
    """The expanded equations vanish at exactly the bad P."""
    found = pair_checks.pencil_of(THREE["a0-two-faults"])
    expanded = bad_equations(found)
    for P in pair_checks.all_matrices(PrimeField(3), found.n_z, found.columns):
        at = dict(zip(expanded.entries, (int(x) for row in P.elements() for x in row), strict=True))
        assert all(int(sympy.sympify(f).subs(at)) % 3 == 0 for f in expanded.equations) == (not judge(found, P).good)


def test_the_share_of_bad_pairs() -> None:
    """Schwartz-Zippel: over GF(3) no more than r / 3 of all P are bad; useless bounds are 1."""
    for system in THREE.values():
        found = pair_checks.pencil_of(system)
        if found.n_z * found.columns > 6:
            continue
        verdicts = [judge(found, P).good for P in pair_checks.all_matrices(PrimeField(3), found.n_z, found.columns)]
        assert Fraction(verdicts.count(False), len(verdicts)) <= Fraction(found.columns, 3)


@pytest.mark.parametrize("field", list(FIELDS.values()), ids=list(FIELDS))
def test_records_go_into_json(field: Json) -> None:
    for name in ("a0-two-faults", "unobservable", "delay-line-2", "no-output", "nothing"):
        found = pair_checks.pencil_of(adversarial(field)[name])
        records: list[Any] = [good_columns(found), bad_pair(found), bad_set(found), forms_of_determinant(found), recoverable_pair(found)]
        if "minimal_polynomial" not in field:
            records.append(bad_equations(found))
        for record in records:
            assert json.loads(json.dumps(record.to_json())) == record.to_json()


@pytest.mark.parametrize("field", ["Q", {"prime": 3}], ids=str)
def test_factors_multiply_to_the_equations(field: Json) -> None:
    for system in adversarial(field).values():
        found = pair_checks.pencil_of(system)
        if found.n_z * found.columns > 6:
            continue
        expanded = bad_equations(found)
        for equation, factors in zip(expanded.equations, expanded.factors, strict=True):
            rest = sympy.expand(equation - sympy.Mul(*(g**e for g, e in factors)))
            assert rest == 0 or all(int(c) % 3 == 0 and field != "Q" for c in sympy.Poly(rest, *expanded.entries).coeffs())


# -- bad input --------------------------------------------------------------------------------------------------------


def test_wrong_pairs_are_told() -> None:
    found = pair_checks.pencil_of(Q["a0-two-faults"])
    with pytest.raises(InvalidInput, match=r"P: got 2 x 2, expected 3 x 2: a row for each basis column"):
        judge(found, [[1, 0], [0, 1]])
    with pytest.raises(InvalidInput, match=r"P: got 3 x 1, expected 3 x 2.*normal rank"):
        judge(found, [[1], [0], [0]])
    with pytest.raises(InvalidInput, match=r"P: got entries over GF\(2\), expected Q"):
        judge(found, Matrix.identity(PrimeField(2), 3).columns([0, 1]))
    assert judge(found, [[1, 2], [1, 2], [0, 0]]).reason == "P has rank 1, below its 2 columns"


def test_a_short_window_is_warned_about() -> None:
    kernel = kernel_representation(read(Q["shift-register-3"]))
    warning = fault_space(kernel, 3).warning
    assert warning is not None and "the lag is 3" in warning and "ask for 4 samples" in warning
    assert fault_space(kernel, 4).warning is None and fault_space(kernel).warning is None


def test_sizes_that_are_not_written_out() -> None:
    wide = exceptional(kernel_representation(read(chains(*[3] * 6))))
    with pytest.raises(InvalidInput, match=r"6 of 24 rows can be chosen in 134596 ways, at most 20000"):
        forms_of_determinant(wide)
    with pytest.raises(InvalidInput, match=r"24 x 6 entries, at most 16"):
        bad_equations(wide)
    assert good_columns(wide).verdict.good
    with pytest.raises(InvalidInput, match=r"expanded over Q and prime fields"):
        bad_equations(pair_checks.pencil_of(paper_example()))
    with pytest.raises(InvalidInput, match=r"determinant: got 1 x 2, expected 1 x 1"):
        determinant(Matrix.of([[1, 2]]))
    with pytest.raises(InvalidInput, match=r"GF\(2\) has fewer than the 3 points"):
        by_values(Matrix.identity(PrimeField(2), 2), Matrix.identity(PrimeField(2), 2))


# -- broken on purpose ------------------------------------------------------------------------------------------------

LINE = delay_line("Q", 2)
BROKEN: dict[str, Broken] = {
    "a forgets C": Broken(
        "exceptional",
        "stacked(system.A @ U, system.C @ U)",
        "stacked(system.A @ U, system.C @ U - system.C @ U)",
        pair_checks.check_polynomial,
        (Q["a0-zero-at-the-origin"], 1),
    ),
    "the sign of a": Broken("polynomial_at", "beside(P, -pencil.a)", "beside(P, pencil.a)", pair_checks.check_polynomial, (LINE, 1)),
    "good is of full rank": Broken(
        "judge",
        "polynomial_at(pencil, matrix)",
        "matrix.rows([0]).elements()[0] if rank(matrix) == matrix.ncols else ()",
        pair_checks.check_witnesses,
        (Q["a0-two-faults"],),
    ),
    "deflation loses a sign": Broken(
        "by_deflation",
        "(_inversions(kept, size) + _inversions(others, size)) % 2",
        "False",
        pair_checks.check_determinants,
        (Matrix.of([[0, 1], [1, 0]]), Matrix.of([[1, 0], [0, 0]])),
    ),
    "Laplace without signs": Broken(
        "forms_of_determinant",
        "polynomials.negative(h) if inversions % 2 else h",
        "h",
        pair_checks.check_forms,
        (LINE, 1),
    ),
    "fixed zeros stay in the common factor": Broken(
        "pluecker_forms",
        "polynomials.divide(common, pencil.fixed)",
        "(common, ())",
        pair_checks.check_forms,
        (Q["unobservable"], 1),
    ),
    "columns of the leading coefficients": Broken(
        "good_columns",
        "row_echelon(at_zero).pivots",
        "tuple(range(pencil.columns))",
        pair_checks.check_witnesses,
        (Q["a0-two-faults"],),
    ),
    "the splitting type is forgotten": Broken(
        "_codimension",
        "max(0, k - e + 1)",
        "max(0, k - e + 2)",
        pair_checks.check_bad_set,
        (chains(0, 1),),
    ),
}


@pytest.mark.parametrize("name", sampled(BROKEN, 4))
def test_it_is_noticed(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    noticed(monkeypatch, BROKEN[name], (AssertionError, ArithmeticError, AttributeError))
