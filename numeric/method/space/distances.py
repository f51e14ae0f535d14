"""This measures how far one subspace lies from another.

    principal_angles        radians, ascending, min(dim U, dim V) of them, accurate when they are tiny and when they
                            are right
    containment_distance    sine of the largest angle from U to V: 0 iff span U lies in span V, 1 if dim U > dim V
    subspace_distance       the same both ways, the larger: 0 iff the spans are equal, 1 if the dimensions differ
    compare_subspaces       all of these and the dimensions in one record
    containment_error       the angles over the metric's own maximum, sqrt(n_v) pi/2: from 0 to 1; as published it is over n_v pi/2
    two_sided_error         the metric for different dimensions over its maximum: 0 iff the spans are equal

A subspace is given by a matrix whose independent columns span it; a subspace without columns, (d, 0), is {0}.
Neither the scale of columns nor the choice of basis matters. Source: [YL16] for subspaces of different dimensions;
[G25] section V for the published error.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ....base.threads import one_thread

# Columns of unit length with a singular value below this are taken for dependent.
DEPENDENT = 1e-12


@dataclass(frozen=True, eq=False)
class Compared:
    """The dimensions of span U and span V, and the `angles` between them: radians, in ascending order."""

    dimensions: tuple[int, int]
    angles: Array

    @property
    def contained(self) -> float:
        """Return the sine of the largest angle from U to V, 1 where U has more dimensions."""
        k, other = self.dimensions
        return 1.0 if k > other else float(np.sin(self.angles.max(initial=0.0)))

    @property
    def two_sided(self) -> float:
        """Return the larger of both containment distances: |P_U - P_V| in the spectral norm."""
        k, other = self.dimensions
        return 1.0 if k != other else self.contained

    def error(self, missing: int, most: int) -> float:
        """Return the norm of the angles, with so many right ones `missing`, over that of `most` right angles, 1 at least."""
        return float(np.sqrt((np.sum(self.angles**2) + missing * np.pi**2 / 4) / max(most, 1)) / (np.pi / 2))


def principal_angles(U: object, V: object) -> Array:
    """Return principal angles in radians, ascending, between the column spans of U (d, k) and V (d, l): min(k, l) of them.

    Each comes from its sine and its cosine together, so that an angle of 1e-12 is as accurate as one of 1. Raises
    InvalidData for different numbers of rows, dependent columns, or entries that are not finite.
    """
    return compare_subspaces(U, V).angles


def containment_distance(U: object, V: object) -> float:
    """Return the sine of the largest angle from span U to span V: 0 iff U lies in V, 1 if dim U > dim V. Raises as
    `principal_angles`.
    """
    return compare_subspaces(U, V).contained


@one_thread()
def subspace_distance(U: object, V: object) -> float:
    """Return the two-sided distance of span U and span V: the sine of the largest angle either way.

    It is 0 iff the spans are equal and 1 where their dimensions differ; neither the choice of basis nor the units of a column matter. It
    tells how far an estimated fault space is from a known one. Source: [YL16], [GVL13] section 6.4.3.

    Parameters
    ----------
    U, V : array_like of the shapes (d, k) and (d, l)

    Returns
    -------
    float

    Raises
    ------
    InvalidData
        Different numbers of rows, dependent columns, entries that are not finite.

    Examples
    --------
    >>> from faultspace.numeric import subspace_distance
    >>> subspace_distance([[1, 0], [0, 1], [0, 0]], [[2, 1], [0, 1], [0, 0]]), subspace_distance([[1], [0]], [[0], [1]])
    (0.0, 1.0)
    """
    return compare_subspaces(U, V).two_sided


def compare_subspaces(U: object, V: object) -> Compared:
    """Compare dimensions and angles of span U (d, k) and span V (d, l). Raises as `principal_angles`."""
    first, second = _orthonormal(U, "U"), _orthonormal(V, "V")
    if len(first) != len(second):
        raise InvalidData(f"U, V: got {len(first)} and {len(second)} rows; subspaces of one space have the same number")
    return Compared((first.shape[1], second.shape[1]), _angles(first, second))


def containment_error(truth: object, estimate: object) -> float:
    """Return how far span `truth` (d, k) is from lying in span `estimate` (d, l): angle norm over sqrt(k) pi/2, from 0 to 1.

    Directions of `truth` for which `estimate` has no room count as right angles. Raises as `principal_angles`.
    """
    compared = compare_subspaces(truth, estimate)
    k, other = compared.dimensions
    return compared.error(max(k - other, 0), k)


def two_sided_error(truth: object, estimate: object) -> float:
    """Return the metric of [YL16] on subspaces of all dimensions over its maximum, from 0 (equal spans) to 1. Raises as
    `principal_angles`.

    Each dimension that one span has more than the other counts as a right angle.
    """
    compared = compare_subspaces(truth, estimate)
    k, other = compared.dimensions
    return compared.error(abs(k - other), max(k, other))


def _angles(first: Array, second: Array) -> Array:
    """Return the angles between spans of orthonormal columns: cosines see right angles well, sines small ones, their arc tangent all."""
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
        raise InvalidData(
            f"{name}: {counted(columns.shape[1], 'column')} in dimension {columns.shape[0]} "
            f"{'is' if columns.shape[1] == 1 else 'are'} dependent; pass a basis"
        )
    left, values, _ = np.linalg.svd(columns / lengths, full_matrices=False)
    if values[-1] <= DEPENDENT * values[0]:
        raise InvalidData(f"{name}: columns are dependent (singular values down to {values[-1]:.1e}); pass a basis")
    return np.asarray(left)
