"""Mistakes in `window_ranks`."""

from __future__ import annotations

from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants, careful
from tests.numeric.audit.unseen.systems import faulty, general
from tests.numeric.audit.unseen.witnesses import ranks, refuses

RANKS = Mutants("window_ranks")

ONE = faulty(general([0.7, -0.4], 1, 2, 71), 200, 71)  # ranks s + 2 from s = 2 on
ONE_RANKS = [2, 4, 5, 6, 7]
WEAK = faulty(general([0.7, -0.4], 2, 3, 72), 200, 72, sizes=[1.0, 1e-10])
TRUE = [3, 6, 8, 10, 12]
UNLIKE = faulty(general([0.7, -0.4], 2, 3, 73), 200, 73, units=[1.0, 1e-9, 1e6])
EARLY = np.vstack([np.random.default_rng(0).standard_normal((60, 1)), np.zeros((140, 1))]) * [[1.0, 2.0]]
LATE = np.vstack([np.zeros((120, 2)), faulty(general([0.7, -0.4], 1, 2, 74), 120, 74, x0=0.0).r])


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
