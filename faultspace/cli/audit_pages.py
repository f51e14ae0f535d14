"""What `faultspace audit` prints of an audit: failures first, a few lines where there are none.

print_report   the causes of failures, the tables asked for, the summary line as the last
by_function    a row for each function: checks, verdicts, what is free, the largest ratio of what a check got to its bound
by_slug        a row for each slug and function, as -v prints it
by_check       a row for each check, as -vv prints it
"""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..base.errors import quote_path
from ..numeric.audit.outcome import Audit, FunctionTally
from ..numeric.audit.records import GREEN, CheckResult, Demand, Status, grouped
from ..numeric.audit.reports.causes import lines_of
from .consoles import full_width, paragraph, print_table

HELP = "free: asked without a must, or not offered; ratio: what was got over its bound, at most 1 where all is well; -v prints every slug."


def print_report(found: Audit, detail: int) -> None:
    """Print at this level of detail: -1 a line a cause, 0 what is known of each, 1 also a row a slug, 2 or more a row a check."""
    console = full_width()
    _causes(console, found, alone=detail < 0)
    if detail >= 0:
        print_table(console, by_function(found.functions))
    if detail > 0:
        console.print()
        print_table(console, by_check(found) if detail > 1 else by_slug(found))
    elif detail == 0:
        paragraph(console, Text(HELP, style="dim"))
    paragraph(console, Text(found.title, style="bold red" if found.failed else "bold green"))


def _causes(console: Console, found: Audit, *, alone: bool) -> None:
    """Print the title of each cause, and below it what is known of it unless it is to stand alone."""
    for cause in found.causes:
        failed = any(one.failed for one in cause.results)
        paragraph(console, Text(cause.title, style="bold"), Text("! " if failed else "~ ", style="bold red" if failed else "bold"))
        for line in () if alone else lines_of(cause, quote_path(found.adapter)):
            label, _, rest = line.partition(": ") if line.startswith(("probably", "effect", "again")) else ("", "", line)
            paragraph(console, rest, f"    {label}: " if label else "    ")
        if not alone:
            console.print()


def _table(*columns: str) -> Table:
    result = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    for number, column in enumerate(columns):
        result.add_column(column, justify="right" if number else "left", no_wrap=bool(number), overflow="fold")
    return result


def by_function(tallies: Sequence[FunctionTally]) -> Table:
    """Return a table with one row for each function. What is free, or not offered, is not counted, as it cannot fail."""
    verdicts = [str(one) for one in Status if any(one in tally.verdicts for tally in tallies)]
    result = _table("function", "checks", *verdicts, "free", "largest ratio")
    for one in tallies:
        name = f"! {one.function}" if one.failed else one.function
        counts = (str(one.verdicts.get(verdict, 0)) for verdict in verdicts)
        cells = (name, str(one.checks), *counts, str(one.free), _number(one.largest_ratio) or "-")
        result.add_row(*(Text(cell, style="bold red" if one.failed else "") for cell in cells))
    return result


def by_slug(results: Sequence[CheckResult]) -> Table:
    """Return a table with one row for each slug and function: checks, how many of them are right, the largest ratio."""
    rows = _table("check", "function", "asks", "right", "checks", "largest ratio")
    for group in grouped(results):
        first, failed = group[0], any(one.failed for one in group)
        right = sum(one.verdict in GREEN for one in group)
        ratio = max((one.ratio for one in group if one.ratio is not None), default=None)
        cells = (first.slug, first.function, _asks(first), str(right), str(len(group)), _number(ratio) or "-")
        rows.add_row(*(Text(cell, style="red" if failed else "") for cell in cells))
    return rows


def by_check(results: Sequence[CheckResult]) -> Table:
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
    numbers = map(_number, (result.got, result.bound, result.ratio))
    cells = (result.name, result.claim or "", _asks(result), result.verdict, result.quantity or "", *numbers)
    return [Text(cell, style="red" if result.failed else "") for cell in cells]


def _asks(result: CheckResult) -> str:
    return str(result.kind) if result.kind != Demand.MUST_HOLD else ""


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.2g}"
