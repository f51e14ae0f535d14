"""Weigh the evidence for an order: what the data say of each, and which orders they leave open.

The reduction's cost at order n is the likelihood ratio against the ARX plant, so that with d = n (p + n_u) + p n_u parameters orders are
compared by two criteria, which err on opposite sides:

    cost + d log N    [S78]: differences approximate twice the logarithm of the odds between two orders; states that the data hardly
                      show are left out
    cost + 2 d        [A74]: the least expected divergence from the truth; a state too many is taken now and then

The range left open runs from the least order among the fewest that hold LEVEL of the odds in a row around the best, to the greatest of
those and of the order that the second criterion takes. That one is the choice: a state too many costs little, one too few much. Where
the range is one order, the order is decided. Beside the criteria stand fits of models made of the first part of the data to the part held
back, and the gap in the singular values, which users know: they take no part in the choice.

OrderRow        an order with its figures
OrderEvidence   all rows, the best order, and the range left open
weighed         the evidence of rows
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

LEVEL = 0.95


@dataclass(frozen=True)
class OrderRow:
    """A row has the `cost` of the reduction with its d `parameters`; `schwarz` is the first criterion and `akaike` the second.

    `odds` is the share among all rows by `schwarz`. `one_step` and `free_run` are 1 - |error| / |y| on samples held back, with channels
    scaled to equal size, of the one-step prediction and of the simulation with fitted initial state, NaN where there were too few. `gap` is
    the ratio of singular value n to the next of the weighted Hankel matrix of the ARX plant, NaN for order 0.
    """

    order: int
    cost: float
    parameters: int
    schwarz: float
    odds: float
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
    orders that the data leave open, from what the odds by Schwarz's criterion [S78] suggest. Printed, it is a table. Raises nothing.

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
        lines = [f"{'order':>5} {'schwarz':>12} {'akaike':>12} {'odds':>6} {'one-step':>9} {'free-run':>9} {'gap':>9}"]
        for row in self.rows:
            fits = f"{row.one_step:>9.4f} {row.free_run:>9.4f} {row.gap:>9.3g}"
            lines.append(f"{row.order:>5} {row.schwarz:>12.6g} {row.akaike:>12.6g} {row.odds:>6.3f} {fits}")
        return "\n".join(lines)


def weighed(rows: Sequence[OrderRow]) -> OrderEvidence:
    """Return the evidence of rows by rising order, one at least, whose odds are still to be filled in."""
    criteria = np.array([row.schwarz for row in rows])
    odds = np.exp(-(criteria - criteria.min()) / 2)
    odds /= odds.sum()
    low = high = int(np.argmin(criteria))
    while odds[low : high + 1].sum() < LEVEL:
        below = odds[low - 1] if low > 0 else -1.0
        above = odds[high + 1] if high + 1 < len(odds) else -1.0
        low, high = (low - 1, high) if below > above else (low, high + 1)
    best = int(np.argmin([row.akaike for row in rows]))
    filled = tuple(replace(row, odds=float(share)) for row, share in zip(rows, odds, strict=True))
    return OrderEvidence(filled, rows[best].order, rows[min(low, best)].order, rows[max(high, best)].order)
