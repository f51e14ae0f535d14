"""Print what `faultspace verify` says by itself, and the page of a claim, which `--claim ID` and `--verbose` ask for.

print_differences   what is not as expected, before all else
print_rest         the hypotheses, the attacks and Rocq, a sentence each; print_machine: the last of these
print_summary      the last line
hypothesis_words, attack_words   a sentence each
print_page         a claim in full: its readings with evidence, attacks, locks and certificates, then what happens without each hypothesis
rows_worth_reading   the rows that are worth showing; all are in the JSON
attack_lines       what the adversary tried on a statement
hashes             certificates by the start of their SHA-256
verdict_text       a verdict, and in words the one that was expected where it is another
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from rich.console import Console
from rich.text import Text

from ..base.sheets import counted
from ..proofs.evidence.attacks import Attacked
from ..proofs.rocq.build import told
from ..proofs.trust.structure_certificates import Certificate, sha256
from ..proofs.verdict.verdicts import ClaimResult, ReadingResult, Report, Row, Verdict
from .claim_cards import STYLES
from .consoles import paragraph

SHORT = 12
MOST_SHOWN = 2
HELP = "--claim ID prints the card of a claim, -v all readings, --out DIR writes the certificates."


def rows_worth_reading(rows: Sequence[Row]) -> list[Row]:
    """Return the rows of one hypothesis, and of two where they are needed only together or the check did not finish: the others follow."""
    follows = (Verdict.CERTIFIED, Verdict.PROVED)
    return [row for row in rows if len(row.dropped) < 2 or (row.verdict not in follows and row.already is None)]


def attack_lines(attacks: Sequence[Attacked]) -> list[str]:
    """Return what the adversary tried on one statement, a line each, with what is wrong with a stored attack."""
    return [f"{one.id}: {one.words}{f' ({one.trouble})' if one.trouble else ''}" for one in attacks]


def _standing(claim: ClaimResult) -> str:
    """Return how many of the readings of its words are not refuted."""
    stated = [result for result in claim.readings if not result.reading.repair]
    standing = sum(result.outcome.verdict not in (Verdict.REFUTED, Verdict.ERROR) for result in stated)
    return f"As stated: {standing} of {len(stated)} {'parts' if claim.claim.in_parts else 'readings'} stand."


def hashes(certificates: Sequence[Certificate], accepted: int) -> str:
    """Return the first headline certificates by the start of their SHA-256, and how many the checker accepted in all."""
    found = [sha256(certificate)[:SHORT] for certificate in certificates]
    more = [f"+ {len(found) - MOST_SHOWN} more"] if len(found) > MOST_SHOWN else []
    total = [f"{accepted} accepted"] if accepted else []
    return "\n".join([*found[:MOST_SHOWN], *more, *total])


def verdict_text(verdict: Verdict, expected: str) -> Text:
    """Return the verdict, red beside the expected one where it is another."""
    if verdict == expected:
        return Text(str(verdict), style=STYLES[verdict])
    return Text(f"{verdict} (expected {expected})", style="bold red")


def print_page(console: Console, claim: ClaimResult, rows: Sequence[Row]) -> None:
    """Print the claim in full, and `rows`, what becomes of it without its hypotheses."""
    heading = Text.assemble((claim.claim.id, "bold"), f"  ({claim.claim.reference}): ", verdict_text(claim.verdict, claim.expected))
    paragraph(console, heading)
    paragraph(console, claim.claim.statement, f"  {claim.claim.whose}: ")
    paragraph(console, _standing(claim), "  ")
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


def print_rest(console: Console, report: Report) -> None:
    """Print a sentence on each of what the verdicts rest on."""
    if report.hypotheses:
        paragraph(console, hypothesis_words(report.hypotheses), "Hypotheses: ")
    paragraph(console, attack_words(report), "Searches: ")
    print_machine(console, report)
    paragraph(console, Text(HELP, style="dim"))


def print_machine(console: Console, report: Report) -> None:
    """Print what Rocq has checked, and by which programs and files."""
    paragraph(console, report.machine, "Machine-checked: ")
    if report.believed is not None:
        paragraph(console, told(report.believed), "Believed: ")


def print_differences(console: Console, report: Report) -> None:
    """Print a line for whatever is not as expected: this stands before all else."""
    for line in differences(report):
        paragraph(console, Text(line, style="bold red"), "! ")


def differences(report: Report) -> Iterator[str]:
    """Yield a line for whatever is not as expected."""
    for claim in report.claims:
        if claim.verdict != claim.expected:
            yield f"{claim.claim.id}: {claim.verdict} (expected {claim.expected})"
        for result in claim.readings:
            if not result.as_expected:
                outcome = result.outcome
                yield f"{claim.claim.id}, {result.reading.id}: {outcome.verdict} (expected {result.expected}); {outcome.evidence}"
    for row in report.hypotheses:
        if not row.as_expected:
            expected = f" (expected {row.expected})" if row.expected not in (None, row.verdict) else ""
            yield f"{_without(row)}: {row.verdict}{expected}; {row.evidence}"


def hypothesis_words(rows: Sequence[Row]) -> str:
    """Return how many hypotheses are needed, how many are proved not to be, and where only no counterexample was found."""
    single = [row for row in rows if len(row.dropped) == 1]
    meanings = Counter(row.meaning or "undecided, the check did not finish" for row in single)
    words = {
        "needed": "needed (a counterexample without it)",
        "not needed": "proved not needed",
        "follows from the others": "that follow from the others",
        "not seen to be needed": "without which no counterexample was found",
    }
    order = [*words, *(meaning for meaning in meanings if meaning not in words)]
    parts = ", ".join(f"{meanings[meaning]} {words.get(meaning, meaning)}" for meaning in order if meanings[meaning])
    together = [row for row in rows if len(row.dropped) == 2]
    pairs = sum(row.verdict == Verdict.REFUTED and row.already is None for row in together)
    return f"{len(single)} dropped alone: {parts or 'none'}; {counted(len(together), 'pair')}: {pairs} needed only together."


def attack_words(report: Report) -> str:
    """Return how many stored attacks this run has looked at again, and what came of them."""
    readings = [(attack, result.outcome.verdict) for claim in report.claims for result in claim.readings for attack in result.attacks]
    attacked = readings + [(attack, row.verdict) for row in report.hypotheses for attack in row.attacks]
    if not attacked:
        return "none is stored on these claims."
    found = [verdict for attack, verdict in attacked if attack.refutes]
    trouble = sum(attack.trouble is not None for attack, _ in attacked)
    standing = sum(verdict != Verdict.REFUTED for verdict in found)
    against = "all of refuted statements" if not standing else f"{standing} against a verdict other than REFUTED"
    ends = f"; {trouble} are out of date or were not found again" if trouble else ""
    nothing = len(attacked) - len(found)
    confirmed = f"{len(found)} confirm a counterexample, {against}"
    return f"{len(attacked)} stored searches were repeated: {confirmed}; {nothing} found nothing{ends}."


def print_summary(console: Console, report: Report) -> None:
    """Print in one line whether everything is as expected, and of what."""
    readings = [reading for claim in report.claims for reading in claim.readings]
    different = [claim.claim.id for claim in report.claims if not claim.as_expected]
    different += [_without(row) for row in report.hypotheses if not row.as_expected]
    tail = (
        f"{counted(len(readings), 'reading')}, {counted(len(report.hypotheses), 'set')} of "
        f"hypotheses dropped, {counted(len(report.decided()), 'distinct certificate')} accepted, "
        f"effort {report.effort}, {report.seconds:.0f} s"
    )
    count = "the claim" if len(report.claims) == 1 else f"all {len(report.claims)} claims"
    if different:
        paragraph(
            console, Text(f"NOT as expected: {', '.join(different)}; {counted(len(report.claims), 'claim')}, {tail}", style="bold red")
        )
    else:
        paragraph(console, Text(f"as expected: {count}; {tail}", style="bold green"))


def _without(row: Row) -> str:
    return f"{row.claim} without {' and '.join(row.dropped) or 'anything'}"
