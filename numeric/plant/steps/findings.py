"""What the steps of `identify` find, a record a step, each complete when it is made:

    Measured -> Modelled -> Explained -> Counted -> Space -> Causes -> Signals -> Answer

Measured     the record about its operating point, and what was stated of it
Modelled     the model, or that its order stays open (`modelling`)
Explained    the residual of the model beside the record, of all samples and of each experiment
Begun        of one experiment: the samples from which on its residual is another one
Count        a number of faults: what remains possible, what it rests on, and because of what
Counted      the count, with all the evidence that was asked for
Space        the space of fault columns
Causes       of one experiment: what single sensors and actuators are to the space and to a shift of the mean
Signals      F, G and the signal of each experiment
Answer       all of it, under the names that people ask for; None stands for what was not asked because of what came before
Reason       a code and its numbers; `words` makes the sentences, last
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum, auto
from typing import Any

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
from ...method.space.estimate import FaultSpaceEstimate
from ...method.space.isolation import Isolation
from ...method.space.shift_isolation import ShiftIsolation
from ..changes.onset import FaultOnset
from ..changes.table import Changes
from ..doubt.listing import Doubts
from ..healthy.against_healthy import FaultsAgainstHealthy
from ..healthy.mean_shift import MeanShift
from .operating_point import ZERO, OperatingPoint


class CountedBy(StrEnum):
    """What a number of faults rests on: the user, a model that explains everything, or one of the three ways of counting."""

    GIVEN = "given"
    MODEL = "model"
    HEALTHY = "healthy samples"
    RANKS = "residual alone"
    LAWS = "outputs and inputs"


class Because(StrEnum):
    """Why a number of faults is what it is, or stays open; `words` has the clause of each."""

    EXPLAINED = auto()
    GIVEN = auto()
    RANKS = auto()
    LAWS = auto()
    AGAINST_HEALTHY = auto()
    UNEQUAL_NUMBERS = auto()
    AS_MANY_AS_OUTPUTS = auto()
    COPIES = auto()
    RANKS_SHOW_FAULTS = auto()
    SPIKES = auto()
    CONSTANT_UNSEEN = auto()
    WENT_WITH_MEANS = auto()
    NOT_ABOUT_ZERO = auto()
    UNLIKE_HEALTHY = auto()
    FORETOLD = auto()
    LAWS_BROKEN = auto()
    UNEXPLAINED = auto()
    MEAN_MOVED = auto()
    MEAN_OPEN = auto()
    MEAN_STAYED = auto()
    CHANGED = auto()
    CHANGE_OPEN = auto()
    HEALTHY_RANKS_ALIKE = auto()
    NO_CHANGE_SEEN = auto()


@dataclass(frozen=True)
class Reason:
    """A code with its numbers, and what the record that it rests on says itself."""

    code: Because
    numbers: Mapping[str, Any] = field(default_factory=dict)
    said: str = ""

    def to_json(self) -> dict[str, Any]:
        """Return the code and its numbers; what was `said` stands where it is from."""
        return {"code": str(self.code), **self.numbers}


@dataclass(frozen=True)
class Count:
    """A number of faults, None where it is undecided; `possible` are the numbers that remain, `because` the reasons, each of which goes
    beyond those before."""

    n_v: int | None
    possible: tuple[int, ...]
    by: CountedBy | None
    because: tuple[Reason, ...]

    def but(self, reason: Reason, possible: tuple[int, ...] | None = None) -> Count:
        """Return the count left open for this reason, with what remains possible, which stays as it was unless it is told."""
        return Count(None, self.possible if possible is None else possible, None, (*self.because, reason))

    def also(self, reason: Reason) -> Count:
        """Return the same count with one reason more."""
        return Count(self.n_v, self.possible, self.by, (*self.because, reason))


@dataclass(frozen=True, eq=False)
class Measured:
    """The record about its operating point; the first `healthy` samples are stated to be without fault, and came in a record of their own
    where `healthy_record`; `noise_level` (p,) was stated."""

    record: Record
    operating_point: OperatingPoint
    healthy: int | None
    healthy_record: bool
    noise_level: Array | None

    @property
    def part(self) -> Record:
        """Return the samples that the model is from."""
        return self.record if self.healthy is None else self.record.beginning(self.healthy)

    @property
    def means_removed(self) -> bool:
        """Say whether means were taken off the channels."""
        return self.operating_point.of != ZERO


@dataclass(frozen=True, eq=False)
class Modelled:
    """The model, or None with the `refusal`, with singular values and the window that they belong to; `exact` says that the record has no
    noise."""

    model: MoespModel | ReducedModel | None
    singular_values: Array
    window: int
    exact: bool
    way: str
    notes: tuple[str, ...] = ()
    refusal: str = ""


@dataclass(frozen=True, eq=False)
class Explained(Measured):
    """What the model leaves of a record: the residual with the sizes of its channels; faults are counted on the samples `held`. A `part` is
    an experiment, behind the healthy samples where these came before it; one experiment has no parts, it is its own."""

    model: MoespModel | ReducedModel
    exact: bool
    block_rows: int
    residual: ResidualSignal
    sizes: ResidualSizes
    held: tuple[int, int]
    initial_states: tuple[Array, ...]
    parts: tuple[Explained, ...]

    @property
    def experiments(self) -> tuple[Explained, ...]:
        """Return the parts, or this where it is one experiment."""
        return self.parts or (self,)


@dataclass(frozen=True, eq=False)
class Begun:
    """The samples from which on the residual of an experiment is another one, or None with a note why they were not looked for."""

    onset: FaultOnset | None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Counted:
    """The count on the samples `held`, and the evidence, None where it was not asked for: the ranks and the count against the healthy
    samples, each with what became of it, the laws, the mean, and the table of changes of each experiment."""

    count: Count
    held: tuple[int, int]
    notes: tuple[str, ...] = ()
    changes: tuple[Changes | None, ...] = ()
    ranks: FaultDimension | None = None
    by_ranks: Count | None = None
    laws: FaultCount | None = None
    mean: MeanShift | None = None
    against: FaultsAgainstHealthy | None = None
    by_healthy: Count | None = None
    against_samples: tuple[int, int] = (0, 0)
    news: int | None = None
    visible: Array | None = None
    unexplained: bool = False


@dataclass(frozen=True, eq=False)
class Space:
    """The space of fault columns, None where there is none, with what must be known of it."""

    estimate: FaultSpaceEstimate | None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Causes:
    """What single sensors and actuators are to the space, and in each experiment to a shift of the mean."""

    isolation: Isolation | None
    shifts: tuple[ShiftIsolation | None, ...]


@dataclass(frozen=True, eq=False)
class Signal:
    """The signal of one experiment for columns F, G out of the space, with the share of the residual that it explains and what it would of
    noise; None where it was not asked for, or is withheld."""

    reconstruction: Reconstruction | None
    explained: float | None
    by_noise: float | None
    notes: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Signals:
    """F (n, n_v), G (p, n_v), one choice out of the space, and the signal of each experiment."""

    pair: tuple[Array, Array] | None
    each: tuple[Signal, ...]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False, repr=False)
class Answer:
    """All that `identify` found, made once, when the last step is done. A field is None where it was not asked for, because of what came
    before. The fields are those of `Identification`, whose docstring explains them one by one."""

    record: Record
    block_rows: int
    operating_point: OperatingPoint
    order_given: bool
    singular_values: Array
    model: MoespModel | ReducedModel | None
    exact: bool
    way: str
    residual: ResidualSignal | None
    sizes: ResidualSizes | None
    held: tuple[int, int]
    dimension: FaultDimension | None
    n_v: int | None
    n_v_given: bool
    possible: tuple[int, ...]
    because: tuple[Reason, ...]
    reason: str
    counted_by: str | None
    count: FaultCount | None
    noise_level: Array | None
    healthy: int | None
    healthy_record: bool
    counted_against: tuple[int, int]
    against: FaultsAgainstHealthy | None
    news: int | None
    mean: MeanShift | None
    changes: Changes | None
    visible: Array | None
    unexplained: bool
    onset: FaultOnset | None
    fault_space: FaultSpaceEstimate | None
    isolation: Isolation | None
    shift_isolation: ShiftIsolation | None
    pair: tuple[Array, Array] | None
    signal: Reconstruction | None
    explained: float | None
    by_noise: float | None
    notes: tuple[str, ...]
    dt: float | None
    doubts: Doubts | None
    initial_states: tuple[Array, ...]
    parts: tuple[Answer, ...]

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
    def experiments(self) -> tuple[Answer, ...]:
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
