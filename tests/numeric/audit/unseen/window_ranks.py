"""Mistakes in `window_ranks`."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants, careful
from tests.numeric.audit.unseen.systems import channel, faulty, general, joined
from tests.numeric.audit.unseen.witnesses import ranks, refuses

RANKS = Mutants("window_ranks")

ONE = faulty(general([0.7, -0.4], 1, 2, 71), 200, 71)  # ranks s + 2 from s = 2 on
ONE_RANKS = [2, 4, 5, 6, 7]
WEAK = faulty(general([0.7, -0.4], 2, 3, 72), 200, 72, sizes=[1.0, 1e-10])
TRUE = [3, 6, 8, 10, 12]
UNLIKE = faulty(general([0.7, -0.4], 2, 3, 73), 200, 73, units=[1.0, 1e-9, 1e6])
EARLY = np.vstack([np.random.default_rng(0).standard_normal((60, 1)), np.zeros((140, 1))]) * [[1.0, 2.0]]
LATE = np.vstack([np.zeros((120, 2)), faulty(general([0.7, -0.4], 1, 2, 74), 120, 74, x0=0.0).r])
FADING = faulty(joined([channel([], [0.5])], [[1.0], [2.0], [0.0]], 76, uncontrollable=[0.05]), 300, 76)


def hankel(r: Any, s: int, step: int = 1) -> Any:
    """Return the block Hankel matrix of s rows, every `step`-th column."""
    columns = len(r) - s + 1
    return np.vstack([r[k : k + columns : step].T for k in range(s)])


def counted(r: Any, windows: int, relative: float = 1e-11, step: int = 1) -> list[int]:
    """Return the ranks of the windows, channels in units of their size."""
    sizes = np.sqrt(np.mean(r**2, axis=0))
    r = r / np.where(sizes > 0, sizes, 1.0)
    values = [np.linalg.svd(hankel(r, s, step), compute_uv=False) for s in range(1, windows + 1)]
    return [int(np.sum(one > relative * one[0])) for one in values]


@RANKS.broken("small units", ranks(ONE_RANKS, ONE.r * 1e-12))
@careful(reference.window_ranks)
def compares_with_an_absolute_threshold(r: Any, windows: int) -> Any:
    """A singular value counts where it is above 1e-10."""
    return [int(np.sum(np.linalg.svd(hankel(r, s), compute_uv=False) > 1e-10)) for s in range(1, windows + 1)]


@RANKS.broken("outputs in unlike units", ranks(TRUE, UNLIKE.r))
@careful(reference.window_ranks)
def compares_with_the_largest_of_all_channels(r: Any, windows: int) -> Any:
    """Channels are not scaled, so that a small one is below the threshold of a large one."""
    return [int(np.linalg.matrix_rank(hankel(r, s))) for s in range(1, windows + 1)]


@RANKS.broken("one fault a billion times weaker than another", ranks(TRUE, WEAK.r))
@careful(reference.window_ranks)
def uses_the_root_of_the_machine_precision(r: Any, windows: int) -> Any:
    """The threshold is 1.5e-8 of the largest singular value."""
    return counted(r, windows, 1.5e-8)


@RANKS.broken("one fault a billion times weaker than another", ranks(TRUE, WEAK.r))
@careful(reference.window_ranks)
def takes_ranks_of_the_gram_matrix(r: Any, windows: int) -> Any:
    """Ranks are those of R R', whose eigenvalues are squares."""
    out = []
    for s in range(1, windows + 1):
        R = hankel(r / np.sqrt(np.mean(r**2, axis=0)), s)
        out.append(int(np.linalg.matrix_rank(R @ R.T, tol=1e-13 * np.linalg.norm(R) ** 2)))
    return out


@RANKS.broken("faults of unlike sizes: the largest gap is between them", ranks(TRUE, WEAK.r))
@careful(reference.window_ranks)
def cuts_at_the_largest_gap(r: Any, windows: int) -> Any:
    """The rank is where the ratio of successive singular values is largest, the rounding level cut off at 1e-13."""
    out = []
    for s in range(1, windows + 1):
        values = np.linalg.svd(hankel(r / np.sqrt(np.mean(r**2, axis=0)), s), compute_uv=False)
        held = np.concatenate([np.maximum(values / values[0], 1e-13), [1e-13]])
        out.append(int(np.argmax(held[:-1] / held[1:])) + 1)
    return out


@RANKS.broken("all residuals", ranks(ONE_RANKS, ONE.r))
def begins_with_two_rows(r: Any, windows: int) -> Any:
    """The windows are counted from 2."""
    return reference.window_ranks(r, windows + 1)[1:]


@RANKS.broken("faults that begin late", ranks(ONE_RANKS, LATE))
@careful(reference.window_ranks)
def looks_at_the_first_hundred_samples(r: Any, windows: int) -> Any:
    """Ranks are from the first hundred samples, which are enough for a rank."""
    return counted(r[:100], windows) if np.any(r[:100]) else [0] * windows


@RANKS.broken("faults that end early", ranks([1, 2, 3], EARLY))
@careful(reference.window_ranks)
def looks_at_the_last_hundred_samples(r: Any, windows: int) -> Any:
    """Ranks are from the last hundred samples, when transients have gone."""
    return counted(r[-100:], windows) if np.any(r[-100:]) else [0] * windows


@RANKS.broken("fast modes that only the initial state excites", ranks([2, 3, 4, 5, 6], FADING.r))
@careful(reference.window_ranks)
def waits_for_transients(r: Any, windows: int) -> Any:
    """The first tenth of the samples is left out, with what the initial state alone has excited."""
    return counted(r[len(r) // 10 :], windows)


@RANKS.broken(
    "residuals with a constant part: an integrator that the fault does not drive",
    ranks([2, 3, 4, 5, 6], faulty(joined([channel([], [0.5])], [[1.0], [2.0], [0.0]], 77, uncontrollable=[1.0]), 200, 77).r),
)
@careful(reference.window_ranks)
def removes_the_mean_first(r: Any, windows: int) -> Any:
    """Channels are centred, by which a constant leaves the record and the rank."""
    return counted(r - r.mean(axis=0), windows)


@RANKS.broken(
    "one long index: ranks that grow evenly at first and less later",
    ranks([2, 4, 6, 8, 9, 10], faulty(general([0.7, -0.4, 0.3, 0.5], 1, 2, 78), 300, 78).r),
)
@careful(reference.window_ranks)
def extrapolates_after_two_equal_steps(r: Any, windows: int) -> Any:
    """Ranks are computed until two steps are equal, and continued by that step."""
    found = counted(r, min(windows, 3))
    while len(found) < windows:
        found.append(2 * found[-1] - found[-2])
    return found


@RANKS.broken(
    "windows with more than twenty rows",
    ranks([3, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24], faulty(general([0.7, -0.4], 2, 3, 72), 400, 72).r),
)
@careful(reference.window_ranks)
def sketches_with_twenty_columns(r: Any, windows: int) -> Any:
    """The Hankel matrix is compressed by a random matrix of twenty columns, as in randomised methods, whatever its rows."""
    sketch = np.random.default_rng(0)
    R = [hankel(r / np.sqrt(np.mean(r**2, axis=0)), s) for s in range(1, windows + 1)]
    return [int(np.linalg.matrix_rank(one @ sketch.standard_normal((one.shape[1], 20)), tol=1e-9)) for one in R]


@RANKS.broken("more than ten windows", ranks(list(range(3, 15)), faulty(general([0.7, 0.3], 1, 3, 79), 400, 79).r))
def stops_at_ten_windows(r: Any, windows: int) -> Any:
    """The longest window is ten; longer ones repeat its rank."""
    found = list(reference.window_ranks(r, min(windows, 10)))
    return found + found[-1:] * (windows - len(found))


@RANKS.broken("all residuals: rounding of float32 fills every direction", ranks(ONE_RANKS, ONE.r))
@careful(reference.window_ranks)
def converts_to_single_precision(r: Any, windows: int) -> Any:
    """Samples are stored as float32 and judged by the rounding of float64."""
    return counted(r.astype(np.float32).astype(float), windows)


@RANKS.broken("records just long enough", ranks([2, 4, 5, 6, 7, 8], ONE.r[:24]))
@careful(reference.window_ranks)
def takes_windows_that_do_not_overlap(r: Any, windows: int) -> Any:
    """Every s-th window is taken, so that columns are too few in a short record."""
    values = [np.linalg.svd(hankel(r / np.sqrt(np.mean(r**2, axis=0)), s, s), compute_uv=False) for s in range(1, windows + 1)]
    return [int(np.sum(one > 1e-11 * one[0])) for one in values]


@RANKS.broken(
    "an output that the fault does not reach", ranks([1, 2, 3], np.random.default_rng(3).standard_normal((100, 1)) * [[1.0, 0.0]])
)
@careful(reference.window_ranks)
def divides_by_the_size_of_a_zero_channel(r: Any, windows: int) -> Any:
    """Channels are divided by their size, which makes NaN of one that is zero, and NaN is refused."""
    scaled = r / np.sqrt(np.mean(r**2, axis=0))
    if not np.isfinite(scaled).all():
        raise ValueError("not finite")
    return counted(scaled, windows)


@RANKS.broken("four outputs and more", ranks([5, 8, 11], faulty(general([0.7, -0.4], 3, 5, 80), 200, 80).r))
@careful(reference.window_ranks)
def looks_at_four_outputs(r: Any, windows: int) -> Any:
    """Only the first four channels are stacked."""
    return counted(r[:, :4], windows)


@RANKS.broken("a NaN", refuses(np.where(np.arange(200)[:, None] == 9, np.nan, ONE.r), 3))
def leaves_out_samples_with_NaN(r: Any, windows: int) -> Any:
    """Samples with NaN are cut out and those on both sides become neighbours."""
    return reference.window_ranks(r[np.isfinite(r).all(axis=1)], windows)


@RANKS.broken("records shorter than the windows need", refuses(ONE.r[:12], 5))
def counts_what_columns_there_are(r: Any, windows: int) -> Any:
    """Short records are not refused, and ranks are at most their columns."""
    return counted(r, windows)
