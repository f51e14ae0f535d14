"""Make the answer of `identify` from its steps, when the last of them is done; the words of its reasons are made here.

answered    the Identification of a record with a model, with that of each experiment
left_open   where the order of the model stays open
Told        what the caller said of the answer, and what the record gives reason to doubt
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar

from ...base.arrays import Array
from ..method.ranks.rank_gap import FaultDimension
from .answer import Identification
from .doubt.listing import Doubts
from .healthy.against_healthy import FaultsAgainstHealthy
from .steps.findings import Begun, Causes, Count, Counted, Explained, Measured, Modelled, Signal, Signals, Space
from .steps.words import said

NOTHING_COUNTED = Counted(Count(None, (), None, ()), (0, 0))
NOTHING_OF_ITS_OWN: dict[str, Any] = {
    **{"residual": None, "sizes": None, "held": (0, 0), "initial_states": ()},
    **dict.fromkeys(("onset", "changes", "shift_isolation", "pair", "signal", "explained", "by_noise")),
}

Evidence = TypeVar("Evidence", FaultDimension, FaultsAgainstHealthy)


@dataclass(frozen=True, eq=False)
class Told:
    """Whether order and number of faults were stated, the sample time, the doubts, and notes of what was left out."""

    order_given: bool
    n_v_given: bool
    dt: float | None
    doubts: Doubts
    notes: tuple[str, ...]


def left_open(measured: Measured, made: Modelled, told: Told) -> Identification:
    """Return the answer where the order of the model stays open, and nothing follows."""
    notes = (*told.notes, *made.notes, f"the order is undecided: {made.refusal}")
    shared = _shared(made, told, NOTHING_COUNTED, Space(None), None)
    return Identification(**vars(measured), **shared, **NOTHING_OF_ITS_OWN, mean=None, notes=notes, parts=())


def answered(
    plant: Explained, made: Modelled, told: Told, onsets: Sequence[Begun], found: Counted, space: Space, causes: Causes, signals: Signals
) -> Identification:
    """Return the answer; of several experiments each has its own record, residual, onset, changes and signal, and the whole has none."""
    shared = _shared(made, told, found, space, causes)
    before, after = told.notes + made.notes + plant.residual.notes, found.notes + space.notes
    tables = found.changes or (None,) * len(onsets)
    each = [
        {**_explained(one), **_signal(signal, signals.pair), "onset": begun.onset, "changes": table, "shift_isolation": shift}
        for one, begun, table, shift, signal in zip(plant.experiments, onsets, tables, causes.shifts, signals.each, strict=True)
    ]
    if plant.parts:
        parts = tuple(
            Identification(**shared, **own, mean=None, notes=before + after + begun.notes + signal.notes, parts=())
            for own, begun, signal in zip(each, onsets, signals.each, strict=True)
        )
        own = NOTHING_OF_ITS_OWN | _explained(plant) | {"pair": signals.pair, "held": found.held}
        return Identification(**shared, **own, mean=found.mean, notes=before + after + signals.notes, parts=parts)
    notes = before + onsets[0].notes + after + signals.notes + signals.each[0].notes
    return Identification(**shared, **each[0] | {"held": found.held}, mean=found.mean, notes=notes, parts=())


def _explained(plant: Explained) -> dict[str, Any]:
    """Return what is known of a record, or of an experiment of it, beside the model."""
    names = [one.name for one in fields(Measured)]
    return {name: getattr(plant, name) for name in (*names, "residual", "sizes", "held", "initial_states")}


def _signal(found: Signal, pair: tuple[Array, Array] | None) -> dict[str, Any]:
    known = {"signal": found.reconstruction, "explained": found.explained, "by_noise": found.by_noise}
    return known | {"pair": None if found.reconstruction is None else pair}


def _shared(made: Modelled, told: Told, found: Counted, space: Space, causes: Causes | None) -> dict[str, Any]:
    """Return what all experiments share: the model, the number of faults and the space."""
    count = found.count
    return {
        "block_rows": made.window,
        "order_given": told.order_given,
        "singular_values": made.singular_values,
        "model": made.model,
        "exact": made.exact,
        "way": made.way,
        "dimension": _worded(found.ranks, found.by_ranks),
        "n_v": count.n_v,
        "n_v_given": told.n_v_given,
        "possible": count.possible,
        "because": count.because,
        "reason": said(count.because),
        "counted_by": count.by,
        "count": found.laws,
        "counted_against": found.against_samples,
        "against": _worded(found.against, found.by_healthy),
        "news": found.news,
        "visible": found.visible,
        "unexplained": found.unexplained,
        "fault_space": space.estimate,
        "isolation": None if causes is None else causes.isolation,
        "dt": told.dt,
        "doubts": told.doubts,
    }


def _worded(evidence: Evidence | None, count: Count | None) -> Evidence | None:
    """Return the evidence with what became of it beside others."""
    if evidence is None or count is None or len(count.because) == 1:
        return evidence
    return replace(evidence, n_v=count.n_v, reason=said(count.because))
