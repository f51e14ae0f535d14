"""Which hypotheses does a claim need? Each is dropped in turn, and in pairs: a counterexample that meets all the others, or none anywhere.

    Subject       what a claim is about, certified: a system with a window, a pair of systems, a trajectory
    Experiment    a conclusion, the hypotheses it is said to rest on, the subjects tried, and the search over Q
    ablate        all rows of an experiment: every hypothesis alone, and every two; REFUTED: needed, CERTIFIED: not

One pass over the subjects notes, for each, which hypotheses it violates and whether the conclusion holds. The claim without the set D is
refuted by whatever violates nothing outside D and fails the conclusion. So a subject that violates nothing and fails refutes the claim
itself: then the experiment is in error, and says so. The smallest over Q is sought where some subject failed, over whatever field.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Generic, Protocol, TypeVar

from .certificate import Certificate
from .verdicts import Row, Verdict
from .workbench import Workbench, accepted


class Subject(Protocol):
    """What a claim is about. `size` orders, `weight` is how many this one stands for, `field` names K, `accepted` counts certificates."""

    @property
    def size(self) -> tuple[int, ...]: ...
    @property
    def weight(self) -> int: ...
    @property
    def field(self) -> str: ...
    @property
    def accepted(self) -> int: ...
    def __str__(self) -> str: ...


S = TypeVar("S", bound=Subject)


@dataclass(frozen=True)
class Experiment(Generic[S]):
    """`claim` is the id in the ledger. `over_q(bench, dropped)`: the smallest subject over Q that meets the hypotheses not dropped and
    fails, or None, and in words where it was sought. `show` gives certificates of a subject."""

    name: str
    claim: str
    conclusion: str
    hypotheses: Mapping[str, Callable[[S], bool]]
    holds: Callable[[S], bool]
    subjects: Callable[[Workbench], Iterable[S]]
    over_q: Callable[[Workbench, Sequence[str]], Found[S]]
    show: Callable[[S], Iterable[Certificate]]

    def violated(self, subject: S) -> frozenset[str]:
        """The hypotheses that the subject does not meet."""
        return frozenset(name for name, meets in self.hypotheses.items() if not meets(subject))


@dataclass(frozen=True)
class Found(Generic[S]):
    """The end of a search: a subject or None, and the box in words."""

    subject: S | None
    box: str


@dataclass
class _Tally(Generic[S]):
    """All subjects by the set of hypotheses they violate: how many, and the smallest of each field that fails the conclusion."""

    tried: Counter[frozenset[str]]
    accepted: Counter[frozenset[str]]
    failing: dict[tuple[frozenset[str], str], S]

    def smallest(self, dropped: frozenset[str]) -> dict[str, S]:
        """The smallest failing subject of each field that violates nothing else."""
        best: dict[str, S] = {}
        for (violated, field), subject in self.failing.items():
            if violated <= dropped and (field not in best or subject.size < best[field].size):
                best[field] = subject
        return best

    def count(self, dropped: frozenset[str]) -> tuple[int, int, int]:
        """Subjects that meet the other hypotheses, those among them that violate one of the dropped, and accepted certificates."""
        kept = [violated for violated in self.tried if violated <= dropped]
        return sum(self.tried[v] for v in kept), sum(self.tried[v] for v in kept if v), sum(self.accepted[v] for v in kept)


def ablate(bench: Workbench, experiment: Experiment[S], expected: Mapping[str, str]) -> tuple[Row, ...]:
    """Rows for each hypothesis alone, in order, then for each two. `expected` has the ledger's verdict for each alone."""
    tally = _tally(bench, experiment)
    flawed = tally.smallest(frozenset())
    if flawed:
        subject = min(flawed.values(), key=lambda s: s.size)
        words = f"nothing dropped, and it fails on {subject}"
        return (_row(experiment, (), Verdict.ERROR, words, None, accepted(experiment.show(subject)), subject.accepted, None),)
    names = list(experiment.hypotheses)
    alone = [_without(bench, experiment, tally, (name,), expected.get(name)) for name in names]
    refuted = {row.dropped[0]: row for row in alone if row.verdict == Verdict.REFUTED}
    rows = list(alone)
    for two in combinations(names, 2):
        already = next((name for name in two if name in refuted), None)
        if already is None:
            rows.append(_without(bench, experiment, tally, two, None))
        else:
            row = refuted[already]
            words = f"already without {already}"
            rows.append(_row(experiment, two, Verdict.REFUTED, words, already, row.certificates, row.accepted, None))
    return tuple(rows)


def _tally(bench: Workbench, experiment: Experiment[S]) -> _Tally[S]:
    tally: _Tally[S] = _Tally(Counter(), Counter(), {})
    for subject in experiment.subjects(bench):
        violated = experiment.violated(subject)
        tally.tried[violated] += subject.weight
        tally.accepted[violated] += subject.accepted
        if not experiment.holds(subject):
            key = (violated, subject.field)
            if key not in tally.failing or subject.size < tally.failing[key].size:
                tally.failing[key] = subject
    return tally


def _without(bench: Workbench, experiment: Experiment[S], tally: _Tally[S], dropped: tuple[str, ...], expected: str | None) -> Row:
    """One row: refuted over Q where that can be, else over the field where it was; certified where nothing fails."""
    elsewhere = tally.smallest(frozenset(dropped))
    total, without, certificates = tally.count(frozenset(dropped))
    found = experiment.over_q(bench, dropped) if elsewhere else Found[S](None, "")
    if found.subject is not None:
        others = sorted(field for field in elsewhere if field != "Q")
        also = f"; also over {', '.join(others)}" if others else ""
        words = f"{found.subject}; the smallest with {found.box}{also}"
        shown = accepted(experiment.show(found.subject))
        return _row(experiment, dropped, Verdict.REFUTED, words, None, shown, len(shown), expected)
    if elsewhere:
        field, subject = min(elsewhere.items(), key=lambda item: (item[0] != "Q", item[1].size))
        where = "the smallest tried" if field == "Q" else f"over {field}, and none over Q with {found.box}"
        shown = accepted(experiment.show(subject))
        return _row(experiment, dropped, Verdict.REFUTED, f"{subject}; {where}", None, shown, len(shown), expected)
    if not total:
        return _row(experiment, dropped, Verdict.ERROR, "nothing tried meets the others", None, (), 0, expected)
    what = "it" if len(dropped) == 1 else "one of the two"
    words = f"holds for all {total} tried that meet the others, {without} of them without {what}"
    if not without:
        words = f"holds for all {total} tried that meet the others, and none of these lacks {what}: where the others hold, it does"
    return _row(experiment, dropped, Verdict.CERTIFIED, words, None, (), certificates, expected)


def _row(
    experiment: Experiment[S],
    dropped: tuple[str, ...],
    verdict: Verdict,
    evidence: str,
    already: str | None,
    certificates: tuple[Certificate, ...],
    count: int,
    expected: str | None,
) -> Row:
    return Row(
        experiment.name, experiment.claim, experiment.conclusion, dropped, verdict, evidence, already, certificates, count, expected
    )
