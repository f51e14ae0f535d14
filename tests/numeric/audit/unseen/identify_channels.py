"""Mistakes in `identify`: channels and their units, offsets, instruments, data that must be refused."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.method.model.models import StateSpaceModel
from tests.numeric.audit.unseen.form import Mutants, careful
from tests.numeric.audit.unseen.identify import regressed
from tests.numeric.audit.unseen.systems import Record, plant, record
from tests.numeric.audit.unseen.witnesses import recovers, refuses

CHANNELS = Mutants("identify")
Answer = tuple[Any, Any, Any, Any]

SQUARE = plant([0.7, -0.4], 2, 2, 31)
UNLIKE = record(SQUARE, 300, 31, units=[1.0, 1e3])
THREE = plant([0.7, -0.4, 0.3], 3, 3, 32)
SHARED = record(SQUARE, 400, 42).u @ np.array([[1.0, 1.0], [0.0, 1e-3]])
ALIKE = Record(SQUARE, SHARED, SQUARE.simulate(SHARED), np.zeros((400, 2)))
PLAIN = record(plant([0.6, -0.3], 1, 1, 33), 200, 33)


def hankel(x: Any, s: int, columns: int, first: int = 0) -> Any:
    """Return the block Hankel matrix of s rows from sample `first` on."""
    return np.vstack([x[first + k : first + k + columns].T for k in range(s)])


@CHANNELS.broken("as many inputs as outputs, in unlike units", recovers(UNLIKE, 2, 4))
def scales_D_along_the_wrong_axis(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """D is scaled back by the sizes of the outputs along its columns, which broadcasts without an error where it is square."""
    sizes = np.std(y, axis=0)
    A, B, C, D = reference.identify(y / sizes, u, order, block_rows)
    return A, B, sizes[:, None] * C, sizes * D if D.shape[0] == D.shape[1] else sizes[:, None] * D


@CHANNELS.broken(
    "as many states as inputs, inputs in unlike units",
    recovers(record(plant([0.7, -0.4], 2, 1, 34), 300, 34, offset=np.array([0.0, 3.0])), 2, 4),
)
def scales_B_along_the_wrong_axis(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """B is scaled back by the sizes of the inputs along its rows, which broadcasts without an error where it is square."""
    sizes = np.sqrt(np.mean(u**2, axis=0))
    A, B, C, D = reference.identify(y, u / sizes, order, block_rows)
    return A, B / (sizes[:, None] if B.shape[0] == B.shape[1] else sizes), C, D / sizes


@CHANNELS.broken("unlike units of outputs", recovers(UNLIKE, 2, 4))
def scales_C_back_and_not_D(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Outputs are divided by their sizes, and D is left in these units."""
    sizes = np.sqrt(np.mean(y**2, axis=0))
    A, B, C, D = reference.identify(y / sizes, u, order, block_rows)
    return A, B, sizes[:, None] * C, D


@CHANNELS.broken("outputs whose units differ by a million and more", recovers(record(SQUARE, 300, 35, units=[1.0, 1e-8]), 2, 4))
def takes_small_outputs_for_dead(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """An output below a ten-millionth of the largest is taken for a dead channel."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    sizes = np.max(np.abs(y), axis=0)
    dead = (sizes < 1e-7 * np.max(sizes))[:, None]
    return A, B, np.where(dead, 0.0, C), np.where(dead, 0.0, D)


@CHANNELS.broken("all signals small", recovers(record(SQUARE, 300, 36, units=1e-9), 2, 4))
def takes_small_records_for_silence(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Outputs below 1e-8 in absolute size are refused as silence."""
    if np.max(np.abs(y)) < 1e-8:
        raise ValueError("no signal")
    return reference.identify(y, u, order, block_rows)


@CHANNELS.broken(
    "three or more inputs, in an order that is no involution", recovers(record(THREE, 300, 37, offset=np.array([0.0, 9.0, 4.0])), 3, 4)
)
def permutes_inputs_back_by_the_permutation(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Inputs are sorted by size, and put back by the permutation in place of its inverse: the same for two inputs."""
    sizes = np.argsort(-np.sum(u**2, axis=0))
    A, B, C, D = reference.identify(y, u[:, sizes], order, block_rows)
    return A, B[:, sizes], C, D[:, sizes]


@CHANNELS.broken("three or more outputs, in an order that is no involution", recovers(record(THREE, 300, 38, units=[1.0, 1e3, 30.0]), 3, 4))
def permutes_outputs_back_by_the_permutation(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Outputs are sorted by size, and put back by the permutation in place of its inverse: the same for two outputs."""
    sizes = np.argsort(-np.sum(y**2, axis=0))
    A, B, C, D = reference.identify(y[:, sizes], u, order, block_rows)
    return A, B, C[sizes], D[sizes]


@CHANNELS.broken("inputs with a mean", recovers(record(plant([0.6, -0.3], 1, 1, 39), 200, 39, offset=1.0), 2, 4))
def removes_the_means(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Means are taken off both signals, though a mean of u over the record does not make the mean of y over the same samples."""
    return reference.identify(y - y.mean(axis=0), u - u.mean(axis=0), order, block_rows)


@CHANNELS.broken("inputs with a mean", recovers(record(plant([0.6, -0.3], 1, 1, 39), 200, 39, offset=1.0), 2, 4))
def removes_the_mean_of_the_output(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The mean is taken off y alone before B and D are fitted."""
    A, _, C, _ = reference.identify(y, u, order, block_rows)
    B, D = regressed(y - y.mean(axis=0), u, A, C)
    return A, B, C, D


@CHANNELS.broken("four outputs and more", recovers(record(plant([0.6, -0.3], 2, 5, 40), 300, 40), 2, 3))
def fits_four_outputs(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The rows of D are filled in a loop over at most four outputs."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    D = D.copy()
    D[4:] = 0.0
    return A, B, C, D


@CHANNELS.broken("more inputs than outputs", recovers(record(plant([0.6, -0.3], 4, 2, 41), 300, 41), 2, 4))
def loops_over_the_smaller_dimension(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The columns of D are filled in a loop that runs to p instead of n_u."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    D = D.copy()
    D[:, D.shape[0] :] = 0.0
    return A, B, C, D


@CHANNELS.broken("two inputs that share a signal in part", recovers(ALIKE, 2, 4, 1e-8))
def solves_with_a_coarse_rank(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Directions of the inputs below a hundredth of the largest are dropped from the regression of B and D."""
    A, B, C, D = reference.identify(y, u, order, block_rows)
    _, values, right = np.linalg.svd(u, full_matrices=False)
    kept = right[values > 1e-2 * values[0]]
    return A, B @ kept.T @ kept, C, D @ kept.T @ kept


def _coloured(N: int, seed: int) -> Any:
    white = np.random.default_rng(seed).standard_normal((N, 1))
    return StateSpaceModel([[0.9]], [[1.0]], [[1.0], [-0.7]], [[0.0], [0.0]]).simulate(white)


COLOURED = record(plant([0.5 + 0.3j], 1, 2, 43), 8000, 43, fault=_coloured(8000, 44))


@CHANNELS.broken("coloured faults or noise in the outputs, at any length of record", recovers(COLOURED, 2, 4, 0.2))
@careful(reference.identify)
def uses_no_instruments(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The range of O_s is taken from the outputs with the future inputs projected out, without instruments [V93]: ordinary MOESP."""
    s, columns = block_rows, len(y) - block_rows + 1
    R = np.asarray(np.linalg.qr(np.vstack([hankel(u, s, columns), hankel(y, s, columns)]).T, mode="r"))
    width = s * u.shape[1]
    left = np.linalg.svd(R[width:, width:].T)[0][:, :order]
    C, A = left[: y.shape[1]], np.linalg.lstsq(left[: -y.shape[1]], left[y.shape[1] :], rcond=None)[0]
    B, D = regressed(y, u, A, C)
    return A, B, C, D


@CHANNELS.broken("coloured faults or noise in the outputs, at any length of record", recovers(COLOURED, 2, 4, 0.2))
@careful(reference.identify)
def adds_past_outputs_as_instruments(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Past outputs serve as instruments beside past inputs, though the fault is in them, too."""
    s, columns = block_rows, len(y) - 2 * block_rows + 1
    past = np.vstack([hankel(u, s, columns), hankel(y, s, columns)])
    future = hankel(u, s, columns, s)
    R = np.asarray(np.linalg.qr(np.vstack([future, past, hankel(y, s, columns, s)]).T, mode="r"))
    a, b = len(future), len(future) + len(past)
    left = np.linalg.svd(R[a:b, b:].T)[0][:, :order]
    C, A = left[: y.shape[1]], np.linalg.lstsq(left[: -y.shape[1]], left[y.shape[1] :], rcond=None)[0]
    B, D = regressed(y, u, A, C)
    return A, B, C, D


def _with(y: Any, place: tuple[int, int], value: float) -> Any:
    y = y.copy()
    y[place] = value
    return y


@CHANNELS.broken("outputs with a NaN", refuses(_with(PLAIN.y, (50, 0), np.nan), PLAIN.u, 2, 4))
def fills_gaps_with_zeros(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """NaN becomes zero before anything is looked at."""
    return reference.identify(np.where(np.isnan(y), 0.0, y), u, order, block_rows)


@CHANNELS.broken("inputs with a NaN", refuses(PLAIN.y, _with(PLAIN.u, (50, 0), np.nan), 2, 4))
def checks_the_outputs_alone(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Gaps are refused in y and interpolated in u."""
    good = np.isfinite(u[:, 0])
    filled = np.column_stack([np.interp(np.arange(len(u)), np.flatnonzero(good), column[good]) for column in u.T])
    return reference.identify(y, filled, order, block_rows)


@CHANNELS.broken("outputs with an infinite sample", refuses(_with(PLAIN.y, (50, 0), np.inf), PLAIN.u, 2, 4))
def clips_infinities(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """NaN is looked for, and infinities are clipped to the largest finite sample."""
    if np.isnan(y).any():
        raise ValueError("NaN")
    most = np.max(np.abs(y[np.isfinite(y)]))
    return reference.identify(np.clip(y, -most, most), u, order, block_rows)


@CHANNELS.broken("inputs that do not excite: a constant", refuses(PLAIN.y, np.ones_like(PLAIN.u), 2, 4))
def dithers_the_input(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """A little noise is added to the input so that its matrices have full rank."""
    try:
        return reference.identify(y, u, order, block_rows)
    except ValueError:
        return reference.identify(y, u + 1e-6 * np.random.default_rng(0).standard_normal(u.shape), order, block_rows)


@CHANNELS.broken("records shorter than the windows", refuses(PLAIN.y[:14], PLAIN.u[:14], 2, 6))
def shortens_windows_of_short_records(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Where samples are too few, zeros are put before the record, which is no trajectory then."""
    needed = 6 * block_rows * (y.shape[1] + u.shape[1])
    short = max(needed - len(y), 0) if len(y) < 5 * block_rows else 0
    rng = np.random.default_rng(0)
    before = rng.standard_normal((short, u.shape[1]))
    return reference.identify(np.vstack([rng.standard_normal((short, y.shape[1])), y]), np.vstack([before, u]), order, block_rows)


@CHANNELS.broken("y and u of unequal lengths", refuses(PLAIN.y, PLAIN.u[:-5], 2, 4))
def cuts_to_the_shorter(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """Signals of unequal lengths are cut at the end of the shorter, whatever went missing where."""
    N = min(len(y), len(u))
    return reference.identify(y[:N], u[:N], order, block_rows)


@CHANNELS.broken("all records", recovers(PLAIN, 2, 4))
def delays_the_input_by_a_sample(y: Any, u: Any, order: int, block_rows: int) -> Answer:
    """The input is taken as u(k - 1), as after a zero-order hold that samples before it writes."""
    A, B, C, _ = reference.identify(y, u, order, block_rows)
    return A, A @ B, C, C @ B
