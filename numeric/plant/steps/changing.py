"""What has changed since the healthy samples of an identification, and what this leaves of a number of faults.

No number of faults follows from the table: a constant fault has no rank, and one fault can be seen in several rows. But 0 is too much said
where a row is seen, or would be seen but for a doubt.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from ....base.arrays import Array
from ....base.errors import InvalidData
from ...method.ranks.rank_gap import fault_dimension
from ...method.space.shift_isolation import gain_errors
from ..changes.predictor import LEARNT_FROM, Stretch
from ..changes.table import Changes
from ..changes.table_rows import MEAN
from ..changes.testing import CHANGES_LEVEL, RAW, changes_within, parameters, responses, table
from .explaining import doubt_of_means
from .findings import Because, Count, Explained, Reason

Tables = Sequence[Changes | None]


def changes_in(plant: Explained) -> Changes | None:
    """Return the table of the samples that faults are counted on; without healthy samples of these alone. None where it cannot be asked."""
    record, rest = plant.record, plant.residual
    first, last = plant.held
    names = record.outputs, record.inputs
    if plant.healthy is None:
        try:
            return changes_within(rest.store.read(first, last), *record.stretch(first, last), outputs=names[0])
        except InvalidData:
            return None
    if rest.fitted:
        return None  # the initial state is from all samples, so that nothing is known of the healthy ones alone
    start = max(plant.healthy - LEARNT_FROM, 0)
    before = _stretch(plant, start, plant.healthy)
    after = replace(_stretch(plant, first, last), gain_errors=gain_errors(plant.model))
    believed = RAW if doubt_of_means(plant, plant.healthy, before.u, after.u) else (*RAW, MEAN)
    return table(before, after, names, CHANGES_LEVEL, believed)


def _stretch(plant: Explained, first: int, last: int) -> Stretch:
    y, u = plant.record.stretch(first, last)
    return Stretch(plant.residual.store.read(first, last), y, u, responses(plant.model, u), parameters(plant.model))


def beside_changes(count: Count, tables: Tables) -> Count:
    """Leave a 0 undecided where a row of a table is seen, or is in doubt though its numbers are beyond chance, in any experiment."""
    if count.n_v not in (0, None):
        return count
    each = [(changes, number if len(tables) > 1 else None) for number, changes in enumerate(tables, 1) if changes is not None]
    seen = [_row(row, number) | {"told": row.told} for changes, number in each for row in changes.seen]
    if seen:
        return count.but(Reason(Because.CHANGED, {"rows": seen}))
    for changes, number in each:
        for row in changes.doubtful:
            return count.but(Reason(Because.CHANGE_OPEN, _row(row, number), row.reason))
    return count


def _row(row: Any, number: int | None) -> dict[str, Any]:
    return {"kind": row.kind, "channel": row.channel, "experiment": number}


def unlike_healthy_ranks(count: Count, tables: Tables, healthy: Array, u: Array) -> Count:
    """Leave a number of faults undecided that the ranks of the residual alone give, where the healthy residual (K, p) with its inputs
    (K, n_u) is too short to count against: noise of unequal powers has such ranks, too. They stand where the table sees a change and the
    ranks of the healthy residual find no fault."""
    if not count.n_v:
        return count
    try:
        there = fault_dimension(healthy, u=u).n_v
    except InvalidData:
        there = None
    if there:
        return count.but(Reason(Because.HEALTHY_RANKS_ALIKE, {"n_v": there}))
    seen = any(changes is not None and changes.seen for changes in tables)
    return count if seen else count.but(Reason(Because.NO_CHANGE_SEEN))
