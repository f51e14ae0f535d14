"""Answer about one file after the other: a bad one is reported and the rest is still done."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from rich.console import Console
from rich.text import Text

from ..base.errors import InvalidInput, in_file, quote_path
from ..base.messages import say
from ..base.progress import Progress, Tell, working
from ..base.sheets import Sheet, line
from .consoles import answers, paragraph, print_json
from .failures import ANSWERED, BAD_INPUT


class Readable(Protocol):
    """A record that people and programs can read."""

    def sheet(self) -> Sheet: ...

    def to_json(self) -> dict[str, Any]: ...


@dataclass(frozen=True)
class FileAnswer:
    """The heading follows the file's name on its line."""

    heading: str
    found: Readable


def answer_each(names: Sequence[str], doing: str, answer: Callable[[str, Progress], FileAnswer], *, as_json: bool) -> int:
    """Print the answer on each file; as JSON, one file gives an object, several an array of objects that also name their "file".

    `doing` says on standard error what is done with a file, until all that is asked of it is computed, its last lines included.
    """
    code = ANSWERED
    console = answers()
    documents = []
    for name in names:
        try:
            with working(doing.format(quote_path(name))) as tell:
                given = answer(name, _of(name, tell))
                tell(f"{quote_path(name)}: writing the answer")
                with in_file(name):
                    document = given.found.to_json() if as_json else {}
                    sheet = [] if as_json else list(given.found.sheet())
            if as_json:
                documents.append({"file": name, **document})
            else:
                _print(console, name, given.heading, sheet)
        except InvalidInput as error:
            say(str(error))
            code = BAD_INPUT
    if as_json and len(names) > 1:
        print_json(documents)
    elif as_json and documents:
        print_json({key: value for key, value in documents[0].items() if key != "file"})
    return code


def _of(name: str, tell: Tell) -> Progress:
    """Return what tells the stages of the work on a file."""
    return lambda stage, done, total: tell(f"{quote_path(name)}: {stage}", done, total)


def _print(console: Console, name: str, heading: str, sheet: Sheet) -> None:
    """Print the lines without a frame."""
    paragraph(console, Text.assemble((quote_path(name), "bold"), f"   {heading}"))
    for label, value in sheet:
        paragraph(console, *((value, line(label, " ")[:-1]) if value else (Text(line(label, ""), style="bold cyan"),)))
    console.print()
