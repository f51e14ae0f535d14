"""The spectra of residual and fault signal: at which frequencies a fault acts, in hertz where the sample time is known.

welch       the mean spectrum of a stretch of samples, read piece by piece
panels      what the picture shows: a panel an output and a fault signal
draw        the picture
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ....base.arrays import Array
from ....base.others_text import as_label
from ...data.records import SampleStore
from ...method.plotting import BLUE, GREY, MOST_CHANNELS, ORANGE, finished

if TYPE_CHECKING:
    from ..steps.findings import Answer

LONGEST, SHORTEST = 512, 16  # samples of a segment
SEGMENTS = 8  # at least, where a stretch has room for them
PIECE = 1 << 14  # samples read at a time
HEALTHY, ONSET = ("healthy samples", "samples after these"), ("before the onset", "after the onset")
LEAST_SPAN = 15.0  # dB that a panel shows at least, so that the roughness of an estimate does not look like a peak
FLOOR = 1e-12  # of the largest power, below which rounding is drawn


def welch(store: SampleStore, first: int, until: int, segment: int) -> Array:
    """Return the mean power density (segment // 2 + 1, k), one-sided and per sample^-1, of the samples first to until - 1.

    Segments overlap by half under a Hann window, each about its own mean; the stretch must have one segment at least. Source: [L99].

    >>> import numpy as np
    >>> from faultspace.numeric.data.records import stored
    >>> r = np.random.default_rng(1).standard_normal((4000, 1))
    >>> bool(abs(welch(stored(r), 0, 4000, 64).mean() / 2 - 1) < 0.1)
    True
    """
    window = np.hanning(segment + 2)[1:-1, None]
    total, count, step = np.zeros((segment // 2 + 1, store.width)), 0, segment // 2
    for start in range(first, until - segment + 1, PIECE // step * step):
        rows = store.read(start, min(start + PIECE // step * step + segment - step, until))
        for begin in range(0, len(rows) - segment + 1, step):
            part = rows[begin : begin + segment]
            total += np.abs(np.fft.rfft(window * (part - part.mean(axis=0)), axis=0)) ** 2
            count += 1
    return np.asarray(2 * total / (max(count, 1) * np.sum(window**2)))


def segment_of(samples: int) -> int:
    """Return how long a segment may be, a power of two; 0 where the stretch is too short for any."""
    longest = 2 * samples // (SEGMENTS + 1)
    return 0 if longest < SHORTEST else int(min(LONGEST, 2 ** int(np.log2(longest))))


def panels(answer: Answer) -> list[tuple[str, list[tuple[str, Array]]]]:
    """Return for each panel its name and its curves (what, power density); none where the record is too short.

    The residual of an output has two curves where it changes: before the first onset, or while healthy, and after it.
    """
    rest, signal = answer.residual, answer.signal
    if rest is None:
        return []
    N, change = len(rest.store), answer.healthy
    if change is None and answer.onset is not None and answer.onset.onsets:
        change = answer.onset.onsets[0].sample
    parts = [("whole record", 0, N)]
    if change is not None and min(segment_of(change), segment_of(N - change)):
        before, after = HEALTHY if answer.healthy is not None else ONSET
        parts = [(before, 0, change), (after, change, N)]
    segment = min(segment_of(until - first) for _, first, until in parts)
    if not segment:
        return []
    curves = [(what, welch(rest.store, first, until, segment)) for what, first, until in parts]
    shown = min(answer.record.p, MOST_CHANNELS)
    found = [(answer.record.outputs[i], [(what, density[:, i]) for what, density in curves]) for i in range(shown)]
    if signal is not None:
        first, until = signal.trusted
        if segment <= until - first:
            density = welch(signal.store, first, until, segment)
            found += [(f"v{j + 1}", [("fault signal", density[:, j])]) for j in range(density.shape[1])]
    return found


def height(count: int) -> float:
    """Return how tall the picture of so many panels is, in inches."""
    return 1.4 + 1.15 * count


def draw(found: list[tuple[str, list[tuple[str, Array]]]], dt: float | None, figure: Any) -> None:
    """Draw the panels one below the other, over frequency in hertz where `dt` in seconds is known, else in cycles a sample."""
    axes = figure.subplots(len(found), 1, sharex=True, squeeze=False)[:, 0]
    styles = {HEALTHY[0]: (GREY, "--"), ONSET[0]: (GREY, "--"), "fault signal": (ORANGE, "-")}
    handles: dict[str, Any] = {}
    for ax, (name, curves) in zip(axes, found, strict=True):
        top = max(float(density.max(initial=0.0)) for _, density in curves) or 1.0
        for what, density in curves:
            colour, style = styles.get(what, (BLUE, "-"))
            frequency = np.linspace(0, 0.5 / (dt or 1.0), len(density))
            # Frequency 0 says nothing: each segment is about its mean.
            decibels = 10 * np.log10(np.maximum(density[1:], FLOOR * top) * (dt or 1.0))
            handles.setdefault(what, ax.plot(frequency[1:], decibels, style, color=colour, linewidth=1.4)[0])
        low, high = ax.get_ylim()
        wider = max(0.0, LEAST_SPAN - (high - low)) / 2
        ax.set_ylim(low - wider, high + wider)
        ax.set_ylabel(as_label(name if len(name) <= 12 else name[:11] + "…"))
        finished(ax, legend=False)
    axes[-1].set_xlabel("frequency in Hz" if dt else "frequency in cycles a sample")
    axes[0].set_title(f"Spectra, in dB of power a {'hertz' if dt else 'cycle a sample'}", loc="left")
    # Below all panels it hides no curve.
    figure.legend(list(handles.values()), list(handles), loc="outside lower center", ncols=len(handles), frameon=False, fontsize=9)
