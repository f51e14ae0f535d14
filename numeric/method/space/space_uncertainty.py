"""This tells how far an estimated fault space may lie from the true one: an angle with a confidence.

A change of the kernel rows, of A and of C changes the conditions M by dM and the solutions W of M W = 0 by -M^+ dM W, off their span. Of
the basis Q the part X off the span of Q counts: tan of the largest angle is |X|. With X_j = N_j C + X_(j+1) A the conditions
[X_(j+1), N_j] change by

    dX_j = dN_j C + N_j dC + dX_(j+1) A + X_(j+1) dA.

Two models have two bases of the state, which are compared after T = O^+ (O + dO), the least-squares map of the observability matrices of
2 n samples in the units of y: the part f of a column turns by dT f too. So a change of the state basis changes nothing, and a covariance of
the model's matrices serves in any gauge.

The number of zeros is taken as right: a wrong one is no matter of angles. So is the noise (one colour, the same power relative to each
channel): the bias of other noise is not in the angle.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy.linalg

from ....base.arrays import Array
from ....base.errors import InvalidData
from ..ranks.sample_windows import ObservedCoordinates
from .estimate import SpaceUncertainty, condition_maps, kernel_conditions


def space_uncertainty(
    rows: Sequence[Array], within: Sequence[Array], covariance: Array, coordinates: ObservedCoordinates, columns: Array
) -> SpaceUncertainty:
    """Return the uncertainty for kernel rows (eta_i + 1, p), combinations of within[i] (q_i, p (eta_i + 1)) with coefficients of this
    covariance, and
    the solutions `columns` (n + p, n_z) of their conditions, all in the observed coordinates."""
    values, vectors = np.linalg.eigh(covariance)
    root = vectors * np.sqrt(np.maximum(values, 0.0))
    every = scipy.linalg.block_diag(*within).T @ root
    return SpaceUncertainty(np.tensordot(every.T, turned_by_rows(rows, coordinates, columns), axes=1))


def turned_by_rows(rows: Sequence[Array], coordinates: ObservedCoordinates, columns: Array) -> Array:
    """Return (sum p (eta_i + 1), n + p, n_z): by what a unit of each coefficient of the rows (eta_i + 1, p) moves the orthonormal basis of
    the span of `columns` (n + p, n_z), off that span, in the coordinates that `coordinates` were made from. The rows and columns are given
    in the observed coordinates, in which the columns solve the conditions of the rows."""
    A, C = coordinates.A, coordinates.C
    lengths = [len(row) for row in rows]
    changes = np.zeros((sum(row.size for row in rows), sum(lengths), columns.shape[1]))
    parameter = condition = 0
    for row in rows:
        responses = condition_maps(A, C, len(row)) @ columns
        changes[parameter : parameter + row.size, condition : condition + len(row)] = responses.transpose(1, 0, 2)
        parameter, condition = parameter + row.size, condition + len(row)
    return _moved(rows, changes, coordinates, columns, None)


def turned_by_model(rows: Sequence[Array], coordinates: ObservedCoordinates, columns: Array) -> Array:
    """Return the same (n (n + p), n + p, n_z) for a unit of each entry of [A; C], in row order, of the observed coordinates, the bases of
    the state matched by the observability matrices."""
    A, C = coordinates.A, coordinates.C
    p, n = C.shape
    if n == 0:
        return np.zeros((0, p, columns.shape[1]))
    units = np.eye(n * (n + p)).reshape(n * (n + p), n + p, n)
    of_A, of_C = units[:, :n], units[:, n:]
    changes = []
    for row in rows:
        X, dX = np.zeros(n), np.zeros((len(of_A), n))
        conditions = []
        for j in reversed(range(len(row))):
            conditions.append(dX @ columns[:n])
            dX = row[j] @ of_C + dX @ A + X @ of_A
            X = row[j] @ C + X @ A
        changes += conditions[::-1]
    scale = coordinates.scale[:, None]
    blocks, moves = [], []
    power, moved = np.eye(n), np.zeros((len(units), n, n))
    for _ in range(2 * n):
        blocks.append(scale * C @ power)
        moves.append(scale * (of_C @ power + C @ moved))
        power, moved = power @ A, of_A @ power + A @ moved
    turn = np.asarray(np.linalg.pinv(np.concatenate(blocks)) @ np.concatenate(moves, axis=1))
    return _moved(rows, np.stack(changes, axis=1), coordinates, columns, turn)


def _moved(rows: Sequence[Array], changes: Array, coordinates: ObservedCoordinates, columns: Array, turn: Array | None) -> Array:
    """Return the movements of the basis for changes (q, conditions, n_z) of what the conditions make of the columns, and turns (q, n, n)
    of the states, both in the observed coordinates."""
    n = coordinates.A.shape[0]
    conditions = np.vstack([kernel_conditions(row[None], coordinates.A, coordinates.C)[0] for row in rows])
    turned = -np.linalg.pinv(conditions) @ changes
    if turn is not None:
        turned[:, :n] += turn @ columns[:n]
    moved = np.array([coordinates.back(change) for change in turned]).reshape(len(turned), *columns.shape)
    Q, R = np.linalg.qr(coordinates.back(columns))
    with np.errstate(all="ignore"):
        found = (moved - Q @ (Q.T @ moved)) @ np.linalg.inv(R) if np.diag(R).all() else np.array(np.nan)
    if not np.isfinite(found).all():
        raise InvalidData(
            f"the outputs have sizes from {coordinates.scale.min():.1g} to {coordinates.scale.max():.1g}: in these "
            "units the columns of the fault space are one up to rounding; pass outputs of like sizes, and the C of these"
        )
    return np.asarray(found)
