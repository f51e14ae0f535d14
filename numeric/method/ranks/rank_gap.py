"""This counts how many independent faults a residual carries, with the evidence, or an honest "undecided".

For exact residuals of x+ = A x + F v, r = C x + G v with exciting v, rank R_(s+1) - rank R_s = (normal rank) + #{left indices
above s}: it falls with s and equals the number of faults n_v from the lag on, whether or not the system is controllable or
observable [G25, proposition 3 with its repaired window]. So the gap must be seen to stay, and a drop at longer windows than were
looked at cannot be excluded from data; `block_rows` says how far to look.

Two regimes, told apart by the data alone:

    rounding    the longest window has singular values at the level of rounding: ranks by QR and SVD (`hankel_ranks`), the gap
                constant over the last third of the windows (three at least), every rank clear of its threshold
    noise       noise fills every direction, so that every R_s has full rank and the gap says nothing: `kernel_row_test`

    windows         s = 1 .. block_rows + 1
    ranks, margins  rank of R_s at its threshold; powers of ten between the threshold and the nearest singular value
    thresholds      in units of the scaled channels (mean square one), see `hankel_ranks`; in the noise regime power^(1/2)
                    (sqrt(columns) + sqrt(rows)), the largest singular value of as many independent errors, about [DS01]: for
                    orientation, since a Hankel matrix of white noise can have a larger one
    gaps            rank R_(s+1) - rank R_s, s = 1 .. block_rows
    channel_scales  root mean square of each channel, divided out first: units do not matter

What is counted are faults that keep exciting: constant, sinusoidal or proportional fault signals count as fewer, as they do for
every method that sees r alone. As many faults as outputs (n_v = p) cannot be told from noise in every output and are never claimed.

What the thresholds rest on: those of the rounding regime on bounds of rounding and of random matrices (`hankel_ranks`), in units of the
data. Beyond them CLEAR_MARGIN asks for a power of ten, LEAST_RUN for as many equal gaps as tell a step from a slope, and DIED_OUT for half
of the digits that the ranks themselves go by. `benchmarks/fault_dimension.py` measures the rates of right answers, and for the constants of
`kernel_row_test` what each is worth; no test here has a stated level.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import Shown, counted, decibels
from ....base.threads import one_thread
from ...data.plain import by_name
from ...data.records import Stored, in_memory
from ...data.validation import positive, signal
from ..plotting import plot_levels, plot_window_ranks
from .hankel_ranks import HankelRanks, ranks_at, rounding_ranks
from .residual_laws import LawLevel, kernel_row_test

DEFAULT_BLOCK_ROWS = 20
LARGEST_DEGREE = 9
MOST_MIXTURES = 12
"""Of more outputs than this the kernel-row test looks at so many fixed mixtures: they too obey laws as long as there are fewer faults, and
the cost, which grows with the cube of outputs times degree, stays that of twelve outputs."""
LARGEST_HANKEL = 280
"""The longest Hankel matrix has so many rows where `block_rows` is not given and outputs are many: its factor costs the square a sample."""
CLEAR_MARGIN = 1.0
LEAST_RUN = 3
DIED_OUT = 1e-6


@dataclass(frozen=True, repr=False)
class FaultDimension(Shown):
    """The number of faults `n_v` in a residual, None where it is undecided, with its `reason` and the evidence [G25].

    `regime` is "rounding" or "noise". `ranks`, `thresholds`, `margins` and `singular_values` (s p,) belong to `windows`, which count
    samples; `gaps[i]` belongs to s = windows[i], and `channel_scales` (p,) are the units of r. `levels` are what the kernel-row test saw,
    in the noise regime only. Raises ImportError in `plot()` without matplotlib.

    >>> import numpy as np
    >>> from faultspace.numeric import fault_dimension
    >>> v = np.random.default_rng(1).standard_normal((200, 1))
    >>> fault_dimension(np.hstack([v, 2 * v]))
    <FaultDimension: number of faults n_v: 1>
    """

    n_v: int | None
    reason: str
    regime: str
    windows: tuple[int, ...]
    ranks: tuple[int, ...]
    gaps: tuple[int, ...]
    thresholds: tuple[float, ...]
    margins: tuple[float, ...]
    singular_values: tuple[Array, ...]
    channel_scales: Array
    levels: tuple[LawLevel, ...] = ()

    @property
    def decided(self) -> bool:
        """Say whether there is an answer."""
        return self.n_v is not None

    @property
    def title(self) -> str:
        """Return the answer, on one short line."""
        return f"number of faults n_v: {'undecided' if self.n_v is None else self.n_v}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield what there is to say of it, as pairs of a name and a value."""
        yield "why", self.reason
        yield "regime", "only rounding" if self.regime == "rounding" else "noise in every window"
        if self.regime == "rounding":
            yield "windows s", " ".join(map(str, self.windows))
            yield "rank R_s", " ".join(map(str, self.ranks))
            yield "rank R_(s+1) - rank R_s", " ".join(map(str, self.gaps))
        for level in self.levels:
            yield f"level of {counted(level.outputs, 'mixed output')}", f"{decibels(level.least, '')} to {decibels(level.largest)}"

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict: the answer, its reason, and what belongs to each window."""
        names = ("n_v", "reason", "regime", "windows", "ranks", "gaps", "margins", "thresholds")
        return by_name(self, *names) | {"levels": [by_name(level, "outputs", "least", "largest") for level in self.levels]}

    def plot(self, ax: Any = None) -> Any:
        """Draw what the answer rests on into the matplotlib axes `ax`, new ones where None are given, and return them: the singular values
        of the longest windows, or under noise the levels of the kernel-row test. Raises ImportError without matplotlib."""
        return plot_levels(self.levels, self.n_v, ax=ax) if self.levels else plot_window_ranks(self, ax=ax)


@one_thread()
def fault_dimension(r: ArrayLike | Stored, *, block_rows: int | None = None, u: ArrayLike | None = None) -> FaultDimension:
    """Return the number of independent faults in a residual, from the gaps of its window ranks.

    With a record from before the fault, `fault_dimension_against_healthy` sees more. float32 data have float32 rounding. Source: [G25]
    proposition 3, repaired; thresholds [GVL13], [DS01].

    Parameters
    ----------
    r : array_like (N, p), or the ResidualSignal of `residual`
        In any units.
    block_rows : int, optional
        Longest window; by default 20, less for few samples or many channels.
    u : array_like (N, n_u), optional
        Inputs, for the residual of an identified model, whose error they drive: the ranks are those of [U_s; R_s] less those of U_s.
        Without them that error counts as further faults where it stands out of the noise.

    Returns
    -------
    FaultDimension
        `n_v`, None where it is undecided, with ranks, gaps and margins.

    Raises
    ------
    InvalidData
        NaN, too few samples, outputs that are all constant, u of another length.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import fault_dimension
    >>> v = np.random.default_rng(1).standard_normal((200, 1))
    >>> fault_dimension(np.hstack([v, 2 * v])).n_v
    1
    """
    values = in_memory(r)
    unit = _rounding_unit(values)
    data = signal(values, "r")
    inputs = None if u is None else _inputs(u, len(data))
    rows = _block_rows(data, block_rows, 0 if inputs is None else inputs.shape[1])
    scaled, scales = _scaled(data)
    exact = rounding_ranks(scaled, rows + 1, unit=unit)
    if inputs is not None:
        beyond = _ranks_beyond(inputs, scaled, rows + 1, unit)
        exact = beyond if beyond.deficient else exact
    if exact.deficient:
        n_v, reason = _from_gaps(exact, scaled)
        return _record(exact, scales, n_v, reason, "rounding")
    degree = min(rows - 1, LARGEST_DEGREE)
    if degree < 3:
        reason = (
            f"there is noise in every direction, and block_rows = {rows} leaves too short windows to look for laws below it; try at least 4"
        )
        return _record(exact, scales, None, reason, "noise")
    test = kernel_row_test(_mixtures(scaled), degree, u=inputs)
    columns = exact.columns
    thresholds = tuple(float(np.sqrt(test.noise_power) * (np.sqrt(columns) + np.sqrt(sigma.size))) for sigma in exact.values)
    ranks = ranks_at(exact.values, thresholds, columns, deficient=False)
    return _record(ranks, scales, test.n_v, test.reason, "noise", test.levels)


def _rounding_unit(r: ArrayLike) -> float:
    """Return the unit in the last place of the numbers given."""
    dtype = np.asarray(r).dtype
    return float(np.finfo(dtype).eps) if dtype in (np.float16, np.float32) else float(np.finfo(float).eps)


def _inputs(u: ArrayLike, samples: int) -> Array:
    """Return u with unit mean square in each channel."""
    inputs = signal(u, "u")
    if len(inputs) != samples:
        raise InvalidData(
            f"u has {counted(len(inputs), 'sample')} and r has {samples}; equal numbers are needed: cut both to the samples they share"
        )
    peaks = np.max(np.abs(inputs), axis=0)
    inputs = inputs / np.where(peaks > 0.0, peaks, 1.0)
    levels = np.sqrt(np.mean(inputs**2, axis=0))
    return np.asarray(inputs / np.where(levels > 0.0, levels, 1.0))


def _ranks_beyond(u: Array, r: Array, windows: int, unit: float) -> HankelRanks:
    """Return the rank [U_s; R_s] - rank U_s: by the same law for the joint signal [u; r], driven by u and v, its gaps count the faults
    alone."""
    joint = rounding_ranks(np.hstack([u, r]), windows, unit=unit)
    own = rounding_ranks(u, windows, unit=unit)
    # Fewer than none would be a joint rank that was decided too small: nothing is clear there.
    ranks = tuple(max(both - one, 0) for both, one in zip(joint.ranks, own.ranks, strict=True))
    clear = [both >= one for both, one in zip(joint.ranks, own.ranks, strict=True)]
    margins = tuple(min(both, one) if sure else 0.0 for both, one, sure in zip(joint.margins, own.margins, clear, strict=True))
    return replace(joint, ranks=ranks, margins=margins)


def _block_rows(r: Array, block_rows: int | None, n_u: int) -> int:
    """Return the largest window asked for or affordable: R_(s+1), with u below it, needs at least as many columns as twice its rows."""
    samples, p = len(r), int(r.shape[1])
    width = 2 * (p + n_u) + 1
    most = (samples + 1) // width - 1  # R_s has samples - s + 1 columns
    if block_rows is not None:
        wanted = positive(block_rows, "block_rows")
        if wanted > most:
            hint = "r has more channels than samples: is it transposed (it must be (N, p))? " if p > samples else ""
            raise InvalidData(
                f"r has {counted(samples, 'sample')} of {counted(p, 'channel')}: windows of "
                f"{wanted} + 1 samples need at least {(wanted + 1) * width - 1}; "
                f"{hint}{f'try block_rows <= {most} or' if most > 0 else 'give'} more samples"
            )
        return wanted
    if most < LEAST_RUN:
        hint = "r has more channels than samples: pass it as (N, p), r.T; otherwise " if p > samples else ""
        fewer = " or fewer channels" if samples >= (LEAST_RUN + 1) * (2 * (1 + n_u) + 1) - 1 else ""
        raise InvalidData(
            f"r has {counted(samples, 'sample')} of {counted(p, 'channel')}: at least {(LEAST_RUN + 1) * width - 1} samples are needed to "
            f"see {LEAST_RUN} gaps; {hint}give more samples{fewer}"
        )
    return min(DEFAULT_BLOCK_ROWS, most, max(2 * LEAST_RUN, LARGEST_HANKEL // (p + n_u) - 1))


def _mixtures(r: Array) -> Array:
    """Return r (N, p), or the first MOST_MIXTURES channels of it turned by a fixed orthogonal matrix, in unit mean square again."""
    p = r.shape[1]
    if p <= MOST_MIXTURES:
        return r
    turn = np.linalg.qr(np.random.default_rng(p).standard_normal((p, MOST_MIXTURES)))[0]
    return _scaled(r @ turn)[0]


def _scaled(r: Array) -> tuple[Array, Array]:
    """Return r with unit mean square in each channel that is not zero, and the scales; safe from under- and overflow."""
    peaks = np.max(np.abs(r), axis=0)
    if np.all(r.max(axis=0) == r.min(axis=0)):
        raise InvalidData(
            "every channel of r is constant: there is no fault signal to count; give a residual that varies (for a constant fault, "
            "include the time it sets in)"
        )
    safe = np.where(peaks > 0.0, peaks, 1.0)
    scaled = r / safe
    levels = np.sqrt(np.mean(scaled**2, axis=0))
    levels = np.where(levels > 0.0, levels, 1.0)
    return scaled / levels, safe * levels


def _from_gaps(exact: HankelRanks, scaled: Array) -> tuple[int | None, str]:
    """Return the verdict of the rounding regime."""
    p = scaled.shape[1]
    clear = 0
    while clear < len(exact.ranks) and exact.margins[clear] >= CLEAR_MARGIN:
        clear += 1
    gaps = exact.gaps[: max(clear - 1, 0)]
    run = max(LEAST_RUN, -(-len(gaps) // 3))
    blur = "" if clear == len(exact.ranks) else f" (from s = {clear + 1} on the ranks are not clear of the threshold)"
    if len(gaps) < run:
        return None, f"{len(gaps)} clear gaps, {run} are needed{blur}; try other block_rows, more samples or a more exciting fault"
    tail = gaps[-run:]
    if len(set(tail)) > 1:
        return None, f"the gap still changes over the last {run} windows, {tail}{blur}: the lag may be longer; try larger block_rows"
    gap = tail[0]
    if gap >= p:
        return None, f"the gap is {p}, as many as outputs, at every clear window{blur}: {counted(p, 'fault')}, or a lag beyond block_rows"
    if gap == 0:
        half = len(scaled) // 2
        early, late = np.linalg.norm(scaled[:half]), np.linalg.norm(scaled[half:])
        if late <= DIED_OUT * early:
            return 0, "r is a free response that dies out: no fault acts"
        return None, "r obeys a law without new information (gap 0): no fault, or one that is constant or a sum of few sinusoids"
    settled = len(gaps) - next(i for i, g in enumerate((*gaps[::-1], -1)) if g != gap) + 1
    return gap, f"the gap is {gap} at every window from s = {settled} to {len(gaps)}{blur}"


def _record(
    ranks: HankelRanks, scales: Array, n_v: int | None, reason: str, regime: str, levels: tuple[LawLevel, ...] = ()
) -> FaultDimension:
    """Put the evidence and the verdict together."""
    return FaultDimension(
        n_v=n_v,
        reason=reason,
        regime=regime,
        windows=tuple(range(1, len(ranks.ranks) + 1)),
        ranks=ranks.ranks,
        gaps=ranks.gaps,
        thresholds=ranks.thresholds,
        margins=ranks.margins,
        singular_values=ranks.values,
        channel_scales=scales,
        levels=levels,
    )
