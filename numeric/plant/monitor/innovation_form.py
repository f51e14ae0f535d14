"""Make the predictor of a monitor from a model and a record without fault, and run it over samples of which some may be missing.

What the monitor needs is an innovation form: x(k+1) = A x + B u + K e + a, y(k) = C x + D u + e + c, e white of covariance S [AM79].
The model gives A, B, C and D alone. A healthy record gives the rest in two steps:

    observer     e_o = y - C x - D u with x+ = A x + B u + K_o e_o. K_o is the gain of the Kalman predictor for noise of covariance q W in
                 the states and of covariance I in the outputs, W = (sum_i A'^i C' C A^i)^-1 over n samples, so that no choice of the basis
                 matters; of the candidates for q the one with the least determinant of the covariance of e_o. q = 0, which is y less the
                 simulated response, is a candidate where A is stable.
    whitening    e_o(k) = c + sum_j A_j e_o(k-j) + sum_j B_j u(k-j) + e(k) by least squares, the lags by the corrected Akaike criterion
                 [BT94]. It takes care of the colour of the noise, which the model does not know, of the error of the model as far as it is
                 linear in past outputs and inputs, and of a poor q: behind any stable observer lie the same innovations.

Both together are one innovation form, whose states are those of the model, past e_o and past inputs. A model without states (n = 0) leaves
the predictor to the whitening alone, which is then an ARX model of the record.

    Form, innovation_form     the innovation form and the errors it leaves on the healthy record, each sample judged by the others
    Predictor                 the Kalman filter of a form: where a state is not known, or outputs are missing, it knows less, and says so

Units: inside, every channel is about its healthy mean and in units of its healthy deviation.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ...method.model.models import StateSpaceModel, observability_matrix
from ...method.ranks.sample_windows import stacked_triangle
from ..healthy.healthy_model import lagged_stretches, number_of_lags

CANDIDATES = (1e-6, 1e-4, 1e-2, 1.0, 1e2)  # for q, beside 0
FOLDS = 4  # parts of the healthy record, each judged by what the others taught
FADED = 1e-2  # what may be left of the first state where the errors of an observer begin to count
ELSEWHERE = 10.0  # times farther than on the healthy record may the plant be where its state is not known
WILD = 1e3  # deviations at which the error of a forecast is cut off, so that a wild number is forgotten; an input of WILD^2 is missing
ROUNDING = 1e-10  # deviation of an error, in that of its output, below which there is no noise
GROWN = float(np.finfo(float).eps ** -0.5)  # times what a state is at the start: rounding in it is half of all digits below that
KNOWN = 1e-10  # variance of the states, in units of the channels, below which they count as known


@dataclass(frozen=True, eq=False)
class Units:
    """Outputs are in units of `scale` (p,) about `centre` (p,), inputs of `input_scale` (n_u,) about `input_centre` (n_u,)."""

    centre: Array
    scale: Array
    input_centre: Array
    input_scale: Array


@dataclass(frozen=True, eq=False)
class Form:
    """The innovation form: A (d, d), B (d, n_u), C (p, d), D (p, n_u), K (d, p), the constants `push` (d,) and `level` (p,).

    `covariance` (p, p) is that of a forecast's error and `unknown` (d, d) that of the states on the healthy record. The whitening has
    `lags` lags and `parameters` coefficients an output.
    """

    A: Array
    B: Array
    C: Array
    D: Array
    K: Array
    push: Array
    level: Array
    covariance: Array
    unknown: Array
    units: Units
    lags: int
    parameters: int

    @property
    def p(self) -> int:
        """Return the number of outputs."""
        return int(self.D.shape[0])

    @property
    def n_u(self) -> int:
        """Return the number of inputs."""
        return int(self.D.shape[1])


@dataclass(frozen=True, eq=False)
class _Whitening:
    """The coefficients (1 + lags (p + pushed) + pushed, p) of the regression of e_o, for `pushed` of the inputs, all or none."""

    coefficients: Array
    covariance: Array
    lags: int
    pushed: int


@dataclass(frozen=True, eq=False)
class Fitted:
    """A `form`, and the `errors` (M, p) of its forecasts on the healthy record, uncorrelated and of deviation one.

    The errors of each quarter are by what the other three taught; `sizes` (M, p) are the same errors output by output, each over its
    deviation.
    """

    form: Form
    errors: Array
    sizes: Array


def innovation_form(model: StateSpaceModel, y: Array, u: Array, *, with_inputs: bool) -> Fitted:
    """Return the form of the model that the healthy y (N, p) and u (N, n_u) teach.

    Without `with_inputs` the whitening leaves the inputs out, as it must where they are not those of the plant.
    Raises InvalidData for too few samples, and for outputs without noise.
    """
    still = np.flatnonzero(np.ptp(y, axis=0) == 0)
    if len(still):
        raise InvalidData(
            f"healthy: output {still[0] + 1} of the model is constant ({y[0, still[0]]:g}), so that there is no noise to hold a stream "
            "against: leave that output out, or give a record in which its sensor is alive"
        )
    units = Units(y.mean(axis=0), _sizes(y), u.mean(axis=0), _sizes(u))
    outputs, inputs = (y - units.centre) / units.scale, (u - units.input_centre) / units.input_scale
    in_y, in_u = units.scale[:, None], units.input_scale
    inner = StateSpaceModel(model.A, model.B * in_u, model.C / in_y, model.D * in_u / in_y)
    with np.errstate(over="ignore", invalid="ignore"):  # what no float holds is no candidate
        gain, first = _gain(inner, outputs, inputs)
    left = _settled(inner, gain, _observed(inner, gain, outputs, inputs), first)
    e, pushed = left[first:], inputs[first:] if with_inputs else inputs[first:, :0]
    if np.any(e[len(e) // 2 :].std(axis=0) < ROUNDING):
        raise InvalidData(
            "healthy: the model explains an output to rounding, so that there is no noise to hold a stream against: give a record of the "
            "plant, with the noise of its sensors"
        )
    try:
        lags = number_of_lags(e - e.mean(axis=0), pushed - pushed.mean(axis=0))
    except InvalidData:
        raise InvalidData(
            "healthy: an output is an exact combination of others and of their past, so that there is no noise to hold a stream "
            "against: leave that output out"
        ) from None
    count, spent = len(e) - lags, 1 + lags * (e.shape[1] + pushed.shape[1]) + pushed.shape[1]
    if count < FOLDS * (spent + len(e[0]) + 1):
        raise InvalidData(
            f"healthy: got {counted(len(y), 'sample')}, with {count} left for {counted(spent, 'parameter')} an output; at least "
            f"{len(y) - count + FOLDS * (spent + len(e[0]) + 1)} are needed: give a longer record without fault"
        )
    parts = [slice(int(part[0]), int(part[-1]) + 1) for part in np.array_split(np.arange(count), FOLDS)]
    triangles = [stacked_triangle(spent + e.shape[1], map(np.hstack, _rows(e, pushed, lags, part))) for part in parts]
    coefficients, covariance = _regression(triangles, spent, count)
    judged = np.empty((count, e.shape[1]))
    single = np.empty_like(judged)
    for k, part in enumerate(parts):
        known, spread = _regression(triangles[:k] + triangles[k + 1 :], spent, count - (part.stop - part.start))
        forecast = np.vstack([now - X @ known for X, now in _rows(e, pushed, lags, part)])
        judged[part] = scipy.linalg.solve_triangular(np.linalg.cholesky(spread), forecast.T, lower=True).T
        single[part] = forecast / np.sqrt(np.diag(spread))
    whitening = _Whitening(coefficients, covariance, lags, pushed.shape[1])
    form = _joined(inner, gain, whitening, units)
    return Fitted(replace(form, unknown=_moments(inner, gain, whitening, outputs, inputs, left, first + lags)), judged, single)


def _sizes(values: Array) -> Array:
    """Return the standard deviations, one for a channel that never changes."""
    sizes = values.std(axis=0)
    return np.where(sizes > 1e-12 * np.abs(values).max(axis=0, initial=0.0), sizes, 1.0)


def _gain(model: StateSpaceModel, y: Array, u: Array) -> tuple[Array, int]:
    """Return the gain K_o (n, p) of the observer, and the first sample from which its first state is forgotten."""
    n, p = model.n, model.p
    if n == 0:
        return np.zeros((0, p)), 0
    observed = observability_matrix(model.A, model.C, n)
    information = observed.T @ observed
    if not np.all(np.isfinite(information)):
        raise InvalidData(
            f"the model has numbers whose products no float holds (its poles reach {float(np.abs(model.poles[0])):.3g}): is its file "
            "damaged? Identify it again, in other units"
        )
    most = np.linalg.pinv(information, hermitian=True)
    gains = [np.zeros((n, p))] if model.is_stable else []
    for q in CANDIDATES:
        try:
            P = scipy.linalg.solve_discrete_are(model.A.T, model.C.T, q * (most + most.T) / 2, np.eye(p))
        except (np.linalg.LinAlgError, ValueError):
            continue
        gains.append(np.linalg.solve(model.C @ P @ model.C.T + np.eye(p), model.C @ P @ model.A.T).T)
    best = np.inf
    chosen: tuple[Array, int] | None = None
    for gain in gains:
        radius = float(np.abs(np.linalg.eigvals(model.A - gain @ model.C)).max())
        if not radius < 1:
            continue
        first = int(min(np.ceil(np.log(FADED) / np.log(max(radius, 1e-3))), len(y) // 4))
        e = _settled(model, gain, _observed(model, gain, y, u), first)[max(first, len(y) // 4) :]
        size = float(np.linalg.slogdet(np.cov(e.T, ddof=0).reshape(p, p))[1])
        if size < best:
            best, chosen = size, (gain, first)
    if chosen is None:
        raise InvalidData(
            f"the model has a mode of modulus {float(np.abs(model.poles[0])):.6g} that its outputs do not show, and which no observer can "
            "follow: identify a model of lower order"
        )
    return chosen


def _observed(model: StateSpaceModel, gain: Array, y: Array, u: Array) -> Array:
    """Return e_o (N, p) of the observer, from the state zero."""
    closed = StateSpaceModel(
        model.A - gain @ model.C,
        np.hstack([model.B - gain @ model.D, gain]),
        -model.C,
        np.hstack([-model.D, np.eye(model.p)]),
    )
    return closed.simulate(np.hstack([u, y]))


def _settled(model: StateSpaceModel, gain: Array, e: Array, first: int) -> Array:
    """Return e_o (N, p) without the response to the first state, which is fitted to the samples that it lasts by least squares."""
    if model.n == 0:
        return e
    span = min(len(e), 4 * first + model.n + 1)
    closed = StateSpaceModel(model.A - gain @ model.C, np.zeros((model.n, 1)), -model.C, np.zeros((model.p, 1)))
    free = np.stack([closed.simulate(np.zeros((span, 1)), x0) for x0 in np.eye(model.n)], axis=2)
    level = np.tile(np.eye(model.p), (span, 1))  # the means of a record with a transient are not those of the plant at rest
    start = np.linalg.lstsq(np.hstack([free.reshape(-1, model.n), level]), e[:span].ravel(), rcond=None)[0][: model.n]
    settled = e.copy()
    settled[:span] -= free @ start
    return settled


def _rows(e: Array, pushed: Array, lags: int, part: slice) -> Iterator[tuple[Array, Array]]:
    """Yield [1 e(k-1) u(k-1) .. e(k-lags) u(k-lags) u(k)] and e(k) for k - lags in the part, in stretches of bounded length."""
    seen = slice(part.start, part.stop + lags)
    for past, now in lagged_stretches(e[seen], pushed[seen], lags):
        yield np.hstack([np.ones((len(now), 1)), past]), now


def _regression(triangles: Sequence[Array], spent: int, count: int) -> tuple[Array, Array]:
    """Return coefficients (q, p), and the covariance (p, p) that a forecast's error has on average, the error of the coefficients in it.

    The triangles are of `count` rows together, `spent` columns of regressors and then those of what is explained.
    """
    whole = stacked_triangle(triangles[0].shape[1], triangles)
    X, now = whole[:, :spent], whole[:, spent:]
    coefficients = np.linalg.lstsq(X, now, rcond=None)[0]
    e = now - X @ coefficients
    return np.asarray(coefficients), np.asarray(e.T @ e / (count - spent) * (1 + spent / count))


def _joined(model: StateSpaceModel, gain: Array, whitening: _Whitening, units: Units) -> Form:
    """Return the form whose states are [x, e_o(k-1), .., e_o(k-lags), u(k-1), .., u(k-lags)], as if these were known."""
    n, p, n_u, lags, pushed = model.n, model.p, model.n_u, whitening.lags, whitening.pushed
    width, coefficients = p + pushed, whitening.coefficients
    steps = coefficients[1 : 1 + lags * width].T.reshape(p, lags, width)
    of_errors, of_inputs = steps[:, :, :p].reshape(p, -1), steps[:, :, p:].reshape(p, -1)
    present = np.zeros((p, n_u))
    present[:, :pushed] = coefficients[1 + lags * width :].T
    size, errors = n + lags * width, n + lags * p
    into = np.zeros((size, p))  # what e_o does to the next states
    into[:n] = gain
    A, B = np.zeros((size, size)), np.zeros((size, n_u))
    A[:n, :n], B[:n] = model.A, model.B
    if lags:
        into[n : n + p] = np.eye(p)
        A[n + p : errors, n : errors - p] = np.eye((lags - 1) * p)
        A[errors + pushed :, errors : size - pushed] = np.eye((lags - 1) * pushed)
        B[errors : errors + pushed, :pushed] = np.eye(pushed)
    recalled = np.hstack([np.zeros((p, n)), of_errors, of_inputs])
    return Form(
        A=A + into @ recalled,
        B=B + into @ present,
        C=np.hstack([model.C, of_errors, of_inputs]),
        D=model.D + present,
        K=into,
        push=into @ coefficients[0],
        level=coefficients[0],
        covariance=whitening.covariance,
        unknown=np.zeros((size, size)),
        units=units,
        lags=lags,
        parameters=len(coefficients),
    )


def _moments(model: StateSpaceModel, gain: Array, whitening: _Whitening, y: Array, u: Array, e: Array, first: int) -> Array:
    """Return the second moments (d, d) of the states of the form on the healthy record, about the state zero in which a run begins."""
    watched = StateSpaceModel(
        model.A - gain @ model.C,
        np.hstack([model.B - gain @ model.D, gain]),
        np.eye(model.n),
        np.zeros((model.n, model.n_u + model.p)),
    )
    x = watched.simulate(np.hstack([u, y]))[first:] if model.n else np.zeros((len(y) - first, 0))
    lags = range(1, whitening.lags + 1)
    past = [signal[first - j : len(y) - j] for signal in (e, u[:, : whitening.pushed]) for j in lags]
    states = np.hstack([x, *past])
    return np.asarray(states.T @ states / len(states))


class Predictor:
    """The Kalman filter of a form [AM79]: it gives the innovations of samples y (p,) and u (n_u,), in the units of the data.

    The state is known up to a covariance P, at first that of the healthy record ten times as wide. An innovation then has the covariance
    S + C P C', and the gain is the optimal one; an output that is missing (NaN) or wild is left out of it. P fades as samples come, and
    where it is nothing the filter is the predictor x+ = A x + B u + K e. `state` (d,) and `root`, the root of P (d, any) or None where the
    state is known, are all that it remembers.

    Over a gap an unstable mode of modulus a makes P grow by a^2 a sample. Its root is what is held, and one orthogonal triangle takes the
    step [AM79], so that no difference of large numbers is formed and rounding costs as many digits as the root has grown by. Where half of
    all digits are gone (GROWN) the state is unknown as at the start, and `begun_anew` says so of the last step.
    """

    def __init__(self, form: Form) -> None:
        self.form = form
        self._root = np.linalg.cholesky(form.covariance)
        self._inverse = scipy.linalg.solve_triangular(self._root, np.eye(form.p), lower=True)
        self._sizes = np.sqrt(np.diag(form.covariance))
        self._wild = WILD * self._sizes
        values, vectors = np.linalg.eigh(ELSEWHERE**2 * form.unknown)
        self._start = vectors * np.sqrt(np.maximum(values, 0.0))
        self._most = GROWN * np.maximum(_lengths(self._start), _lengths(form.K @ self._root))
        self.begun_anew = False
        self.restart()

    def restart(self) -> None:
        """Forget the state."""
        self.state = np.zeros(len(self.form.A))
        self.root: Array | None = self._start

    def step(self, y: Array, u: Array) -> tuple[Array, Array] | None:
        """Return the innovation (p,) of one sample, uncorrelated and of deviation one, and output by output over its deviation.

        Zero stands for an output that is missing. None is returned where all are, and where an input is missing: no output of the sample
        can be judged then, and the state is unknown again.
        """
        form, units = self.form, self.form.units
        self.begun_anew = False
        with np.errstate(over="ignore", invalid="ignore"):
            pushed, there = (u - units.input_centre) / units.input_scale, np.isfinite(y)
            if not (np.abs(pushed) < WILD**2).all():  # NaN is not, either
                self.restart()
                return None
            forecast = form.C @ self.state + form.D @ pushed + form.level
            e = np.where(there, (np.where(there, y, 0.0) - units.centre) / units.scale - forecast, 0.0)
            after = form.A @ self.state + form.B @ pushed + form.push
            if self.root is None and there.all() and (np.abs(e) <= self._wild).all():
                self.state = after + form.K @ e
                return self._inverse @ e, e / self._sizes
            return self._filtered(e, there, after)

    def _filtered(self, e: Array, there: NDArray[np.bool_], after: Array) -> tuple[Array, Array] | None:
        """Take the step with a state that is not known, or with outputs missing or wild; `after` is the next one by the forecast alone."""
        form, noise = self.form, self._root
        root = np.zeros((len(form.A), 0)) if self.root is None else self.root
        if not there.any():
            self._keep(after, _lower(np.hstack([form.K @ noise, form.A @ root])))
            return None
        outputs = np.hstack([noise, form.C @ root])  # times its transpose it is the covariance of e
        sizes = _lengths(outputs)
        # What is wild tells nothing of the state: an unstable model that follows it, cut off as it is, never comes back.
        used = there & (np.abs(e) <= WILD * sizes)
        e = np.clip(e, -WILD * sizes, WILD * sizes)
        order, seen, p = np.argsort(~used, kind="stable"), int(np.sum(used)), form.p
        triangle = _lower(np.vstack([outputs[order], np.hstack([form.K @ noise, form.A @ root])]))
        white = _solved(triangle[:seen, :seen], e[used])
        expected = np.where(there, e, 0.0)
        expected[~there] = (triangle[:p, :seen] @ white)[~there[order]]
        self._keep(after + triangle[p:, :seen] @ white, triangle[p:, seen:])
        if seen < p:  # else the triangle is that of all outputs in their order
            white = _solved(_lower(outputs), expected)
        return white, e / sizes

    def _keep(self, state: Array, root: Array) -> None:
        """Take the state, known up to the root, unless it is as unknown as at the start."""
        reach = _lengths(root)
        self.state, self.root = state, None if np.max(reach, initial=0.0) ** 2 < KNOWN else root
        if not (np.all(reach <= self._most) and np.all(np.isfinite(state))):  # NaN is not, either
            self.begun_anew = True
            self.restart()


def _solved(triangle: Array, values: Array) -> Array:
    """Return the lower triangle's solution; what is no finite number there is seen in the state."""
    return np.asarray(scipy.linalg.solve_triangular(triangle, values, lower=True, check_finite=False))


def _lower(wide: Array) -> Array:
    """Return the lower triangle T with T T' = wide wide' and no negative number on its diagonal."""
    upper = np.asarray(np.linalg.qr(wide.T, mode="r"))
    return np.asarray((upper * np.where(np.diag(upper) < 0, -1.0, 1.0)[:, None]).T)


def _lengths(rows: Array) -> Array:
    """Return the lengths of the rows."""
    return np.asarray(np.sqrt(np.sum(rows * rows, axis=1)))
