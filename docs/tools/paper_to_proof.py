"""From the paper's statements to the theorems: a page computed from the ledger, the sources of Rocq and the language of claims.

of_the_paper     the claims that the ledger refers to [G25], in its order
TheoremRow       a theorem of a reading: where it stands, what it supposes, and where it is proved that this can be met
ReadingRow       a reading, a case that meets what it supposes, and its theorems
rows             the readings of a claim
page             the page, in Markdown, as it stands two folders below the top
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from faultspace.base.progress import silent
from faultspace.proofs.brought.readings import readings
from faultspace.proofs.hypotheses import ablations
from faultspace.proofs.rocq.sources import beyond, paths, sources
from faultspace.proofs.rocq.statements import Statements, read
from faultspace.proofs.verdict.ablation import Ablation
from faultspace.proofs.verdict.ledger import OURS, Claim, Reading, expected_without, load
from faultspace.proofs.verdict.verdicts import Verdict, of_readings
from faultspace.proofs.verdict.workbench import Workbench

from .instances import meeting
from .premises import Instance, instances, premises

PAPER = "[G25]"
THEORY, BEYOND = "../../proofs/theory", "../../proofs/theory_beyond"
NONE = "no instance is computed"
BY_THEOREMS = "what each of its theorems supposes can be met together"
HEAD = """# From the paper to the proofs

This page is made of the [ledger](../../proofs/verdict/ledger.toml), the sources of the [theory](../../proofs/theory/README.md) and the
texts of the language of claims. Each claim of the ledger that is taken from [G25] has a section, in the order of the ledger: the claim as
the review states it, each way to read it with the [verdict](../../docs/claims.md) that the ledger expects where there is Rocq, and its
theorems. Of a refuted reading these are its counterexample. A matrix of the theorems is the transpose of the paper's
([row vectors](../../proofs/theory/README.md#row-vectors)). [The statements in full](statements.md) have every word that they use.

- *Met by* tells a case that meets a reading, or what is proved of the premises of its theorems. Where the
  [language of claims](../../docs/your-claims.md) says the reading, it is the smallest case of its box over Q in which C and F (of a record
  C and B) are not zero and everything that it supposes holds, what an implication supposes that it concludes included. Where the reading is
  refuted, it is the smallest that also fails. The two systems of a pair may be one.
- Of each theorem that supposes something of what it is about it is proved that all its premises *can be met together*: `NAME_instance`, a
  theorem on a small system, says just that, in the words of the headline. Each meets the premises of one theorem, which need not be all
  that the reading supposes.
- A premise within what a theorem says to exist is printed with the others, and needs no instance: what exists is proved and not chosen.
- Where *no instance is computed*, the language does not say the reading, no theorem does, and it is not refuted. That is no sign that there
  is none: `faultspace verify` tries such readings on cases that it makes, with certificates.
- The tables tell what becomes of a conclusion without each of its hypotheses. A counterexample is shown by
  `faultspace verify --claim ID`; [the hypotheses](../../docs/hypotheses.md) has all claims. *Not known to be needed* means that nothing
  that was tried fails without it, and that no theorem says that it is not needed.
"""


@dataclass(frozen=True)
class TheoremRow:
    """`premises` are texts of Rocq. `instance` leads to the theorem that they can be met together; it is "" where nothing is supposed of
    what the theorem is about, and only there."""

    name: str
    file: str
    line: int
    premises: tuple[str, ...]
    instance: str


@dataclass(frozen=True)
class ReadingRow:
    """`met` tells a case that meets what the reading supposes; "" where none is computed."""

    reading: Reading
    met: str
    theorems: tuple[TheoremRow, ...]


def of_the_paper() -> list[Claim]:
    """Return the claims of the paper; those of the review alone and ours are left out."""
    return [claim for claim in load() if PAPER in claim.reference and not claim.reference.startswith(OURS)]


def rows(claim: Claim) -> list[ReadingRow]:
    """Return a row for each reading of the claim."""
    found = []
    for reading in claim.readings:
        theorems = tuple(_theorem(name) for name in reading.theorems)
        found.append(ReadingRow(reading, _met(claim, reading, theorems), theorems))
    return found


def _met(claim: Claim, reading: Reading, theorems: Sequence[TheoremRow]) -> str:
    """Return in words what meets the hypotheses of a reading: of a refuted one its counterexample."""
    name, refuted = f"{claim.id}--{reading.id}", reading.expected == "REFUTED"
    if name in readings():
        case = meeting(name, refuted=refuted)
        return "" if case is None else f"`{case}`{', its counterexample' if refuted else ''}"
    if refuted:
        shown = f"that `faultspace verify --claim {claim.id}` shows, with certificates"
        return f"the counterexample {'of ' + ', '.join(f'`{one.name}`' for one in theorems) if theorems else shown}"
    if reading.hypotheses and (proved := [one.name for one in theorems if one.instance]):
        return f"{BY_THEOREMS}, which is proved: {', '.join(f'`{name}_instance`' for name in proved)}"
    return "" if reading.hypotheses else "it supposes nothing"


@cache
def _statements() -> Statements:
    return read(sources())


@cache
def _instances() -> dict[str, Instance]:
    return instances(_statements(), sources() | beyond())


@cache
def _theorem(name: str) -> TheoremRow:
    headline = _statements().headlines[name]
    before, _, _ = sources()[headline.file].partition(f"Theorem {name} ")
    return TheoremRow(name, paths()[headline.file], before.count("\n") + 1, premises(headline), _instance(name))


def _instance(name: str) -> str:
    one = _instances().get(name)
    if one is None:
        return ""
    place = f"{BEYOND}/{one.file}" if one.file in beyond() else f"{THEORY}/{paths()[one.file]}"
    return f"`{name}_instance`, [{one.file}]({place}), line {one.line}"


@cache
def page() -> str:
    """Return the page: what its words mean, how many have an instance, then a section for each claim."""
    found = {claim: rows(claim) for claim in of_the_paper()}
    counts = _counts([row for of_one in found.values() for row in of_one])
    return "\n".join([HEAD, *counts, *(line for one in found.items() for line in _section(*one))])


def _counts(every: Sequence[ReadingRow]) -> Iterator[str]:
    empty = [f"`{row.reading.id}`" for row in every if not row.met]
    by_theorems = sum(row.met.startswith(BY_THEOREMS) for row in every)
    theorems = {one.name: one for row in every for one in row.theorems}.values()
    proved = sum(bool(one.instance) for one in theorems)
    met = len(every) - len(empty) - by_theorems
    yield f"The {len(every)} readings below rest on {len(theorems)} theorems. {met} readings suppose nothing or have a case below that"
    lacking = f"; of {len(empty)} {NONE}: {', '.join(empty)}" if empty else ""
    yield f"meets them; of the theorems of {by_theorems} it is proved, one by one, that what they suppose can be met{lacking}."
    yield f"{len(theorems) - proved} theorems suppose nothing of what they are about; of each of the other {proved} it is proved that all"
    yield "that it supposes can be met together."
    yield ""


def _section(claim: Claim, found: Sequence[ReadingRow]) -> Iterator[str]:
    verdict = of_readings([(one, Verdict(one.proved)) for one in claim.readings], in_parts=claim.in_parts)
    yield from (
        f"## {claim.id}",
        "",
        f"{claim.reference}.",
        "",
        f"> {claim.statement}",
        "",
        f"The claim is {verdict}. {_differs(claim)}",
        "",
    )
    for row in found:
        yield from _reading(row)
    yield from _dropped(claim)


def _differs(claim: Claim) -> str:
    """Return which readings of the words fail or hold, and which are ours."""
    stated = [one for one in claim.readings if not one.repair]
    kinds = {
        "Refuted readings of these words": [one for one in stated if one.expected == "REFUTED"],
        "Standing readings of these words": [one for one in stated if one.expected != "REFUTED"],
        "Ours": [one for one in claim.readings if one.repair],
    }
    return " ".join(f"{what}: {', '.join(one.id for one in found)}." for what, found in kinds.items() if found)


def _reading(row: ReadingRow) -> Iterator[str]:
    reading = row.reading
    yield f"**{reading.id}**{' (ours)' if reading.repair else ''}, {reading.proved}. {reading.statement}"
    yield ""
    yield f"- If: {'; '.join(reading.hypotheses) or 'nothing is supposed'}."
    yield f"- Met by: {row.met or NONE}."
    for one in row.theorems:
        file, supposed = one.file.rpartition("/")[2], ", ".join(f"`{text}`" for text in one.premises)
        supposed = f"Premises: {supposed}" if supposed else "It supposes nothing"
        supposed += f"; they can be met together: {one.instance}" if one.instance else ""
        yield f"- `{one.name}`, [{file}]({THEORY}/{one.file}), line {one.line}. {supposed}."
    if not row.theorems:
        yield "- No theorem."
    if reading.missing:
        yield f"- A proof lacks: {reading.missing}."
    yield ""


def _dropped(claim: Claim) -> Iterator[str]:
    """Yield, for each conclusion whose hypotheses are dropped in turn, what becomes of it without each."""
    about = [one for one in ablations() if one.claim == claim.id]
    if not about:
        yield from ("No hypothesis of this claim is dropped in turn.", "")
        return
    yield from ("| conclusion | hypothesis | without it |", "|---|---|---|")
    for ablation in about:
        for name, entry in expected_without()[ablation.name].items():
            yield f"| {ablation.conclusion} | {name} | {_without(ablation, name, entry)} |"
    yield ""
    if not any(f"{claim.id}--{one.id}" in readings() for one in claim.readings):
        for subject in dict.fromkeys(_subject(ablation) for ablation in about):
            yield from (f"All hypotheses of the table, and its conclusion, hold of `{subject}`.", "")


def _without(ablation: Ablation[Any], name: str, entry: str) -> str:
    if entry == "REFUTED":
        return "[a counterexample](../../docs/hypotheses.md)"
    if entry == "IMPLIED":
        return f"it follows from the others: {ablation.implied[name]}"
    proved = ablation.theorems_without((name,))
    return f"not needed: {', '.join(f'`{one}`' for one in proved)}" if proved else "not known to be needed"


def _subject(ablation: Ablation[Any]) -> str:
    """Return the first subject that is not degenerate and meets all hypotheses; the conclusion holds of it. Raises StopIteration: none."""
    subjects = ablation.subjects(_bench())
    return str(next(one for one in subjects if not ablation.violated(one) and not one.degenerate and ablation.holds(one)))


@cache
def _bench() -> Workbench:
    return Workbench("quick", 1, silent)
