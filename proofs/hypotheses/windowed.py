"""Claims about one system and a window: their hypotheses, and the search for the smallest system where dropping one lets them fail.

    Windowed      a system by its evidence, and a window
    Condition     a test on a Windowed, and the same in the language of claims, by which many systems are looked at together
    says          the condition that an expression states: certificates tell what it reads
    windowed      an ablation made of conditions

Where many systems are gone through, the language leaves out those that violate a hypothesis or meet the conclusion; what is left is decided
by the certificates of each system.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial

from ..boxes.box import Box, expression, rows_where
from ..evidence.corpus import CORPUS, Evidence, Questions
from ..language.certified import Certified, asked_by
from ..language.evaluating import evaluate
from ..quantities.batches import Batch
from ..trust.structure_certificates import Certificate
from ..verdict.ablation import Ablation, Found, Proof, first_found
from ..verdict.workbench import Show, Workbench, size
from .facets import AIMED, MODEL, POOR, degenerate, facets

BOX = Box(n=(1, 2), m=(1, 2), p=(1, 2), total=5)


@dataclass(frozen=True)
class Windowed:
    """A system by its accepted certificates, and a number of samples; 0 where the claim is about no window."""

    evidence: Evidence
    window: int

    @property
    def size(self) -> tuple[int, ...]:
        """The numbers n + m + p, then n, m, p, then the window."""
        return (*size(self.evidence.system), self.window)

    @property
    def weight(self) -> int:
        """The number of systems in the orbit; windows are not counted as more of them."""
        return self.evidence.weight

    @cached_property
    def field(self) -> str:
        """The field in words, as it is printed."""
        return str(self.evidence.system.field)

    @property
    def accepted(self) -> frozenset[str]:
        """The accepted certificates, by their SHA-256."""
        return self.evidence.accepted

    @cached_property
    def degenerate(self) -> str:
        """This says why the system would be a poor witness."""
        return degenerate(self.evidence.system)

    def __str__(self) -> str:
        return f"{self.evidence.system}, s = {self.window}" if self.window else str(self.evidence.system)


@dataclass(frozen=True)
class Condition:
    """A hypothesis or a conclusion about a system and a window.

    `holds` decides on certificates, which answer the questions `asks`. `look` says the same of integer systems in the language of claims,
    with {s} for the number of samples; it is None where the language has no words for it.
    """

    asks: Questions
    holds: Callable[[Windowed], bool]
    look: str | None


def says(text: str) -> Condition:
    """Return the condition that an expression states, with {s} for the number of samples."""

    def holds(subject: Windowed) -> bool:
        return bool(evaluate(expression(text.format(s=subject.window)), Certified(subject.evidence)))

    return Condition(asked_by(expression(text.format(s=1))), holds, text)


OBSERVABLE, CONTROLLABLE, LEFT_INVERTIBLE = (says(MODEL[name]) for name in ("observable", "controllable", "left-invertible"))
STABLE = Condition((), lambda w: facets(w.evidence.system).stable, MODEL["A stable"])
EVERYTHING = Condition((), lambda w: True, None)
FROM_DELAY = says("implies(delay_known < inf, delay_known <= {s})")


def from_n(extra: int = 0) -> Condition:
    """Return the condition s >= n + extra."""
    return says(f"{{s}} >= n + {extra}")


def from_lag(extra: int = 0) -> Condition:
    """Return the condition s >= lag + extra."""
    return says(f"{{s}} >= lag + {extra}")


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

    def open_still(batch: Batch, s: int, poor: bool) -> set[int]:
        """Return which systems are poor, or are not, meet what is kept as far as the language says it, and fail the conclusion."""
        texts = [POOR if poor else f"not ({POOR})"]
        texts += [] if conclusion.look is None else [f"not ({conclusion.look})"]
        texts += [one.look for one in kept if one.look is not None]
        return set(map(int, rows_where(tuple(text.format(s=s) for text in texts), batch)))

    def counterexamples(poor: bool) -> Iterator[Windowed]:
        for batch in bench.searched(box):
            looks = {s: open_still(batch, s, poor) for s in windows(batch.n)}
            for index in sorted(set().union(*looks.values())):
                evidence = bench.examined(batch.system(index), asks)
                for s in windows(batch.n):
                    subject = Windowed(evidence, s)
                    if index in looks[s] and all(c.holds(subject) for c in kept) and not conclusion.holds(subject):
                        yield subject

    return first_found(counterexamples, str(box))
