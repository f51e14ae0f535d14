"""This is what the tests ask about pairs (Fhat P, Ghat P) of one system. Every check raises AssertionError and takes a SYSTEM of the
format.

small_systems           every SYSTEM over GF(2) of given dimensions
all_matrices            every matrix over GF(p) of a shape
check_space             U = V* + S*, its coordinates, the degrees of L and the fixed zeros
check_determinants      by_values, by_deflation and sympy agree
check_polynomial        D(q; P) against the oracle's gcd of all maximal minors, and against `compare`
check_forms             both routes to the h_J, their sum at a P, the rank of the linear forms
check_bad_set           its dimension by counting and by a Groebner basis
check_witnesses         good columns; a bad pair, or none
check_assignment        pairs with given zeros, and one that needs no initial state
check_zero_feedthrough  the condition, the alternative and the delays
check_names             two systems: equal names iff equal behaviours
check_feedback          (A + F K, C + G K)
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from random import Random
from typing import Any

import sympy
from sympy.polys.matrices import DomainMatrix

from faultspace.exact.algebra import polynomials
from faultspace.exact.algebra.fields import Field, NumberField, PrimeField
from faultspace.exact.algebra.matrices import Matrix, beside, column_basis, rank, right_null_space, stacked
from faultspace.exact.pairs.assignment import assign_zeros, recoverable_pair
from faultspace.exact.pairs.bad_variety import bad_equations, bad_set
from faultspace.exact.pairs.canonical_form import behavior_name, fault_class, feedback_class, with_feedback
from faultspace.exact.pairs.linear_determinants import by_deflation, by_values, linear_determinant
from faultspace.exact.pairs.no_feedthrough import zero_feedthrough
from faultspace.exact.pairs.pluecker import coefficient_forms, forms_of_determinant, value
from faultspace.exact.pairs.polynomial import Exceptional, exceptional, judge, polynomial_at
from faultspace.exact.pairs.witnesses import BadPair, bad_pair, good_columns
from faultspace.exact.structure.behavior import compare
from faultspace.exact.structure.fault_columns import fault_space
from faultspace.exact.structure.inversion import largest_output_nulling
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.structure.pencil import characteristic_polynomial, infinite_zero_orders
from faultspace.exact.structure.record import analyze
from faultspace.exact.structure.signals import simulate
from faultspace.exact.structure.zero_output import chain_from_rest
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import observability_matrix
from tests.exact.checks import random_matrix, read
from tests.exact.slow_pairs import dimension_of, members_by_formula, pluecker_forms
from tests.oracle.pencil import invariant_zero_polynomial, normal_rank
from tests.oracle.systems import parse_system

Json = Any


def small_systems(n: int, p: int, m: int, *, feedthrough: bool = True) -> Iterator[Json]:
    """These are all SYSTEMs over GF(2) with these dimensions; without `feedthrough` only those with G = 0."""
    shapes = {"A": (n, n), "F": (n, m), "C": (p, n), "G": (p, m)}
    sizes = {k: h * w if feedthrough or k != "G" else 0 for k, (h, w) in shapes.items()}
    for bits in product((0, 1), repeat=sum(sizes.values())):
        rest = iter(bits)
        tables = {k: [[next(rest, 0) for _ in range(w)] for _ in range(h)] for k, (h, w) in shapes.items()}
        yield tables | {"n": n, "m": m, "p": p, "field": {"prime": 2}}


def all_matrices(field: Field, nrows: int, ncols: int) -> Iterator[Matrix]:
    """These are all matrices of that shape over a prime field."""
    assert isinstance(field, PrimeField)
    for entries in product(range(field.p), repeat=nrows * ncols):
        rows = [list(entries[i * ncols : (i + 1) * ncols]) for i in range(nrows)]
        yield Matrix.of(rows, field, shape=(nrows, ncols))


def pencil_of(system: Json) -> Exceptional:
    """The result is `exceptional` of the SYSTEM."""
    return exceptional(kernel_representation(read(system)))


def some_pair(found: Exceptional, seed: int) -> Matrix:
    """The result is a P of the right shape with small entries, of deficient rank now and then."""
    rng = Random(seed)
    P = random_matrix(rng, found.system, found.n_z, found.columns)
    return P @ random_matrix(rng, found.system, found.columns, found.columns) if seed % 3 == 0 else P


def check_space(system: Json) -> None:
    """U by its definition, by V* + S*, and in coordinates; L annihilates q b - a; the fixed zeros are those of the unobservable part."""
    found = pencil_of(system)
    exact = found.system
    strong = beside(largest_output_nulling(exact), chain_from_rest(exact).last_subspace)
    assert found.states == column_basis(strong)
    columns = stacked(found.space.F, found.space.G)
    assert columns @ found.b == stacked(found.states, Matrix.zero(exact.field, exact.p, found.zeta))
    assert columns @ found.a == stacked(exact.A @ found.states, exact.C @ found.states)
    assert found.n_z == found.zeta + found.columns
    assert found.zeta == exact.n - sum(found.kernel.left_minimal_indices)
    all_of_it = analyze(exact)
    if all_of_it.left_invertible:
        assert found.zeta == all_of_it.zeta
    unobserved = exact.n - rank(observability_matrix(exact, exact.n))
    assert len(found.fixed) - 1 == unobserved and sum(found.left_degrees) == found.zeta - unobserved
    assert found.observable == all_of_it.observable
    assert not polynomials.divide(characteristic_polynomial(exact.A), found.fixed)[1]
    for row in found.left_kernel:  # L_j(q) (q b - a) = 0, power by power
        for k in range(row.nrows + 1):
            before = row.rows([k - 1]) @ found.b if k else Matrix.zero(exact.field, 1, found.zeta)
            after = row.rows([k]) @ found.a if k < row.nrows else Matrix.zero(exact.field, 1, found.zeta)
            assert before == after
    coefficients = stacked(Matrix.zero(exact.field, 0, found.n_z), *found.left_kernel)
    assert rank(coefficients) == coefficients.nrows == found.n_z - unobserved


def check_determinants(constant: Matrix, slope: Matrix) -> None:
    """Three routes to det(X + q Y) agree."""
    field = constant.field
    wanted = by_deflation(constant, slope)
    assert linear_determinant(constant, slope) == wanted
    if isinstance(field, NumberField):
        return
    q = sympy.Symbol("q")
    table = DomainMatrix.from_Matrix(sympy.Matrix(constant.to_sympy() + q * slope.to_sympy())).convert_to(sympy.QQ[q])
    ascending = list(reversed(sympy.Poly((-1) ** constant.nrows * table.charpoly()[-1].as_expr(), q).all_coeffs()))
    slow = [int(c) for c in ascending] if isinstance(field, PrimeField) else ascending
    assert polynomials.trimmed(field.element(c) for c in slow) == wanted
    if not isinstance(field, PrimeField) or field.p > rank(slope):
        assert by_values(constant, slope) == wanted


def check_polynomial(system: Json, seed: int) -> None:
    """D(q; P) is the gcd of the maximal minors, zero iff the normal rank is below r, nonzero iff the behaviours are equal."""
    found = pencil_of(system)
    check_pair(found, some_pair(found, seed))


def check_pair(found: Exceptional, P: Matrix) -> None:
    """What `check_polynomial` asks of a random P holds for this one."""
    verdict = judge(found, P)
    pair = verdict.system
    slow = parse_system(pair.to_json())
    assert verdict.good == (normal_rank(slow) == found.columns)
    kernel = kernel_representation(pair)
    assert verdict.good == compare(found.kernel, kernel).equivalent
    assert verdict.rank == rank(P) and (verdict.good <= (rank(P) == P.ncols))
    if verdict.good:
        wanted = tuple(P.field.element(slow.field.write(c)) for c in invariant_zero_polynomial(slow))
        assert polynomials.monic(verdict.polynomial) == wanted
        assert verdict.finite_zeros == len(wanted) - 1
        assert verdict.infinite_zeros == sum(infinite_zero_orders(kernel))
        assert verdict.null_vector is None
    else:
        null = verdict.null_vector
        assert null is not None and not null.fault.is_zero()
        assert verdict.finite_zeros is None and verdict.infinite_zeros is None
    field = P.field
    assert verdict.to_json()["polynomial"] == [field.write(c) for c in verdict.polynomial]


def check_forms(system: Json, seed: int) -> None:
    """The minors of the pencils themselves are those of q b - a, and the sum at a P is the determinant."""
    found = pencil_of(system)
    slow, fast = pluecker_forms(found), forms_of_determinant(found)
    assert slow.keys() == fast.minors.keys()
    J = min(fast.minors)
    unit = fast.minors[J][-1] / slow[J][-1]
    assert all(tuple(unit * c for c in h) == fast.minors[K] for K, h in slow.items())
    P = some_pair(found, seed)
    assert value(fast, P) == polynomial_at(found, P)
    _, forms = coefficient_forms(fast)
    assert forms.nrows == found.zeta + 1 and rank(forms) == found.zeta + 2 - len(found.fixed)


def check_witnesses(system: Json) -> None:
    """The good columns are good; a bad pair has full column rank and exists exactly where it must."""
    found = pencil_of(system)
    good = good_columns(found)
    assert good.verdict.good and len(good.chosen) == found.columns
    assert Matrix.identity(found.system.field, found.n_z).columns(good.chosen) == good.verdict.P
    assert compare(found.kernel, kernel_representation(good.verdict.system)).equivalent
    bad = bad_pair(found)
    expected = found.columns >= 1 and (not found.observable or (found.columns >= 2 and found.zeta >= 1))
    assert isinstance(bad, BadPair) == expected
    if isinstance(bad, BadPair):
        assert rank(bad.verdict.P) == found.columns and not bad.verdict.good
        assert (bad.conditions @ bad.verdict.P.columns([0])).is_zero()
        assert not compare(found.kernel, kernel_representation(bad.verdict.system)).equivalent


def check_bad_set(system: Json) -> None:
    """The dimension by counting is that of a Groebner basis of the expanded equations; it leaves 1 iff all L_j are constant, r >= 1."""
    found = pencil_of(system)
    counted = bad_set(found)
    if found.columns == 0:
        assert counted.codimension is None
        return
    assert counted.codimension is not None and counted.dimension is not None
    free = sum(found.left_degrees)
    assert 1 <= counted.codimension <= free + 1
    assert (counted.codimension == 1) == (free == 0)
    if found.columns == 1:
        assert counted.codimension == free + 1
    if system["field"] == "Q" and found.n_z * found.columns <= 8:
        expanded = bad_equations(found)
        assert dimension_of(expanded.equations, expanded.entries) == counted.dimension


def check_assignment(system: Json, seed: int) -> None:
    """There is a pair with each degree of free zeros; `structure` finds its zeros again, and v(0) is recovered from outputs alone."""
    found = pencil_of(system)
    field, rng = found.system.field, Random(seed)
    free = found.zeta + 1 - len(found.fixed) if found.columns else 0
    for degree in range(free + 1):
        own = tuple(field.element(rng.randint(-2, 2)) for _ in range(degree))
        desired = polynomials.multiply(found.fixed, (*own, field.element(1)))
        result = assign_zeros(found, list(desired))
        assert result.desired == desired and result.verdict.polynomial == tuple(result.unit * c for c in desired)
        again = analyze(result.system)
        assert again.invariant_zero_polynomial == desired and again.left_invertible
        assert sum(again.infinite_zero_orders) == found.zeta - len(desired) + 1
        assert compare(found.kernel, again.kernel).equivalent
    recovery = recoverable_pair(found)
    pair = recovery.assignment.system
    x0, v = random_matrix(rng, pair, pair.n, 1), random_matrix(rng, pair, recovery.delay + 1, pair.m)
    outputs = simulate(pair, x0, v).residuals
    column = stacked(Matrix.zero(field, 0, 1), *(outputs.rows([k]).transposed() for k in range(outputs.nrows)))
    assert recovery.left_inverse @ column == v.rows([0]).transposed()


def check_zero_feedthrough(system: Json) -> None:
    """For G = 0 and a left-invertible system, members, conditions and alternative are as their definitions say."""
    exact = read(system)
    assert exact.G.is_zero()
    kernel = kernel_representation(exact)
    assert members_by_formula(exact) == exceptional(kernel).states
    all_of_it = analyze(exact)
    if not all_of_it.left_invertible:
        return
    found = zero_feedthrough(kernel)
    assert found.members == _zero_feedthrough_members(found.exceptional.space.basis, exact)
    unobserved = exact.n - rank(observability_matrix(exact, exact.n))
    assert found.finite_zeros == all_of_it.finite_zeros and found.ambiguity == all_of_it.zeta - exact.m
    assert found.rank_CF == rank(exact.C @ exact.F)
    if exact.m == 0:
        assert found.pins_F and found.pins_v
        return
    assert found.pins_F == (all_of_it.zeta == exact.m)
    assert found.pins_F == (found.rank_CF == exact.m and found.finite_zeros == 0)
    assert found.pins_F == (found.members == column_basis(exact.F))
    assert found.pins_v == (found.rank_CF == exact.m and found.finite_zeros == unobserved)
    assert not found.pins_v or found.delay_unknown_state is not None
    assert not found.pins_F or (found.pins_v and all_of_it.observable and found.delay_known_state == 1)
    if found.alternative is not None:
        other = found.alternative.system
        assert other.G.is_zero() and other.F == found.alternative.F
        assert rank(beside(exact.F, other.F)) > exact.m
        assert compare(kernel, kernel_representation(other)).equivalent
        assert found.pins_v == same_response_up_to_basis(exact, other)


def _zero_feedthrough_members(basis: Matrix, system: ResidualSystem) -> Matrix:
    """Return the members [f; 0] of the span of the basis rows, by intersecting with the columns [x; 0]."""
    states = beside(Matrix.identity(system.field, system.n), Matrix.zero(system.field, system.n, system.p)).transposed()
    columns = basis.transposed()
    common = right_null_space(beside(columns, -states)).rows(range(columns.ncols))
    return column_basis((columns @ common).rows(range(system.n)))


def same_response_up_to_basis(one: ResidualSystem, other: ResidualSystem) -> bool:
    """This tells whether the Markov parameters of `other` are those of `one` times one constant matrix."""
    responses = []
    for system in (one, other):
        state, blocks = system.F, [system.G]
        for _ in range(system.n):
            blocks.append(system.C @ state)
            state = system.A @ state
        responses.append(stacked(*blocks))
    return rank(beside(*responses)) == rank(responses[0])


def check_names(first: Json, second: Json) -> bool:
    """Equal names iff equal behaviours; for the same A, C equal classes iff equal behaviours; equal feedback classes only then."""
    one, two = (kernel_representation(read(system)) for system in (first, second))
    equivalent = compare(one, two).equivalent
    assert (behavior_name(one) == behavior_name(two)) == equivalent
    assert not equivalent or hash(behavior_name(one)) == hash(behavior_name(two))
    if (one.system.A, one.system.C) == (two.system.A, two.system.C):
        assert (fault_class(one) == fault_class(two)) == equivalent
        assert (feedback_class(one) == feedback_class(two)) == equivalent
    if feedback_class(one) == feedback_class(two):
        assert equivalent
    return equivalent


def check_feedback(system: Json, seed: int) -> None:
    """v = K x + v' changes (A, C), but no name and no fault space."""
    exact = read(system)
    changed = with_feedback(exact, random_matrix(Random(seed), exact, exact.m, exact.n))
    one, two = kernel_representation(exact), kernel_representation(changed)
    assert compare(one, two).equivalent
    assert behavior_name(one) == behavior_name(two) and feedback_class(one) == feedback_class(two)
    assert fault_class(one).basis == fault_class(two).basis
    assert (fault_class(one) == fault_class(two)) == ((exact.A, exact.C) == (changed.A, changed.C))
    space = fault_space(one)  # any gain on all of Z, not only on the system's own columns
    whole = exact.with_faults(space.F, space.G)
    moved = kernel_representation(with_feedback(whole, random_matrix(Random(seed + 1), exact, whole.m, exact.n)))
    assert compare(one, moved).equivalent and feedback_class(moved) == feedback_class(one)
