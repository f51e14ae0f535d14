"""What a run has to find out, on all cores: what becomes of each reading, and of each claim without its hypotheses.

    Check, Without    a function of claims/, and an ablation: each is a task
    decided           what each of some tasks comes to

Whatever a task rests on is made once, for all. So every task is tried at first: one that asks for certified material says which, and is
tried again when that is there, while those that ask for none are done. What is asked for is made on all cores too, all of it at once.
"""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import local
from typing import Any

from ..base.progress import silent
from ..base.tasks import Once, ordered, processes
from .claims import check_of
from .evidence.material import Carried, Folder, Material, Shelf, Wanted
from .evidence.once_a_run import in_run
from .hypotheses import ablations
from .kept_answers import KeptAnswers
from .trust.checker import Malformed, Rejected
from .verdict.ablation import ablate
from .verdict.ledger import IN_LANGUAGE, expected_without
from .verdict.verdicts import Outcome, Row, Verdict
from .verdict.workbench import Workbench


@dataclass(frozen=True)
class Check:
    """The function of claims/ with this name, "claim.reading", or the text in the language of claims, "language.NAME"; to an Outcome."""

    name: str

    def done(self, bench: Workbench) -> Outcome:
        """Return what the function finds; an ERROR where it raises, or says something that no accepted certificate bears."""
        file, _, name = self.name.partition(".")
        try:
            if file == IN_LANGUAGE:
                from .brought.readings import decide_reading  # here, where it is needed: half of the claims do without the language

                outcome = decide_reading(bench, name)
            else:
                outcome = check_of(self.name)(bench)
        except (Malformed, Rejected) as error:
            outcome = Outcome(Verdict.ERROR, f"the checker refused a certificate: {error}")
        except Exception as error:  # whatever it is, this check did not finish, and the others go on
            outcome = Outcome(Verdict.ERROR, f"{type(error).__name__}: {error}")
        if outcome.verdict in (Verdict.CERTIFIED, Verdict.REFUTED) and not (outcome.certificates and outcome.accepted):
            outcome = Outcome(Verdict.ERROR, f"{outcome.verdict}, and yet no certificate was accepted: {outcome.evidence}")
        return outcome

    def __str__(self) -> str:
        return self.name.replace("_", "-").replace(".", ": ")


@dataclass(frozen=True)
class Without:
    """The ablation with this name; it comes to rows of the table of hypotheses."""

    name: str

    def done(self, bench: Workbench) -> tuple[Row, ...]:
        """Return the rows, or one in ERROR where they did not finish."""
        ablation = next(one for one in ablations() if one.name == self.name)
        try:
            return ablate(bench, ablation, expected_without()[ablation.name])
        except Exception as error:  # as for a check: it did not finish, and the others go on
            return (ablation.row((), Outcome(Verdict.ERROR, f"{type(error).__name__}: {error}")),)

    def __str__(self) -> str:
        return f"{self.name} without its hypotheses"


Task = Check | Without


@dataclass(frozen=True)
class Answer:
    """What a task came to, and the seconds that it took where it was done."""

    found: Any
    seconds: float


def decided(bench: Workbench, tasks: Sequence[Task], *, elsewhere: bool = False, kept: KeptAnswers | None = None) -> dict[Task, Answer]:
    """Return what each task comes to. `bench` then has the material that was made.

    `elsewhere` says that tasks may be done on other machines, which do not see a folder of this one. What is `kept` is not done again, and
    what is done is kept as it comes.
    """
    try:
        if elsewhere:
            return _in_rounds(bench, tasks, Carried(), kept)
        with TemporaryDirectory(prefix="faultspace-") as folder:
            return _in_rounds(bench, tasks, Folder(Path(folder)), kept)
    finally:
        vars(_mine).clear()  # where one process does it all, it is this one


def _in_rounds(bench: Workbench, tasks: Sequence[Task], shelf: Shelf, kept: KeptAnswers | None = None) -> dict[Task, Answer]:
    kept = kept or KeptAnswers(bench.effort)
    answers = {task: Answer(*found) for task in tasks if (found := kept.found(str(task))) is not None}
    needed: dict[Task, set[str]] = defaultdict(set)
    # The claims without their hypotheses take longest, so that they come first.
    waiting = sorted((task for task in tasks if task not in answers), key=lambda task: isinstance(task, Check))
    while waiting:
        wanted: dict[str, Material] = {}
        later = []
        parts = [shelf.part(needed[task]) for task in waiting]
        once = {id(part): Once(part) for part in parts}
        calls = [(task, bench.effort, once[id(part)]) for task, part in zip(waiting, parts, strict=True)]
        stream = ordered(_tried, calls, count=processes(bench.jobs))
        for task, answer in zip(waiting, stream, strict=True):
            if isinstance(answer, Answer):
                answers[task] = answer
                kept.note(str(task), answer.found, answer.seconds)
                bench.progress(str(task), len(answers), len(tasks))
            else:
                wanted |= {kind.name: kind for kind in answer}
                needed[task].update(kind.name for kind in answer)
                later.append(task)
        bench.make([kind for name, kind in wanted.items() if name not in shelf], shelf)
        kept.note_corpus(bench.corpus_in_words)
        waiting = later
    return answers


def _tried(task: Task, effort: str, shelf: Shelf) -> Answer | tuple[Material, ...]:
    in_run(shelf.run)
    try:
        return _done(task, _bench(effort, shelf))
    except Wanted as wanted:
        return wanted.kinds


_mine = local()  # a Dask worker does several tasks at a time in one process, where it has several threads


def _bench(effort: str, shelf: Shelf) -> Workbench:
    """Return the workbench of this thread, which keeps what it read and found out for the next task of the run."""
    if getattr(_mine, "run", None) != (effort, shelf.run):
        _mine.run, _mine.bench = (effort, shelf.run), Workbench(effort, 1, silent, shelf)
    bench: Workbench = _mine.bench
    bench.shelf = shelf
    return bench


def _done(task: Task, bench: Workbench) -> Answer:
    started = time.perf_counter()
    return Answer(task.done(bench), time.perf_counter() - started)
