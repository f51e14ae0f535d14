"""past-outputs: with past outputs among the instruments, as every packaged tool has them, a coloured fault biases the estimate."""

from __future__ import annotations

from typing import Any

from ...exact.experiments import Experiment
from ..experiments_tried import experiment_of
from ..verdicts import Outcome
from ..workbench import Workbench
from .proposition_1 import certify_limits, smallest_limit


def coloured_fault(bench: Workbench) -> Outcome:
    """u white, v coloured and independent of u: the limit of PO-MOESP lies in the range of O_s, as that of PI-MOESP does."""

    def drive(system: dict[str, Any]) -> Experiment:
        return experiment_of(system, [[["1", "0"]]], [[["0", "1"]], [["0", "1"]]])

    return smallest_limit(
        [drive],
        lambda d: d.controllable and d.observable and d.equal and not d.past_outputs_within,
        "u white, v(k) = f(k) + f(k-1) of its own white f",
    )


def white_fault(bench: Workbench) -> Outcome:
    """u and v white and independent, no other noise: it does."""
    return certify_limits([d for d in bench.limits if d.origin == "u and v white and independent"], lambda d: d.past_outputs_within)


def past_inputs(bench: Workbench) -> Outcome:
    """On the experiments with a coloured fault independent of u where PO-MOESP fails, PI-MOESP is right."""
    records = [d for d in bench.limits if d.uncorrelated and not d.past_outputs_within and d.controllable and d.observable and d.long_past]
    return certify_limits(records, lambda d: d.equal and d.inputs_right)
