"""Mistakes in `identify`: poles, the regression of B and D, windows and orders."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.method.model.models import StateSpaceModel
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.systems import plant, record
from tests.numeric.audit.unseen.witnesses import recovers

IDENTIFY = Mutants("identify")
Answer = tuple[Any, Any, Any, Any]


def regressed(y: Any, u: Any, A: Any, C: Any, *, state: bool = True, ridge: float = 0.0, lag: int = 0) -> tuple[Any, Any]:
    """Return B and D by least squares over all samples, from `lag` on; with or without an initial state."""
    (N, p), n, n_u = y.shape, len(A), u.shape[1]
    columns = []
    for j in range(n_u):
        for e in np.eye(n):
            columns.append(StateSpaceModel(A, e[:, None], C, np.zeros((p, 1))).simulate(u[:, j : j + 1]))
    for j in range(n_u):
        for e in np.eye(p):
            columns.append(u[:, j : j + 1] * e)
    if state:
        columns += [StateSpaceModel(A, np.zeros((n, 1)), C, np.zeros((p, 1))).simulate(np.zeros((N, 1)), e) for e in np.eye(n)]
    Phi, right = np.stack(columns, axis=-1)[lag:].reshape((N - lag) * p, -1), y[lag:].reshape(-1)
    if ridge:
        Phi = np.vstack([Phi, ridge * np.eye(Phi.shape[1])])
        right = np.concatenate([right, np.zeros(Phi.shape[1])])
    theta = np.linalg.lstsq(Phi, right, rcond=None)[0]
    B, D = theta[: n * n_u].reshape(n_u, n).T, theta[n * n_u : n * n_u + p * n_u].reshape(n_u, p).T
    return B, D


def diagonal(model: Answer) -> tuple[Any, Any, Any, Any]:
    """Return the model in its complex modal form."""
    A, B, C, D = model
    poles, V = np.linalg.eig(A)
    return poles, np.linalg.solve(V, B.astype(complex)), C @ V, D


RINGING = record(plant([0.6 + 0.5j, -0.4], 1, 2, 1), 300, 1)
# The second output is the first one again: it shortens no observability index.


@IDENTIFY.broken("systems with an unstable pole", recovers(record(plant([1.02, 0.5], 1, 1, 3), 120, 3), 2, 4))
def reflects_unstable_poles(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Poles outside the unit circle are reflected into it, as filters do."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    poles, V = np.linalg.eig(A)
    poles = np.where(np.abs(poles) > 1, 1 / np.conj(poles), poles)
    return (V @ np.diag(poles) @ np.linalg.inv(V)).real, B, C, D


@IDENTIFY.broken("systems with an unstable pole", recovers(record(plant([1.02, 0.5], 1, 1, 3), 120, 3), 2, 4))
def refuses_unstable_systems(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """A model whose A is not stable is taken for a failure of the method."""
    found = reference.identify(y, u, order, block_rows)
    if np.max(np.abs(np.linalg.eigvals(found[0]))) > 1:
        raise ValueError("unstable")
    return found


@IDENTIFY.broken(
    "a D some of whose entries are a thousandth of the others",
    recovers(record(StateSpaceModel([[0.5]], [[1.0, 1.0]], [[1.0]], [[1.0, 5e-4]]), 200, 9), 1, 3),
)
def tidies_small_entries_of_D(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Entries of D below a thousandth of the largest are set to zero."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return A, B, C, np.where(np.abs(D) < 1e-3 * np.max(np.abs(D), initial=0.0), 0.0, D)


@IDENTIFY.broken("records that do not begin at rest", recovers(RINGING, 3, 5))
def starts_from_rest(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The regression of B and D has no initial state."""
    A, _, C, _ = reference.identify(y, u, order, block_rows)
    return A, regressed(y, u, A, C, state=False)[0], C, regressed(y, u, A, C, state=False)[1]


@IDENTIFY.broken(
    "order nine and more",
    recovers(record(plant([0.9, 0.7, 0.5, 0.3, -0.2, -0.4, -0.6, -0.8, 0.3 + 0.8j], 1, 3, 17), 500, 17), 10, 12, 1e-6),
)
def has_room_for_eight_states(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The order is cut at eight, the size of a workspace."""
    return reference.identify(y, u, min(order, 8), block_rows)


@IDENTIFY.broken("records longer than five hundred samples", recovers(record(plant([0.8, -0.4], 1, 1, 18), 700, 18), 2, 4))
def thins_long_records(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Every second sample of long records is left out to save time, though the model then has another sample time."""
    step = 2 if len(y) > 500 else 1
    return reference.identify(y[::step], u[::step], order, block_rows)


@IDENTIFY.broken("order one", recovers(record(plant([0.8], 1, 1, 20), 100, 20), 1, 3))
def squeezes_a_single_state(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Matrices are squeezed, so that those of one state, or of one channel, lose their axes."""
    return tuple(np.squeeze(one) for one in reference.identify(y, u, order, block_rows))  # type: ignore[return-value]
