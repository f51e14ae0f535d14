"""This is report.html, the page of one record: the answers as tiles, the summary below them, the pictures in their places.

report      the page as text, from the lines of the summary and the pictures drawn into a folder
tiles       the answers at its head: model, faults, onset, cause, fault space, signal; what is open says so
CAPTIONS    for each picture its section, its caption and the words for those who cannot see it
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ....base.errors import quote_path
from ....base.page import Picture, Tile, page
from ....base.sheets import counted
from .causes_told import after_healthy
from .summary import fit, markdown, missed_levels

if TYPE_CHECKING:
    from ..steps.findings import Answer

CAPTIONS = {
    "outputs.png": (
        "Model",
        "The last samples of each output, as measured and as the model simulates them from the inputs alone.",
        "Curves of each output over the last samples, measured and simulated.",
    ),
    "zeros-and-poles.png": (
        "Model",
        "The poles of the model beside the unit circle, each with the region that holds it with probability 0.95 where that is known: an "
        "ellipse, of a real pole a bar. Circles are the finite zeros of the faults, where F and G are given.",
        "Poles and zeros in the complex plane with the unit circle.",
    ),
    "singular-values.png": (
        "Model",
        "The singular values behind the order: those that PI-MOESP or the ARX model has; an order shows as a gap behind as many of them.",
        "Falling singular values on a logarithmic scale, with the order marked.",
    ),
    "window-ranks.png": (
        "Faults",
        "The singular values of the residual's windows; what stands above the threshold counts for the rank.",
        "Singular values of windows of growing length with thresholds and ranks.",
    ),
    "noise-levels.png": (
        "Faults",
        "What the best law on k mixed outputs leaves: it jumps behind the number of faults.",
        "Power that the best law leaves over the number of mixed outputs.",
    ),
    "residual.png": (
        "Onset",
        "The residual of each output over the whole record; dashed lines are onsets, within intervals of probability 0.95.",
        "Curves of the residual of each output with the onsets marked.",
    ),
    "spectra.png": (
        "Onset",
        "The power of the residual of each output over frequency, before and after the first onset where there is one, and of the fault "
        "signal in the units of its column of F and G: where the blue curve stands above the grey one, the fault acts.",
        "Curves of power over frequency, a panel for each output and for each fault signal.",
    ),
    "isolation.png": (
        "Which sensor or actuator",
        "The angle of each single cause to the fault space, with the angle that chance stays below were it the cause.",
        "Bars of angles, one for each sensor and each actuator, with marks at their bounds.",
    ),
    "shift-causes.png": (
        "Which sensor or actuator",
        "How unlikely the direction of the shift is by chance, were this cause the one: what stands beyond the line is excluded.",
        "Bars of chances, one for each sensor and each actuator, with lines where a cause is excluded and where it is consistent.",
    ),
    "fault-signal.png": (
        "Fault signal",
        "The reconstructed fault signal over the whole record, and in detail where the residual is loudest.",
        "Curves of the fault signal over the record, and a detail.",
    ),
}


def report(answer: Answer, lines: Sequence[str], folder: Path, data: str) -> str:
    """Return the page of the summary's `lines` with the pictures that the folder has."""
    drawn = [
        Picture((folder / name).read_bytes(), section, caption, words)
        for name, (section, caption, words) in CAPTIONS.items()
        if (folder / name).is_file()
    ]
    try:
        by = f"faultspace {version('faultspace')}"
    except PackageNotFoundError:  # a tree that nobody installed
        by = "faultspace"
    foot = f"Made by {by}, identify, of {quote_path(data)}. The page is complete in itself: it fetches nothing."
    return page(f"{quote_path(data)}: model and faults", markdown(lines), tiles=list(tiles(answer)), pictures=drawn, foot=foot)


def tiles(answer: Answer) -> Iterator[Tile]:
    """Yield the answers, each with what it rests on; an answer that is not decided says so in words."""
    model, orders, explained = answer.model, answer.orders, fit(answer)
    if model is None:
        yield Tile("Model", "no order decided", "The singular values have no gap to trust.", False)
        return
    left = "" if orders is None or orders.decided else f"; {orders.least} to {orders.most} are left open"
    least = ""
    if explained is not None and np.all(np.isfinite(explained)):
        least = f"Simulated from the inputs alone it fits each output to {explained.min():.3g} % or more."
        if explained.min() < 0:
            least = "Simulated from the inputs alone it is worse than the mean for an output."
        if missed_levels(answer, explained):
            least = "It misses the level of an output: take the channels about their means."
    yield Tile("Model", f"order {model.order}{left}", least, not left)
    yield _faults(answer)
    yield from _causes(answer)
    space = answer.fault_space
    if space is not None and space.meaningful:
        sure = (
            ""
            if space.uncertainty is None
            else f", its angle to the true space below {np.degrees(space.uncertainty.angle()):.2g} degrees with probability 0.95"
        )
        rests = f"Its dimension is n_z = {space.n_z}{sure}."
        yield Tile("Fault space", "found" if space.decided else "undecided", rests if space.decided else space.why, space.decided)
    if answer.explained is not None and answer.by_noise is not None:
        noise = f"Noise alone could explain up to {100 * answer.by_noise:.3g} %."
        if answer.signal is None:
            yield Tile("Fault signal", "withheld", f"It explains {100 * answer.explained:.3g} % of the residual. {noise}", False)
        else:
            yield Tile("Fault signal", f"explains {100 * answer.explained:.4g} %", f"This is the share of the residual. {noise}")


def _faults(answer: Answer) -> Tile:
    """Return what is said of the number of faults; a 0 has its condition, or what moved the mean, beside it."""
    moved = answer.mean is not None and answer.mean.shifted
    shift = " The mean of the residual moved: a constant fault has no rank." if moved else ""
    if answer.n_v is None:
        possible = " or ".join(map(str, answer.possible))
        at_least = f"at least {answer.at_least}" if answer.at_least else "undecided"
        return Tile("Faults", f"undecided: {possible}" if possible else at_least, f"See the section on faults.{shift}", False)
    rests = "The number was given." if answer.n_v_given else f"Counted from {answer.counted_by or 'the data'}."
    if answer.n_v == 0 and moved:
        return Tile("Faults", "a constant one acts", f"No other was counted.{shift}", False)
    if answer.n_v == 0 and not answer.n_v_given and answer.noise_level is None and answer.healthy is None and not answer.exact:
        return Tile("Faults", "none told from noise", f"{rests} It takes the noise for granted that the section on faults states.", False)
    if answer.n_v == 0 and not answer.n_v_given and not answer.exact:
        return Tile("Faults", "none seen", f"{rests} The section on faults says from which size on one would have been.")
    return Tile("Faults", counted(answer.n_v, "fault"), rests)


def _causes(answer: Answer) -> Iterator[Tile]:
    """Yield when the residual changes, and which single cause explains it, where these were asked."""
    onset, shift, isolation = answer.onset, answer.shift_isolation, answer.isolation
    if onset is not None and onset.onsets:
        first, last = onset.onsets[0].interval
        more = f" {counted(len(onset.onsets) - 1, 'more onset follows', 'more onsets follow')}." if len(onset.onsets) > 1 else ""
        yield Tile(
            "Onset",
            f"sample {onset.onsets[0].sample}{after_healthy(answer, onset.onsets[0].sample)}",
            f"It lies in {first} to {last} with probability {onset.confidence:g}.{more}",
        )
    if shift is not None and shift.decided:
        yield Tile("Cause", shift.answer, "This is told by the direction in which the mean of the residual moved.")
    elif isolation is not None:
        if isolation.decided:
            yield Tile("Cause", isolation.answer, "This is told by the fault space.")
        else:
            yield Tile("Cause", "undecided", isolation.finding, False)
