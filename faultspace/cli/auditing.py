"""Run `faultspace audit`, which puts an implementation through the checks of `faultspace.numeric.audit`.

Asked         who is audited, by which checks, within which limits
performed     the audit of that; saved: one that was done before
report        prints it, writes the files asked for, and returns the exit code
print_report  failures first: their causes, the tables asked for, the summary line as the last
by_function, by_slug, by_check   tables with a row each
list_checks   the checks that would be asked
list_peers    the published packages that adapters come for
export, reproduce   the checks as files and a check as a script, for those who do not have faultspace
"""

from __future__ import annotations

import json
import shlex
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..base.errors import InvalidInput, quote_path
from ..base.others_text import printable
from ..base.processes import Limits
from ..base.progress import working
from ..base.writing import write_text
from ..numeric.audit.checks.catalogue import chosen
from ..numeric.audit.expectations import as_expected, expected_in
from ..numeric.audit.outcome import Audit, FunctionTally
from ..numeric.audit.peers import PEERS
from ..numeric.audit.records import GREEN, CheckResult, Demand, Status, grouped, named
from ..numeric.audit.reports.causes import lines_of
from ..numeric.audit.reports.machines import endpoint, junit_xml, svg
from ..numeric.audit.running import audit
from ..numeric.audit.subjects.opening import opened
from .consoles import answers, full_width, paragraph, print_json, print_table
from .failures import ANSWERED, NOT_AS_EXPECTED
from .reading_files import read_json

HELP = "free: asked without a must, or not offered; ratio: what was got over its bound, at most 1 where all is well; -v prints every slug."


@dataclass(frozen=True)
class Asked:
    """At most one of `adapter`, `command` and `peer` is given; without any of them it is our own code. `only` names checks, `seed` and
    `quick` are those of `audit`."""

    adapter: str | None
    command: str | None
    peer: str | None
    only: tuple[str, ...]
    seed: int
    quick: bool
    seconds: float
    gibibytes: float
    environment: tuple[str, ...] = ()

    @property
    def limits(self) -> Limits:
        """The limits of a check."""
        return Limits(self.seconds, int(self.gibibytes * 2**30), self.environment)


def performed(asked: Asked, expected: Path | None) -> Audit:
    """Return the audit, with the failures that a file expects. Raises InvalidInput."""
    known = () if expected is None else expected_in(expected)
    with working("starting the adapter") as tell:
        return audit(**vars(asked), expected=known, on_progress=tell)


def saved(file: Path, asked: Asked, expected: Path | None) -> Audit:
    """Return the audit that `faultspace audit --json` printed into a file: of it the checks that are named, if any are, with the failures
    that a file expects. Raises InvalidInput, also for what names another implementation or other vectors."""
    if asked.adapter or asked.command or asked.peer or asked.seed or asked.quick:
        raise InvalidInput(
            "--from reports what was asked before, and asks nothing: leave the adapter, --exec, --peer, --seed and --quick out, or leave "
            "--from out and ask again"
        )
    try:
        found = Audit.from_json(read_json(str(file)))
    except InvalidInput as error:
        raise InvalidInput(f"{error}; try: faultspace audit --json > {shlex.quote(str(file))}") from None
    for name in asked.only:
        if not any(named(one, name) for one in found):
            raise InvalidInput(f"check {name}: {quote_path(str(file))} has no result of that name, expected one that -vv prints of it")
    known = () if expected is None else expected_in(expected)
    if known:
        chosen((), [one.name for one in known])
    results = [one for one in found if not asked.only or any(named(one, name) for name in asked.only)]
    return Audit(found.adapter, tuple(as_expected(one, known) for one in results))


def report(found: Audit, *, junit: Path | None, badge: Path | None, detail: int, as_json: bool) -> int:
    """Print the audit, and write the files asked for first. The code is 0 where every must is met, else 1. Raises InvalidInput.

    detail: -1 prints a line a cause, 0 what is known of each, 1 also a row a slug, 2 or more a row a check.
    """
    if badge is not None and badge.suffix not in (".svg", ".json"):
        raise InvalidInput(f"--badge: got {quote_path(str(badge))}, expected a file that ends in .svg or .json")
    if junit is not None:
        write_text(junit, junit_xml(found.adapter, found.results))
    if badge is not None:
        write_text(badge, svg(found.results) if badge.suffix == ".svg" else json.dumps(endpoint(found.results)) + "\n")
    if as_json:
        print_json(found.to_json())
    else:
        print_report(found, detail)
    return NOT_AS_EXPECTED if found.failed else ANSWERED


def list_checks(asked: Asked, *, as_json: bool) -> int:
    """Print the full names of the checks that would be asked, one a line, and return 0. Raises InvalidInput."""
    with opened(asked.adapter, asked.command, asked.peer, asked.limits) as subject:
        checks = chosen(subject.functions, asked.only, asked.seed, asked.quick)
    if as_json:
        print_json([{"check": one.full_name, "kind": str(one.kind), "claim": one.claim, "effect": one.effect} for one in checks])
    else:
        for one in checks:
            sys.stdout.write(printable(one.full_name) + "\n")
    return ANSWERED


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


def export(asked: Asked, folder: Path) -> int:
    """Write the checks into a folder, print how many there are, and return 0. Raises InvalidInput."""
    from ..numeric.audit.upstream.exporting import write_checks

    with working("writing the checks") as tell:
        count = write_checks(folder, asked.only, tell)
    sys.stdout.write(f"{count} checks in {quote_path(str(folder))}; README.md there says how to read them\n")
    return ANSWERED


def reproduce(asked: Asked, name: str, language: str) -> int:
    """Print the script that shows a check, and return 0. Raises InvalidInput."""
    from ..numeric.audit.upstream.reproducing import script

    with opened(asked.adapter, asked.command, asked.peer, asked.limits) as subject:
        functions = subject.functions
    sys.stdout.write(script(name, functions, language, adapter=asked.adapter, peer=asked.peer, command=asked.command))
    return ANSWERED


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
