"""The model is tested: simulation against the recursion written out, conversions, and what it refuses."""

import json
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace.base.errors import InvalidData
from faultspace.numeric.method.model.models import BLOCK, PIECE, Simulator, StateSpaceModel, observability_matrix

Array = NDArray[np.float64]


def model(n: int, n_u: int, p: int, seed: int = 0, radius: float = 0.9) -> StateSpaceModel:
    rng = np.random.default_rng(seed)
    A = rng.standard_normal((n, n))
    if n:
        A *= radius / np.abs(np.linalg.eigvals(A)).max()
    return StateSpaceModel(A, rng.standard_normal((n, n_u)), rng.standard_normal((p, n)), rng.standard_normal((p, n_u)))


def step_by_step(system: StateSpaceModel, u: Array, x0: Array) -> Array:
    y, x = np.empty((len(u), system.p)), x0
    for k, sample in enumerate(u):
        y[k] = system.C @ x + system.D @ sample
        x = system.A @ x + system.B @ sample
    return y


@pytest.mark.parametrize(("n", "n_u", "p"), [(1, 1, 1), (3, 2, 1), (4, 1, 3), (0, 2, 2)])
@pytest.mark.parametrize("samples", [1, BLOCK - 1, BLOCK, 3 * BLOCK + 5, PIECE + 7])
def test_simulation_is_the_recursion(n: int, n_u: int, p: int, samples: int) -> None:
    system, rng = model(n, n_u, p), np.random.default_rng(1)
    u, x0 = rng.standard_normal((samples, n_u)), rng.standard_normal(n)
    wanted = step_by_step(system, u, x0)
    assert np.allclose(system.simulate(u, x0), wanted, rtol=0, atol=1e-12 * (1 + np.abs(wanted).max()))
    assert np.allclose(system.simulate(u), step_by_step(system, u, np.zeros(n)), rtol=0, atol=1e-12 * (1 + np.abs(wanted).max()))


def test_a_simulator_goes_on_where_it_stopped() -> None:
    system, rng = model(3, 2, 2), np.random.default_rng(2)
    u = rng.standard_normal((500, 2))
    simulator = Simulator(system)
    parts = [simulator.respond(u[a:b]) for a, b in ((0, 1), (1, 200), (200, 200), (200, 500))]
    assert np.allclose(np.concatenate(parts), system.simulate(u), rtol=0, atol=1e-12)


def test_an_unstable_model_is_simulated_and_overflows_openly() -> None:
    system = StateSpaceModel([[2.0]], [[1.0]], [[1.0]], [[0.0]])
    y = system.simulate(np.ones(2000))
    assert np.array_equal(y[:5, 0], [0, 1, 3, 7, 15])
    assert not np.isfinite(y[-1, 0])
    assert not system.is_stable


def test_markov_parameters_are_the_impulse_response() -> None:
    system = model(4, 2, 3)
    for channel in range(2):
        pulse = np.zeros((12, 2))
        pulse[0, channel] = 1
        assert np.allclose(system.markov(12)[:, :, channel], system.simulate(pulse), atol=1e-13)
    assert system.markov(0).shape == (0, 3, 2)


def test_the_observability_matrix_stacks_powers() -> None:
    system = model(3, 1, 2)
    stacked = [system.C @ np.linalg.matrix_power(system.A, k) for k in range(5)]
    assert np.allclose(observability_matrix(system.A, system.C, 5), np.concatenate(stacked))


def test_poles_come_by_falling_modulus() -> None:
    system = StateSpaceModel(np.diag([0.1, -0.9, 0.5]), np.ones((3, 1)), np.ones((1, 3)), [[0]])
    assert np.allclose(system.poles, [-0.9, 0.5, 0.1])
    assert system.is_stable
    assert not StateSpaceModel([[1.0]], [[1.0]], [[1.0]], [[0.0]]).is_stable


def test_json_keeps_every_bit() -> None:
    for sizes in ((4, 2, 3), (0, 1, 2), (1, 1, 1)):
        system = model(*sizes)
        record = json.loads(json.dumps(system.to_json()))
        again = StateSpaceModel.from_json(record)
        assert record["format"] == "faultspace-model/1"
        assert all(np.array_equal(getattr(again, name), getattr(system, name)) for name in "ABCD")


def test_json_of_another_shape_is_refused() -> None:
    record = model(2, 1, 1).to_json()
    bad: list[tuple[Any, str]] = [
        (record | {"format": "faultspace-model/2"}, "faultspace-model/1"),
        ([1], "faultspace-model/1"),
        ({key: value for key, value in record.items() if key != "C"}, "lacks C"),
        (record | {"n": 3}, "do not fit"),
        (record | {"B": [["x"], [1]]}, "do not fit"),
        (record | {"D": [[float("nan")]]}, "D has entries that are NaN"),
    ]
    for wrong, words in bad:
        with pytest.raises(InvalidData, match=words):
            StateSpaceModel.from_json(wrong)


def test_matrices_are_copied_checked_and_read_only() -> None:
    A = np.eye(2) / 2
    system = StateSpaceModel(A, np.ones((2, 1)), np.ones((1, 2)), [[0]])
    A[0, 0] = 7
    assert system.A[0, 0] == 0.5
    with pytest.raises(ValueError, match="read-only"):
        system.A[0, 0] = 1
    with pytest.raises(InvalidData, match=r"B has shape \(3, 1\)"):
        StateSpaceModel(A, np.ones((3, 1)), np.ones((1, 2)), [[0]])
    with pytest.raises(InvalidData, match="two axes"):
        StateSpaceModel(A, [1, 1], np.ones((1, 2)), [[0]])
    with pytest.raises(InvalidData, match="NaN or infinite"):
        StateSpaceModel(np.full((2, 2), np.inf), np.ones((2, 1)), np.ones((1, 2)), [[0]])
    with pytest.raises(InvalidData, match="real numbers"):
        StateSpaceModel([["a"]], [[1]], [[1]], [[0]])


def test_simulation_refuses_what_does_not_fit() -> None:
    system = model(2, 2, 1)
    with pytest.raises(InvalidData, match=r"transposed: pass u\.T"):
        system.simulate(np.zeros((2, 9)))
    with pytest.raises(InvalidData, match="the model 2 inputs"):
        system.simulate(np.zeros((9, 3)))
    with pytest.raises(InvalidData, match="x0 must be 2 finite numbers"):
        system.simulate(np.zeros((9, 2)), [1.0])
    late = np.zeros((40_000, 2))
    late[39_000, 1] = np.inf
    with pytest.raises(InvalidData, match="infinite at sample 39000, channel 1"):
        system.simulate(late)
    with pytest.raises(InvalidData, match="NaN at sample 4"):
        system.simulate(np.where(np.arange(9)[:, np.newaxis] == 4, np.nan, np.zeros((9, 2))))


def test_scipy_simulates_the_same() -> None:
    from scipy.signal import dlsim

    system, rng = model(3, 2, 2), np.random.default_rng(5)
    u = rng.standard_normal((50, 2))
    _, y, _ = dlsim(system.to_scipy(), u)
    assert np.allclose(y, system.simulate(u), atol=1e-12)


def test_control_gets_the_matrices_or_the_reader_a_way_to_it() -> None:
    system = model(3, 2, 2)
    try:
        converted = system.to_control()
    except ImportError as error:
        assert "pip install control" in str(error)
        return
    assert np.array_equal(converted.A, system.A)
    assert np.array_equal(converted.D, system.D)
    assert converted.dt is True
