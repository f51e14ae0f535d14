"""A claim asks for the evidence that its readings need, and no other: alone, with others, in whatever order, it says the same."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from faultspace.base.progress import silent
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs import deciding
from faultspace.proofs.deciding import Check, Task, Without, decided
from faultspace.proofs.evidence import corpus, questions
from faultspace.proofs.evidence.corpus import CORPUS, Evidence, Questions, Source, Unasked, by_question, examine
from faultspace.proofs.evidence.material import Carried, Folder, Material, Shelf, loaded, made
from faultspace.proofs.evidence.questions import FINITE_ZEROS, INFINITE_ZEROS, OBSERVABILITY, QUESTIONS, RANKS, SPACE, Question, answered
from faultspace.proofs.hypotheses import ablations, trajectories, windowed
from faultspace.proofs.hypotheses.facets import AIMED
from faultspace.proofs.hypotheses.windowed import Windowed
from faultspace.proofs.trust import structure_certificates as make
from faultspace.proofs.trust.checker import Rejected
from faultspace.proofs.verdict import workbench
from faultspace.proofs.verdict.ablation import Ablation
from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.workbench import Workbench

# What the ledger says of single systems alone, and what stands.
READINGS = (
    "language.theorem-2--pencil-zeros-minimal", "language.theorem-2--pencil-zeros", "language.assumption-4--n-known",
    "language.assumption-4--n-unknown", "language.assumption-4--lag", "language.proposition-3--n-alone",
    "language.proposition-3--lag-exactly", "language.proposition-3--normal-rank", "language.problem-11--window-n-plus-1",
    "language.problem-11--lag-plus-1", "language.problem-11--dimension", "zero_feedthrough.exactly_when",
    "language.trajectory-recovered--state-known", "language.trajectory-recovered--no-finite-zeros",
    "trajectory_recovered.zero_feedthrough_signal", "language.objection-3--gap-without-controllability",
    "language.objection-3--ranks-without-minimality", "window_ranks.ranks", "language.window-ranks--indices", "window_ranks.solutions",
    "language.window-ranks--limit", "language.sharp-windows--gap",
)  # fmt: skip
ONE_STATE = ResidualSystem.of([[0]], [[1]], [[1]], [[0]])


@cache
def sample() -> list[Any]:
    return [item for place, item in enumerate(CORPUS[RANKS].items(Workbench("quick", 1, silent))) if place % 9 == 1]


@cache
def later() -> list[Any]:
    return [item for place, item in enumerate(AIMED[RANKS].items(Workbench("quick", 1, silent))) if place < 2 or place % 20 == 0]


def few(bench: Any) -> Iterator[Source]:
    return iter(sample()[::4])


def few_aimed(bench: Any) -> Iterator[Source]:
    return iter(later()[::2])


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """The corpus and the aimed systems are samples, certified anew by each workbench, question by question."""
    one, other = by_question("corpus", "certifying", few), by_question("aimed systems", "certifying", few_aimed)
    monkeypatch.setattr(workbench, "CORPUS", one)
    monkeypatch.setattr(windowed, "CORPUS", one)
    monkeypatch.setattr(windowed, "AIMED", other)


@pytest.fixture(scope="module")
def bench() -> Workbench:
    found = Workbench("quick", 1, silent)
    found.put_answers(CORPUS, [examine(*item) for item in sample()])
    found.put_answers(AIMED, [examine(*item) for item in later()])
    return found


class Watch:
    """The questions that were asked for, and those whose answers were read."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.asked: set[Question[Any]] = set()
        self.read: set[Question[Any]] = set()
        answers, answer = Workbench.answers, Evidence.answer

        def asking(bench: Workbench, kinds: Any, wanted: Questions) -> tuple[Evidence, ...]:
            self.asked |= set(wanted)
            return answers(bench, kinds, wanted)

        def reading(evidence: Evidence, question: Question[Any]) -> Any:
            self.read.add(question)
            return answer(evidence, question)

        monkeypatch.setattr(Workbench, "answers", asking)
        monkeypatch.setattr(Evidence, "answer", reading)


@pytest.mark.parametrize("reading", READINGS)
def test_a_reading_asks_exactly_what_it_reads(reading: str, bench: Workbench, monkeypatch: pytest.MonkeyPatch) -> None:
    """What it reads and did not ask would be an error; what it asks and does not read would be counted although nothing rests on it."""
    watch = Watch(monkeypatch)
    outcome = Check(reading).done(bench)
    assert outcome.verdict == "CERTIFIED", outcome.evidence
    assert watch.asked == watch.read != set()


@pytest.mark.parametrize("ablation", [one for one in ablations() if one.subjects.__module__ == windowed.__name__], ids=lambda one: one.name)
def test_an_ablation_asks_exactly_what_its_conditions_read(
    ablation: Ablation[Windowed], bench: Workbench, monkeypatch: pytest.MonkeyPatch
) -> None:
    watch = Watch(monkeypatch)
    for subject in ablation.subjects(bench):
        ablation.violated(subject)
        ablation.holds(subject)
    assert watch.asked == watch.read != set()


def test_what_was_not_asked_is_no_answer() -> None:
    found = examine("test", ONE_STATE, questions=(RANKS, SPACE))
    assert (found.left_invertible, found.fault_space.dimension, len(found.accepted)) == (True, 2, 3)
    for name in ("observable", "controllable", "zeta", "delay_known_state", "window_ranks", "space_dimensions", "right_minimal_indices"):
        with pytest.raises(Unasked, match="was not asked of"):
            getattr(found, name)
    assert found.asked((SPACE,)).answers == {SPACE: found.answers[SPACE]}
    more = found.asked((OBSERVABILITY, RANKS))
    assert list(more.answers) == [OBSERVABILITY, RANKS] and more.answers[RANKS] is found.answers[RANKS] and more.observable
    assert found.asked(()).accepted == frozenset()


def test_questions_are_answered_alone_as_together() -> None:
    """Each answer is the same by itself as among all, and all of them rest on as many certificates as their answers do."""
    for item in sample()[::12]:
        origin, system, weight = item
        together = examine(origin, system, weight)
        for question in QUESTIONS:
            assert examine(origin, system, weight, (question,)).answers == {question: together.answers[question]}
        assert together.accepted == frozenset().union(*(one.accepted for one in together.answers.values()))
        assert 0 < len(together.accepted) <= 10 + 2 * (item[1].n + 2)


def test_an_answer_is_read_only_off_accepted_certificates(monkeypatch: pytest.MonkeyPatch) -> None:
    right = make.infinite_zeros(ONE_STATE)
    monkeypatch.setattr(make, "infinite_zeros", lambda system: right | {"statement": right["statement"] | {"infinite_zero_orders": [2]}})
    with pytest.raises(Rejected):
        examine("test", ONE_STATE, questions=(INFINITE_ZEROS,))
    assert examine("test", ONE_STATE, questions=(RANKS, FINITE_ZEROS)).finite_zeros == 0


TASKS: list[Task] = [
    *(Check(name) for name in ("window_ranks.ranks", "language.window-ranks--indices", "window_ranks.solutions")),
    *(Check(f"language.theorem-2--{name}") for name in ("finite-zeros-only", "every-window", "pencil-zeros")),
    Check("language.window-ranks--limit"),
    Check("language.trajectory-recovered--state-unknown"),
    Check("language.proposition-3--n-alone"),
    Check("objection_3.controllability_needed"),
    Without("gap"),
]


def said(tasks: list[Task], shelf: Shelf | None = None) -> dict[Task, Any]:
    """Return what each task comes to on a workbench of its own, in one process or as if in several."""
    bench = Workbench("quick", 1, silent)
    answers = decided(bench, tasks) if shelf is None else deciding._in_rounds(bench, tasks, shelf)
    return {task: answer.found for task, answer in answers.items()}


def test_alone_with_others_and_in_another_order_the_same_is_said(small: None, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The verdict, the words, the certificates and their number do not depend on what else is asked, before, after, or elsewhere."""
    whole = said(TASKS)
    assert len({found.accepted for task, found in whole.items() if isinstance(task, Check)}) > 3
    assert said(TASKS[::-1]) == whole
    for task in TASKS:
        assert said([task]) == {task: whole[task]}
    assert said([TASKS[8], TASKS[1]]) == {task: whole[task] for task in (TASKS[8], TASKS[1])}
    monkeypatch.setattr(deciding, "ordered", lambda call, tasks, count: (call(*each[:-1], each[-1].value) for each in tasks))
    assert said(TASKS, Folder(tmp_path)) == said(TASKS, Carried()) == whole
    (tmp_path / "again").mkdir()
    assert said(TASKS[3:5], Folder(tmp_path / "again")) == {task: whole[task] for task in TASKS[3:5]}


@pytest.mark.slow  # every claim of the ledger, by itself and in a run of all
def test_every_claim_says_alone_what_it_says_in_a_run_of_all() -> None:
    def tasks(claim: str) -> list[Task]:
        checks = [Check(reading.check) for one in load() if one.id == claim for reading in one.readings]
        return [*dict.fromkeys(checks), *(Without(one.name) for one in ablations() if one.claim == claim)]

    claims = {claim.id: tasks(claim.id) for claim in load()}
    whole = said(list(dict.fromkeys(task for some in claims.values() for task in some)))
    for claim, some in claims.items():
        assert said(some) == {task: whole[task] for task in some}, claim


def test_only_what_a_reading_asks_is_certified(small: None, monkeypatch: pytest.MonkeyPatch) -> None:
    kinds: list[str] = []
    real = make.accept

    def watched(certificate: make.Certificate) -> None:
        kinds.append(certificate["kind"])
        real(certificate)

    monkeypatch.setattr(questions, "accept", watched)
    bench = Workbench("quick", 1, silent)
    outcome = Check("language.proposition-3--n-alone").done(bench)
    assert outcome.verdict == "CERTIFIED" and len(kinds) == 2 * len(sample()[::4])
    assert set(kinds) == {"window-ranks", "left-invertible", "not-left-invertible"}
    assert Check("language.sharp-windows--gap").done(bench).verdict == "CERTIFIED" and len(kinds) == 2 * len(sample()[::4])  # made once
    assert Check("language.window-ranks--limit").done(bench).verdict == "CERTIFIED" and len(kinds) == (2 + 1 + 2 + 1) * len(sample()[::4])


def test_an_interrupted_making_leaves_nothing_behind(small: None, monkeypatch: pytest.MonkeyPatch) -> None:
    bench, real, calls = Workbench("quick", 1, silent), answered, 0

    def stopped(question: Question[Any], kernel: Any) -> Any:
        nonlocal calls
        calls += 1
        if calls == 7:
            raise KeyboardInterrupt
        return real(question, kernel)

    monkeypatch.setattr(corpus, "answered", stopped)
    check = Check("language.proposition-3--lag-exactly")
    with pytest.raises(KeyboardInterrupt):
        check.done(bench)
    assert check.done(bench) == Check("language.proposition-3--lag-exactly").done(Workbench("quick", 1, silent))
    calls = 6
    with pytest.raises(KeyboardInterrupt):
        bench.examined(ONE_STATE, (SPACE,))
    assert bench.examined(ONE_STATE, (SPACE, RANKS)) == examine("search", ONE_STATE, questions=(SPACE, RANKS))
    assert bench.examined(ONE_STATE, (RANKS,)) == examine("search", ONE_STATE, questions=(RANKS,))


def test_a_refused_answer_is_an_error_of_those_who_ask_it_alone(small: None, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(question: Question[Any], kernel: Any) -> Any:
        if question == INFINITE_ZEROS:
            raise Rejected("not so")
        return answered(question, kernel)

    monkeypatch.setattr(corpus, "answered", refused)
    bench = Workbench("quick", 1, silent)
    assert Check("language.window-ranks--indices").done(bench).evidence == "the checker refused a certificate: not so"
    assert Check("window_ranks.solutions").done(bench).verdict == "CERTIFIED"
    assert bench.corpus_in_words.startswith("1 the paper's example") or "systems" in bench.corpus_in_words


def test_kinds_of_the_same_items_are_made_together() -> None:
    """The items are drawn once; an error in one kind is none of the other; the first error stays."""
    drawn: list[int] = []

    def items(bench: Any) -> Iterator[int]:
        drawn.append(1)
        return iter(range(5))

    def kind(name: str, make: Callable[[int], list[int]]) -> Material:
        return Material(name, name, items, make, 2)

    def odd(item: int) -> list[int]:
        if item % 2:
            raise ValueError(f"{item} is odd")
        return [item]

    (packed,) = made([kind("twice", lambda x: [x, 2 * x]), kind("odd", odd), kind("none", lambda x: [])], None, 1, silent, "")
    found = loaded(packed)
    assert drawn == [1] and found["twice"] == (0, 0, 1, 2, 2, 4, 3, 6, 4, 8) and found["none"] == ()
    assert str(found["odd"]) == "1 is odd"


def test_the_first_look_at_a_trajectory_is_what_its_certificates_state() -> None:
    differ = set()
    for _, system, _ in sample()[:12]:
        for s in (1, 2):
            for x0, v in trajectories.signals(system, s, 2) if system.n and system.m else ():
                gap = trajectories.examined(system, x0, v, s).gap
                assert trajectories._gap(system, x0, v, s) == gap
                differ.add(gap - system.m)
    assert len(differ) > 1
