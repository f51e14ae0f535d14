"""When a residual begins to be another one: the onset of a fault, with its uncertainty, in which outputs and how large.

fault_onset   the changes of a residual, one after the other
FaultOnset    they, with the stretch that stands for "without fault", and what is said where there are none
Onset         one change: sample, interval, chance, outputs, sizes

A stretch is tested for one change (`change_scan.py`); where one is found, what lies before and after its interval is tested in turn, each
at the same level (binary segmentation, [V81]). Sizes are in deviations, "sigmas", of what comes before the first change: the residual there
is taken for one without fault, which samples that are stated to be healthy make sure of. Nothing here tells a fault that acts from the
first sample to the last from none.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import Shown, counted
from ....base.threads import one_thread
from ...data.plain import by_name, plain
from ...data.records import SampleStore, Stored, stored
from ...data.validation import signal, whole
from .change_scan import LEAST, Reader, Scan, changed_outputs, choose_lags, located, scan

ONSET_LEVEL = 0.01  # the chance that a stretch without a change is said to have one
CONFIDENCE = 0.95  # of the interval


@dataclass(frozen=True, eq=False)
class Onset:
    """One change of a residual of p outputs.

    sample     the first sample after it
    interval   (first, last): the samples that this may be, by the likelihood ratio
    p_value    the chance of so clear a change without one, over all samples at which one was looked for
    changed    the outputs (their numbers) that change by themselves, and `chances` (p,) for each
    stretch    (start, stop): the samples start .. stop - 1 between it and the next change that are clear of both
    shift      (p,): by what the mean lies off that of the reference there, in deviations of the reference
    growth     (p,): the deviation there over that of the reference
    """

    sample: int
    interval: tuple[int, int]
    p_value: float
    changed: tuple[int, ...]
    chances: Array
    stretch: tuple[int, int]
    shift: Array
    growth: Array

    @property
    def size(self) -> Array:
        """Return how large the part of the fault is in each output (p,), the root of its mean square over the deviation of the reference:
        0 where the residual is no larger than there."""
        return np.sqrt(np.maximum(self.shift**2 + self.growth**2 - 1.0, 0.0))

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict."""
        return by_name(self) | {"size": plain(self.size)}


@dataclass(frozen=True, eq=False, repr=False)
class FaultOnset(Shown):
    """The changes of a residual r (N, p), in the order of time.

    onsets      the changes; none where the residual is alike from the first sample to the last, as `reason` says
    samples     N
    healthy     samples stated to be without fault, None where nobody has
    reference   (start, stop): the samples start .. stop - 1 that stand for "without fault"
    deviation   (p,): of the residual there, in units of y: one sigma
    level       the chance that a stretch without a change is said to have one; `p_value` is that of the first stretch tested, the whole
    confidence  of the intervals
    lags        of the autoregression that whitens the whole

    Raises nothing itself; `fault_onset`, which makes it, raises InvalidData. Source: [CG00], [S88], [BC91].

    >>> import numpy as np
    >>> from faultspace.numeric import fault_onset
    >>> r = np.random.default_rng(1).standard_normal((300, 2))
    >>> r[200:, 1] += 3.0
    >>> fault_onset(r)
    <FaultOnset: residual of 300 samples, 1 onset: sample 200>
    """

    onsets: tuple[Onset, ...]
    samples: int
    healthy: int | None
    reference: tuple[int, int]
    deviation: Array
    level: float
    confidence: float
    p_value: float | None
    lags: int
    reason: str

    @property
    def title(self) -> str:
        """Return what was found, on one short line."""
        where = ", ".join(str(onset.sample) for onset in self.onsets[:4]) + (", .." if len(self.onsets) > 4 else "")
        found = f"{counted(len(self.onsets), 'onset')}: {counted(len(self.onsets), 'sample')[2:]} {where}" if self.onsets else "no onset"
        return f"residual of {counted(self.samples, 'sample')}, {found}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield what there is to say of it, as pairs of a name and a value."""
        yield "why", self.reason
        if self.reference[1] > self.reference[0]:
            yield "reference", f"samples {self.reference[0]} to {self.reference[1] - 1}"
            yield "deviation there (one sigma)", ", ".join(f"{size:.4g}" for size in self.deviation)
        for onset in self.onsets:
            first, last = onset.interval
            yield (
                f"onset at sample {onset.sample}",
                f"between {first} and {last} with probability {self.confidence:g}, p {onset.p_value:.2g}",
            )
            yield "    outputs that change", ", ".join(f"y{j + 1}" for j in onset.changed) or "none by itself, all of them together"
            yield "    size after it, in sigmas", ", ".join(f"{size:.3g}" for size in onset.size)
            yield "    mean moves by, in sigmas", ", ".join(f"{size:.3g}" for size in onset.shift)
            yield "    deviation grows by a factor", ", ".join(f"{size:.3g}" for size in onset.growth)

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict."""
        names = ("onsets", "samples", "healthy", "reference", "deviation", "level", "confidence", "p_value", "lags", "reason")
        return by_name(self, *names)


@dataclass(frozen=True, eq=False)
class _Stretch:
    """Samples first .. last - 1: what reads them in their units, the outputs that move there, the lags, and the scan, which is
    None where nothing moves or the samples are too few."""

    first: int
    last: int
    read: Reader
    moving: NDArray[np.bool_]
    lags: int
    found: Scan | None


@dataclass(frozen=True)
class _Change:
    """A change before it is measured: the sample, its interval, the chances."""

    sample: int
    interval: tuple[int, int]
    p_value: float
    chances: Array


@one_thread()
def fault_onset(
    r: ArrayLike | SampleStore | Stored, *, healthy: int | None = None, level: float = ONSET_LEVEL, confidence: float = CONFIDENCE
) -> FaultOnset:
    """Find the samples from which on a residual is another one: its mean, its powers, how outputs go together, or its colour.

    The residual may have any colour that an autoregression takes off, and any law: the chance is counted on the residual itself. A fault
    that comes slowly has an onset where it begins to be seen, and more where it has grown. A change of the inputs can change a residual
    too, where the model is not exact. Source: [CG00] chapter 3, [S88], [BC91], [V81].

    Parameters
    ----------
    r : array_like (N, p), a store, or the ResidualSignal of `residual`
        In the units of y.
    healthy : int, optional
        Number of first samples stated to be without fault: no onset is looked for among them, and the others are held against them; else
        against what comes before the first onset.
    level : float
        Chance that a stretch without a change is said to have one, at least 0.005.
    confidence : float in (0, 1)
        That of the intervals.

    Returns
    -------
    FaultOnset
        `onsets`, each with its sample, interval and chance.

    Raises
    ------
    InvalidData
        Values that are not finite; a level, a confidence or a number of healthy samples that cannot be.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import fault_onset
    >>> r = np.random.default_rng(0).standard_normal((400, 2))
    >>> r[250:, 0] *= 4.0
    >>> found = fault_onset(r)
    >>> first, last = found.onsets[0].interval
    >>> first <= 250 <= last, found.onsets[0].changed
    (True, (0,))
    """
    held: Any = getattr(r, "store", r)
    store = held if isinstance(held, SampleStore) else stored(signal(held, "r"))
    known = None if healthy is None else whole(healthy, "healthy", 1, "state how many samples precede the faults, or leave it out")
    N = len(store)
    if known is not None and known >= N:
        raise InvalidData(f"healthy: got {known} for {counted(N, 'sample')}; some must follow: state fewer")
    if not 2 * LEAST <= level < 1:
        raise InvalidData(f"level: got {level}; a chance of {2 * LEAST} or more, below 1, is needed, for example 0.01")
    if not 0 < confidence < 1:
        raise InvalidData(f"confidence: got {confidence}; a number between 0 and 1 is needed, for example 0.95")
    record = _scanned(store, 0, N, known or 0)
    changes = _changes(store, record, known or 0, level, confidence)
    p_value = None if record.found is None else record.found.p_value
    if changes:
        reason = _found(changes, known, level)
    elif p_value is not None:
        reason = _alike(known, p_value, level)
    else:
        reason = f"{counted(N, 'sample')} are too few to look for a change" if record.moving.any() else "the residual never changes at all"
    reference = (0, changes[0].interval[0] if changes else known or N)
    mean, deviation = _moments(store, *reference)
    onsets = tuple(_measured(store, changes, mean, deviation, level))
    return FaultOnset(onsets, N, known, reference, deviation, level, confidence, p_value, record.lags, reason)


def _scaled(store: SampleStore, start: int, stop: int) -> tuple[Reader, NDArray[np.bool_]]:
    """Return a reader of the outputs that change at all in samples start .. stop - 1, in units of their deviations there, and which these
    are."""
    mean, units = _moments(store, start, stop)
    moving = np.asarray(units > 0)

    def read(first: int, last: int) -> Array:
        return np.asarray((store.read(first, last)[:, moving] - mean[moving]) / units[moving])

    return read, moving


def _scanned(store: SampleStore, first: int, last: int, earliest: int) -> _Stretch:
    """Return samples first .. last - 1, scanned for a change at `earliest` or later."""
    read, moving = _scaled(store, first, last)
    p = int(moving.sum())
    lags = choose_lags(read, first, last, p) if p else 0
    return _Stretch(first, last, read, moving, lags, scan(read, first, last, p, lags, earliest) if p else None)


def _changes(store: SampleStore, stretch: _Stretch, earliest: int, level: float, confidence: float) -> list[_Change]:
    """Return the changes of a stretch that was scanned from `earliest` on, in the order of time."""
    found = stretch.found
    if found is None or found.p_value > level:
        return []
    chances = np.ones(store.width)
    chances[stretch.moving] = changed_outputs(found)
    sample, interval = located(stretch.read, found, earliest, confidence)
    change, (start, stop) = _Change(sample, interval, found.p_value, chances), interval
    before = _changes(store, _scanned(store, stretch.first, start, earliest), earliest, level, confidence)
    return [*before, change, *_changes(store, _scanned(store, stop, stretch.last, stop + 1), stop + 1, level, confidence)]


def _measured(store: SampleStore, changes: list[_Change], mean: Array, deviation: Array, level: float) -> Iterator[Onset]:
    """Yield the changes with their sizes beside mean and deviation (p,) of what comes before the first of them."""
    ends = [*(change.interval[0] for change in changes), len(store)][1:]
    sigma = np.where(deviation > 0, deviation, np.nan)
    for change, stop in zip(changes, ends, strict=True):
        stretch = (change.interval[1], stop)
        after, spread = _moments(store, *stretch)
        seen = tuple(int(j) for j in np.flatnonzero(change.chances <= level))
        shift, growth = (after - mean) / sigma, spread / sigma
        yield Onset(change.sample, change.interval, change.p_value, seen, change.chances, stretch, shift, growth)


def _moments(store: SampleStore, first: int, last: int) -> tuple[Array, Array]:
    """Return mean and deviation (p,) of samples first .. last - 1; the deviation of what never changes is exactly zero."""
    count = max(last - first, 1)
    nothing = np.zeros(store.width)
    low = np.min([piece.min(axis=0) for piece in store.pieces(first, last)] or [nothing], axis=0)
    high = np.max([piece.max(axis=0) for piece in store.pieces(first, last)] or [nothing], axis=0)
    # In units of the largest value: squares of very large or small numbers would leave what floats can hold.
    size = np.maximum(np.abs(low), np.abs(high))
    size = np.where(size > 0, size, 1.0)
    mean = sum(((piece / size).sum(axis=0) for piece in store.pieces(first, last)), nothing) / count
    squares = sum((((piece / size - mean) ** 2).sum(axis=0) for piece in store.pieces(first, last)), nothing)
    return np.asarray(size * mean), np.where(high > low, size * np.sqrt(squares / count), 0.0)


def _found(changes: list[_Change], healthy: int | None, level: float) -> str:
    """Return why there are so many onsets, and what the sizes are held against."""
    against = (
        "samples stated to be without fault come before" if healthy else "what comes before the first is taken for the state without fault"
    )
    how = f"each stretch is tested at level {level:g}"
    return f"the residual is another one before and after {counted(len(changes), 'sample')}; {how}; {against}"


def _alike(healthy: int | None, p_value: float, level: float) -> str:
    """Return what no onset means."""
    chance = f"so large a difference has a chance of {p_value:.2g} without a change (level {level:g})"
    if healthy is not None:
        return f"after the healthy samples the residual goes on as before: {chance}"
    return (
        f"the residual is alike from the first sample to the last: {chance}; a fault that acts, acts all the time, and has no onset in "
        "this record"
    )
