"""Print answers on standard output; how far a command has come is shown on standard error (`base/progress.py`).

answers        the console for tables: colours and the window's width on a terminal, plain and 140 wide or more elsewhere
full_width     the same, elsewhere as wide as a table needs
print_json     one document on one line
print_table    a table, or its rows as paragraphs where it is too wide
paragraph      a text after a label: broken between words on a terminal, the lines below in line with the first; one line elsewhere
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator

from rich.cells import cell_len
from rich.console import Console, ConsoleOptions, RenderableType
from rich.measure import Measurement
from rich.segment import Segment
from rich.table import Table
from rich.text import Text

from ..base.others_text import lines

PIPED_WIDTH = 140
UNBOUNDED = 1_000_000


class _Answers(Console):
    """This console leaves a broken pipe to `failures.guarded`. Names and texts of others are text on it, whatever characters they have."""

    def render(self, renderable: RenderableType, options: ConsoleOptions | None = None) -> Iterator[Segment]:
        """Yield the segments, those of text printable."""
        for one in super().render(renderable, options):
            yield one if one.control else Segment(lines(one.text), one.style)

    def on_broken_pipe(self) -> None:
        self.quiet = True
        raise BrokenPipeError


def answers() -> Console:
    """Return the console on which answers are printed."""
    plain = not sys.stdout.isatty()
    width = max(PIPED_WIDTH, _columns()) if plain else None
    return _Answers(file=sys.stdout, width=width, markup=False, highlight=False, emoji=False)


def full_width() -> Console:
    """Return a console for answers whose tables are never folded where nobody looks at a window."""
    console = answers()
    return console if console.is_terminal else _Answers(file=sys.stdout, width=UNBOUNDED, markup=False, highlight=False, emoji=False)


def paragraph(console: Console, text: Text | str, label: Text | str = "") -> None:
    """Print the text after its label, on a terminal broken between words; elsewhere each line of it is one line, however long.

    The lines below begin below the first word, or a little right of the label where that leaves too little room. Nothing is cut: a word
    that is longer than a line goes on in the next.
    """
    whole = Text.assemble(label, text)
    if not console.is_terminal:
        console.print(whole, soft_wrap=True)
        return
    head = Text.assemble(label).plain
    for line in whole.split("\n", allow_blank=True) or [whole]:
        console.print(Text("\n").join(_broken(console, line, head)))
        head = ""


def _broken(console: Console, line: Text, head: str) -> list[Text]:
    """Return the line in pieces that fit, all but the first behind the same indentation."""
    width = max(console.width, 1)
    if line.cell_len <= width:
        return [line]
    plain = line.plain
    margin = len(plain) - len(plain.lstrip())
    longest = max((cell_len(word) for word in plain.removeprefix(head).split()), default=0)
    if head.strip() and 2 * cell_len(head) <= width and longest <= width - cell_len(head):
        indent = cell_len(head)
    else:
        indent = margin + (4 if head.strip() else 2 if plain.lstrip().startswith("- ") else 0)
    indent = min(indent, width // 2)
    first = line.wrap(console, width, overflow="fold")[0]
    rest = line[len(first) :]
    rest = rest[len(rest.plain) - len(rest.plain.lstrip()) :]
    pieces = [first, *(Text(" " * indent) + piece for piece in rest.wrap(console, width - indent, overflow="fold"))]
    for piece in pieces:
        piece.rstrip()
    return pieces


def print_table(console: Console, table: Table) -> None:
    """Print the table where its columns fit, and else a paragraph for each row, which names every column that it has a value for."""
    unbounded = console.options.update(width=UNBOUNDED)  # else the measure is no wider than the window
    if Measurement.get(console, unbounded, table).minimum <= console.width:
        if console.is_terminal:
            console.print(table)
            return
        with console.capture() as captured:
            console.print(table)
        console.print("\n".join(one.rstrip() for one in captured.get().splitlines()), soft_wrap=True)
        return
    if table.title:
        paragraph(console, str(table.title))
    for first, *others in zip(*(column.cells for column in table.columns), strict=True):
        pairs = zip(table.columns[1:], others, strict=True)
        values = [f"{column.header}: {value}" for column, value in pairs if str(value)]
        paragraph(console, "; ".join(values), Text.assemble(Text(str(first), style="bold"), "  " if values else ""))


def print_json(document: object) -> None:
    """Print the document on one line of standard output."""
    sys.stdout.write(json.dumps(document) + "\n")
    sys.stdout.flush()


def _columns() -> int:
    try:
        return int(os.environ.get("COLUMNS", ""))
    except ValueError:
        return 0
