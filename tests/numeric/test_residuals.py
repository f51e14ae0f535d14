"""The residual is tested: exact data leave nothing, faulty data leave the fault's own response, whatever the model's poles."""

import numpy as np
import pytest
from numpy.typing import ArrayLike

from faultspace.base.errors import InvalidData
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.model.residuals import FORWARD, residual, split
from faultspace.numeric.method.ranks.rank_gap import fault_dimension


def state_space(A: ArrayLike, B: ArrayLike, C: ArrayLike, D: ArrayLike) -> StateSpaceModel:
    return StateSpaceModel(*(np.asarray(matrix, dtype=np.float64) for matrix in (A, B, C, D)))


def model_with_radius(radius: float, seed: int = 0, n: int = 4, n_u: int = 2, p: int = 3) -> StateSpaceModel:
    random = np.random.default_rng(seed)
    A = random.standard_normal((n, n))
    A *= radius / np.max(np.abs(np.linalg.eigvals(A)))
    return StateSpaceModel(A, random.standard_normal((n, n_u)), random.standard_normal((p, n)), random.standard_normal((p, n_u)))


@pytest.mark.parametrize("radius", [0.3, 0.9, 0.999])
def test_exact_data_leave_rounding_and_the_initial_state(radius: float) -> None:
    model = model_with_radius(radius)
    random = np.random.default_rng(1)
    u, x0 = random.standard_normal((3000, 2)), random.standard_normal(4)
    y = model.simulate(u, x0)
    result = residual(y, u, model)
    assert np.max(np.abs(result.r)) <= 1e-10 * np.max(np.abs(y))
    assert np.allclose(result.x0, x0, rtol=0, atol=1e-10 * np.max(np.abs(y)))
    assert result.observed == 4 and result.backward == 0 and result.notes == ()


def test_growing_modes_run_backward() -> None:
    model = model_with_radius(1.3)
    growing = int(np.sum(np.abs(model.poles) > 1.01))
    assert growing > 0
    random = np.random.default_rng(2)
    u = random.standard_normal((400, 2))
    # A bounded trajectory, built by its own recursion: forward for the decaying coordinates, backward for the growing ones.
    values, vectors = np.linalg.eig(model.A)
    pushes = u @ np.linalg.solve(vectors, model.B.astype(complex)).T
    states = np.zeros((401, 4), dtype=complex)
    for i, value in enumerate(values):
        if abs(value) < 1.0:
            for k in range(400):
                states[k + 1, i] = value * states[k, i] + pushes[k, i]
        else:
            for k in range(399, -1, -1):
                states[k, i] = (states[k + 1, i] - pushes[k, i]) / value
    x = (states @ vectors.T).real
    y = x[:400] @ model.C.T + u @ model.D.T
    result = residual(y, u, model)
    assert result.backward == growing and "backward" in result.notes[0]
    assert np.max(np.abs(result.r)) <= 1e-11 * np.max(np.abs(y))
    assert np.allclose(result.x0, x[0], atol=1e-9)
    with pytest.raises(InvalidData, match="leave x0 out"):
        residual(y, u, model, x0=x[0])


def test_a_record_that_grows_itself_is_handled() -> None:
    model = model_with_radius(1.1, seed=3)
    random = np.random.default_rng(3)
    u, x0 = random.standard_normal((200, 2)), random.standard_normal(4)
    y = model.simulate(u, x0)
    result = residual(y, u, model)
    assert np.max(np.abs(y)) > 1e6 and result.backward > 0
    assert np.max(np.abs(result.r)) <= 1e-12 * np.max(np.abs(y))


def test_the_split_is_a_similarity() -> None:
    model = model_with_radius(1.3, seed=5)
    parts = split(model, 500)
    together = np.linalg.inv(parts.basis) @ model.A @ parts.basis
    ahead = parts.forward_model.n
    assert 0 < ahead < 4
    assert np.allclose(together[:ahead, ahead:], 0, atol=1e-10) and np.allclose(together[ahead:, :ahead], 0, atol=1e-10)
    assert np.allclose(together[ahead:, ahead:] @ parts.backward_model.A, np.eye(4 - ahead), atol=1e-10)


def test_given_state_is_used_as_given() -> None:
    model = model_with_radius(0.8)
    u = np.random.default_rng(4).standard_normal((100, 2))
    y = model.simulate(u, [1.0, 2.0, 3.0, 4.0])
    result = residual(y, u, model, x0=[1.0, 2.0, 3.0, 5.0])
    free = np.array([model.C @ np.linalg.matrix_power(model.A, k)[:, 3] for k in range(100)])
    assert np.allclose(result.r, -free, atol=1e-12)
    assert not result.x0_covariance.any()


def test_fault_dimension_survives_the_fitted_state() -> None:
    model = model_with_radius(0.8)
    random = np.random.default_rng(6)
    u, v = random.standard_normal((600, 2)), random.standard_normal((600, 1))
    F = random.standard_normal((4, 1))
    fault = StateSpaceModel(model.A, F, model.C, np.zeros((3, 1)))
    result = residual(model.simulate(u, [5.0, -5.0, 5.0, 0.0]) + fault.simulate(v), u, model)
    answer = fault_dimension(result.r)
    assert answer.n_v == 1 and answer.regime == "rounding"


def test_covariance_of_the_initial_state_is_the_scatter() -> None:
    model = state_space([[0.9, 0.2], [0.0, 0.7]], [[1.0], [1.0]], [[1.0, 0.0], [0.0, 1.0], [1.0, 1.0]], np.zeros((3, 1)))
    random = np.random.default_rng(7)
    squares = []
    for _ in range(150):
        u, e = random.standard_normal((300, 1)), random.standard_normal((301, 3))
        result = residual(model.simulate(u, [1.0, 2.0]) + e[1:] + 0.7 * e[:-1], u, model)
        error = result.x0 - [1.0, 2.0]
        squares.append(error @ np.linalg.solve(result.x0_covariance, error))
    # Mean of a chi-square of 2 degrees over 150 trials: 2 +- 0.16 (one deviation), plus what lags beyond the window would add.
    assert 1.4 < np.mean(squares) < 2.8
    assert np.allclose(result.covariance, 1.49 * np.eye(3), atol=0.45)


def test_states_that_the_record_does_not_show_stay_at_zero() -> None:
    model = state_space(np.diag([0.5, 0.9]), np.ones((2, 1)), [[1.0, 0.0]], [[0.0]])
    u = np.random.default_rng(8).standard_normal((50, 1))
    result = residual(model.simulate(u, [3.0, 7.0]), u, model)
    assert result.observed == 1 and "1 of 2" in result.notes[0]
    assert np.allclose(result.x0, [3.0, 0.0], atol=1e-12)


def test_no_state_at_all() -> None:
    model = state_space(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((1, 0)), [[2.0]])
    u = np.arange(10.0)
    result = residual(2.0 * u + 1.0, u, model)
    assert np.allclose(result.r, 1.0) and result.x0.shape == (0,)


def test_inputs_are_left_alone_and_any_real_type_is_read() -> None:
    model = model_with_radius(0.8)
    random = np.random.default_rng(9)
    y, u = random.integers(-9, 9, (80, 3)), random.integers(-9, 9, (80, 2))
    wide = np.zeros((160, 6), dtype=np.float32)
    wide[::2, ::2] = y
    y_kept, wide_kept = y.copy(), wide.copy()
    first, second = residual(y, u, model), residual(wide[::2, ::2], u, model)
    assert np.array_equal(first.r, second.r)
    assert np.array_equal(y, y_kept) and np.array_equal(wide, wide_kept)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda y, u: (np.where(y == y[5, 1], np.nan, y), u), "NaN at sample 5, channel 1"),
        (lambda y, u: (y[:-1], u), "equal numbers"),
        (lambda y, u: (y.T, u), "transposed"),
        (lambda y, u: (y[:, :2], u), "3 outputs"),
        (lambda y, u: (y, u[:, 0]), "2 inputs"),
        (lambda y, u: (y[:1], u[:1]), "cannot fix 4 initial states"),
    ],
)
def test_bad_data_are_refused_with_a_reason(change, says) -> None:  # type: ignore[no-untyped-def]
    model = model_with_radius(0.8)
    random = np.random.default_rng(10)
    y, u = random.standard_normal((50, 3)), random.standard_normal((50, 2))
    with pytest.raises(InvalidData, match=says):
        y, u = change(y, u)
        residual(y, u, model)


def test_a_given_state_is_simulated_forward_up_to_the_growth_that_is_said() -> None:
    samples, draw = 200, np.random.default_rng(11)
    y, u = draw.standard_normal((samples, 1)), draw.standard_normal((samples, 1))
    for growth, refused in ((0.9 * FORWARD, False), (1.1 * FORWARD, True), (1e200, True), (np.inf, True)):
        pole = growth ** (1 / samples) if np.isfinite(growth) else 1e10
        model = StateSpaceModel([[pole]], [[1.0]], [[1.0]], [[0.0]])
        if refused:
            with pytest.raises(InvalidData, match="1 mode"):
                residual(y, u, model, x0=[1.0])
        else:
            assert np.array_equal(residual([(y, u)], None, model, x0=[1.0]).r, y - model.simulate(u, [1.0]))


def test_pieces_are_read_as_the_array() -> None:
    model = model_with_radius(0.9)
    draw = np.random.default_rng(12)
    y, u = draw.standard_normal((500, 3)), draw.standard_normal((500, 2))
    pieces = [(y[:100], u[:100]), (y[100:101], u[100:101]), (y[101:], u[101:])]
    assert np.array_equal(residual(pieces, None, model).r, residual(y, u, model).r)
    assert np.allclose(residual(pieces, None, model, x0=np.ones(model.n)).r, residual(y, u, model, x0=np.ones(model.n)).r, atol=1e-12)
    with pytest.raises(InvalidData, match="3 outputs"):
        residual([*pieces, (y[:5, :2], u[:5])], None, model, x0=np.ones(model.n))
    with pytest.raises(InvalidData, match="only once"):
        residual(iter(pieces), None, model)
