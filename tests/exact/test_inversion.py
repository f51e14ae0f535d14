"""Left inverses recover v(0), ambiguous words are silent, and the two delays are what these say."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from faultspace.exact.algebra.matrices import Matrix, beside, column_basis, rank, right_null_space, stacked
from faultspace.exact.structure.inversion import (
    ambiguous_word,
    delay_known_state,
    delay_unknown_state,
    largest_output_nulling,
    left_inverse,
)
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.structure.record import analyze
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import observability_matrix, window_matrix
from tests.exact import checks
from tests.oracle.families import FIELDS, delay_line, shift_register
from tests.oracle.strategies import SEEDS, systems
from tests.thorough import examples

Json = Any


@pytest.mark.parametrize("field", list(FIELDS.values()), ids=list(FIELDS))
@settings(max_examples=examples(20))
@given(data=st.data())
def test_delays_inverses_and_words(field: Json, data: st.DataObject) -> None:
    checks.check_inversion(data.draw(systems(field=field)), data.draw(SEEDS))


@settings(max_examples=examples(80))
@given(systems())
def test_when_there_is_a_delay(given: Json) -> None:
    """Known state: r = m, and the delay is the largest infinite order. Unknown: r = m and n_f = n - rank O_n."""
    found = analyze(checks.read(given))
    system = found.system
    if found.left_invertible:
        assert found.delay_known_state == max(found.infinite_zero_orders, default=0)
    else:
        assert found.delay_known_state is None
    unobserved = system.n - rank(observability_matrix(system, system.n))
    exists = found.left_invertible and (found.finite_zeros == unobserved or system.m == 0)
    assert (found.delay_unknown_state is not None) == exists
    if exists:
        assert found.delay_unknown_state is not None and found.delay_known_state is not None
        assert found.delay_unknown_state >= found.delay_known_state


@settings(max_examples=examples(60))
@given(systems())
def test_the_largest_output_nulling_subspace(given: Json) -> None:
    """The states from which zero output is possible: ker of [O_s T_s] projected to the state, s = n or more."""
    system = checks.read(given)
    silent = right_null_space(window_matrix(system, system.n + 1)).rows(range(system.n))
    V = largest_output_nulling(system)
    assert column_basis(silent) == V
    # [A; C] V is within [V; 0] + im [F; G]
    target = beside(stacked(V, Matrix.zero(system.field, system.p, V.ncols)), stacked(system.F, system.G))
    assert rank(beside(target, stacked(system.A @ V, system.C @ V))) == rank(target)


@pytest.mark.parametrize("n", [1, 2, 5])
def test_known_delays(n: int) -> None:
    line = kernel_representation(checks.read(delay_line("Q", n)))
    register = kernel_representation(checks.read(shift_register("Q", n)))
    assert (delay_known_state(line), delay_unknown_state(line)) == (n, n)
    assert (delay_known_state(register), delay_unknown_state(register)) == (0, 0)
    inverse = left_inverse(line.system, n, known_state=False)
    assert inverse == Matrix.of([[0] * n + [1]])
    assert left_inverse(line.system, n - 1, known_state=True) is None


def test_a_finite_zero_hides_the_fault_unless_the_state_is_known() -> None:
    """A = 2, F = C = G = 1: from x(0) = 1, v(k) = -x(k) is silent; from rest nothing is."""
    kernel = kernel_representation(ResidualSystem.of([[2]], [[1]], [[1]], [[1]]))
    assert (delay_known_state(kernel), delay_unknown_state(kernel)) == (0, None)
    word = ambiguous_word(kernel.system, 9, known_state=False)
    assert word is not None and word.x0 == -word.v.rows([0])
    assert ambiguous_word(kernel.system, 9, known_state=True) is None


@pytest.mark.parametrize("known_state", [True, False])
def test_no_sample_has_no_word(known_state: bool) -> None:
    """Without samples there is no v(0) to be ambiguous."""
    assert ambiguous_word(ResidualSystem.of([[0]], [[0]], [[0]], [[0]]), 0, known_state=known_state) is None
    word = ambiguous_word(ResidualSystem.of([[0]], [[0]], [[0]], [[0]]), 1, known_state=known_state)
    assert word is not None and not word.v.is_zero()
