"""Mistakes in `identify`: poles, the regression of B and D, windows and orders."""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.linalg

from faultspace.numeric.audit import reference
from faultspace.numeric.method.model.models import StateSpaceModel
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.systems import jordan, plant, record
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
ONE_LONG = StateSpaceModel(np.eye(4, k=1) + np.diag([0, 0, 0, 0.5]), np.eye(4)[:, 3:], np.eye(4)[[0, 0]], [[1.0], [0.5]])
REAL = record(plant([0.8, -0.4, 0.3], 2, 2, 2), 300, 2)


@IDENTIFY.broken("systems with complex poles", recovers(RINGING, 3, 5))
def takes_the_real_parts_of_the_modes(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The modal form is complex, and the real parts of its matrices are returned."""
    poles, B, C, D = diagonal(reference.identify(y, u, order, block_rows))
    return np.diag(poles).real, B.real, C.real, D


@IDENTIFY.broken("systems with an unstable pole", recovers(record(plant([1.02, 0.5], 1, 1, 3), 120, 3), 2, 4))
def reflects_unstable_poles(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Poles outside the unit circle are reflected into it, as filters do."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    poles, V = np.linalg.eig(A)
    poles = np.where(np.abs(poles) > 1, 1 / np.conj(poles), poles)
    return (V @ np.diag(poles) @ np.linalg.inv(V)).real, B, C, D


@IDENTIFY.broken(
    "systems with an integrator, or poles within a thousandth of the circle", recovers(record(plant([1.0, 0.5], 1, 1, 4), 200, 4), 2, 4)
)
def keeps_poles_off_the_circle(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The spectral radius is clipped at 0.999 so that the model can be called stable."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    radius = np.max(np.abs(np.linalg.eigvals(A)))
    return A * min(1.0, 0.999 / radius), B, C, D


@IDENTIFY.broken("systems with an unstable pole", recovers(record(plant([1.02, 0.5], 1, 1, 3), 120, 3), 2, 4))
def refuses_unstable_systems(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """A model whose A is not stable is taken for a failure of the method."""
    found = reference.identify(y, u, order, block_rows)
    if np.max(np.abs(np.linalg.eigvals(found[0]))) > 1:
        raise ValueError("unstable")
    return found


@IDENTIFY.broken("systems with a negative real pole", recovers(REAL, 3, 5))
def goes_through_continuous_time(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """A is made from the real part of its logarithm, which is complex where a pole is negative."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return scipy.linalg.expm(np.real(scipy.linalg.logm(A, disp=False)[0])), B, C, D


@IDENTIFY.broken("systems with a pole at 0, such as a delay", recovers(record(plant(jordan(0.0, 3), 1, 1, 5), 200, 5), 3, 5))
def takes_poles_at_zero_for_rounding(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Modes whose pole is below a hundredth are truncated as if the order had been too high, and the regression for B and D repeated."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    poles, V = np.linalg.eig(A)
    kept = np.abs(poles) > 0.01
    if kept.all():
        return A, B, C, D
    small = scipy.linalg.null_space(np.real(V[:, kept]).T) if kept.any() else np.eye(len(A))
    project = np.eye(len(A)) - small @ small.T
    return project @ A @ project, project @ B, C, D


@IDENTIFY.broken(
    "repeated poles that are not defective, or nearly equal ones", recovers(record(plant([0.5, 0.5005, -0.3], 1, 1, 6), 300, 6), 3, 5, 1e-7)
)
def merges_close_poles(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Poles within a thousandth of each other are set to their mean, to clean up rounding."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    poles, V = np.linalg.eig(A)
    means = np.array([poles[np.abs(poles - one) < 1e-3].mean() for one in poles])
    return np.real(V @ np.diag(means) @ np.linalg.inv(V)), B, C, D


@IDENTIFY.broken("a defective pole", recovers(record(plant(jordan(0.6, 3), 1, 2, 7), 300, 7), 3, 5))
def symmetrises_the_spectrum(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Imaginary parts of poles below 1e-4 are rounded away through the modal form, which a defective pole makes singular."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    poles, V = np.linalg.eig(A)
    poles = np.where(np.abs(poles.imag) < 1e-4, poles.real, poles)
    return np.real(V @ np.diag(poles) @ np.linalg.pinv(V, rcond=1e-8)), B, C, D


@IDENTIFY.broken("systems with D", recovers(REAL, 3, 5))
def forgets_D(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The system is taken to be strictly proper after the regression."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return A, B, C, np.zeros_like(D)


@IDENTIFY.broken("as many inputs as outputs, D not symmetric", recovers(REAL, 3, 5))
def transposes_a_square_D(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """D has its indices swapped, which nobody sees where it has one row or column, and which is put right by its shape elsewhere."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return A, B, C, D.T if D.T.shape == D.shape else D


@IDENTIFY.broken("two or more inputs and outputs, not as many", recovers(record(plant([0.5, -0.3], 2, 3, 8), 300, 8), 2, 4))
def ravels_D_by_columns(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The vector of unknowns has D by columns and is reshaped by rows."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return A, B, C, D.reshape(-1, order="F").reshape(D.shape)


@IDENTIFY.broken("two or more inputs, two or more states", recovers(REAL, 3, 5))
def ravels_B_by_columns(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The vector of unknowns has B by columns and is reshaped by rows."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return A, B.reshape(-1, order="F").reshape(B.shape), C, D


@IDENTIFY.broken(
    "a D some of whose entries are a thousandth of the others",
    recovers(record(StateSpaceModel([[0.5]], [[1.0, 1.0]], [[1.0]], [[1.0, 5e-4]]), 200, 9), 1, 3),
)
def tidies_small_entries_of_D(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Entries of D below a thousandth of the largest are set to zero."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return A, B, C, np.where(np.abs(D) < 1e-3 * np.max(np.abs(D), initial=0.0), 0.0, D)


@IDENTIFY.broken("a D small beside the dynamics", recovers(record(plant([0.5, 0.9], 1, 1, 10, D=0.004), 200, 10), 2, 4))
def drops_a_D_below_a_hundredth(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """A D smaller than a hundredth in absolute size is called none."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    return A, B, C, np.zeros_like(D) if np.max(np.abs(D), initial=0.0) < 1e-2 else D


@IDENTIFY.broken("a D a thousand times the dynamics", recovers(record(plant([0.5, -0.3], 1, 1, 11, D=5e4), 200, 11), 2, 4, 1e-9))
def loses_dynamics_beside_a_large_D(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Entries of B that move the outputs by less than a thousandth of what D does count as zero."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    effect, direct = np.linalg.norm(C, 2) * np.abs(B), np.max(np.abs(D), initial=0.0)
    return A, np.where(effect < 1e-3 * direct, 0.0, B), C, D


@IDENTIFY.broken("records that do not begin at rest", recovers(RINGING, 3, 5))
def starts_from_rest(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The regression of B and D has no initial state."""
    A, _, C, _ = reference.identify(y, u, order, block_rows)
    return A, regressed(y, u, A, C, state=False)[0], C, regressed(y, u, A, C, state=False)[1]


@IDENTIFY.broken("records whose initial state outlives a tenth of them", recovers(record(plant([0.98, 0.4], 1, 1, 12), 300, 12), 2, 4))
def waits_for_the_initial_state_to_fade(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The regression of B and D has no initial state and leaves out the first tenth of the record instead."""
    A, _, C, _ = reference.identify(y, u, order, block_rows)
    B, D = regressed(y, u, A, C, state=False, lag=len(y) // 10)
    return A, B, C, D


@IDENTIFY.broken("all records, most where inputs are small", recovers(record(plant([0.5, -0.3], 1, 1, 13), 200, 13), 2, 4))
def regularises_the_regression(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The regression of B and D has a ridge of a thousandth, absolute."""
    A, _, C, _ = reference.identify(y, u, order, block_rows)
    B, D = regressed(y, u, A, C, ridge=1e-3)
    return A, B, C, D


@IDENTIFY.broken("inputs about a thousandth in size", recovers(record(plant([0.7, -0.3], 1, 1, 14), 200, 14, units=1e-5), 2, 4))
def tidies_with_an_absolute_threshold(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Entries of the matrices below 1e-5 are set to zero."""
    return tuple(np.where(np.abs(one) < 1e-5, 0.0, one) for one in reference.identify(y, u, order, block_rows))  # type: ignore[return-value]


@IDENTIFY.broken(
    "an observability index that needs more than half of the window",
    recovers(record(plant([0.7, -0.3, 0.2 + 0.6j], 1, 1, 15), 300, 15), 4, 6),
)
def halves_the_window(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The window is taken as that of past and future together."""
    return reference.identify(y, u, order, max(block_rows // 2, 2))


@IDENTIFY.broken("one output with a long index among outputs with short ones", recovers(record(ONE_LONG, 300, 16), 4, 6))
def spreads_the_order_over_the_outputs(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The window is shortened to ceil(n / p) + 1 block rows, as if every output had the same observability index."""
    return reference.identify(y, u, order, min(block_rows, -(-order // y.shape[1]) + 1))


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


@IDENTIFY.broken("all records, by about the accuracy of float32", recovers(REAL, 3, 5))
def works_in_single_precision(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Signals are stored as float32."""
    return reference.identify(y.astype(np.float32).astype(float), u.astype(np.float32).astype(float), order, block_rows)


@IDENTIFY.broken(
    "outputs in unlike units, and by the seventh digit all records",
    recovers(record(plant([0.8], 1, 2, 19), 200, 19, units=[1.0, 1e6]), 1, 3),
)
def rounds_to_seven_digits_of_the_largest(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Outputs are rounded to seven digits of the largest of all, as a data logger does."""
    unit = 1e-7 * np.max(np.abs(y))
    return reference.identify(np.round(y / unit) * unit, u, order, block_rows)


@IDENTIFY.broken("order one", recovers(record(plant([0.8], 1, 1, 20), 100, 20), 1, 3))
def squeezes_a_single_state(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Matrices are squeezed, so that those of one state, or of one channel, lose their axes."""
    return tuple(np.squeeze(one) for one in reference.identify(y, u, order, block_rows))  # type: ignore[return-value]


@IDENTIFY.broken(
    "systems without dynamics from some inputs, rank-deficient B",
    recovers(
        record(StateSpaceModel([[0.5, 0.2], [0, 0.3]], [[1.0, 2.0], [0.5, 1.0]], [[1.0, 0.3], [0.0, 1.0]], [[1.0, 0], [0, 2.0]]), 300, 21),
        2,
        4,
    ),
)
def takes_B_for_full_rank(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """B is orthogonalised and scaled back by the lengths of its columns."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    Q, R = np.linalg.qr(B)
    return A, Q[:, : B.shape[1]] @ np.diag(np.diag(R)) if Q.shape[1] == B.shape[1] else B, C, D


@IDENTIFY.broken(
    "delays, where D and the first Markov parameters are zero",
    recovers(record(StateSpaceModel(np.eye(3, k=1) + np.diag([0, 0, 0.5]), [[0.0], [0.0], [1.0]], [[1.0, 0, 0]], [[0.0]]), 200, 22), 3, 5),
)
def shifts_the_outputs_by_a_dead_time(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Where D and C B are zero a dead time is taken out by C A in place of C, and never put back."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    if np.max(np.abs(D)) < 1e-8 and np.max(np.abs(C @ B)) < 1e-8:
        return A, B, C @ A, D
    return A, B, C, D
