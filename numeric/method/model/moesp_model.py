"""This is what an identification by MOESP returns: the model with the account of its order, or the error that no order could be chosen."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import Shown, counted
from ...data.plain import by_name, plain
from ..plotting import plot_singular_values
from .models import Identified, StateSpaceModel


class OrderUndecided(InvalidData):
    """The error that no order could be chosen, from data that are good enough for a model of a given order [V93].

    `pi_moesp` and `po_moesp` raise it where the singular values have no gap to trust; it is an InvalidData, whose `singular_values`,
    falling and as many as the number of rows of the projected outputs, tell what could be chosen. Raises nothing itself; `identify` never
    raises it.

    >>> import numpy as np
    >>> from faultspace.numeric import OrderUndecided, pi_moesp
    >>> draw = np.random.default_rng(2)
    >>> try:
    ...     pi_moesp(draw.standard_normal((400, 2)), draw.standard_normal((400, 1)), block_rows=5)
    ... except OrderUndecided as error:
    ...     len(error.singular_values)
    5
    """

    def __init__(self, message: str, singular_values: Array) -> None:
        super().__init__(message)
        self.singular_values = singular_values


@dataclass(frozen=True)
class Gap:
    """The singular value of the order is `ratio` times the next; the largest ratio elsewhere stands beside it, and `clean` says whether
    the rule stands behind the order."""

    order: int
    ratio: float
    runner_up: int
    runner_up_ratio: float
    clean: bool


@dataclass(frozen=True, eq=False, repr=False)
class MoespModel(Identified, Shown):
    """The model that PI-MOESP identified [V93], and how far to trust it.

    `model` holds A (n, n), B (n, n_u), C (p, n) and D (p, n_u), which stand here too. `singular_values` are all of step 2, falling, and
    `gap` is that at the order taken. x0 (n,) is the state at the first sample of the (first) experiment, None where no data were read for
    it. `residual_covariance` (p, p) is the mean of r r^T for r = y - simulated y, with the parameters fitted taken off the number of
    samples, or None. `condition_numbers` are "inputs" of [Uf; Up], "observability" of O_(s-1) and "input matrices" of the regression for
    B, D; `route` is that of the compression. `warnings` are what a user must know; an unstable A stands there and is never altered.
    All are in the units of the data. Raises ImportError in `plot()` and `to_control()` where the package that they need is not installed.

    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, pi_moesp
    >>> u = np.random.default_rng(1).standard_normal((400, 1))
    >>> pi_moesp(StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]]).simulate(u), u, block_rows=5)
    <MoespModel: model of order 1, 1 input, 1 output, stable>
    """

    model: StateSpaceModel
    order: int
    singular_values: Array
    gap: Gap
    initial_states: tuple[Array, ...]
    residual_covariance: Array | None
    condition_numbers: dict[str, float]
    route: str
    warnings: tuple[str, ...]

    @property
    def title(self) -> str:
        """Return what the model is, on one short line."""
        stability = "stable" if self.model.is_stable else "NOT stable"
        return f"model of order {self.order}, {counted(self.model.n_u, 'input')}, {counted(self.model.p, 'output')}, {stability}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield what there is to say of it, as pairs of a name and a value."""
        clean = "clean" if self.gap.clean else "NOT clean"
        yield "singular value of the order", f"{self.gap.ratio:.3g} times the next ({clean})"
        yield "largest ratio elsewhere", f"{self.gap.runner_up_ratio:.3g}, at {self.gap.runner_up}"
        yield "moduli of the poles", ", ".join(f"{abs(pole):.4g}" for pole in self.model.poles) or "none"
        if self.residual_covariance is not None:
            deviations = np.sqrt(np.diag(self.residual_covariance))
            yield "standard deviation of the residual", ", ".join(f"{size:.4g}" for size in deviations)
        yield from ((f"condition of the {name}", f"{value:.3g}") for name, value in self.condition_numbers.items())
        yield from (("warning", warning) for warning in self.warnings)

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict: that of the model, how it was found and how far it can be trusted."""
        found = by_name(self, "order", "singular_values", "x0", "residual_covariance", "condition_numbers", "route", "warnings")
        return self.model.to_json() | found | {"order_gap": plain(self.gap.ratio), "order_gap_clean": self.gap.clean}

    def plot(self, ax: Any = None) -> Any:
        """Draw the singular values and the order into the matplotlib axes `ax`, new ones where None are given, and return them. Raises
        ImportError without matplotlib."""
        return plot_singular_values(self.singular_values, order=self.order, ax=ax)
