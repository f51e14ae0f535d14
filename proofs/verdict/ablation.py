"""This asks which hypotheses a claim needs. Each is dropped in turn, and in pairs: a counterexample that meets all the others, or none
anywhere.

    Subject       what a claim is about, certified: a system with a window, a pair of systems, a trajectory
    Proof         theorems of Rocq that prove the conclusion, and the hypotheses they prove it from
    Ablation      a conclusion, the hypotheses it is said to rest on, the subjects tried, and the search over Q
    ablate        all rows of an ablation: every hypothesis alone, and every two; REFUTED: needed, CERTIFIED: no counterexample found

One pass over the subjects notes, for each, which hypotheses it violates and whether the conclusion holds. The claim without the set D is
refuted by whatever violates nothing outside D and fails the conclusion. So a subject that violates nothing and fails refutes the claim
itself: then the ablation is in error, and says so. The smallest over Q is sought where some subject failed, over whatever field; among
the smallest, one that fails for a reason of its own comes before one that is `degenerate`.

A hypothesis that no subject lacks which meets the others may follow from them. That is told where the ablation gives the reason, in
`implied`; a reason that a subject contradicts is an error, and so is a counterexample to what a Proof says.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from itertools import combinations
from typing import Any, Generic, Protocol, TypeVar

from ..trust.structure_certificates import Certificate
from .verdicts import Outcome, Row, Verdict
from .workbench import Workbench, accepted


class Subject(Protocol):
    """What a claim is about. `size` orders, `weight` is how many this one stands for, `field` names K, `accepted` are the
    certificates, by their SHA-256.

    `degenerate` says why it would be a poor witness: C = 0, repeated fault columns, an input that does nothing; "" where it would not.
    """

    @property
    def size(self) -> tuple[int, ...]: ...
    @property
    def weight(self) -> int: ...
    @property
    def field(self) -> str: ...
    @property
    def accepted(self) -> frozenset[str]: ...
    @property
    def degenerate(self) -> str: ...
    def __str__(self) -> str: ...


S = TypeVar("S", bound=Subject)


@dataclass(frozen=True)
class Proof:
    """`theorems` of theory/headlines that prove the conclusion, for all subjects, from these `hypotheses` and no other."""

    theorems: tuple[str, ...]
    hypotheses: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Ablation(Generic[S]):
    """What a claim is when hypotheses of it are dropped: its conclusion, its hypotheses, and where it is tried.

    `claim` is the id in the ledger. `over_q(bench, dropped)`: the smallest subject over Q that meets the hypotheses not dropped and fails,
    or None, and in words where it was sought. `show` gives certificates of a subject. `implied`: hypotheses that follow from the others,
    and why.
    """

    name: str
    claim: str
    conclusion: str
    hypotheses: Mapping[str, Callable[[S], bool]]
    holds: Callable[[S], bool]
    subjects: Callable[[Workbench], Iterable[S]]
    over_q: Callable[[Workbench, Sequence[str]], Found[S]]
    show: Callable[[S], Iterable[Certificate]]
    proof: Proof | None = None
    implied: Mapping[str, str] = field(default_factory=dict)

    def violated(self, subject: S) -> frozenset[str]:
        """Return the hypotheses that the subject does not meet."""
        return frozenset(name for name, meets in self.hypotheses.items() if not meets(subject))

    def row(self, dropped: tuple[str, ...], found: Outcome, **more: Any) -> Row:
        """Return the row of an outcome, without these hypotheses."""
        outcome = {one.name: getattr(found, one.name) for one in fields(Outcome)}
        return Row(**outcome, ablation=self.name, claim=self.claim, conclusion=self.conclusion, dropped=dropped, **more)

    def theorems_without(self, dropped: Sequence[str]) -> tuple[str, ...]:
        """Return the theorems that prove the conclusion without these hypotheses; none where the proof uses one of them."""
        return self.proof.theorems if self.proof is not None and self.proof.hypotheses.isdisjoint(dropped) else ()


@dataclass(frozen=True)
class Found(Generic[S]):
    """The end of a search: a subject or None, and in words where it was sought."""

    subject: S | None
    box: str


def first_found(counterexamples: Callable[[bool], Iterable[S]], box: str) -> Found[S]:
    """Return the first that is not degenerate, or, where all are, the first. `counterexamples(poor)` has those that are, or those that are
    not.
    """
    for poor in (False, True):
        for subject in counterexamples(poor):
            return Found(subject, box)
    return Found(None, box)


@dataclass
class _Tally(Generic[S]):
    """All subjects by the set of hypotheses they violate: how many, and the smallest of each field that fails the conclusion."""

    tried: Counter[frozenset[str]]
    accepted: dict[frozenset[str], set[str]]
    failing: dict[tuple[frozenset[str], str], S]

    def smallest(self, dropped: frozenset[str]) -> dict[str, S]:
        """Return the smallest failing subject of each field that violates nothing else."""
        found: dict[str, S] = {}
        for (violated, name), subject in self.failing.items():
            if violated <= dropped and (name not in found or _order(subject) < _order(found[name])):
                found[name] = subject
        return found

    def count(self, dropped: frozenset[str]) -> _Count:
        kept = [violated for violated in self.tried if violated <= dropped]
        accepted = frozenset().union(*(self.accepted[v] for v in kept))
        return _Count(sum(self.tried[v] for v in kept), sum(self.tried[v] for v in kept if v), accepted)


@dataclass(frozen=True)
class _Count:
    """This counts subjects that meet the other hypotheses, and those among them that violate one of the dropped; `accepted` has the
    certificates of all, by their SHA-256."""

    tried: int
    lacking: int
    accepted: frozenset[str]


def ablate(bench: Workbench, ablation: Ablation[S], expected: Mapping[str, str]) -> tuple[Row, ...]:
    """Return the rows of an ablation: for each hypothesis alone, in order, then for each two. `expected` has the ledger's entry for each
    alone.
    """
    tally = _tally(bench, ablation)
    flawed = tally.smallest(frozenset())
    if flawed:
        subject = min(flawed.values(), key=_order)
        words = f"nothing is dropped, and the conclusion fails on {subject}"
        return (ablation.row((), Outcome(Verdict.ERROR, words, accepted(ablation.show(subject)), subject.accepted)),)
    names = list(ablation.hypotheses)
    alone = [_without(bench, ablation, tally, (name,), expected.get(name)) for name in names]
    refuted = {row.dropped[0]: row for row in alone if row.verdict == Verdict.REFUTED}
    rows = list(alone)
    for two in combinations(names, 2):
        already = next((name for name in two if name in refuted), None)
        if already is None:
            rows.append(_without(bench, ablation, tally, two, None))
        else:
            row, count = refuted[already], tally.count(frozenset(two))
            found = replace(row, evidence=f"it falls without {already} alone")
            rows.append(ablation.row(two, found, already=already, tried=count.tried, lacking=count.lacking))
    return tuple(rows)


def _order(subject: Subject) -> tuple[bool, tuple[int, ...]]:
    return bool(subject.degenerate), subject.size


def _tally(bench: Workbench, ablation: Ablation[S]) -> _Tally[S]:
    tally: _Tally[S] = _Tally(Counter(), defaultdict(set), {})
    for subject in ablation.subjects(bench):
        violated = ablation.violated(subject)
        tally.tried[violated] += subject.weight
        tally.accepted[violated] |= subject.accepted
        if not ablation.holds(subject):
            key = (violated, subject.field)
            if key not in tally.failing or _order(subject) < _order(tally.failing[key]):
                tally.failing[key] = subject
    return tally


def _without(bench: Workbench, ablation: Ablation[S], tally: _Tally[S], dropped: tuple[str, ...], expected: str | None) -> Row:
    """Return one row: refuted over Q where that can be, else over the field where it was; certified where nothing fails."""
    elsewhere = tally.smallest(frozenset(dropped))
    count = tally.count(frozenset(dropped))
    reason = ablation.implied.get(dropped[0]) if len(dropped) == 1 else None

    def row(verdict: Verdict, words: str, certificates: tuple[Certificate, ...] = (), decided: frozenset[str] = frozenset()) -> Row:
        found = Outcome(verdict, words, certificates, decided)
        theorems = ablation.theorems_without(dropped)
        return ablation.row(dropped, found, ledger=expected, theorems=theorems, tried=count.tried, lacking=count.lacking, implied=reason)

    if elsewhere:
        subject, where = _witness(bench, ablation, dropped, elsewhere)
        certificates = accepted(ablation.show(subject))
        poor = f"; every counterexample found is degenerate: {subject.degenerate}" if subject.degenerate else ""
        words = f"{subject}; {where}{poor}"
        if ablation.theorems_without(dropped):
            words = f"{', '.join(ablation.theorems_without(dropped))} prove it without, and yet it fails on {words}"
            return row(Verdict.ERROR, words, certificates)
        return row(Verdict.REFUTED, words, certificates)
    if not count.tried:
        return row(Verdict.ERROR, "no subject that was tried meets the others")
    if reason is not None and count.lacking:
        words = f"{count.lacking} of the {count.tried} subjects that meet the others lack it, although it is said to follow: {reason}"
        return row(Verdict.ERROR, words, (), count.accepted)
    return row(Verdict.CERTIFIED, _found_none(count, dropped, reason), (), count.accepted)


def _found_none(count: _Count, dropped: Sequence[str], reason: str | None) -> str:
    what = "it" if len(dropped) == 1 else "one of the two"
    if reason is not None:
        return f"it follows from the others: {reason}; of the {count.tried} subjects tried that meet the others none lacks it"
    if not count.lacking:
        return f"no counterexample among {count.tried} tried that meet the others, none of which lacks {what}; why, is not known"
    return f"no counterexample among {count.tried} tried that meet the others, {count.lacking} of which lack {what}"


def _witness(bench: Workbench, ablation: Ablation[S], dropped: tuple[str, ...], elsewhere: Mapping[str, S]) -> tuple[S, str]:
    """Return the counterexample to show, and in words how small it is and where else there are some."""
    found = ablation.over_q(bench, dropped)
    tried = elsewhere.get("Q")
    if found.subject is not None and (tried is None or _order(found.subject)[0] <= _order(tried)[0]):
        others = sorted(name for name in elsewhere if name != "Q")
        also = f"; also over {', '.join(others)}" if others else ""
        kind = "" if found.subject.degenerate else ", degenerate ones left out,"
        return found.subject, f"the smallest{kind} with {found.box}{also}"
    if tried is not None:
        return tried, "the smallest tried"
    name, subject = min(elsewhere.items(), key=lambda item: _order(item[1]))
    return subject, f"over {name}, and none over Q with {found.box}"
