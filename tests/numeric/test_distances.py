"""These tests are about angles planted by construction, from right to 1e-14; containment and two sides; the published error and what is
wrong with it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import scipy.linalg

from faultspace.base.errors import InvalidData
from faultspace.numeric.method.space.distances import (
    compare_subspaces,
    containment_distance,
    containment_error,
    principal_angles,
    subspace_distance,
    two_sided_error,
)
from tests.numeric.published_error import author_error

EPS = np.finfo(float).eps


def planted(seed: int, dimension: int, angles: list[float], extra: int = 0) -> tuple[Any, Any]:
    """Return U (d, k) and V (d, k + extra) with exactly these principal angles, in scrambled bases."""
    rng = np.random.default_rng(seed)
    k = len(angles)
    Q = scipy.linalg.qr(rng.standard_normal((dimension, dimension)))[0]
    first, second, more = Q[:, :k], Q[:, k : 2 * k], Q[:, 2 * k : 2 * k + extra]
    tilted = first * np.cos(angles) + second * np.sin(angles)
    return first @ rng.standard_normal((k, k)), np.hstack([tilted, more]) @ rng.standard_normal((k + extra, k + extra))


@pytest.mark.parametrize("extra", [0, 1, 2])
@pytest.mark.parametrize(
    "angles",
    [[0.0], [1e-14, 0.3], [1e-10, 1e-5, 1.0], [np.pi / 2 - 1e-9, np.pi / 4], [np.pi / 2], [1e-8, 1e-8, np.pi / 2]],
    ids=str,
)
def test_planted_angles(angles: list[float], extra: int) -> None:
    """The absolute errors are those of rounding, whatever the angle: neither small nor right angles lose half the digits."""
    worst = 0.0
    for seed in range(10):
        U, V = planted(seed, 9, angles, extra)
        bound = 50 * EPS * (np.linalg.cond(U) + np.linalg.cond(V))
        for found in (principal_angles(U, V), principal_angles(V, U)):
            got = np.max(np.abs(found - np.sort(angles)))
            worst = max(worst, got / bound)
            assert got <= bound
    print(f"got/bound at most {worst:.2g}")


def test_agrees_with_scipy() -> None:
    rng = np.random.default_rng(1)
    for k in range(1, 5):  # beyond, angles are zero and scipy loses half the digits
        U, V = rng.standard_normal((7, k)), rng.standard_normal((7, 3))
        np.testing.assert_allclose(principal_angles(U, V), np.sort(scipy.linalg.subspace_angles(U, V)), atol=1e-13)


def test_containment_is_one_sided() -> None:
    rng = np.random.default_rng(2)
    V = rng.standard_normal((6, 4))
    U = V @ rng.standard_normal((4, 2))
    assert containment_distance(U, V) < 1e-13
    assert containment_distance(V, U) == 1.0
    assert subspace_distance(U, V) == subspace_distance(V, U) == 1.0
    comparison = compare_subspaces(U, V)
    assert comparison.dimensions == (2, 4) and comparison.angles.size == 2


def test_two_sided_is_the_norm_of_the_difference_of_projectors() -> None:
    rng = np.random.default_rng(3)
    for _ in range(10):
        U, V = rng.standard_normal((6, 3)), rng.standard_normal((6, 3))
        projectors = [M @ np.linalg.pinv(M) for M in (U, V)]
        assert subspace_distance(U, V) == pytest.approx(np.linalg.norm(projectors[0] - projectors[1], 2), abs=1e-12)
        assert subspace_distance(U, U @ rng.standard_normal((3, 3))) < 1e-12


def test_units_of_columns_do_not_matter() -> None:
    U, V = planted(4, 8, [1e-9, 0.2])
    scaled = U * [1e-150, 1e150]
    np.testing.assert_allclose(principal_angles(scaled, V), [1e-9, 0.2], atol=1e-13)


def test_the_published_error_and_the_corrected_ones() -> None:
    """Orthogonal planes have the error 1/sqrt(2) as published and 1 as corrected; the whole space as the estimate has 0 as published,
    and yet is wrong."""
    eye = np.eye(8)
    assert author_error(eye[:, :2], eye[:, 2:4]) == pytest.approx(1 / np.sqrt(2))
    assert containment_error(eye[:, :2], eye[:, 2:4]) == pytest.approx(1)
    assert author_error(eye[:, :2], eye) == 0 and containment_error(eye[:, :2], eye) == 0
    assert two_sided_error(eye[:, :2], eye) == pytest.approx(np.sqrt(6 / 8))
    assert two_sided_error(eye[:, :2], eye[:, :2]) == 0
    assert containment_error(eye[:, :4], eye[:, :2]) == pytest.approx(np.sqrt(2 / 4))
    U, V = planted(5, 8, [0.1, 0.4], extra=1)
    assert author_error(U, V) == pytest.approx(np.hypot(0.1, 0.4) / np.pi)
    assert two_sided_error(U, V) == pytest.approx(np.sqrt(0.17 + np.pi**2 / 4) / (np.sqrt(3) * np.pi / 2))
    assert two_sided_error(U, V) == pytest.approx(two_sided_error(V, U))


def test_a_random_subspace_does_not_score_one() -> None:
    """This is the baseline of the study: a random estimate of the same dimension, against the right maximum."""
    rng = np.random.default_rng(6)
    scores = [author_error(rng.standard_normal((8, 2)), rng.standard_normal((8, 5))) for _ in range(200)]
    assert 0.2 < np.median(scores) < 0.5


def test_no_columns() -> None:
    nothing, plane = np.zeros((4, 0)), np.eye(4)[:, :2]
    assert principal_angles(nothing, plane).size == 0
    assert containment_distance(nothing, plane) == 0 and containment_distance(plane, nothing) == 1
    assert two_sided_error(nothing, nothing) == 0


@pytest.mark.parametrize(
    "U, V, message",
    [
        (np.eye(3), np.eye(4), r"U, V: got 3 and 4 rows"),
        (np.ones((3, 2)), np.eye(3), r"U: columns are dependent"),
        (np.eye(3), np.zeros((3, 1)), r"V: 1 column in dimension 3 is dependent"),
        (np.ones((2, 3)), np.eye(2), r"U: 3 columns in dimension 2 are dependent"),
        (np.array([[np.nan]]), np.eye(1), r"U: got an array of shape \(1, 1\); a basis is"),
    ],
)
def test_what_is_no_basis(U: Any, V: Any, message: str) -> None:
    with pytest.raises(InvalidData, match=message):
        principal_angles(U, V)
