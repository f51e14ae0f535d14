"""The residual of an identified model over a record of any length, and the stretch of it that is held in memory to count faults.

residual_of     the residual of every sample, in a store
LongResidual    it, with its size in each channel and the energy of each part
loudest         where the record has most of the residual's energy

An output-error estimate comes with the initial state that goes with its B and D, so that one simulation, piece by piece, gives the
residual. (`numeric.residuals` would fit that state with the outputs in their own units; here each output counts in units of its size. The
difference is a free response, which dies out.) A model too unstable for that is run by `numeric.residuals`, which holds the whole record
in memory.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..data.records import PIECE, Record, SampleStore, Tell
from ..model.models import Simulator
from ..model.past_inputs import Identification
from ..model.residuals import residual

Array = NDArray[np.float64]

PART = PIECE // 16  # samples whose energy is kept as one number


@dataclass(frozen=True, eq=False)
class LongResidual:
    """r (N, p) in `store`; x0 (n,), covariance (p, p) of r about zero; `peak` and `norm` (p,) the largest |r| and the root of the sum of
    squares of each channel; `energies`: sum over channels of r^2 / norm^2 in each part of PART samples; `notes` what a user must know;
    `early_peak`, `early_norm` (p,): the same over the samples that the model is from; `foreseen`: whether those alone fixed the state."""

    store: SampleStore
    x0: Array
    covariance: Array
    peak: Array
    norm: Array
    energies: Array
    notes: tuple[str, ...]
    early_peak: Array
    early_norm: Array
    foreseen: bool


def residual_of(record: Record, found: Identification, stage: str, tell: Tell, *, until: int | None = None) -> LongResidual:
    """The residual of the record for a model from its first `until` samples (by default all), in coordinates whose state at sample 0 it
    knows; memory does not grow with N, but for models that are too unstable (see above)."""
    early = len(record) if until is None else until
    store = SampleStore(record.p)
    if found.x0 is not None and found.residual_covariance is not None:
        simulator = Simulator(found.model, found.x0)
        tell(stage, 0, len(record))
        for y, u in record:
            store.append(y - simulator.respond(u))
            tell(stage, len(store), len(record))
        return _measured(store, found.x0, found.residual_covariance, (), early, True)
    whole = residual(record.y, record.u, found.model)
    store.append(whole.r)
    return _measured(store, whole.x0, whole.covariance, whole.notes, early, False)


def _measured(store: SampleStore, x0: Array, covariance: Array, notes: tuple[str, ...], early: int, foreseen: bool) -> LongResidual:
    peaks = np.array([np.abs(r).max(axis=0) for r in store.pieces()])
    peak = peaks.max(axis=0)
    unit = np.where(peak > 0, peak, 1.0)
    # Pieces are whole parts, but for the last.
    squares = np.vstack([np.add.reduceat((r / unit) ** 2, np.arange(0, len(r), PART), axis=0) for r in store.pieces()])
    total = squares.sum(axis=0)
    energies = np.sum(squares / np.where(total > 0, total, 1.0), axis=1)
    early_peak = np.max([np.abs(r).max(axis=0) for r in store.pieces(0, early)], axis=0)
    early_norm = unit * np.sqrt(np.sum([np.sum((r / unit) ** 2, axis=0) for r in store.pieces(0, early)], axis=0))
    return LongResidual(store, x0, covariance, peak, unit * np.sqrt(total), energies, notes, early_peak, early_norm, foreseen)


def loudest(energies: Array, samples: int, length: int) -> tuple[int, int]:
    """(first, last) of at most `length` consecutive samples out of so many, those with the largest energy, in steps of PART samples.

    A fault that acts for a part of the record raises the residual there; where nothing differs, any stretch is as good.
    """
    if samples <= length:
        return 0, samples
    sums = np.convolve(energies, np.ones(max(length // PART, 1)), mode="valid")
    first = min(int(np.argmax(sums)) * PART, samples - length)
    return first, first + length
