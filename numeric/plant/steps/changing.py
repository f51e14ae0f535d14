"""What has changed since the healthy samples of an identification, and what this leaves of a number of faults.

with_changes      the Findings with the table: against the healthy samples, or the little that can be said within a record without them
beside_changes    the same where the table forbids to say 0
unlike_healthy_ranks    a count by ranks alone, where the healthy part is too short to count against it

No number of faults follows from the table: a constant fault has no rank, and one fault can be seen in several rows. But 0 is too much said
where a row is seen, or would be seen but for a doubt.
"""

from __future__ import annotations

from dataclasses import replace

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ...method.ranks.rank_gap import fault_dimension
from ...method.space.shift_isolation import gain_errors
from ..changes.predictor import LEARNT_FROM, Stretch
from ..changes.table_rows import MEAN
from ..changes.testing import CHANGES_LEVEL, RAW, changes_within, parameters, responses, table
from .elsewhere import doubt_of_means
from .findings import Findings


def with_changes(answer: Findings) -> Findings:
    """Return the Findings with the table, of the samples that faults are counted on; without healthy samples of these alone."""
    record, rest = answer.record, answer.residual
    assert rest is not None
    if rest.fitted and answer.healthy is not None:
        return answer  # the initial state is from all samples, so that nothing is known of the healthy ones alone
    first, last = answer.held
    names = record.outputs, record.inputs
    if answer.healthy is None:
        y, u = record.stretch(first, last)
        try:
            found = changes_within(rest.store.read(first, last), y, u, outputs=names[0])
        except InvalidData:
            return answer
        return replace(answer, changes=found)
    start = max(answer.healthy - LEARNT_FROM, 0)
    parts = (_stretch(answer, start, answer.healthy), _stretch(answer, first, last))
    after = replace(parts[1], gain_errors=gain_errors(answer.model))
    believed = RAW if doubt_of_means(answer, answer.healthy, parts[0].u, after.u) else (*RAW, MEAN)
    return replace(answer, changes=table(parts[0], after, names, CHANGES_LEVEL, believed))


def _stretch(answer: Findings, first: int, last: int) -> Stretch:
    assert answer.residual is not None and answer.model is not None
    y, u = answer.record.stretch(first, last)
    return Stretch(answer.residual.store.read(first, last), y, u, responses(answer.model, u), parameters(answer.model))


def beside_changes(answer: Findings) -> Findings:
    """Leave a 0 undecided where a row of a table is seen, or is in doubt though its numbers are beyond chance, in any experiment."""
    if answer.n_v not in (0, None):
        return answer
    tables = [(one.changes, _where(answer, number)) for number, one in enumerate(answer.experiments, 1) if one.changes is not None]
    seen = [(row, where) for changes, where in tables for row in changes.seen]
    doubtful = [(row, where) for changes, where in tables for row in changes.doubtful]
    if seen:
        rows = "; ".join(f"{row.kind} of {row.channel}{where}: {row.told}" for row, where in seen[:2])
        more = f" and {counted(len(seen) - 2, 'row')} more" if len(seen) > 2 else ""
        told = f"something has changed ({rows}{more}), whatever its number of independent faults"
    elif doubtful:
        row, where = doubtful[0]
        told = f"whether there is a {row.kind} of {row.channel}{where} is undecided: {row.reason}"
    else:
        return answer
    return replace(answer, n_v=None, counted_by=None, reason=f"{answer.reason}; but {told}")


def _where(answer: Findings, number: int) -> str:
    return f" in experiment {number}" if answer.parts else ""


def unlike_healthy_ranks(answer: Findings, healthy: Array, u: Array) -> Findings:
    """Leave a number of faults undecided that the ranks of the residual alone give, where the healthy residual (K, p) with its inputs
    (K, n_u) is too short to count against: noise of unequal powers has such ranks, too. They stand where the table sees a change and the
    ranks of the healthy residual find no fault."""
    if not answer.n_v:
        return answer
    try:
        there = fault_dimension(healthy, u=u).n_v
    except InvalidData:
        there = None
    if any(one.changes is not None and one.changes.seen for one in answer.experiments) and not there:
        return answer
    why = f"the same way finds {there} among the healthy samples" if there else "the table of changes sees none since the healthy samples"
    return replace(answer, n_v=None, counted_by=None, reason=f"{answer.reason}; but {why}, so that this may be noise of unequal powers")
