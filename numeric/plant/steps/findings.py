"""What `identify` has found: the model, the residual, the count of faults, their space and signal, and what a user must know.

Findings         the record; None stands for what was not asked because of what came before
COUNTED_BY       what a count can rest on
"""

from __future__ import annotations

from dataclasses import dataclass

from ....base.arrays import Array
from ...data.records import Record
from ...method.model.moesp_model import MoespModel
from ...method.model.order_evidence import OrderEvidence
from ...method.model.reduced_model import ReducedModel
from ...method.model.residuals import ResidualSignal
from ...method.ranks.rank_gap import FaultDimension
from ...method.rows.fault_count import FaultCount
from ...method.signal.reconstruction import Reconstruction
from ...method.signal.residual_sizes import ResidualSizes
from ...method.space.by_ranks import FaultSpaceEstimate
from ...method.space.isolation import Isolation
from ...method.space.shift_isolation import ShiftIsolation
from ..changes.onset import FaultOnset
from ..changes.table import Changes
from ..doubt.listing import Doubts
from ..healthy.against_healthy import FaultsAgainstHealthy
from ..healthy.mean_shift import MeanShift
from .operating_point import ZERO, OperatingPoint

COUNTED_BY = ("given", "model", "healthy samples", "residual alone", "outputs and inputs")
"""An n_v rests on one of these: the user, a model that explains everything, or one of the three ways of counting."""


@dataclass(frozen=True, eq=False, repr=False)
class Findings:
    """This is what `identify` has found so far. A field is None where it was not asked for, because of what came before.

    The fields are those of `Identification`, which `identify` returns and whose docstring explains them one by one.
    """

    record: Record
    block_rows: int
    operating_point: OperatingPoint
    order_given: bool
    singular_values: Array
    model: MoespModel | ReducedModel | None
    exact: bool = False
    way: str = ""
    residual: ResidualSignal | None = None
    sizes: ResidualSizes | None = None
    held: tuple[int, int] = (0, 0)
    dimension: FaultDimension | None = None
    n_v: int | None = None
    n_v_given: bool = False
    possible: tuple[int, ...] = ()
    count: FaultCount | None = None
    noise_level: Array | None = None
    reason: str = ""
    counted_by: str | None = None
    healthy: int | None = None
    healthy_record: bool = False
    counted_against: tuple[int, int] = (0, 0)
    against: FaultsAgainstHealthy | None = None
    news: int | None = None
    mean: MeanShift | None = None
    changes: Changes | None = None
    visible: Array | None = None
    unexplained: bool = False
    onset: FaultOnset | None = None
    fault_space: FaultSpaceEstimate | None = None
    isolation: Isolation | None = None
    shift_isolation: ShiftIsolation | None = None
    pair: tuple[Array, Array] | None = None
    signal: Reconstruction | None = None
    explained: float | None = None
    by_noise: float | None = None
    notes: tuple[str, ...] = ()
    dt: float | None = None
    doubts: Doubts | None = None
    initial_states: tuple[Array, ...] = ()
    parts: tuple[Findings, ...] = ()

    @property
    def means_removed(self) -> bool:
        """Say whether means were taken off the channels."""
        return self.operating_point.of != ZERO

    @property
    def modelled(self) -> int:
        """Return how many samples, from the first on, the model is from."""
        return self.healthy or len(self.record)

    @property
    def at_least(self) -> int:
        """Return the number of faults that act in any case: the count where there is one; else one where anything stands out, the mean
        and the table of changes included."""
        if self.n_v is not None:
            return self.n_v
        changed = any(one.changes is not None and bool(one.changes.seen) for one in self.experiments)
        counts = (self.against.at_least if self.against else 0, min(self.possible, default=0))
        seen = (*counts, int(self.moved or self.unexplained or changed))
        return max(seen)

    @property
    def experiments(self) -> tuple[Findings, ...]:
        """Return what was found in each experiment: its own record, residual, onset, changes and signal, with the model, the number of
        faults and the space of all. One experiment is its own."""
        return self.parts or (self,)

    @property
    def orders(self) -> OrderEvidence | None:
        """Return the evidence for the order where it was left open and the model is one of `arx_reduction`."""
        return self.model.orders if isinstance(self.model, ReducedModel) else None

    @property
    def moved(self) -> bool:
        """Say whether the mean of the residual left that of the healthy samples."""
        return self.healthy is not None and self.mean is not None and self.mean.shifted is True
