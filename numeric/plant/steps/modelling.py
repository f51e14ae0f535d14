"""Make the model of `identify`: by reduction of an ARX model where there is noise, by PI-MOESP where there is none.

modelled        the Modelled of a record
window_default  the block rows of PI-MOESP where none are given

Which way. Without noise and fault both are exact; of PI-MOESP [V93] the audit asks it of every record that it ships, and it stays there.
Where a fault acts on a record without noise, neither is: what the fault does is told from what the inputs do by chance alone. Its rows are
exact all the same, and so is the count; the model is reduced under the covariance of what the faults leave, for the order of PI-MOESP.
Under noise PI-MOESP is far from what the data hold, and the reduction [W89] comes near it. Ranks tell the kinds of record apart
(`method/ranks/exactness.py`). PI-MOESP also stands in where the windows of an ARX model cannot be had: too few samples, an input that does
not excite them, an unstable plant. Where it finds no gap in its singular values, the reduction chooses the order, and where there is none
either, samples held back do (`method/model/order_choice.py`), so that there is a model whenever one is better than none.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ....base.errors import InvalidData
from ....base.progress import Progress
from ....base.sheets import counted
from ...data.records import Passes, Record
from ...data.validation import experiment
from ...method.model.arx_windows import longest_lag
from ...method.model.asymptotic_likelihood import reduction
from ...method.model.moesp_model import OrderUndecided
from ...method.model.order_choice import order_left_open
from ...method.model.past_inputs import pi_moesp_experiments
from ...method.model.reduction_starts import hankel_factors
from ...method.ranks.exactness import SCREENED, driven_exactly, obeys_exactly
from .findings import Modelled

DEFAULT_WINDOW = 20
SPARE = 3  # windows for each row of the Hankel matrices of PI-MOESP, at least
STAGE = "identifying the model"
MOST_TRIED = 1 << 18  # samples of a record of which orders are tried by samples held back: it stands in memory


def modelled(record: Record, order: int | None, block_rows: int | None, on_progress: Progress) -> Modelled:
    """Make the model of a record. Raises InvalidData where neither way can have one, with the reason of the first."""
    longest = _longest(record)
    exact = obeys_exactly(*longest.stretch(0, SCREENED), single=record.single)
    if not exact:
        try:
            return _by_reduction(record, order, block_rows, exact, on_progress)
        except InvalidData as error:
            found = _by_past_inputs(record, order, block_rows, exact, on_progress)
            note = f"the model is from PI-MOESP, without standard errors, for want of an ARX model: {error}"
            return _with_notes(_by_held_out(record, found, on_progress), note)
    found = _by_past_inputs(record, order, block_rows, exact, on_progress)
    if found.model is not None:
        driven = driven_exactly(*longest.stretch(0, SCREENED), single=record.single)
        return _beside_faults(record, found, block_rows, on_progress) if driven else found
    try:
        other = _by_reduction(record, order, block_rows, exact, on_progress)
    except InvalidData:
        return _by_held_out(record, found, on_progress)
    return _with_notes(other, f"PI-MOESP leaves the order undecided: {found.refusal}")


def _beside_faults(record: Record, found: Modelled, block_rows: int | None, on_progress: Progress) -> Modelled:
    """Return the model of the same order by reduction, where faults act on a record without noise: to a model they are noise, of which it
    has the covariance, and PI-MOESP leaves several times the error."""
    assert found.model is not None
    try:
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            other = _by_reduction(record, found.model.order, block_rows, found.exact, on_progress)
    except (InvalidData, np.linalg.LinAlgError) as error:
        return _with_notes(found, f"the model is an estimate by PI-MOESP, without standard errors, for want of an ARX model: {error}")
    return _with_notes(
        other, f"the record has no noise, but faults drive it, so that the model is an estimate, of order {found.model.order}"
    )


def _by_held_out(record: Record, found: Modelled, on_progress: Progress) -> Modelled:
    """Return the model of the order that fits samples held back best, where the singular values left it open, with what remains open."""
    if found.model is not None:
        return found
    tried = _longest(record)
    chosen = order_left_open(*tried.stretch(0, len(tried)), found.window) if len(tried) <= MOST_TRIED else None
    if chosen is None:
        return found
    fits = ", ".join(f"{n}: {fit:.3g}" for n, fit in enumerate(chosen.fits, 1) if np.isfinite(fit))
    note = (
        f"the order is chosen by the fit of models of the first two thirds to the last, 1 perfect, by order {fits}: {chosen.best} fits "
        f"best, and {chosen.least} to {chosen.most} are not told apart; what follows rests on it ({found.refusal})"
    )
    return _with_notes(_by_past_inputs(record, chosen.best, found.window, found.exact, on_progress), note)


def _with_notes(found: Modelled, *notes: str) -> Modelled:
    return Modelled(found.model, found.singular_values, found.window, found.exact, found.way, (*notes, *found.notes), found.refusal)


def _by_reduction(record: Record, order: int | None, block_rows: int | None, exact: bool, on_progress: Progress) -> Modelled:
    sources = [experiment(Passes(one, STAGE, on_progress), None) for one in record.experiments]
    # Without its note of a closed loop, which is among the doubts, with what it does.
    found, _ = reduction(sources, order, block_rows, True)
    # Powers of two near the deviations: they round nothing, and are the same in whatever pieces the record came.
    units = np.exp2(-np.round(np.log2(record.channels.deviation)))
    arx = found.arx.scaled(units[record.n_u :], units[: record.n_u])
    values = hankel_factors(arx, max(arx.order, 1), weighted=True)[2]
    way = f"an ARX model of {counted(arx.order, 'lag')}, reduced under its own weight"
    notes = found.notes
    if found.order == 0:
        notes += ("the outputs follow the inputs at once or not at all: the model has no state",)
    lags = block_rows if block_rows is not None else max(longest_lag([len(one) for one in record.experiments], record.p, record.n_u), 1)
    return Modelled(found, values, lags, exact, way, notes)


def _by_past_inputs(record: Record, order: int | None, block_rows: int | None, exact: bool, on_progress: Progress) -> Modelled:
    rows = block_rows if block_rows is not None else window_default(len(record), record.p, record.n_u, order)
    way = f"PI-MOESP with windows of {rows} samples"
    try:
        found = pi_moesp_experiments(_of_windows(record, 2 * rows, on_progress), order=order, block_rows=rows)
    except OrderUndecided as error:
        return Modelled(None, error.singular_values, rows, exact, way, refusal=str(error))
    notes = found.warnings
    if order is not None and not found.gap.clean:
        notes += (f"order {order} was given; the singular values have no clean gap there (ratio {found.gap.ratio:.3g})",)
    return Modelled(found, found.singular_values, rows, exact, way, notes)


def _longest(record: Record) -> Record:
    """Return the longest experiment of a record."""
    return max(record.experiments, key=len)


def _of_windows(record: Record, least: int, on_progress: Progress) -> list[tuple[Any, None]]:
    """Return the experiments with so many samples at least, or all where none has."""
    longer = [one for one in record.experiments if len(one) >= least]
    return [(Passes(one, STAGE, on_progress), None) for one in longer or record.experiments]


def window_default(samples: int, p: int, n_u: int, order: int | None) -> int:
    """Return 20 block rows, more where a given order needs them, fewer where the record is short."""
    wanted = DEFAULT_WINDOW if order is None else max(DEFAULT_WINDOW, -(-order // p) + 2, -(-order // n_u) + 1)
    affordable = samples // (2 + SPARE * (2 * n_u + p))
    return max(min(wanted, affordable), 2)
