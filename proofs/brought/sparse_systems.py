"""Sparse random systems that want a bound to fail: more of them, and sparser, than a table of values can hold.

    withstand     add to a table the systems on which some bound fails, and seek bounds anew, until none fails

Systems have up to 6 states, 3 faults and 4 outputs. About one entry a row is not 0, or one at most, as in shift registers: such systems
have long lags, delays and indices. They are drawn from six seeds, as many from each; a slow machine stops drawing after thirty seconds,
and the answer says how many there were. What is drawn is kept, with what was found of it, so that bounds that come in the place of
refuted ones meet all of it, too.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from ...base.progress import Progress
from ..boxes.box import Box
from ..language.by_batches import Table as Answers
from ..language.by_batches import UndefinedAt, true_of
from ..language.nodes import Node
from ..quantities.batches import Batch
from ..quantities.blocks import lifted
from ..quantities.elimination import Integers
from .drawn_cases import LARGEST_STATES, MOST_FAULTS, MOST_OUTPUTS
from .tables import OUTSIDE, Table, add_batch

SEEDS, BATCHES, AT_A_TIME, SECONDS = range(2, 8), 60, 250, 30.0  # tables.py draws from seed 1
Rows = NDArray[np.intp]
Found = TypeVar("Found")


def withstand(
    table: Table, hypotheses: Sequence[Node], columns: Sequence[Node], seek: Callable[[], tuple[Found, list[Node]]], progress: Progress
) -> Found:
    """Add to the table, which is of these columns, the sparse systems on which a bound fails, and return what `seek` then finds.

    `seek` makes bounds of the table, and returns what it found and the bounds. It is asked anew until none fails on what was drawn.
    """
    batches: list[tuple[Batch, Rows]] = []
    started, left = time.monotonic(), len(SEEDS) * BATCHES
    draws = (_drawn(table.box, np.random.default_rng((seed, number))) for seed in SEEDS for number in range(BATCHES))
    while True:
        (found, listed), added = seek(), 0
        rows_by_values = {row.values: row for row in table.rows}
        answers: dict[tuple[Node, ...], Answers] = {}
        for number in range(left):
            if number == len(batches):
                if time.monotonic() - started > SECONDS:
                    left = number
                    break
                progress("attacking bounds by sparse systems", number, left)
                batch = next(draws)
                batches.append((batch, _meeting(hypotheses, batch)))
            batch, rows = batches[number]
            failing = _failing(listed, batch, rows, answers)
            if len(failing):
                added += add_batch(batch.part(failing), (OUTSIDE + 3, number), rows_by_values, hypotheses, columns)
        table.sparse, table.sparse_met = len(batches) * AT_A_TIME, sum(len(rows) for _, rows in batches)
        if not added:
            return found
        table.rows = sorted(rows_by_values.values(), key=lambda row: row.place)


def _meeting(hypotheses: Sequence[Node], batch: Batch) -> Rows:
    rows = np.arange(len(batch))
    for node in hypotheses:
        rows = rows[true_of(node, batch, rows, Answers())]
    return rows


def _failing(bounds: Sequence[Node], batch: Batch, rows: Rows, answers: dict[tuple[Node, ...], Answers]) -> Rows:
    """Return the systems on which a bound fails, or has no value because a quantity is infinite."""
    failing: list[int] = []
    for node in bounds:
        left = rows
        while len(left):
            try:
                failing += left[~true_of(node, batch, left, answers.setdefault((node,), Answers()))].tolist()
                break
            except UndefinedAt as error:
                failing.append(error.index)
                left = left[left != error.index]
    return np.array(sorted(set(failing)), dtype=np.intp)


def _drawn(box: Box, rng: Generator) -> Batch:
    n, m, p = (int(rng.integers(least, 1 + most)) for least, most in ((2, LARGEST_STATES), (1, MOST_FAULTS), (1, MOST_OUTPUTS)))
    signed = 0.0 if box.prime == 2 else rng.choice((0.0, 0.0, 0.5), AT_A_TIME)[:, None, None]
    single = rng.random(AT_A_TIME)[:, None, None] < 0.5

    def sparse(rows: int, columns: int, means: Sequence[float]) -> Integers:
        """Return matrices with so many entries a row on average that are not 0: anywhere, or at most one a row."""
        shape, mean = (AT_A_TIME, rows, columns), rng.choice(means, AT_A_TIME)[:, None, None]
        place = rng.integers(0, columns, shape[:2])[:, :, None] == np.arange(columns)
        one = place & (rng.random((*shape[:2], 1)) < 0.6 * mean)
        filled = np.where(single, one, rng.random(shape) < mean / columns)
        return np.where(filled, np.where(rng.random(shape) < signed, -1, 1), 0).astype(np.int64)

    means = (0.4, 0.7, 1.0, 1.5)
    drawn = sparse(n, n, means), sparse(m, n, means).transpose(0, 2, 1), sparse(p, n, means), sparse(p, m, (0, 0.3, *means))
    A, F, C, G = (lifted(one, box.field.degree) for one in drawn)
    return Batch(A, F, C, G, box.prime, number_field=box.number_field)
