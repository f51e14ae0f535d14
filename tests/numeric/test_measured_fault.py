"""A known additive fault injected into measured data that nobody here made is found, and nothing is found where none was injected.

The flexible structure of DaISy (B. De Moor, ed., ESAT/STADIUS, KU Leuven) as kept by SLICOT: 2 shakers, 28 accelerometers. The variable
FAULTSPACE_DATA names the folder. The first half of the record is taken as healthy, the fault sets in at its middle; the model is
identified from the whole record, fault included, with past inputs as instruments.
"""

import os
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import scipy.signal
from numpy.typing import NDArray

from faultspace.numeric.method.model.moesp_model import MoespModel
from faultspace.numeric.method.model.past_inputs import pi_moesp
from faultspace.numeric.method.model.residuals import residual
from faultspace.numeric.plant.healthy.against_healthy import fault_dimension_against_healthy, fault_direction_against_healthy
from faultspace.numeric.plant.healthy.healthy_model import healthy_reference

Array = NDArray[np.float64]
FOLDER = os.environ.get("FAULTSPACE_DATA")
pytestmark = pytest.mark.skipif(FOLDER is None, reason="FAULTSPACE_DATA does not name the folder of measured records")
ORDER, BLOCK_ROWS = 34, 30


def record() -> tuple[Array, Array]:
    """Return y (N, 28) and u (N, 2), means removed."""
    from scipy.io import loadmat

    assert FOLDER is not None
    contents = {key: value for key, value in loadmat(Path(FOLDER) / "flexible_structure_dat.mat").items() if not key.startswith("_")}
    (table,) = contents.values()
    table = table.astype(np.float64)
    table = table - table.mean(axis=0)
    return np.asarray(table[:, 2:]), np.asarray(table[:, :2])


def fault(samples: int, first: int, pole: float, seed: int) -> Array:
    """Return coloured noise of unit power from sample `first` on, zero before."""
    v: Array = scipy.signal.lfilter([1.0], [1.0, -pole], np.random.default_rng(seed).standard_normal(samples))
    v[:first] = 0.0
    return np.asarray(v / v[first:].std())


def identified(y: Array, u: Array) -> tuple[MoespModel, Array]:
    """Return the model from the record itself and its residual."""
    found = pi_moesp(y, u, order=ORDER, block_rows=BLOCK_ROWS)
    return found, residual(y, u, found.model).r


@cache
def identified_as_measured() -> tuple[MoespModel, Array]:
    """Return the model from the record without an injected fault, and its residual."""
    return identified(*record())


def sine(a: Array, b: Array) -> float:
    """Return the sine of the angle between two directions."""
    a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
    return float(np.linalg.norm(a - b * (a @ b)))


def output_direction(seed: int, y: Array) -> Array:
    """Return a random direction over the outputs, each in proportion to its size: v of unit power adds that much to each on average."""
    G = np.random.default_rng(seed).standard_normal(y.shape[1])
    return np.asarray(y.std(axis=0) * G / np.sqrt(np.mean(G**2)))


# Level of the fault below the outputs, and the largest sine of the angle and the least correlation that it must be found with: about twice
# the error seen, far below those of a random direction (a sine of .98) and of no fault (a correlation of .06).
LEVELS = [
    pytest.param(0.1, 0.02, 0.99, marks=pytest.mark.slow),
    pytest.param(0.01, 0.03, 0.98, marks=pytest.mark.slow),
    (0.003, 0.1, 0.9),  # the smallest is the hardest
]


@pytest.mark.parametrize(("level", "largest_sine", "least_correlation"), LEVELS)
def test_one_injected_fault_is_counted_located_and_read(level: float, largest_sine: float, least_correlation: float) -> None:
    y, u = record()
    half = len(y) // 2
    v, G = fault(len(y), half, 0.8, 1), output_direction(2, y)
    _, r = identified(y + level * v[:, np.newaxis] * G, u)
    healthy = healthy_reference(r[:half], u[:half])
    answer = fault_dimension_against_healthy(r[half:], healthy, u=u[half:])
    # A fault ten times louder than the rest of the residual turns more than two can be told apart: undecided, never two.
    assert answer.at_least == 1, answer.reason
    assert answer.n_v == 1 or level == 0.1, answer.reason
    direction = fault_direction_against_healthy(r[half:], healthy, u=u[half:])
    off = sine(direction.z / y.std(axis=0), G / y.std(axis=0))
    like = abs(np.corrcoef(direction.signal, v[half:])[0, 1])
    print(f"level {level}: counted at {np.sum(answer.counts == 1)} of {len(answer.counts)}, sine {off:.4f}, correlation {like:.4f}")
    assert off < largest_sine
    assert like > least_correlation


# Without the inputs there is a regressor less of the same code.
@pytest.mark.parametrize("with_inputs", [True, pytest.param(False, marks=pytest.mark.slow)])
def test_without_an_injected_fault_nothing_is_found(with_inputs: bool) -> None:
    y, u = record()
    half = len(y) // 2
    _, r = identified_as_measured()
    before, after = (u[:half], u[half:]) if with_inputs else (None, None)
    answer = fault_dimension_against_healthy(r[half:], healthy_reference(r[:half], before), u=after)
    assert answer.n_v == 0, answer.reason
    assert np.all(answer.roots[:, 0] <= answer.thresholds[:, 0])


@pytest.mark.slow  # two faults are counted against simulated healthy samples daily, in `test_identify.py`
def test_two_injected_faults_are_two() -> None:
    y, u = record()
    half = len(y) // 2
    v = np.column_stack([fault(len(y), half, 0.8, 1), fault(len(y), half, -0.5, 3)])
    G = np.column_stack([output_direction(2, y), output_direction(4, y)])
    _, r = identified(y + 0.003 * v @ G.T, u)
    answer = fault_dimension_against_healthy(r[half:], healthy_reference(r[:half], u[:half]), u=u[half:])
    assert answer.n_v == 2, answer.reason


@pytest.mark.slow
def test_a_fault_on_the_states_is_counted_and_its_signal_read() -> None:
    y, u = record()
    half = len(y) // 2
    model = identified_as_measured()[0]
    F = np.random.default_rng(5).standard_normal(ORDER)
    v = fault(len(y), half, 0.8, 1)
    added, x = np.empty_like(y), np.zeros(ORDER)
    for k in range(len(y)):
        added[k] = model.C @ x
        x = model.A @ x + F * v[k]
    added *= 0.1 / np.mean(added[half:].std(axis=0) / y.std(axis=0))
    found, r = identified(y + added, u)
    healthy = healthy_reference(r[:half], u[:half])
    answer = fault_dimension_against_healthy(r[half:], healthy, u=u[half:])
    assert answer.n_v == 1, answer.reason
    direction = fault_direction_against_healthy(r[half:], healthy, A=found.A, C=found.C, u=u[half:])
    assert abs(np.corrcoef(direction.signal, v[half:])[0, 1]) > 0.6
