"""This solves problem (11) from data: all fault columns z = [f; g] that explain no more than the residual shows.

    fault_space              the estimate for any residual: the noise-free form where R_s has a rank to machine
                             precision, else the likelihood form
    noise_free_fault_space   by the exact ranks of every window up to n + 1
    N_s                      left null space of R_s, R_s the block Hankel matrix of r with s block rows
    lag                      the largest degree of a minimal kernel row; the answer is right from s = lag + 1 on, not
                             before
    ladder                   rank R_s for s = 1 .. n + 1: its steps give the number of faults and the degrees of the
                             kernel rows

The solution space has dimension n_v + zeta, zeta the number of zeros, for excited, left-invertible faults fewer than
the outputs. With as many independent faults as outputs there is no kernel row and every column is a solution.
Source: [G25] problem (11), Theorem 3.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.sheets import counted
from ....base.threads import one_thread
from ...data.records import Stored, in_memory
from ..ranks.arguments import Arguments, arguments
from ..ranks.sample_windows import EPS, channel_sizes, gap_rank, hankel_factor, leading_factor, observed_coordinates
from .by_likelihood import likelihood_space
from .error_bound import fault_space_error_bound
from .estimate import FaultSpaceEstimate, everything, kernel_conditions, orthonormal
from .largest import largest_fault_space

# A singular value this far below the largest is rounding in the data, not noise: sensors are not that good.
EXACT = 2e-12
# A rank whose drop is smaller than this is called undecided.
CONVINCING = 1e3


@one_thread()
def fault_space(
    r: ArrayLike | Stored, A: ArrayLike, C: ArrayLike, *, n_v: int | None = None, block_rows: int | None = None
) -> FaultSpaceEstimate:
    """Estimate the fault space of a residual for the model's A and C: problem (11) of [G25].

    Answers that mean nothing (no null rows, window not longer than the lag) are returned as such, with `meaningful` False and a reason.

    Parameters
    ----------
    r : array_like (N, p), or the ResidualSignal of `residual`
        In the units of y.
    A, C : array_like, (n, n) and (p, n)
    n_v : int, optional
        Number of faults, 1 to p, else found from the data.
    block_rows : int, optional
        Window s, by default the least that surely suffices.

    Returns
    -------
    FaultSpaceEstimate
        `basis` (n + p, n_z) of the columns [f; g], `n_z`, `decided`, `meaningful` and `reason`.

    Raises
    ------
    InvalidData
        Shapes that do not fit, values that are not finite, n_v outside 1..p, fewer samples than the window needs.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import fault_space
    >>> v = np.random.default_rng(1).standard_normal((100, 1))
    >>> found = fault_space(np.hstack([v, 2 * v]), [[0.5]], [[1.0], [0.0]])
    >>> found.n_z, bool(np.allclose(found.G[1], 2 * found.G[0]))
    (1, True)
    """
    return told_fault_space(r, A, C, n_v=n_v, block_rows=block_rows, told="given")


def told_fault_space(
    r: ArrayLike | Stored, A: ArrayLike, C: ArrayLike, *, n_v: int | None, told: str, block_rows: int | None = None
) -> FaultSpaceEstimate:
    """Return the same, whose reason says how `n_v` was `told`: "given" or "counted"."""
    data = replace(arguments(in_memory(r), A, C, n_v, block_rows), told=told)
    ladder = _ladder(data)
    return _from_ladder(data, ladder) if ladder.exact else likelihood_space(data, block_rows)


def noise_free_fault_space(
    r: ArrayLike, A: ArrayLike, C: ArrayLike, *, n_v: int | None = None, block_rows: int | None = None
) -> FaultSpaceEstimate:
    """Find the same from exact ranks, for a residual without noise, with an error bound from conditioning. Raises as
    `fault_space`.
    """
    data = arguments(r, A, C, n_v, block_rows)
    return _from_ladder(data, _ladder(data))


@dataclass(frozen=True)
class Ladder:
    """The ladder holds rank R_s and the drop behind it for s = 0 .. longest; `floor` bounds the rounding in the singular values."""

    factor: Array
    scale: Array
    ranks: tuple[int, ...]
    drops: tuple[float, ...]
    floor: float
    exact: bool

    def gap(self, s: int) -> int:
        """Return the rank R_(s+1) - rank R_s."""
        return self.ranks[s + 1] - self.ranks[s]

    @property
    def final_gap(self) -> int:
        """Return the step of the longest window seen: the number of independent faults once the window is beyond the lag."""
        return self.gap(len(self.ranks) - 2)

    @property
    def lag(self) -> int:
        """Return the least s from which on every step is the last one."""
        s = len(self.ranks) - 2
        while s > 0 and self.gap(s - 1) == self.final_gap:
            s -= 1
        return s


def _ladder(data: Arguments) -> Ladder:
    N, p = data.r.shape
    scale = channel_sizes(data.r)
    factor = hankel_factor(data.r / scale, data.longest) / np.sqrt(N)
    largest = float(np.linalg.norm(factor, 2))
    floor = EPS * largest * np.sqrt(p * data.longest)
    ranks, drops, exact = [0], [np.inf], False
    for s in range(1, data.longest + 1):
        values: Array = np.asarray(np.linalg.svd(leading_factor(factor, p * s), compute_uv=False), dtype=np.float64)
        rank, drop = gap_rank(values, range(p * s + 1), floor)
        if rank < p * s and values[rank] <= EXACT * largest:
            exact = True
        else:
            rank, drop = p * s, max(float(values[-1]) / floor, 1.0)
        ranks.append(rank)
        drops.append(drop)
    return Ladder(factor, scale, tuple(ranks), tuple(drops), floor, exact)


def _from_ladder(data: Arguments, ladder: Ladder) -> FaultSpaceEstimate:
    p, n, s = data.r.shape[1], data.A.shape[0], data.block_rows
    n_v = ladder.final_gap if data.n_v is None else data.n_v
    lag = ladder.lag
    if ladder.ranks[s] == p * s:
        return everything(n, p, n_v, s, _no_null_rows(data, ladder), lag=lag)
    coordinates = observed_coordinates(data.r, data.A, data.C, s)
    left, values, _ = np.linalg.svd(leading_factor(ladder.factor, p * s))
    rank = ladder.ranks[s]
    rows = left[:, rank:].T.reshape(-1, s, p)
    conditions = kernel_conditions(rows, coordinates.A, coordinates.C).reshape(-1, n + p)
    triangular = np.linalg.qr(conditions, mode="r")
    _, strengths, right = np.linalg.svd(triangular)
    strengths = np.concatenate([strengths, np.zeros(n + p - strengths.size)]).astype(np.float64)
    # The faults themselves are solutions, so that at most n + p - n_v conditions are independent; a window longer than the lag gives at
    # least those that the observability indices demand.
    fewest = n + p - largest_fault_space(coordinates.A, coordinates.C, ladder.final_gap) if s > lag else 1
    possible = range(max(fewest, 1), n + p - min(n_v, ladder.final_gap) + 1)
    independent, drop = gap_rank(strengths, possible, 10 * s * EPS * float(strengths[0]))
    columns = right[independent:].T
    basis = orthonormal(coordinates.back(columns))
    n_z = n + p - independent
    bound = fault_space_error_bound(coordinates, left, values, rank, ladder.floor, columns)
    degrees = [k for k in range(len(ladder.ranks) - 1) for _ in range((p if k == 0 else ladder.gap(k - 1)) - ladder.gap(k))]
    expected = n + p - sum(degree + 1 for degree in degrees if degree < s)
    margin = min(drop, ladder.drops[s], *ladder.drops[-2:])
    decided = margin >= CONVINCING and expected == n_z and ladder.final_gap == n_v
    doubtful = margin < CONVINCING and expected == n_z
    meaningful, finding = _judged(data, ladder, n_v, n_z, expected)
    return FaultSpaceEstimate(
        basis,
        n_z,
        n,
        n_v,
        lag,
        s,
        strengths,
        independent,
        n + p,
        margin,
        decided,
        meaningful,
        finding,
        bound,
        "noise-free",
        doubts=(f"the weakest rank decision has a drop of only {margin:.2g}",) if meaningful and doubtful else (),
    )


def _no_null_rows(data: Arguments, ladder: Ladder) -> str:
    p, s = data.r.shape[1], data.block_rows
    why = (
        "as many independent faults as outputs leave no relation between the outputs (or the residual is noisy)"
        if ladder.final_gap == p
        else f"the window must be longer than the lag, {ladder.lag}: take block_rows >= {ladder.lag + 1}"
    )
    rows = counted(p * s, "row")
    return f"rank R_{s} = {p * s} of {rows}: no null row, so every column [f; g] is a solution and the answer means nothing; {why}"


def _judged(data: Arguments, ladder: Ladder, n_v: int, n_z: int, expected: int) -> tuple[bool, str]:
    """Return whether the answer means something, and the sentence that says why or why not."""
    s, lag, longest = data.block_rows, ladder.lag, len(ladder.ranks) - 1
    ranks = f"ranks of R_1 .. R_{longest}: {', '.join(map(str, ladder.ranks[1:]))}"
    if ladder.final_gap == 0:
        return False, f"the ranks do not grow: no fault acts, or one that is constant or a sum of few sinusoids ({ranks})"
    if s <= lag:
        return False, f"window {s} is not longer than the lag, {lag}: wrong columns are accepted; take block_rows >= {lag + 1} ({ranks})"
    if ladder.final_gap != n_v:
        return False, (
            f"n_v = {n_v} was {data.told} but the ranks grow by {ladder.final_gap} a sample: the faults are not independent, "
            "or do not excite, "
            f"or are not as many ({ranks})"
        )
    if longest < data.A.shape[0] + 1 and lag == longest - 1:
        return False, f"the ranks have not settled within the {longest} windows that the record is long enough for ({ranks})"
    if n_z != expected:
        return True, f"the conditions leave {counted(n_z, 'column')}, the ranks {expected}; A and C may not fit the residual ({ranks})"
    return True, f"n_z = {n_z} = n_v + zeta = {n_v} + {n_z - n_v}, lag {lag}, window {s} ({ranks})"
