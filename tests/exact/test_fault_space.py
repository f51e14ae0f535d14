"""Problem (11) is tested: windows and limit by definition, by a closed form and from data; pairs out of it.

closed_form     im [F; G] + [A; C] U + [U; 0], U = V* + S*, for left-invertible systems
"""

from __future__ import annotations

from random import Random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from faultspace.base.errors import InvalidInput
from faultspace.exact.algebra.fields import QQ, PrimeField
from faultspace.exact.algebra.matrices import Matrix, beside, column_basis, rank, row_echelon, stacked
from faultspace.exact.structure.behavior import compare
from faultspace.exact.structure.fault_columns import fault_space, fault_space_dimension, from_kernel_rows, with_pair
from faultspace.exact.structure.inversion import largest_output_nulling
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.structure.record import analyze
from faultspace.exact.structure.zero_output import chain_from_rest
from faultspace.exact.system.systems import ResidualSystem, read_system
from tests.exact import checks
from tests.oracle.families import FIELDS, adversarial, paper_example, shift_register
from tests.oracle.strategies import SEEDS, systems
from tests.thorough import examples

Json = Any
SOME = settings(max_examples=examples(50))
SEEN = ResidualSystem.of([[0]], [[1]], [[1], [0]], [[0], [1]])


def closed_form(system: ResidualSystem) -> Matrix:
    """These are basis rows of im [F; G] + [A; C] U + [U; 0]."""
    U = column_basis(beside(largest_output_nulling(system), chain_from_rest(system).last_subspace))
    columns = beside(
        stacked(system.F, system.G),
        stacked(system.A @ U, system.C @ U),
        stacked(U, Matrix.zero(system.field, system.p, U.ncols)),
    )
    return row_echelon(columns.transposed()).matrix


@pytest.mark.parametrize("field", list(FIELDS.values()), ids=list(FIELDS))
@settings(max_examples=examples(20))
@given(data=st.data())
def test_every_window(field: Json, data: st.DataObject) -> None:
    checks.check_fault_spaces(data.draw(systems(field=field)))


@settings(max_examples=examples(100))
@given(systems())
def test_the_closed_form(given: Json) -> None:
    found = analyze(checks.read(given))
    if found.left_invertible:
        assert closed_form(found.system) == found.fault_space.basis
        U = beside(largest_output_nulling(found.system), chain_from_rest(found.system).last_subspace)
        assert rank(U) == found.zeta


def test_the_closed_form_is_tried_on_zeros_of_both_kinds() -> None:
    """The named systems include left-invertible ones with finite and with infinite zeros."""
    kinds = set()
    for named in [*adversarial("Q").values(), paper_example()]:
        found = analyze(checks.read(named))
        if found.left_invertible:
            assert closed_form(found.system) == found.fault_space.basis
            kinds.add((found.finite_zeros > 0, sum(found.infinite_zero_orders) > 0))
    assert kinds >= {(False, False), (True, False), (False, True)}


@SOME
@given(systems(), SEEDS)
def test_some_basis_gives_back_the_system(given: Json, seed: int) -> None:
    """There is a P with [Fhat; Ghat] P = [F; G]: its rows stand at the pivots of the echelon form."""
    system = checks.read(given)
    kernel = kernel_representation(system)
    space = fault_space(kernel)
    P = stacked(system.F, system.G).rows(row_echelon(space.basis).pivots)
    assert with_pair(space, P) == system
    T = checks.random_matrix(Random(seed), system, system.m, system.m)
    assert compare(kernel, with_pair(space, P @ T)).equivalent or rank(T) < system.m


@SOME
@given(systems())
def test_members_one_by_one(given: Json) -> None:
    """z is in the space at window s iff adding it as a fault column makes no new word of s samples."""
    system = checks.read(given)
    kernel = kernel_representation(system)
    for s in (1, system.n, system.n + 1):
        space = fault_space(kernel, s)
        for i in range(system.n + system.p):
            unit = Matrix.identity(system.field, system.n + system.p).rows([i])
            f, g = unit.columns(range(system.n)), unit.columns(range(system.n, system.n + system.p))
            more = system.with_faults(beside(system.F, f.transposed()), beside(system.G, g.transposed()))
            member = rank(stacked(space.basis, unit)) == space.dimension
            assert member == (kernel_representation(more).rank(s) == kernel.rank(s))


def test_the_smallest_example() -> None:
    """At s = n = 1 every column is accepted, (5, 3, -2) too; from s = 2 on only multiples of (1, 0, 1)."""
    kernel = kernel_representation(SEEN)
    assert fault_space(kernel, 1).basis == Matrix.identity(QQ, 3)
    assert not fault_space(kernel, 1).is_limit and fault_space(kernel, 2).is_limit
    assert fault_space(kernel, 2).basis == Matrix.of([[1, 0, 1]])
    doubtful = with_pair(fault_space(kernel, 1), Matrix.of([[5], [3], [-2]]))
    assert not compare(kernel, doubtful).equivalent
    assert compare(kernel, with_pair(fault_space(kernel), Matrix.of([["-7/3"]]))).equivalent


@pytest.mark.parametrize("n", [1, 4, 12])
def test_no_window_up_to_n_is_enough(n: int) -> None:
    kernel = kernel_representation(checks.read(shift_register("Q", n)))
    assert [fault_space_dimension(kernel, s) for s in (0, n, n + 1)] == [n + 2, n + 2, 1]
    assert fault_space(kernel, n).exact_from == n + 1


def test_full_column_rank_is_not_enough() -> None:
    """A P of full column rank whose pair has a smaller normal rank makes no equivalent system."""
    system = ResidualSystem.of([[0]], [[1, 0]], [[1], [0]], [[0, 0], [0, 1]])
    kernel = kernel_representation(system)
    space = fault_space(kernel)
    assert space.dimension == 3  # zeta = 1 and p = r = 2: every column is accepted
    bad = with_pair(space, Matrix.of([[1, 0], [0, 1], [0, 0]]))
    assert rank(stacked(bad.F, bad.G)) == 2
    assert not compare(kernel, bad).equivalent
    assert kernel_representation(bad).normal_rank == 1


def test_no_row_asks_nothing() -> None:
    assert from_kernel_rows([], SEEN.A, SEEN.C) == Matrix.identity(QQ, 3)
    static = ResidualSystem.of([], [], [], [], n=0, m=0, p=0)
    assert fault_space(kernel_representation(static)).basis.shape == (0, 0)


@pytest.mark.parametrize("window", [-1, 1.0, "2", True])
def test_windows_that_are_none(window: Any) -> None:
    with pytest.raises(InvalidInput, match=r"^window: got .*, expected an integer >= 0$"):
        fault_space(kernel_representation(SEEN), window)


@pytest.mark.parametrize("P", [Matrix.of([[1], [2]]), Matrix.of([[1]], PrimeField(3))], ids=str)
def test_a_P_that_does_not_fit(P: Matrix) -> None:
    with pytest.raises(InvalidInput, match=r"^P: got .*, expected"):
        with_pair(fault_space(kernel_representation(SEEN)), P)


def test_P_may_be_nested_lists_and_a_system_may_have_inputs() -> None:
    """The pair of columns of full column rank that is not equivalent, from plain lists; B and D change nothing."""
    data = {"A": [["0"]], "F": [["1", "0"]], "C": [["1"], ["0"]], "G": [["0", "0"], ["0", "1"]]}
    plain, with_inputs = read_system(data), read_system(data | {"B": [["1"]], "D": [["0"], ["2"]]})
    kernel = kernel_representation(with_inputs)
    assert analyze(with_inputs).to_json() == analyze(plain).to_json()
    bad = with_pair(fault_space(kernel), [[1, 0], [0, 1], [0, 0]])
    assert bad == with_pair(fault_space(kernel), Matrix.of([[1, 0], [0, 1], [0, 0]]))
