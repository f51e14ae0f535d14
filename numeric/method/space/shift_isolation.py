"""Which single sensor or actuator explains a shift of the mean of a residual: the fault that is a step or a constant, and has no rank.

A bias a of sensor j moves the steady mean of the residual by a e_j, a constant offset a of actuator j by a G(1)_j, column j of the static
gain G(1) = C (I - A)^-1 B + D. A shift says nothing of the size a, so that the direction alone tells causes apart, and with one output
there is none.

isolate_shift     the answer for a shift, its covariance and the model that the residual is of
stays             whether a shift is the same earlier and later
positive_definite   whether a covariance is one
gain_errors       the errors of the static gain of an identified model
ShiftIsolation    it, with a row for each sensor and each input
ShiftCause        one row

    d, V      the shift (p,) and its covariance, estimated with so many degrees of freedom B where it is of `mean_shift`
    c, S      the direction of a cause and the covariance of its errors: zero for a sensor, of an actuator that of G(1)_j by the standard
              errors of the model (delta method, [L99])
    T         min over a of (d - a c)' (V + a^2 S)^-1 (d - a c), the likelihood ratio of a collinear pair d, c [MN89]; a is on a grid of
              angles, then polished. Where S = 0 it is (N' d)' (N' V N)^-1 N' d with N across c
    chance    T is Hotelling's statistic of p - 1 outputs with B degrees of freedom [H31], chi-squared where V is known; V + a^2 S has more
              than B, so that the chance of an actuator is a little too large, and it is excluded a little too late
    bound     the angle between d and a c in the metric of V, which no units change, stays below it with probability 0.95 at least
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy  # its folders are loaded when they are first used
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData, shorten
from ....base.sheets import counted
from ....base.threads import one_thread
from ...data.plain import by_name, plain
from ..model.models import StateSpaceModel
from ..model.residuals import HasModel
from ..plotting import plot_chances
from .isolation import CONSISTENT, EXCLUDED, RANK, WIDE, SingleCause, SingleCauses, channels, words_of_one

ANGLES = 720  # of the grid on which the least statistic is looked for
NO_GAIN = "the model has a pole on the unit circle or outside, as far as its standard errors tell: an offset has no steady response"
UNSTEADY = "nothing shows that the shift stays what it is, so that the static gain does not tell what an actuator does"
NO_ERRORS = "the model is of PI-MOESP, which does not tell how sure it is, so that nothing is known of how sure its static gain is"


@dataclass(frozen=True)
class ShiftCause(SingleCause):
    """One single cause: `size` is the bias in units of that output, or the offset in units of that input, which explains the shift best,
    and `deviation` its standard deviation; the angle is that between the shift and what the cause makes, in the metric of the noise."""

    size: float | None
    deviation: float | None

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict, the bound in degrees."""
        bound = None if self.bound is None else plain(np.degrees(self.bound))
        return by_name(self, "kind", "channel", "size", "deviation", "p_value", "answer") | {"bound_degrees": bound}


@dataclass(frozen=True, repr=False)
class ShiftIsolation(SingleCauses[ShiftCause]):
    """Which single sensors and actuators explain a shift of the mean of a residual.

    causes     a row for each sensor, in the order of the outputs, then for each actuator, in the order of the inputs
    answer     the whole in plain words
    reason     why nothing can be said, where that is so; else empty
    actuators  why nothing can be said of actuators, where that is so; else empty
    samples    (start, stop): the samples start .. stop - 1 whose mean has moved, where `identify` chose them
    against    (start, stop): those that their mean is held against

    Raises nothing itself; `isolate_shift`, which makes it, raises InvalidData. Source: [H31], [MN89].

    >>> from faultspace.numeric import StateSpaceModel, isolate_shift
    >>> model = StateSpaceModel([[0.5]], [[1.0]], [[1.0], [1.0]], [[0.0], [0.0]])
    >>> isolate_shift([0.0, 1.0], [[0.01, 0.0], [0.0, 0.01]], model)
    <ShiftIsolation: a sensor fault on y2 explains the shift, and no other single sensor or ..>
    """

    actuators: str
    samples: tuple[int, int] | None = None
    against: tuple[int, int] | None = None

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield the answer and a line for each cause."""
        yield "answer", self.answer
        for cause in self.causes:
            size = "" if cause.size is None else f": size {cause.size:.4g} +- {cause.deviation:.2g}"
            chance = "" if cause.p_value is None else f", p {cause.p_value:.2g}"
            yield cause.name, f"{cause.answer}{size}{chance}"

    def plot(self, ax: Any = None) -> Any:
        """Draw the chances as bars into the matplotlib axes `ax`, new ones where None are given, and return them; causes of which nothing
        could be computed are left out. Raises ImportError without matplotlib."""
        rows = [(f"{cause.kind} {cause.channel}", cause.p_value, cause.answer) for cause in self.causes if cause.p_value is not None]
        return plot_chances(rows, (EXCLUDED, CONSISTENT), ax=ax)

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict, bounds in degrees."""
        return by_name(self, "answer", "reason", "actuators", "samples", "against", "causes")


@dataclass(frozen=True)
class _Law:
    """The law of a statistic T: Hotelling's of `freedom` degrees, chi-squared where that is None."""

    freedom: int | None

    def chance(self, statistic: float, width: int) -> float:
        """Return the chance of more than the statistic, of a vector of this width."""
        if self.freedom is None:
            return float(scipy.special.chdtrc(width, statistic))
        under = self.freedom - width + 1
        return float(scipy.special.fdtrc(width, under, statistic * under / (self.freedom * width)))

    def quantile(self, width: int) -> float:
        """Return what the statistic stays below with probability 0.95."""
        if self.freedom is None:
            return float(scipy.special.chdtri(width, 0.05))
        under = self.freedom - width + 1
        return float(scipy.special.fdtri(width, under, 0.95)) * self.freedom * width / under


@one_thread()
def isolate_shift(
    shift: ArrayLike,
    covariance: ArrayLike,
    model: StateSpaceModel | HasModel,
    *,
    freedom: int | None = None,
    steady: bool = True,
    varying: ArrayLike | None = None,
    outputs: Sequence[str] | None = None,
    inputs: Sequence[str] | None = None,
) -> ShiftIsolation:
    """Say which single sensors and actuators explain a shift of the mean of a residual.

    A cause is "excluded" where its probability is below 0.01, "consistent" where it is 0.05 or more and the bound is below half a radian,
    and else "undecided". Of one output all are undecided, and so they are where the shift itself is not beyond chance. Source: [H31],
    [MN89].

    Parameters
    ----------
    shift : array_like, (p,)
        By what the mean has moved, in units of y.
    covariance : array_like, (p, p)
        Of its errors: the noise at frequency zero and the error of the model times the change of the mean of u, as `MeanShift` has it.
    model : ReducedModel or StateSpaceModel
        The static gain has the standard errors of a ReducedModel; A, B, C, D of a StateSpaceModel, of the shapes (n, n), (n, n_u), (p, n),
        (p, n_u), are taken as right.
    freedom : int, optional
        Degrees of freedom of the covariance; None where it is known.
    steady : bool
        Whether the fault stays what it is and its onset has died out: else nothing is said of actuators, whose response is then more than
        the static gain.
    varying : array_like (p, p), optional
        Covariance of the mean by the residual's own variation while the fault acts, where it is estimated: of a fault that varies the mean
        is chance, within such errors, and of one in an actuator the static gain does not tell it.
    outputs, inputs : list of str, optional
        Names of the channels, by default y1, .., u1, ..

    Returns
    -------
    ShiftIsolation
        A row for each sensor and input.

    Raises
    ------
    InvalidData
        Shapes, names and covariances that cannot be.

    Examples
    --------
    >>> from faultspace.numeric import StateSpaceModel, isolate_shift
    >>> model = StateSpaceModel([[0.5]], [[1.0]], [[1.0], [1.0]], [[0.0], [0.0]])
    >>> isolate_shift([1.1, 0.9], [[0.01, 0.0], [0.0, 0.01]], model).answer
    'an actuator fault on u1 explains the shift, and no other single sensor or actuator does'
    """
    matrices: Any = getattr(model, "model", model)
    p, n_u = matrices.D.shape
    d, V = _checked(shift, covariance, p)
    if freedom is not None and not freedom >= p:
        wanted = "at least as many are needed, or None where it is known"
        raise InvalidData(f"freedom: got {shorten(freedom)} for {counted(p, 'output')}; {wanted}")
    names = channels(outputs, inputs, p, n_u)
    law = _Law(freedom)
    whiten = np.linalg.inv(np.linalg.cholesky(V))
    wide = whiten if varying is None else np.linalg.inv(np.linalg.cholesky(V + _checked(shift, varying, p)[1]))
    reason, by_itself = (_refusal(law.chance(float(np.sum((metric @ d) ** 2)), p), p) for metric in (whiten, wide))
    if by_itself and not reason:
        reason = (
            f"{by_itself} beside what the residual varies by while the fault acts: a fault that is no constant has such a mean by chance"
        )
    uncertainty = getattr(model, "uncertainty", None)
    actuators = "" if not n_u else NO_ERRORS if matrices is not model and uncertainty is None else _unsteady(matrices, uncertainty, steady)
    causes = [_cause("sensor", names[0][j], d, np.eye(p)[j], np.zeros((0, p)), whiten, law, silent=bool(reason)) for j in range(p)]
    if actuators:
        causes += [ShiftCause("actuator", name, None, None, "undecided", None, None) for name in names[1]]
    else:
        gain, errors = _static_gain(matrices, None if uncertainty is None else uncertainty.root)
        for j, name in enumerate(names[1]):
            causes.append(_cause("actuator", name, d, gain[:, j], errors[:, :, j], wide, law, silent=bool(reason)))
    finding = reason or words_of_one(causes, "the shift", f" ({actuators})" if actuators else "")
    return ShiftIsolation(tuple(causes), finding, reason, actuators)


def stays(earlier: Array, later: Array, covariance: Array, freedom: int | None) -> bool:
    """Say whether two shifts (p,), whose difference has this covariance (p, p), differ by no more than chance at level EXCLUDED."""
    gap = later - earlier
    return _Law(freedom).chance(float(gap @ np.linalg.solve(covariance, gap)), len(gap)) >= EXCLUDED


def positive_definite(V: Array) -> bool:
    """Say whether a covariance (p, p) is more than rounding in every direction, whatever the units."""
    sizes = np.sqrt(np.maximum(np.diag(V), 0.0))
    return bool(np.all(sizes > 0) and np.linalg.eigvalsh(V / np.outer(sizes, sizes))[0] > len(V) * np.finfo(np.float64).eps)


def gain_errors(model: StateSpaceModel | HasModel | None) -> Array | None:
    """Return the errors (K, p, n_u) of the static gain of an identified model, whose sum of squares over K is their variance: what it makes
    of inputs whose mean moves by m is wrong by errors @ m. None where the model has no standard errors, or no static gain."""
    uncertainty = getattr(model, "uncertainty", None)
    if uncertainty is None or _unsteady(uncertainty.model, uncertainty, steady=True):
        return None
    return _static_gain(uncertainty.model, uncertainty.root)[1]


def _checked(shift: ArrayLike, covariance: ArrayLike, p: int) -> tuple[Array, Array]:
    """Return shift (p,) and covariance (p, p). Raises InvalidData for what is none."""
    d, V = np.asarray(shift, dtype=np.float64), np.asarray(covariance, dtype=np.float64)
    if d.shape != (p,) or V.shape != (p, p):
        raise InvalidData(f"shift, covariance: got shapes {d.shape} and {V.shape}; needed ({p},) and ({p}, {p}) for {counted(p, 'output')}")
    if not (np.all(np.isfinite(d)) and np.all(np.isfinite(V))):
        raise InvalidData("shift, covariance: got entries that are NaN or infinite; finite ones are needed")
    if not positive_definite(V):
        raise InvalidData("covariance: a positive definite matrix is needed; leave out outputs that are exact combinations of others")
    return d, (V + V.T) / 2


def _refusal(chance: float, p: int) -> str:
    """Return why nothing can be said of any cause; an empty string where something can."""
    if p == 1:
        return "with one output every sensor and every actuator explains any shift, so that they are never to be told apart by it"
    if chance >= EXCLUDED:
        return f"the shift is not beyond chance (probability {chance:.2g})"
    return ""


def _unsteady(matrices: StateSpaceModel, uncertainty: Any, steady: bool) -> str:
    """Return why the static gain says nothing of actuators; an empty string where it does."""
    poles = np.linalg.eigvals(matrices.A) if uncertainty is None else uncertainty.model.poles
    deviations = np.zeros(len(poles)) if uncertainty is None else np.abs(uncertainty.poles())
    reach = float(scipy.special.ndtri(1 - EXCLUDED / 2))
    if np.any(1.0 - np.abs(poles) <= np.maximum(reach * deviations, RANK)):
        return NO_GAIN
    return "" if steady else UNSTEADY


def _static_gain(matrices: StateSpaceModel, root: Array | None) -> tuple[Array, Array]:
    """Return G(1) (p, n_u) and its errors (K, p, n_u), as linear maps of the numbers of the model's root: dG(1) = L dT X with L and X of
    `invariants.py` at z = 1."""
    (p, n), n_u = matrices.C.shape, matrices.B.shape[1]
    rest = np.eye(n) - matrices.A
    X = np.vstack([np.linalg.solve(rest, matrices.B), np.eye(n_u)])
    L = np.hstack([np.linalg.solve(rest.T, matrices.C.T).T, np.eye(p)])
    gain = matrices.C @ X[:n] + matrices.D
    if root is None:
        return gain, np.zeros((0, p, n_u))
    return gain, L @ root.T.reshape(root.shape[1], n + p, n + n_u) @ X


def _cause(kind: str, channel: str, d: Array, column: Array, errors: Array, whiten: Array, law: _Law, *, silent: bool) -> ShiftCause:
    """Return what is to say of one direction (p,) with these errors (K, p)."""
    size = float(np.linalg.norm(whiten @ column))
    if silent or size == 0.0:
        return ShiftCause(kind, channel, None, None, "undecided", None, None)
    # In the metric of V, turned so that the errors of c are independent; c has unit length, which keeps scales out of the search.
    moved = errors @ whiten.T / size
    variances, turn = np.linalg.eigh(moved.T @ moved)
    variances = np.maximum(variances, 0.0)
    seen, aim = turn.T @ whiten @ d, turn.T @ whiten @ column / size
    a = _best(seen, aim, variances)
    precise = 1.0 + a * a * variances
    statistic = float(np.sum((seen - a * aim) ** 2 / precise))
    width = len(d) - 1
    chance = law.chance(statistic, width)
    bound = float(np.arctan(np.sqrt(precise.max() * law.quantile(width)) / np.linalg.norm(seen)))
    answer = "excluded" if chance < EXCLUDED else "consistent" if chance >= CONSISTENT and bound <= WIDE else "undecided"
    deviation = float(1 / np.sqrt(np.sum(aim**2 / precise)))
    return ShiftCause(kind, channel, bound, chance, answer, a / size, deviation / size)


def _best(d: Array, c: Array, variances: Array) -> float:
    """Return the a that makes sum (d - a c)^2 / (1 + a^2 variances) least, for c of unit length."""
    if not np.any(variances > 0):
        return float(c @ d)
    scale = float(np.linalg.norm(d))

    def statistic(angle: Any) -> Any:
        a = scale * np.tan(np.atleast_1d(angle))[:, None]
        return np.sum((d - a * c) ** 2 / (1.0 + a * a * variances), axis=1)

    angles = np.pi * ((np.arange(ANGLES) + 0.5) / ANGLES - 0.5)
    near, step = angles[int(np.argmin(statistic(angles)))], np.pi / ANGLES
    found = scipy.optimize.minimize_scalar(
        lambda angle: float(statistic(angle)[0]), bounds=(near - step, near + step), method="bounded", options={"xatol": 1e-12}
    )
    return float(scale * np.tan(found.x))
