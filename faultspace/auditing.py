"""`faultspace audit`: an implementation through the checks of `faultspace.numeric.audit`.

run          the command's body
table        what a person reads
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from rich.table import Table
from rich.text import Text

from .consoles import answers, print_json, stages
from .exact.input_rules import InvalidInput
from .failures import ANSWERED, NOT_AS_EXPECTED, printable
from .numeric.audit.adapter import load
from .numeric.audit.records import Kind, Record
from .numeric.audit.running import audit, told
from .numeric.audit.subprocess_adapter import Exec
from .numeric.input_checks import InvalidData

REFERENCE = "faultspace.numeric.audit.reference"


def run(adapter: str | None, *, command: str | None, only: Sequence[str], timeout: float, as_json: bool) -> int:
    """Audits the adapter of that name, or the program `command`. 0 where every must is met, else 1; raises InvalidInput."""
    if adapter is not None and command is not None:
        raise InvalidInput("got an adapter and --exec, expected one of them")
    name = adapter or (f"--exec '{command}'" if command else REFERENCE)
    try:
        with _implementation(adapter or REFERENCE, command, timeout) as implementation, stages() as tell:
            records = audit(implementation, only=only, tell=lambda check, done, total: tell("auditing", done, total))
    except InvalidData as error:
        raise InvalidInput(str(error)) from None
    failed = [record for record in records if record.failed]
    if as_json:
        print_json({"adapter": name, "failed": len(failed), "records": [record.to_json() for record in records]})
    else:
        console = answers()
        console.print(table(records))
        for record in failed:
            console.print(Text(told(record, printable(name) if command is None else name)), soft_wrap=True)
        functions = ", ".join(dict.fromkeys(record.function for record in records))
        tally = f"{len(records)} checks of {functions or 'nothing'}: {len(failed)} failed"
        console.print(Text(tally, style="bold red" if failed else "bold"), soft_wrap=True)
    return NOT_AS_EXPECTED if failed else ANSWERED


@contextmanager
def _implementation(adapter: str, command: str | None, timeout: float) -> Iterator[object]:
    if command is not None:
        with Exec(command, timeout=timeout) as program:
            yield program
        return
    # An adapter may import what lies beside it, as it could if it were run.
    sys.path.insert(0, "")
    try:
        yield load(adapter)
    finally:
        sys.path.remove("")


def table(records: Sequence[Record]) -> Table:
    """One row a check."""
    result = Table(box=None, pad_edge=False, header_style="bold")
    for column in ("check", "claim", "asks", "verdict"):
        result.add_column(column, no_wrap=True)
    result.add_column("quantity", overflow="fold", min_width=24)
    for column in ("got", "bound", "ratio"):
        result.add_column(column, justify="right", no_wrap=True)
    for record in records:
        style = "red" if record.failed else ""
        numbers = [("" if x is None else f"{x:.2g}") for x in (record.got, record.bound, record.ratio)]
        asks = str(record.kind) if record.kind != Kind.MUST_HOLD else ""
        cells = (record.name, record.claim or "", asks, record.verdict, record.quantity or "", *numbers)
        result.add_row(*(Text(cell, style=style) for cell in cells))
    return result
