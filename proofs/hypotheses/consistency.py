"""These are the hypotheses of proposition-1: how u and v may be correlated, controllability and observability, colour of u.

    Driven                 an experiment with certified limits, as a subject
    consistency            the limit of PI-MOESP carries the true A and C, and both regressions the true B and D; u is white
    consistency_coloured   the same; u is autoregressive of order at most s, white or not

That the limit carries A and C is decided on its state part: the (A, C) that is read off its columns, similar to the true one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from operator import attrgetter

from ...exact.algebra.fields import QQ
from ...exact.algebra.matrices import Matrix
from ...exact.limits.experiments import Experiment
from ...exact.limits.moesp import limit
from ...exact.system.systems import ResidualSystem
from ..claims.experiments import show_words
from ..evidence.experiments import LIMITS, LimitEvidence, examine_experiment, first_look
from ..evidence.material import Material
from ..trust import structure_certificates as make
from ..trust.limit_certificates import certificates_of
from ..trust.structure_certificates import Certificate
from ..verdict.ablation import Ablation, Found, first_found
from ..verdict.workbench import Workbench
from .aimed_experiments import BOX, aimed_experiments, small_experiments
from .changes_of_state import similarity
from .facets import degenerate


@dataclass(frozen=True)
class Driven:
    """An experiment with certified limits, as a subject.

    `record` is what accepted certificates say of it; `model_right` says that the limit carries A and C, and `autoregressive` that u is so,
    of order at most s.
    """

    record: LimitEvidence
    model_right: bool
    autoregressive: bool

    @property
    def size(self) -> tuple[int, ...]:
        """The numbers n + m + p + nu, then n, m, p, nu, s, past, then how long the experiment is in words."""
        e = self.record.experiment
        r, nu = e.system.residual, e.system.nu
        return (r.n + r.m + r.p + nu, r.n, r.m, r.p, nu, e.s, e.past, len(str(self)))

    @property
    def weight(self) -> int:
        """An experiment stands for itself alone."""
        return 1

    @property
    def field(self) -> str:
        """An experiment is always over Q."""
        return "Q"

    @property
    def accepted(self) -> frozenset[str]:
        """The accepted certificates, by their SHA-256."""
        return self.record.accepted

    @cached_property
    def degenerate(self) -> str:
        """Why it would be a poor witness: its system is one, its B is zero, or the weighting of a limit of higher rank decides."""
        weighted = self.record.limit_rank > self.record.experiment.system.residual.n and self.record.inputs_right
        return _degenerate(self.record.experiment) or (WEIGHTED if weighted else "")

    def __str__(self) -> str:
        return show_words(self.record)


WEIGHTED = "the limit has a rank above n, and B and D are right: its n leading singular vectors, in some weighting, may carry A and C"
UNCORRELATED: dict[str, Callable[[Driven], bool]] = {
    "v(k), u(k-l) uncorrelated, l >= 1": lambda x: x.record.past_lags,
    "v(k), u(k) uncorrelated": lambda x: x.record.same_time,
    "v(k), u(k+l) uncorrelated, l >= 1": lambda x: x.record.leads,
    "(A, B) controllable": lambda x: x.record.controllable,
    "(A, C) observable on s - 1": lambda x: x.record.observable,
    "past >= n": lambda x: x.record.long_past,
}


def consistency() -> Ablation[Driven]:
    """Return the ablation with the hypothesis that is usually made, u white."""
    return _ablation("consistency", {**UNCORRELATED, "u white": lambda x: x.record.white})


def consistency_coloured() -> Ablation[Driven]:
    """Return the ablation with the weaker hypothesis that is enough, u autoregressive of order at most s."""
    return _ablation("consistency-coloured", {**UNCORRELATED, "u autoregressive of order at most s": lambda x: x.autoregressive})


def _ablation(name: str, hypotheses: Mapping[str, Callable[[Driven], bool]]) -> Ablation[Driven]:
    return Ablation(
        name=name,
        claim="proposition-1",
        conclusion="PI-MOESP converges to the true A, B, C, D",
        hypotheses=hypotheses,
        holds=_right,
        subjects=_subjects,
        over_q=partial(_smallest, hypotheses),
        show=_show,
    )


def driven(record: LimitEvidence) -> Driven:
    """Return the subject that is made of an experiment with certified limits."""
    state, residual = record.state, record.experiment.system.residual
    read = None if state is None else similarity(_without_faults(residual), _model(state.A, state.C))
    return Driven(record, read is not None, record.predicted)


def _subjects(bench: Workbench) -> Iterator[Driven]:
    bench.need(LIMITS, AIMED, SMALL)
    yield from bench.material(DRIVEN)
    yield from bench.material(AIMED)


def _aimed(bench: Workbench) -> Iterator[Experiment]:
    return aimed_experiments(400 if bench.full else 8)


def _examined_aimed(experiment: Experiment) -> Driven:
    return driven(examine_experiment("aimed", experiment))


def _small(bench: Workbench) -> Iterator[Experiment]:
    return small_experiments()


def _looked_at(experiment: Experiment) -> Driven:
    return driven(first_look(experiment))


DRIVEN = Material("driven", "reading population limits", attrgetter("limits"), driven, 20)
AIMED = Material("aimed experiments", "population limits, aimed", _aimed, _examined_aimed, 10)
SMALL = Material("small experiments", "a first look at small experiments", _small, _looked_at, 10)


def _smallest(hypotheses: Mapping[str, Callable[[Driven], bool]], bench: Workbench, dropped: Sequence[str]) -> Found[Driven]:
    kept = [test for name, test in hypotheses.items() if name not in dropped]
    looks = bench.material(SMALL)

    def fails(subject: Driven, poor: bool) -> bool:
        return bool(subject.degenerate) == poor and all(test(subject) for test in kept) and not _right(subject)

    def counterexamples(poor: bool) -> Iterator[Driven]:
        for look in looks:
            # What a first look says is not believed: the subject that it leads to is what accepted certificates say of the experiment.
            if fails(look, poor) and fails(subject := driven(bench.examined_experiment(look.record.experiment)), poor):
                yield subject

    return first_found(counterexamples, BOX)


def _right(subject: Driven) -> bool:
    return subject.model_right and subject.record.inputs_right


def _degenerate(experiment: Experiment) -> str:
    return degenerate(experiment.system.residual) or ("B = 0" if experiment.system.B.is_zero() else "")


def _model(A: Matrix, C: Matrix) -> ResidualSystem:
    return ResidualSystem(A, Matrix.zero(QQ, A.nrows, 0), C, Matrix.zero(QQ, C.nrows, 0))


def _without_faults(system: ResidualSystem) -> ResidualSystem:
    return _model(system.A, system.C)


def _show(subject: Driven) -> Iterator[Certificate]:
    """Certificates of the limits, the regressions, and the rank of O_(s-1), which must be n for A to be read."""
    experiment = subject.record.experiment
    yield from certificates_of(limit(experiment))
    if experiment.s > 1:
        yield make.matrix_rank("window", _without_faults(experiment.system.residual), window=experiment.s - 1)
