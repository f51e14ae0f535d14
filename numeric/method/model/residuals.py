"""This is the residual r = y - (response of the model to u), with the initial state fitted or given.

Whatever trajectory x+ = A x + B u is subtracted, r obeys the fault model x+ = A x + F v, r = C x + G v; the choice of initial
state only decides how much free response stays in r. Fitting it by least squares takes out as much as can be.

    residual        y, u, model -> ResidualSignal
    ResidualSignal  r, x0 with their uncertainty
    split           coordinates in which slow and decaying modes run forward and growing modes run backward
    regressor       Phi (N p, n): the free response of unit states; the fit is y - T u ~ Phi theta

Soundness. The fit goes by orthogonal triangles of chunks of Phi, its columns scaled to unit norm, and singular directions at rounding
level are left at zero (they are not observable in the record), never by normal equations. A mode with |lambda|^N > GROWTH cannot be
simulated forward: the rounding of the first samples would fill the record. It is split off by an ordered Schur form and a Sylvester
equation [GVL13] and run backward from its fitted final state, where it decays; so unstable models need no refusal. With a
given x0 nothing is left to choose, and they are refused.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np
import scipy.linalg
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import Shown, counted
from ....base.threads import one_thread
from ...data.plain import by_name
from ...data.records import SampleStore, stored
from ...data.validation import experiment
from ..plotting import plot_residual
from ..ranks.sample_windows import stacked_triangle
from .models import Simulator, StateSpaceModel

GROWTH = 1e4
"""This is the largest growth over the record with which a mode is still simulated forward: it costs four digits of sixteen."""
FORWARD = 1e6
"""This is the largest growth over the record with which a mode is simulated forward from a state that is given: ten digits remain."""
CHUNK = 1024


@dataclass(frozen=True, eq=False, repr=False)
class ResidualSignal(Shown):
    """The residual r (N, p) of a model, in the units of y, with the initial state that it was taken from.

    `store` holds r, and `x0` (n,) is the state at the first sample; `fitted` says whether it was fitted to this record. `covariance` (p, p)
    is that of r about zero, with fitted degrees of freedom taken off; `x0_covariance` (n, n) is zero where x0 was given. `observed` is the
    number of state directions that the record determines, `backward` the number of growing modes that were run backward, and `notes` are
    what a user should know. Raises ImportError in
    `plot()` without matplotlib. Source of the fit: [GVL13] section 5.3.

    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, residual
    >>> found = residual(np.ones((4, 1)), np.zeros((4, 1)), StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]]), x0=[0.0])
    >>> found, found.r.ravel().tolist()
    (<ResidualSignal: residual of 4 samples, 1 output>, [1.0, 1.0, 1.0, 1.0])
    """

    store: SampleStore
    x0: Array
    fitted: bool
    covariance: Array
    x0_covariance: Array
    observed: int
    backward: int
    notes: tuple[str, ...]

    @cached_property
    def r(self) -> Array:
        """Return the residual (N, p), all of it in memory."""
        return self.store.read(0, len(self.store))

    @property
    def title(self) -> str:
        """Return what the residual is, on one short line."""
        return f"residual of {counted(len(self.store), 'sample')}, {counted(self.store.width, 'output')}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield what there is to say of it, as pairs of a name and a value."""
        sizes = np.sqrt(np.diag(self.covariance))
        yield "standard deviation by output", ", ".join(f"{size:.4g}" for size in sizes)
        yield "initial state", f"{'fitted' if self.fitted else 'given'}, {self.observed} of {len(self.x0)} directions determined"
        yield from (("note", note) for note in self.notes)

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict of everything but the samples, which `r` has."""
        found = by_name(self, "x0", "fitted", "covariance", "x0_covariance", "observed", "backward", "notes")
        return {"samples": len(self.store), "p": self.store.width} | found

    def plot(self, ax: Any = None) -> Any:
        """Draw the residual into the matplotlib axes `ax`, new ones where None are given, and return them. Raises ImportError without
        matplotlib."""
        return plot_residual(self.r, ax=ax)


class HasModel(Protocol):
    """What an identification returns: a result with its `model`."""

    @property
    def model(self) -> Any:
        """Return the model that was identified, or another result that has it; None where there is none."""


@one_thread()
def residual(
    y: ArrayLike | Iterable[tuple[ArrayLike, ArrayLike]],
    u: ArrayLike | None,
    model: StateSpaceModel | HasModel,
    *,
    x0: ArrayLike | None = None,
) -> ResidualSignal:
    """Return r = y - (the model's response to u); the initial state is fitted by least squares [GVL13] unless `x0` is given.

    With x0 given, the record is read once, piece by piece, and none of it is held; the fit of x0 holds it. The covariance of x0 holds for a
    stationary r, with autocovariances up to lag N^(1/3) under Bartlett weights [NW87]; the model is taken as exact.

    Parameters
    ----------
    y, u : array_like, (N, p) and (N, n_u)
        In the model's units; with `u` None, `y` gives the consecutive pieces (y, u) of the record at each `iter`.
    model : StateSpaceModel, or what has one
        As the results of `pi_moesp` and `identify` have.
    x0 : array_like (n,), optional
        The initial state.

    Returns
    -------
    ResidualSignal
        `r` (N, p) and `x0`.

    Raises
    ------
    InvalidData
        NaN, unequal lengths, channels that do not fit the model; where x0 is fitted, no more samples (N p of all outputs) than states; a
        given x0 with a model whose modes grow by more than FORWARD over the record.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, residual
    >>> model = StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]])
    >>> u = np.ones((4, 1))
    >>> residual(model.simulate(u) + 0.25, u, model, x0=[0.0]).r.ravel().tolist()
    [0.25, 0.25, 0.25, 0.25]
    """
    if model is None:
        raise InvalidData("model: got None; a StateSpaceModel is needed, or the result of pi_moesp or of identify")
    model = _found_in(model)
    source = experiment(y, u)
    if x0 is not None:
        return _with_given_state(source, model, x0)
    gathered = list(source)
    outputs, inputs = (np.concatenate([piece[i] for piece in gathered]) for i in (0, 1))
    _check(outputs.shape, inputs.shape, model)
    parts = split(model, len(outputs))
    error = outputs - parts.forced(inputs)
    theta, directions, observed = _fit(parts, error)
    r = error
    for start, stop, phi in parts.chunks():
        r[start:stop] -= phi @ theta
    to_x0 = parts.to_first_state()
    notes = []
    if parts.backward:
        notes.append(f"{parts.backward} growing mode(s) of the model were run backward from their fitted final state")
    if observed < model.n:
        notes.append(f"the record determines {observed} of {counted(model.n, 'direction')} of the state; x0 is zero along the others")
    freedom = max(len(r) - observed / model.p, 1.0)
    return ResidualSignal(
        store=stored(r),
        x0=parts.first_state(theta, inputs),
        fitted=True,
        covariance=r.T @ r / freedom,
        x0_covariance=to_x0 @ _state_covariance(parts, r, directions) @ to_x0.T,
        observed=observed,
        backward=parts.backward,
        notes=tuple(notes),
    )


def _found_in(model: StateSpaceModel | HasModel) -> StateSpaceModel:
    """Return the model of a result; InvalidData where it has none."""
    if (found := model_of(model)) is None:
        raise InvalidData("model: the identification has none, since its order is undecided: state an order")
    return found


def model_of(result: StateSpaceModel | HasModel | None) -> StateSpaceModel | None:
    """Return the model of a result, which is one or has one; None where there is none."""
    while result is not None and not isinstance(result, StateSpaceModel):
        result = result.model
    return result


def _fits(y: tuple[int, ...], u: tuple[int, ...], model: StateSpaceModel) -> None:
    """Refuse channels that do not fit the model."""
    if y[1] != model.p or u[1] != model.n_u:
        turned = "; y looks transposed, pass y.T" if y[0] == model.p else ""
        raise InvalidData(
            f"y has {counted(y[1], 'column')} and u has {u[1]}, the model has "
            f"{counted(model.p, 'output')} and {counted(model.n_u, 'input')}: "
            f"one column a channel is needed{turned}"
        )


def _check(y: tuple[int, ...], u: tuple[int, ...], model: StateSpaceModel) -> None:
    """Refuse data that do not fit the model, or are too few."""
    _fits(y, u, model)
    if y[0] * model.p <= model.n:
        raise InvalidData(
            f"{counted(y[0], 'sample')} of {counted(model.p, 'output')} cannot fix "
            f"{counted(model.n, 'initial state')}: more than {model.n / model.p:g} samples are "
            f"needed; give more samples, or x0"
        )


def _with_given_state(source: Iterable[tuple[Array, Array]], model: StateSpaceModel, x0: ArrayLike) -> ResidualSignal:
    """Return the residual from a known initial state, piece by piece."""
    simulator = Simulator(model, np.array(x0, dtype=np.float64).reshape(-1))
    state, store, squares = simulator.state.copy(), SampleStore(model.p), np.zeros((model.p, model.p))
    u_width = 0
    for y, u in source:
        _fits(y.shape, u.shape, model)
        r = y - simulator.respond(u)
        with np.errstate(over="ignore", invalid="ignore"):  # a model that grows so much is refused below
            squares += r.T @ r
        store.append(r)
        u_width = u.shape[1]
    samples = len(store)
    _check((samples, model.p), (samples, u_width or model.n_u), model)
    if growing := growing_modes(model, samples):
        raise InvalidData(
            f"the model has {counted(growing, 'mode')} growing by more than {FORWARD:g} over "
            f"{counted(samples, 'sample')}: simulating from a given x0 would "
            f"amplify rounding as much; leave x0 out (the growing modes are then run backward), or cut the record into shorter experiments"
        )
    return ResidualSignal(store, state, False, squares / samples, np.zeros((model.n, model.n)), model.n, 0, ())


def growing_modes(model: StateSpaceModel, samples: int) -> int:
    """Return how many modes grow so much over so many samples that the model cannot be simulated forward from a given state."""
    return int(np.sum(np.abs(model.poles) > FORWARD ** (1.0 / samples)))


def _radius(samples: int) -> float:
    """Return the modulus that grows by GROWTH over the record."""
    return float(GROWTH ** (1.0 / samples))


@dataclass(frozen=True)
class SplitModel:
    """The state is x = basis [x_f; x_b], where x_f runs forward from its first state and x_b backward from the state after the last
    sample; theta stacks both."""

    forward_model: StateSpaceModel
    backward_model: StateSpaceModel
    basis: Array
    samples: int

    @property
    def backward(self) -> int:
        """Return the number of states that run backward."""
        return self.backward_model.n

    def forced(self, u: Array) -> Array:
        """Return the response to u with theta = 0."""
        return self.forward_model.simulate(u) + self.backward_model.simulate(u[::-1])[::-1]

    def rows(self, start: int, stop: int) -> Array:
        """Return rows start .. stop - 1 of the regressor, (stop - start, p, n)."""
        ahead = _powers(self.forward_model, start, stop - start)
        behind = _powers(self.backward_model, self.samples - stop, stop - start)[::-1]
        return np.concatenate([ahead, behind], axis=2)

    def chunks(self) -> Iterator[tuple[int, int, Array]]:
        """Return the regressor in chunks (start, stop, rows)."""
        for start in range(0, self.samples, CHUNK):
            stop = min(start + CHUNK, self.samples)
            yield start, stop, self.rows(start, stop)

    def first_state(self, theta: Array, u: Array) -> Array:
        """Return the state x at the first sample."""
        ahead = self.forward_model.n
        simulator = Simulator(self.backward_model, theta[ahead:])
        simulator.respond(np.ascontiguousarray(u[::-1]))
        return np.asarray(self.basis @ np.concatenate([theta[:ahead], simulator.state]))

    def to_first_state(self) -> Array:
        """Return d x(0) / d theta."""
        back = np.linalg.matrix_power(self.backward_model.A, self.samples)
        return np.asarray(self.basis @ scipy.linalg.block_diag(np.eye(self.forward_model.n), back))


def split(model: StateSpaceModel, samples: int) -> SplitModel:
    """Separate the modes that grow by more than GROWTH over the record from the others."""
    radius = _radius(samples)
    schur, turn, ahead = scipy.linalg.schur(model.A, output="real", sort=lambda re, im: bool(np.hypot(re, im) <= radius))
    coupling = scipy.linalg.solve_sylvester(schur[:ahead, :ahead], -schur[ahead:, ahead:], -schur[:ahead, ahead:])
    basis = turn.copy()
    basis[:, ahead:] += turn[:, :ahead] @ coupling
    inputs = turn.T @ model.B
    inputs[:ahead] -= coupling @ inputs[ahead:]
    outputs = model.C @ basis
    forward_model = StateSpaceModel(schur[:ahead, :ahead], inputs[:ahead], outputs[:, :ahead], model.D)
    # x_b(k) = A^-1 (x_b(k+1) - B u(k)), y(k) = C x_b(k): a decaying model of the reversed record.
    inverse = np.linalg.inv(schur[ahead:, ahead:])
    push = -inverse @ inputs[ahead:]
    backward_model = StateSpaceModel(inverse, push, outputs[:, ahead:] @ inverse, outputs[:, ahead:] @ push)
    return SplitModel(forward_model, backward_model, basis, samples)


def _powers(model: StateSpaceModel, first: int, count: int) -> Array:
    """Return C A^k for k = first .. first + count - 1, (count, p, n), by doubling."""
    block = (model.C @ np.linalg.matrix_power(model.A, first))[np.newaxis]
    step = model.A
    while len(block) < count:
        block = np.concatenate([block, block @ step])
        step = step @ step
    return np.asarray(block[:count], dtype=np.float64)


def _fit(parts: SplitModel, error: Array) -> tuple[Array, Array, int]:
    """Return theta by least squares, a matrix D with D D' = (Phi' Phi)^+, and the number of directions determined."""
    n = parts.basis.shape[0]
    chunks = parts.chunks()
    rows = (np.hstack([phi.reshape(phi.shape[0] * phi.shape[1], n), error[start:stop].reshape(-1, 1)]) for start, stop, phi in chunks)
    triangle = stacked_triangle(n + 1, rows)
    norms = np.linalg.norm(triangle[:, :n], axis=0)
    norms = np.where(norms > 0.0, norms, 1.0)
    left, values, right = np.linalg.svd(triangle[:, :n] / norms, full_matrices=False)
    least = np.finfo(float).eps * max(len(error), n) * (values[0] if n else 0.0)
    observed = int(np.sum(values > least))
    directions = (right[:observed].T / values[:observed]) / norms[:, np.newaxis]
    return directions @ (left[:, :observed].T @ triangle[:, n]), directions, observed


def _state_covariance(parts: SplitModel, r: Array, directions: Array) -> Array:
    """Return the covariance of theta for a stationary r: D D' Phi' Cov(r) Phi D D', lags up to N^(1/3), Bartlett weights."""
    reach = min(int(np.ceil(len(r) ** (1 / 3))), len(r) - 1)
    n = parts.basis.shape[0]
    middle = np.zeros((n, n))
    lagged = [(1.0 - lag / (reach + 1)) * (r[lag:].T @ r[: len(r) - lag]) / len(r) for lag in range(reach + 1)]
    lagged[0] /= 2.0  # every term is added with its transpose
    largest = 0.0
    for start, _, phi in parts.chunks():
        size = float(np.max(np.abs(phi), initial=0.0))
        largest = max(largest, size)
        if size < 1e-9 * largest:  # a decayed response adds nothing to a covariance
            continue
        before = min(start, reach)
        longer = np.concatenate([parts.rows(start - before, start), phi]) if before else phi
        # Outputs come first, so that a covariance meets all samples of the chunk in one product of matrices.
        outputs = np.ascontiguousarray(longer.transpose(1, 0, 2))
        p, samples, _ = outputs.shape
        weighted = np.zeros((p, len(phi), n))
        for lag, covariance in enumerate(lagged):
            skip = max(lag - before, 0)
            then = outputs[:, before + skip - lag : samples - lag]
            weighted[:, skip:] += (covariance @ then.reshape(p, then.shape[1] * n)).reshape(then.shape)
        term = outputs[:, before:].reshape(p * len(phi), n).T @ weighted.reshape(p * len(phi), n)
        middle += term + term.T
    inverse = directions @ directions.T
    return np.asarray(inverse @ middle @ inverse)
