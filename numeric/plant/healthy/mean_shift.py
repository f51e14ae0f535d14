"""This tells whether the mean of a residual has moved since a healthy record: the constant fault, which no rank can show.

A constant signal is persistently exciting of order one only, so that a constant fault changes no rank gap. It moves the mean of r, and a
healthy record says what means are worth: how much noise there is at frequency zero, and how much of a mean the model's error explains.

    predictor     e(k) = r(k) - c - sum_j A_j r(k-j) - sum_j B_j u(k-j), least squares on the healthy record [lags: `healthy_model.py`]
    shift         d of the mean of r: the mean of e over the part tested is (I - sum A_j) d plus chance, where d stays what it is
    chance        of covariance W h. W: long-run covariance of e, from the first B cosine transforms of the healthy e, each an independent
                  vector of covariance W where the spectrum is flat so near to zero [LLSW18]; prewhitening by the predictor makes it flat
                  [AM92], and B is theirs, .41 K^(2/3). h = 1/M + x' (X0' X0)^-1 x: M samples tested, the second term the error of the
                  coefficients [C60], x the mean of the regressors that is expected without a shift, so that h does not grow with d
    test          T^2 = mean(e)' W^-1 mean(e) / h, and T^2 (B - p + 1) / (B p) has Fisher's law with p and B - p + 1 degrees of freedom
                  [H31]: exact for Gaussian e that is flat near zero, and given h; `benchmarks/identify_healthy.py` measures the level
    power         the same with noncentrality d' V^-1 d: from it the shift of one output alone that is found with the stated chance
    estimate      of d: the mean of r itself less the one expected, (I - sum A_j)^-1 (mean(e) + P). P = sum_i a_i (r(s-i) - r(t-i)) / M
                  is what the lags have before the first sample s and miss before the end t, a_i = sum_(j>=i) A_j: without it a fault
                  that varies, at one sensor, would lean into other outputs
    V             covariance of the estimate, (I - sum A_j)^-1 (W h + 2 a S a' / M^2) (I - sum A_j)^-T, S that of the lags while healthy;
                  the last few e are in P and in mean(e), which is left out: by its order in M it is to W h as the lags are to M

Undecided, with the reason, where the test has no ground: a predictor with a root at one within what a random walk of K samples shows
[F76], for then a mean says nothing; a healthy record whose own halves differ by the same test; more outputs than B.

    MeanReference           what the healthy record teaches
    MeanShift, mean_shift   the test of another part
    mean_about_zero         whether a residual has a mean at all, by its own noise
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy  # its folders are loaded when they are first used; scipy.stats takes longer than most tests, and is not needed
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ...method.model.arx import companion_roots
from ...method.ranks.sample_windows import channel_sizes
from .healthy_model import HEALTHY_LEVEL, lagged, number_of_lags, residual_and_inputs

ROUNDING = float(np.finfo(np.float64).eps)
POWER = 0.9
"""This is the chance with which a fault of the reported size is found."""
COSINES = 0.41
"""The test takes B = COSINES K^(2/3) cosine transforms [LLSW18]."""
UNIT_ROOT = 20.7
"""K (1 - root) of a random walk of K samples, its mean fitted, stays below this with probability .99 [F76, table 8.5.1]."""


@dataclass(frozen=True, eq=False)
class MeanReference:
    """What the healthy record says about the mean of a residual.

    `coefficients` (1 + q, p), that of the constant first, belong to the predictor with `lags` lags, of r in units of `scales` (p,) and u in
    those of `input_scales` (n_u,). `root` satisfies root' root = (X0' X0)^-1, `still` (p, p) is I - sum A_j, `long_run` (p, p) is the
    covariance W of `freedom` B, `nearest` is the least |1 - root| of the predictor, and `samples` is K. `ends` (p, lags p) are the a_i side
    by side, and `past` (lags p, lags p) is S.
    """

    scales: Array
    input_scales: Array
    lags: int
    coefficients: Array
    root: Array
    still: Array
    long_run: Array
    freedom: int
    nearest: float
    samples: int
    ends: Array
    past: Array

    @property
    def p(self) -> int:
        """Return the number of outputs."""
        return len(self.scales)

    @property
    def law(self) -> tuple[int, int]:
        """Return the degrees of freedom of Fisher's law."""
        return self.p, self.freedom - self.p + 1

    def threshold(self, level: float) -> float:
        """Return what T^2 exceeds by chance with probability `level`."""
        over, under = self.law
        return float(scipy.special.fdtri(over, under, 1 - level)) * self.freedom * self.p / under

    def noncentrality(self, level: float, power: float) -> float:
        """Return d' V^-1 d of a shift d that the test finds with chance `power`."""
        over, under = self.law
        bound = float(scipy.special.fdtri(over, under, 1 - level))
        most = 1.0
        while scipy.special.ncfdtr(over, under, most, bound) > 1 - power:
            most *= 2.0
        return float(scipy.optimize.brentq(lambda size: 1 - power - scipy.special.ncfdtr(over, under, size, bound), 1e-9, most))


@dataclass(frozen=True, eq=False)
class MeanShift:
    """The verdict on the mean of a residual, with its evidence.

    `shifted` is None where it is undecided, and `reason` says why. `shift` (p,) is the estimate in units of r, and `deviations` (p,) are
    its standard deviations. `channels` numbers the outputs whose own shift is beyond chance. `statistic` is T^2, held against `threshold`
    at `level`. `visible` (p,) is the shift of one output alone that would be found with chance POWER. `covariance` (p, p) is that of the
    shift, estimated with `freedom` degrees of freedom. Arrays are None where nothing could be estimated.
    """

    shifted: bool | None
    reason: str
    level: float
    shift: Array | None = None
    deviations: Array | None = None
    visible: Array | None = None
    channels: tuple[int, ...] = ()
    statistic: float | None = None
    threshold: float | None = None
    covariance: Array | None = None
    freedom: int | None = None


def _learnt(r: Array, inputs: Array) -> MeanReference:
    """Learn from a healthy residual (N, p) and its inputs (N, n_u). Raises InvalidData for channels that are constant or exact combinations
    of others, and too few samples for the channels."""
    scales, input_scales = channel_sizes(r - r.mean(axis=0)), _sizes(inputs)
    r, inputs = r / scales, inputs / input_scales
    K, p = r.shape
    lags = number_of_lags(r - r.mean(axis=0), inputs - inputs.mean(axis=0))
    X, now = _regressors(r, inputs, lags)
    freedom = int(COSINES * len(now) ** (2 / 3))
    if freedom < p + 2 or len(now) <= X.shape[1] + freedom:
        raise InvalidData(
            f"{counted(K, 'sample')} without fault {'is' if K == 1 else 'are'} too few to say what the "
            f"means of {counted(p, 'output')} are worth: state more of them"
        )
    factor, triangle = np.linalg.qr(X)
    if np.linalg.cond(triangle) * ROUNDING >= 1.0:
        raise InvalidData(
            "channels are combinations of others and of their past up to rounding, so that there is no noise to compare "
            "with: leave such out"
        )
    root = np.asarray(np.linalg.inv(triangle)).T
    coefficients = root.T @ (factor.T @ now)
    e = now - X @ coefficients
    # What the coefficients took out of e is put back on average.
    waves = np.asarray(scipy.fft.dct(e, type=2, axis=0, norm="ortho"))[1 : freedom + 1] / np.sqrt(1.0 - X.shape[1] / len(now))
    width = p + inputs.shape[1]
    steps = [coefficients[1 + j * width : 1 + j * width + p].T for j in range(lags)]
    still = np.eye(p) - sum(steps, np.zeros((p, p)))
    if np.linalg.cond(still) * ROUNDING >= 1.0:
        raise InvalidData(
            "channels are nearly combinations of others and of their past, or wander like random walks, so that means say "
            "nothing: leave such out"
        )
    of_r = X[:, [1 + j * width + i for j in range(lags) for i in range(p)]]
    of_r = of_r - of_r.mean(axis=0)
    return MeanReference(
        scales=scales,
        input_scales=input_scales,
        lags=lags,
        coefficients=coefficients,
        root=root,
        still=still,
        long_run=waves.T @ waves / freedom,
        freedom=freedom,
        nearest=nearest_root(steps),
        samples=len(now),
        ends=np.hstack([sum(steps[i:], np.zeros((p, p))) for i in range(lags)] or [np.zeros((p, 0))]),
        past=of_r.T @ of_r / len(of_r),
    )


def mean_shift(
    r: ArrayLike,
    u: ArrayLike | None,
    healthy: ArrayLike,
    healthy_u: ArrayLike | None,
    *,
    level: float = HEALTHY_LEVEL,
    gain_errors: ArrayLike | None = None,
) -> MeanShift:
    """Test whether the mean of r (M, p), with inputs u (M, n_u), has left that of the healthy residual (K, p) with its inputs.

    `gain_errors` (k, p, n_u) are those of the static gain of the model, as `method/space/shift_isolation.py` has them, None where nothing
    is known of it. `level` (0, 1): probability of finding a shift where there is none. What the healthy record cannot bear is an undecided
    answer, never an error. Source: head of the module.
    """
    before, inputs_before = residual_and_inputs(healthy, healthy_u)
    after, inputs = residual_and_inputs(r, u)
    try:
        reference = _learnt(before, inputs_before)
    except InvalidData as error:
        return MeanShift(None, str(error), level)
    if len(after) < reference.lags + 1:
        return MeanShift(
            None, f"there are {counted(len(after), 'sample')}, fewer than the {reference.lags + 1} that the healthy noise remembers", level
        )
    off = None
    if gain_errors is not None and inputs.shape[1]:
        off = np.asarray(gain_errors) @ (inputs.mean(axis=0) - inputs_before.mean(axis=0))
    found = _tested(reference, after, inputs, level, off)
    if reference.nearest * reference.samples < UNIT_ROOT:
        reason = "the healthy residual wanders: its mean says nothing (an integrating plant, a drift, a fault in it?)"
        return MeanShift(None, reason, level, found.shift)
    half = len(before) // 2
    try:
        itself = _tested(_learnt(before[:half], inputs_before[:half]), before[half:], inputs_before[half:], level)
    except InvalidData:
        return found  # halves too short to be held against each other
    if itself.shifted:
        reason = "the mean moves within the healthy samples themselves: a drift, or a fault among them; state fewer, or take the drift out"
        return MeanShift(None, reason, level, found.shift, found.deviations)
    return found


def mean_about_zero(r: ArrayLike, u: ArrayLike | None = None, *, level: float = HEALTHY_LEVEL) -> MeanShift:
    """Test whether r (N, p) with inputs u (N, n_u) needs a constant beside its lags, by its own noise at frequency zero.

    `shift` is then where r rests with the inputs at zero: its mean where there are none. It is undecided as `mean_shift` is. The error of
    the coefficients counts as it does there, with the means that a rest at zero would give.
    """
    residual, inputs = residual_and_inputs(r, u)
    try:
        reference = _learnt(residual, inputs)
    except InvalidData as error:
        return MeanShift(None, str(error), level)
    if reference.nearest * reference.samples < UNIT_ROOT:
        return MeanShift(None, "the residual wanders like a random walk: its mean says nothing", level)
    means = _regressors(residual / reference.scales, inputs / reference.input_scales, reference.lags)[0].mean(axis=0)
    still = means.copy()
    still[0] = 0.0
    h = float(np.sum((reference.root @ (means - _expected(reference, still))) ** 2))
    return _judged(reference, reference.coefficients[0], h, level)


def _tested(reference: MeanReference, r: Array, u: Array, level: float, off: Array | None = None) -> MeanShift:
    """Do the test itself; `off` (k, p) are errors of the model in the mean of r, in its units."""
    scaled = r / reference.scales
    X, now = _regressors(scaled, u / reference.input_scales, reference.lags)
    e = (now - X @ reference.coefficients).mean(axis=0)
    h = 1.0 / len(now) + float(np.sum((reference.root @ _expected(reference, X.mean(axis=0))) ** 2))
    before, last = scaled[: reference.lags][::-1], scaled[len(now) :][::-1]
    return _judged(reference, e, h, level, reference.ends @ (before - last).ravel() / len(now), len(now), off)


def _judged(
    reference: MeanReference, e: Array, h: float, level: float, ends: Array | None = None, samples: int = 1, off: Array | None = None
) -> MeanShift:
    """Return the verdict on the mean e (p,) of what the predictor leaves, of covariance W h where there is no shift; `ends` is P, none
    where the lags miss nothing, of so many samples M; `off` (k, p) are errors of the model in the mean of r."""
    own = reference.long_run * h
    if off is not None:
        wrong = off / reference.scales @ reference.still.T
        own = own + wrong.T @ wrong
    # Fewer faults than outputs and no noise leave directions in which the covariance is rounding.
    sizes = np.linalg.eigvalsh(own)
    if sizes[0] <= reference.p * ROUNDING * sizes[-1]:
        return MeanShift(None, "the residual has directions without noise, in which its mean has no test", level)
    statistic = float(e @ np.linalg.solve(own, e))
    threshold = reference.threshold(level)
    back = np.linalg.inv(reference.still)
    if ends is not None:
        e, own = e + ends, own + 2.0 * reference.ends @ reference.past @ reference.ends.T / samples**2
    sizes, axes = np.linalg.eigh(own)
    sizes = np.maximum(sizes, np.finfo(np.float64).tiny)
    half = back @ axes * np.sqrt(sizes)
    V = half @ half.T
    shift = back @ e * reference.scales
    deviations = np.sqrt(np.diag(V)) * reference.scales
    single = -float(scipy.special.stdtrit(reference.freedom, level / (2 * reference.p)))
    channels = tuple(int(i) for i in np.flatnonzero(np.abs(shift) > single * deviations))
    # The mean of W^-1, a Wishart matrix of freedom B, is B / (B - p - 1) times the true one.
    roots = axes.T @ reference.still / np.sqrt(sizes)[:, None]
    precisions = np.sum(roots**2, axis=0) * (reference.freedom - reference.p - 1) / reference.freedom
    visible = np.sqrt(reference.noncentrality(level, POWER) / precisions) * reference.scales
    shifted = statistic > threshold
    compared = f"T^2 = {statistic:.4g} against {threshold:.4g}, which chance exceeds with probability {level:g}"
    reason = f"the mean has moved: {compared}" if shifted else f"no shift of the mean: {compared}"
    found = channels if shifted else ()
    covariance = V * np.outer(reference.scales, reference.scales)
    return MeanShift(shifted, reason, level, shift, deviations, visible, found, statistic, threshold, covariance, reference.freedom)


def _regressors(r: Array, u: Array, lags: int) -> tuple[Array, Array]:
    """Return [1, r(k-1) u(k-1) .. r(k-lags) u(k-lags) u(k)] and r(k)."""
    past, now = lagged(r, u, lags)
    return np.hstack([np.ones((len(now), 1)), past]), now


def _expected(reference: MeanReference, means: Array) -> Array:
    """Return the means of the regressors with those of r replaced by what the predictor expects without a shift."""
    p, width = reference.p, reference.p + len(reference.input_scales)
    expected = means.copy()
    of_r = [slice(1 + j * width, 1 + j * width + p) for j in range(reference.lags)]
    for place in of_r:
        expected[place] = 0.0
    level = np.linalg.solve(reference.still, expected @ reference.coefficients)
    for place in of_r:
        expected[place] = level
    return expected


def nearest_root(steps: list[Array]) -> float:
    """Return the least |1 - z| over the roots z of the predictor."""
    if not steps:
        return 1.0
    return float(np.abs(1.0 - companion_roots(np.hstack(steps))).min())


def _sizes(u: Array) -> Array:
    """Return the units of the inputs, about their means; one for an input that is still."""
    return channel_sizes(u - u.mean(axis=0)) if u.shape[1] else np.ones(0)
