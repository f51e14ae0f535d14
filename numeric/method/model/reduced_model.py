"""Reduce an ARX model to order n under its weight, from the windows of the data alone, with the uncertainty of the result.

Uncertainty. Were the weight W the true one, the information of T would be the matrix of the normal equations. W = A* S^-1 A is estimated,
and too large on average: by 1 + p h / f, since the errors of A at one angle have the covariance (h / f) S x Phi^-1 [B74], and S^-1 by
f / (f - p - 1), the mean of an inverse Wishart matrix with f degrees of freedom. The same errors of the weight make the estimate vary more,
by the same share to first order [KR97]. So the information is divided by both twice.

A disturbance d that is not stationary, as faults may be, asks for no other covariance. Let u be stationary and independent of d. The slope
of the sum at the true T is linear in u and in d, so that its variance, given d, is an integral over angles of the spectrum of u times
the periodogram of d: the average spectrum of d alone counts, and that is what the ARX model fits.

ReducedModel        the result
reduced             the model of order n from windows
described, judged   a minimum in the units of the data with its uncertainty, and what must be said of it
reduction_problem   the ARX model and what is minimised, at given angles; reduction_problems: at angles enough, and for the search
weight_inflation    by how much the estimated weight makes information and costs too large
enough_angles       how many angles the sums over them need
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ....base.arrays import Array
from ....base.chi_squared import chi_squared_tail
from ....base.errors import InvalidData
from ....base.sheets import Shown, counted
from ...data.plain import by_name, plain
from .arx import Arx, adjoint, fitted_arx, input_spectrum
from .arx_windows import ArxWindows
from .compression import EPS
from .invariants import half_transfers, state_space, system_matrix
from .models import Identified, StateSpaceModel
from .order_evidence import OrderEvidence
from .reduction_search import Found, minimum
from .uncertainty import Uncertainty, uncertainty_of
from .weighted_reduction import Reduction, circle, spectral_radius

# Angles: 32 to 256 give the same errors (`python benchmarks/at_the_bound.py --calibrate angles`), poles near the circle ask for more.
COARSE, FINE = 64, 4096  # least and most angles
SAME_SUM = 1e-2  # relative change of the sums that twice the angles may make
UNBELIEVABLE = 1e-6  # probability of a misfit that is not put down to chance
AMPLIFICATION = 1e6  # growth over the windows from which an ARX model is called unstable where data or misfit say so too


@dataclass(frozen=True, eq=False, repr=False)
class ReducedModel(Identified, Shown):
    """The model of order n that `arx_reduction` gives, with what it rests on, in the units of the data [W89].

    `model` has A of the shape (n, n), B (n, n_u), C (p, n) and D (p, n_u). `innovation_covariance` (p, p) is that of the one-step errors
    of the ARX model, `arx`, whose `disturbance(angles)` is the spectrum (M, p, p) of faults and noise together. `uncertainty` has the
    standard deviations of Markov parameters, transfer function and poles. `cost` is the weighted sum of squares that the reduction left,
    which is the likelihood ratio of the ARX plant against this one. `likelihood` is what was minimised, in the units of the data and for
    as many samples as the estimated weight is worth: differences of its `cost` are twice those of log likelihoods. `offsets` has what
    the outputs are at rest with u = 0, of the shape (p,), for each experiment: sensors' zeros, the operating point and the means of the
    faults, which nothing in the data tells apart. `initial_states` has one of the shape (n,) an experiment, by least squares, and none
    where the data are not there any more. `orders` is the evidence where the order was left open, and `notes` say what a user must know.
    Look at `notes` first, then at `orders` where
    the order was left open, then at the poles with their deviations. Raises ImportError in `plot()` and `to_control()` where the package
    that they need is not installed.

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
    likelihood: Reduction
    offsets: tuple[Array, ...] = ()
    initial_states: tuple[Array, ...] = ()
    orders: OrderEvidence | None = None
    notes: tuple[str, ...] = ()

    @property
    def order(self) -> int:
        """Return the number n of states."""
        return self.model.n

    @property
    def offset(self) -> Array | None:
        """Return the outputs (p,) of the first experiment at rest with u = 0."""
        return self.offsets[0] if self.offsets else None

    @property
    def title(self) -> str:
        """Return what the model is, on one short line."""
        return f"ARX model reduced to {self.model.title.removeprefix('state-space model of ')}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield the notes, what the model rests on, its poles and Markov parameters with deviations, and the evidence for the order."""
        yield from (("note", note) for note in self.notes)
        yield "ARX model", f"{counted(self.arx.order, 'lag')}, {counted(self.arx.rows, 'window')} of the data"
        yield "misfit against the ARX model", f"{self.cost:.4g}"
        yield "deviation of the innovations", ", ".join(f"{size:.4g}" for size in np.sqrt(np.diag(self.innovation_covariance)))
        if self.offset is not None:
            yield "outputs at rest with u = 0", ", ".join(f"{level:.4g}" for level in self.offset)
        yield from self.uncertainty.sheet()
        if self.orders is not None:
            yield self.orders.title, ""
            yield from self.orders.sheet()

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict: that of the model, how sure it is, and what it rests on; null stands for what there is not."""
        arx = {"lags": self.arx.order, "windows": self.arx.rows, "A": plain(self.arx.outputs), "B": plain(self.arx.inputs)}
        uncertainty = {name: value for name, value in self.uncertainty.to_json().items() if name != "model"}
        found = by_name(self, "order", "cost", "innovation_covariance", "offsets", "initial_states", "orders", "notes")
        return self.model.to_json() | found | {"arx": arx, "uncertainty": uncertainty}

    def plot(self, ax: Any = None) -> Any:
        """Draw the poles with the regions that hold them with probability 0.95, as `uncertainty.plot` does, into the matplotlib axes `ax`,
        new ones where None are given, and return them. Raises ImportError without matplotlib."""
        return self.uncertainty.plot(ax)


def reduced(windows: ArxWindows, n: int) -> ReducedModel:
    """Return the model of order n >= 0 from the windows alone, without initial states. Raises InvalidData as `arx_reduction` does."""
    arx = fitted_arx(windows, -(-n // windows.p))
    problem, coarse = reduction_problems(windows, arx)
    return judged(described(windows, arx, problem, minimum(windows, arx, problem, coarse, n), n), windows)


def described(windows: ArxWindows, arx: Arx, problem: Reduction, found: Found, n: int) -> ReducedModel:
    """Return a minimum, which is in channels of unit deviation, in the units of the data and with its uncertainty."""
    y, u = windows.scales
    rows, columns = np.concatenate([np.ones(n), y]), np.concatenate([np.ones(n), 1 / u])
    scaled = uncertainty_of(state_space(found.matrix, n), problem.information(found.matrix, n) / weight_inflation(arx))
    model = state_space(found.matrix * rows[:, None] * columns, n)
    uncertainty = Uncertainty(model, scaled.root * np.outer(rows, columns).ravel()[:, None])
    inner = arx.scaled(y, u)
    likelihood = problem.scaled(y, u, problem.samples / weight_inflation(arx))
    return ReducedModel(model, inner.covariance, uncertainty, inner, found.cost, likelihood, _offsets(model, inner, windows))


def weight_inflation(arx: Arx) -> float:
    """Return what information and costs under an estimated weight are to be divided by: see the head of the module."""
    p, freedom = len(arx.covariance), arx.freedom
    return float(((1 + p * arx.order / freedom) * freedom / max(freedom - p - 1, 1)) ** 2)


def reduction_problems(windows: ArxWindows, arx: Arx) -> tuple[Reduction, Reduction]:
    """Return what is minimised, at angles enough, and the same at COARSE angles for the search."""
    count = enough_angles(windows, arx)
    problem = reduction_problem(windows, arx, circle(count))
    return problem, problem if count == COARSE else reduction_problem(windows, arx, circle(COARSE))


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


def _offsets(model: StateSpaceModel, arx: Arx, windows: ArxWindows) -> tuple[Array, ...]:
    """Return for each experiment what its outputs are at rest with u = 0, from the means of its windows.

    The constant of the ARX model is A(q) of the mean outputs less B(q) of the mean inputs, lag by lag, which is right whatever state the
    experiment began in. At rest the outputs are A(1)^-1 of it, about the mean input, from which the model's own gain leads to u = 0.
    """
    rest = np.zeros(1)
    gains = (arx.plant(rest)[0].real, half_transfers(system_matrix(model), model.n, rest)[0][0].real)
    found = []
    for mean in windows.means:
        outputs, inputs = ([mean[columns(lag)] for lag in range(arx.order + 1)] for columns in (windows.outputs, windows.inputs))
        constant = np.einsum("iab,ib->a", arx.outputs, outputs) - np.einsum("iab,ib->a", arx.inputs, inputs)
        at_mean = np.linalg.lstsq(arx.outputs.sum(axis=0), constant, rcond=None)[0]
        found.append(np.asarray(at_mean + (gains[0] - gains[1]) @ inputs[0], dtype=np.float64))
    return tuple(found)


def judged(found: ReducedModel, windows: ArxWindows) -> ReducedModel:
    """Return the model with notes on what its cost and poles show. Raises InvalidData for a plant that seems to be unstable.

    At the true plant the cost is part of the likelihood ratio of all ARX parameters, chi-squared with as many degrees of freedom; at its
    minimum it is less. Roots of A(q) outside the unit circle alone tell little: of many roots some lie there by chance. They count where
    the outputs grow or the misfit is large.
    """
    model, arx, cost = found.model, found.arx, found.cost
    parameters = windows.p * windows.regressors(arx.order)
    radius, misfit = spectral_radius(model.A), chi_squared_tail(cost, parameters) < UNBELIEVABLE
    on_circle, most = radius > 1 - EPS**0.25, np.log(AMPLIFICATION)
    growing = np.log(max(arx.radius(), 1e-300)) * arx.rows > most
    if (misfit and arx.radius() > 1 and (on_circle or growing)) or (growing and windows.growth > most):
        raise InvalidData(
            f"no stable model of order {model.n} explains the data: its poles reach modulus {radius:.6g}, those of the ARX model "
            f"{arx.radius():.6g}, the outputs grow by about exp({windows.growth:.3g}), and the misfit is {cost:.4g} where {parameters} is "
            "usual; the plant may be unstable (pi_moesp takes such), or the order too low"
        )
    note = ""
    if misfit:
        note = f"order {model.n} leaves a misfit of {cost:.4g} where at most about {parameters} is usual: the order may be too low"
    elif on_circle:
        note = f"a pole has modulus {radius:.6g}: the plant may be unstable, or integrate, which is not fitted here"
    return replace(found, notes=(*found.notes, note)) if note else found
