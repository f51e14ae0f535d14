"""The view model of a whole page, out of the records alone.

PageView   what the templates read
view       the model of these records
"""

from __future__ import annotations

import base64
import json
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from ...proofs.verdict.picture import GROUPS
from ...proofs.verdict.review_points import Point, review, source
from ..computed.texts import sources, withdrawn, words
from ..records import Records
from .alarms import Alarm, alarms
from .claims import SHORT, ClaimView, TheoremView, claims, theorems
from .words import Link, anchor, cited, place, prose


@dataclass(frozen=True)
class RowView:
    """A claim without one or two of its hypotheses."""

    claim: str
    conclusion: str
    dropped: str
    verdict: str
    meaning: str


@dataclass(frozen=True)
class CertificateRow:
    """A certificate with the checker's words, and the file as an address that holds it."""

    kind: str
    digest: str
    place: str
    accepted: bool
    words: str
    href: Markup
    name: str


@dataclass(frozen=True)
class WordView:
    """A word of the glossary."""

    name: str
    place: str
    symbol: Markup
    meaning: Markup
    source: Markup


@dataclass(frozen=True)
class PageView:
    """All that a page shows. `records` holds what the templates lay out as it is."""

    alarms: list[Alarm]
    records: Records
    command: str
    groups: Mapping[str, str]
    points: tuple[Point, ...]
    named: frozenset[str]
    review_source: Mapping[str, str]
    claims: list[ClaimView]
    counts: Mapping[str, int]
    rows: list[RowView]
    theorems: list[TheoremView]
    certificates: list[CertificateRow]
    withdrawn: list[Markup] | None
    sources: Mapping[str, Markup]
    words: list[WordView]
    open_readings: list[tuple[Link, str, str]]


def view(records: Records) -> PageView:
    """Return the model; nothing in it is computed but what orders, counts and compares."""
    keys = sources()
    found = claims(records, keys)
    readings = [(claim, one) for claim in found for one in claim.readings]
    wrong = withdrawn()
    return PageView(
        alarms=alarms(found, records),
        records=records,
        command=_command(records),
        groups={group: title for group, title in GROUPS.items() if any(one.card["group"] == group for one in found)},
        points=review(),
        named=frozenset(one.name for one in found),
        review_source=source(),
        claims=found,
        counts=Counter(one.verdict for _, one in readings),
        rows=_rows(records),
        theorems=theorems(found, records),
        certificates=_certificates(records),
        withdrawn=None if wrong is None else [prose(entry) for entry in wrong],
        sources={key: prose(text) for key, text in keys.items()},
        words=[
            WordView(one.name, anchor("word", place(one.name)), prose(one.symbol), prose(one.meaning), cited(one.source, keys))
            for one in words()
        ],
        open_readings=[
            (Link(f"{claim.name}, {one.name}", f"#{claim.place}"), one.statement, one.missing)
            for claim, one in readings
            if one.verdict == "CERTIFIED" and one.missing
        ],
    )


def _command(records: Records) -> str:
    """Return what repeats the page: one command, unless only some claims were decided."""
    verifying = str(records.run.origin["command"])
    if "--claim" in verifying:
        return f"{verifying} --out RUN && faultspace report --run RUN --out DIR"
    return f"faultspace report --effort {records.run.verdicts['effort']} --out DIR"


def _rows(records: Records) -> list[RowView]:
    """Return the rows of one hypothesis, and of two that are needed only together; the others follow from these."""
    chosen = [
        row
        for row in records.run.verdicts["hypotheses"]
        if len(row["dropped"]) < 2 or (row["verdict"] not in ("CERTIFIED", "PROVED") and row["already_without"] is None)
    ]
    return [
        RowView(
            claim=row["claim"],
            conclusion=row["conclusion"],
            dropped=" and ".join(row["dropped"]) or "nothing dropped",
            verdict=row["verdict"],
            meaning=_meaning(row),
        )
        for row in chosen
    ]


def _meaning(row: Mapping[str, Any]) -> str:
    if row["verdict"] == "ERROR":
        return "undecided, the check did not finish"
    if row["verdict"] == "REFUTED":
        return "needed" if row["dropped"] else "refuted as it stands"
    if row["follows_from_the_others"]:
        return "follows from the others"
    return "not needed, proved" if row["verdict"] == "PROVED" else "not seen to be needed"


def _certificates(records: Records) -> list[CertificateRow]:
    rows = []
    for digest, one in records.run.certificates.items():
        said = records.checked[digest]
        data = base64.b64encode(json.dumps(one, separators=(",", ":"), sort_keys=True).encode()).decode("ascii")
        rows.append(
            CertificateRow(
                kind=one["kind"],
                digest=digest,
                place=anchor("certificate", digest[:SHORT]),
                accepted=said["accepted"],
                words=said["words"],
                href=Markup(f"data:application/json;base64,{data}"),
                name=f"{one['kind']}-{digest[:SHORT]}.json",
            )
        )
    return sorted(rows, key=lambda row: (row.kind, row.digest))
