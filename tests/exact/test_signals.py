"""Trajectories are compared with the recursion by hand, Hankel matrices entry by entry, and what data say with what the model says."""

from __future__ import annotations

from random import Random
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from faultspace.base.errors import InvalidInput
from faultspace.exact.algebra.fields import PrimeField
from faultspace.exact.algebra.matrices import Matrix, rank
from faultspace.exact.structure.fault_columns import fault_space
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.structure.record import analyze
from faultspace.exact.structure.signals import Trajectory, data_fault_space, excitation_matrix, hankel, persistency, simulate
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import window_matrix
from tests.exact import checks
from tests.oracle.behaviours import excitation, residual_hankel
from tests.oracle.strategies import SEEDS, systems
from tests.oracle.systems import parse_system, trajectory
from tests.thorough import examples

Json = Any
SOME = settings(max_examples=examples(50))
SEEN = ResidualSystem.of([[0]], [[1]], [[1], [0]], [[0], [1]])


def excited(given: ResidualSystem, seed: int, samples: int) -> Trajectory:
    """The result is a random trajectory."""
    rng = Random(seed)
    return simulate(given, checks.random_matrix(rng, given, given.n, 1), checks.random_matrix(rng, given, samples, given.m))


@SOME
@given(systems(), SEEDS, st.integers(0, 6))
def test_the_recursion_by_hand(given: Json, seed: int, samples: int) -> None:
    exact, slow = checks.read(given), parse_system(given)
    found = excited(exact, seed, samples)
    assert found.states.shape == (samples + 1, exact.n)
    assert found.faults.shape == (samples, exact.m) and found.residuals.shape == (samples, exact.p)

    def parsed(rows: Any) -> Any:
        return [[slow.field.parse(x) for x in row] for row in rows]

    x0, v = parsed(found.states.rows([0]).to_json())[0], parsed(found.faults.to_json())
    states, outputs = trajectory(slow, x0, v)
    assert [list(x.entries()) for x in states] == parsed(found.states.to_json())
    assert [list(r.entries()) for r in outputs] == parsed(found.residuals.to_json())
    for s in range(samples + 1):
        assert hankel(found.residuals, s) == checks.as_exact(residual_hankel(slow, x0, v, s), exact.field)
        assert excitation_matrix(found, s) == checks.as_exact(excitation(slow, x0, v, s), exact.field)


@SOME
@given(systems(), SEEDS)
def test_the_factorisation(given: Json, seed: int) -> None:
    """The Hankel matrix is the product R_s = [O_s T_s] [X; V_s]."""
    exact = checks.read(given)
    found = excited(exact, seed, 6)
    for s in range(5):
        assert hankel(found.residuals, s) == window_matrix(exact, s) @ excitation_matrix(found, s)


@settings(max_examples=examples(40))
@given(systems(), SEEDS)
def test_data_say_what_the_model_says(given: Json, seed: int) -> None:
    """Where [X; V_s] has full row rank: rank R_s = rank [O_s T_s], and problem (11) from data is the one of the model."""
    exact = checks.read(given)
    kernel = kernel_representation(exact)
    longest = exact.n + 2
    found = excited(exact, seed, exact.n + exact.m * longest + longest + 8)
    matrix = excitation_matrix(found, longest)
    assume(rank(matrix) == matrix.nrows)
    for s in range(longest + 1):
        assert rank(hankel(found.residuals, s)) == kernel.rank(s)
        assert data_fault_space(found.residuals, exact.A, exact.C, s) == fault_space(kernel, s).basis


@settings(max_examples=examples(40))
@given(systems(), SEEDS)
def test_a_persistently_exciting_fault_excites_everything(given: Json, seed: int) -> None:
    """(A, F) controllable and v persistently exciting of order n + s: [X; V_s] has full row rank [WRMM05]."""
    exact = checks.read(given)
    found = excited(exact, seed, 12 + 6 * exact.m)
    order = persistency(found.faults)
    assume(order > exact.n and analyze(exact).controllable)
    matrix = excitation_matrix(found, order - exact.n)
    assert rank(matrix) == matrix.nrows


@pytest.mark.parametrize("prime", [2, 3, 7])
@SOME
@given(data=st.data())
def test_persistency_is_the_largest_full_rank(prime: int, data: st.DataObject) -> None:
    field = PrimeField(prime)
    width = data.draw(st.integers(0, 2))
    samples = data.draw(st.lists(st.lists(st.integers(0, prime - 1), min_size=width, max_size=width), max_size=9))
    signal = Matrix.of(samples, field, shape=(len(samples), width))
    full = [rank(hankel(signal, s)) == width * s for s in range(len(samples) + 1)]
    assert full[persistency(signal)] and not any(full[persistency(signal) + 1 :])


@pytest.mark.parametrize(
    "samples, order",
    [
        ([[1], [1], [1], [1], [1]], 1),
        ([[1], [2], [4], [8], [16]], 1),
        ([[0], [0], [0]], 0),
        ([[0], [0], [1], [0], [0]], 3),
        ([[1, 1], [2, 2], [5, 5]], 0),
        ([], 0),
    ],
)
def test_known_orders(samples: list[list[int]], order: int) -> None:
    """Constant and geometric signals have order one, two equal channels none."""
    assert persistency(Matrix.of(samples, shape=(len(samples), len(samples[0]) if samples else 1))) == order


def test_a_constant_fault_breaks_the_gap() -> None:
    """rank R_s stops growing under v = 1, though the behaviour does not."""
    dull = simulate(SEEN, Matrix.of([[3]]), Matrix.of([[1]] * 12))
    assert [rank(hankel(dull.residuals, s)) for s in (1, 2, 3)] == [2, 2, 2]
    assert [kernel_representation(SEEN).rank(s) for s in (1, 2, 3)] == [2, 3, 4]


def test_hankel_entries() -> None:
    signal = Matrix.of([[1, 2], [3, 4], [5, 6]])
    assert hankel(signal, 2) == Matrix.of([[1, 3], [2, 4], [3, 5], [4, 6]])
    assert hankel(signal, 0).shape == (0, 4) and hankel(signal, 3).shape == (6, 1)


@pytest.mark.parametrize(("s", "why"), [(-1, ", expected an integer >= 0"), (4, " with 3 samples, expected 0 <= window <= samples")])
def test_windows_that_do_not_fit(s: int, why: str) -> None:
    with pytest.raises(InvalidInput, match=f"^window: got {s}{why}$"):
        hankel(Matrix.of([[1], [2], [3]]), s)


@pytest.mark.parametrize("x0, v", [([[1], [2]], [[1]]), ([[1]], [[1, 2]]), ([[1, 1]], [[1]])])
def test_signals_that_do_not_fit(x0: Any, v: Any) -> None:
    with pytest.raises(InvalidInput, match=r"^x0, v: got .*, expected \(1, 1\) and \(N, 1\)$"):
        simulate(SEEN, Matrix.of(x0), Matrix.of(v))
