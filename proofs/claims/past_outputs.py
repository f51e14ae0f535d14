"""past-outputs: with past outputs among the instruments, as tools have them, a coloured fault can bias the estimate."""

from __future__ import annotations

from typing import Any

from ...exact.limits.experiments import Experiment
from ..evidence.experiments import Drawn, experiment_of
from ..evidence.kept_experiments import WITHOUT_RANK
from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench
from .proposition_1 import certify_limits, smallest_limit, smallest_seasonal


def coloured_fault(bench: Workbench) -> Outcome:
    """With u white and v coloured and independent of u, the limit of PO-MOESP is claimed to lie in the range of O_s, as PI-MOESP's does."""

    def drive(system: dict[str, Any]) -> Experiment:
        return experiment_of(system, [[["1", "0"]]], [[["0", "1"]], [["0", "1"]]])

    return smallest_limit(
        bench,
        [drive],
        lambda e: e.controllable and e.observable and e.equal and not e.past_outputs_within,
        "u white, v(k) = f(k) + f(k-1) of its own white f",
    )


def white_fault(bench: Workbench) -> Outcome:
    """With u and v white and independent and no other noise, it does lie there."""
    return certify_limits([e for e in bench.limits if e.origin == Drawn.INDEPENDENT_WHITE], lambda e: e.past_outputs_within)


def past_inputs(bench: Workbench) -> Outcome:
    """Where the limit of PO-MOESP leaves the range, PI-MOESP is claimed to be right: some inputs of period 3 defeat both."""
    others = [name for name in WITHOUT_RANK if name.endswith("coloured-fault") or name.startswith("rational")]
    return smallest_seasonal(lambda e: e.whole_range_expected and not e.past_outputs_within and not e.equal, taps=3, others=others)


def past_inputs_long_past(bench: Workbench) -> Outcome:
    """It is right where past >= n + the order of the filter of u."""
    records = [e for e in bench.limits if e.whole_range_expected and e.past_of_input and not e.past_outputs_within]
    return certify_limits(records, lambda e: e.equal and e.inputs_right)
