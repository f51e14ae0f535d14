"""The hypotheses of proposition-1: how u and v may be correlated, controllability and observability, colour of u.

    Driven          an experiment with certified limits, as a subject
    consistency     PI-MOESP gives the range of O_s, and both regressions the true B and D
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

from ...exact.population_limits import population_limits
from ..ablation import Experiment, Found
from ..claims.proposition_1 import BOX, MOVING_AVERAGE, WHITE, drives, show_words
from ..experiments_tried import Drive, LimitDossier, certificates_of, examine_experiment, experiments_in_order, following, independent_white
from ..workbench import Workbench


@dataclass(frozen=True)
class Driven:
    """An experiment with what accepted certificates say of it."""

    record: LimitDossier

    @property
    def size(self) -> tuple[int, ...]:
        """n + m + p + nu, then n, m, p, nu."""
        system = self.record.experiment.system
        r = system.residual
        return (r.n + r.m + r.p + system.nu, r.n, r.m, r.p, system.nu)

    @property
    def weight(self) -> int:
        """One."""
        return 1

    @property
    def field(self) -> str:
        """Always Q."""
        return "Q"

    @property
    def accepted(self) -> int:
        """Accepted certificates."""
        return self.record.accepted

    def __str__(self) -> str:
        return show_words(self.record)


HYPOTHESES: dict[str, Callable[[Driven], bool]] = {
    "v(k), u(k-l) uncorrelated, l >= 1": lambda x: x.record.past_lags,
    "v(k), u(k) uncorrelated": lambda x: x.record.same_time,
    "v(k), u(k+l) uncorrelated, l >= 1": lambda x: x.record.leads,
    "(A, B) controllable": lambda x: x.record.controllable,
    "(A, C) observable on s - 1": lambda x: x.record.observable,
    "past >= n": lambda x: x.record.long_past,
    "u white": lambda x: x.record.white,
}


def consistency() -> Experiment[Driven]:
    """A, C from the limit of rank n, B and D by either regression."""
    return Experiment(
        name="consistency",
        claim="proposition-1",
        conclusion="PI-MOESP converges to the true A, B, C, D",
        hypotheses=HYPOTHESES,
        holds=_right,
        subjects=lambda bench: (Driven(record) for record in bench.limits),
        over_q=_smallest,
        show=lambda subject: certificates_of(population_limits(subject.record.experiment)),
    )


def _right(subject: Driven) -> bool:
    d = subject.record
    return d.equal and d.limit_rank == d.experiment.system.residual.n and d.inputs_right


def _smallest(bench: Workbench, dropped: Sequence[str]) -> Found[Driven]:
    kept = [test for name, test in HYPOTHESES.items() if name not in dropped]
    tried: list[Drive] = [independent_white, partial(following, gain="1"), *drives([WHITE, MOVING_AVERAGE], [["1"], ["0", "1"]])]
    if set(dropped) <= {"past >= n", "u white"}:
        return Found(None, "n = 1, where past >= n always")  # and the colour of u is not needed
    box = f"{BOX}, v white of its own, u(k-1), u(k) or u(k+1), u white or e(k) + e(k-1)/2"
    for experiment in experiments_in_order(tried):
        subject = Driven(examine_experiment("search", experiment))
        if all(test(subject) for test in kept) and not _right(subject):
            return Found(subject, box)
    return Found(None, box)
