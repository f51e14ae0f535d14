"""Standard output, where answers go; how it is going is told on standard error (`progress`).

answers        the console for tables: colours and the window's width on a terminal, plain and 140 wide or more elsewhere
print_json     one document on one line
print_table    a table, or its rows as paragraphs where it is too wide
paragraph      a text under a label: between words on a terminal, the lines below in line with the first; one line elsewhere
"""

from __future__ import annotations

import json
import os
import sys

from rich.console import Console
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text

PIPED_WIDTH = 140
UNBOUNDED = 1_000_000


class _Answers(Console):
    """A console that leaves a broken pipe to `failures.guarded`."""

    def on_broken_pipe(self) -> None:
        self.quiet = True
        raise BrokenPipeError


def answers() -> Console:
    """The console that tables are printed on."""
    plain = not sys.stdout.isatty()
    width = max(PIPED_WIDTH, _columns()) if plain else None
    return _Answers(file=sys.stdout, width=width, markup=False, highlight=False, emoji=False)


def paragraph(console: Console, text: Text | str, label: Text | str = "") -> None:
    """The text after its label. Nothing is cut: a word that is longer than the line goes on in the next."""
    if not console.is_terminal:
        console.print(Text.assemble(label, text), soft_wrap=True)
        return
    if not label:
        console.print(text, overflow="fold")
        return
    lines = Table.grid()
    lines.add_column(no_wrap=True)
    lines.add_column(overflow="fold")
    lines.add_row(label, text)
    console.print(lines)


def print_table(console: Console, table: Table) -> None:
    """The table where its columns fit, and elsewhere a paragraph for each row, which names every column that it has a value for."""
    unbounded = console.options.update(width=UNBOUNDED)  # else the measure is no wider than the window
    if Measurement.get(console, unbounded, table).minimum <= console.width:
        console.print(table)
        return
    if table.title:
        paragraph(console, str(table.title))
    for first, *others in zip(*(column.cells for column in table.columns), strict=True):
        pairs = zip(table.columns[1:], others, strict=True)
        values = [f"{column.header}: {value}" for column, value in pairs if str(value)]
        paragraph(console, "; ".join(values), Text.assemble(Text(str(first), style="bold"), "  " if values else ""))


def print_json(document: object) -> None:
    """The document on one line of standard output."""
    sys.stdout.write(json.dumps(document) + "\n")
    sys.stdout.flush()


def _columns() -> int:
    try:
        return int(os.environ.get("COLUMNS", ""))
    except ValueError:
        return 0
