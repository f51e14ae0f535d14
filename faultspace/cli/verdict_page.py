"""Print the page of a claim for `faultspace verify --claim ID`.

print_page   as stated, as checked, evidence, attacks, locks and certificates of each reading, then what happens without each hypothesis
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rich.console import Console
from rich.text import Text

from ..base.sheets import counted
from ..proofs.trust.structure_certificates import sha256
from ..proofs.verdict.verdicts import ClaimResult, ReadingResult, Row
from .consoles import paragraph
from .verdict_tables import attack_lines, hashes, rows_worth_reading, verdict_text


def print_page(console: Console, claim: ClaimResult, rows: Sequence[Row]) -> None:
    """Print the claim in full, and `rows`, what becomes of it without its hypotheses."""
    heading = Text.assemble((claim.claim.id, "bold"), f"  ({claim.claim.reference}): ", verdict_text(claim.verdict, claim.expected))
    paragraph(console, heading)
    paragraph(console, claim.claim.statement, f"  {claim.claim.whose}: ")
    for result in claim.readings:
        kind = "reading of ours" if result.reading.repair else "reading"
        name = Text.assemble((result.reading.id, "bold"), ": ", verdict_text(result.outcome.verdict, result.expected))
        paragraph(console, name, f"  {kind} ")
        for label, text in _reading(result):
            paragraph(console, text, f"    {label:<14}")
    ablation = None
    for row in rows_worth_reading(rows):
        if row.ablation != ablation:
            ablation = row.ablation
            paragraph(console, row.conclusion, "  which hypotheses are needed for: ")
        meaning = f", {row.meaning}" if row.meaning else ""
        verdict = Text.assemble(verdict_text(row.verdict, row.expected or row.verdict), meaning)
        dropped = f"without {' and '.join(row.dropped)}" if row.dropped else "with all of them"
        paragraph(console, Text.assemble(dropped, ": ", verdict), "  ")
        for label, text in _row(row):
            paragraph(console, text, f"    {label:<14}")
    console.print()


def _row(row: Row) -> Iterator[tuple[str, str]]:
    """Yield (label, text) for each line below what is dropped."""
    yield "evidence:", row.evidence
    for line in attack_lines(row.attacks):
        yield "attacked by:", line
    if row.certificates or row.accepted:
        yield "certificates:", ", ".join(hashes(row.certificates, row.accepted).splitlines())


def _reading(result: ReadingResult) -> Iterator[tuple[str, str]]:
    """Yield (label, text) for each line below the reading's name."""
    reading, outcome = result.reading, result.outcome
    yield "as checked:", reading.statement
    yield "hypotheses:", "; ".join(reading.hypotheses) or "none"
    yield "evidence:", outcome.evidence
    if reading.missing:
        yield "to a proof:", reading.missing
    for line in attack_lines(result.attacks):
        yield "attacked by:", line
    yield "accepted:", f"{counted(outcome.accepted, 'certificate')} by the checker"
    for name, lock in result.locks.items():
        yield "theorem:", f"{name}, locked as SHA-256 {lock}"
    for certificate in outcome.certificates:
        yield "certificate:", f"{certificate['kind']}, SHA-256 {sha256(certificate)}"
    yield "seconds:", f"{result.seconds:.1f}, beside the making of the certificates that readings share"
