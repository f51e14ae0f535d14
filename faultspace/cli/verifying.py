"""`faultspace verify`: every claim of the ledger, decided anew, with a table of verdicts and the certificates they rest on.

run             the command's body
verdict_table   one row a reading
hypotheses_table   a row for each hypothesis dropped
attack_lines    what the adversary tried on a statement
statements      a claim in full: as printed, as checked, hypotheses, evidence, certificates
write_out       the headline certificates and verdicts.json into a folder
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..base.errors import InvalidInput, quote_path, shorten
from ..proofs.evidence.attacks import Attacked
from ..proofs.evidence.specimens import specimens
from ..proofs.rocq import recheck as rocq_recheck
from ..proofs.rocq.build import BrokenTheory, NoRocq, NotProved
from ..proofs.trust.structure_certificates import Certificate, sha256
from ..proofs.verdict.ledger import load
from ..proofs.verdict.verdicts import ClaimResult, ReadingResult, Report, Row, Verdict
from ..proofs.verification import verify
from .consoles import answers, print_json, stages
from .failures import ANSWERED, NOT_AS_EXPECTED, say
from .reading_files import prepare_folder, write_json

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


def run(claims: Sequence[str], *, effort: str, jobs: int, out: Path | None, recheck: bool, as_json: bool) -> int:
    """Decides the claims (all when none is named), with `recheck` by theorems that are compiled anew.

    Raises InvalidInput for an unknown claim or a folder that cannot be written into, and to recheck without Rocq.
    """
    known = [claim.id for claim in load()]
    for name in claims:
        if name not in known:
            raise InvalidInput(f"--claim: got {shorten(name)}, expected one of {', '.join(known)}")
    if out is not None:
        prepare_folder(out)
    if recheck and not _rechecked():
        return NOT_AS_EXPECTED
    with stages() as progress:
        report = verify(claims or None, effort=effort, jobs=jobs, progress=progress)
    if out is not None:
        count = write_out(report, out, () if claims else specimens())
        say(f"{count} certificates and verdicts.json are in {quote_path(str(out))}")
    if as_json:
        print_json(report.to_json())
    else:
        _print(answers(), report, in_full=bool(claims))
    return ANSWERED if report.as_expected else NOT_AS_EXPECTED


def _rechecked() -> bool:
    """Whether the theory, compiled anew, is accepted; says so. Raises InvalidInput where there is no Rocq."""
    try:
        with stages() as progress:
            say(f"the Rocq theory was {rocq_recheck.recheck(progress)}")
    except NoRocq as error:
        raise InvalidInput(f"--recheck: {error}") from None
    except (BrokenTheory, NotProved) as error:
        say(f"the Rocq theory, compiled anew, is not accepted: {error}")
        return False
    return True


def write_out(report: Report, folder: Path, more: Sequence[Certificate] = ()) -> int:
    """Writes every headline certificate, and more, as kind-<first 12 of its SHA-256>.json, then verdicts.json. How many certificates."""
    certificates = [*report.certificates(), *more]
    for certificate in certificates:
        write_json(folder / f"{certificate['kind']}-{sha256(certificate)[:SHORT]}.json", certificate)
    write_json(folder / "verdicts.json", report.to_json())
    return len(certificates)


def verdict_table(report: Report) -> Table:
    """A row for each claim as printed, and below it one for each reading as checked, with what its verdict rests on."""
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1), pad_edge=False)
    table.add_column("claim / reading", overflow="fold", max_width=32)
    table.add_column("verdict", no_wrap=True)
    table.add_column("statement / hypotheses / evidence", overflow="fold")
    table.add_column("certificates", no_wrap=True)
    table.add_column("seconds", no_wrap=True, justify="right")
    for claim in report.claims:
        printed = Text.assemble((claim.claim.statement, "bold"), (f"  ({claim.claim.reference}) {_standing(claim)}", "dim"))
        table.add_row(Text(claim.claim.id, style="bold"), _verdict(claim.verdict, claim.expected, "\n"), printed, "", "")
        for result in claim.readings:
            reading, outcome = result.reading, result.outcome
            told = Text.assemble(
                reading.statement,
                (f"\nhypotheses: {'; '.join(reading.hypotheses) or 'none'}", "dim"),
                (f"\n{outcome.evidence}", "dim italic"),
                (f"\nfor all systems: {reading.missing}" if reading.missing else "", "dim italic"),
                ("".join(f"\nattacked by {line}" for line in attack_lines(result.attacks)), "dim italic"),
            )
            name = f"  {reading.id}{' (repair)' if reading.repair else ''}"
            verdict = _verdict(outcome.verdict, result.expected, "\n")
            table.add_row(name, verdict, told, _hashes(outcome.certificates, outcome.accepted), f"{result.seconds:.1f}")
        table.add_section()
    return table


def hypotheses_table(rows: Sequence[Row]) -> Table:
    """Which hypotheses are needed: a row for each dropped alone, and for each two that are needed only together."""
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1), pad_edge=False, title="which hypotheses are needed", title_justify="left")
    table.add_column("claim / without", overflow="fold", max_width=44)
    table.add_column("verdict", no_wrap=True)
    table.add_column("counterexample or evidence", overflow="fold")
    table.add_column("certificates", no_wrap=True)
    experiment = None
    for row in rows:
        if row.experiment != experiment:
            experiment = row.experiment
            table.add_section()
            table.add_row(Text(row.claim, style="bold"), "", Text(row.conclusion, style="bold"), "")
        if len(row.dropped) < 2 or (row.verdict not in (Verdict.CERTIFIED, Verdict.PROVED) and row.already is None):
            name = f"  {' and '.join(row.dropped) or 'nothing dropped'}"
            verdict = Text.assemble(_verdict(row.verdict, row.expected or row.verdict, "\n"), ("\n" + row.meaning, "dim"))
            told = Text("\n".join([row.evidence, *(f"attacked by {line}" for line in attack_lines(row.attacks))]), style="dim italic")
            table.add_row(name, verdict, told, _hashes(row.certificates, row.accepted))
    return table


def attack_lines(attacks: Sequence[Attacked]) -> list[str]:
    """What the adversary tried on one statement, a line each, with what is wrong with a stored attack."""
    return [f"{one.id}: {one.words}{f' ({one.trouble})' if one.trouble else ''}" for one in attacks]


def _standing(claim: ClaimResult) -> str:
    """How many of the readings as printed are not refuted."""
    printed = [result for result in claim.readings if not result.reading.repair]
    standing = sum(result.outcome.verdict not in (Verdict.REFUTED, Verdict.ERROR) for result in printed)
    return f"As printed: {standing} of {len(printed)} {'parts' if claim.claim.in_parts else 'readings'} stand."


def _hashes(certificates: Sequence[Certificate], accepted: int) -> str:
    """The first headline certificates by the start of their SHA-256, and how many the checker accepted in all."""
    found = [sha256(certificate)[:SHORT] for certificate in certificates]
    more = [f"+ {len(found) - MOST_SHOWN} more"] if len(found) > MOST_SHOWN else []
    total = [f"{accepted} accepted"] if accepted else []
    return "\n".join([*found[:MOST_SHOWN], *more, *total])


def statements(claim: ClaimResult) -> Iterator[Text]:
    """The claim in full, line by line."""
    yield Text.assemble((claim.claim.id, "bold"), f"  ({claim.claim.reference}): ", _verdict(claim.verdict, claim.expected))
    yield Text(f"  as printed: {claim.claim.statement}")
    for reading in claim.readings:
        yield from _reading(reading)


def _reading(result: ReadingResult) -> Iterator[Text]:
    reading, outcome = result.reading, result.outcome
    kind = "repair" if reading.repair else "reading"
    yield Text.assemble(f"  {kind} ", (reading.id, "bold"), ": ", _verdict(outcome.verdict, result.expected))
    yield Text(f"    as checked:   {reading.statement}")
    yield Text(f"    hypotheses:   {'; '.join(reading.hypotheses) or 'none'}")
    yield Text(f"    evidence:     {outcome.evidence}")
    if reading.missing:
        yield Text(f"    to a proof:   {reading.missing}")
    for line in attack_lines(result.attacks):
        yield Text(f"    attacked by:  {line}")
    yield Text(f"    accepted:     {outcome.accepted} certificates by the checker")
    for name, lock in result.locks.items():
        yield Text(f"    theorem:      {name}, locked as SHA-256 {lock}")
    for certificate in outcome.certificates:
        yield Text(f"    certificate:  {certificate['kind']}, SHA-256 {sha256(certificate)}")


def _print(console: Console, report: Report, *, in_full: bool) -> None:
    if in_full:
        for claim in report.claims:
            for line in statements(claim):
                console.print(line, soft_wrap=True)
            console.print()
    else:
        console.print(verdict_table(report))
    if report.hypotheses:
        console.print(hypotheses_table(report.hypotheses))
    if not in_full:
        console.print("--claim ID tells a claim in full; --out DIR writes the certificates")
    if report.corpus:
        console.print(f"systems: {report.corpus}", soft_wrap=True)
    console.print(f"machine-checked: {report.machine}", soft_wrap=True)
    console.print(_summary(report), soft_wrap=True)


def _summary(report: Report) -> Text:
    readings = [reading for claim in report.claims for reading in claim.readings]
    accepted = sum(reading.outcome.accepted for reading in readings)
    different = [claim.claim.id for claim in report.claims if not claim.as_expected]
    different += [f"{row.claim} without {' and '.join(row.dropped) or 'anything'}" for row in report.hypotheses if not row.as_expected]
    accepted += sum(row.accepted for row in report.hypotheses if row.verdict == Verdict.REFUTED and row.already is None)
    tail = (
        f"{len(readings)} readings, {len(report.hypotheses)} sets of hypotheses dropped, {accepted} certificates accepted, "
        f"effort {report.effort}, {report.seconds:.0f} s"
    )
    if different:
        return Text(f"NOT as expected: {', '.join(different)}; {len(report.claims)} claims, {tail}", style="bold red")
    return Text(f"as expected: all {len(report.claims)} claims; {tail}", style="bold green")


def _verdict(verdict: Verdict, expected: str, between: str = " ") -> Text:
    if verdict == expected:
        return Text(str(verdict), style=STYLES[verdict])
    return Text(f"{verdict}{between}(expected {expected})", style="bold red")
