"""One factor of a record's windows: every regression in it is that of the data, and pieces and experiments merge to the whole."""

from __future__ import annotations

import numpy as np
import pytest

from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidData
from faultspace.numeric.method.model.arx import Arx, fitted_arx, input_spectrum, polynomial
from faultspace.numeric.method.model.arx_windows import (
    ArxWindows,
    about_zero,
    arx_windows,
    joined_windows,
    longest_lag,
    merge_windows,
    past_input_compression,
)
from faultspace.numeric.method.model.compression import compress
from faultspace.numeric.method.model.weighted_reduction import circle

RNG = np.random.default_rng(3)
Y, U = np.cumsum(RNG.standard_normal((60, 2)), axis=0) * [1.0, 1e4], RNG.standard_normal((60, 1)) * 1e-3
LAGS = 4


def rows(y: Array, u: Array, lags: int, order: int) -> Array:
    """Return the regressors of an ARX model of this order, its constant last, on the windows of `lags` + 1 samples: the slow way."""
    columns = [u[lags:]]
    for lag in range(1, order + 1):
        columns += [y[lags - lag : len(y) - lag], u[lags - lag : len(u) - lag]]
    return np.hstack([*columns, np.ones((len(y) - lags, 1))])


def whole() -> ArxWindows:
    return arx_windows([(Y, U)], LAGS)


@pytest.mark.parametrize("order", range(LAGS + 1))
def test_the_residual_of_every_order_stands_in_the_factor(order: int) -> None:
    windows = whole()
    regressors, targets = rows(Y, U, LAGS, order), Y[LAGS:]
    left = targets - regressors @ np.linalg.lstsq(regressors, targets, rcond=None)[0]
    tail = windows.factor[windows.regressors(order) :, -2:]
    assert np.allclose(tail.T @ tail, left.T @ left, rtol=1e-9)


def test_the_model_is_the_regression_of_its_order() -> None:
    windows = whole()
    found = fitted_arx(windows)
    y, u = windows.scales
    assert np.allclose(y, np.std(Y[LAGS:], axis=0, ddof=1)) and np.allclose(u, np.std(U[LAGS:], axis=0, ddof=1))
    model = found.scaled(y, u)
    solution = np.linalg.lstsq(rows(Y, U, LAGS, model.order), Y[LAGS:], rcond=None)[0].T
    blocks = [model.inputs[0]] + [part for i in range(1, model.order + 1) for part in (-model.outputs[i], model.inputs[i])]
    assert np.allclose(np.hstack(blocks), solution[:, :-1], rtol=1e-7, atol=1e-9 * np.abs(solution[:, :-1]).max())
    left = Y[LAGS:] - rows(Y, U, LAGS, model.order) @ solution.T
    assert np.allclose(model.covariance, left.T @ left / (len(left) - 1 - windows.regressors(model.order)), rtol=1e-5)


@pytest.mark.parametrize("samples", [6, 14, 60, 105, 300, 500, 800])
@pytest.mark.parametrize("alike", [False, True])
def test_the_factor_of_a_short_record_is_that_of_its_windows(samples: int, alike: bool) -> None:
    """The twin forms the windows. Columns that repeat others, as those of the constant do, must not cost rows of the factor."""
    lags, draw = 5, np.random.default_rng(3)
    u = draw.standard_normal((samples, 2))
    u[:, 1] = u[:, 0] if alike else 3.7
    y = np.cumsum(u, axis=0) + draw.standard_normal((samples, 2))
    found = arx_windows([(y, u)], lags)
    past = [[part[k - lag] for lag in range(1, lags + 1) for part in (y, u)] for k in range(lags, samples)]
    rows = np.array([np.concatenate([u[k], *earlier, y[k]]) for k, earlier in zip(range(lags, samples), past, strict=True)])
    about = rows - rows.mean(axis=0)
    gram, size = about.T @ about, np.linalg.norm(rows, axis=0)
    assert np.all(np.abs(found.factor.T @ found.factor - gram) <= 1e-13 * np.outer(size, size))


def test_pieces_are_the_whole() -> None:
    pieces = arx_windows([(Y[:1], U[:1]), (Y[1:7], U[1:7]), (Y[7:], U[7:])], LAGS)
    assert pieces.rows == whole().rows and pieces.samples == 60
    assert np.allclose(pieces.factor, whole().factor, rtol=1e-9, atol=1e-9 * np.abs(whole().factor).max())


def test_experiments_are_the_sum_of_their_windows_about_their_own_means() -> None:
    parts = [arx_windows([(Y[a:b], U[a:b])], LAGS) for a, b in ((0, 30), (30, 60))]
    merged = merge_windows(parts)
    assert merged.rows == 2 * (30 - LAGS - 1) and merged.samples == 60 and len(merged.means) == 2
    assert np.allclose(merged.factor.T @ merged.factor, sum(part.factor.T @ part.factor for part in parts), rtol=1e-9)
    moved = merge_windows([parts[0], arx_windows([(Y[30:] + np.array([5.0, 7e4]), U[30:] - 0.1)], LAGS)])
    assert np.allclose(moved.factor, merged.factor, rtol=1e-9, atol=1e-9 * np.abs(merged.factor).max())


@pytest.mark.parametrize("cut", [3, 30, 59])
def test_overlapping_parts_of_one_experiment_are_the_whole(cut: int) -> None:
    far = Y + np.array([50.0, -3e5])
    first, second = arx_windows([(far[:cut], U[:cut])], LAGS), arx_windows([(far[max(cut - LAGS, 0) :], U[max(cut - LAGS, 0) :])], LAGS)
    joined, once = joined_windows(first, second), arx_windows([(far, U)], LAGS)
    assert (joined.rows, joined.samples) == (once.rows, once.samples) == (60 - LAGS - 1, 60)
    assert np.allclose(joined.factor, once.factor, rtol=1e-9, atol=1e-9 * np.abs(once.factor).max())
    assert np.allclose(joined.means[0], once.means[0])


def test_windows_about_zero_have_no_constant() -> None:
    far = Y + np.array([50.0, -3e5])
    windows = about_zero(arx_windows([(far, U + 1)], LAGS))
    regressors = np.hstack([rows(far, U + 1, LAGS, LAGS)[:, :-1], far[LAGS:]])
    assert windows.rows == 60 - LAGS and not np.any(windows.means[0])
    assert np.allclose(windows.factor.T @ windows.factor, regressors.T @ regressors, rtol=1e-9)


@pytest.mark.parametrize("far", [1e2, 1e6, 1e9])
def test_an_operating_point_leaves_the_distances_as_they_are(far: float) -> None:
    """Their error is the rounding of the numbers that are given, times what sums over windows add to it."""
    deviations = Y.std(axis=0)
    moved = arx_windows([(Y + far * deviations, U + far * U.std())], LAGS)
    sizes = np.linalg.norm(whole().factor, axis=0)
    assert np.max(np.abs(moved.factor - whole().factor) / sizes) < 20 * np.finfo(float).eps * far
    constant = arx_windows([(np.hstack([Y, np.full((60, 1), far / 3)]), U)], LAGS)
    assert not np.any(constant.factor[:, constant.outputs(0)[2]])


def test_the_factor_of_pi_moesp_is_in_it() -> None:
    windows = about_zero(whole())
    y, u = windows.scales
    direct = compress(Y / y, U / u, block_rows=2, past_rows=3, route="qr")
    found = past_input_compression(windows, 2, 3)
    assert found.columns == direct.columns
    assert np.allclose(found.factor, direct.factor, rtol=1e-8, atol=1e-8 * np.abs(direct.factor).max())


def test_lags_leave_windows_enough() -> None:
    for lengths, p, n_u in (([1000], 3, 1), ([200], 1, 1), ([30, 40], 2, 1), ([1000], 28, 3), ([10**6], 3, 2)):
        lags = longest_lag(lengths, p, n_u)
        assert sum(max(length - lags, 0) for length in lengths) >= 4 * (n_u + lags * (p + n_u))
        assert lags <= 1.6 * np.cbrt(sum(lengths))
    assert longest_lag([1000], 3, 1) == 16 and longest_lag([3], 1, 1) == -1
    assert longest_lag([10**6], 3, 2) == 36 and longest_lag([10**6], 28, 2) == 20


def test_an_ar_model_has_the_spectrum_of_what_it_was_made_of() -> None:
    rng = np.random.default_rng(0)
    u = np.zeros((20000, 2))
    e = rng.standard_normal(u.shape) @ np.array([[1.0, 0.5], [0.0, 1.0]])
    for k in range(1, len(u)):
        u[k] = np.array([[0.7, 0.0], [0.3, -0.5]]) @ u[k - 1] + e[k]
    windows = arx_windows([(rng.standard_normal((len(u), 1)), u)], 6)
    angles = circle(16)
    transfer = np.linalg.inv(polynomial(np.array([np.eye(2), [[-0.7, 0.0], [-0.3, 0.5]]]), angles)) / windows.scales[1][:, None]
    true = transfer @ (np.array([[1.0, 0.0], [0.5, 1.0]]) @ np.array([[1.0, 0.5], [0.0, 1.0]])) @ np.conj(np.swapaxes(transfer, 1, 2))
    found = input_spectrum(windows, angles)
    assert np.max(np.linalg.norm(found - true, axis=(1, 2)) / np.linalg.norm(true, axis=(1, 2))) < 0.15


def test_weight_disturbance_and_markov_parameters_belong_together() -> None:
    arx = Arx(np.array([np.eye(2), [[-0.5, 0.1], [0.0, 0.3]]]), np.ones((2, 2, 1)), np.array([[2.0, 0.5], [0.5, 1.0]]), 100, 90)
    angles = circle(512)
    assert np.allclose(arx.weight(angles) @ arx.disturbance(angles), np.eye(2))
    plant, noise = arx.markov(60)
    powers = np.exp(-1j * np.outer(angles, np.arange(60)))
    assert np.allclose(np.tensordot(powers, plant, 1), arx.plant(angles))
    coloured = np.tensordot(powers, noise, 1)
    assert np.allclose(coloured @ np.conj(np.swapaxes(coloured, 1, 2)), arx.disturbance(angles))
    assert arx.radius() == pytest.approx(0.5)


def test_what_cannot_be_used_is_refused() -> None:
    with pytest.raises(InvalidData, match="no data"):
        arx_windows([], 3)
    with pytest.raises(InvalidData, match="all need the same"):
        arx_windows([(Y, U), (Y[:, :1], U)], 3)
    with pytest.raises(InvalidData, match="nothing to merge"):
        merge_windows([])
    with pytest.raises(InvalidData, match="lags"):
        merge_windows([whole(), arx_windows([(Y, U)], 3)])
    for far in (0.0, 1e4):
        with pytest.raises(InvalidData, match="span fewer than all of 5 directions"):
            fitted_arx(arx_windows([(Y, np.full_like(U, far / 3))], LAGS))
        with pytest.raises(InvalidData, match="span 5 of 10 directions"):
            fitted_arx(arx_windows([(Y, far + np.hstack([U, 2 * U]) / 1e-3)], LAGS))
    with pytest.raises(InvalidData, match="span 2 of 5 directions"):
        fitted_arx(arx_windows([(Y, np.sin(np.arange(60.0))[:, None])], LAGS))
    with pytest.raises(InvalidData, match="other units"):
        fitted_arx(arx_windows([(Y * 1e160, U)], LAGS))
