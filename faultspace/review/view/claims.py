"""The claims with their cards and readings, and the theorems behind them.

ClaimView, ReadingView, TheoremView    what a page shows of each
claims        all claims of a run
theorems      the theorems that readings name, with their statements where the sources have them as locked
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from ...proofs.rocq.build import NotProved
from ...proofs.rocq.locks import Lock, kept
from ...proofs.rocq.sources import paths
from ..records import Records
from .words import anchor, cited

SHORT = 12


@dataclass(frozen=True)
class TheoremView:
    """`file` is empty where the sources at hand are not as they were locked."""

    name: str
    place: str
    digest: str
    file: str


@dataclass(frozen=True)
class ReadingView:
    """One reading as checked."""

    name: str
    ours: bool
    statement: str
    hypotheses: tuple[str, ...]
    verdict: str
    expected: str
    evidence: str
    missing: str

    @property
    def as_expected(self) -> bool:
        """The page compares by itself."""
        return self.verdict == self.expected


@dataclass(frozen=True)
class ClaimView:
    """One claim; `card` is its card as the run has written it."""

    name: str
    place: str
    reference: Markup
    whose: str
    stated: str
    verdict: str
    expected: str
    card: Mapping[str, Any]
    readings: tuple[ReadingView, ...]

    @property
    def as_expected(self) -> bool:
        """The page compares by itself."""
        return self.verdict == self.expected


def claims(records: Records, keys: Container[str]) -> list[ClaimView]:
    """Return the claims in the order of the run."""
    return [_claim(one, records, keys) for one in records.run.verdicts["claims"]]


def _claim(claim: Mapping[str, Any], records: Records, keys: Container[str]) -> ClaimView:
    return ClaimView(
        name=claim["id"],
        place=anchor("claim", claim["id"]),
        reference=cited(claim["reference"], keys),
        whose=claim["whose"],
        stated=claim["as_stated"],
        verdict=claim["verdict"],
        expected=claim["expected"],
        card=claim["card"],
        readings=tuple(_reading(one) for one in claim["readings"]),
    )


def _reading(reading: Mapping[str, Any]) -> ReadingView:
    return ReadingView(
        name=reading["reading"],
        ours=reading["ours"],
        statement=reading["statement"],
        hypotheses=tuple(reading["hypotheses"]),
        verdict=reading["verdict"],
        expected=reading["expected"],
        evidence=reading["evidence"],
        missing=reading["missing_for_a_proof"] or "",
    )


def theorems(found: list[ClaimView], records: Records) -> list[TheoremView]:
    """Return the theorems of all readings, by name."""
    digests: dict[str, str] = {}
    for claim in records.run.verdicts["claims"]:
        for reading in claim["readings"]:
            for name, digest in reading["locks"].items():
                digests[name] = digest
    try:
        locks: Mapping[str, Lock] = kept().theorems
    except NotProved:
        locks = {}
    files = paths()
    views = []
    for name in sorted(digests):
        lock = locks.get(name)
        same = lock is not None and lock.sha256 == digests[name]
        views.append(
            TheoremView(
                name=name,
                place=anchor("theorem", name),
                digest=digests[name],
                file=f"proofs/theory/{files.get(lock.file, lock.file)}" if lock is not None and same else "",
            )
        )
    return views
