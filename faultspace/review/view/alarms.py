"""What is not as it should be, found by comparing and not by believing a flag: a page shows it before anything else.

Alarm     what was expected and what came, with the place of the page that tells more
alarms    all of a page
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ...proofs.verdict.origin import checkers
from ..records import Records
from .claims import SHORT, ClaimView


@dataclass(frozen=True)
class Alarm:
    """`of` names what it is about; `words` say what came and what was expected."""

    of: str
    words: str
    href: str


def alarms(claims: list[ClaimView], records: Records) -> list[Alarm]:
    """Return whatever is not as expected: verdicts first, then what they rest on."""
    return [*_verdicts(claims), *_hypotheses(records), *_certificates(records), *_controls(records)]


def _verdicts(claims: list[ClaimView]) -> Iterator[Alarm]:
    if not claims:
        yield Alarm("the run", "no claim was decided", "#claims")
    for claim in claims:
        if not claim.as_expected:
            yield Alarm(claim.name, f"the verdict is {claim.verdict}, {claim.expected} was expected", f"#{claim.place}")
        for one in claim.readings:
            if not one.as_expected:
                words = f"the verdict is {one.verdict}, {one.expected} was expected; {one.evidence}"
                yield Alarm(f"{claim.name}, {one.name}", words, f"#{claim.place}")


def _hypotheses(records: Records) -> Iterator[Alarm]:
    for row in records.run.verdicts["hypotheses"]:
        wrong = row["expected"] is not None and row["verdict"] != row["expected"]
        if wrong or not row["as_expected"]:
            words = f"the verdict is {row['verdict']}, {row['expected']} was expected; {row['evidence']}"
            yield Alarm(f"{row['claim']} without {' and '.join(row['dropped']) or 'anything'}", words, "#hypotheses")


def _certificates(records: Records) -> Iterator[Alarm]:
    here = {one["file"]: one["sha256"] for one in checkers()}
    other = [one["file"] for one in records.run.origin["checkers"] if here.get(one["file"]) != one["sha256"]]
    if other:
        yield Alarm("the checker", f"this page was made with another {', '.join(other)} than the run", "#certificates")
    for digest, said in records.checked.items():
        if not said["accepted"]:
            kind = records.run.certificates[digest]["kind"]
            yield Alarm(f"certificate {kind}-{digest[:SHORT]}", f"the checker refused it: {said['words']}", "#certificates")
    named = {
        one["sha256"]: one["kind"]
        for part in (
            *(reading for claim in records.run.verdicts["claims"] for reading in claim["readings"]),
            *records.run.verdicts["hypotheses"],
        )
        for one in part["certificates"]
    }
    missing = [f"{kind}-{digest[:SHORT]}" for digest, kind in named.items() if digest not in records.run.certificates]
    if missing:
        yield Alarm("certificates", f"{len(missing)} that the run names are not in its folder, {missing[0]} for one", "#certificates")


def _controls(records: Records) -> Iterator[Alarm]:
    for kind, row in records.controls["spoiled"].items():
        if row["accepted"]:
            yield Alarm(f"spoiled certificates, {kind}", f"the checker accepted {len(row['accepted'])} of {row['tried']}", "#controls")
    for one in records.controls["statements"]:
        if not one["refused"]:
            words = f"it is {one['verdict']}, and its true neighbour is {one['verdict_of_true']}"
            yield Alarm(f"the false statement {one['words']!r}", words, "#controls")
