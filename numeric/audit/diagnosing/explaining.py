"""The sentence of what is probably wrong: the first suspicion that stands its test.

explained    of a failed check, or nothing where no suspicion stands
SUSPICIONS   of each function
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress

import numpy as np

from ....base.threads import one_thread
from ..records import Check, Demand, Function, Measurement
from . import counts, models, signals, spaces
from .suspicions import Case, Recorder, Suspicion

SUSPICIONS: Mapping[str, Sequence[Suspicion]] = {
    "identify": models.SUSPICIONS,
    "residual": signals.RESIDUAL,
    "window_ranks": counts.RANKS,
    "fault_dimension": counts.OF_RESIDUAL,
    "fault_space": spaces.SUSPICIONS,
    "reconstruct": signals.SIGNAL,
    "structure": counts.OF_STRUCTURE,
    "count_faults": counts.OF_RECORD,
    "identified_fault_space": spaces.OF_RECORD,
}


@one_thread()
def explained(check: Check, function: Function) -> str:
    """Return what is probably wrong with a guarded function that fails a check: a sentence that a computation bears out, or nothing.

    The function is asked again, as the check asks it and in other units, orders and states; an answer of its own is put right in many ways
    and given to the check. Nothing is told of checks of manners and costs, nor of those whose question is to be refused.
    """
    if check.kind is not Demand.MUST_HOLD:
        return ""
    recorder, measured = Recorder(function), list[Measurement]()
    with suppress(Exception):  # it failed, in whatever way
        measured.extend(check.measure(recorder))
    if not recorder.calls or (measured and not any(one.sides for one in measured)):
        return ""
    case = Case(check, function, recorder.calls, measured)
    return next((one.words for one in SUSPICIONS[check.function] if _stands(one, case)), "")


def _stands(suspicion: Suspicion, case: Case) -> bool:
    """This tells whether the test bears the suspicion out; an answer may be anything, and what no test can read bears nothing out."""
    try:
        with np.errstate(all="ignore"):
            return suspicion.confirmed(case)
    except Exception:
        return False
