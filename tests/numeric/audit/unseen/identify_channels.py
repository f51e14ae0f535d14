"""Mistakes in `identify`: channels and their units, offsets, instruments, data that must be refused."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.systems import plant, record
from tests.numeric.audit.unseen.witnesses import recovers, refuses

CHANNELS = Mutants("identify")
Answer = tuple[Any, Any, Any, Any]

SQUARE = plant([0.7, -0.4], 2, 2, 31)
UNLIKE = record(SQUARE, 300, 31, units=[1.0, 1e3])
THREE = plant([0.7, -0.4, 0.3], 3, 3, 32)
SHARED = record(SQUARE, 400, 42).u @ np.array([[1.0, 1.0], [0.0, 1e-3]])
PLAIN = record(plant([0.6, -0.3], 1, 1, 33), 200, 33)


def hankel(x: Any, s: int, columns: int, first: int = 0) -> Any:
    """Return the block Hankel matrix of s rows from sample `first` on."""
    return np.vstack([x[first + k : first + k + columns].T for k in range(s)])


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
