"""`faultspace audit`: an implementation through the checks of `faultspace.numeric.audit`.

run          the command's body
list_peers   the published packages that adapters come for
by_function  a row for each function: checks, passed, failed, the largest ratio of what a check got to its bound
table        a row for each check, as --verbose prints it
"""

from __future__ import annotations

import shlex
from collections.abc import Sequence

from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..base.errors import InvalidData, InvalidInput, quote_path
from ..numeric.audit.peers import PEERS
from ..numeric.audit.peers import peer as peer_named
from ..numeric.audit.programs import Limits
from ..numeric.audit.records import Kind, Record, Verdict, grouped
from ..numeric.audit.running import audit, audit_named, told
from ..numeric.audit.scoreboard import REFERENCE, audit_peer
from ..numeric.audit.subprocess_adapter import Exec
from .consoles import answers, paragraph, print_json, print_table
from .failures import ANSWERED, NOT_AS_EXPECTED
from .progress import working

HELP = "free: asked without a must, or not offered; ratio: what was got over its bound, at most 1 where all is well; -v prints every check."


def run(
    adapter: str | None,
    *,
    command: str | None,
    peer: str | None,
    only: Sequence[str],
    seconds: float,
    gibibytes: float,
    as_json: bool,
    verbose: bool = False,
) -> int:
    """Audits the adapter of that name, the program `command` or the package `peer`, each check within so many seconds and GiB.

    0 where every must is met, else 1; raises InvalidInput.
    """
    if sum(one is not None for one in (adapter, command, peer)) > 1:
        raise InvalidInput("got more than one of an adapter, --exec and --peer, expected one of them")
    if adapter == "":
        raise InvalidInput("got an empty name, expected an adapter (none at all: our own reference)")
    name = shlex.quote(adapter or REFERENCE)
    if command is not None or peer is not None:
        name = f"--exec {shlex.quote(command)}" if command is not None else f"--peer {peer}"
    limits = Limits(seconds, int(gibibytes * 2**30))
    try:
        audited = peer_named(peer) if peer is not None else None
        with working("starting the adapter") as tell:
            if audited is not None:
                records = audit_peer(audited, limits=limits, only=only, tell=tell)
            elif command is not None:
                with Exec(command, limits) as program:
                    records = audit(program, only=only, tell=tell)
            else:
                records = audit_named(adapter or REFERENCE, limits=limits, only=only, tell=tell)
    except InvalidData as error:
        raise InvalidInput(str(error)) from None
    failed = [record for record in records if record.failed]
    if as_json:
        print_json({"adapter": name, "failed": len(failed), "records": [record.to_json() for record in records]})
    else:
        _print(answers(), records, name, verbose=verbose)
    return NOT_AS_EXPECTED if failed else ANSWERED


def list_peers(*, as_json: bool) -> int:
    """The packages that adapters come for: version where it is here, else what it needs. 0."""
    found = [(one, one.version()) for one in PEERS]
    if as_json:
        print_json([{"name": one.name, "language": one.language, "version": version, "needs": one.needs} for one, version in found])
        return ANSWERED
    result = Table(box=None, pad_edge=False, header_style="bold")
    for column in ("--peer", "what it is", "language", "version here", "needs"):
        result.add_column(column)
    for one, version in found:
        result.add_row(*(Text(cell) for cell in (one.name, one.title, one.language, version or "-", one.needs)))
    print_table(answers(), result)
    return ANSWERED


def _print(console: Console, records: Sequence[Record], name: str, *, verbose: bool) -> None:
    """The tables, the failures in words, and the summary line as the last."""
    if verbose:
        print_table(console, table(records))
        console.print()
    print_table(console, by_function(records))
    failed = [record for record in records if record.failed]
    for group in grouped(failed):
        others = f" Also: {', '.join(one.vector for one in group[1:])}." if len(group) > 1 else ""
        paragraph(console, Text(told(group[0], quote_path(name)) + others), Text("! ", style="bold red"))
    if not verbose:
        paragraph(console, Text(HELP, style="dim"))
    functions = ", ".join(dict.fromkeys(record.function for record in records))
    tally = f"{len(records)} checks of {functions or 'nothing'}: {len(failed)} failed"
    paragraph(console, Text(tally, style="bold red" if failed else "bold green"))


def by_function(records: Sequence[Record]) -> Table:
    """One row a function, those with a failure first. What is free, or not offered, is not counted, as it cannot fail."""
    result = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    result.add_column("function", overflow="fold")
    for column in ("checks", "passed", "failed", "free"):
        result.add_column(column, justify="right", no_wrap=True)
    result.add_column("largest ratio", justify="right", no_wrap=True)
    functions = dict.fromkeys(record.function for record in records)
    groups = [[record for record in records if record.function == function] for function in functions]
    for group in sorted(groups, key=lambda group: not any(record.failed for record in group)):
        failed = sum(record.failed for record in group)
        passed = sum(record.kind != Kind.FREE and record.verdict == Verdict.PASS for record in group)
        name = f"! {group[0].function}" if failed else group[0].function
        cells = (name, str(len(group)), str(passed), str(failed), str(len(group) - passed - failed), _largest(group))
        result.add_row(*(Text(cell, style="bold red" if failed else "") for cell in cells))
    return result


def _largest(records: Sequence[Record]) -> str:
    measured = [record.ratio for record in records if record.ratio is not None and record.kind != Kind.FREE]
    if not measured:
        return "-"
    return f"{max(measured):.2g}"


def table(records: Sequence[Record]) -> Table:
    """One row a check, under the name of its function."""
    result = Table(box=None, pad_edge=False, header_style="bold")
    for column in ("check", "claim", "asks", "verdict"):
        result.add_column(column, no_wrap=True)
    result.add_column("quantity", overflow="fold", min_width=24)
    for column in ("got", "bound", "ratio"):
        result.add_column(column, justify="right", no_wrap=True)
    for function in dict.fromkeys(record.function for record in records):
        result.add_row(Text(function, style="bold"))
        for record in records:
            if record.function == function:
                result.add_row(*_row(record))
    return result


def _row(record: Record) -> list[Text]:
    numbers = [("" if x is None else f"{x:.2g}") for x in (record.got, record.bound, record.ratio)]
    asks = str(record.kind) if record.kind != Kind.MUST_HOLD else ""
    cells = (record.name, record.claim or "", asks, record.verdict, record.quantity or "", *numbers)
    return [Text(cell, style="red" if record.failed else "") for cell in cells]
