"""The systems of a box put to several questions at once: the claim, and the claim without each of its hypotheses.

    Question       some of the hypotheses, and the conclusion
    Found          what became of a question: the first system that fails, or how many were tried and how many meet the hypotheses
    Searched       that of every question, and how much of the box was gone through
    search         all of a box

Each question goes on until a system fails. What several of them ask of a system is found once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ...base.errors import InvalidData, InvalidInput
from ...base.progress import Progress
from ...base.tasks import Died, as_they_come
from ..boxes.box import Box, Share, Sizes, Stretch
from ..language.by_batches import Table, UndefinedAt, true_of
from ..language.invariance import invariant
from ..language.nodes import Node
from ..language.vocabularies import VOCABULARIES
from ..quantities.cases import Case
from .kept import Sharing, name_of, texts


@dataclass(frozen=True)
class Question:
    """Do all systems that meet these hypotheses have this property? `dropped` is the hypothesis that was left out, if one was."""

    hypotheses: tuple[Node, ...]
    conclusion: Node
    dropped: int | None = None


@dataclass(frozen=True)
class Undefined:
    """The conclusion, or a hypothesis, has no value on a system."""

    message: str
    system: Case


@dataclass
class Found:
    """`met` counts the systems that meet the hypotheses, up to the one that fails; `failing` is that one."""

    met: int = 0
    failing: Case | None = None
    undefined: Undefined | None = None

    @property
    def open(self) -> bool:
        """Whether the search goes on."""
        return self.failing is None and self.undefined is None


@dataclass
class Searched:
    """What became of each question. `systems` of the box were gone through, by `looked_at` of them, one an orbit; all where `exhausted`."""

    found: list[Found]
    systems: int = 0
    looked_at: int = 0
    exhausted: bool = True


@dataclass
class _Part(Share):
    """What one process found in its share of the systems of some sizes: of each question, place and system of the first that fails."""

    met: list[int] = field(default_factory=list)
    first: list[tuple[tuple[int, int], Case | Undefined] | None] = field(default_factory=list)
    tables: dict[Node, Table] = field(default_factory=dict)


def search(
    box: Box, questions: Sequence[Question], *, most: int, jobs: int = 1, progress: Progress, sharing: Sharing | None = None
) -> Searched:
    """Go through the box until every question has failed, all systems are tried, or `most` of them are."""
    result = Searched([Found() for _ in questions])
    reduced = invariant(*{node for one in questions for node in (*one.hypotheses, one.conclusion)}, vocabulary=VOCABULARIES[box.about])
    sizes = box.sizes()
    total = sum(box.count(*one) for one in sizes)
    shown = max(1, total // 1000)
    for one in sizes:
        waiting = [k for k, found in enumerate(result.found) if found.open]
        if not waiting:
            break
        left = most - result.systems
        if left <= 0:
            result.exhausted = False
            break
        progress("going through the box", result.systems // shown, total // shown)
        asked = [questions[k] for k in waiting]
        parts = _share(box, one, asked, left, sharing or Sharing(jobs), reduced=reduced)
        result.systems += sum(part.systems for part in parts)
        result.looked_at += sum(part.looked_at for part in parts)
        result.exhausted &= all(part.whole for part in parts)
        for place, k in enumerate(waiting):
            result.found[k].met += sum(part.met[place] for part in parts)
            firsts = [first for part in parts if (first := part.first[place]) is not None]
            if firsts:
                _, failing = min(firsts, key=lambda first: first[0])
                if isinstance(failing, Undefined):
                    result.found[k].undefined = failing
                else:
                    result.found[k].failing = failing
    return result


def _share(box: Box, sizes: Sizes, asked: list[Question], left: int, sharing: Sharing, *, reduced: bool) -> list[_Part]:
    """Return the parts of the systems of these sizes: those that are kept, and the others gone through now."""
    of, said = sharing.parts(box.count(*sizes)), texts(asked)
    if of == 1:
        return [_search(box, sizes, asked, left, 0, 1, reduced)]
    kept = sharing.kept if said is not None else None
    names = [name_of(str(box), sizes, said, left, k, of) for k in range(of)]
    parts: dict[int, _Part] = {}
    for k, name in enumerate(names):
        if kept is not None and (one := kept.parts.get(name)) is not None and len(one["met"]) == len(asked):
            parts[k] = _Part(one["systems"], one["looked_at"], one["whole"], list(one["met"]), [None] * len(asked))
    waiting = [k for k in range(of) if k not in parts]
    tasks = [(box, sizes, asked, left // of, k, of, reduced) for k in waiting]
    for number, part in as_they_come(_search, tasks, count=sharing.jobs, cluster=sharing.cluster):
        k = waiting[number]
        if isinstance(part, Died):
            raise InvalidData(
                f"part {k + 1} of {of} of {box} came to no end: {part.reason}; try a smaller box, or fewer processes at a time"
            )
        parts[k] = part
        if kept is not None and not any(part.first):
            kept.note(names[k], systems=part.systems, looked_at=part.looked_at, whole=part.whole, met=part.met)
    return [parts[k] for k in range(of)]


def _search(box: Box, sizes: Sizes, asked: list[Question], left: int, mine: int, of: int, reduced: bool) -> _Part:
    """Try every `of`th stretch of the systems of these sizes, from number `mine` on."""
    part = _Part(met=[0] * len(asked), first=[None] * len(asked))
    for number, stretch in part.stretches(box, sizes, left, mine, of, reduced=reduced):
        for k, question in enumerate(asked):
            if part.first[k] is None:
                _ask(question, k, number, stretch, part)
        if all(part.first):
            break
    part.tables.clear()
    return part


def _ask(question: Question, k: int, number: int, stretch: Stretch, part: _Part) -> None:
    rows = np.arange(len(stretch.batch))
    try:
        for node in question.hypotheses:
            rows = rows[true_of(node, stretch.batch, rows, part.tables.setdefault(node, Table()))]
        part.met[k] += int(stretch.weights[rows].sum())
        conclusion = question.conclusion
        failing = rows[~true_of(conclusion, stretch.batch, rows, part.tables.setdefault(conclusion, Table()))]
    except UndefinedAt as error:
        system = stretch.batch.case(error.index)
        part.first[k] = (number, error.index), Undefined(str(error), system)
        return
    if len(failing):
        first = int(failing.min())
        part.first[k] = (number, first), stretch.batch.case(first)


def must_have_a_value(undefined: Undefined, where: str) -> InvalidInput:
    """Return the complaint about an expression without a value."""
    return InvalidInput(f"{where}: on {undefined.system}, {undefined.message}")
