"""What the reduction computes, one at a time: derivatives, normal equations, coordinates, descent."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from faultspace.base.arrays import Array
from faultspace.numeric.method.model.invariants import (
    half_transfers,
    markov_jacobian,
    off_gauge,
    pole_jacobian,
    state_space,
    system_matrix,
    transfer,
    transfer_jacobian,
)
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.model.uncertainty import uncertainty_of
from faultspace.numeric.method.model.weighted_reduction import Reduction, balanced, circle, descend, ladder, spectral_radius

N_STATES = 3


def model(seed: int = 0, n: int = N_STATES, p: int = 2, n_u: int = 2) -> StateSpaceModel:
    rng = np.random.default_rng(seed)
    A = rng.standard_normal((n, n))
    return StateSpaceModel(0.8 * A / max(spectral_radius(A), 1e-9), *(rng.standard_normal(s) for s in ((n, n_u), (p, n), (p, n_u))))


def problem(plant: StateSpaceModel, count: int = 40, seed: int = 1) -> Reduction:
    rng, angles = np.random.default_rng(seed), circle(count)

    def positive(size: int) -> Array:
        root = rng.standard_normal((count, size, size)) + 1j * rng.standard_normal((count, size, size))
        return np.asarray(root @ np.conj(np.swapaxes(root, 1, 2)))

    return Reduction(angles, half_transfers(system_matrix(plant), plant.n, angles)[0], positive(plant.p), positive(plant.n_u), 100)  # type: ignore[arg-type]


def by_differences(function: Callable[[Array], Any], matrix: Array, step: float = 1e-6) -> Any:
    """Return the Jacobian of a function of T by central differences."""
    columns = []
    for entry in range(matrix.size):
        change = np.zeros(matrix.size)
        change[entry] = step
        moved = change.reshape(matrix.shape)
        columns.append((function(matrix + moved) - function(matrix - moved)).ravel() / (2 * step))
    return np.array(columns).T


@pytest.mark.parametrize("sizes", [(3, 2, 2), (1, 1, 1), (4, 3, 1), (0, 2, 1), (2, 1, 3)])
def test_derivatives_of_invariants(sizes: tuple[int, int, int]) -> None:
    n, p, n_u = sizes
    T, angles = system_matrix(model(5, n, p, n_u)), np.array([0.3, 1.0, 3.0])
    assert np.allclose(markov_jacobian(T, n, 6), by_differences(lambda t: state_space(t, n).markov(6), T), atol=1e-7)
    assert np.allclose(transfer_jacobian(T, n, angles), by_differences(lambda t: half_transfers(t, n, angles)[0], T), atol=1e-6)
    poles, slopes = pole_jacobian(T, n)
    assert np.allclose(poles, state_space(T, n).poles)
    assert np.allclose(slopes, by_differences(lambda t: state_space(t, n).poles, T), atol=1e-6)


def test_the_gauge_changes_no_invariant_and_nothing_else_does() -> None:
    T = system_matrix(model(2))
    across = off_gauge(T, N_STATES)
    assert across.shape == (T.size, T.size - N_STATES**2) and np.allclose(across.T @ across, np.eye(across.shape[1]))
    jacobian = markov_jacobian(T, N_STATES, 12)
    along = np.eye(T.size) - across @ across.T
    assert np.linalg.norm(jacobian @ along) < 1e-12 * np.linalg.norm(jacobian)
    assert np.linalg.matrix_rank(jacobian @ across) == across.shape[1]


def test_normal_equations_are_those_of_the_residuals() -> None:
    plant, at = model(3), system_matrix(model(4))
    reduction = problem(plant)
    left, right = np.linalg.cholesky(reduction.weight), np.linalg.cholesky(reduction.spectrum)

    def residuals(T: Array) -> Array:
        error = reduction.plant - half_transfers(T, N_STATES, reduction.angles)[0]
        whitened = np.sqrt(reduction.samples / len(reduction.angles)) * np.conj(np.swapaxes(left, 1, 2)) @ error @ right
        return np.concatenate([whitened.real.ravel(), whitened.imag.ravel()])

    hessian, slope, cost = reduction.normal_equations(at, N_STATES)
    jacobian = by_differences(residuals, at)
    assert cost == pytest.approx(float(residuals(at) @ residuals(at))) == reduction.cost(at, N_STATES)
    assert np.allclose(hessian, jacobian.T @ jacobian, rtol=1e-6, atol=1e-6 * np.abs(hessian).max())
    assert np.allclose(slope, -jacobian.T @ residuals(at), rtol=1e-6, atol=1e-6 * np.abs(slope).max())
    assert np.array_equal(reduction.information(at, N_STATES), hessian) or np.allclose(
        reduction.information(at, N_STATES), hessian, rtol=1e-10
    )


def test_input_matrices_of_the_true_a_and_c_are_the_true_ones() -> None:
    plant = model(6)
    found = problem(plant).input_matrices(plant.A, plant.C)
    assert np.allclose(found, system_matrix(plant), atol=1e-9)


def test_balanced_coordinates_have_equal_diagonal_gramians() -> None:
    plant = model(7)
    found = state_space(balanced(system_matrix(plant), N_STATES), N_STATES)
    assert np.allclose(found.markov(10), plant.markov(10), atol=1e-10)
    powers = [np.linalg.matrix_power(found.A, k) for k in range(400)]
    reach = sum(power @ found.B @ found.B.T @ power.T for power in powers)
    observe = sum(power.T @ found.C.T @ found.C @ power for power in powers)
    assert np.allclose(reach, observe, atol=1e-8) and np.allclose(reach, np.diag(np.diag(reach)), atol=1e-8)


def test_a_model_that_cannot_be_balanced_stays_as_it_is() -> None:
    for A in (np.diag([0.5, 0.5]), np.diag([1.0, 0.5])):
        T = system_matrix(StateSpaceModel(A, [[1.0], [1.0]], [[1.0, 0.0]], [[0.0]]))
        assert np.all(np.isfinite(balanced(T, 2)))
    assert balanced(np.ones((2, 1)), 0).tolist() == [[1.0], [1.0]]


def test_descent_finds_the_plant_again_and_never_leaves_stability() -> None:
    plant = model(8)
    reduction = problem(plant)
    T = system_matrix(plant)
    moved = T + 0.02 * np.random.default_rng(0).standard_normal(T.shape)
    found, cost = descend(reduction, moved, N_STATES, 100, 1e-12)
    assert cost < 1e-12 * reduction.cost(moved, N_STATES)
    assert np.allclose(state_space(found, N_STATES).markov(10), plant.markov(10), atol=1e-6)
    unstable = StateSpaceModel(plant.A * 1.5, plant.B, plant.C, plant.D)
    found, _ = descend(problem(unstable), T, N_STATES, 60, 1e-9)
    assert spectral_radius(found[:N_STATES, :N_STATES]) < 1


def test_the_ladder_goes_from_the_mean_power_down_to_the_weight_itself() -> None:
    plant = model(9)
    spectrum = np.array([np.diag([1.0, 1e-6]) for _ in range(40)], dtype=complex)
    true = Reduction(circle(40), problem(plant).plant, np.linalg.inv(spectrum), problem(plant).spectrum, 100)
    rungs = list(ladder(true, spectrum))
    ranges = [float(np.linalg.cond(rung.weight).max()) for rung in rungs]
    assert rungs[-1] is true and ranges == sorted(ranges) and ranges[0] < 100 and len(rungs) == 4


def test_what_is_not_determined_has_a_huge_deviation() -> None:
    plant = StateSpaceModel(np.diag([0.5, 0.2]), [[1.0], [1.0]], [[1.0, 0.0]], [[0.0]])
    count = system_matrix(plant).size
    assert np.all(uncertainty_of(plant, np.zeros((count, count))).markov(3) > 1e100)
    assert np.all(uncertainty_of(plant, np.eye(count)).markov(3) < 10)


@pytest.mark.parametrize("n", [0, 1, 4])
def test_the_transfer_function_alone_is_that_of_the_half_transfers(n: int) -> None:
    matrix = 0.3 * np.random.default_rng(n).standard_normal((n + 3, n + 2))
    angles = np.linspace(0.01, 3.1, 40)
    assert np.allclose(transfer(matrix, n, angles), half_transfers(matrix, n, angles)[0], rtol=1e-12, atol=1e-13)
