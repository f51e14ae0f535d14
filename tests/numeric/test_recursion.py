"""A linear recursion by products against the loop, and the few coordinates that tell its states against the powers written out."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace.numeric.method.model import recursion
from faultspace.numeric.method.model.input_matrices import by_output_error
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.model.recursion import GROUP, Recursion, power_basis

Array = NDArray[np.float64]
HARD = ("integrators", "far from normal")  # rounding may cost them the short basis
RNG = np.random.default_rng(11)
TURNED = np.linalg.qr(RNG.standard_normal((4, 4)))[0]
CLUSTER = np.diag([0.999999, 0.999999 - 1e-7, 0.5, -0.5])
MATRICES = {
    "random": 0.4 * RNG.standard_normal((5, 5)),
    "one state": np.array([[0.7]]),
    "derogatory": TURNED @ np.diag([0.5, 0.5, 0.5, -0.2]) @ TURNED.T,
    "a multiple of I": 0.9 * np.eye(3),
    "zero": np.zeros((3, 3)),
    "Jordan block": 0.8 * np.eye(6) + np.eye(6, k=1),
    "nilpotent": np.eye(4, k=1),
    "poles near each other": TURNED @ CLUSTER @ TURNED.T,
    "integrators": np.eye(4) + np.triu(np.ones((4, 4)), 1),
    "many states": 0.19 * RNG.standard_normal((24, 24)),
    "far from normal": np.diag(np.linspace(0.1, 0.9, 5)) + np.triu(100.0 * RNG.standard_normal((5, 5)), 1),
    "no states": np.zeros((0, 0)),
}


def by_loop(H: Array, pushes: Array, start: Array) -> Array:
    """Return all states, one step after the other."""
    states = [start]
    for push in pushes:
        states.append(states[-1] @ H.T + push)
    return np.stack(states)


@pytest.mark.parametrize("count", [0, 1, GROUP, 2 * GROUP - 1, 2 * GROUP, 2 * GROUP + 3, 40 * GROUP + 1])
def test_states_are_those_of_the_loop(count: int) -> None:
    H, pushes, start = 0.4 * RNG.standard_normal((3, 3)), RNG.standard_normal((count, 2, 3)), RNG.standard_normal((2, 3))
    wanted = by_loop(H, pushes, start)
    assert np.allclose(Recursion(H).states(pushes, start), wanted, rtol=0, atol=1e-13 * np.abs(wanted).max())


@pytest.mark.parametrize("name", MATRICES)
def test_the_coordinates_tell_every_power(name: str) -> None:
    A = MATRICES[name]
    basis = power_basis(A)
    n, d = len(A), len(basis.H)
    assert d <= n or name in HARD
    assert np.allclose(np.einsum("ajk,bjk->ab", basis.matrices, basis.matrices), np.eye(d), atol=1e-10)
    coordinates, power, largest = basis.identity, np.eye(n), 0.0
    for _ in range(300):
        told = np.tensordot(coordinates, basis.matrices, axes=1)
        largest = max(largest, np.abs(power).max(initial=0.0))
        assert np.allclose(told, power, rtol=0, atol=1e-12 * largest)
        coordinates, power = basis.H @ coordinates, A @ power


def test_where_the_basis_does_not_close_all_entries_are_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    A = MATRICES["random"]
    monkeypatch.setattr(recursion, "EPS", 0.0)
    basis = power_basis(A)
    assert len(basis.H) == 25
    coordinates = basis.H @ basis.H @ basis.identity
    assert np.allclose(np.tensordot(coordinates, basis.matrices, axes=1), A @ A)


@pytest.mark.parametrize("radius", [1.3, 2.0, 1e90])
def test_powers_that_leave_all_numbers_are_no_overflow(radius: float) -> None:
    """They are compared as far as they can be. A study of short records meets models so unstable, and squares of their powers overflow."""
    with np.errstate(all="raise", under="ignore"):
        basis = power_basis(radius * np.array([[1.0, 1.0], [0.0, -0.9]]))
    assert len(basis.H) == 2


@pytest.mark.parametrize("name", [name for name in MATRICES if name not in ("far from normal", "many states", "no states")])
def test_output_error_and_what_it_leaves_are_least_squares_written_out(name: str) -> None:
    A = MATRICES[name]
    n, n_u, p, samples = len(A), 2, 3, 203
    C, u, y = RNG.standard_normal((p, n)), RNG.standard_normal((samples, n_u)), RNG.standard_normal((samples, p))
    starts = [StateSpaceModel(A, np.zeros((n, n_u)), C, np.zeros((p, n_u))).simulate(u, x).ravel() for x in np.eye(n)]
    units = np.eye((n + p) * n_u).reshape(-1, n + p, n_u)
    columns = np.stack([*starts, *(StateSpaceModel(A, unit[:n], C, unit[n:]).simulate(u).ravel() for unit in units)], axis=1)
    fitted = columns @ np.linalg.lstsq(columns, y.ravel(), rcond=1e-13)[0]
    wanted = y - fitted.reshape(y.shape)
    found = by_output_error([[(y[:50], u[:50]), (y[50:], u[50:])]], A, C, n_u)
    left = y - StateSpaceModel(A, found.B, C, found.D).simulate(u, found.initial_states[0])
    size = float(np.linalg.norm(columns, axis=0).max() / np.linalg.norm(columns, axis=0).min())
    assert found.squares is not None
    assert np.allclose(found.squares, wanted.T @ wanted, rtol=0, atol=1e-11 * size * np.sum(y**2))
    assert np.allclose(left.T @ left, found.squares, rtol=0, atol=1e-11 * size * np.sum(y**2))


def test_a_wrong_recursion_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    true_states: Any = Recursion.states
    monkeypatch.setattr(Recursion, "states", lambda self, pushes, start: true_states(self, np.roll(pushes, 1, 0), start))
    with pytest.raises(AssertionError):
        test_output_error_and_what_it_leaves_are_least_squares_written_out("random")
