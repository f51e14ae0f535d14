"""Run `faultspace audit`, which puts an implementation through the checks of `faultspace.numeric.audit`.

run          the command's body
list_peers   the published packages that adapters come for
by_function  a row for each function: checks, passed, failed, the largest ratio of what a check got to its bound
table        a row for each check, as --verbose prints it
"""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..base.progress import working
from ..numeric.audit.outcome import Audit, FunctionTally
from ..numeric.audit.peers import PEERS
from ..numeric.audit.records import CheckResult, Demand
from ..numeric.audit.running import audit
from .consoles import answers, paragraph, print_json, print_table
from .failures import ANSWERED, NOT_AS_EXPECTED

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
    """Audit the adapter of that name, the program `command` or the package `peer`, each check within so many seconds and GiB.

    The code is 0 where every must is met, else 1. Raises InvalidInput.
    """
    with working("starting the adapter") as tell:
        found = audit(adapter, command=command, peer=peer, only=only, seconds=seconds, gibibytes=gibibytes, on_progress=tell)
    if as_json:
        print_json(found.to_json())
    else:
        _print(answers(), found, verbose=verbose)
    return NOT_AS_EXPECTED if found.failed else ANSWERED


def list_peers(*, as_json: bool) -> int:
    """Print the packages that adapters come for, with the version where it is here and else what it needs, and return 0."""
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


def _print(console: Console, found: Audit, *, verbose: bool) -> None:
    """Print the tables, the failures in words, and the summary line as the last."""
    if verbose:
        print_table(console, table(found))
        console.print()
    print_table(console, by_function(found.functions))
    for words in found.failures:
        paragraph(console, words, Text("! ", style="bold red"))
    if not verbose:
        paragraph(console, Text(HELP, style="dim"))
    paragraph(console, Text(found.title, style="bold red" if found.failed else "bold green"))


def by_function(tallies: Sequence[FunctionTally]) -> Table:
    """Return a table with one row for each function. What is free, or not offered, is not counted, as it cannot fail."""
    result = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    result.add_column("function", overflow="fold")
    for column in ("checks", "passed", "failed", "free"):
        result.add_column(column, justify="right", no_wrap=True)
    result.add_column("largest ratio", justify="right", no_wrap=True)
    for one in tallies:
        name = f"! {one.function}" if one.failed else one.function
        ratio = "-" if one.largest_ratio is None else f"{one.largest_ratio:.2g}"
        cells = (name, str(one.checks), str(one.passed), str(one.failed), str(one.free), ratio)
        result.add_row(*(Text(cell, style="bold red" if one.failed else "") for cell in cells))
    return result


def table(results: Sequence[CheckResult]) -> Table:
    """Return a table with one row for each check, under the name of its function."""
    rows = Table(box=None, pad_edge=False, header_style="bold")
    for column in ("check", "claim", "asks", "verdict"):
        rows.add_column(column, no_wrap=True)
    rows.add_column("quantity", overflow="fold", min_width=24)
    for column in ("got", "bound", "ratio"):
        rows.add_column(column, justify="right", no_wrap=True)
    for function in dict.fromkeys(one.function for one in results):
        rows.add_row(Text(function, style="bold"))
        for one in results:
            if one.function == function:
                rows.add_row(*_row(one))
    return rows


def _row(result: CheckResult) -> list[Text]:
    numbers = [("" if x is None else f"{x:.2g}") for x in (result.got, result.bound, result.ratio)]
    asks = str(result.kind) if result.kind != Demand.MUST_HOLD else ""
    cells = (result.name, result.claim or "", asks, result.verdict, result.quantity or "", *numbers)
    return [Text(cell, style="red" if result.failed else "") for cell in cells]
