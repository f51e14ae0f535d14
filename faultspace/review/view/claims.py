"""The claims as stated beside the claims as checked, and the graph that they make.

ClaimView, ReadingView, CertificateView, TheoremView    what a page shows of each
claims        all claims of a run
theorems      the theorems that readings name, with their statements where the sources have them as locked
nodes         the graph's nodes: what became of the statement, and on what the weakest reading that stands rests
LEVELS        verdicts from the strongest to the weakest
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from ...proofs.rocq.build import NotProved
from ...proofs.rocq.locks import Lock, kept
from ...proofs.rocq.sources import paths
from ...proofs.verdict.verdicts import Verdict
from ..drawing.graph import Node
from ..records import Records
from .words import anchor, cited

LEVELS = ("PROVED", "IDENTITY", "CERTIFIED")
SHORT = 12


@dataclass(frozen=True)
class CertificateView:
    """`place` is the name of its row among the certificates; None where the run names it and has no file of it."""

    kind: str
    digest: str
    place: str | None


@dataclass(frozen=True)
class TheoremView:
    """`statement` and `file` are empty where the sources at hand are not as they were locked."""

    name: str
    place: str
    digest: str
    statement: str
    file: str
    used_by: tuple[str, ...]


@dataclass(frozen=True)
class ReadingView:
    """One reading as checked; `scope` says for what the verdict holds."""

    name: str
    ours: bool
    statement: str
    hypotheses: tuple[str, ...]
    verdict: str
    expected: str
    scope: str
    evidence: str
    theorems: tuple[str, ...]
    missing: str
    attacks: tuple[str, ...]
    accepted: int
    certificates: tuple[CertificateView, ...]
    seconds: float

    @property
    def as_expected(self) -> bool:
        """The page compares by itself."""
        return self.verdict == self.expected


@dataclass(frozen=True)
class ClaimView:
    """One claim; `status` and `level` colour its node in the graph."""

    name: str
    place: str
    reference: Markup
    whose: str
    stated: str
    verdict: str
    expected: str
    meaning: str
    uses: tuple[str, ...]
    status: str
    level: str
    readings: tuple[ReadingView, ...]

    @property
    def as_expected(self) -> bool:
        """The page compares by itself."""
        return self.verdict == self.expected

    @property
    def words(self) -> str:
        """This says in words what the two colours of its node say."""
        statement = {
            "stands": "the statement stands in a reading",
            "amended": "the statement falls in every reading, or a part of it, and a repair stands",
            "falls": "the statement falls in every reading, or a part of it",
            "open": "the check did not finish",
        }[self.status]
        return f"{statement}; what stands rests on: {self.level}"


def claims(records: Records, keys: Container[str]) -> list[ClaimView]:
    """Return the claims in the order of the run."""
    return [_claim(one, records, keys) for one in records.run.verdicts["claims"]]


def _claim(claim: Mapping[str, Any], records: Records, keys: Container[str]) -> ClaimView:
    verdict = claim["verdict"]
    status = {"REFUTED": "falls", "AMENDED": "amended", "ERROR": "open"}.get(verdict, "stands")
    standing = [one["verdict"] for one in claim["readings"] if one["verdict"] in LEVELS]
    return ClaimView(
        name=claim["id"],
        place=anchor("claim", claim["id"]),
        reference=cited(claim["reference"], keys),
        whose=claim["whose"],
        stated=claim["as_stated"],
        verdict=verdict,
        expected=claim["expected"],
        meaning=meaning(verdict),
        uses=tuple(claim["uses"]),
        status=status,
        level=max(standing, key=LEVELS.index).lower() if standing else "nothing",
        readings=tuple(_reading(one, records) for one in claim["readings"]),
    )


def _reading(reading: Mapping[str, Any], records: Records) -> ReadingView:
    return ReadingView(
        name=reading["reading"],
        ours=reading["ours"],
        statement=reading["statement"],
        hypotheses=tuple(reading["hypotheses"]),
        verdict=reading["verdict"],
        expected=reading["expected"],
        scope=meaning(reading["verdict"]),
        evidence=reading["evidence"],
        theorems=tuple(reading["locks"]),
        missing=reading["missing_for_a_proof"] or "",
        attacks=tuple(attack(one) for one in reading["attacks"]),
        accepted=reading["certificates_accepted"],
        certificates=tuple(certificate(one, records) for one in reading["certificates"]),
        seconds=reading["seconds"],
    )


def certificate(named: Mapping[str, Any], records: Records) -> CertificateView:
    """Return a certificate that a record names."""
    digest = named["sha256"]
    return CertificateView(named["kind"], digest, anchor("certificate", digest[:SHORT]) if digest in records.run.certificates else None)


def attack(one: Mapping[str, Any]) -> str:
    """Return what an attack tried, with what is wrong with a stored one."""
    trouble = f" ({one['trouble']})" if one["trouble"] else ""
    return f"{one['attack']}: {one['words']}{trouble}"


def meaning(verdict: str) -> str:
    """Return what a verdict says; a word that is none, out of a broken record, is told to be none."""
    return Verdict(verdict).meaning if verdict in list(Verdict) else "this is no verdict of the closed list"


def theorems(found: list[ClaimView], records: Records) -> list[TheoremView]:
    """Return the theorems of all readings, by name."""
    used: dict[str, list[str]] = {}
    digests: dict[str, str] = {}
    for claim in records.run.verdicts["claims"]:
        for reading in claim["readings"]:
            for name, digest in reading["locks"].items():
                used.setdefault(name, []).append(f"{claim['id']}, {reading['reading']}")
                digests[name] = digest
    try:
        locks: Mapping[str, Lock] = kept().theorems
    except NotProved:
        locks = {}
    files = paths()
    views = []
    for name in sorted(used):
        lock = locks.get(name)
        same = lock is not None and lock.sha256 == digests[name]
        views.append(
            TheoremView(
                name=name,
                place=anchor("theorem", name),
                digest=digests[name],
                statement=lock.statement if lock is not None and same else "",
                file=f"proofs/theory/{files.get(lock.file, lock.file)}" if lock is not None and same else "",
                used_by=tuple(used[name]),
            )
        )
    return views


def nodes(found: list[ClaimView]) -> list[Node]:
    """Return what the graph draws."""
    return [Node(one.name, one.uses, one.status, one.level, one.words) for one in found]
