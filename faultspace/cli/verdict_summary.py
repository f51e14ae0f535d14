"""Print what `faultspace verify` says by itself: a line for each claim, the unexpected ones first, and what stands behind them all.

print_differences   what is not as expected, before all else
print_lines         the claims, what the verdicts mean, the hypotheses, the attacks, Rocq
print_summary       the last line
resting_on          how many readings of a claim have which verdict
hypothesis_words, attack_words   a sentence each
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..base.sheets import counted
from ..proofs.rocq.build import told
from ..proofs.verdict.verdicts import ClaimResult, Report, Row, Verdict
from .consoles import paragraph, print_table
from .verdict_tables import STYLES

HELP = "--claim ID prints a page of a claim, -v the long tables, --out DIR writes the certificates."


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
