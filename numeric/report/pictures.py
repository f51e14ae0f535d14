"""The pictures of `faultspace identify`, one a file.

main_picture the one picture of `Identification.plot`
pictures     draws what the Findings holds into a folder; remarks on what could not be had
PICTURES     the names of the files

    singular-values   of PI-MOESP, with the order
    window-ranks      singular values of the residual's windows, with thresholds and ranks
    noise-levels      where noise fills every window: what the best law on k mixed outputs leaves, which jumps at k = n_v
    zeros-and-poles   poles of the model and finite zeros of the faults
    outputs           the last samples, measured against simulated
    fault-signal      the whole record, and a detail of it where the residual is loudest
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base.errors import InvalidData
from ..count.rank_gap import FaultDimension
from ..signal import plots
from ..signal.residual_sizes import loudest

if TYPE_CHECKING:
    from ..findings import Findings
    from ..model.residuals import ResidualSignal
    from ..signal.reconstruction import Reconstruction

PICTURES = (
    "singular-values.png", "window-ranks.png", "noise-levels.png", "zeros-and-poles.png", "outputs.png", "fault-signal.png",
)  # fmt: skip
PICTURED = 300  # samples of a detail
MOST_DRAWN = 1 << 15  # rows of the fault signal that are drawn: of a longer one the extremes of equal parts, two rows each
TICKS = 7
WIDE, SQUARE, TALL = (8.0, 4.6), (5.2, 5.2), (8.0, 6.4)


def pictures(answer: Findings, folder: Path) -> list[str]:
    """Draws what there is; without matplotlib the sentence that says so."""
    try:
        figure: Any = import_module("matplotlib.figure")
    except ImportError:
        return ["no plots: matplotlib is not installed (pip install 'faultspace[plots]')"]
    for name, size, draw in _drawings(answer):
        picture = figure.Figure(figsize=size, layout="constrained")
        draw(picture)
        picture.savefig(folder / name, dpi=130)
    return []


def main_picture(answer: Findings, ax: Any = None) -> Any:
    """The fault signal where there is one, else the last samples of the outputs, measured and simulated; into `ax`, which is returned.

    Raises InvalidData where there is no model to draw anything of."""
    if answer.residual is None:
        raise InvalidData("there is no model, so that there is nothing to draw: state an order")
    if ax is None:
        ax = import_module("matplotlib.pyplot").figure(figsize=WIDE, layout="constrained").add_subplot()
    if answer.signal is not None:
        _draw_stretch(answer.signal, *_extremes(answer.signal), ax)
        ax.set_title("Fault signal" if answer.signal.store.width == 1 else "Fault signals", loc="left")
        return ax
    y, simulated, first = _last_outputs(answer, answer.residual)
    return plots.plot_measured_and_simulated(y, simulated, names=answer.record.outputs, first=first, ax=ax)


def _last_outputs(answer: Findings, rest: ResidualSignal) -> tuple[Any, Any, int]:
    """The last PICTURED samples of the outputs, measured and simulated, and the number of the first of them."""
    N = len(answer.record)
    first = max(N - PICTURED, 0)
    y = answer.record.stretch(first, N)[0]
    return y, y - rest.store.read(first, N), first


def _drawings(answer: Findings) -> list[tuple[str, tuple[float, float], Callable[[Any], Any]]]:
    """Name, size and what to do with a figure."""
    model, dimension, rest, signal = answer.model, answer.dimension, answer.residual, answer.signal
    order = model.order if model else None
    spectrum, ranks, levels, plane, outputs, faults = PICTURES
    drawings: list[tuple[str, tuple[float, float], Callable[[Any], Any]]] = [
        (spectrum, WIDE, lambda figure: plots.plot_singular_values(answer.singular_values, order=order, ax=figure.add_subplot()))
    ]
    if dimension and len(dimension.windows) > 1:
        drawings.append((ranks, WIDE, lambda figure: _draw_windows(dimension, figure.add_subplot())))
    if dimension and dimension.levels:
        drawings.append((levels, WIDE, lambda figure: _draw_levels(dimension, figure.add_subplot())))
    if model:
        zeros = signal.zeros if signal else np.zeros(0)
        drawings.append((plane, SQUARE, lambda figure: plots.plot_zeros_and_poles(model.model.poles, zeros, ax=figure.add_subplot())))
    if rest:
        names = answer.record.outputs
        y, simulated, first = _last_outputs(answer, rest)
        draw = plots.plot_measured_and_simulated
        drawings.append((outputs, WIDE, lambda figure: draw(y, simulated, names=names, first=first, ax=figure.add_subplot())))
    if answer.sizes and signal:
        near = loudest(answer.sizes.energies, len(signal.store), PICTURED)
        drawings.append((faults, TALL, lambda figure: _draw_signal(signal, near, figure)))
    return drawings


def _draw_windows(dimension: FaultDimension, ax: Any) -> None:
    plots.plot_window_ranks(dimension, ax=ax)
    if dimension.regime == "noise":
        ax.set_title("Windows of the residual: noise fills every direction, their ranks do not count faults")


def _draw_levels(dimension: FaultDimension, ax: Any) -> None:
    """The levels of the kernel-row test by number of mixed outputs, from least to largest over the mixtures tried."""
    levels = sorted(dimension.levels, key=lambda level: level.outputs)
    count, middle = [level.outputs for level in levels], [level.middle for level in levels]
    reach = [(level.largest - level.least) / 2 for level in levels]
    ax.errorbar(count, middle, yerr=reach, fmt="o-", color=plots.BLUE, linewidth=1, capsize=4, label="noise left by the best law")
    if dimension.n_v:
        ax.axvline(dimension.n_v + 0.5, color=plots.GREY, linestyle="--", linewidth=1, label=f"$n_v$ = {dimension.n_v}: no law up to here")
    verdict = "undecided" if dimension.n_v is None else f"{dimension.n_v}"
    ax.set(xlabel="outputs mixed", ylabel="log noise power (nats)", title=f"How many outputs still obey a common law? Faults: {verdict}")
    ax.set_xticks(count)
    ax.grid(True, color="#dddddd", linewidth=0.6)
    ax.legend(frameon=False, fontsize=9)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)


def _extremes(signal: Reconstruction) -> tuple[Any, int, float]:
    """Rows to draw of the whole signal, the sample they begin with and the samples that each stands for."""
    N = len(signal.store)
    part = 1 if N <= MOST_DRAWN else -(-2 * N // MOST_DRAWN)
    if part == 1:
        return signal.store.read(0, N), 0, 1.0
    parts = (signal.store.read(first, first + part) for first in range(0, N, part))
    return np.array([ends for rows in parts for ends in (rows.min(axis=0), rows.max(axis=0))]), 0, part / 2


def _draw_signal(signal: Reconstruction, near: tuple[int, int], figure: Any) -> None:
    """The whole signal above, the samples `near` below."""
    whole, detail = figure.subplots(2)
    _draw_stretch(signal, *_extremes(signal), whole)
    _draw_stretch(signal, signal.store.read(*near), near[0], 1.0, detail)
    whole.set_xlabel("")
    what = "Fault signal" if signal.store.width == 1 else "Fault signals"
    whole.set_title(what, loc="left")
    detail.set_title("detail, where the residual is loudest", loc="left")


def _draw_stretch(signal: Reconstruction, rows: Any, first: int, step: float, ax: Any) -> None:
    """Rows that stand for `step` samples each, from sample `first` on, with an axis that tells samples."""
    begin, end = (int(np.clip(round((edge - first) / step), 0, len(rows))) for edge in signal.trusted)
    plots.plot_fault_signal(rows, trusted=(begin, end), ax=ax)
    ax.set_title("")
    ticker: Any = import_module("matplotlib.ticker")
    last = first + step * (len(rows) - 1)
    samples = [place for place in ticker.MaxNLocator(TICKS, integer=True).tick_values(first, last) if first <= place <= last]
    ax.set_xticks([(place - first) / step for place in samples], [f"{place:,.0f}" for place in samples])
