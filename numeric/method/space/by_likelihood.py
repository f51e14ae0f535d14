"""This estimates the fault space from a noisy residual, where R_s has full rank and no null row is exact.

    fault_space_by_likelihood   kernel rows by maximum likelihood with noise colour
    joint_basis                 all p - n_v rows at once, with the row degrees that the data accept, from a fault space found row by row
    complement                  P with orthonormal rows and P O_s = 0: a true kernel row is g P, because A and C are known
    mix                         n_v + 1 combinations of the outputs, which obey exactly one kernel row, of degree n - zeta

zeta, the number of zeros, is never taken larger than the observability indices of (A, C) allow (`fault_space_bound`).
It is chosen where a higher degree of the row no longer explains anything. On data of the paper's kind no rule finds it always, because a
system that nearly has a zero looks like one that has it: `decided` and `margin` tell how clear it was, and `zeta` of the estimate is None
where it was not. The number found, all p - n_v rows are fitted at once (`joint_kernel_basis`), which also tells how far the space may be
off.

What noise it takes. The likelihood form divides each channel by its size and takes the noise to have one colour and the same power in
every divided channel: it is consistent only where the noise has one colour and the same power relative to each channel. Otherwise, as
with sensors of equal absolute noise on channels of different size, it keeps a bias of second order in the noise that more samples do not
take away (`tests/numeric/test_convergence.py` shows both), and the stated angle does not contain it. Other units of r change nothing: the
channels are divided by their sizes all the same.

The constants are judged by `benchmarks/constants.py space`, whose rule was fixed before: 442 records of 540 (seeds 700100 and 700600) are
answered rightly and 4 wrongly; with QUIET doubled it is 471 and 10, more of either kind, and no other factor is better.

Source: [G25] problem (11); the likelihood of one row is that of `kernel_likelihood`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations_with_replacement, islice

import numpy as np
import scipy.linalg
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.sheets import counted
from ..ranks.arguments import Arguments, arguments
from ..ranks.one_row import kernel_row
from ..ranks.rank_gap import fault_dimension
from ..ranks.sample_windows import EPS, ObservedCoordinates, observed_coordinates
from .basis import KernelBasis, kernel_basis
from .estimate import FaultSpaceEstimate, condition_maps, everything, kernel_conditions, orthonormal
from .largest import largest_fault_space
from .space_uncertainty import space_uncertainty
from .tapered_moments import CrossMoments, tapered_moments

# Nats a sample: what a longer row may gain by absorbing noise colour, what it must gain to be called clearly needed, and up to where the
# gains not used are clearly idle.
IDLE, NEEDED, QUIET = 0.1, 0.5, 0.03
NOISE_TAKEN = "noise taken to have one colour and the same power relative to each channel: a bias stays where it has not"


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
    doubts = () if decided else (f"the number of zeros is a near thing (margin {margin:.2g}, 1 is needed)",)
    finding = f"n_z = {n_z} = n_v + zeta = {faults} + {zeta}; {why}; {_told_bound(n_z, most)}{NOISE_TAKEN}"
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
        finding,
        None,
        "likelihood",
        None if basis is None else space_uncertainty(basis.rows, basis.within, basis.covariance, coordinates, columns),
        doubts,
    )


def _faults(data: Arguments) -> tuple[int | None, str]:
    """Return the number of faults and where it comes from; None, or p, with the reason why there is no answer."""
    if data.n_v is None:
        found = fault_dimension(data.r)
        if found.n_v is None:
            return None, f"the number of faults is undecided ({found.reason}): give n_v; until then any column will do"
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


# Splits tried, and the nats a sample by which the joint level may lie above that of single rows before another is.
SPLITS = 6
SLACK = 0.3  # nats above the best split up to which another is a start, too; it decides which descents are made, and no answer


def joint_basis(
    moments: CrossMoments, coordinates: ObservedCoordinates, rows: int, degree: int, columns: Array, level: float
) -> KernelBasis | None:
    """Find the likeliest basis of this many rows, whose degrees add up to `degree`, started from the fault space `columns` (n + p, n_z) in
    the observed coordinates; None where no split of the degree comes near the `level` that single rows leave."""
    for degrees in islice(splits(degree, rows), SPLITS):
        within = [complement(coordinates.A, coordinates.C, eta + 1) for eta in degrees]
        start = rows_from(columns, coordinates, degrees)
        if start is None:
            continue
        basis = kernel_basis(moments.of_degree(max(degrees)), within, [start])
        if basis.level <= level + SLACK:
            return basis
    return None


def splits(degree: int, rows: int) -> Iterator[tuple[int, ...]]:
    """Return ascending row degrees that add up to `degree`, the most equal first."""
    parts = (part for part in combinations_with_replacement(range(degree + 1), rows) if sum(part) == degree)
    yield from sorted(parts, key=lambda part: (part[-1] - part[0], part[-1]))


def complement(A: Array, C: Array, s: int) -> Array:
    """Return P (k, p s) with orthonormal rows, P O_s = 0."""
    blocks = [C]
    for _ in range(s - 1):
        blocks.append(blocks[-1] @ A)
    left, values, _ = np.linalg.svd(np.vstack(blocks))
    size = float(values[0]) if values.size else 0.0
    observed = int(np.sum(values > left.shape[0] * EPS * size))
    return np.asarray(left[:, observed:].T)


def rows_from(columns: Array, coordinates: ObservedCoordinates, degrees: tuple[int, ...]) -> list[Array] | None:
    """Return kernel rows (eta_i + 1, p) of these ascending degrees that come nearest to N T_s(z) = 0 for the columns z and leave no
    row a combination of shifts of the others; None where the degrees leave no room for that."""
    p = coordinates.C.shape[0]
    found: list[Array] = []
    for degree in sorted(set(degrees)):
        P = complement(coordinates.A, coordinates.C, degree + 1)
        shifts = [np.pad(row.ravel(), (a * p, (degree - a + 1) * p - row.size)) for row in found for a in range(degree - len(row) + 2)]
        if shifts:
            P = scipy.linalg.null_space(np.array(shifts) @ P.T).T @ P
        wanted = degrees.count(degree)
        if len(P) < wanted:
            return None
        asked = np.concatenate(list(condition_maps(coordinates.A, coordinates.C, degree + 1) @ columns), axis=1)
        left = np.linalg.svd(P @ asked)[0]
        found += [(vector @ P).reshape(degree + 1, p) for vector in left[:, len(P) - wanted :].T]
    return found
