"""Measured data that nobody here made: published singular values and poles, orders and fits.

The records are DaISy's (B. De Moor, ed., ESAT/STADIUS, KU Leuven) as kept by SLICOT. They are no part of this tree: the variable
FAULTSPACE_DATA names their folder. A fit is 100 (1 - |y - yhat| / |y - mean|): estimated on the first half, simulated on the second with
the initial state fitted.
"""

import os
import re
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from faultspace.base.errors import InvalidData
from faultspace.numeric.method.model.models import StateSpaceModel, observability_matrix
from faultspace.numeric.method.model.past_inputs import pi_moesp
from faultspace.numeric.method.model.past_outputs import po_moesp

Array = NDArray[np.float64]
FOLDER = os.environ.get("FAULTSPACE_DATA")
pytestmark = pytest.mark.skipif(FOLDER is None, reason="FAULTSPACE_DATA does not name the folder of measured records")


def numbers(text: str) -> Array:
    return np.array([float(word) for word in re.findall(r"-?\d+\.\d+", text)])


def folder() -> Path:
    assert FOLDER is not None
    return Path(FOLDER)


def hair_dryer() -> tuple[Array, Array]:
    """Return y and u as recorded, 1000 samples."""
    values = np.array((folder() / "hairdryer_SLICOT_IB01BD.dat").read_text("ascii").split("\n", 3)[3].split(), dtype=np.float64)
    assert values.shape == (2000,)
    return values[1000:], values[:1000]


def record(name: str, inputs: int) -> tuple[Array, Array]:
    """Return y and u of a MATLAB file whose first columns are the inputs, means removed."""
    from scipy.io import loadmat

    contents = {key: value for key, value in loadmat(folder() / name).items() if not key.startswith("_")}
    (table,) = contents.values()
    table = table.astype(np.float64)
    table = table - table.mean(axis=0)
    return table[:, inputs:], table[:, :inputs]


def fit(model: StateSpaceModel, y: Array, u: Array) -> Array:
    """Return the fit of each output, percent."""
    free = y - model.simulate(u)
    x0 = np.linalg.lstsq(observability_matrix(model.A, model.C, len(y)), free.ravel(), rcond=None)[0]
    error = y - model.simulate(u, x0)
    result: Array = 100 * (1 - np.linalg.norm(error, axis=0) / np.linalg.norm(y - y.mean(axis=0), axis=0))
    return result


def test_the_hair_dryers_published_singular_values_and_poles_come_back() -> None:
    y, u = hair_dryer()
    found = po_moesp(y, u, order=4, block_rows=15)
    published = numbers((folder() / "IB01AD.res").read_text("ascii"))
    assert published.shape == (15,)
    assert np.abs(found.singular_values - published).max() < 0.51e-4, "equal to the four decimals printed"
    A = numbers((folder() / "IB01BD.res").read_text("ascii"))[:16].reshape(4, 4)
    # Printed to four decimals: the poles then hold to about as many times their condition.
    poles = StateSpaceModel(A, np.zeros((4, 1)), np.zeros((1, 4)), [[0]]).poles
    assert np.allclose(found.model.poles, poles, atol=2e-3)


def test_the_hair_dryer_by_past_inputs() -> None:
    y, u = hair_dryer()
    y, u = (y - y.mean())[:, np.newaxis], (u - u.mean())[:, np.newaxis]
    found = pi_moesp(y[:500], u[:500], order=4, block_rows=15, past_rows=30)
    assert fit(found.model, y[500:], u[500:])[0] > 90.5
    with pytest.raises(InvalidData, match="no clean gap"):
        pi_moesp(y, u, block_rows=15)


def test_the_robot_arm_has_order_four() -> None:
    y, u = record("robot_arm_dat.mat", 1)
    assert y.shape == (1024, 1)
    # The gap after 4 is the largest by far to the eye, but not ten times that after 13, and is not told.
    with pytest.raises(InvalidData, match="the largest is after 4"):
        pi_moesp(y[:512], u[:512], block_rows=15)
    found = pi_moesp(y[:512], u[:512], order=4, block_rows=15)
    assert not found.gap.clean
    assert found.route == "qr", "a periodic sweep excites too little for a Gram"
    assert fit(found.model, y[512:], u[512:])[0] > 96


def test_the_disc_players_order_is_not_made_up() -> None:
    y, u = record("CD_player_arm_dat.mat", 2)
    for method in (pi_moesp, po_moesp):
        with pytest.raises(InvalidData, match="no clean gap"):
            method(y, u, block_rows=15)
    found = pi_moesp(y[:1024], u[:1024], order=8, block_rows=15)
    assert not found.gap.clean
    assert np.all(fit(found.model, y[1024:], u[1024:]) > [70, 77])


def test_the_flexible_structure_drops_after_28() -> None:
    y, u = record("flexible_structure_dat.mat", 2)
    assert y.shape == (8523, 28)
    half = len(y) // 2
    with pytest.raises(InvalidData, match=r"no clean gap .* the largest is after 28"):
        pi_moesp(y[:half], u[:half], block_rows=30)
    found = pi_moesp(y[:half], u[:half], order=34, block_rows=30)
    assert np.mean(fit(found.model, y[half:], u[half:])) > 91
    with pytest.raises(InvalidData, match="order = 34 is above the 32 directions of past inputs"):
        pi_moesp(y, u, order=34, block_rows=16)
