"""When the faults of `identify` set in, and which single sensor or actuator explains them.

with_onset       the Findings with the changes of the residual over the whole record
with_isolation   the Findings with the angle of each sensor and each input to the fault space, where there is one
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..base.progress import Progress
from .findings import Findings
from .signal.onset import fault_onset
from .space.isolation import isolate


def with_onset(answer: Findings, on_progress: Progress) -> Findings:
    """Return the Findings with the samples from which on the residual is another one."""
    assert answer.residual is not None
    on_progress("looking for the onset", 0, 0)
    try:
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            return replace(answer, onset=fault_onset(answer.residual, healthy=answer.healthy))
    except np.linalg.LinAlgError:
        note = "no onset was looked for: numbers of the residual are too unequal to compute with, as outliers make them"
        return replace(answer, notes=(*answer.notes, note))


def with_isolation(answer: Findings) -> Findings:
    """Return the Findings with what single causes are to the fault space; without a space nothing is said."""
    space, model, record = answer.fault_space, answer.model, answer.record
    if space is None or model is None:
        return answer
    y = record.stretch(*answer.held)[0]
    # The units that `identified_fault_space` matches states in: it is called with outputs about their means.
    sizes = np.sqrt(np.mean((y - y.mean(axis=0)) ** 2, axis=0))
    units = np.where(sizes > 0, sizes, 1.0)
    return replace(answer, isolation=isolate(space, model, outputs=record.outputs, inputs=record.inputs, units=units))
