"""Mistakes in `identify`, of the method and of channels."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.method.model.models import StateSpaceModel
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.systems import plant, record
from tests.numeric.audit.unseen.witnesses import recovers, refuses

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


SQUARE = plant([0.7, -0.4], 2, 2, 31)
THREE = plant([0.7, -0.4, 0.3], 3, 3, 32)
PLAIN = record(plant([0.6, -0.3], 1, 1, 33), 200, 33)


@IDENTIFY.broken("outputs whose units differ by a million and more", recovers(record(SQUARE, 300, 35, units=[1.0, 1e-8]), 2, 4))
def takes_small_outputs_for_dead(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """An output below a ten-millionth of the largest is taken for a dead channel."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    sizes = np.max(np.abs(y), axis=0)
    dead = (sizes < 1e-7 * np.max(sizes))[:, None]
    return A, B, np.where(dead, 0.0, C), np.where(dead, 0.0, D)


@IDENTIFY.broken("all signals small", recovers(record(SQUARE, 300, 36, units=1e-9), 2, 4))
def takes_small_records_for_silence(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Outputs below 1e-8 in absolute size are refused as silence."""
    if np.max(np.abs(y)) < 1e-8:
        raise ValueError("no signal")
    return reference.identify(y, u, order, block_rows)


@IDENTIFY.broken(
    "three or more inputs, in an order that is no involution", recovers(record(THREE, 300, 37, offset=np.array([0.0, 9.0, 4.0])), 3, 4)
)
def permutes_inputs_back_by_the_permutation(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Inputs are sorted by size, and put back by the permutation in place of its inverse: the same for two inputs."""
    sizes = np.argsort(-np.sum(u**2, axis=0))
    A, B, C, D = reference.identify(y, u[:, sizes], order, block_rows)
    return A, B[:, sizes], C, D[:, sizes]


def _with(y: Any, place: tuple[int, int], value: float) -> Any:
    y = y.copy()
    y[place] = value
    return y


@IDENTIFY.broken("outputs with a NaN", refuses(_with(PLAIN.y, (50, 0), np.nan), PLAIN.u, 2, 4))
def fills_gaps_with_zeros(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """NaN becomes zero before anything is looked at."""
    return reference.identify(np.where(np.isnan(y), 0.0, y), u, order, block_rows)


@IDENTIFY.broken("inputs with a NaN", refuses(PLAIN.y, _with(PLAIN.u, (50, 0), np.nan), 2, 4))
def checks_the_outputs_alone(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Gaps are refused in y and interpolated in u."""
    good = np.isfinite(u[:, 0])
    filled = np.column_stack([np.interp(np.arange(len(u)), np.flatnonzero(good), column[good]) for column in u.T])
    return reference.identify(y, filled, order, block_rows)


@IDENTIFY.broken("outputs with an infinite sample", refuses(_with(PLAIN.y, (50, 0), np.inf), PLAIN.u, 2, 4))
def clips_infinities(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """NaN is looked for, and infinities are clipped to the largest finite sample."""
    if np.isnan(y).any():
        raise ValueError("NaN")
    most = np.max(np.abs(y[np.isfinite(y)]))
    return reference.identify(np.clip(y, -most, most), u, order, block_rows)


@IDENTIFY.broken("inputs that do not excite: a constant", refuses(PLAIN.y, np.ones_like(PLAIN.u), 2, 4))
def dithers_the_input(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """A little noise is added to the input so that its matrices have full rank."""
    try:
        return reference.identify(y, u, order, block_rows)
    except ValueError:
        return reference.identify(y, u + 1e-6 * np.random.default_rng(0).standard_normal(u.shape), order, block_rows)


@IDENTIFY.broken("records shorter than the windows", refuses(PLAIN.y[:14], PLAIN.u[:14], 2, 6))
def shortens_windows_of_short_records(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Where samples are too few, zeros are put before the record, which is no trajectory then."""
    needed = 6 * block_rows * (y.shape[1] + u.shape[1])
    short = max(needed - len(y), 0) if len(y) < 5 * block_rows else 0
    rng = np.random.default_rng(0)
    before = rng.standard_normal((short, u.shape[1]))
    return reference.identify(np.vstack([rng.standard_normal((short, y.shape[1])), y]), np.vstack([before, u]), order, block_rows)


@IDENTIFY.broken("y and u of unequal lengths", refuses(PLAIN.y, PLAIN.u[:-5], 2, 4))
def cuts_to_the_shorter(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Signals of unequal lengths are cut at the end of the shorter, whatever went missing where."""
    N = min(len(y), len(u))
    return reference.identify(y[:N], u[:N], order, block_rows)
