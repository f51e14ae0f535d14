"""Ask whether the data need the last state of a model, or whether they would rather do with one less.

Every surplus state of a model is a zero of its faults: the kernel rows have the degrees that they have, and n_z grows with the order that
was told. The reduction's cost at the order below is the likelihood ratio of the two orders, by which `order_evidence` chooses where the
order is open: a state is worth its p + n_u parameters where it gains more than twice their number [A74]. A state that is not there gains
as much about once in ten records.

LastState     what the last state gains
last_state    from a reduced model
"""

from __future__ import annotations

from dataclasses import dataclass

from ....base.threads import one_thread
from .reduced_model import ReducedModel
from .reduction_starts import one_state_less
from .valleys import begun, in_units
from .weighted_reduction import arrived


@dataclass(frozen=True)
class LastState:
    """The last state lowers the cost by `gain` with so many `parameters`."""

    gain: float
    parameters: int

    @property
    def worth(self) -> float:
        """Return the gain over what Akaike's criterion asks of it: from one on, the state is needed."""
        return self.gain / (2 * self.parameters)


@one_thread()
def last_state(found: ReducedModel) -> LastState:
    """Return what the last of n >= 1 states gains.

    Models of the order below are sought from the model without each of its modes, and from random starts as `valleys` does.
    """
    n = found.order
    problem, own, _, _ = in_units(found)
    shorter = [arrived(problem, matrix, n - 1) for matrix in one_state_less(own, n, problem)]
    best, cost = min(shorter, key=lambda end: end[1])
    if n > 1:
        cost = min([cost, *(arrived(problem, matrix, n - 1)[1] for matrix in begun(problem, best, n - 1))])
    return LastState(max(cost - problem.cost(own, n), 0.0), sum(problem.plant.shape[1:]))
