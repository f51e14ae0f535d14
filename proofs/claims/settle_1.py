"""settle-1: a fault that follows the input, v(k) = K u(k-1), biases PI-MOESP."""

from __future__ import annotations

from functools import partial

from ...exact.kernel_representation import kernel_representation
from ..experiments_tried import LimitDossier, following
from ..verdicts import Outcome
from ..workbench import Workbench
from .proposition_1 import certify_limits, smallest_limit


def biased(bench: Workbench) -> Outcome:
    """u white, K != 0, the fault seen in the outputs: A, C of order n, B or D come out wrong."""
    records = [d for d in bench.limits if d.origin == "u white, v(k) = K u(k-1)" and _seen(d)]
    return certify_limits(records, lambda d: not (d.equal and d.inputs_right))


def a_c_wrong(bench: Workbench) -> Outcome:
    """A and C themselves come out wrong, the limit having rank n + 1: not where a zero of the fault at 0 cancels the delay."""
    return smallest_limit(
        [partial(following, gain="1")],
        lambda d: _seen(d) and d.controllable and d.observable and d.equal,
        "v(k) = u(k-1), u white",
    )


def _seen(d: LimitDossier) -> bool:
    return kernel_representation(d.experiment.system.residual).normal_rank == 1
