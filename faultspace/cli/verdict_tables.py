"""Print what `faultspace verify` says by itself, and the page of a claim, which `--claim ID` and `--verbose` ask for.

print_differences   what is not as expected, before all else
print_lines        a line for each claim, what the verdicts mean, the hypotheses, the attacks, Rocq; print_machine: the last of these
print_summary      the last line
resting_on         how many readings of a claim have which verdict
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
from rich.table import Table
from rich.text import Text

from ..base.sheets import counted
from ..proofs.evidence.attacks import Attacked
from ..proofs.rocq.build import told
from ..proofs.trust.structure_certificates import Certificate, sha256
from ..proofs.verdict.verdicts import ClaimResult, ReadingResult, Report, Row, Verdict
from .consoles import paragraph, print_table

STYLES = {
    Verdict.PROVED: "bold green",
    Verdict.IDENTITY: "green",
    Verdict.CERTIFIED: "green",
    Verdict.REFUTED: "yellow",
    Verdict.AMENDED: "magenta",
    Verdict.ERROR: "bold red",
}
SHORT = 12
MOST_SHOWN = 2
HELP = "--claim ID prints a page of a claim, -v those of all, --out DIR writes the certificates."


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


def print_lines(console: Console, report: Report) -> None:
    """Print a line for each claim, then a sentence on each of what they rest on."""
    claims = sorted(report.claims, key=lambda claim: claim.as_expected)  # stable: else in the order of the ledger
    print_table(console, claims_table(claims))
    there = {claim.verdict for claim in claims} | {one.outcome.verdict for claim in claims for one in claim.readings}
    occurring = [verdict for verdict in Verdict if verdict in there]
    paragraph(console, Text("; ".join(f"{verdict}: {verdict.meaning}" for verdict in occurring) + ".", style="dim"))
    if report.hypotheses:
        paragraph(console, hypothesis_words(report.hypotheses), "hypotheses: ")
    paragraph(console, attack_words(report), "attacks: ")
    print_machine(console, report)
    paragraph(console, Text(HELP, style="dim"))


def print_machine(console: Console, report: Report) -> None:
    """Print what Rocq has checked, and by which programs and files."""
    paragraph(console, report.machine, "machine-checked: ")
    if report.believed is not None:
        paragraph(console, told(report.believed), "believed: ")


def print_differences(console: Console, report: Report) -> None:
    """Print a line for whatever is not as expected: this stands before all else."""
    for line in differences(report):
        paragraph(console, Text(line, style="bold red"), "! ")


def claims_table(claims: Sequence[ClaimResult]) -> Table:
    """Return a table with one row for each claim, where "!" marks those that are not as expected."""
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    table.add_column("claim", no_wrap=True)
    table.add_column("verdict", no_wrap=True)
    table.add_column("readings as stated", overflow="fold")
    table.add_column("readings of ours", overflow="fold")
    for claim in claims:
        name = Text(claim.claim.id) if claim.as_expected else Text(f"! {claim.claim.id}", style="bold red")
        verdict = Text(str(claim.verdict), style=STYLES[claim.verdict] if claim.as_expected else "bold red")
        table.add_row(name, verdict, resting_on(claim, ours=False), resting_on(claim, ours=True))
    return table


def resting_on(claim: ClaimResult, *, ours: bool) -> str:
    """Return how many of the readings of the words as stated, or of ours, have which verdict: "1 proved, 2 refuted"."""
    verdicts = [result.outcome.verdict for result in claim.readings if result.reading.repair == ours]
    counts = Counter(verdicts)
    parts = ", ".join(f"{counts[verdict]} {verdict.lower()}" for verdict in Verdict if counts[verdict])
    return f"parts: {parts}" if claim.claim.in_parts and not ours else parts or "-"


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
    return (
        f"{len(attacked)} looked at again: {len(found)} confirm a counterexample "
        f"({standing} of these against a verdict other than REFUTED), {len(attacked) - len(found)} found none; "
        f"{trouble} out of date or not found again."
    )


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
