"""This shows tables of a benchmark, on a terminal and in Markdown.

Sheet       a title, a head, rows of texts
markdown    sheets and notes as Markdown
show        sheets and notes on a terminal
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rich.console import Console
from rich.table import Table

LEFT = ("system", "record", "aim", "")


@dataclass(frozen=True)
class Sheet:
    """This is a table before it is written."""

    title: str
    head: list[str]
    rows: list[list[str]]


def markdown(sheets: Sequence[Sheet], notes: Sequence[str]) -> str:
    """This writes all of it in Markdown."""
    parts = []
    for sheet in sheets:
        lines = [" | ".join(cells) for cells in (sheet.head, ["---"] * len(sheet.head), *sheet.rows)]
        parts.append(f"### {sheet.title[0].upper()}{sheet.title[1:]}\n\n" + "\n".join(f"| {line} |" for line in lines))
    parts.append("\n".join(f"- {line}" for line in notes))
    return "\n\n".join(parts)


def show(sheets: Sequence[Sheet], notes: Sequence[str], console: Console) -> None:
    """This prints all of it on a terminal."""
    for sheet in sheets:
        table = Table(title=sheet.title, title_justify="left")
        for name in sheet.head:
            table.add_column(name, justify="left" if name in LEFT else "right")
        for row in sheet.rows:
            table.add_row(*row)
        console.print(table)
    for line in notes:
        console.print(line)
