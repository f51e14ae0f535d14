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

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ....base.chi_squared import chi_squared_tail
from ....base.sheets import Shown
from ...data.plain import plain
from ..plotting import plot_criteria

REFUSED = 0.01  # the level of a test
WIDTHS = (9, 6, 8, 8, 5)  # of the columns of the table


@dataclass(frozen=True)
class OrderRow:
    """A row has the `cost` of the reduction with its d `parameters`, and `akaike` is the criterion of the choice.

    `cost` is that of the reduction without the inflation by its estimated weight. `chance` bounds the probability of a cost so much larger
    than that of the choice where this order is right, and is one from the choice on.
    `one_step` and `free_run` are 1 - |error| / |y| on samples held back, with channels scaled to equal size, of the one-step prediction and
    of the simulation with fitted initial state, NaN where there were too few. `gap` is the ratio of singular value n to the next of the
    weighted Hankel matrix of the ARX plant, NaN for order 0 and where the matrix ends, whose size alone makes the last ones small. `poles`
    are those of the model of this order from the whole record, by falling modulus.
    """

    order: int
    cost: float
    parameters: int
    chance: float
    one_step: float
    free_run: float
    gap: float
    poles: tuple[complex, ...] = ()

    @property
    def akaike(self) -> float:
        """Return cost + 2 d."""
        return self.cost + 2 * self.parameters


@dataclass(frozen=True, repr=False)
class OrderEvidence(Shown):
    """What the data say of the order of the model, where it was left open.

    `rows` is a list of OrderRow, one an order; `best` is the order chosen, by Akaike's criterion [A74], and `least` to `most` are the
    orders that the data leave open: `least` is the least that is not refused at a level of 1 %, and `most` is `best`. More states than
    that may be there and be too weak to show. Look at `decided` first, then at the table of `summary()`: where several orders are open
    and the fit to samples held back is equal, the least of them is the simpler model. Raises ImportError in `plot()` without matplotlib.

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
        """This tells whether one order alone is left."""
        return self.least == self.most

    @property
    def title(self) -> str:
        """Return the answer, on one short line."""
        left = "the only one left open" if self.decided else f"left open: {self.least} to {self.most}"
        return f"order {self.best}, {left}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield one line an order: Akaike's criterion, the chance of so large a cost, both fits and the gap in the singular values."""
        columns = ("akaike", "chance", "one-step", "free-run", "gap")
        yield "", " ".join(f"{name:>{width}}" for name, width in zip(columns, WIDTHS, strict=True))
        for row in self.rows:
            gap = f"{row.gap:.0e}" if row.gap >= 1000 else f"{row.gap:.1f}"
            texts = (f"{row.akaike:.4g}", _chance(row.chance), f"{row.one_step:.4f}", f"{row.free_run:.4f}", gap)
            values = ["-" if text == "nan" else text for text in texts]
            name = f"order {row.order}{', taken' if row.order == self.best else ''}"
            yield name, " ".join(f"{value:>{width}}" for value, width in zip(values, WIDTHS, strict=True))

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict: the choice, the range left open and the rows; null stands for a fit or gap that there is not."""
        names = ("cost", "parameters", "akaike", "chance", "one_step", "free_run", "gap")
        rows = [
            {"order": row.order} | {name: plain(getattr(row, name)) for name in names} | {"poles": [plain(pole) for pole in row.poles]}
            for row in self.rows
        ]
        return {"best": self.best, "least": self.least, "most": self.most, "decided": self.decided, "rows": rows}

    def plot(self, ax: Any = None) -> Any:
        """Draw the criterion above its least value by order, the orders left open shaded, into the matplotlib axes `ax`, new ones where
        None are given, and return them. Raises ImportError without matplotlib."""
        curves = {"Akaike": [row.akaike for row in self.rows]}
        return plot_criteria([row.order for row in self.rows], curves, taken=self.best, open_range=(self.least, self.most), ax=ax)


def _chance(chance: float) -> str:
    """Return a probability in six characters at most."""
    return f"{chance:.2g}" if chance >= 1e-3 or chance == 0 else f"{chance:.0e}"


def weighed(rows: Sequence[OrderRow]) -> OrderEvidence:
    """Return the evidence of rows by rising order, one at least, whose chances are still to be filled in."""
    best = min(rows, key=lambda row: row.akaike)
    chances = [1.0] * len(rows)
    for above, row in enumerate(reversed(rows)):
        if row.order < best.order:
            gain, states = max(row.cost - best.cost, 0.0), best.parameters - row.parameters
            chances[len(rows) - 1 - above] = min(above * chi_squared_tail(gain, states), 1.0)
    filled = tuple(replace(row, chance=chance) for row, chance in zip(rows, chances, strict=True))
    least = min(row.order for row in filled if row.chance >= REFUSED)
    return OrderEvidence(filled, best.order, least, best.order)
