"""This is what `identify` says and writes of each experiment, where a record holds several, and of the one where it holds one."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from ....base.arrays import Array
from ...data.plain import plain
from ...method.model.reduced_model import ReducedModel
from ..steps.explaining import most_moved

if TYPE_CHECKING:
    from ..steps.findings import Answer


def _before(part: Answer) -> int:
    """Return how many samples of the record of a part are those of a healthy record, and not of the experiment."""
    return (part.healthy or 0) if part.healthy_record else 0


def own_fit(part: Answer) -> Array:
    """Return 100 (1 - |y - simulated y| / |y - mean of y|) of each output (p,) over the samples of the experiment itself."""
    assert part.residual is not None
    start = _before(part)
    y = part.record.part(start, len(part.record))
    spread = np.sqrt(len(y)) * y.channels.deviation[y.n_u :]
    squares = sum((np.sum(r**2, axis=0) for r in part.residual.store.pieces(start)), np.zeros(y.p))
    return np.asarray(100 * (1 - np.sqrt(squares) / np.where(spread > 0, spread, 1.0)))


def experiments(answer: Answer) -> list[dict[str, Any]]:
    """Return what was found in each experiment, whose samples are counted from its own first one."""
    skipped = 1 if answer.healthy_record and len(answer.initial_states) > len(answer.experiments) else 0
    rows = []
    for number, part in enumerate(answer.experiments):
        model, onset, signal = answer.model, part.onset, part.signal
        offsets = model.offsets if isinstance(model, ReducedModel) else ()
        known, before = number + skipped, _before(part)
        states = answer.initial_states
        rows.append(
            {
                "samples": len(part.record) - before,
                "x0": plain(states[known]) if known < len(states) else None,
                "offset": plain(offsets[known]) if known < len(offsets) else None,
                "fit": None if part.residual is None else plain(own_fit(part)),
                "onsets": None if onset is None else [one.sample - before for one in onset.onsets],
                "onset_p_value": None if onset is None else plain(onset.p_value),
                "onset_reason": None if onset is None else onset.reason,
                "changed": None if part.changes is None else [f"{row.kind} of {row.channel}" for row in part.changes.seen],
                "shift": None if part.shift_isolation is None else part.shift_isolation.answer,
                "explained": plain(part.explained),
                "explained_by_noise": plain(part.by_noise),
                "trusted": None if signal is None else [max(sample - before, 0) for sample in signal.trusted],
            }
        )
    return rows


def experiment_lines(answer: Answer) -> Iterator[str]:
    """Yield the section on the experiments, where there are several."""
    if not answer.parts:
        return
    yield ""
    yield "## Experiments"
    yield "one model, one number of faults and one fault space for all; in each experiment by itself:"
    yield f"    {'experiment':>10}  {'samples':>8}  {'fit, least':>10}  {'signal explains':>15}  onsets, and what has changed"
    for number, (part, row) in enumerate(zip(answer.parts, experiments(answer), strict=True), 1):
        onsets = "none" if not row["onsets"] else "at sample " + ", ".join(map(str, row["onsets"][:4]))
        looked = "not looked for" if row["onsets"] is None else onsets
        seen = f"; {', '.join(row['changed'][:3])}" if row["changed"] else ""
        share = "-" if part.signal is None or part.explained is None else f"{100 * part.explained:.3g} %"
        yield f"    {number:>10}  {row['samples']:>8}  {np.min(own_fit(part)):>8.3g} %  {share:>15}  {looked}{seen}"
    healthy = " the healthy samples are held against each;" if answer.healthy is not None else ""
    yield f"samples are counted from the first of each experiment;{healthy} each is tested for an onset at its own level"
    drawn = answer.parts.index(most_moved(answer)) + 1
    yield f"the pictures of outputs, residual and signal are of experiment {drawn}, in which the residual varies most"
    for number, part in enumerate(answer.parts, 1):
        if part.shift_isolation is not None:
            yield f"experiment {number}: {part.shift_isolation.answer}"


def numbered(answer: Answer) -> Iterator[tuple[int, int, int, Answer]]:
    """Yield for each experiment its number, the first of its samples in the record of its part, where these stand among all samples, and
    the part."""
    place = (answer.healthy or 0) if answer.healthy_record and answer.parts else 0
    for number, part in enumerate(answer.experiments, 1):
        start = _before(part) if answer.parts else 0
        yield number, start, place, part
        place += len(part.record) - start
