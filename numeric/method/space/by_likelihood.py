"""This estimates the fault space from a noisy residual, where R_s has full rank and no null row is exact.

    fault_space_by_likelihood      kernel rows by maximum likelihood with noise colour: the better estimator
    fault_space_by_least_squares   null rows by the singular value decomposition, weighted by their uncertainty: no
                                   iteration, white noise
    null_row_covariance            what white noise does to a null row, up to a factor
    P                              orthonormal rows with P O_s = 0, `complement` of `joint_kernel_basis`
    q                              (p - n_v) s - (n - zeta): how many null rows a window has for a given number of zeros
    mix                            n_v + 1 combinations of the outputs, which obey exactly one kernel row, of degree
                                   n - zeta

zeta, the number of zeros, is never taken larger than the observability indices of (A, C) allow (`fault_space_bound`).
It is chosen where a higher degree of the row no longer explains anything (likelihood), or by the largest drop among the
possible ranks (least squares). On data of the paper's kind no rule finds it always, because a system that nearly has a
zero looks like one that has it: `decided` and `margin` tell how clear it was, and `zeta` of the estimate is None where
it was not. The number found, all p - n_v rows are fitted at once (`joint_kernel_basis`), which also tells how far the
space may be off.

What noise it takes. The likelihood form divides each channel by its size and takes the noise to have one colour and the same power in
every divided channel: it is consistent only where the noise has one colour and the same power relative to each channel. Otherwise, as
with sensors of equal absolute noise on channels of different size, it keeps a bias of second order in the noise that more samples do not
take away (`tests/numeric/test_convergence.py` shows both), and the stated angle does not contain it. Least squares takes white noise,
likewise in proportion. Other units of r change nothing: the channels are divided by their sizes all the same.

The constants are judged by `benchmarks/constants.py space` and `squares`, whose rule was fixed before. Of 900 records (seed 700500)
least squares answers 123 rightly and 3 wrongly, and no factor from a half to two is better. The likelihood answers 442 rightly and 4
wrongly of 540 (seeds 700100 and 700600); with QUIET doubled it is 471 and 10, more of either kind, and no other factor is better.

Source: [G25] problem (11); the likelihood of one row is that of `kernel_likelihood`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ..ranks.arguments import Arguments, arguments
from ..ranks.one_row import kernel_row
from ..ranks.rank_gap import fault_dimension
from ..ranks.sample_windows import EPS, ObservedCoordinates, gap_rank, hankel_factor, observed_coordinates
from .estimate import FaultSpaceEstimate, condition_maps, everything, kernel_conditions, orthonormal
from .largest import largest_fault_space
from .space_uncertainty import space_uncertainty
from .start import complement, joint_basis
from .tapered_moments import CrossMoments, tapered_moments

# Nats a sample: what a longer row may gain by absorbing noise colour, what it must gain to be called clearly needed,
# and
# up to where the gains not used are clearly idle.
IDLE, NEEDED, QUIET = 0.1, 0.5, 0.03
# Ratio of singular values below which a rank found in noise is called undecided.
CLEAR_DROP = 14.0
# Windows beyond lag + 1 that least squares uses: shifted copies of the null rows average the noise; many more let it
# in again.
EXTRA_WINDOWS = 3
REWEIGHTINGS = 6
NOISE_TAKEN = "noise taken to have one colour and the same power relative to each channel: a bias stays where it has not"
# Floor of signal over noise power in the uncertainty of null rows, where the estimate of the signal is itself noise.
SIGNAL_FLOOR = 1e-3


def fault_space_by_likelihood(
    r: ArrayLike, A: ArrayLike, C: ArrayLike, *, n_v: int | None = None, block_rows: int | None = None
) -> FaultSpaceEstimate:
    """Estimate the fault space of a noisy residual r (N, p) for A (n, n), C (p, n), from kernel rows of maximum likelihood.

    `n_v` is asked of `fault_dimension` when not given. `block_rows` s is the window the answer is for: rows of
    degree below s are used; by default it is lag + 1. Consistent only for noise of one colour and of the same power
    relative to each channel (head of the module). Raises InvalidData as `fault_space`.
    """
    return likelihood_space(arguments(r, A, C, n_v, block_rows), block_rows)


def likelihood_space(data: Arguments, block_rows: int | None) -> FaultSpaceEstimate:
    """Return the same of arguments that were checked."""
    faults, why = _faults(data)
    if faults is None or faults >= data.p:
        return everything(data.n, data.p, faults, data.block_rows, why)
    coordinates = observed_coordinates(data.r, data.A, data.C, data.n + 1)
    moments = tapered_moments(data.r / coordinates.scale, coordinates.observed)
    fits = [_fit(moments, coordinates, mix) for mix in _mixes(data.p, faults)]
    levels = np.array([sum(fit.levels[degree] for fit in fits) / len(fits) for degree in range(moments.degree + 1)])
    most = largest_fault_space(coordinates.A, coordinates.C, faults)
    degree, margin = _least_degree(levels, len(data.r), data.n + faults - most)
    zeta = data.n - degree
    n_z = faults + zeta
    conditions = np.vstack([kernel_conditions(fit.rows[degree][None], coordinates.A, coordinates.C)[0] for fit in fits])
    basis = joint_basis(moments, coordinates, data.p - faults, degree, _solutions(conditions, n_z)[1], levels[degree])
    if basis is not None:
        conditions = np.vstack([kernel_conditions(row[None], coordinates.A, coordinates.C)[0] for row in basis.rows])
    lag = -(-degree // (data.p - faults)) if basis is None else max(map(len, basis.rows)) - 1
    window = lag + 1 if block_rows is None else data.block_rows
    if window <= lag:
        return everything(data.n, data.p, faults, window, _too_short(data, faults, zeta, lag, window), lag=lag)
    strengths, columns = _solutions(conditions, n_z)
    decided = margin >= 1
    doubt = "" if decided else f"undecided: the number of zeros is a near thing (margin {margin:.2g}, 1 is needed); "
    reason = f"{doubt}n_z = {n_z} = n_v + zeta = {faults} + {zeta}; {why}; {_told_bound(n_z, most)}{NOISE_TAKEN}"
    return FaultSpaceEstimate(
        orthonormal(coordinates.back(columns)),
        n_z,
        data.n,
        faults,
        lag,
        window,
        strengths,
        data.n + data.p - n_z,
        data.n + data.p,
        margin,
        decided,
        True,
        reason,
        None,
        "likelihood",
        None if basis is None else space_uncertainty(basis.rows, basis.within, basis.covariance, coordinates, columns),
    )


def fault_space_by_least_squares(
    r: ArrayLike, A: ArrayLike, C: ArrayLike, *, n_v: int | None = None, block_rows: int | None = None
) -> FaultSpaceEstimate:
    """Estimate the same from the left singular vectors of P R_s, their conditions weighted by the covariance that white noise
    gives them.

    Raises InvalidData as `fault_space`.
    """
    data = arguments(r, A, C, n_v, block_rows)
    faults, why = _faults(data)
    if faults is None or faults >= data.p:
        return everything(data.n, data.p, faults, data.block_rows, why)
    zeta, drop = _zeros_by_rank(data, faults, data.n + 1)
    lag = -(-(data.n - zeta) // (data.p - faults))
    # Not beyond what the record is long enough for.
    window = min(lag + 1 + EXTRA_WINDOWS, (len(data.r) + 1) // (data.p + 1)) if block_rows is None else data.block_rows
    if window <= lag:
        return everything(data.n, data.p, faults, window, _too_short(data, faults, zeta, lag, window), lag=lag)
    n, p, n_z = data.n, data.p, faults + zeta
    coordinates, P, left, values = _null_directions(data, window)
    q = (p - faults) * window - (n - zeta)
    signal = left.shape[1] - q
    rows = left[:, signal:].T @ P
    conditions = kernel_conditions(rows.reshape(q, window, p), coordinates.A, coordinates.C)
    maps = condition_maps(coordinates.A, coordinates.C, window)
    uncertainty = null_row_covariance(P, left, values, signal)
    columns = np.eye(n + p)
    for _ in range(REWEIGHTINGS):
        weighted = _whitened(conditions, maps, uncertainty, columns)
        _, strengths, right = np.linalg.svd(np.linalg.qr(weighted, mode="r"))
        strengths = np.concatenate([strengths, np.zeros(n + p - strengths.size)])
        columns = right[n + p - n_z :].T
    decided = drop >= CLEAR_DROP
    doubt = "" if decided else f"undecided: the rank behind zeta drops by only {drop:.2g}; "
    reason = f"{doubt}n_z = {n_z} = n_v + zeta = {faults} + {zeta}, window {window}; {why}"
    basis = orthonormal(coordinates.back(columns))
    return FaultSpaceEstimate(
        basis,
        n_z,
        n,
        faults,
        lag,
        window,
        strengths,
        n + p - n_z,
        n + p,
        drop,
        decided,
        True,
        reason,
        None,
        "least squares",
    )


def _faults(data: Arguments) -> tuple[int | None, str]:
    """Return the number of faults and where it comes from; None, or p, with the reason why there is no answer."""
    if data.n_v is None:
        found = fault_dimension(data.r)
        if found.n_v is None:
            return (
                None,
                f"the number of faults is undecided ({found.reason}): give n_v; until then any column will do",
            )
        if found.n_v == 0:
            return None, f"no fault was found ({found.reason}), so there is no fault space to speak of"
        faults, source = found.n_v, "n_v from fault_dimension"
    else:
        faults, source = data.n_v, f"n_v as {data.told}"
    if faults >= data.p:
        return (
            faults,
            f"{counted(faults, 'fault')} in {counted(data.p, 'output')} "
            f"{'leaves' if faults == 1 else 'leave'} no relation between the outputs: every column is a solution",
        )
    return faults, source


def _too_short(data: Arguments, faults: int, zeta: int, lag: int, window: int) -> str:
    rows = max((data.p - faults) * window - (data.n - zeta), 0)
    return (
        f"too few equations: with n = {data.n}, p = {data.p}, n_v = {faults} and {counted(zeta, 'zero')} a window of {window} has "
        f"{counted(rows, 'null row')}, "
        f"where a window longer than the lag, {lag}, is needed; take block_rows >= {lag + 1}"
    )


def _mixes(p: int, faults: int) -> list[Array]:
    """Return orthonormal mixes (p, n_v + 1) of the outputs: the identity where that is all of them, else enough general
    ones to see every output.
    """
    if p == faults + 1:
        return [np.eye(p)]
    draw = np.random.default_rng(20)
    return [np.linalg.qr(draw.standard_normal((p, faults + 1)))[0] for _ in range(2 * (p - faults) + 1)]


@dataclass(frozen=True)
class _Course:
    """The course over the degrees 0, 1, ..: the level of the best row of a mix, and the row (degree + 1, p) in all outputs."""

    levels: list[float]
    rows: list[Array]


def _fit(moments: CrossMoments, coordinates: ObservedCoordinates, mix: Array) -> _Course:
    """Fit rows of the degrees 0, 1, .. up to the number of observed states."""
    mixed = moments.mixed(mix).real_parts()
    course = _Course([], [])
    starts: tuple[Array, ...] = ()
    for degree in range(moments.degree + 1):
        P = complement(coordinates.A, mix.T @ coordinates.C, degree + 1)
        if P.shape[0] == 0:
            course.levels.append(np.inf)
            course.rows.append(np.zeros((degree + 1, len(mix))))
            continue
        row = kernel_row(mixed.of_degree(degree), within=P, starts=starts)
        starts = (row.coefficients,)
        course.levels.append(row.level)
        course.rows.append(row.coefficients @ mix.T)
    return course


def _solutions(conditions: Array, n_z: int) -> tuple[Array, Array]:
    """Return singular values (n + p,) of the conditions (.., n + p), and the n_z columns that meet them best."""
    width = conditions.shape[1]
    _, values, right = np.linalg.svd(conditions)
    return np.concatenate([values, np.zeros(width - values.size)]), right[width - n_z :].T


def _told_bound(n_z: int, most: int) -> str:
    return "as many as the observability indices of (A, C) allow; " if n_z == most else ""


def _least_degree(levels: Array, samples: int, least: int) -> tuple[int, float]:
    """Return the least degree, `least` or more, after which no longer row gains more than IDLE nats, and how clear that is (1 or more:
    clear on both sides). `least` is what the observability indices of (A, C) demand: below it there is no alternative that a gain could
    refute.
    """
    idle = max(IDLE, 30 / samples)
    best = np.minimum.accumulate(levels[::-1])[::-1]
    degree = next(d for d in range(least, len(levels)) if np.isfinite(levels[d]) and levels[d] - best[d] <= idle)
    gained = np.inf if degree == least else float(levels[degree - 1] - levels[degree])
    unused = max(float(levels[degree] - best[degree]), QUIET / 1e3)
    return degree, float(min(gained / NEEDED, QUIET / unused))


def _null_directions(data: Arguments, s: int) -> tuple[ObservedCoordinates, Array, Array, Array]:
    coordinates = observed_coordinates(data.r, data.A, data.C, s)
    factor = hankel_factor(data.r / coordinates.scale, s) / np.sqrt(len(data.r))
    P = complement(coordinates.A, coordinates.C, s)
    left, values, _ = np.linalg.svd(P @ factor)
    return coordinates, P, left, np.concatenate([values, np.zeros(P.shape[0] - values.size)])


def _zeros_by_rank(data: Arguments, faults: int, s: int) -> tuple[int, float]:
    """Return zeta by the largest drop among the ranks of P R_s that it allows, and the drop."""
    s = min(s, (len(data.r) + 1) // (data.p + 1))
    coordinates, P, _, values = _null_directions(data, s)
    hidden = data.n - coordinates.observed
    most = largest_fault_space(coordinates.A, coordinates.C, faults) - faults
    ranks = {P.shape[0] - ((data.p - faults) * s - (data.n - zeta)): zeta for zeta in range(hidden, most + 1)}
    possible = [rank for rank in ranks if 0 < rank < P.shape[0]]
    if not possible:
        raise InvalidData(
            f"r has {counted(len(data.r), 'sample')}, too few for a window longer than the lag: record more, or take a model of lower order"
        )
    rank, drop = gap_rank(values, possible, EPS * float(values[0]))
    return ranks[rank], drop


def null_row_covariance(P: Array, left: Array, values: Array, signal: int) -> Array:
    """Return the covariance (p s, p s), up to a factor, of the error that white noise makes in each left singular vector to a
    small value.

    To first order the vector tilts towards signal direction j with variance proportional to lambda_j / (lambda_j -
    noise)^2.
    """
    power = values**2
    noise = float(np.mean(power[signal:])) if signal < power.size else 0.0
    clean = np.maximum(power[:signal] - noise, max(SIGNAL_FLOOR * noise, EPS**2 * float(power[0])))
    tilted = P.T @ left[:, :signal]
    return np.asarray((tilted * (power[:signal] / clean**2)) @ tilted.T)


def _whitened(conditions: Array, maps: Array, uncertainty: Array, columns: Array) -> Array:
    """Return conditions (q, s, n + p) as (q s, n + p), each row's s conditions multiplied so that their errors at `columns`
    are white on average.
    """
    responses = np.einsum("kab,bz->kaz", maps, columns)
    spread = np.einsum("kaz,ac,lcz->kl", responses, uncertainty, responses, optimize=True)
    spread += np.eye(len(spread)) * max(1e-9 * float(np.trace(spread)), np.finfo(float).tiny)
    q, s, width = conditions.shape
    stacked = conditions.transpose(1, 0, 2).reshape(s, q * width)
    white = np.linalg.solve(np.linalg.cholesky(spread), stacked)
    return np.asarray(white.reshape(s * q, width))
