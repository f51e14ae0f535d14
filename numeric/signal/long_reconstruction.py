"""The fault signal over a record of any length: the smoother of `numeric.reconstruction` on pieces that overlap.

reconstructed   v of every sample, in a store
FaultSignal     it, with delay, zeros, the samples to be trusted and how well it explains the residual

What is unknown at the edges of a piece (its initial state; through zeros outside the unit circle the future) fades at a known rate: of
each piece the middle is kept, and `mismatch` tells by how much neighbours differ where they meet. Where nothing fades (a zero on the
unit circle, faults that r does not determine) or it fades too slowly for pieces of LONGEST samples, the whole residual is held in memory.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..data.records import SampleStore, Tell
from .reconstruction import Reconstruction, reconstruct_fault

Array = NDArray[np.float64]

LONGEST = 1 << 16
LEAST_MARGIN = 1 << 10  # samples left out at an inner edge, at least: the smoother forgets noise in far fewer
COMPARED = 64


@dataclass(frozen=True, eq=False)
class FaultSignal:
    """v (N, n_v) in `store`; delay, trusted (first, last), zeros, misfit and reason as in `Reconstruction`; mismatch: the largest
    difference of neighbouring pieces where they meet, relative to the size of v there (0 where there is one piece); left, whole (p,): sums
    of squares of r - simulated and of r in each output, over the samples that were asked for."""

    store: SampleStore
    delay: int | None
    trusted: tuple[int, int]
    zeros: NDArray[np.complex128]
    left_invertible: bool
    misfit: float
    mismatch: float
    reason: str
    left: Array
    whole: Array

    def explained(self, units: Array) -> float:
        """The share of r that the signal explains, in squares, the outputs in these units (p,)."""
        whole = float(np.sum(self.whole / units**2))
        return 1.0 - float(np.sum(self.left / units**2)) / whole if whole else 0.0


def reconstructed(
    r: SampleStore, A: Array, F: Array, C: Array, G: Array, stage: str, tell: Tell, *, judged: tuple[int, int] | None = None
) -> FaultSignal:
    """The signal of the faults F (n, n_v), G (p, n_v) in r (N, p); `judged`: samples (first, last) of `left` and `whole`, by default all.

    Raises InvalidData as `reconstruct_fault`.
    """
    N = len(r)
    within = judged or (0, N)
    tell(stage, 0, N)
    begin = reconstruct_fault(r.read(0, LONGEST), A, F, C, G)
    if N <= LONGEST:
        return _single(begin, r, within, tell, stage)
    lost = begin.trusted[0], LONGEST - begin.trusted[1]
    margin = max(*lost, LEAST_MARGIN)
    if begin.trusted[0] >= begin.trusted[1] or 4 * margin > LONGEST:
        return _single(reconstruct_fault(r.read(0, N), A, F, C, G), r, within, tell, stage)
    v, left, mismatch = SampleStore(F.shape[1]), 0.0, 0.0
    parts = np.zeros((2, r.width))
    start, piece = 0, begin
    while True:
        end = start + len(piece.v)
        kept = N if end == N else end - margin
        part = slice(len(v) - start, kept - start)
        given = r.read(start, end)[part]
        error = given - piece.simulated[part]
        left += float(np.sum(error**2))
        parts += _squares(error, given, len(v), within)
        v.append(piece.v[part])
        tell(stage, kept, N)
        if end == N:
            break
        before = piece.v[kept - start : kept - start + COMPARED]
        start = min(kept - margin, N - LONGEST)
        piece = reconstruct_fault(r.read(start, start + LONGEST), A, F, C, G)
        after = piece.v[kept - start : kept - start + COMPARED]
        size = float(np.linalg.norm(after))
        mismatch = max(mismatch, float(np.linalg.norm(after - before)) / size if size else 0.0)
    whole = float(sum(np.sum(part**2) for part in r.pieces()))
    trusted = begin.trusted[0], N - (len(piece.v) - piece.trusted[1])
    misfit = float(np.sqrt(left / whole)) if whole else 0.0
    return FaultSignal(v, begin.delay, trusted, begin.zeros, begin.left_invertible, misfit, mismatch, begin.reason, *parts)


def _squares(error: Array, given: Array, start: int, within: tuple[int, int]) -> Array:
    """Sums of squares (2, p) of both over those samples `within`; the first one is sample `start`."""
    first, last = (min(max(edge - start, 0), len(given)) for edge in within)
    return np.stack([np.sum(rows[first:last] ** 2, axis=0) for rows in (error, given)])


def _single(whole: Reconstruction, r: SampleStore, within: tuple[int, int], tell: Tell, stage: str) -> FaultSignal:
    store = SampleStore(whole.v.shape[1])
    store.append(whole.v)
    tell(stage, len(store), len(store))
    given = r.read(0, len(whole.v))
    parts = _squares(given - whole.simulated, given, 0, within)
    return FaultSignal(store, whole.delay, whole.trusted, whole.zeros, whole.left_invertible, whole.misfit, 0.0, whole.reason, *parts)
