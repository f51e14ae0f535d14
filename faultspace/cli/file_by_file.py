"""Answer about one file after the other: a bad one is reported and the rest is still done.

FileAnswer        what is known about a file: a heading, and the record with its `sheet` and `to_json`
answer_each   the command's body: answers, printed or as JSON; the largest exit code
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from rich.console import Console
from rich.text import Text

from ..base.errors import InvalidInput, in_file, quote_path
from ..base.messages import say
from ..base.sheets import Sheet, line
from .consoles import answers, paragraph, print_json
from .failures import ANSWERED, BAD_INPUT


class Readable(Protocol):
    """This is a record that people and programs can read."""

    def sheet(self) -> Sheet: ...

    def to_json(self) -> dict[str, Any]: ...


@dataclass(frozen=True)
class FileAnswer:
    """The heading follows the file's name on its line."""

    heading: str
    found: Readable


def answer_each(names: Sequence[str], answer: Callable[[str], FileAnswer], *, as_json: bool) -> int:
    """Print the answer on each file; as JSON, one file gives an object, several an array of objects that also name their "file"."""
    code = ANSWERED
    console = answers()
    documents = []
    for name in names:
        try:
            given = answer(name)
            with in_file(name):
                if as_json:
                    documents.append({"file": name, **given.found.to_json()})
                else:
                    _print(console, name, given)
        except InvalidInput as error:
            say(str(error))
            code = BAD_INPUT
    if as_json and len(names) > 1:
        print_json(documents)
    elif as_json and documents:
        print_json({key: value for key, value in documents[0].items() if key != "file"})
    return code


def _print(console: Console, name: str, given: FileAnswer) -> None:
    """Print the lines without a frame."""
    paragraph(console, Text.assemble((quote_path(name), "bold"), f"   {given.heading}"))
    for label, value in given.found.sheet():
        paragraph(console, *((value, line(label, " ")[:-1]) if value else (Text(line(label, ""), style="bold cyan"),)))
    console.print()
