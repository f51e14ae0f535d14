"""Claims about one system and a window: their hypotheses, and the search for the smallest system where dropping one lets them fail.

    Windowed      a system by its evidence, and a window
    Condition     a test on a Windowed, and its vectorised first look at many systems at once
    windowed      an ablation made of conditions

A first look never decides: it only leaves out what surely violates a hypothesis or surely meets the conclusion; what is left is decided
by the certificates of the system.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from ..evidence.corpus import CORPUS, Evidence, Questions
from ..evidence.questions import DELAY_KNOWN_STATE, OBSERVABILITY, RANKS, REACHABILITY
from ..evidence.search import Box, Facts, Flags
from ..trust.structure_certificates import Certificate
from ..verdict.ablation import Ablation, Found, Proof, first_found
from ..verdict.workbench import Show, Workbench, size
from .aimed import AIMED
from .facets import degenerate, facets, nilpotent

BOX = Box(total=5, largest_n=2, largest_m=2, largest_p=2)


@dataclass(frozen=True)
class Windowed:
    """A system by its accepted certificates, and a number of samples; 0 where the claim is about no window."""

    evidence: Evidence
    window: int

    @property
    def size(self) -> tuple[int, ...]:
        """These are the numbers n + m + p, then n, m, p, then the window."""
        return (*size(self.evidence.system), self.window)

    @property
    def weight(self) -> int:
        """The number of systems in the orbit; windows are not counted as more of them."""
        return self.evidence.weight

    @cached_property
    def field(self) -> str:
        """This is the field in words, as it is printed."""
        return str(self.evidence.system.field)

    @property
    def accepted(self) -> frozenset[str]:
        """These are the accepted certificates, by their SHA-256."""
        return self.evidence.accepted

    @cached_property
    def degenerate(self) -> str:
        """This says why the system would be a poor witness."""
        return degenerate(self.evidence.system)

    def __str__(self) -> str:
        return f"{self.evidence.system}, s = {self.window}" if self.window else str(self.evidence.system)


@dataclass(frozen=True)
class Condition:
    """This is a hypothesis or a conclusion about a system and a window.

    `holds` decides on certificates. `first_look` at integer systems leaves out what surely violates it (of a hypothesis) or surely meets it
    (of a conclusion). `asks` are the questions whose answers `holds` reads.
    """

    asks: Questions
    holds: Callable[[Windowed], bool]
    first_look: Callable[[Facts, int], Flags]


OBSERVABLE = Condition((OBSERVABILITY,), lambda w: w.evidence.observable, lambda f, s: f.observable)
CONTROLLABLE = Condition((REACHABILITY,), lambda w: w.evidence.controllable, lambda f, s: f.controllable)
LEFT_INVERTIBLE = Condition((RANKS,), lambda w: w.evidence.left_invertible, lambda f, s: f.left_invertible)
STABLE = Condition((), lambda w: facets(w.evidence.system).stable, lambda f, s: nilpotent(f))


def from_n(extra: int = 0) -> Condition:
    """Return the condition s >= n + extra."""
    return Condition((), lambda w: w.window >= w.evidence.system.n + extra, lambda f, s: np.full(len(f.A), s >= f.n + extra))


def from_lag(extra: int = 0) -> Condition:
    """Return the condition s >= lag + extra."""

    def first_look(facts: Facts, s: int) -> Flags:
        reached = facts.gap(s - extra) == facts.gap(facts.n + 1) if s > extra else np.zeros(len(facts.A), dtype=np.bool_)
        return np.asarray(reached | (facts.gap(0) == facts.gap(facts.n + 1)))

    return Condition((RANKS,), lambda w: w.window >= w.evidence.kernel.lag + extra, first_look)


def _from_delay(subject: Windowed) -> bool:
    """Whether s >= l, the delay of left inversion with known initial state; there is no bound where there is no delay."""
    delay = subject.evidence.delay_known_state
    return delay is None or subject.window >= delay


def _delay_look(facts: Facts, s: int) -> Flags:
    return np.asarray((facts.delay_known_state <= s) | (facts.delay_known_state > facts.n))


EVERYTHING = Condition((), lambda w: True, lambda f, s: np.full(len(f.A), True))
FROM_DELAY = Condition((DELAY_KNOWN_STATE,), _from_delay, _delay_look)

NO_WINDOW = range(0, 1)


def windowed(
    name: str,
    claim: str,
    words: str,
    hypotheses: Mapping[str, Condition],
    conclusion: Condition,
    show: Show,
    scope: Condition = EVERYTHING,
    windows: Callable[[int], range] = lambda n: range(1, n + 3),
    box: Box = BOX,
    proof: Proof | None = None,
    implied: Mapping[str, str] | None = None,
) -> Ablation[Windowed]:
    """Return the ablation on every system of the corpus and every aimed one that is in the scope, at every window."""

    asks = tuple(dict.fromkeys(question for one in (scope, conclusion, *hypotheses.values()) for question in one.asks))

    def subjects(bench: Workbench) -> Iterator[Windowed]:
        bench.need(*(kinds[question] for kinds in (CORPUS, AIMED) for question in asks))
        for evidence in (*bench.corpus(asks), *bench.answers(AIMED, asks)):
            for s in windows(evidence.system.n):
                if scope.holds(subject := Windowed(evidence, s)):
                    yield subject

    def certificates(subject: Windowed) -> Iterator[Certificate]:
        yield from show(subject.evidence.system)

    return Ablation(
        name=name,
        claim=claim,
        conclusion=words,
        hypotheses={key: condition.holds for key, condition in hypotheses.items()},
        holds=conclusion.holds,
        subjects=subjects,
        over_q=partial(_smallest, asks, hypotheses, conclusion, scope, windows, box),
        show=certificates,
        proof=proof,
        implied=implied or {},
    )


def _smallest(
    asks: Questions,
    hypotheses: Mapping[str, Condition],
    conclusion: Condition,
    scope: Condition,
    windows: Callable[[int], range],
    box: Box,
    bench: Workbench,
    dropped: Sequence[str],
) -> Found[Windowed]:
    kept = [scope, *(condition for name, condition in hypotheses.items() if name not in dropped)]

    def counterexamples(poor: bool) -> Iterator[Windowed]:
        for facts in bench.searched(box):
            looks: dict[int, Flags] = {}
            for s in windows(facts.n):
                open_still = ~conclusion.first_look(facts, s)
                for condition in kept:
                    if not open_still.any():
                        break
                    open_still &= condition.first_look(facts, s)
                looks[s] = open_still
            for index in np.flatnonzero(np.logical_or.reduce(list(looks.values()))):
                system = facts.system(int(index))
                if bool(degenerate(system)) != poor:
                    continue
                evidence = bench.examined(system, asks)
                for s in windows(facts.n):
                    subject = Windowed(evidence, s)
                    if looks[s][index] and all(c.holds(subject) for c in kept) and not conclusion.holds(subject):
                        yield subject

    return first_found(counterexamples, str(box))
