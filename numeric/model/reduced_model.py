"""Reduce an ARX model to order n under its weight, from the windows of the data alone, with the uncertainty of the result.

Uncertainty. Were the weight W the true one, the information of T would be the matrix of the normal equations. W = A* S^-1 A is estimated,
and too large on average: by 1 + p h / f, since the errors of A at one angle have the covariance (h / f) S x Phi^-1 [B74], and S^-1 by
f / (f - p - 1), the mean of an inverse Wishart matrix with f degrees of freedom. The same errors of the weight make the estimate vary more,
by the same share to first order [KR97]. So the information is divided by both twice.

ReducedModel        the result
reduced             the model of order n from windows
reduction_problem   the ARX model and what is minimised, at given angles
enough_angles       how many angles the sums over them need
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2

from ...base.arrays import Array
from ...base.errors import InvalidData
from .arx import Arx, adjoint, fitted_arx, input_spectrum
from .arx_windows import ArxWindows
from .compression import EPS
from .invariants import state_space
from .models import StateSpaceModel
from .order_evidence import OrderEvidence
from .reduction_starts import one_state_less, starts
from .uncertainty import Uncertainty, uncertainty_of
from .weighted_reduction import Reduction, circle, descend, ladder, spectral_radius

# Angles: 32 to 256 give the same errors (`python benchmarks/at_the_bound.py --calibrate angles`), poles near the circle ask for more.
COARSE, FINE = 64, 4096  # least and most angles
SAME_SUM = 1e-2  # relative change of the sums that twice the angles may make
# The search: one or three starts kept give the same errors (`--calibrate starts`); budgets only bound its time, the last one its end.
KEPT = 2  # starts that are followed up the ladder
NEAREST = 2  # starts of the least cost under the true weight that are followed without the ladder
RUNGS, TRUE, LAST = (15, 1e-3), (25, 1e-4), (60, 1e-7)  # most steps, and relative gain of a step below which a descent ends
DISTINCT = 1e-2  # relative difference of costs from which two starts are thought to lie in different valleys
UNBELIEVABLE = 1e-6  # probability of a misfit that is not put down to chance
AMPLIFICATION = 1e6  # growth over the windows from which an ARX model is called unstable where data or misfit say so too


@dataclass(frozen=True, eq=False)
class ReducedModel:
    """The model of order n that `arx_reduction` gives, with what it rests on, in the units of the data [W89].

    `model` has A of the shape (n, n), B (n, n_u), C (p, n) and D (p, n_u). `innovation_covariance` (p, p) is that of the one-step errors
    of the ARX model, `arx`, whose `disturbance(angles)` is the spectrum (M, p, p) of faults and noise together. `uncertainty` has the
    standard deviations of Markov parameters, transfer function and poles. `cost` is the weighted sum of squares that the reduction left,
    which is the likelihood ratio of the ARX plant against this one. `initial_states` has one of the shape (n,) an experiment, by least
    squares, and none where the data are not there any more. `orders` is the evidence where the order was left open, and `notes` say what
    a user must know. Raises nothing.

    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, arx_reduction
    >>> u, noise = np.random.default_rng(1).standard_normal((2, 400, 1))
    >>> y = StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]]).simulate(u) + 0.1 * noise
    >>> found = arx_reduction(y, u, order=1)
    >>> bool(abs(found.model.A[0, 0] - 0.5) < 4 * found.uncertainty.poles()[0].real), found.order
    (True, 1)
    """

    model: StateSpaceModel
    innovation_covariance: Array
    uncertainty: Uncertainty
    arx: Arx
    cost: float
    initial_states: tuple[Array, ...] = ()
    orders: OrderEvidence | None = None
    notes: tuple[str, ...] = ()

    @property
    def A(self) -> Array:
        """Return the state matrix (n, n)."""
        return self.model.A

    @property
    def B(self) -> Array:
        """Return the input matrix (n, n_u)."""
        return self.model.B

    @property
    def C(self) -> Array:
        """Return the output matrix (p, n)."""
        return self.model.C

    @property
    def D(self) -> Array:
        """Return the direct feedthrough (p, n_u)."""
        return self.model.D

    @property
    def order(self) -> int:
        """n is the number of states."""
        return self.model.n

    @property
    def x0(self) -> Array | None:
        """State (n,) at the first sample of the first experiment."""
        return self.initial_states[0] if self.initial_states else None


def reduced(windows: ArxWindows, n: int) -> ReducedModel:
    """Return the model of order n >= 0 from the windows alone, without initial states. Raises InvalidData as `arx_reduction` does."""
    return reduced_from(windows, fitted_arx(windows, -(-n // windows.p)), n)


def reduced_from(windows: ArxWindows, arx: Arx, n: int) -> ReducedModel:
    """Do the same with the ARX model (in channels of unit size) made beforehand."""
    problem = reduction_problem(windows, arx, circle(enough_angles(windows, arx)))
    matrix, cost = _minimum(windows, arx, problem, n)
    y, u = windows.scales
    rows, columns = np.concatenate([np.ones(n), y]), np.concatenate([np.ones(n), 1 / u])
    p, freedom = windows.p, arx.freedom
    too_large = (1 + p * arx.order / freedom) * freedom / max(freedom - p - 1, 1)
    scaled = uncertainty_of(state_space(matrix, n), problem.information(matrix, n) / too_large**2)
    model = state_space(matrix * rows[:, None] * columns, n)
    uncertainty = Uncertainty(model, scaled.root * np.outer(rows, columns).ravel()[:, None])
    inner = arx.scaled(y, u)
    return ReducedModel(model, inner.covariance, uncertainty, inner, cost, notes=_notes(model, inner, windows, cost))


def reduction_problem(windows: ArxWindows, arx: Arx, angles: Array) -> Reduction:
    """Return what is minimised: the ARX plant under its own weight and the input's spectrum, at these angles."""
    return Reduction(angles, arx.plant(angles), arx.weight(angles), input_spectrum(windows, angles), windows.rows)


def enough_angles(windows: ArxWindows, arx: Arx) -> int:
    """Return how many angles give the plant's response, plain and weighted, the same power as twice as many do."""
    count, before = COARSE, np.zeros(2)
    while True:
        problem = reduction_problem(windows, arx, circle(count))
        output = problem.plant @ problem.spectrum @ adjoint(problem.plant)
        sums = np.array([np.mean(np.trace(part, axis1=1, axis2=2).real) for part in (output, problem.weight @ output)])
        if np.all(np.abs(sums - before) <= SAME_SUM * sums):
            return count // 2
        if count >= FINE:
            return count
        count, before = 2 * count, sums


def _minimum(windows: ArxWindows, arx: Arx, problem: Reduction, n: int) -> tuple[Array, float]:
    """Return T of the least cost found, and that cost. The search uses few angles, and only its end is the problem itself."""
    coarse = problem if len(problem.angles) == COARSE else reduction_problem(windows, arx, circle(COARSE))
    rungs = list(ladder(coarse, arx.disturbance(coarse.angles)))
    begun = list(starts(windows, arx, rungs[0], n))
    found = _climbed(rungs, begun, n, KEPT)
    # What a flat weight cannot tell apart the true one can, from the start or from one state more.
    longer = _climbed(rungs, starts(windows, arx, rungs[0], n + 1), n + 1, 1) if n else []
    near = begun + [less for start, _ in longer for less in one_state_less(start, n + 1, coarse)]
    near.sort(key=lambda start: coarse.cost(start, n))
    found += [descend(coarse, start, n, *TRUE) for start in near[:NEAREST]]
    if not found:
        raise InvalidData(f"no start for order {n}: the data show no dynamics that a model of this order could be begun from")
    return descend(problem, min(found, key=lambda one: one[1])[0], n, *LAST)


def _climbed(rungs: Sequence[Reduction], begun: Iterable[Array], n: int, kept: int) -> list[tuple[Array, float]]:
    """Return the ends of the ladder from the `kept` best distinct starts, the least cost first."""
    distinct: list[tuple[Array, float]] = []
    for matrix, cost in sorted((descend(rungs[0], start, n, *RUNGS) for start in begun), key=lambda one: one[1]):
        if all(cost - other > DISTINCT * cost for _, other in distinct):
            distinct.append((matrix, cost))
    ends = []
    for matrix, _ in distinct[:kept]:
        for rung in rungs[1:-1]:
            matrix, _ = descend(rung, matrix, n, *RUNGS)
        ends.append(descend(rungs[-1], matrix, n, *TRUE))
    return sorted(ends, key=lambda one: one[1])


def _notes(model: StateSpaceModel, arx: Arx, windows: ArxWindows, cost: float) -> tuple[str, ...]:
    """Return notes on what the cost and the poles show. Raises InvalidData for a plant that seems to be unstable.

    At the true plant the cost is part of the likelihood ratio of all ARX parameters, chi-squared with as many degrees of freedom; at its
    minimum it is less. Roots of A(q) outside the unit circle alone tell little: of many roots some lie there by chance. They count where
    the outputs grow or the misfit is large.
    """
    parameters = windows.p * windows.regressors(arx.order)
    radius, misfit = spectral_radius(model.A), float(chi2.sf(cost, parameters)) < UNBELIEVABLE
    on_circle, most = radius > 1 - EPS**0.25, np.log(AMPLIFICATION)
    growing = np.log(max(arx.radius(), 1e-300)) * arx.rows > most
    if (misfit and arx.radius() > 1 and (on_circle or growing)) or (growing and windows.growth > most):
        raise InvalidData(
            f"no stable model of order {model.n} explains the data: its poles reach modulus {radius:.6g}, those of the ARX model "
            f"{arx.radius():.6g}, the outputs grow by about exp({windows.growth:.3g}), and the misfit is {cost:.4g} where {parameters} is "
            "usual; the plant may be unstable (pi_moesp takes such), or the order too low"
        )
    if misfit:
        return (f"order {model.n} leaves a misfit of {cost:.4g} where at most about {parameters} is usual: the order may be too low",)
    if on_circle:
        return (f"a pole has modulus {radius:.6g}: the plant may be unstable, or integrate, which is not fitted here",)
    return ()
