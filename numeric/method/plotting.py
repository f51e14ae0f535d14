"""Pictures of what was identified. Every function draws into `ax` (a matplotlib Axes; a new figure without one) and returns it.

plot_singular_values          of PI-MOESP, with the order
plot_conditions               singular values of the conditions on a fault column, with the dimension of the fault space
plot_window_ranks             singular values of R_s and R_(s+1), with thresholds and chosen ranks
plot_zeros_and_poles          in the complex plane, with the unit circle
plot_uncertain_poles          the poles with the regions that hold them with a stated probability
plot_criteria                 criteria of the order above their least values, the orders left open shaded
plot_roots                    what stands out of a healthy record at each frequency, with what chance reaches
plot_measured_and_simulated   outputs and the model's, one below the other
plot_fault_signal             the reconstructed signals, the samples shaded that are not determined
plot_stored_signal            the same for a signal of any length in a store
plot_residual                 a residual, one output below the other
plot_onsets                   the same over the whole record, with the changes found in it and their intervals
plot_angles                   angles of single causes to a fault space, with the angles that chance reaches
plot_chances                  chances of single causes of a shift
plot_levels                   what the best law on so many mixed outputs leaves, which jumps at the number of faults

matplotlib is imported when a figure is made, so that the package does without it. Colours are ones that the colour-blind tell
apart, and never the only difference. Long signals are drawn as the band between their extremes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib import import_module
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...base.arrays import Array
from ...base.errors import InvalidData
from ...base.others_text import as_label
from ...base.sheets import counted
from ..data.records import SampleStore
from ..data.validation import signal

BLUE, ORANGE, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#777777"
MOST_POINTS = 3000
MOST_DRAWN = 1 << 15  # rows of a stored signal that are drawn: of a longer one the extremes of equal parts, two rows each
TICKS = 7
DECIBEL = 10.0 / np.log(10.0)  # of the natural logarithm of a power
LEAST_CHANCE = 1e-12  # that is drawn: less says no more
MOST_CHANNELS = 8
SEEN = 0.2  # of the picture: smaller regions are drawn larger by a power of ten that does not go beyond it
STYLES = {"consistent": (GREEN, ""), "excluded": (GREY, "//"), "undecided": (ORANGE, "..")}  # of a cause
LOWEST = 1e-18  # relative: smaller singular values are drawn there


def plot_singular_values(values: ArrayLike, *, order: int | None = None, ax: Any = None) -> Any:
    """Draw the singular values (k,) of PI-MOESP, which fall; those of the order filled, the others open."""
    ax = _axes(ax)
    sigma = _spectrum(values, "values")
    count = np.arange(1, len(sigma) + 1)
    n = 0 if order is None else order
    ax.semilogy(count[:n], sigma[:n], "o", color=BLUE, markersize=5, label=f"taken: order {order}")
    ax.semilogy(count[n:], sigma[n:], "o", color=BLUE, markersize=5, fillstyle="none", label="not taken" if n else "no order taken")
    if 0 < n < len(sigma):
        ax.axvline(n + 0.5, color=GREY, linewidth=0.9, linestyle="--")
    ax.set(xlabel="number", ylabel="singular value (outputs scaled)", title="Singular values and order")
    _whole_numbers(ax)
    return finished(ax, legend=True)


def plot_conditions(values: ArrayLike, equations: int, *, others: str, ax: Any = None) -> Any:
    """Draw the singular values of the conditions on a fault column [f; g] relative to the largest, from the largest on: the first
    `equations` of them filled, the rest, if any, open. The legend says of the others what `others` tells. Raises InvalidData where there
    are none.
    """
    sigma = _spectrum(values, "values")
    if not len(sigma):
        raise InvalidData("values: got none, expected one at least: there is no condition on a fault column to draw")
    ax = _axes(ax)
    sigma, count = sigma / sigma[0], np.arange(1, len(sigma) + 1)
    ax.semilogy(count[:equations], sigma[:equations], "o", color=BLUE, markersize=5, label=f"{counted(equations, 'independent condition')}")
    style = {"color": BLUE, "markersize": 5, "fillstyle": "none"}
    ax.semilogy(count[equations:], sigma[equations:], "o", label=others, **style)
    ax.set(xlabel="number", ylabel="singular value over the largest", title="Conditions on a fault column, and the fault space")
    _whole_numbers(ax)
    return finished(ax, legend=True)


def plot_window_ranks(dimension: Any, *, window: int | None = None, ax: Any = None) -> Any:
    """Draw, of a FaultDimension, the singular values of R_s (circles) and R_(s+1) (squares) with their thresholds; those above are filled,
    the legend has the ranks. Under noise these are no ranks, and the legend does not call them so.

    `window` is s, by default the longest with a successor. Raises InvalidData for an s that was not looked at.
    """
    longest = len(dimension.windows) - 1
    s = longest if window is None else window
    if not 1 <= s <= longest:
        raise InvalidData(f"window = {window} was not looked at; the record has windows 1 to {longest} with a successor each")
    ax = _axes(ax)
    exact = dimension.regime == "rounding"
    for number, marker, colour in ((s, "o", BLUE), (s + 1, "s", ORANGE)):
        sigma = _spectrum(dimension.singular_values[number - 1], "singular values")
        rank, threshold = dimension.ranks[number - 1], dimension.thresholds[number - 1]
        count = np.arange(1, len(sigma) + 1)
        name = f"$R_{{{number}}}$"
        found = f"rank {rank} of {len(sigma)}" if exact else f"{rank} of {len(sigma)} above what noise reaches"
        ax.semilogy(count[:rank], sigma[:rank], marker, color=colour, markersize=4.5, label=f"{name}: {found}")
        ax.semilogy(count[rank:], sigma[rank:], marker, color=colour, markersize=4.5, fillstyle="none")
        style = "--" if number == s else ":"
        ax.axhline(threshold, color=colour, linewidth=1, linestyle=style, label=f"{'threshold' if exact else 'reach of noise'}, {name}")
    gap = dimension.gaps[s - 1]
    verdict = "undecided" if dimension.n_v is None else f"$n_v$ = {dimension.n_v}"
    counts = f"ranks differ by {gap}; {verdict}"
    title = counts if exact else "noise fills every direction, their ranks do not count faults"
    ax.set(xlabel="number", ylabel="singular value (channels of mean square one)", title=f"Windows of the residual: {title}")
    _whole_numbers(ax)
    return finished(ax, legend=True)


def plot_zeros_and_poles(poles: ArrayLike, zeros: ArrayLike = (), *, ax: Any = None) -> Any:
    """Draw poles (crosses) and finite zeros (circles) with the unit circle, in equal scales."""
    ax = _axes(ax)
    sets = {name: np.asarray(given, dtype=np.complex128).ravel() for name, given in (("poles", poles), ("zeros", zeros))}
    for name, given in sets.items():
        if not np.all(np.isfinite(given)):
            raise InvalidData(f"{name} holds values that are NaN or infinite; finite ones are needed: leave the others out")
    turn = np.linspace(0, 2 * np.pi, 361)
    ax.plot(np.cos(turn), np.sin(turn), color=GREY, linewidth=1)
    ax.axhline(0, color=GREY, linewidth=0.5)
    ax.axvline(0, color=GREY, linewidth=0.5)
    cross: dict[str, Any] = {"color": BLUE, "markersize": 8, "markeredgewidth": 1.8}
    ax.plot(sets["poles"].real, sets["poles"].imag, "x", label=counted(len(sets["poles"]), "pole"), **cross)
    if len(sets["zeros"]):
        style = {"color": ORANGE, "markersize": 8, "markeredgewidth": 1.6, "fillstyle": "none"}
        ax.plot(sets["zeros"].real, sets["zeros"].imag, "o", label=counted(len(sets["zeros"]), "finite zero"), **style)
    reach = 1.15 * max(1.0, *(float(np.max(np.abs(given), initial=0.0)) for given in sets.values()))
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="real part", ylabel="imaginary part", title="Poles and finite zeros")
    ax.set_aspect("equal")
    return finished(ax, legend=True, below=True)


def plot_uncertain_poles(poles: ArrayLike, roots: ArrayLike, *, zeros: ArrayLike = (), confidence: float = 0.95, ax: Any = None) -> Any:
    """Draw poles (n,), each with the region that holds it with this probability: an ellipse, and of a real pole a bar; `zeros` have none.

    To first order a pole is off by its row of `roots` (n, K), complex, times K standard normal numbers. Regions too small to be seen are
    all drawn so many powers of ten larger, which the legend tells. A pole whose row is not finite has none, and the legend says so.
    """
    places, maps = np.asarray(poles, dtype=np.complex128).ravel(), np.asarray(roots, dtype=np.complex128)
    sure = np.all(np.isfinite(maps), axis=1)
    turn = np.linspace(0, 2 * np.pi, 361)
    edges = []
    for place, row in zip(places[sure], maps[sure], strict=True):
        axes, sizes, _ = np.linalg.svd(np.stack([row.real, row.imag]), full_matrices=False)
        # The distance in deviations has two degrees of freedom where the pole is complex, one where it is real.
        factor = np.sqrt(-2 * np.log(1 - confidence)) if place.imag else NormalDist().inv_cdf((1 + confidence) / 2)
        circle = np.stack([np.cos(turn), np.sin(turn)])[: len(sizes)]
        edges.append(np.array([1, 1j]) @ axes @ (factor * sizes[:, None] * circle))
    ax = plot_zeros_and_poles(places, zeros, ax=ax)
    largest = max((float(np.max(np.abs(edge))) for edge in edges), default=0.0)
    larger = 10 ** max(0, int(np.floor(np.log10(SEEN * ax.get_xlim()[1] / largest)))) if largest > 0 else 1
    label = f"{100 * confidence:g} % region" + (f", drawn {larger} times larger" if larger > 1 else "")
    for place, edge in zip(places[sure], edges, strict=True):
        drawn = place + larger * edge
        ax.plot(drawn.real, drawn.imag, color=ORANGE, linewidth=1.6, label=label)
        label = ""
    if not np.all(sure):
        ax.plot([], [], " ", label=f"{counted(int(np.sum(~sure)), 'pole')} without: multiple")
    ax.set_title("Poles, and how sure they are")
    return finished(ax, legend=True, below=True)


def plot_criteria(
    orders: Sequence[int], curves: Mapping[str, Sequence[float]], *, taken: int, open_range: tuple[int, int], ax: Any = None
) -> Any:
    """Draw each curve of a criterion (one number an order) above its least value, the order taken filled, the orders left open shaded.

    The scale is linear up to 10 and logarithmic beyond, where orders are out of the question.
    """
    ax = _axes(ax)
    for (name, values), colour, marker, style in zip(curves.items(), (BLUE, ORANGE, GREEN), "os^", ("-", "--", ":"), strict=False):
        above = np.asarray(values, dtype=np.float64) - np.min(values)
        ax.plot(orders, above, marker + style, color=colour, fillstyle="none", linewidth=1.2, markersize=6, label=name)
        chosen = [above[k] for k, order in enumerate(orders) if order == taken]
        ax.plot([taken] * len(chosen), chosen, marker, color=colour, markersize=6)
    least, most = open_range
    words = f"left open: {least} to {most}" if least < most else f"left open: {least} alone"
    ax.axvspan(least - 0.4, most + 0.4, color=GREY, alpha=0.2, linewidth=0, label=words)
    ax.set_yscale("symlog", linthresh=10)
    ax.set(xlabel="order", ylabel="criterion above its least value", title=f"What the data say of the order; taken: {taken} (filled)")
    ticker: Any = import_module("matplotlib.ticker")
    ax.xaxis.set_major_locator(ticker.MaxNLocator(integer=True, min_n_ticks=1))
    return finished(ax, legend=True)


def plot_roots(frequencies: Array, roots: Array, thresholds: Array, n_v: int | None, *, ax: Any = None) -> Any:
    """Draw the roots (centres, p) by frequency, in cycles a sample, against their thresholds: at most the three largest, with markers
    where one stands above its threshold and so do those before it."""
    ax = _axes(ax)
    above = np.cumprod(roots > thresholds, axis=1).astype(bool)
    for j, (colour, marker) in enumerate(zip((BLUE, ORANGE, GREEN), "os^", strict=True)):
        if j < roots.shape[1]:
            drawn = np.maximum(roots[:, j], LOWEST)
            ax.semilogy(frequencies, drawn, "-", color=colour, linewidth=1.2, label=f"direction {j + 1}, {int(above[:, j].sum())} above")
            ax.semilogy(frequencies[above[:, j]], drawn[above[:, j]], marker, color=colour, markersize=4)
            ax.semilogy(frequencies, thresholds[:, j], ":", color=colour, linewidth=1.2, label=f"what chance reaches in direction {j + 1}")
    verdict = "undecided" if n_v is None else f"$n_v$ = {n_v}"
    ax.set(
        xlabel="frequency (cycles a sample)", ylabel="power over that of the healthy record", title=f"Beyond the healthy record: {verdict}"
    )
    return finished(ax, legend=True)


def plot_measured_and_simulated(
    y: ArrayLike, simulated: ArrayLike, *, names: Sequence[str] | None = None, first: int = 0, ax: Any = None
) -> Any:
    """Draw y (N, p) and simulated (N, p), channel above channel, `first` the number of the first sample; at most 8 channels are drawn."""
    measured, model = signal(y, "y"), signal(simulated, "simulated")
    if measured.shape != model.shape:
        raise InvalidData(f"y is {measured.shape} and simulated {model.shape}; equal shapes are needed: cut both to the samples they share")
    ax = _axes(ax)
    p = measured.shape[1]
    middle, size = _centres(np.vstack([measured, model]))
    levels = _stacked(ax, names or [f"y{j + 1}" for j in range(p)], "outputs", size)
    for j, level in enumerate(levels):
        for values, colour, style, text in ((measured, BLUE, "-", "measured"), (model, ORANGE, "--", "simulated")):
            drawn = values[:, j] if p == 1 else (values[:, j] - middle[j]) / size[j] + level
            _line(ax, first, drawn, colour, style, text if j == 0 else None)
    ax.set(xlabel="sample", title="Measured against simulated" + _some_of(p))
    return finished(ax, legend=True, outside=True)


def plot_fault_signal(v: ArrayLike, *, trusted: tuple[int, int] | None = None, ax: Any = None) -> Any:
    """Draw v (N, n_v), signal above signal; outside v[first:last] = `trusted` the background is shaded. At most 8 signals are drawn."""
    values = signal(v, "v")
    ax = _axes(ax)
    N, m = values.shape
    first, last = (0, N) if trusted is None else trusted
    kept = values[first:last] if first < last else values
    middle, size = _centres(kept)
    own = ["v1 (in the scale of F and G)"] if m == 1 else [f"v{j + 1}" for j in range(m)]
    levels = _stacked(ax, own, "signals", size)
    for j, level in enumerate(levels):
        # What is not determined may be large: the scale is that of the rest.
        drawn = np.clip((values[:, j] - middle[j]) / size[j], -1.2, 1.2)
        _line(ax, 0, drawn * size[j] + middle[j] if m == 1 else drawn + level, GREEN, "-", None)
    lost = [(0, N - 1)] if first >= last else [(a, b) for a, b in ((0, first), (last, N - 1)) if b > a]
    for number, (a, b) in enumerate(lost):
        ax.axvspan(a, b, color=GREY, alpha=0.25, linewidth=0, label="not determined (zeros, delay)" if number == 0 else None)
    ax.set(xlabel="sample", title="Fault signal" + ("s" if m > 1 else "") + _some_of(m))
    ax.margins(x=0.01)
    return finished(ax, legend=bool(lost), outside=True)


def plot_stored_signal(v: SampleStore, trusted: tuple[int, int], *, first: int = 0, last: int | None = None, ax: Any = None) -> Any:
    """Draw samples first .. last - 1 (by default all) of v (N, n_v) as `plot_fault_signal` does; a long one is drawn by its extremes."""
    ax = _axes(ax)
    rows, samples = _drawn_rows(v, first, len(v) if last is None else last)
    a, b = (int(np.clip(round((edge - first) / samples), 0, len(rows))) for edge in trusted)
    plot_fault_signal(rows, trusted=(a, b), ax=ax)
    _sample_ticks(ax, first, first + samples * (len(rows) - 1), samples)
    return ax


def _drawn_rows(store: SampleStore, first: int, last: int) -> tuple[Array, float]:
    """Return the rows of a store that are drawn of samples first .. last - 1, of a long one the extremes of equal parts, and the samples
    that a row stands for."""
    step = 1 if last - first <= MOST_DRAWN else -(-2 * (last - first) // MOST_DRAWN)
    if step == 1:
        return store.read(first, last), 1.0
    parts = (store.read(start, min(start + step, last)) for start in range(first, last, step))
    return np.array([ends for part in parts for ends in (part.min(axis=0), part.max(axis=0))]), step / 2


def _sample_ticks(ax: Any, first: float, last: float, samples: float) -> None:
    """Name samples first .. last where each row that was drawn stands for so many."""
    ticker: Any = import_module("matplotlib.ticker")
    ticks = [place for place in ticker.MaxNLocator(TICKS, integer=True).tick_values(first, last) if first <= place <= last]
    ax.set_xticks([(place - first) / samples for place in ticks], [f"{place:,.0f}" for place in ticks])


def plot_residual(r: ArrayLike, *, names: Sequence[str] | None = None, ax: Any = None) -> Any:
    """Draw r (N, p), output above output, each in its own scale; at most 8 outputs are drawn."""
    values = signal(r, "r")
    ax = _axes(ax)
    p = values.shape[1]
    middle, size = _centres(values)
    for j, level in enumerate(_stacked(ax, names or [f"r{j + 1}" for j in range(p)], "outputs", size)):
        _line(ax, 0, values[:, j] if p == 1 else (values[:, j] - middle[j]) / size[j] + level, BLUE, "-", None)
    ax.set(xlabel="sample", title="Residual" + _some_of(p))
    ax.margins(x=0.01)
    return finished(ax, legend=False)


def plot_onsets(
    store: SampleStore,
    onsets: Sequence[tuple[int, tuple[int, int]]],
    *,
    healthy: int | None = None,
    names: Sequence[str] | None = None,
    ax: Any = None,
) -> Any:
    """Draw all samples of a residual (N, p) in a store, the onsets (sample, (first, last)) as lines within their intervals, and the end of
    the samples stated to be healthy; a long record is drawn by the extremes of equal parts."""
    rows, samples = _drawn_rows(store, 0, len(store))
    ax = plot_residual(rows, names=names, ax=ax)
    for number, (sample, (first, last)) in enumerate(onsets):
        label = "onset, in its interval" if number == 0 else None
        ax.axvspan(first / samples, last / samples, color=ORANGE, alpha=0.3, linewidth=0)
        ax.axvline(sample / samples, color=ORANGE, linewidth=1.4, linestyle="--", label=label)
    if healthy is not None:
        ax.axvline(healthy / samples, color=GREEN, linewidth=1.4, linestyle=":", label="stated to be healthy until here")
    _sample_ticks(ax, 0, len(store) - 1, samples)
    ax.set_title("Residual of the whole record" if onsets else "Residual of the whole record: no onset")
    return finished(ax, legend=bool(onsets) or healthy is not None, outside=True)


def plot_angles(rows: Sequence[tuple[str, float, float | None, str]], *, ax: Any = None) -> Any:
    """Draw a bar for each (name, angle, bound, answer), angles in radians: as long as the angle, with a mark at the bound, hatched by the
    answer, which stands beside it. The scale is logarithmic, so that small angles are seen beside their bounds."""
    ax = _axes(ax)
    least = min((np.degrees(size) for _, angle, bound, _ in rows for size in (angle, bound) if size), default=1.0)
    left = max(least, 1e-9) / 3
    for place, (_, angle, bound, answer) in enumerate(rows):
        colour, hatch = STYLES[answer]
        ax.barh(place, max(np.degrees(angle) - left, 0.0), left=left, height=0.6, color=colour, alpha=0.55, hatch=hatch, edgecolor=colour)
        reach = max(angle, bound or 0.0, np.radians(left))
        if bound is not None:
            ax.plot(np.degrees([bound, bound]), [place - 0.42, place + 0.42], color="black", linewidth=2)
        ax.annotate(answer, (np.degrees(reach), place), xytext=(6, 0), textcoords="offset points", va="center", fontsize=9)
    ax.plot([], [], color="black", linewidth=2, label="what chance stays below (95 %), were it the cause")
    ax.set_yticks(range(len(rows)), [as_label(name) for name, *_ in rows])
    ax.set_ylim(len(rows) - 0.4, -0.6)
    ax.set_xscale("log")
    ax.set_xlim(left, 90 * (90 / left) ** 0.2)  # with room for the answers
    ax.set(xlabel="angle to the fault space (degrees)", title="Single causes")
    return finished(ax, legend=True, outside=True)


def plot_chances(rows: Sequence[tuple[str, float, str]], limits: tuple[float, float], *, ax: Any = None) -> Any:
    """Draw a bar for each (name, chance, answer), hatched by the answer, which stands beside it: the longer, the less likely a shift as far
    off is by chance, were it the cause. Below the first of the `limits` a cause is excluded, from the second on it is consistent. Chances
    below LEAST_CHANCE are drawn as that."""
    ax = _axes(ax)
    sizes = [-np.log10(max(chance, LEAST_CHANCE)) for _, chance, _ in rows]
    for place, (size, (_, _, answer)) in enumerate(zip(sizes, rows, strict=True)):
        colour, hatch = STYLES[answer]
        ax.barh(place, size, height=0.6, color=colour, alpha=0.55, hatch=hatch, edgecolor=colour)
        ax.annotate(answer, (size, place), xytext=(6, 0), textcoords="offset points", va="center", fontsize=9)
    excluded, consistent = (-np.log10(limit) for limit in limits)
    ax.axvline(excluded, color="black", linewidth=1.5, label=f"below {limits[0]:g}: excluded")
    ax.axvline(consistent, color=GREY, linestyle="--", linewidth=1, label=f"from {limits[1]:g} on: consistent")
    ax.set_yticks(range(len(rows)), [as_label(name) for name, *_ in rows])
    ax.set_ylim(len(rows) - 0.4, -0.6)
    reach = max([*sizes, 2 * excluded])
    ax.set_xlim(0, 1.2 * reach)  # with room for the answers
    places = range(0, int(reach) + 1, 2)
    ax.set_xticks(places, ["1", *(f"$10^{{-{place}}}$" for place in places[1:])])
    ax.set(xlabel="chance that the shift points so far away from the cause", title="Causes of the shift")
    return finished(ax, legend=True, outside=True)


def plot_levels(levels: Sequence[Any], n_v: int | None, *, ax: Any = None) -> Any:
    """Draw the levels of the kernel-row test, a LawLevel each, by number of mixed outputs, from least to largest over the mixtures
    tried."""
    ax = _axes(ax)
    by_count = sorted(levels, key=lambda level: level.outputs)
    # Levels are natural logarithms of powers.
    count, middle = [level.outputs for level in by_count], [DECIBEL * level.middle for level in by_count]
    reach = [DECIBEL * (level.largest - level.least) / 2 for level in by_count]
    label = "noise left by the best law; bars: least to largest over the mixtures"
    ax.errorbar(count, middle, yerr=reach, fmt="o-", color=BLUE, linewidth=1, capsize=4, label=label)
    if n_v:
        ax.axvline(n_v + 0.5, color=GREY, linestyle="--", linewidth=1, label=f"$n_v$ = {n_v}: no law up to here")
    verdict = "undecided" if n_v is None else f"{n_v}"
    ax.set(xlabel="outputs mixed", ylabel="noise power (dB)", title=f"How many outputs still obey a common law? Faults: {verdict}")
    ax.set_xticks(count)
    return finished(ax, legend=True)


def _axes(ax: Any) -> Any:
    """Return `ax`, or the axes of a new figure of pyplot."""
    if ax is not None:
        return ax
    try:
        pyplot: Any = import_module("matplotlib.pyplot")
    except ImportError:
        raise ImportError("plots need matplotlib: pip install 'faultspace[plots]'") from None
    return pyplot.subplots(figsize=(7, 4.2), layout="constrained")[1]


def finished(ax: Any, *, legend: bool, outside: bool = False, below: bool = False) -> Any:
    """Give the axes the grid, the sides and the legend that all pictures have, and return them."""
    ax.grid(True, color="#dddddd", linewidth=0.6, zorder=0)
    ax.set_axisbelow(True)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    if legend and outside:  # above the picture, on the right: nothing of a signal is hidden
        ax.set_title(ax.get_title(), loc="left")
        ax.set_title("")
        ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, frameon=False, fontsize=9)
    elif legend and below:  # where the picture fills its square
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2, frameon=False, fontsize=9)
    elif legend:
        ax.legend(loc="best", frameon=True, framealpha=0.9, edgecolor="none", fontsize=9)
    return ax


def _spectrum(values: ArrayLike, name: str) -> Array:
    """Return singular values as they can be drawn on a logarithmic scale."""
    sigma = np.asarray(values, dtype=np.float64).ravel()
    if not np.all(np.isfinite(sigma)) or np.any(sigma < 0):
        raise InvalidData(f"{name}: got negative or not finite ones; singular values are needed")
    return np.asarray(np.maximum(sigma, LOWEST * (float(sigma.max(initial=0.0)) or 1.0)))


def _whole_numbers(ax: Any) -> None:
    ticker: Any = import_module("matplotlib.ticker")
    ax.set_xlim(left=0.4)  # there is no number zero
    ax.xaxis.set_major_locator(ticker.MaxNLocator(integer=True, min_n_ticks=1))


def _centres(values: Array) -> tuple[Array, Array]:
    """Return middle and half-range of each column; half-range 1 for a constant one."""
    low, high = values.min(axis=0), values.max(axis=0)
    half = (high - low) / 2
    return (high + low) / 2, np.where(half > 0, half, 1.0)


def _stacked(ax: Any, names: Sequence[str], what: str, size: Array) -> list[float]:
    """Return the heights of the channels, first on top, and the ticks that name them; a single channel keeps its own units."""
    drawn_channels = min(len(size), MOST_CHANNELS)
    if drawn_channels == 1:
        ax.set_ylabel(as_label(names[0]))
        return [0.0]
    levels = [2.3 * (drawn_channels - 1 - j) for j in range(drawn_channels)]
    ax.set_yticks(levels, [f"{as_label(names[j])}\n±{size[j]:.2g}" for j in range(drawn_channels)])
    ax.set_ylabel(f"{what}, each in its own scale")
    return levels


def _some_of(count: int) -> str:
    return f" ({MOST_CHANNELS} of {count})" if count > MOST_CHANNELS else ""


def _line(ax: Any, first: int, values: Array, colour: str, style: str, label: str | None) -> None:
    """Draw a line, or a band between the extremes of equal parts where there are more samples than can be seen."""
    N = len(values)
    if N <= MOST_POINTS:
        ax.plot(np.arange(first, first + N), values, style, color=colour, linewidth=1.2, label=label)
        return
    step = -(-2 * N // MOST_POINTS)
    starts = np.arange(0, N, step)
    low, high = np.minimum.reduceat(values, starts), np.maximum.reduceat(values, starts)
    ax.fill_between(first + starts, low, high, color=colour, alpha=0.75, linewidth=0.3, label=label)
