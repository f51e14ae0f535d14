"""Witnesses: legitimate questions whose right answer is known, with the error of an answer beside what rounding may make of it.

answered        the witness for a distance from the truth; refusing and crashing are as far as can be
refuses         the witness that a question without an answer is refused
recovers        identify: the Markov parameters, in units of each output's largest
takes_out       residual: what is left of y, up to a free response
ranks, counts   the numbers themselves
spans           fault_space: the angle between two spaces, outputs in units of their size
restores        reconstruct: the signal without its last samples, which no output has seen yet
has_structure   structure: ranks and orders must be equal, zeros are matched in pairs
explains        identified_fault_space: the angle between pulse responses, which no state basis changes
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from scipy.optimize import linear_sum_assignment

from faultspace.numeric.audit.adapter import guarded
from faultspace.numeric.audit.records import Broken, Refused
from faultspace.numeric.method.model.models import StateSpaceModel
from tests.numeric.audit.unseen.form import Function, Witness
from tests.numeric.audit.unseen.systems import Faulty, Matrices, Record, free_responses

ROUNDED = 1e-9  # of the size of the answer: all questions here are well posed, and the reference stays below it


def copies(arguments: Sequence[Any]) -> list[Any]:
    """Return the arguments with arrays of their own, in the same order of memory."""
    return [one.copy(order="K") if isinstance(one, np.ndarray) else one for one in arguments]


def answered(distance: Callable[[Any], float], *arguments: Any, limit: float = ROUNDED) -> Witness:
    """The error is distance(answer) / limit, infinite for what is no answer."""

    def witness(function: Function) -> float:
        try:
            got = distance(guarded(function)(*copies(arguments))) / limit
        except (Refused, Broken, ValueError, IndexError, TypeError):
            return np.inf
        return float(got) if got == got else np.inf

    return witness


def refuses(*arguments: Any) -> Witness:
    """An answer is an error, and so is a crash."""

    def witness(function: Function) -> float:
        try:
            guarded(function)(*copies(arguments))
        except Refused:
            return 0.0
        except Broken:
            return np.inf
        return np.inf

    return witness


def markov_distance(model: StateSpaceModel) -> Callable[[Any], float]:
    """Return the distance of A, B, C, D from a model."""
    count = 2 * model.n + 4
    truth = np.asarray(model.markov(count))
    sizes = np.max(np.abs(truth), axis=(0, 2), keepdims=True)

    def distance(answer: Any) -> float:
        got = np.asarray(StateSpaceModel(*(np.asarray(one) for one in answer)).markov(count))
        if got.shape != truth.shape:
            return np.inf
        return float(np.max(np.abs(got - truth) / sizes))

    return distance


def recovers(found: Record, order: int, block_rows: int, limit: float = ROUNDED) -> Witness:
    """The model of a record."""
    return answered(markov_distance(found.model), found.y, found.u, order, block_rows, limit=limit)


def takes_out(found: Record, limit: float = ROUNDED) -> Witness:
    """The residual of a record under its own model, up to a free response of that model."""
    model, N = found.model, len(found.y)
    free = free_responses(model.A, model.C, N)
    scale = np.max(np.abs(found.y), axis=0)
    columns = np.linalg.qr((free / scale[:, None]).reshape(N * model.p, model.n))[0]

    def distance(r: Any) -> float:
        got = np.asarray(r)
        if got.shape != found.y.shape:
            return np.inf
        error = ((got - found.fault) / scale).reshape(-1)
        return float(np.max(np.abs(error - columns @ (columns.T @ error))))

    return answered(distance, found.y, found.u, model.A, model.B, model.C, model.D, limit=limit)


def ranks(truth: Sequence[int], r: Any) -> Witness:
    """The ranks of the windows of r."""
    return answered(lambda got: float(list(got) != list(truth)), r, len(truth))


def counts(n_v: int, *arguments: Any) -> Witness:
    """A number of faults."""
    return answered(lambda got: float(int(got) != n_v or isinstance(got, float)), *arguments)


def angle(one: Any, other: Any) -> float:
    """Return the sine of the largest angle between the spans of columns, one where their dimensions differ."""
    one, other = np.asarray(one), np.asarray(other)
    if one.shape != other.shape:
        return 1.0
    left, right = (np.linalg.qr(columns / np.linalg.norm(columns, axis=0))[0] for columns in (one, other))
    return float(np.linalg.norm(left - right @ (right.T @ left), 2))


def spans(found: Faulty, truth: Any, n_v: int, block_rows: int, limit: float = ROUNDED) -> Witness:
    """The fault space, `truth` (n + p, n_z) known by construction."""
    n = len(found.A)
    sizes = np.concatenate([np.ones(n), np.sqrt(np.mean(found.r**2, axis=0))])[:, None]
    known = np.asarray(truth) / sizes
    return answered(lambda Z: angle(np.asarray(Z) / sizes, known), found.r, found.A, found.C, n_v, block_rows, limit=limit)


def restores(found: Faulty, limit: float = ROUNDED, *, hidden: int = 0) -> Witness:
    """The fault signal, each in units of its own size, without the last `hidden` samples, that zeros outside the unit circle disturb."""
    n = len(found.A)
    truth = found.v[: len(found.v) - max(n, hidden)]
    sizes = np.max(np.abs(truth), axis=0)

    def distance(v: Any) -> float:
        got = np.asarray(v)
        return np.inf if got.shape != found.v.shape else float(np.max(np.abs(got[: len(truth)] - truth) / sizes))

    return answered(distance, found.r, found.A, found.F, found.C, found.G, found.x0, limit=limit)


def has_structure(system: Matrices, zeros: Sequence[complex] | Any, orders: Sequence[int], limit: float = 1e-6) -> Witness:
    """Normal rank, zeros and left-invertibility; of complex zeros each one is named, repeated ones as often as they are."""
    m = system[1].shape[1]

    def distance(answer: Any) -> float:
        if answer.normal_rank != len(orders) or list(answer.infinite_zero_orders) != sorted(orders):
            return np.inf
        if bool(answer.left_invertible) != (len(orders) == m) or len(answer.finite_zeros) != len(zeros):
            return np.inf
        got, truth = np.asarray(answer.finite_zeros, dtype=complex), np.asarray(zeros, dtype=complex)
        apart = np.abs(got[:, None] - truth) / (1 + np.abs(truth))
        rows, columns = linear_sum_assignment(apart)
        return float(np.max(apart[rows, columns], initial=0.0))

    return answered(distance, *system, limit=limit)


def pulses(A: Any, C: Any, Z: Any, count: int) -> Any:
    """Return the responses [g; C f; C A f; ...] of the columns [f; g]."""
    A, C, Z = np.asarray(A), np.asarray(C), np.asarray(Z)
    state, blocks = Z[: len(A)], [Z[len(A) :]]
    for _ in range(count):
        blocks.append(C @ state)
        state = A @ state
    return np.vstack(blocks)


def explains(y: Any, u: Any, order: int, n_v: int, truth: tuple[Any, Any, Any], limit: float) -> Witness:
    """A model with its fault columns; outputs in units of their size."""
    sizes = np.tile(np.sqrt(np.mean(y**2, axis=0)), order + 3)[:, None]
    known = pulses(*truth, order + 2) / sizes
    return answered(lambda got: angle(pulses(got[0], got[1], got[2], order + 2) / sizes, known), y, u, order, n_v, limit=limit)
