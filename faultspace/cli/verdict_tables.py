"""Make the long tables of `faultspace verify`, as `--verbose` prints them.

verdict_table      a row for each reading, with its statement, hypotheses, evidence and certificates
hypotheses_table   a row for each hypothesis dropped
rows_worth_reading          the rows that are worth showing; all are in the JSON
attack_lines       what the adversary tried on a statement
hashes             certificates by the start of their SHA-256
verdict_text       a verdict, and in words the one that was expected where it is another
"""

from __future__ import annotations

from collections.abc import Sequence

from rich import box
from rich.table import Table
from rich.text import Text

from ..proofs.evidence.attacks import Attacked
from ..proofs.trust.structure_certificates import Certificate, sha256
from ..proofs.verdict.verdicts import ClaimResult, Report, Row, Verdict

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


def verdict_table(report: Report) -> Table:
    """Return a table with a row for each claim as stated and one for each reading as checked, with what its verdict rests on."""
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1), pad_edge=False)
    table.add_column("claim / reading", overflow="fold", max_width=32)
    table.add_column("verdict", no_wrap=True)
    table.add_column("statement / hypotheses / evidence", overflow="fold")
    table.add_column("certificates", no_wrap=True)
    table.add_column("own s", no_wrap=True, justify="right")
    for claim in report.claims:
        stated = Text.assemble((claim.claim.statement, "bold"), (f"  ({claim.claim.reference}) {_standing(claim)}", "dim"))
        table.add_row(Text(claim.claim.id, style="bold"), verdict_text(claim.verdict, claim.expected, "\n"), stated, "", "")
        for result in claim.readings:
            reading, outcome = result.reading, result.outcome
            words = Text.assemble(
                reading.statement,
                (f"\nhypotheses: {'; '.join(reading.hypotheses) or 'none'}", "dim"),
                (f"\n{outcome.evidence}", "dim italic"),
                (f"\nfor all systems: {reading.missing}" if reading.missing else "", "dim italic"),
                ("".join(f"\nattacked by {line}" for line in attack_lines(result.attacks)), "dim italic"),
            )
            name = f"  {reading.id}{' (ours)' if reading.repair else ''}"
            verdict = verdict_text(outcome.verdict, result.expected, "\n")
            table.add_row(name, verdict, words, hashes(outcome.certificates, outcome.accepted), f"{result.seconds:.1f}")
        table.add_section()
    return table


def hypotheses_table(rows: Sequence[Row]) -> Table:
    """Return a table of which hypotheses are needed: a row for each dropped alone, and for each two that are needed only together."""
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1), pad_edge=False, title="which hypotheses are needed", title_justify="left")
    table.add_column("claim / without", overflow="fold", max_width=44)
    table.add_column("verdict", no_wrap=True)
    table.add_column("counterexample or evidence", overflow="fold")
    table.add_column("certificates", no_wrap=True)
    ablation = None
    for row in rows_worth_reading(rows):
        if row.ablation != ablation:
            ablation = row.ablation
            table.add_section()
            table.add_row(Text(row.claim, style="bold"), "", Text(row.conclusion, style="bold"), "")
        name = f"  {' and '.join(row.dropped) or 'nothing dropped'}"
        verdict = Text.assemble(verdict_text(row.verdict, row.expected or row.verdict, "\n"), ("\n" + row.meaning, "dim"))
        words = Text("\n".join([row.evidence, *(f"attacked by {line}" for line in attack_lines(row.attacks))]), style="dim italic")
        table.add_row(name, verdict, words, hashes(row.certificates, row.accepted))
    return table


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


def verdict_text(verdict: Verdict, expected: str, between: str = " ") -> Text:
    """Return the verdict, red beside the expected one where it is another."""
    if verdict == expected:
        return Text(str(verdict), style=STYLES[verdict])
    return Text(f"{verdict}{between}(expected {expected})", style="bold red")
