"""This is what the tests of this room ask of one system or two. Every check raises AssertionError and takes a SYSTEM of the format.

    as_exact                    the oracle's matrix as one of this room
    read, indices               SYSTEM -> ResidualSystem; its Kronecker indices and zeros in one tuple
    check_report                `structure` says what the slow oracle says
    check_window_ranks          recursion, kernel rows and built matrices agree on rank [O_s T_s] and rank T_s
    check_kernel_rows           the rows annihilate, are triangular by their pivots, span every left null space with their shifts
    check_relations             `relations` on its own: what it solves for annihilates the built matrix
    check_finite_zeros          four routes to the invariant zeros
    check_infinite_zeros        gaps of rank T_s, diagonal form of the reversed pencil, gcd of its minors
    check_right_indices         transposed kernel rows, the oracle's annihilators, a null vector of least degree
    check_diagonals             left P right = diagonal with unimodular multipliers, finite and infinite
    check_kronecker_sum         n = sum eta + sum eps + n_f + n_inf
    check_fault_spaces          problem (11) at every window and in the limit
    check_comparison            two systems: `compare`, inclusions on windows, separating words
    check_inversion             delays, left inverses and ambiguous words

The broken versions in test_broken_on_purpose are put through the same checks.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from random import Random
from typing import Any

from faultspace.exact.algebra import polynomials
from faultspace.exact.algebra.fields import Field, PrimeField
from faultspace.exact.algebra.matrices import Matrix, beside, left_null_space, rank, row_echelon, stacked
from faultspace.exact.algebra.polynomials import Poly, PolyMatrix, SmithDiagonal
from faultspace.exact.structure.behavior import Separation, compare
from faultspace.exact.structure.fault_columns import fault_space, fault_space_dimension
from faultspace.exact.structure.inversion import ambiguous_word, delay_known_state, delay_unknown_state, left_inverse
from faultspace.exact.structure.kernel_rows import KernelRepresentation, annihilates, kernel_representation
from faultspace.exact.structure.pencil import (
    finite_diagonal,
    infinite_diagonal,
    infinite_zero_orders,
    invariant_zero_polynomial,
    pencil,
    reversed_pencil,
    right_minimal_indices,
    right_null_polynomial,
    zero_dynamics_polynomial,
    zeros_alone,
)
from faultspace.exact.structure.record import analyze
from faultspace.exact.structure.relations import coefficients_of, integer_relations, relations_over_prime_field
from faultspace.exact.structure.signals import simulate
from faultspace.exact.structure.zero_output import chain_from_rest, zero_output_chain
from faultspace.exact.system.modular import image
from faultspace.exact.system.systems import ResidualSystem, read_system
from faultspace.exact.system.windows import toeplitz_matrix, window_matrix
from tests.oracle import first_difference, inspect_slowly, same_report
from tests.oracle.fault_space import fault_space as slow_fault_space
from tests.oracle.linear import Matrix as SlowMatrix
from tests.oracle.pencil import infinite_zero_orders_of_pencil, right_minimal_indices_of_pencil
from tests.oracle.pencil import invariant_zero_polynomial as slow_zero_polynomial
from tests.oracle.systems import parse_system

Json = Any


def read(system: Json) -> ResidualSystem:
    """The result is the system of the dict, without its inputs."""
    return read_system(system).residual


def indices(system: ResidualSystem) -> tuple[Any, ...]:
    """The result is (r, left indices, right indices, zero polynomial, infinite orders, both delays), which no change of basis changes."""
    all_of_it = analyze(system)
    return (
        all_of_it.kernel.normal_rank,
        all_of_it.kernel.left_minimal_indices,
        all_of_it.right_minimal_indices,
        all_of_it.invariant_zero_polynomial,
        all_of_it.infinite_zero_orders,
        all_of_it.delay_known_state,
        all_of_it.delay_unknown_state,
    )


def as_exact(matrix: SlowMatrix, field: Field) -> Matrix:
    """Return the oracle's matrix as one of this room."""
    rows = [[matrix.field.write(x) for x in row] for row in matrix.rows]
    return Matrix.of(rows, field, shape=(matrix.height, matrix.width))


def random_matrix(rng: Random, system: ResidualSystem, nrows: int, ncols: int) -> Matrix:
    """The entries of the result are among -2..2."""
    return Matrix.of([[rng.randint(-2, 2) for _ in range(ncols)] for _ in range(nrows)], system.field, shape=(nrows, ncols))


# -- one system -------------------------------------------------------------------------------------------------------


def check_report(system: Json) -> None:
    """`analyze(...).to_json()` equals what the oracle finds from definitions."""
    fast, slow = analyze(read(system)).to_json(), inspect_slowly(system)
    assert same_report(slow, fast), (system, fast, slow)


def check_window_ranks(system: Json) -> None:
    """The recursion and the rows give rank [O_s T_s] and rank T_s for s = 0..n+3 as the built matrices do."""
    exact = read(system)
    windows = exact.n + 3
    built = tuple(rank(window_matrix(exact, s)) for s in range(windows + 1))
    chain = zero_output_chain(exact)
    assert tuple(chain.rank(s) for s in range(windows + 1)) == built
    assert tuple(chain.gap(k) for k in range(windows)) == tuple(b - a for a, b in pairwise(built))
    rest = chain_from_rest(exact)
    assert tuple(rest.rank(s) for s in range(windows + 1)) == tuple(rank(toeplitz_matrix(exact, s)) for s in range(windows + 1))
    assert chain.final_gap == rest.final_gap == built[-1] - built[-2]
    for k, profile in enumerate(chain.profiles):  # the independent rows of sample k, below all rows of earlier samples
        window = window_matrix(exact, k + 1)
        before = rank(window.rows(range(k * exact.p)))
        for output in range(exact.p):
            after = rank(window.rows(range(k * exact.p + output + 1)))
            assert (after > before) == (output in profile)
            before = after
    kernel = kernel_representation(exact)
    assert tuple(kernel.rank(s) for s in range(windows + 1)) == built
    assert tuple(kernel.gap(k) for k in range(windows)) == tuple(b - a for a, b in pairwise(built))


def check_kernel_rows(system: Json) -> None:
    """The rows annihilate; they and their shifts are a basis of the left null space of every window."""
    exact = read(system)
    kernel = kernel_representation(exact)
    assert list(kernel.left_minimal_indices) == sorted(kernel.left_minimal_indices)
    assert len(kernel.rows) == exact.p - kernel.normal_rank
    pivots = [row.pivot for row in kernel.rows]
    assert len(set(pivots)) == len(pivots)
    for row in kernel.rows:
        assert annihilates(row, exact)
        leading = row.coefficients.rows([row.degree])
        assert leading[0, row.pivot] != 0
        assert all(leading[0, j] == 0 for j in range(row.pivot + 1, exact.p))
    for s in range(exact.n + 3):
        shifts = _shifted_rows(kernel, s)
        window = window_matrix(exact, s)
        assert (shifts @ window).is_zero()
        assert rank(shifts) == shifts.nrows == left_null_space(window).nrows


def check_relations(system: Json) -> None:
    """The relations for the shape that the exact recursion shows annihilate the built matrix of their window."""
    exact = read(system)
    dependent: dict[int, int] = {}  # output -> the first sample at which it depends on earlier ones
    for k, profile in enumerate(zero_output_chain(exact).profiles):
        for output in set(range(exact.p)) - set(profile):
            dependent.setdefault(output, k)
    leads = sorted((mu, output) for output, mu in dependent.items())
    if isinstance(exact.field, PrimeField):
        found = [Matrix.of(relation, exact.field) for relation in relations_over_prime_field(exact, leads)]
    else:
        coordinates = integer_relations(exact, leads, image(exact).prime)
        assert coordinates is not None
        found = [coefficients_of(relation, exact) for relation in coordinates]
    assert [relation.nrows for relation in found] == [mu + 1 for mu, _ in leads]
    for relation in found:
        assert (_side_by_side(relation) @ window_matrix(exact, relation.nrows)).is_zero()
        assert not relation.is_zero()


def check_finite_zeros(system: Json) -> None:
    """The gcd of compressed minors (over Q), zero dynamics, diagonal form and the oracle's gcd of all minors agree."""
    exact = read(system)
    field = exact.field
    slow = parse_system(system)
    wanted = tuple(field.element(slow.field.write(c)) for c in slow_zero_polynomial(slow))
    assert invariant_zero_polynomial(kernel_representation(exact), len(wanted) - 1) == wanted
    assert zeros_alone(kernel_representation(exact)) == wanted
    assert zero_dynamics_polynomial(exact) == wanted
    product: Poly = (field.element(1),)
    for entry in finite_diagonal(exact).diagonal:
        product = polynomials.multiply(product, entry) if entry else product
    assert polynomials.monic(product) == wanted


def check_infinite_zeros(system: Json) -> None:
    """The orders agree: from rank T_s, from the powers of t in the diagonal form of the reversed pencil, from the gcd of its minors."""
    exact = read(system)
    found = infinite_zero_orders(kernel_representation(exact))
    assert list(found) == sorted(found)
    valuations = [next(k for k, c in enumerate(f) if c != 0) for f in infinite_diagonal(exact).diagonal if f]
    assert sorted(v - 1 for v in valuations if v) == list(found)
    assert infinite_zero_orders_of_pencil(parse_system(system)) == list(found)
    for k in range(exact.n + 2):
        assert rank(toeplitz_matrix(exact, k + 1)) - rank(toeplitz_matrix(exact, k)) == sum(delta <= k for delta in found)


def check_right_indices(system: Json) -> None:
    """Against the dimensions of the polynomial right kernel; the null vector has the least of them for its degree."""
    exact = read(system)
    found = right_minimal_indices(exact)
    assert list(found) == right_minimal_indices_of_pencil(parse_system(system))
    null = right_null_polynomial(exact)
    assert (null is None) == (not found)
    if null is None:
        return
    assert null.fault.nrows == null.state.nrows == found[0] + 1
    assert not null.fault.is_zero()
    columns: PolyMatrix = [[polynomials.trimmed(row[j] for row in null.state.elements())] for j in range(exact.n)]
    columns += [[polynomials.trimmed(row[j] for row in null.fault.elements())] for j in range(exact.m)]
    assert all(not entry for row in _product(pencil(exact), columns, 1) for entry in row)


def check_diagonals(system: Json) -> None:
    """left P right is the diagonal, and the multipliers have polynomial inverses."""
    exact = read(system)
    one = exact.field.element(1)
    height, width = exact.n + exact.p, exact.n + exact.m
    for matrix, form in ((pencil(exact), finite_diagonal(exact)), (reversed_pencil(exact), infinite_diagonal(exact))):
        assert _product(form.left, form.left_inverse, height) == _unit(height, one)
        assert _product(form.right, form.right_inverse, width) == _unit(width, one)
        assert _product(_product(form.left, matrix, width), form.right, width) == _spread(form, height, width)


def check_kronecker_sum(system: Json) -> None:
    """The Kronecker structure gives n, p, m and zeta, and with them the two formulas for ranks and dimensions hold."""
    exact = read(system)
    found = analyze(exact)
    kernel = found.kernel
    eta, eps, orders = kernel.left_minimal_indices, found.right_minimal_indices, found.infinite_zero_orders
    assert exact.n == sum(eta) + sum(eps) + found.finite_zeros + sum(orders)
    assert exact.p == kernel.normal_rank + len(eta)
    assert exact.m == kernel.normal_rank + len(eps)
    assert len(orders) == kernel.normal_rank
    assert found.zeta == exact.n - sum(eta) - sum(eps)
    for s in range(exact.n + 3):
        assert rank(window_matrix(exact, s)) == s * kernel.normal_rank + sum(min(s, x) for x in eta)
        assert fault_space(kernel, s).dimension == exact.n + exact.p - sum(x + 1 for x in eta if x <= s - 1)
    if eta:
        assert found.fault_space.dimension == kernel.normal_rank + found.zeta + sum(eps)


def check_fault_spaces(system: Json) -> None:
    """Problem (11) is solved as its definition says at every window 0..n+2, and in the limit."""
    exact, slow = read(system), parse_system(system)
    kernel = kernel_representation(exact)
    limit = fault_space(kernel)
    dimensions = []
    for s in range(exact.n + 3):
        found = fault_space(kernel, s)
        assert found.basis == as_exact(slow_fault_space(slow, s), exact.field)
        assert found.basis == row_echelon(found.basis).matrix
        assert found.dimension == fault_space_dimension(kernel, s)
        assert found.is_limit == (s >= limit.exact_from) and limit.is_limit
        dimensions.append(found.dimension)
        if found.is_limit:
            assert found.basis == limit.basis
    assert dimensions == sorted(dimensions, reverse=True)
    assert limit.dimension == fault_space_dimension(kernel) == dimensions[-1]
    if kernel.rows:  # the least window is the least one
        assert limit.exact_from == kernel.lag + 1 and dimensions[kernel.lag] > limit.dimension
    else:
        assert limit.exact_from == 1 and limit.dimension == exact.n + exact.p
    # the system's own columns explain no more than the system does
    own = beside(exact.F.transposed(), exact.G.transposed())
    assert rank(stacked(limit.basis, own)) == limit.dimension
    assert stacked(limit.F, limit.G).transposed() == limit.basis


def check_inversion(system: Json, seed: int = 0) -> None:
    """Delays against the existence of left inverses; these recover v(0); ambiguous words are silent."""
    exact = read(system)
    kernel = kernel_representation(exact)
    for known_state, delay in ((True, delay_known_state(kernel)), (False, delay_unknown_state(kernel))):
        for last in range(exact.n + 1):
            inverse = left_inverse(exact, last, known_state=known_state)
            word = ambiguous_word(exact, last + 1, known_state=known_state)
            assert (inverse is not None) == (delay is not None and last >= delay) == (word is None)
            if inverse is not None:
                rng = Random(seed)
                for _ in range(3):
                    x0 = Matrix.zero(exact.field, exact.n, 1) if known_state else random_matrix(rng, exact, exact.n, 1)
                    faults = random_matrix(rng, exact, last + 1, exact.m)
                    assert inverse @ _as_column(simulate(exact, x0, faults).residuals) == faults.rows([0]).transposed()
            if word is not None:
                assert word.v.shape == (last + 1, exact.m) and word.x0.shape == (exact.n, 1)
                assert not word.v.rows([0]).is_zero()
                assert simulate(exact, word.x0, word.v).residuals.is_zero()
                assert not known_state or word.x0.is_zero()


# -- two systems ------------------------------------------------------------------------------------------------------


def check_comparison(first: Json, second: Json) -> int | None:
    """`compare` against the oracle's first difference; inclusion on windows by ranks; words that separate. The difference."""
    one, two = kernel_representation(read(first)), kernel_representation(read(second))
    found = compare(one, two)
    assert found.first_difference == first_difference(first, second), (first, second)
    assert found.equivalent == (found.first_difference is None)
    check_separation(one, two, found.first_not_in_second)
    check_separation(two, one, found.second_not_in_first)
    mirrored = compare(two, one)
    assert mirrored.first_difference == found.first_difference
    return found.first_difference


def check_separation(inner: KernelRepresentation, outer: KernelRepresentation, found: Separation | None) -> None:
    """Ranks tell the inclusion of `inner` in `outer` on each window; where it ends, the word is one of inner and none of outer."""
    maker, other = inner.system, outer.system
    for s in range(maker.n + other.n + 2):
        wide = window_matrix(other, s)
        included = rank(beside(wide, window_matrix(maker, s))) == rank(wide)
        assert included == (found is None or s < found.window)
    if found is None:
        return
    assert found.v.shape == (found.window, maker.m) and found.window == found.row.degree + 1
    assert found.row in outer.rows
    outputs = simulate(maker, found.x0, found.v).residuals
    assert not (_side_by_side(found.row.coefficients) @ _as_column(outputs)).is_zero()
    wide = window_matrix(other, found.window)
    assert rank(beside(wide, _as_column(outputs))) == rank(wide) + 1


# -- pieces -----------------------------------------------------------------------------------------------------------


def _side_by_side(coefficients: Matrix) -> Matrix:
    """These are the rows of a matrix in one row: c_0, c_1, ... as the left factor of a window matrix."""
    return beside(*(coefficients.rows([k]) for k in range(coefficients.nrows)))


def _as_column(signal: Matrix) -> Matrix:
    """These are the samples of a time-major signal in one column."""
    return stacked(Matrix.zero(signal.field, 0, 1), *(signal.rows([k]).transposed() for k in range(signal.nrows)))


def _shifted_rows(kernel: KernelRepresentation, s: int) -> Matrix:
    """These are the kernel rows and their shifts as rows on s samples."""
    system = kernel.system
    rows = [Matrix.zero(system.field, 0, system.p * s)]
    for row in kernel.rows_within(s):
        flat = _side_by_side(row.coefficients)
        for shift in range(s - row.degree):
            before = Matrix.zero(system.field, 1, system.p * shift)
            after = Matrix.zero(system.field, 1, system.p * (s - row.degree - 1 - shift))
            rows.append(beside(before, flat, after))
    return stacked(*rows)


def _product(a: PolyMatrix, b: PolyMatrix, width: int) -> PolyMatrix:
    """The result is a b, where b has `width` columns (it may have no row that shows it)."""
    result: PolyMatrix = []
    for row in a:
        line: list[Poly] = []
        for j in range(width):
            entry: Poly = ()
            for x, other in zip(row, b, strict=True):
                entry = polynomials.add(entry, polynomials.multiply(x, other[j]))
            line.append(entry)
        result.append(line)
    return result


def _unit(size: int, one: Any) -> PolyMatrix:
    return [[(one,) if i == j else () for j in range(size)] for i in range(size)]


def _spread(form: SmithDiagonal, height: int, width: int) -> PolyMatrix:
    return [[form.diagonal[i] if i == j else () for j in range(width)] for i in range(height)]


SINGLE_CHECKS: Sequence[Any] = (
    check_report,
    check_window_ranks,
    check_kernel_rows,
    check_relations,
    check_finite_zeros,
    check_infinite_zeros,
    check_right_indices,
    check_diagonals,
    check_kronecker_sum,
    check_fault_spaces,
    check_inversion,
)
