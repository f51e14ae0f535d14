"""This tells how far an estimated fault space may lie from the true one: an angle with a confidence.

    space_uncertainty   from a kernel basis of maximum likelihood, whose coefficients have a covariance

A change dN of the kernel rows changes their conditions M by dM and the solutions W of M W = 0 by -M^+ dM W, off their
span. Of the basis Q the part X off the span of Q counts: tan of the largest angle is |X|. The number of zeros is taken
as right: a wrong one is no matter of angles. So is the noise (one colour, the same power relative to each channel): the
bias of other noise is not in the angle.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...base.arrays import Array
from ..count.windows import ObservedCoordinates
from .result import SpaceUncertainty, condition_maps, kernel_conditions


def space_uncertainty(
    rows: Sequence[Array], within: Sequence[Array], covariance: Array, coordinates: ObservedCoordinates, columns: Array
) -> SpaceUncertainty:
    """Return the uncertainty for kernel rows (eta_i + 1, p), combinations of within[i] (q_i, p (eta_i + 1)) with coefficients of this
    covariance, and
    the solutions `columns` (n + p, n_z) of their conditions, all in the observed coordinates."""
    A, C = coordinates.A, coordinates.C
    conditions = np.vstack([kernel_conditions(row[None], A, C)[0] for row in rows])
    changes = np.zeros((len(covariance), len(conditions), columns.shape[1]))
    parameter = condition = 0
    for row, basis in zip(rows, within, strict=True):
        responses = condition_maps(A, C, len(row)) @ columns
        block = np.einsum("qa,kaz->qkz", basis, responses)
        changes[parameter : parameter + len(basis), condition : condition + len(row)] = block
        parameter += len(basis)
        condition += len(row)
    turned = -np.linalg.pinv(conditions) @ changes
    moved = np.array([coordinates.back(change) for change in turned]).reshape(len(turned), *columns.shape)
    Q, R = np.linalg.qr(coordinates.back(columns))
    off = (moved - Q @ (Q.T @ moved)) @ np.linalg.inv(R)
    values, vectors = np.linalg.eigh(covariance)
    root = vectors * np.sqrt(np.maximum(values, 0.0))
    return SpaceUncertainty(np.tensordot(root.T, off, axes=1))
