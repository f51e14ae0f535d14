"""The fault space from a noisy residual, where R_s has full rank and no null row is exact.

    fault_space_by_likelihood      kernel rows by maximum likelihood with noise colour: the better estimator
    fault_space_by_least_squares   null rows by the singular value decomposition, weighted by their uncertainty: no
                                   iteration, white noise
    null_row_covariance            what white noise does to a null row, up to a factor
    P                              orthonormal rows with P O_s = 0: a true null row is g P, because A and C are known
    q                              (p - n_v) s - (n - zeta): how many null rows a window has for a given number of zeros
    mix                            n_v + 1 combinations of the outputs, which obey exactly one kernel row, of degree
                                   n - zeta

zeta, the number of zeros, is chosen where a higher degree of the row no longer explains anything (likelihood), or by
the largest drop among the possible ranks (least squares). On data of the paper's kind no rule finds it always:
`decided` and `margin` tell how clear it was. Source: [G25] problem (11); the likelihood is that of `kernel_likelihood`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .fault_dimension import fault_dimension
from .fault_space_estimate import FaultSpaceEstimate, condition_maps, everything, kernel_conditions, orthonormal
from .input_checks import InvalidData
from .kernel_likelihood import kernel_row, window_moments
from .residual_arguments import Arguments, arguments
from .residual_windows import EPS, ObservedCoordinates, gap_rank, hankel_factor, observed_coordinates

Array = NDArray[np.float64]

# Nats a sample: what a longer row may gain by absorbing noise colour, what it must gain to be called clearly needed,
# and
# up to where the gains not used are clearly idle.
IDLE, NEEDED, QUIET = 0.15, 0.5, 0.05
# Ratio of singular values below which a rank found in noise is called undecided.
CLEAR_DROP = 10.0
# Windows beyond lag + 1 that least squares uses: shifted copies of the null rows average the noise; many more let it
# in again.
EXTRA_WINDOWS = 3
REWEIGHTINGS = 3
# Floor of signal over noise power in the uncertainty of null rows, where the estimate of the signal is itself noise.
SIGNAL_FLOOR = 1e-3


def fault_space_by_likelihood(
    r: ArrayLike, A: ArrayLike, C: ArrayLike, *, n_v: int | None = None, block_rows: int | None = None
) -> FaultSpaceEstimate:
    """The fault space of a noisy residual r (N, p) for A (n, n), C (p, n), from kernel rows of maximum likelihood.

    `n_v` is asked of `fault_dimension` when not given. `block_rows` s is the window the answer is for: rows of
    degree below s are used; by default it is lag + 1. Raises InvalidData as `fault_space`.
    """
    data = arguments(r, A, C, n_v, block_rows)
    faults, why = _faults(data)
    if faults is None or faults >= data.p:
        return everything(data.n, data.p, faults, data.block_rows, why)
    coordinates = observed_coordinates(data.r, data.A, data.C, data.n + 1)
    scaled = data.r / coordinates.scale
    fits = [_fit(scaled, coordinates, mix) for mix in _mixes(data.p, faults)]
    highest = coordinates.observed
    levels = np.array([sum(fit[0][degree] for fit in fits) / len(fits) for degree in range(highest + 1)])
    degree, margin = _least_degree(levels, len(data.r))
    zeta = data.n - degree
    lag = -(-degree // (data.p - faults))
    window = lag + 1 if block_rows is None else data.block_rows
    if window <= lag:
        return everything(data.n, data.p, faults, window, _too_short(data, faults, zeta, lag, window), lag=lag)
    conditions = np.vstack([fit[1][degree] for fit in fits])
    n_z = faults + zeta
    _, strengths, right = np.linalg.svd(conditions)
    strengths = np.concatenate([strengths, np.zeros(data.n + data.p - strengths.size)])
    basis = orthonormal(coordinates.back(right[data.n + data.p - n_z :].T))
    decided = margin >= 1
    doubt = "" if decided else f"undecided: the number of zeros is a near thing (margin {margin:.2g}, 1 is needed); "
    reason = f"{doubt}n_z = {n_z} = n_v + zeta = {faults} + {zeta}; {why}"
    return FaultSpaceEstimate(
        basis,
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
    )


def fault_space_by_least_squares(
    r: ArrayLike, A: ArrayLike, C: ArrayLike, *, n_v: int | None = None, block_rows: int | None = None
) -> FaultSpaceEstimate:
    """The same from the left singular vectors of P R_s, their conditions weighted by the covariance that white noise
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
    """The number of faults and where it comes from; None, or p, with the reason why there is no answer."""
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
        faults, source = data.n_v, "n_v as given"
    if faults >= data.p:
        return (
            faults,
            f"{faults} faults in {data.p} outputs leave no relation between the outputs: every column is a solution",
        )
    return faults, source


def _too_short(data: Arguments, faults: int, zeta: int, lag: int, window: int) -> str:
    rows = max((data.p - faults) * window - (data.n - zeta), 0)
    return (
        f"too few equations: with n = {data.n}, p = {data.p}, n_v = {faults} and {zeta} zeros a window of {window} has "
        f"{rows} null rows, "
        f"where a window longer than the lag, {lag}, is needed; take block_rows >= {lag + 1}"
    )


def _mixes(p: int, faults: int) -> list[Array]:
    """Orthonormal mixes (p, n_v + 1) of the outputs: the identity where that is all of them, else enough general
    ones to see every output.
    """
    if p == faults + 1:
        return [np.eye(p)]
    draw = np.random.default_rng(20)
    return [np.linalg.qr(draw.standard_normal((p, faults + 1)))[0] for _ in range(2 * (p - faults) + 1)]


def _fit(scaled: Array, coordinates: ObservedCoordinates, mix: Array) -> tuple[list[float], list[Array]]:
    """For degrees 0, 1, .. up to the number of observed states: the level of the best row of the mix, and its
    conditions (degree + 1, n + p).
    """
    p = len(mix)
    n, highest = coordinates.A.shape[0], coordinates.observed
    moments = window_moments(scaled @ mix, highest)
    levels, conditions = [], []
    starts: tuple[Array, ...] = ()
    for degree in range(highest + 1):
        P = _complement(coordinates.A, mix.T @ coordinates.C, degree + 1)
        if P.shape[0] == 0:
            levels.append(np.inf)
            conditions.append(np.zeros((0, n + p)))
            continue
        row = kernel_row(moments.of_degree(degree), within=P, starts=starts)
        starts = (row.coefficients,)
        levels.append(row.level)
        conditions.append(kernel_conditions((row.coefficients @ mix.T)[None], coordinates.A, coordinates.C)[0])
    return levels, conditions


def _least_degree(levels: Array, samples: int) -> tuple[int, float]:
    """The least degree after which no longer row gains more than IDLE nats, and how clear that is (1 or more: clear
    on both sides).
    """
    idle = max(IDLE, 30 / samples)
    best = np.minimum.accumulate(levels[::-1])[::-1]
    degree = next(d for d in range(len(levels)) if np.isfinite(levels[d]) and levels[d] - best[d] <= idle)
    gained = np.inf if degree == 0 else float(levels[degree - 1] - levels[degree])
    unused = max(float(levels[degree] - best[degree]), QUIET / 1e3)
    return degree, float(min(gained / NEEDED, QUIET / unused))


def _complement(A: Array, C: Array, s: int) -> Array:
    """P (k, p s) with orthonormal rows, P O_s = 0."""
    blocks = [C]
    for _ in range(s - 1):
        blocks.append(blocks[-1] @ A)
    left, values, _ = np.linalg.svd(np.vstack(blocks))
    size = float(values[0]) if values.size else 0.0
    observed = int(np.sum(values > left.shape[0] * EPS * size))
    return np.asarray(left[:, observed:].T)


def _null_directions(data: Arguments, s: int) -> tuple[ObservedCoordinates, Array, Array, Array]:
    coordinates = observed_coordinates(data.r, data.A, data.C, s)
    factor = hankel_factor(data.r / coordinates.scale, s) / np.sqrt(len(data.r))
    P = _complement(coordinates.A, coordinates.C, s)
    left, values, _ = np.linalg.svd(P @ factor)
    return coordinates, P, left, np.concatenate([values, np.zeros(P.shape[0] - values.size)])


def _zeros_by_rank(data: Arguments, faults: int, s: int) -> tuple[int, float]:
    """zeta by the largest drop among the ranks of P R_s that it allows, and the drop."""
    s = min(s, (len(data.r) + 1) // (data.p + 1))
    coordinates, P, _, values = _null_directions(data, s)
    hidden = data.n - coordinates.observed
    ranks = {P.shape[0] - ((data.p - faults) * s - (data.n - zeta)): zeta for zeta in range(hidden, data.n + 1)}
    possible = [rank for rank in ranks if 0 < rank < P.shape[0]]
    if not possible:
        raise InvalidData(
            f"r has {len(data.r)} samples, too few for a window longer than the lag: record more, "
            "or take a model of lower order"
        )
    rank, drop = gap_rank(values, possible, EPS * float(values[0]))
    return ranks[rank], drop


def null_row_covariance(P: Array, left: Array, values: Array, signal: int) -> Array:
    """Covariance (p s, p s), up to a factor, of the error that white noise makes in each left singular vector to a
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
    """Conditions (q, s, n + p) as (q s, n + p), each row's s conditions multiplied so that their errors at `columns`
    are white on average.
    """
    responses = np.einsum("kab,bz->kaz", maps, columns)
    spread = np.einsum("kaz,ac,lcz->kl", responses, uncertainty, responses, optimize=True)
    spread += np.eye(len(spread)) * max(1e-9 * float(np.trace(spread)), np.finfo(float).tiny)
    q, s, width = conditions.shape
    stacked = conditions.transpose(1, 0, 2).reshape(s, q * width)
    white = np.linalg.solve(np.linalg.cholesky(spread), stacked)
    return np.asarray(white.reshape(s * q, width))
