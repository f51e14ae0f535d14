"""This tells how large a residual of any length is, and the stretch of it that is held in memory to count faults."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....base.arrays import Array
from ...data.records import SampleStore
from ...data.validation import PIECE

PART = PIECE // 16  # samples whose energy is kept as one number


@dataclass(frozen=True, eq=False)
class ResidualSizes:
    """How large a residual is, channel by channel and part by part.

    `peak` and `norm` (p,) are the largest |r| and the root of the sum of squares of each channel, in its units; `energies` is the sum over
    channels of r^2 / norm^2 in each part of PART samples; `early_peak` and `early_norm` (p,) are the same as the first two over the samples
    that the model is from.
    """

    peak: Array
    norm: Array
    energies: Array
    early_peak: Array
    early_norm: Array


def residual_sizes(store: SampleStore, early: int) -> ResidualSizes:
    """Return the sizes of r (N, p) in `store`, whose first `early` samples the model is from; r is read three times, in pieces."""
    peaks = np.array([np.abs(r).max(axis=0) for r in store.pieces()])
    peak = peaks.max(axis=0)
    unit = np.where(peak > 0, peak, 1.0)
    # Pieces are whole parts, but for the last.
    squares = np.vstack([np.add.reduceat((r / unit) ** 2, np.arange(0, len(r), PART), axis=0) for r in store.pieces()])
    total = squares.sum(axis=0)
    energies = np.sum(squares / np.where(total > 0, total, 1.0), axis=1)
    early_peak = np.max([np.abs(r).max(axis=0) for r in store.pieces(0, early)], axis=0)
    early_norm = unit * np.sqrt(np.sum([np.sum((r / unit) ** 2, axis=0) for r in store.pieces(0, early)], axis=0))
    return ResidualSizes(peak, unit * np.sqrt(total), energies, early_peak, early_norm)


def loudest(energies: Array, samples: int, length: int) -> tuple[int, int]:
    """Return (first, last) of at most `length` consecutive samples out of so many, those with the largest energy, in steps of PART samples.

    A fault that acts for a part of the record raises the residual there; where nothing differs, any stretch is as good.
    """
    if samples <= length:
        return 0, samples
    sums = np.convolve(energies, np.ones(max(length // PART, 1)), mode="valid")
    first = min(int(np.argmax(sums)) * PART, samples - length)
    return first, first + length
