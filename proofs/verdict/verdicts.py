"""What a run says of a claim: the closed list of verdicts and the records that carry them.

Verdict          PROVED, IDENTITY, CERTIFIED, REFUTED, AMENDED, ERROR
Outcome          what one check found: verdict, evidence in words, certificates
ReadingResult    an outcome with the reading it belongs to, the verdict the ledger expects, and the seconds it took
ClaimResult      the readings of one claim and the verdict on the claim as a whole
Row              a claim without one or two of its hypotheses
of_readings      the verdict on a claim from those on its readings
Report           all claims of a run; `as_expected` decides the exit code
"""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from ...base.sheets import Shown
from ..evidence.attacks import Attacked
from ..trust.structure_certificates import Certificate, sha256
from .ledger import Claim, Reading, sentences
from .picture import Line, draw


class Verdict(StrEnum):
    """The closed list of verdicts, from the strongest to that of a check which did not finish.

    Each is a string, and `meaning` says in a sentence what it stands for. A run computes verdicts; none is ever stored by hand.
    The type is StrEnum, so that a verdict is written to JSON as it is.

    Raises ValueError for a word that is none of them.

    >>> from faultspace.proofs import Verdict
    >>> Verdict("CERTIFIED").meaning
    'no counterexample was found among the systems tried, or what is said to exist is there, by certificates that the checker accepted'
    """

    PROVED = "PROVED"
    IDENTITY = "IDENTITY"
    CERTIFIED = "CERTIFIED"
    REFUTED = "REFUTED"
    AMENDED = "AMENDED"
    ERROR = "ERROR"

    @property
    def meaning(self) -> str:
        """What the verdict says of a statement."""
        return _MEANINGS[self]


_MEANINGS = {
    Verdict.PROVED: "it holds of all that it speaks of, by theorems that Rocq has checked, without axioms",
    Verdict.IDENTITY: "it holds for all values of the entries at the dimensions named, by polynomial identities expanded twice",
    Verdict.CERTIFIED: (
        "no counterexample was found among the systems tried, or what is said to exist is there, by certificates that the checker accepted"
    ),
    Verdict.REFUTED: "it fails, by a counterexample with certificates that the checker accepted",
    Verdict.AMENDED: "every reading of the claim as stated is refuted, or of a part of it, and a repair of ours is not",
    Verdict.ERROR: "the check did not finish",
}

IMPLIED = "IMPLIED"  # the ledger's word for a hypothesis that follows from the others


@dataclass(frozen=True)
class Outcome:
    """What a check found. `evidence` says on what the verdict rests; `certificates` are the headline ones, all accepted by the
    checker.

    `decided` has the SHA-256 of those that the checker accepted on the way; `accepted` counts the distinct ones, headline or not.
    """

    verdict: Verdict
    evidence: str
    certificates: tuple[Certificate, ...] = ()
    decided: frozenset[str] = frozenset()

    @property
    def all_decided(self) -> frozenset[str]:
        """All certificates that the checker accepted for it, headline or not, by their SHA-256."""
        return self.decided | {sha256(certificate) for certificate in self.certificates}

    @property
    def accepted(self) -> int:
        """The number of distinct certificates that the checker accepted for it."""
        return len(self.all_decided)

    @property
    def named(self) -> list[dict[str, str]]:
        """Its headline certificates, by kind and SHA-256."""
        return [{"kind": c["kind"], "sha256": sha256(c)} for c in self.certificates]


@dataclass(frozen=True, repr=False)
class ReadingResult(Shown):
    """One reading of one claim, checked. `locks`: theorem -> the SHA-256 of what it says (`rocq_locks`)."""

    reading: Reading
    outcome: Outcome
    seconds: float
    machine_checked: bool = False
    locks: Mapping[str, str] = field(default_factory=dict)
    attacks: tuple[Attacked, ...] = ()

    @property
    def expected(self) -> str:
        """The ledger's verdict, PROVED where Rocq has checked the theorems of the reading."""
        return self.reading.proved if self.machine_checked else self.reading.expected

    @property
    def as_expected(self) -> bool:
        """This says whether the computed verdict is the expected one."""
        return self.outcome.verdict == self.expected

    @property
    def title(self) -> str:
        """Its name and verdict."""
        return f"{self.reading.id}: {self.outcome.verdict}" + ("" if self.as_expected else f", expected {self.expected}")

    def sheet(self) -> list[tuple[str, str]]:
        """Return the statement, and what its verdict rests on, as (name, value) pairs."""
        attacks = [("attacked by", attack.words) for attack in self.attacks]
        certificates = ("certificates accepted", str(self.outcome.accepted))
        return [("statement", self.reading.statement), ("evidence", self.outcome.evidence), certificates, *attacks]

    def to_json(self) -> dict[str, Any]:
        """Return the object in `verify --json`."""
        return {
            "reading": self.reading.id,
            "ours": self.reading.repair,
            "statement": self.reading.statement,
            "hypotheses": list(self.reading.hypotheses),
            "verdict": str(self.outcome.verdict),
            "expected": self.expected,
            "as_expected": self.as_expected,
            "theorems": list(self.reading.theorems) if self.machine_checked else [],
            "locks": dict(self.locks),
            "missing_for_a_proof": self.reading.missing or None,
            "evidence": self.outcome.evidence,
            "certificates_accepted": self.outcome.accepted,
            "certificates": self.outcome.named,
            "attacks": [attack.to_json() for attack in self.attacks],
            "seconds": round(self.seconds, 3),
        }


@dataclass(frozen=True, repr=False)
class ClaimResult(Shown):
    """A claim with its readings checked. AMENDED: every reading of its words, or of those of one of its parts, is refuted, and a
    repair is not."""

    claim: Claim
    readings: tuple[ReadingResult, ...]

    @property
    def verdict(self) -> Verdict:
        """The verdict on the claim, computed from those on its readings."""
        return of_readings([(r.reading, r.outcome.verdict) for r in self.readings], in_parts=self.claim.in_parts)

    @property
    def expected(self) -> str:
        """The ledger's verdict; where Rocq has checked theorems of it, what the verdicts expected of its readings make."""
        if not any(r.machine_checked for r in self.readings):
            return self.claim.expected
        return of_readings([(r.reading, Verdict(r.expected)) for r in self.readings], in_parts=self.claim.in_parts)

    @property
    def rests_on(self) -> tuple[str, ...]:
        """The readings that hold, with their level: what the claim comes down to."""
        return tuple(f"{r.reading.id}: {r.outcome.verdict}" for r in self.readings if r.outcome.verdict != Verdict.REFUTED)

    @property
    def as_expected(self) -> bool:
        """Whether every verdict, the claim's own included, is the expected one."""
        return self.verdict == self.expected and all(r.as_expected for r in self.readings)

    @property
    def title(self) -> str:
        """Its name and verdict."""
        return f"{self.claim.id}: {self.verdict}" + ("" if self.verdict == self.expected else f", expected {self.expected}")

    def sheet(self) -> list[tuple[str, str]]:
        """Return the statement, whose words these are, and the verdict on each reading, as (name, value) pairs."""
        readings = [(one.reading.id, f"{one.outcome.verdict}. {one.reading.statement}") for one in self.readings]
        return [(self.claim.whose, self.claim.statement), ("readings", ""), *readings]

    def to_json(self) -> dict[str, Any]:
        """Return the object in `verify --json`."""
        return {
            "id": self.claim.id,
            "reference": self.claim.reference,
            "whose": self.claim.whose,
            "as_stated": self.claim.statement,
            "as_printed": self.claim.statement,  # what earlier runs called it
            "uses": list(self.claim.uses),
            "verdict": str(self.verdict),
            "expected": self.expected,
            "as_expected": self.as_expected,
            "rests_on": list(self.rests_on),
            "readings": [r.to_json() for r in self.readings],
        }


def of_readings(readings: Sequence[tuple[Reading, Verdict]], *, in_parts: bool) -> Verdict:
    """The verdict on a claim from those on its readings: a part is refuted when its readings all are, the claim when a part is."""
    verdicts = [verdict for _, verdict in readings]
    if not verdicts or Verdict.ERROR in verdicts:
        return Verdict.ERROR
    parts: dict[str | int, list[Verdict]] = {}
    for place, (reading, verdict) in enumerate(readings):
        if not reading.repair:
            parts.setdefault(reading.part or (place if in_parts else ""), []).append(verdict)
    holding = [verdict for reading, verdict in readings if reading.repair and verdict != Verdict.REFUTED]
    if any(all(verdict == Verdict.REFUTED for verdict in part) for part in parts.values()):
        return Verdict.AMENDED if holding else Verdict.REFUTED
    standing = [verdict for part in parts.values() for verdict in part if verdict != Verdict.REFUTED] or holding
    return max(standing, key=list(Verdict).index) if standing else Verdict.REFUTED


@dataclass(frozen=True, kw_only=True)
class Row(Outcome):
    """The outcome of the claim without the hypotheses `dropped`. `already` names a single one of them without which it falls already.

    `theorems` prove it without them, and `machine_checked` says that Rocq has checked these in the run. Of the `tried` subjects that meet
    the other hypotheses, `lacking` violate one of the dropped. `implied`: why a dropped one follows from the others; None where it does
    not. `ledger` is the ledger's entry: REFUTED, CERTIFIED, or IMPLIED. A row that rests on no subject which lacks the dropped is not as
    expected, unless it is told why there is none.
    """

    ablation: str
    claim: str
    conclusion: str
    dropped: tuple[str, ...]
    already: str | None = None
    ledger: str | None = None
    theorems: tuple[str, ...] = ()
    machine_checked: bool = False
    tried: int | None = None
    lacking: int | None = None
    implied: str | None = None
    attacks: tuple[Attacked, ...] = ()

    @property
    def expected(self) -> str | None:
        """The verdict expected: PROVED where Rocq has checked the theorems; rows of two follow from the subjects alone, and have none."""
        if self.ledger is None or self.ledger == Verdict.REFUTED:
            return self.ledger
        return str(Verdict.PROVED if self.machine_checked else Verdict.CERTIFIED)

    @property
    def meaning(self) -> str:
        """The verdict in the words of the table: needed, not needed, or not needed since it follows from the others."""
        if self.verdict == Verdict.REFUTED:
            return "needed"
        if self.verdict == Verdict.ERROR:
            return ""
        if self.implied is not None:
            return "follows from the others"
        return "not needed" if self.verdict == Verdict.PROVED else "not seen to be needed"

    @property
    def as_expected(self) -> bool:
        """This says whether verdict and meaning are the ledger's."""
        if self.verdict == Verdict.ERROR or self.ledger is None:
            return self.verdict != Verdict.ERROR
        rests_on_something = self.lacking != 0 or self.implied is not None
        return self.verdict == self.expected and (self.implied is not None) == (self.ledger == IMPLIED) and rests_on_something

    def to_json(self) -> dict[str, Any]:
        """Return the object in `verify --json`."""
        return {
            "experiment": self.ablation,
            "claim": self.claim,
            "conclusion": self.conclusion,
            "dropped": list(self.dropped),
            "verdict": str(self.verdict),
            "needed": self.verdict == Verdict.REFUTED,
            "follows_from_the_others": self.implied,
            "expected": self.expected,
            "as_expected": self.as_expected,
            "already_without": self.already,
            "theorems": list(self.theorems) if self.machine_checked else [],
            "tried": self.tried,
            "lacking": self.lacking,
            "evidence": self.evidence,
            "certificates_accepted": self.accepted,
            "certificates": self.named,
            "attacks": [attack.to_json() for attack in self.attacks],
        }


@dataclass(frozen=True, repr=False)
class Report(Shown):
    """The verdicts of a run on every claim that was asked for; `verify` returns it.

    `claims` is a tuple with a ClaimResult a claim, whose `readings` hold the outcomes, and `hypotheses` has a Row for each hypothesis that
    was dropped. `corpus` says in words on which systems the run rests, `seconds` is how long it took, `machine` is what there is to say of
    Rocq, and `believed` says which programs and files it was (None: it was not asked). `certificates()` gives the list of all headline
    certificates. The claims are those of [G25].

    Raises nothing; `plot` raises ImportError where there is no matplotlib.

    >>> import faultspace as fs
    >>> report = fs.verify(["example-v"], jobs=1)
    >>> report.claims[0].readings[2].title
    'window-of-assumption-4: REFUTED'
    >>> len(report.certificates()), report.as_expected
    (15, True)
    """

    effort: str
    claims: tuple[ClaimResult, ...]
    hypotheses: tuple[Row, ...]
    corpus: str
    seconds: float
    machine: str = "not asked"
    believed: Mapping[str, str | None] | None = None
    versions: dict[str, str] = field(default_factory=lambda: versions())

    @property
    def as_expected(self) -> bool:
        """This says whether every verdict is the expected one."""
        return all(claim.as_expected for claim in self.claims) and all(row.as_expected for row in self.hypotheses)

    @property
    def title(self) -> str:
        """This says how many claims were decided, and how many of the verdicts are not those that the ledger expects."""
        wrong = sum(not claim.as_expected for claim in self.claims) + sum(not row.as_expected for row in self.hypotheses)
        claims = f"{len(self.claims)} claim{'' if len(self.claims) == 1 else 's'}"
        return f"{claims} decided: {'every verdict is the expected one' if not wrong else f'{wrong} verdicts are not the expected ones'}"

    def sheet(self) -> list[tuple[str, str]]:
        """The claims with their verdicts, as (name, value) pairs; those that are not as expected come first."""
        ordered = sorted(self.claims, key=lambda claim: claim.as_expected)
        claims = [(c.claim.id, str(c.verdict) + ("" if c.as_expected else f", expected {c.expected}")) for c in ordered]
        wrong = [row for row in self.hypotheses if not row.as_expected]
        return [*((f"{r.claim} without {' and '.join(r.dropped)}", f"{r.verdict}, expected {r.expected}") for r in wrong), *claims]

    def certificates(self) -> list[Certificate]:
        """Every headline certificate once, in the order of the claims."""
        readings = (reading.outcome.certificates for claim in self.claims for reading in claim.readings)
        rows = (row.certificates for row in self.hypotheses)
        return list({sha256(certificate): certificate for several in (*readings, *rows) for certificate in several}.values())

    def decided(self) -> frozenset[str]:
        """Every certificate that the checker accepted in this run, by its SHA-256: one on which several verdicts rest is there once."""
        readings = (reading.outcome.all_decided for claim in self.claims for reading in claim.readings)
        return frozenset().union(*readings, *(row.all_decided for row in self.hypotheses))

    def plot(self, ax: Any = None) -> Any:
        """Draw a line a claim, with its verdict in a sentence, into the matplotlib axes `ax` (new ones for None), and return them.

        Raises ImportError where there is no matplotlib.
        """
        said = {name: words["verdict"] for name, words in sentences().items()}
        found = [(one.claim, one.verdict, said.get(one.claim.id, "") if one.as_expected else one.title) for one in self.claims]
        return draw([Line(claim.id, claim.group, str(verdict), words) for claim, verdict, words in found], ax)

    def to_json(self) -> dict[str, Any]:
        """Return the object that `verify --json` prints."""
        return {
            "effort": self.effort,
            "as_expected": self.as_expected,
            "corpus": self.corpus,
            "rocq": self.machine,
            "believed": None if self.believed is None else dict(self.believed),
            "seconds": round(self.seconds, 1),
            "versions": self.versions,
            "claims": [claim.to_json() for claim in self.claims],
            "hypotheses": [row.to_json() for row in self.hypotheses],
        }


def versions() -> dict[str, str]:
    """Return the versions of Python and of what verdicts are computed with, by name."""
    found = {"python": platform.python_version()}
    for name in ("faultspace", "python-flint", "sympy", "numpy"):
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = "not installed as a package"
    return found
