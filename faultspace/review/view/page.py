"""The view model of a whole page, out of the records alone.

PageView   what the templates read
view       the model of these records
"""

from __future__ import annotations

import base64
import json
import tomllib
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from typing import Any

from markupsafe import Markup

from ..computed.texts import sources, withdrawn, words
from ..drawing.graph import graph
from ..records import Records
from .alarms import Alarm, agrees, alarms
from .claims import SHORT, CertificateView, ClaimView, TheoremView, certificate, claims, nodes, theorems
from .words import Link, anchor, cited, place, prose


@dataclass(frozen=True)
class SentenceView:
    """`supported` says whether the verdicts of all readings that it comes down to are there and as expected."""

    text: Markup
    rests: tuple[tuple[Link, str], ...]
    supported: bool


@dataclass(frozen=True)
class RowView:
    """A claim without one or two of its hypotheses."""

    claim: str
    place: str
    conclusion: str
    dropped: str
    verdict: str
    meaning: str
    counts: str
    evidence: str
    certificates: tuple[CertificateView, ...]


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
class StatementView:
    """A statement of the field with its source, and what became of it; `verdict` is empty where this run did not decide it."""

    name: str
    field: str
    statement: str
    source: Markup
    verdict: str
    expected: str
    as_expected: bool
    counterexample: str
    tried: str


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
    sentences: list[SentenceView]
    claims: list[ClaimView]
    counts: Mapping[str, int]
    graph: Markup
    rows: list[RowView]
    theorems: list[TheoremView]
    certificates: list[CertificateRow]
    literature: list[StatementView]
    decided: bool
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
        sentences=_sentences(found),
        claims=found,
        counts=Counter(one.verdict for _, one in readings),
        graph=graph(nodes(found)),
        rows=_rows(records),
        theorems=theorems(found, records),
        certificates=_certificates(records),
        literature=_literature(records, keys),
        decided=records.run.literature is not None,
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


def _sentences(found: list[ClaimView]) -> list[SentenceView]:
    text = resources.files("faultspace.review").joinpath("sentences.toml").read_text("utf-8")
    readings = {f"{claim.name}.{one.name}": (claim, one) for claim in found for one in claim.readings}
    views = []
    for sentence in tomllib.loads(text)["sentence"]:
        there = [readings.get(name) for name in sentence["rests"]]
        rests = tuple(
            (
                Link(name.replace(".", ", "), f"#{each[0].place}" if each else "#claims"),
                each[1].verdict if each else "not decided in this run",
            )
            for name, each in zip(sentence["rests"], there, strict=True)
        )
        views.append(SentenceView(prose(sentence["text"]), rests, all(each is not None and each[1].as_expected for each in there)))
    return views


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
            place=anchor("claim", row["claim"]),
            conclusion=row["conclusion"],
            dropped=" and ".join(row["dropped"]) or "nothing dropped",
            verdict=row["verdict"],
            meaning=_meaning(row),
            counts=f"{row['lacking']} of {row['tried']} tried lack it" if row["tried"] is not None else "",
            evidence=row["follows_from_the_others"] or row["evidence"],
            certificates=tuple(certificate(one, records) for one in row["certificates"]),
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


def _literature(records: Records, keys: Mapping[str, str]) -> list[StatementView]:
    text = resources.files("faultspace").joinpath("examples", "literature.toml").read_text("utf-8")
    stated = tomllib.loads(text)["claim"]
    if records.run.literature is None:
        return [_statement(name, one, {"field": "", "verdict": "", "expected": one["expected"]}, keys) for name, one in stated.items()]
    return [_statement(one["id"], stated.get(one["id"], {}), one, keys) for one in records.run.literature["claims"]]


def _statement(name: str, stated: Mapping[str, Any], found: Mapping[str, Any], keys: Mapping[str, str]) -> StatementView:
    smallest, tried = found.get("smallest"), found.get("tried")
    shown = {key: value for key, value in (smallest or {}).items() if key not in ("quantities", "computed", "in_box", "n", "m", "p")}
    return StatementView(
        name=name,
        field=found["field"],
        statement=stated.get("statement", "its words are not in the file of this version"),
        source=cited(stated.get("source", ""), keys),
        verdict=found["verdict"],
        expected=str(found["expected"]),
        as_expected=not found["verdict"] or agrees(found["verdict"], found["expected"]),
        counterexample=_systems(shown) if smallest else "",
        tried=f"{tried['systems']} {tried['of']} with {tried['box']}, {tried['met']} meet the hypotheses" if tried else "",
    )


def _systems(found: Mapping[str, Any]) -> str:
    """Return a counterexample on one line, as the terminal shows it."""
    return json.dumps(found).replace('"', "").strip("{}")
