"""This reconstructs the fault signal of a residual of any length: the smoother on the whole, or on pieces that overlap.

    reconstruct_fault   v of every sample, for r in memory or in a store
    Reconstruction      it, with delay, zeros, the samples to be trusted and how well it explains the residual

A residual of at most LONGEST samples is one piece. Of a longer one, what is unknown at the edges of a piece (its initial state; through
zeros outside the unit circle the future) fades at a known rate: of each piece the middle is kept, and `mismatch` tells by how much
neighbours differ where they meet. Where nothing fades (a zero on the unit circle, faults that r does not determine), where it fades too
slowly for pieces of LONGEST samples, and where the initial state is given, the whole residual is held in memory.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.progress import Progress, silent
from ....base.sheets import Shown, counted
from ....base.threads import one_thread
from ...data.plain import by_name
from ...data.records import SampleStore, Stored, stored
from ...data.validation import signal
from ..plotting import plot_stored_signal
from ..ranks.arguments import not_zero
from .smoother import Solution, Stretch, simulated, smoothed

LONGEST = 1 << 16
LEAST_MARGIN = 1 << 10  # samples left out at an inner edge, at least: the smoother forgets noise in far fewer
COMPARED = 64


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class Reconstruction(Solution, Shown):
    """A fault signal v (N, n_v), kept in `store`, with x(k+1) = A x + F v and `simulated` = C x + G v.

    delay            samples until v(k) is seen, from a known x(0), or from an unknown one if such a delay exists; None where the system
                     is not left-invertible, so that v is not determined at all
    trusted          (first, last): v[first:last] is disturbed by no zero and no delay; empty where first >= last
    zeros            finite zeros of (A, F, C, G)
    left_invertible  whether v is determined by r and x(0) in principle
    misfit           |r - simulated| / |r|
    reason           what is determined and what is not, in words
    mismatch         the largest difference of neighbouring pieces where they meet, relative to the size of v there; 0 for one piece
    left, whole      (p,): sums of squares of r - simulated and of r in each output, over the samples that were asked for
    x0               (n,): the state at the first sample
    pair             A, F, C and G, which the signal belongs to

    r and `simulated` are in the units of y. Raises ImportError in `plot()` without matplotlib. Source: [HP98], [MZ10].

    >>> import numpy as np
    >>> from faultspace.numeric import reconstruct_fault
    >>> v = np.sin(np.arange(50.0))[:, np.newaxis]
    >>> reconstruct_fault(np.hstack([v, 2 * v]), [[0.5]], [[0.0]], [[1.0], [0.0]], [[1.0], [2.0]])
    <Reconstruction: fault signal of 50 samples, n_v 1: samples 0 to 49 are determined>
    """

    store: SampleStore
    mismatch: float
    left: Array
    whole: Array

    @cached_property
    def v(self) -> Array:
        """Return the signal (N, n_v), all of it in memory."""
        return self.store.read(0, len(self.store))

    @cached_property
    @one_thread()
    def _simulated(self) -> tuple[Array, Array]:
        return simulated(*self.pair, self.x0, self.v)

    @property
    def x(self) -> Array:
        """Return the states (N, n) that v drives from x0, all of them in memory."""
        return self._simulated[0]

    @property
    def simulated(self) -> Array:
        """Return C x + G v (N, p), all of it in memory."""
        return self._simulated[1]

    @property
    def title(self) -> str:
        """Return what the signal is, on one short line."""
        first, last = self.trusted
        determined = "no sample is determined" if first >= last else f"samples {first} to {last - 1} are determined"
        return f"fault signal of {counted(len(self.store), 'sample')}, n_v {self.store.width}: {determined}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield what there is to say of it, as pairs of a name and a value."""
        yield "why", self.reason
        yield "delay until it is seen", "not determined by the outputs" if self.delay is None else counted(self.delay, "sample")
        yield "moduli of the finite zeros", ", ".join(f"{size:.4g}" for size in np.abs(self.zeros)) or "none"
        yield "|r - simulated| / |r|, all outputs", f"{100 * self.misfit:.2g} %"
        if self.mismatch:
            yield "largest difference of pieces", f"{self.mismatch:.2g} of the signal"

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict of everything but the samples, which `v` has; complex zeros are [real, imaginary]."""
        found = by_name(self, "delay", "trusted", "zeros", "left_invertible", "misfit", "mismatch", "reason", "x0")
        return {"samples": len(self.store), "n_v": self.store.width} | found

    def plot(self, ax: Any = None) -> Any:
        """Draw the signal into the matplotlib axes `ax`, new ones where None are given, and return them; samples that are not determined
        are shaded. Raises ImportError without matplotlib."""
        return plot_stored_signal(self.store, self.trusted, ax=ax)

    @property
    def fit(self) -> float:
        """Return 1 - misfit, which is one where the simulated residual equals the given one."""
        return 1.0 - self.misfit

    def explained(self, units: Array) -> float:
        """Return the share of r that the signal explains, in squares, the outputs in these units (p,)."""
        whole = float(np.sum(self.whole / units**2))
        return 1.0 - float(np.sum(self.left / units**2)) / whole if whole else 0.0


@one_thread()
def reconstruct_fault(
    r: ArrayLike | SampleStore | Stored,
    A: ArrayLike,
    F: ArrayLike,
    C: ArrayLike,
    G: ArrayLike,
    *,
    x0: ArrayLike | None = None,
    within: tuple[int, int] | None = None,
    on_progress: Progress | None = None,
) -> Reconstruction:
    """Reconstruct the signal v of the faults F, G whose simulated residual equals r, by the smoother of [HP98], [MZ10].

    Parameters
    ----------
    r : array_like (N, p), a store, or the ResidualSignal of `residual`
        In the units of y.
    A, F, C, G : array_like, (n, n), (n, n_v), (p, n) and (p, n_v)
    x0 : array_like (n,), optional
        The initial state, where it is known.
    within : (int, int), optional
        The samples (first, last) of `left` and `whole`, by default all.
    on_progress : callable, optional
        Hears (stage, done, total).

    Returns
    -------
    Reconstruction
        `v` (N, n_v) in units of r over those of G, where it is `trusted`, and its `delay`.

    Raises
    ------
    InvalidData
        Shapes that do not fit, values that are not finite, no fault or more than outputs, a fault with zero columns in both F and G, a
        model so unstable that the record overflows.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import reconstruct_fault
    >>> v = np.sin(np.arange(50.0))[:, np.newaxis]
    >>> r = np.hstack([v, 2 * v])
    >>> found = reconstruct_fault(r, [[0.5]], [[0.0]], [[1.0], [0.0]], [[1.0], [2.0]])
    >>> found.delay, bool(np.allclose(found.v, v))
    (0, True)
    """
    on_progress = on_progress or silent
    held: Any = getattr(r, "store", r)
    store = held if isinstance(held, SampleStore) else stored(signal(held, "r"))
    N = len(store)
    kept = within or (0, N)

    def solve(start: int, stop: int, state: ArrayLike | None = None) -> Stretch:
        return smoothed(store.read(start, stop), A, F, C, G, x0=state)

    on_progress("reconstructing the fault signal", 0, N)
    not_zero(any(np.any(rows) for rows in store.pieces()))
    begin, margin = solve(0, N if x0 is not None else min(N, LONGEST), x0), 0
    if len(begin.v) < N:
        margin = max(begin.trusted[0], LONGEST - begin.trusted[1], LEAST_MARGIN)
        if begin.trusted[0] >= begin.trusted[1] or 4 * margin > LONGEST:
            begin = solve(0, N)
    found = _joined(begin, solve, store, margin, kept, on_progress)
    on_progress("reconstructing the fault signal", N, N)
    return found


def _joined(
    begin: Stretch, solve: Callable[[int, int], Stretch], r: SampleStore, margin: int, within: tuple[int, int], on_progress: Progress
) -> Reconstruction:
    """Join the middles of the pieces that `solve` gives, one after the other."""
    N = len(r)
    v, left, mismatch = SampleStore(begin.v.shape[1]), 0.0, 0.0
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
        on_progress("reconstructing the fault signal", kept, N)
        if end == N:
            break
        before = piece.v[kept - start : kept - start + COMPARED]
        start = min(kept - margin, N - LONGEST)
        piece = solve(start, start + LONGEST)
        after = piece.v[kept - start : kept - start + COMPARED]
        size = float(np.linalg.norm(after))
        mismatch = max(mismatch, float(np.linalg.norm(after - before)) / size if size else 0.0)
    whole = float(sum(np.sum(part**2) for part in r.pieces()))
    trusted = begin.trusted[0], N - (len(piece.v) - piece.trusted[1])
    misfit = float(np.sqrt(left / whole)) if whole else 0.0
    known = {field.name: getattr(begin, field.name) for field in fields(Solution)} | {"trusted": trusted, "misfit": misfit}
    return Reconstruction(store=v, mismatch=mismatch, left=parts[0], whole=parts[1], **known)


def _squares(error: Array, given: Array, start: int, within: tuple[int, int]) -> Array:
    """Return sums of squares (2, p) of both over those samples `within`; the first one is sample `start`."""
    first, last = (min(max(edge - start, 0), len(given)) for edge in within)
    return np.stack([np.sum(rows[first:last] ** 2, axis=0) for rows in (error, given)])
