"""Ask whether the data need the last state of a model, or whether one state less explains them as well.

Every surplus state of a model is a zero of its faults: the kernel rows have the degrees that they have, and n_z grows with the order that
was told. The reduction's cost at the order below is the likelihood ratio of the two orders, by the law that `order_evidence` uses: the gain
of a state that is not there is chi-squared with p + n_u degrees of freedom, about [D87].

last_state_chance    the probability of so large a gain where the state is not there
"""

from __future__ import annotations

from scipy.stats import chi2

from ...base.threads import one_thread
from .reduced_model import ReducedModel
from .reduction_starts import one_state_less
from .valleys import END, begun, in_units
from .weighted_reduction import descend


@one_thread()
def last_state_chance(found: ReducedModel) -> float:
    """Return the probability, one for a model without states: from 0.01 on, an order less is not refused.

    Models of the order below are sought from the model without each of its modes, and from random starts as `valleys` does.
    """
    n = found.order
    if n == 0:
        return 1.0
    problem, own, _, _ = in_units(found)
    shorter = [descend(problem, matrix, n - 1, *END) for matrix in one_state_less(own, n, problem)]
    best, cost = min(shorter, key=lambda end: end[1])
    if n > 1 and problem.plant.shape[2]:
        cost = min([cost, *(descend(problem, matrix, n - 1, *END)[1] for matrix in begun(problem, best, n - 1))])
    return float(chi2.sf(max(cost - problem.cost(own, n), 0.0), sum(problem.plant.shape[1:])))
