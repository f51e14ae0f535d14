"""From the paper's statements to the theorems: the text of docs/paper-to-proof.md, computed from the ledger, the sources of Rocq and the
language of claims.

    of_the_paper     the claims that the ledger refers to [G25], in its order
    TheoremRow       a theorem of a reading: where it stands, what it supposes, and which examples say the words of that
    ReadingRow       a reading, a case that meets what it supposes, and its theorems
    rows             the readings of a claim
    lines            the page, in Markdown
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from ..base.progress import silent
from .brought.instances import meeting
from .brought.readings import readings
from .hypotheses import ablations
from .rocq.premises import Examples, Instance, examples, instances, parts, words
from .rocq.sources import beyond, paths, sources
from .rocq.statements import Headline, Statements, read
from .verdict.ablation import Ablation
from .verdict.ledger import Claim, Reading, expected_without, load
from .verdict.verdicts import Verdict, of_readings
from .verdict.workbench import Workbench

PAPER, OURS = "[G25]", "ours"
THEORY, BEYOND = "../proofs/theory", "../proofs/theory_beyond"
NONE = "no instance is computed"
COUNTEREXAMPLE, INSTANCES = "the counterexample of", "what its theorems suppose is met together, which is proved:"
PROVED = "met together, which is proved by"
NOTHING_SUPPOSED, NO_WORD = "it supposes nothing", "they use no word of ours"


@dataclass(frozen=True)
class TheoremRow:
    """`premises` are texts of Rocq. `met` tells the theorem that they hold together, or examples that say all their words; "" where there
    is neither, and then `nearest` what lacks."""

    name: str
    file: str
    line: int
    premises: tuple[str, ...]
    met: str
    nearest: str


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
        theorems = tuple(_theorem(name, reading.theorems) for name in reading.theorems)
        found.append(ReadingRow(reading, _met(claim, reading, theorems), theorems))
    return found


def _met(claim: Claim, reading: Reading, theorems: Sequence[TheoremRow]) -> str:
    """Return in words what meets the hypotheses of a reading: of a refuted one its counterexample."""
    name, refuted = f"{claim.id}--{reading.id}", reading.expected == "REFUTED"
    if name in readings():
        case = meeting(name, refuted=refuted)
        return "" if case is None else f"`{case}`{', its counterexample' if refuted else ''}"
    if refuted and theorems and all(one.met for one in theorems):
        compared = _by_words(theorems)
        weaker = f"; of the premises of {', '.join(f'`{name}`' for name in compared)} the words alone are compared" if compared else ""
        return f"{COUNTEREXAMPLE} {', '.join(f'`{one.name}`' for one in theorems)}{weaker}"
    if reading.hypotheses and theorems and all(one.met for one in theorems) and not _by_words(theorems) and (proved := _proved(theorems)):
        return f"{INSTANCES} {', '.join(f'`{name}_instance`' for name in proved)}"
    return "" if reading.hypotheses else NOTHING_SUPPOSED


def _proved(theorems: Sequence[TheoremRow]) -> list[str]:
    """Return the names of those of which an instance is proved."""
    return [one.name for one in theorems if one.met.startswith(PROVED)]


def _by_words(theorems: Sequence[TheoremRow]) -> list[str]:
    """Return the names of those whose premises are met as far as words tell."""
    return [one.name for one in theorems if one.met not in ("", NOTHING_SUPPOSED, NO_WORD) and not one.met.startswith(PROVED)]


@cache
def _statements() -> Statements:
    return read(sources())


@cache
def _examples() -> Examples:
    return examples(_statements())


@cache
def _instances() -> dict[str, Instance]:
    return instances(_statements(), sources() | beyond())


@cache
def _theorem(name: str, beside: tuple[str, ...]) -> TheoremRow:
    headline = _statements().headlines[name]
    before, _, _ = sources()[headline.file].partition(f"Theorem {name} ")
    met, nearest = _how_met(headline, beside)
    return TheoremRow(name, paths()[headline.file], before.count("\n") + 1, parts(headline).premises, met, nearest)


def _how_met(headline: Headline, beside: tuple[str, ...]) -> tuple[str, str]:
    """Return which examples say all words that a headline supposes, or, where none do, the nearest one and what it lacks."""
    premises = parts(headline).premises
    if (one := _instances().get(headline.name)) is not None:
        place = f"{BEYOND}/{one.file}" if one.file in beyond() else f"{THEORY}/{paths()[one.file]}"
        return f"{PROVED} `{headline.name}_instance`, [{one.file}]({place}), line {one.line}", ""
    wanted = words(_statements(), headline, premises)
    if not wanted:
        return (NO_WORD if premises else NOTHING_SUPPOSED), ""
    found = _examples().saying(wanted, beside)
    names = " and ".join(f"`{name}`" for name in found.names)
    if not found.lacking:
        return (f"{names} say all their words together" if len(found.names) > 1 else f"{names} says all their words of one example"), ""
    if found.lacking == wanted:
        return "", NONE
    lacking = ", ".join(f"`{key.partition('.')[2]}`" for key in sorted(found.lacking))
    return "", f"{NONE}: nearest {'come' if len(found.names) > 1 else 'comes'} {names}, without {lacking}"


def lines() -> list[str]:
    """Return the page: how many have an instance, then a section for each claim."""
    found = {claim: rows(claim) for claim in of_the_paper()}
    return [*_counts([row for of_one in found.values() for row in of_one]), *(line for one in found.items() for line in _section(*one))]


def _counts(every: Sequence[ReadingRow]) -> Iterator[str]:
    empty = [row for row in every if not row.met]
    theorems = {one.name: one for row in every for one in row.theorems}.values()
    nothing, lacking = [one for one in theorems if one.met == NOTHING_SUPPOSED], [one.name for one in theorems if not one.met]
    numbers = [one for one in theorems if one.met == NO_WORD]
    proved = _proved([*theorems])
    compared = sum(row.met.startswith(COUNTEREXAMPLE) and bool(_by_words(row.theorems)) for row in every)
    said = len(theorems) - len(nothing) - len(numbers) - len(lacking) - len(proved)
    yield (
        f"The {len(every)} readings below rest on {len(theorems)} theorems. "
        f"{len(every) - len(empty)} readings suppose nothing or have a case below that meets"
    )
    yield (
        f"them, {compared} of them as far as words tell; of {len(empty)} {NONE}. {len(nothing)} theorems suppose nothing, "
        f"and {len(numbers)} only what uses no word of ours; the words that {said}"
    )
    yield f"suppose are said by examples, and of {len(lacking)} {NONE}: {', '.join(f'`{name}`' for name in lacking)}."
    yield f"Of {len(proved)} it is proved that all premises can be met together."
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
    """Return which readings of the paper's words fail or hold, and which are ours."""
    printed = [one for one in claim.readings if not one.repair]
    kinds = {
        "Refuted as the paper can be read": [one for one in printed if one.expected == "REFUTED"],
        "Standing as the paper can be read": [one for one in printed if one.expected != "REFUTED"],
        "Ours, and not the paper's": [one for one in claim.readings if one.repair],
    }
    return " ".join(f"{what}: {', '.join(one.id for one in found)}." for what, found in kinds.items() if found)


def _reading(row: ReadingRow) -> Iterator[str]:
    reading = row.reading
    yield f"**{reading.id}**{' (ours)' if reading.repair else ''}, {reading.proved}. {reading.statement}"
    yield ""
    yield f"- If: {'; '.join(reading.hypotheses) or 'nothing is supposed'}."
    yield f"- Met by: {row.met or NONE}."
    for one in row.theorems:
        file, premises = one.file.rpartition("/")[2], ", ".join(f"`{text}`" for text in one.premises)
        supposed = f"Premises: {premises}; {one.met or one.nearest}" if premises else "It supposes nothing"
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
        return "[a counterexample](hypotheses.md)"
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
