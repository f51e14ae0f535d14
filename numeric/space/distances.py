"""This measures how far one subspace lies from another, and one model from another.

    principal_angles        radians, ascending, min(dim U, dim V) of them, accurate when they are tiny and when they
                            are right
    containment_distance    sine of the largest angle from U to V: 0 iff span U lies in span V, 1 if dim U > dim V
    subspace_distance       the same both ways, the larger: 0 iff the spans are equal, 1 if the dimensions differ
    compare_subspaces       all of these and the dimensions in one record
    author_error            the published error of the study: |angles| / (n_v pi/2), containment only
    containment_error       the same angles over the metric's own maximum, sqrt(n_v) pi/2: from 0 to 1
    two_sided_error         the metric for different dimensions over its maximum: 0 iff the spans are equal
    markov_distance         relative difference of the Markov parameters of two models: 0 iff they are the same
                            input-output map

A subspace is given by a matrix whose independent columns span it; a subspace without columns, (d, 0), is {0}.
Neither the scale of columns nor the choice of basis matters. Source: [YL16] for subspaces of different dimensions;
[G25] section V for the published error.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ...base.arrays import Array
from ...base.errors import InvalidData

# Columns of unit length with a singular value below this are taken for dependent.
DEPENDENT = 1e-12


class HasMatrices(Protocol):
    """This is anything with A (n, n), B (n, n_u), C (p, n) and D (p, n_u)."""

    @property
    def A(self) -> Any: ...
    @property
    def B(self) -> Any: ...
    @property
    def C(self) -> Any: ...
    @property
    def D(self) -> Any: ...


@dataclass(frozen=True)
class SubspaceComparison:
    """The comparison sets span U and span V side by side; the distances are sines, and `angles` are radians in ascending order."""

    dimensions: tuple[int, int]
    angles: Array
    first_in_second: float
    second_in_first: float

    @property
    def same_dimension(self) -> bool:
        """Say whether the two-sided distance can be below one at all."""
        return self.dimensions[0] == self.dimensions[1]

    @property
    def two_sided(self) -> float:
        """Return the larger of both containment distances: |P_U - P_V| in the spectral norm."""
        return max(self.first_in_second, self.second_in_first)

    def __str__(self) -> str:
        largest = np.degrees(self.angles[-1]) if self.angles.size else 0.0
        same = "" if self.same_dimension else "; different dimensions, so the two-sided distance is 1 whatever the angles"
        first, second = self.dimensions
        return f"dimensions {first} and {second}, largest principal angle {largest:.3g} degrees{same}"


def principal_angles(U: object, V: object) -> Array:
    """Return principal angles in radians, ascending, between the column spans of U (d, k) and V (d, l): min(k, l) of them.

    Each comes from its sine and its cosine together, so that an angle of 1e-12 is as accurate as one of 1. Raises
    InvalidData for different numbers of rows, dependent columns, or entries that are not finite.
    """
    first, second = _orthonormal(U, "U"), _orthonormal(V, "V")
    _same_space(first, second)
    return _angles(first, second)


def containment_distance(U: object, V: object) -> float:
    """Return the sine of the largest angle from span U to span V: 0 iff U lies in V, 1 if dim U > dim V. Raises as
    `principal_angles`.
    """
    return compare_subspaces(U, V).first_in_second


def subspace_distance(U: object, V: object) -> float:
    """Return the two-sided distance, sine of the largest angle either way: 0 iff the spans are equal, 1 if their dimensions
    differ.

    Raises as `principal_angles`.
    """
    return compare_subspaces(U, V).two_sided


def compare_subspaces(U: object, V: object) -> SubspaceComparison:
    """Compare dimensions, angles and both containments of span U (d, k) and span V (d, l). Raises as `principal_angles`."""
    first, second = _orthonormal(U, "U"), _orthonormal(V, "V")
    _same_space(first, second)
    k, other = first.shape[1], second.shape[1]
    angles = _angles(first, second)
    largest = float(np.sin(angles[-1])) if angles.size else 0.0
    return SubspaceComparison((k, other), angles, 1.0 if k > other else largest, 1.0 if other > k else largest)


def author_error(truth: object, estimate: object, n_v: int | None = None) -> float:
    """Return the error as published: the 2-norm of the angles between the true [F; G] and the estimate over n_v pi/2.

    `n_v` is the number of columns of `truth` (d, n_v) unless given. Two doubts come with it: the angles cannot
    exceed sqrt(n_v) pi/2 in norm, so that for n_v > 1 the error never reaches one; and an estimate that is the whole
    space scores zero. `containment_error` mends the first, `two_sided_error` both. Source: [G25] section V, [YL16].
    Raises InvalidData.
    """
    angles = principal_angles(truth, estimate)
    columns = np.atleast_2d(np.asarray(truth)).shape[1] if n_v is None else n_v
    if columns < 1:
        raise InvalidData(f"n_v: got {columns}; the published error divides by n_v, so it needs at least one fault")
    return float(np.linalg.norm(angles) / (columns * np.pi / 2))


def containment_error(truth: object, estimate: object) -> float:
    """Return how far span `truth` (d, k) is from lying in span `estimate` (d, l): angle norm over sqrt(k) pi/2, from 0 to 1.

    Directions of `truth` for which `estimate` has no room count as right angles. Raises as `principal_angles`.
    """
    angles, k, other = _angles_and_dimensions(truth, estimate)
    return float(np.sqrt((np.sum(angles**2) + max(k - other, 0) * np.pi**2 / 4) / max(k, 1)) / (np.pi / 2))


def two_sided_error(truth: object, estimate: object) -> float:
    """Return the metric of [YL16] on subspaces of all dimensions over its maximum, from 0 (equal spans) to 1. Raises as
    `principal_angles`.

    Each dimension that one span has more than the other counts as a right angle.
    """
    angles, k, other = _angles_and_dimensions(truth, estimate)
    return float(np.sqrt((np.sum(angles**2) + abs(k - other) * np.pi**2 / 4) / max(k, other, 1)) / (np.pi / 2))


def markov_distance(model1: HasMatrices, model2: HasMatrices, *, samples: int | None = None) -> float:
    """Return |H1 - H2| / max(|H1|, |H2|), Frobenius norms over the Markov parameters D, CB, CAB, ...; between 0 and 2, no
    basis matters.

    `samples` parameters are compared; by default n1 + n2 + 1, which are enough to tell any two different maps of
    these orders apart [K80]. Raises InvalidData when the models have different inputs or outputs.
    """
    D1, D2 = (np.atleast_2d(np.asarray(model.D, float)) for model in (model1, model2))
    if D1.shape != D2.shape:
        raise InvalidData(f"models: got (p, n_u) = {D1.shape} and {D2.shape}; only models with the same inputs and outputs compare")
    count = 1 + sum(np.asarray(model.A).shape[0] for model in (model1, model2)) if samples is None else samples
    if count < 1:
        raise InvalidData(f"samples: got {count}; at least one Markov parameter must be compared")
    one, two = _markov(model1, count), _markov(model2, count)
    scale = max(np.linalg.norm(one), np.linalg.norm(two))
    return float(np.linalg.norm(one - two) / scale) if scale > 0 else 0.0


def _markov(model: HasMatrices, count: int) -> Array:
    A, B, C, D = (np.atleast_2d(np.asarray(matrix, float)) for matrix in (model.A, model.B, model.C, model.D))
    parameters, state = [D], B
    for _ in range(1, count):
        parameters.append(C @ state)
        state = A @ state
    return np.array(parameters)


def _angles_and_dimensions(U: object, V: object) -> tuple[Array, int, int]:
    comparison = compare_subspaces(U, V)
    return comparison.angles, *comparison.dimensions


def _angles(first: Array, second: Array) -> Array:
    """Return cosines see right angles well, sines small ones; the arc tangent of both sees all. Orthonormal columns in."""
    if first.shape[1] < second.shape[1]:
        first, second = second, first
    if second.shape[1] == 0:
        return np.zeros(0)
    across = first.T @ second
    cosines = np.linalg.svd(across, compute_uv=False)
    sines = np.linalg.svd(second - first @ across, compute_uv=False)[::-1]
    return np.sort(np.arctan2(sines[: cosines.size], cosines))


def _orthonormal(matrix: object, name: str) -> Array:
    columns = np.array(matrix, dtype=float)
    if columns.ndim == 1:
        columns = columns[:, None]
    if columns.ndim != 2 or not np.all(np.isfinite(columns)):
        raise InvalidData(f"{name}: got an array of shape {columns.shape}; a basis is a (d, k) matrix of finite numbers")
    lengths = np.linalg.norm(columns, axis=0)
    if columns.shape[1] == 0:
        return columns
    if columns.shape[1] > columns.shape[0] or lengths.min() == 0:
        raise InvalidData(f"{name}: {columns.shape[1]} columns in dimension {columns.shape[0]} are dependent; pass a basis")
    left, values, _ = np.linalg.svd(columns / lengths, full_matrices=False)
    if values[-1] <= DEPENDENT * values[0]:
        raise InvalidData(f"{name}: columns are dependent (singular values down to {values[-1]:.1e}); pass a basis")
    return np.asarray(left)


def _same_space(first: Array, second: Array) -> None:
    if first.shape[0] != second.shape[0]:
        raise InvalidData(f"U, V: got {first.shape[0]} and {second.shape[0]} rows; subspaces of one space have the same number")
