"""Find every valley of a reduction's likelihood: other models of the same order that explain the data about as well as the estimate.

The transfer functions of all models of an order are a manifold that is nearly flat on the scale of the errors, and the cost rises from its
minimum to the true model by what the chi-squared law says. But models far from each other may have transfer functions that differ by no
more than errors do: a state that hardly shows may have its pole elsewhere, and two modes may share what they explain in another way. They
lie in valleys of their own, whose costs differ by less than chance makes. What depends on A and C themselves, as a fault space does, may
then be far from the truth, by much more than the covariance at the estimate tells.

So the minimisation is repeated from STARTS models drawn at random: [A B] with orthonormal rows, from the uniform distribution [M07], which
is every controllable stable pair in input-normal coordinates, C and D by least squares, up the ladder of weights. Ends whose transfer
functions differ by less than a standard deviation are one valley. Its probability is proportional to exp(-cost / 2): under Jeffreys' prior
[J46], which is the volume in the space of transfer functions, all valleys are as wide.

Valley       a model with its uncertainty and its probability
valleys      those of a reduced model, its own first
in_units     likelihood and model in units in which it is conditioned well
begun        where descents from random starts come
last_state   what the last state of a reduced model gains: every surplus state is a zero of its faults, as the kernel rows have the degrees
             that they have. The cost at the order below is the likelihood ratio of the two orders, as in `order_evidence` [A74]; a state
             that is not there gains twice its p + n_u parameters in about one of ten records
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from ....base.arrays import Array
from ....base.threads import one_thread
from .invariants import state_space, system_matrix, transfer
from .reduced_model import COARSE, ReducedModel
from .reduction_search import RUNGS, TRUE
from .reduction_starts import one_state_less
from .uncertainty import Uncertainty, uncertainty_of
from .weighted_reduction import Reduction, arrived, descend, ladder

# Models that are followed. `python benchmarks/space_at_the_bound.py --calibrate` shows how often the angle of a fault space holds with
# fewer, and with more.
STARTS = 16
# Rise of the cost from which a valley is left out: with a weight of exp(-6) sixteen of them have no say in a quantile of 95 %.
HIGHEST = 12.0
# Squared distance of two transfer functions, in standard deviations, below which the data cannot tell them apart.
APART = 1.0
SEED = 20251122


@dataclass(frozen=True, eq=False)
class Valley:
    """The likelihood has a minimum at `uncertainty.model`, whose errors within the valley it tells, and the truth lies there with
    probability `weight`."""

    uncertainty: Uncertainty
    weight: float


@one_thread()
def valleys(found: ReducedModel) -> tuple[Valley, ...]:
    """Return the valleys that were found, in the units of the data, the model's own one first; the weights add up to one."""
    n = found.order
    problem, own, rows, columns = in_units(found)
    ends = [arrived(problem, matrix, n)[0] for matrix in begun(problem, own, n)] if min(n, problem.plant.shape[2]) else []
    minima = _distinct(problem, own, ends, n, HIGHEST)
    costs = np.array([problem.cost(matrix, n) for matrix in minima])
    weights = np.exp((costs.min() - costs) / 2)
    weights /= weights.sum()
    others = [_described(problem, matrix, n, rows, columns) for matrix in minima[1:]]
    return tuple(Valley(known, float(weight)) for known, weight in zip([found.uncertainty, *others], weights, strict=True))


def in_units(found: ReducedModel) -> tuple[Reduction, Array, Array, Array]:
    """Return the likelihood and the system matrix T with outputs in units of what disturbs them and inputs in units of their deviation, and
    the factors of the rows (n + p,) and columns (n + n_u,) of T that lead there."""
    likelihood, n = found.likelihood, found.order
    powers = np.linalg.inv(likelihood.weight), likelihood.spectrum
    # An output that nothing disturbs but rounding may come out below zero, and an input without power has none.
    y, u = (np.sqrt(np.abs(np.einsum("mii->i", power).real) / len(power)) for power in powers)
    y, u = np.where(y > 0.0, y, 1.0), np.where(u > 0.0, u, 1.0)
    rows, columns = np.concatenate([np.ones(n), 1 / y]), np.concatenate([np.ones(n), u])
    return likelihood.scaled(1 / y, 1 / u, likelihood.samples), system_matrix(found.model) * rows[:, None] * columns, rows, columns


def begun(problem: Reduction, own: Array, n: int) -> list[Array]:
    """Return where descents from random starts come near minima other than `own` (n + p, n + n_u), on few angles."""
    step = max(len(problem.angles) // COARSE, 1)
    thin = slice(step // 2, None, step)
    coarse = Reduction(problem.angles[thin], problem.plant[thin], problem.weight[thin], problem.spectrum[thin], problem.samples)
    rungs = list(ladder(coarse, np.asarray(np.linalg.inv(coarse.weight), dtype=np.complex128)))
    rng, n_u, ends = np.random.default_rng(SEED), coarse.plant.shape[2], []
    for _ in range(STARTS):
        # An orthogonal matrix of no preferred direction, as scipy.stats.ortho_group draws it: from the QR decomposition of a normal one.
        q, r = np.linalg.qr(rng.normal(size=(n + n_u, n + n_u)))
        pair = (q * np.sign(np.diag(r)))[:n]
        matrix = rungs[0].output_matrices(pair[:, :n], pair[:, n:])
        for rung in rungs[:-1]:
            matrix, _ = descend(rung, matrix, n, *RUNGS)
        ends.append(descend(coarse, matrix, n, *TRUE)[0])
    return _distinct(coarse, own, ends, n, 2 * HIGHEST)[1:]


def _distinct(problem: Reduction, own: Array, ends: Iterable[Array], n: int, highest: float) -> list[Array]:
    """Return `own` and, by rising cost, the ends that the data tell apart and whose costs are not higher by `highest`."""
    kept, most = [own], problem.cost(own, n) + highest
    for cost, matrix in sorted(((problem.cost(end, n), end) for end in ends), key=lambda pair: pair[0]):
        response = replace(problem, plant=transfer(matrix, n, problem.angles))
        if cost < most and all(response.cost(other, n) >= APART for other in kept):
            kept.append(matrix)
    return kept


def _described(problem: Reduction, matrix: Array, n: int, rows: Array, columns: Array) -> Uncertainty:
    """Return the model and its uncertainty in the units of the data, those of the problem divided by `rows` and `columns`."""
    known = uncertainty_of(state_space(matrix, n), problem.information(matrix, n))
    return Uncertainty(state_space(matrix / rows[:, None] / columns, n), known.root / np.outer(rows, columns).ravel()[:, None])


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
