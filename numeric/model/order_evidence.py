"""Weigh the evidence for an order: what the data say of each, and which orders they leave open.

The reduction's cost at order n is the likelihood ratio against the ARX plant, so that with d = n (p + n_u) + p n_u parameters [A74]

    cost + 2 d

is least, on average, where the expected divergence from the truth is: that order is the choice. A state whose gain is less is better left
out, be it there or not; one too many is taken now and then, which costs little.

The range left open runs from the least order that is not refused to the choice. An order is refused where its cost exceeds that of the
choice by more than chance does in one record of a hundred. The gain of k states that are not there is chi-squared with k (p + n_u)
degrees of freedom, about [D87], and any of the orders tried may be the choice, so that the chances of all of them add up, at most;
`python benchmarks/at_the_bound.py --orders` counts how often the true order is refused in simulated records. There is no
upper end of that kind, for any model could have more states which these data hardly show [D88]: beyond the choice, the data say no more
than that they show none worth having. Where the range is one order, the order is decided. Beside the criterion stand fits of models made of
the first part of the data to the part held back, and the gap in the singular values, which users know: they take no part in the choice.

OrderRow        an order with its figures
OrderEvidence   all rows, the best order, and the range left open
weighed         the evidence of rows
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from scipy.stats import chi2

REFUSED = 0.01


@dataclass(frozen=True)
class OrderRow:
    """A row has the `cost` of the reduction with its d `parameters`, and `akaike` is the criterion of the choice.

    `cost` is that of the reduction without the inflation by its estimated weight. `chance` bounds the probability of a cost so much larger
    than that of the choice where this order is right, and is one from the choice on.
    `one_step` and `free_run` are 1 - |error| / |y| on samples held back, with channels scaled to equal size, of the one-step prediction and
    of the simulation with fitted initial state, NaN where there were too few. `gap` is the ratio of singular value n to the next of the
    weighted Hankel matrix of the ARX plant, NaN for order 0.
    """

    order: int
    cost: float
    parameters: int
    chance: float
    one_step: float
    free_run: float
    gap: float

    @property
    def akaike(self) -> float:
        """Return cost + 2 d."""
        return self.cost + 2 * self.parameters


@dataclass(frozen=True)
class OrderEvidence:
    """What the data say of the order of the model, where it was left open.

    `rows` is a list of OrderRow, one an order; `best` is the order chosen, by Akaike's criterion [A74], and `least` to `most` are the
    orders that the data leave open: `least` is the least that is not refused at a level of 1 %, and `most` is `best`. More states than
    that may be there and be too weak to show. Printed, it is a table. Raises nothing.

    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, arx_reduction
    >>> u, noise = np.random.default_rng(1).standard_normal((2, 400, 1))
    >>> y = StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]]).simulate(u) + 0.1 * noise
    >>> evidence = arx_reduction(y, u).orders
    >>> evidence.least <= evidence.best <= evidence.most, evidence.rows[0].order
    (True, 0)
    """

    rows: tuple[OrderRow, ...]
    best: int
    least: int
    most: int

    @property
    def decided(self) -> bool:
        """Whether one order alone is left."""
        return self.least == self.most

    def __str__(self) -> str:
        """The table, one line an order."""
        lines = [f"{'order':>5} {'cost':>12} {'akaike':>12} {'chance':>9} {'one-step':>9} {'free-run':>9} {'gap':>9}"]
        for row in self.rows:
            figures = f"{row.chance:>9.2g} {row.one_step:>9.4f} {row.free_run:>9.4f} {row.gap:>9.3g}"
            lines.append(f"{row.order:>5} {row.cost:>12.6g} {row.akaike:>12.6g} {figures}")
        return "\n".join(lines)


def weighed(rows: Sequence[OrderRow]) -> OrderEvidence:
    """Return the evidence of rows by rising order, one at least, whose chances are still to be filled in."""
    best = min(rows, key=lambda row: row.akaike)
    chances = [1.0] * len(rows)
    for above, row in enumerate(reversed(rows)):
        if row.order < best.order:
            gain, states = max(row.cost - best.cost, 0.0), best.parameters - row.parameters
            chances[len(rows) - 1 - above] = min(above * float(chi2.sf(gain, states)), 1.0)
    filled = tuple(replace(row, chance=chance) for row, chance in zip(rows, chances, strict=True))
    least = min(row.order for row in filled if row.chance >= REFUSED)
    return OrderEvidence(filled, best.order, least, best.order)
