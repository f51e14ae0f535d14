"""Say how options are read and shown: the parts that the commands of `command_line` are declared with.

Effort, Expected, Language   the words that an option can be
Plain                a command whose help shows its arguments as they are typed
number               the parser of a number from a least one on, up to a largest one
jobs_number          the parser of a number of processes
in_our_words         a complaint about options as all complaints about input are
Json, Verbose, ..     options and an argument that several commands have
"""

from __future__ import annotations

import re
from collections.abc import Callable
from enum import StrEnum
from math import inf
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperCommand

from ..base.errors import shorten


class Effort(StrEnum):
    """It says how long `verify` looks."""

    quick = "quick"
    full = "full"


class Expected(StrEnum):
    """The answers that `compare` can be made to expect."""

    equivalent = "equivalent"
    different = "different"


class Language(StrEnum):
    """A script that shows a failure is in one of these."""

    python = "python"
    octave = "octave"
    matlab = "matlab"
    julia = "julia"


class Plain(TyperCommand):
    """The usage and the list of arguments show each by its `metavar`, without braces and types around it."""

    def collect_usage_pieces(self, ctx: Any) -> list[str]:
        """Return the words after the command's name."""
        return ["[OPTIONS]", *(str(one.metavar) for one in self.get_params(ctx) if one.param_type_name == "argument")]

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write arguments and options with their help."""
        rows: dict[str, list[tuple[str, str]]] = {"argument": [], "option": []}
        for one in self.get_params(ctx):
            if record := one.get_help_record(ctx):
                rows[one.param_type_name].append((str(one.metavar) if one.param_type_name == "argument" else record[0], record[1]))
        for kind, shown in rows.items():
            if shown:
                with formatter.section(f"{kind.title()}s"):
                    formatter.write_dl(shown)


MOST_JOBS = 1024  # no machine of today has more cores, and ten times as many processes take its memory before they begin


def number(kind: type[int] | type[float], least: float, such_as: float, most: float = inf) -> Callable[[str], Any]:
    """Return the parser of a number from `least` on, up to `most`, which says what it got, what it needs and what to try."""

    def parsed(text: str) -> Any:
        try:
            value = kind(str(text))
        except ValueError:
            value = None
        open_end = kind is float and not least
        if value is None or not (value > 0 if open_end else least <= value) or value == inf or value > most:
            wanted = "positive number" if open_end else f"{'whole ' if kind is int else ''}number from {least:g} on"
            if value is not None and most < value < inf:
                wanted = f"number of {most:g} at most"
            raise typer.BadParameter(f"got {shorten(str(text))}, expected a {wanted}, try {such_as:g}")
        return value

    return parsed


jobs_number = number(int, 1, 2, MOST_JOBS)


def in_our_words(message: str) -> str:
    """Return a complaint about options as all complaints about input are: the place, what was got, what is expected."""
    message = re.sub(r"^Invalid value for '([^']*)': ", lambda found: f"{found[1].split(' / ')[-1]}: ", message)
    message = re.sub(r"^Missing (?:option|argument) '([^']*)'\.", r"\1: got none, expected one on the command line", message)
    message = re.sub(r"^Option '([^']*)' requires (?:an argument|(\d+) arguments)\.", r"\1: got none, expected a value behind it", message)
    message = re.sub(r"^No such (command|option):? '?([^' ]*?)'?(?:\. ?| |$)", r"\2: there is no such \1; ", message).removesuffix("; ")
    message = re.sub(r"; \(Possible options: (.*)\)$", r"; the nearest are \1", message.replace("; Did you mean", "; did you mean"))
    message = re.sub(r"^Got unexpected extra arguments?(?:\(s\))? \((.*)\)$", r"got \1, expected no argument there", message)
    return re.sub(r"(?:Value error, )?'([^']*)' is not one of (.*?)\.?$", r"got '\1', expected one of \2", message)


Json = Annotated[bool, typer.Option("--json", help="Print JSON and nothing else on standard output.")]
Verbose = Annotated[bool, typer.Option("-v", "--verbose", help="Print a page of each claim, too.")]
Floats = Annotated[bool, typer.Option("--floats-exactly", help="Take floats as the dyadic rationals that they are.")]
OneSystem = Annotated[str, typer.Argument(metavar="SYSTEM", help="A system file, - or example:NAME.")]
Scheduler = Annotated[str | None, typer.Option(metavar="ADDRESS", help="Work on the Dask cluster with this scheduler instead.")]
Jobs = Annotated[int | None, typer.Option(metavar="K", parser=jobs_number, help="Processes at a time.", show_default="all cores")]
BoxJobs = Annotated[int, typer.Option(metavar="K", parser=jobs_number, help="Processes at a time, for large boxes.")]
Certificates = Annotated[Path | None, typer.Option(metavar="DIR", help="Write the certificates there.")]
