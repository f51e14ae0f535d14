"""These tests are about what must not change, and what must change in a known way, when a system is written differently.

inverse         of a random invertible matrix, by solving from the left
MULTIPLES       scalings of amplitudes; 0 in small prime fields, where they are left out
"""

from __future__ import annotations

from random import Random
from typing import Any

import pytest
from hypothesis import given, settings

from faultspace.exact.algebra.fields import PrimeField
from faultspace.exact.algebra.matrices import Matrix, beside, rank, row_echelon, solve_left, stacked
from faultspace.exact.structure.fault_columns import fault_space
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.structure.record import analyze
from faultspace.exact.system.systems import ResidualSystem
from tests.exact import checks
from tests.oracle.families import paper_example
from tests.oracle.strategies import SEEDS, systems
from tests.thorough import examples

Json = Any
SOME = settings(max_examples=examples(50))
MULTIPLES = ((1000, 1), (1, 7), (-3, 2))


def invertible(rng: Random, system: ResidualSystem, size: int) -> tuple[Matrix, Matrix]:
    """The result is a random invertible matrix and its inverse."""
    while True:
        found = checks.random_matrix(rng, system, size, size)
        if rank(found) == size:
            inverse = solve_left(found, Matrix.identity(system.field, size))
            assert inverse is not None and found @ inverse == Matrix.identity(system.field, size)
            return found, inverse


def limit(system: ResidualSystem) -> Matrix:
    """The result is the fault space Z as basis rows."""
    return fault_space(kernel_representation(system)).basis


def moved(basis: Matrix, of_states: Matrix, of_outputs: Matrix) -> Matrix:
    """The result is the space of (T f, U g) in its canonical basis."""
    n, p = of_states.ncols, of_outputs.ncols
    parts = basis.columns(range(n)) @ of_states.transposed(), basis.columns(range(n, n + p)) @ of_outputs.transposed()
    return row_echelon(beside(*parts)).matrix


def scaled(matrix: Matrix, factor: Any) -> Matrix:
    """Every entry of the result is the factor times that of the matrix."""
    rows = [[x * factor for x in row] for row in matrix.elements()]
    return Matrix.from_elements(matrix.field, matrix.nrows, matrix.ncols, rows)


def factors(system: ResidualSystem) -> list[Any]:
    """The result is the list of MULTIPLES as units of the field."""
    one = system.field.element
    pairs = [(one(top), one(bottom)) for top, bottom in MULTIPLES]
    return [top / bottom for top, bottom in pairs if top != 0 and bottom != 0]


@SOME
@given(systems(), SEEDS)
def test_bases_of_states_faults_and_outputs(given: Json, seed: int) -> None:
    rng, system = Random(seed), checks.read(given)
    T, T_inverse = invertible(rng, system, system.n)
    V, _ = invertible(rng, system, system.m)
    U, _ = invertible(rng, system, system.p)
    other = ResidualSystem(T @ system.A @ T_inverse, T @ system.F @ V, U @ system.C @ T_inverse, U @ system.G @ V)
    assert checks.indices(other) == checks.indices(system)
    assert limit(other) == moved(limit(system), T, U)
    first, second = analyze(system), analyze(other)
    assert (first.observable, first.controllable) == (second.observable, second.controllable)


@SOME
@given(systems(), SEEDS)
def test_a_basis_of_faults_leaves_the_fault_space(given: Json, seed: int) -> None:
    system = checks.read(given)
    V, _ = invertible(Random(seed), system, system.m)
    assert limit(system.with_faults(system.F @ V, system.G @ V)) == limit(system)


@SOME
@given(systems(), SEEDS)
def test_permuted_outputs(given: Json, seed: int) -> None:
    """The recursion prefers earlier outputs; what it finds must not depend on their order."""
    system = checks.read(given)
    order = list(range(system.p))
    Random(seed).shuffle(order)
    other = ResidualSystem(system.A, system.F, system.C.rows(order), system.G.rows(order))
    assert checks.indices(other) == checks.indices(system)
    U = Matrix.identity(system.field, system.p).rows(order)
    assert limit(other) == moved(limit(system), Matrix.identity(system.field, system.n), U)
    back = ResidualSystem(other.A, other.F, U.transposed() @ other.C, U.transposed() @ other.G)
    assert back == system and hash(back) == hash(system)


@SOME
@given(systems())
def test_amplitudes(given: Json) -> None:
    """Faults, outputs and states may be given in other units."""
    system = checks.read(given)
    wanted, space = checks.indices(system), limit(system)
    for c in factors(system):
        one = system.field.element(1)
        assert checks.indices(system.with_faults(scaled(system.F, c), scaled(system.G, c))) == wanted
        outputs = ResidualSystem(system.A, system.F, scaled(system.C, c), scaled(system.G, c))
        assert checks.indices(outputs) == wanted
        states = ResidualSystem(system.A, scaled(system.F, c), scaled(system.C, one / c), system.G)
        assert checks.indices(states) == wanted
        identities = [Matrix.identity(system.field, size) for size in (system.n, system.p)]
        assert limit(states) == moved(space, scaled(identities[0], c), identities[1])


@SOME
@given(systems())
def test_units_of_time(given: Json) -> None:
    """A, F -> cA, cF puts q/c for q: the zeros are multiplied by c and nothing else changes."""
    system = checks.read(given)
    r, left, right, zeros, infinite, known, unknown = checks.indices(system)
    for c in factors(system):
        other = ResidualSystem(scaled(system.A, c), scaled(system.F, c), system.C, system.G)
        powers = [system.field.element(1)]
        for _ in zeros[1:]:
            powers.append(powers[-1] * c)
        multiplied = tuple(a * power for a, power in zip(zeros, reversed(powers), strict=True))
        assert checks.indices(other) == (r, left, right, multiplied, infinite, known, unknown)


@SOME
@given(systems(), SEEDS)
def test_feedback_and_output_injection(given: Json, seed: int) -> None:
    """Neither changes a Kronecker index or a zero; neither need keep Z, but both keep its dimension."""
    rng, system = Random(seed), checks.read(given)
    K, L = checks.random_matrix(rng, system, system.m, system.n), checks.random_matrix(rng, system, system.n, system.p)
    fed = ResidualSystem(system.A + system.F @ K, system.F, system.C + system.G @ K, system.G)
    injected = ResidualSystem(fed.A + L @ fed.C, fed.F + L @ fed.G, fed.C, fed.G)
    wanted = checks.indices(system)
    for other in (fed, injected):
        assert checks.indices(other)[:5] == wanted[:5]
        assert limit(other).nrows == limit(system).nrows


@SOME
@given(systems())
def test_the_transposed_system(given: Json) -> None:
    """Left and right change places, zeros stay."""
    system = checks.read(given)
    r, left, right, zeros, infinite, *_ = checks.indices(system)
    assert checks.indices(system.transposed())[:5] == (r, right, left, zeros, infinite)
    assert system.transposed().transposed() == system


@SOME
@given(systems(field="Q", largest=2), systems(field="Q", largest=2))
def test_two_systems_side_by_side(first: Json, second: Json) -> None:
    """Indices of a direct sum are those of both together."""
    one, two = checks.read(first), checks.read(second)

    def diagonal(a: Matrix, b: Matrix) -> Matrix:
        upper, lower = Matrix.zero(a.field, a.nrows, b.ncols), Matrix.zero(a.field, b.nrows, a.ncols)
        return stacked(beside(a, upper), beside(lower, b))

    both = analyze(ResidualSystem(*(diagonal(getattr(one, k), getattr(two, k)) for k in "AFCG")))
    parts = analyze(one), analyze(two)
    assert both.kernel.left_minimal_indices == tuple(sorted(x for s in parts for x in s.kernel.left_minimal_indices))
    assert both.right_minimal_indices == tuple(sorted(x for s in parts for x in s.right_minimal_indices))
    assert both.infinite_zero_orders == tuple(sorted(x for s in parts for x in s.infinite_zero_orders))
    assert both.finite_zeros == sum(s.finite_zeros for s in parts)
    assert both.observable == all(s.observable for s in parts)


@pytest.mark.parametrize("prime", [2, 3, 5, 7, 65537])
def test_integer_systems_modulo_a_prime_have_no_larger_ranks(prime: int) -> None:
    """Reduction modulo a prime can only lower rank [O_s T_s]; a large prime keeps it."""
    A, F, C, G = [[0, 1], [2, 3]], [[1], [3]], [[1, 2], [0, 5]], [[0], [2]]
    exact = kernel_representation(ResidualSystem.of(A, F, C, G))
    reduced = kernel_representation(ResidualSystem.of(A, F, C, G, field=PrimeField(prime)))
    for s in range(1, 6):
        assert reduced.rank(s) <= exact.rank(s)
        assert reduced.rank(s) == exact.rank(s) or prime < 100


def test_the_example_in_other_units() -> None:
    """The example of the paper is given with all amplitudes in thousandths and all states mixed."""
    system = checks.read(paper_example())
    T, T_inverse = invertible(Random(0), system, 3)
    c = system.field.element("1/1000")
    other = ResidualSystem(T @ system.A @ T_inverse, scaled(T @ system.F, c), system.C @ T_inverse, system.G)
    assert checks.indices(other) == checks.indices(system)
    assert limit(other) == moved(limit(system), T, Matrix.identity(system.field, 2))
