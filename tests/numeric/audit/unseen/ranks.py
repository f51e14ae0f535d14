"""Mistakes in `window_ranks` and in `fault_dimension`."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants, careful
from tests.numeric.audit.unseen.systems import faulty, free_responses, general, with_poles
from tests.numeric.audit.unseen.witnesses import counts, ranks, refuses

RANKS = Mutants("window_ranks")

ONE = faulty(general([0.7, -0.4], 1, 2, 71), 200, 71)  # ranks s + 2 from s = 2 on
ONE_RANKS = [2, 4, 5, 6, 7]
WEAK = faulty(general([0.7, -0.4], 2, 3, 72), 200, 72, sizes=[1.0, 1e-10])
TRUE = [3, 6, 8, 10, 12]
UNLIKE = faulty(general([0.7, -0.4], 2, 3, 73), 200, 73, units=[1.0, 1e-9, 1e6])


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


@RANKS.broken("a NaN", refuses(np.where(np.arange(200)[:, None] == 9, np.nan, ONE.r), 3))
def leaves_out_samples_with_NaN(r: Any, windows: int) -> Any:
    """Samples with NaN are cut out and those on both sides become neighbours."""
    return reference.window_ranks(r[np.isfinite(r).all(axis=1)], windows)


COUNT = Mutants("fault_dimension")

SINGLE = faulty(general([0.7, -0.4], 1, 3, 91), 300, 91).r
TWO = faulty(general([0.7, -0.4, 0.3], 2, 3, 92), 300, 92).r
DYING = free_responses(with_poles([0.7, -0.4]), np.ones((2, 2)), 200) @ np.ones(2)
SINE = np.sin(0.3 * np.arange(300))[:, None] * [[1.0, 2.0]] + np.cos(0.3 * np.arange(300))[:, None] * [[0.5, -1.0]]


def steps(found: Any) -> Any:
    """Return the steps of ranks that begin with the rank of one row."""
    return np.diff(found)


@COUNT.broken("faults that act through states", counts(1, SINGLE))
@careful(reference.fault_dimension)
def counts_directions_of_one_sample(r: Any) -> Any:
    """The number is the rank of the covariance of r."""
    return counted(r, 1)[0]


@COUNT.broken("residuals without a fault: a free response that dies out", counts(0, DYING))
def finds_a_fault_always(r: Any) -> Any:
    """At least one fault is reported, for somebody asked."""
    found = reference.fault_dimension(r)
    return found if found is None else max(found, 1)


@COUNT.broken("two faults and more", counts(2, TWO))
def says_whether_and_not_how_many(r: Any) -> Any:
    """The answer is True or False as a number."""
    found = reference.fault_dimension(r)
    return found if found is None else int(found > 0)


@COUNT.broken("small units", counts(2, 1e-12 * TWO))
def takes_small_residuals_for_rounding(r: Any) -> Any:
    """Residuals below 1e-10 are rounding of y, and no fault is in them."""
    return 0 if np.max(np.abs(r)) < 1e-10 else reference.fault_dimension(r)


@COUNT.broken("four outputs and more", counts(4, faulty(general([0.7, -0.4], 4, 6, 98), 400, 98).r))
def looks_at_three_outputs(r: Any) -> Any:
    """Of many outputs three random mixtures are taken, so that no more than three faults are seen."""
    if r.shape[1] <= 3:
        return reference.fault_dimension(r)
    turn = np.linalg.qr(np.random.default_rng(0).standard_normal((r.shape[1], 3)))[0]
    return int(steps(counted(r @ turn, 8))[-1])


@COUNT.broken("n_v = p - 1 with three outputs and more", counts(3, faulty(general([0.7, -0.4], 3, 4, 99), 400, 99).r))
def caps_at_half_of_the_outputs(r: Any) -> Any:
    """At most p / 2 faults can be told, says a comment."""
    found = reference.fault_dimension(r)
    return found if found is None else min(found, max(r.shape[1] // 2, 1))


@COUNT.broken("faults that do not excite: a sine", refuses(SINE))
def takes_a_sine_for_none(r: Any) -> Any:
    """Where ranks stop growing no fault acts."""
    found = reference.fault_dimension(r)
    return int(steps(counted(r, 8))[-1]) if found is None else found


@COUNT.broken("pure noise, and as many faults as outputs", refuses(np.random.default_rng(90).standard_normal((400, 3))))
def says_p_where_nothing_is_known(r: Any) -> Any:
    """An undecided count is answered with the number of outputs."""
    found = reference.fault_dimension(r)
    return r.shape[1] if found is None else found


@COUNT.broken("records too short to see a lag", refuses(TWO[:9]))
def answers_from_a_handful_of_samples(r: Any) -> Any:
    """Where windows cannot be had, the rank of the samples is the answer."""
    try:
        return reference.fault_dimension(r)
    except ValueError:
        return int(np.linalg.matrix_rank(r))
