"""Whitening by triangles of stretches is the least squares of all samples at once, and takes no memory of lags times samples."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from faultspace.base.arrays import Array
from faultspace.numeric import StateSpaceModel
from faultspace.numeric.method.ranks.sample_windows import stacked_triangle
from faultspace.numeric.plant.healthy.healthy_model import STRETCH, lagged, spectra
from faultspace.numeric.plant.monitor.innovation_form import FOLDS, innovation_form

STATELESS = StateSpaceModel(np.zeros((0, 0)), np.zeros((0, 2)), np.zeros((3, 0)), np.zeros((3, 2)))


def coloured(samples: int, seed: int) -> tuple[Array, Array]:
    """Return outputs (N, 3), an autoregression of twelve lags, and inputs (N, 2)."""
    rng = np.random.default_rng(seed)
    y, e, u = np.zeros((samples + 12, 3)), rng.normal(size=(samples + 12, 3)), rng.normal(size=(samples, 2))
    for k in range(12, samples + 12):
        y[k] = e[k] + 0.5 * y[k - 1] - 0.4 * y[k - 12]
    return y[12:], u


def judged_at_once(y: Array, u: Array, lags: int) -> Array:
    """Return each sample's error, whitened, by what the other parts teach: least squares with all rows in one array."""
    outputs, inputs = (y - y.mean(axis=0)) / y.std(axis=0), (u - u.mean(axis=0)) / u.std(axis=0)
    past, now = lagged(outputs, inputs, lags)
    X = np.hstack([np.ones((len(now), 1)), past])
    judged = np.empty_like(now)
    for part in np.array_split(np.arange(len(now)), FOLDS):
        others = np.setdiff1d(np.arange(len(now)), part)
        known = np.linalg.lstsq(X[others], now[others], rcond=None)[0]
        e = now[others] - X[others] @ known
        spread = e.T @ e / (len(others) - X.shape[1]) * (1 + X.shape[1] / len(others))
        judged[part] = np.linalg.solve(np.linalg.cholesky(spread), (now[part] - X[part] @ known).T).T
    return judged


@pytest.mark.parametrize("samples", [900, 4 * STRETCH + 1, 4 * STRETCH + 900])
def test_every_sample_is_judged_as_by_all_rows_at_once(samples: int) -> None:
    y, u = coloured(samples, samples)
    found = innovation_form(STATELESS, y, u, with_inputs=True)
    assert found.form.lags >= 12
    np.testing.assert_allclose(found.errors, judged_at_once(y, u, found.form.lags), atol=1e-9)


@pytest.mark.parametrize("heights", [[], [0], [5], [1, 1, 1], [0, 7], [40, 3, 2], [2, 0]])
def test_the_triangle_has_the_moments_of_all_blocks(heights: list[int]) -> None:
    rng = np.random.default_rng(0)
    blocks = [rng.normal(size=(height, 4)) for height in heights]
    triangle, rows = stacked_triangle(4, blocks), np.vstack([np.zeros((0, 4)), *blocks])
    assert triangle.shape == (min(len(rows), 4), 4)
    np.testing.assert_allclose(triangle.T @ triangle, rows.T @ rows, atol=1e-12)


def most_memory(samples: int) -> int:
    """Return the peak, in bytes, of what the form of so many samples takes."""
    y, u = coloured(samples, 3)
    tracemalloc.start()
    found = innovation_form(STATELESS, y, u, with_inputs=True)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert found.form.lags >= 12
    return most


def test_the_form_of_a_long_record_does_not_hold_its_lags() -> None:
    """All regressors and the copies of them that least squares makes are more than thirty times the record."""
    short, long = 4 * STRETCH, 9 * STRETCH
    assert most_memory(long) - most_memory(short) < 14 * 5 * 8 * (long - short)


def slow_spectra(e: Array, tapers: int, centres: Array) -> Array:
    """Return the transforms of e times each sine taper, a sum for each frequency."""
    N = len(e)
    k = np.arange(1, N + 1)
    sines = [np.sqrt(2 / (N + 1)) * np.sin(np.pi * t * k / (N + 1)) for t in range(1, tapers + 1)]
    return np.array([[(sine * np.exp(-2j * np.pi * f * k)) @ e for sine in sines] for f in centres])


@pytest.mark.parametrize(("samples", "p", "tapers"), [(60, 3, 4), (61, 1, 7), (9, 2, 2)])
def test_spectra_are_those_of_tapered_samples(samples: int, p: int, tapers: int) -> None:
    e = np.random.default_rng(samples).normal(size=(samples, p))
    found = spectra(e, tapers)
    slow = slow_spectra(e, tapers, found.frequencies)
    assert np.abs(found.transforms) == pytest.approx(np.abs(slow), abs=1e-10)
    cross = [np.einsum("ctp,ctq->ctpq", one, one.conj()) for one in (found.transforms, slow)]
    np.testing.assert_allclose(cross[0], cross[1], atol=1e-10)
