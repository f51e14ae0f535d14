"""This is what a check of a claim has at hand, and the ways in which it comes to a verdict.

Workbench     the effort of the run and the certified material, made once and on demand: corpus, pairs, alternatives, limits
certify       the statement on every system of the corpus that meets the hypotheses: CERTIFIED, or REFUTED by the smallest that fails
refute        the smallest counterexample in a box, found by search: REFUTED, or what `certify` says when there is none
witnessed     the opposite of a statement, by the counterexample to it
counterexample, certify_records    the outcome of a search, and of a statement on pairs, alternatives or experiments
accepted      certificates, each put before the checker once more: headline certificates are never shown unchecked
all_accepted  the distinct certificates that several pieces of evidence rest on
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeVar
from uuid import uuid4

from ...base.progress import Progress
from ...exact.limits.experiments import Experiment
from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box, Sizes, in_order
from ..evidence.alternatives import ALTERNATIVES, PAIRS, AlternativeEvidence, PairEvidence
from ..evidence.corpus import CORPUS, ByQuestion, Evidence, Questions, describe, examine, together
from ..evidence.experiments import LIMITS, LimitEvidence, examine_experiment, first_look
from ..evidence.material import Made, Material, Packed, Shelf, Wanted, loaded, made
from ..evidence.pairs_by_polynomial import PAIRS_BY_POLYNOMIAL, PairByPolynomial
from ..quantities.batches import Batch
from ..trust.structure_certificates import Certificate, accept
from .verdicts import Outcome, Verdict

Show = Callable[[ResidualSystem], Iterable[Certificate]]
Test = Callable[[Evidence], bool]
Item = TypeVar("Item", PairEvidence, AlternativeEvidence, PairByPolynomial, LimitEvidence)


@dataclass
class Workbench:
    """The effort ("quick" or "full"), the number of processes, where progress goes, and the certified material of a run.

    Where there is a `shelf`, material is read from there, and `Wanted` is raised for what is not there; else it is made here.
    """

    effort: str
    jobs: int
    progress: Progress
    shelf: Shelf | None = None

    def corpus(self, questions: Questions) -> tuple[Evidence, ...]:
        """Return single systems with what accepted certificates answer to these questions."""
        return self.answers(CORPUS, questions)

    @cached_property
    def pairs(self) -> tuple[PairEvidence, ...]:
        """Pairs of systems with accepted certificates."""
        return self.material(PAIRS)

    @cached_property
    def alternatives(self) -> tuple[AlternativeEvidence, ...]:
        """Systems with other fault matrices for the same (A, C)."""
        return self.material(ALTERNATIVES)

    @cached_property
    def pairs_by_polynomial(self) -> tuple[PairByPolynomial, ...]:
        """Pairs (Fhat P, Ghat P) with D(q; P) and accepted certificates."""
        return self.material(PAIRS_BY_POLYNOMIAL)

    @cached_property
    def limits(self) -> tuple[LimitEvidence, ...]:
        """Experiments with certified population limits."""
        return self.material(LIMITS)

    def material(self, kind: Material) -> tuple[Any, ...]:
        """Return certified material of a kind, made or read the first time it is asked for. Raises what its making raised."""
        if kind.name not in self._made:
            if self.shelf is None:
                if kind.name not in self._packed:
                    self.make([kind])
                self._take(self._packed[kind.name])
            elif kind.name in self.shelf:
                self._take(self.shelf[kind.name])
            else:
                raise Wanted(kind)
        found = self._made[kind.name]
        if isinstance(found, Exception):
            raise found
        return found

    def answers(self, systems: ByQuestion, questions: Questions) -> tuple[Evidence, ...]:
        """Return the evidence on some systems with the answers to these questions, and no other; what is missing is made all at once."""
        kinds = [systems[question] for question in questions]
        self.need(*kinds)
        missing = [kind for kind in kinds if kind.name not in self._made and kind.name not in self._packed]
        if self.shelf is None and missing:
            self.make(missing)
        return together([self.material(kind) for kind in kinds], questions)

    def put_answers(self, systems: ByQuestion, found: Sequence[Evidence]) -> None:
        """Take this as the evidence on some systems, for every question."""
        for kind in systems.values():
            self.put(kind, found)

    def put(self, kind: Material, found: Sequence[Any]) -> None:
        """Take this as the material of a kind."""
        self._made[kind.name] = tuple(found)

    def _take(self, packed: Packed) -> None:
        """Load what was made, but for kinds that are there already."""
        self._made.update({**loaded(packed), **self._made})

    def need(self, *kinds: Material) -> None:
        """Raise `Wanted` for those of the kinds that are not on the shelf, so that they are made together and not one after the other."""
        if self.shelf is not None:
            missing = [kind for kind in kinds if kind.name not in self._made and kind.name not in self.shelf]
            if missing:
                raise Wanted(*missing)

    def make(self, kinds: Sequence[Material], shelf: Shelf | None = None) -> None:
        """Make material of these kinds, all of it at once, and put it on a shelf for other processes too where one is given."""
        for packed in made(kinds, self, self.jobs, self.progress, uuid4().hex if shelf is None else shelf.run):
            self._packed |= dict.fromkeys(packed.names, packed)
            if shelf is not None:
                shelf.put(packed)

    @property
    def corpus_in_words(self) -> str:
        """This says how the corpus was made, with counts; it is empty where no claim of the run asked for it."""
        for kind in CORPUS.values():
            if kind.name in self._made or kind.name in self._packed:
                with suppress(Exception):  # the error of its making, which is for whoever asks for this kind
                    self.material(kind)
                if not isinstance(found := self._made[kind.name], Exception):
                    return describe(found)
        return ""

    def searched(self, box: Box) -> Iterator[Batch]:
        """Yield the systems of a box in order, one of each orbit, with what earlier searches of this run found out about them."""
        for sizes in box.sizes():
            if sizes not in self._searched:
                self._searched[sizes] = [stretch.batch for stretch in box.stretches(sizes, reduced=True)]
            yield from self._searched[sizes]

    def examined(self, system: ResidualSystem, questions: Questions) -> Evidence:
        """Return what certificates answer to these questions about a system that a search came upon: several come upon the same."""
        known = self._examined.get(system) or examine("search", system, questions=())
        self._examined[system] = known.asked((*known.answers, *(question for question in questions if question not in known.answers)))
        return self._examined[system].asked(questions)

    def looked_at(self, experiment: Experiment) -> LimitEvidence:
        """Return a first look at an experiment that a search comes upon, taken once."""
        if experiment not in self._looks:
            self._looks[experiment] = first_look(experiment)
        return self._looks[experiment]

    def examined_experiment(self, experiment: Experiment) -> LimitEvidence:
        """Return the evidence on an experiment that a search came upon, made the first time."""
        if experiment not in self._examined_experiments:
            self._examined_experiments[experiment] = examine_experiment("search", experiment)
        return self._examined_experiments[experiment]

    @cached_property
    def _made(self) -> dict[str, Made]:
        return {}

    @cached_property
    def _packed(self) -> dict[str, Packed]:
        """What was made here, of which `_made` has what was asked for."""
        return {}

    @cached_property
    def _searched(self) -> dict[Sizes, list[Batch]]:
        """The systems with the usual entries, by their sizes."""
        return {}

    @cached_property
    def _examined(self) -> dict[ResidualSystem, Evidence]:
        return {}

    @cached_property
    def _examined_experiments(self) -> dict[Experiment, LimitEvidence]:
        return {}

    @cached_property
    def _looks(self) -> dict[Experiment, LimitEvidence]:
        return {}

    @property
    def full(self) -> bool:
        """This says whether this is the run for the background."""
        return self.effort == "full"


def accepted(certificates: Iterable[Certificate]) -> tuple[Certificate, ...]:
    """Return the certificates, each accepted by the checker now. Raises checker.Rejected."""
    found = tuple(certificates)
    for certificate in found:
        accept(certificate)
    return found


def all_accepted(found: Iterable[Evidence | Item]) -> frozenset[str]:
    """Return the certificates that these rest on, by their SHA-256: those that several share once."""
    return frozenset().union(*(one.accepted for one in found))


def size(system: ResidualSystem) -> tuple[int, ...]:
    """Return the numbers n + m + p, then n, m, p: the order in which the smallest is sought."""
    return (system.n + system.m + system.p, system.n, system.m, system.p)


def certify(bench: Workbench, asks: Questions, applies: Test, holds: Test, show: Show) -> Outcome:
    """Return the outcome of the statement `holds` on every system of the corpus to which it applies: CERTIFIED, or REFUTED by the
    smallest. Both tests read the answers to the questions that it asks, and no other.
    """
    tried = [e for e in bench.corpus(asks) if applies(e)]
    failing = sorted((e for e in tried if not holds(e)), key=lambda e: size(e.system))
    if failing:
        system = failing[0].system
        return Outcome(Verdict.REFUTED, f"fails on {system}, the smallest of the corpus", accepted(show(system)), failing[0].accepted)
    if not tried:
        return Outcome(Verdict.ERROR, "no system of the corpus meets the hypotheses")
    total = sum(e.weight for e in tried)
    representative = next((e for e in tried if e.system.n), tried[0]).system
    evidence = f"no counterexample found in {total} systems: {describe(tried)}"
    return Outcome(Verdict.CERTIFIED, evidence, accepted(show(representative)), all_accepted(tried))


def refute(bench: Workbench, box: Box, candidates: str, asks: Questions, applies: Test, holds: Test, show: Show) -> Outcome:
    """Return the smallest system of the box to which the statement applies and on which it fails; else `certify`.

    `candidates` says in the language of claims which systems are looked at; the accepted certificates of each decide.
    """
    for system in in_order(box, candidates, reduced=True):
        evidence = bench.examined(system, asks)
        if applies(evidence) and not holds(evidence):
            return counterexample(str(system), box, show(system))
    return certify(bench, asks, applies, holds, show)


def witnessed(found: Outcome) -> Outcome:
    """Return the outcome of the opposite of a statement, by the counterexample to it: CERTIFIED by one witness, REFUTED where there is
    none, ERROR as it is.
    """
    match found.verdict:
        case Verdict.ERROR:
            return found
        case Verdict.REFUTED:
            return replace(found, verdict=Verdict.CERTIFIED, evidence=f"by one witness: {found.evidence}")
        case _:
            return replace(found, verdict=Verdict.REFUTED, evidence=f"no witness: {found.evidence}")


def counterexample(words: str, box: object, certificates: Iterable[Certificate]) -> Outcome:
    """Return the outcome REFUTED, by these certificates."""
    checked = accepted(certificates)
    return Outcome(Verdict.REFUTED, f"{words}; the smallest with {box}", checked)


def certify_records(
    records: Sequence[Item],
    failing: Sequence[Item],
    words: Callable[[Item], str],
    show: Callable[[Item], Iterable[Certificate]],
    unit: str = "pairs",
) -> Outcome:
    """The same for pairs and alternatives: `records` meet the hypotheses, `failing` are those among them that refute the statement."""
    if failing:
        certificates = accepted(show(failing[0]))
        return Outcome(Verdict.REFUTED, f"fails on {words(failing[0])}", certificates, failing[0].accepted)
    if not records:
        return Outcome(Verdict.ERROR, f"none of the {unit} meets the hypotheses")
    totals: dict[str, int] = {}
    for record in records:
        totals[record.origin] = totals.get(record.origin, 0) + record.weight
    listed = "; ".join(f"{count} {origin}" for origin, count in totals.items())
    evidence = f"no counterexample found in {sum(totals.values())} {unit}: {listed}"
    return Outcome(Verdict.CERTIFIED, evidence, accepted(show(records[0])), all_accepted(records))
