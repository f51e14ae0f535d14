"""Declare what the command `faultspace audit` understands; its work is in `auditing`, imported when asked for.

audit      the command's body
Language   those that a script which shows a failure can be in
"""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from .option_types import Json, number


class Language(StrEnum):
    """A script that shows a failure is in one of these."""

    python = "python"
    octave = "octave"
    matlab = "matlab"
    julia = "julia"


def audit(
    adapter: Annotated[
        str | None,
        typer.Argument(metavar="[ADAPTER]", show_default=False, help="module:object, file.py:object, module or file; else our own code."),
    ] = None,
    command: Annotated[
        str | None, typer.Option("--exec", metavar="CMD", help="A program that speaks JSON lines instead.", show_default=False)
    ] = None,
    peer: Annotated[str | None, typer.Option(metavar="NAME", help="A published package instead; see --peers.", show_default=False)] = None,
    result: Annotated[
        Path | None, typer.Option("--from", metavar="FILE", help="Report what --json printed before; nothing runs.", show_default=False)
    ] = None,
    peers: Annotated[bool, typer.Option("--peers", help="List the packages that adapters come for, and what each needs.")] = False,
    listed: Annotated[bool, typer.Option("--list", help="List the checks that would be asked, and ask none.")] = False,
    check: Annotated[
        list[str] | None,
        typer.Option(
            "--check", metavar="NAME", help="Only these: SLUG, SLUG[VECTOR] or SLUG[VECTOR]-FUNCTION, * and ? for anything; repeatable."
        ),
    ] = None,
    seed: Annotated[int, typer.Option(metavar="N", parser=number(int, 0, 0), help="Draw the vectors of all kinds of trouble anew.")] = 0,
    quick: Annotated[bool, typer.Option("--quick", help="Of every check one vector, and all kinds of trouble.")] = False,
    expected: Annotated[
        Path | None,
        typer.Option("--expected-failures", metavar="FILE", help="Known failures, a line each, NAME: REASON.", show_default=False),
    ] = None,
    junit: Annotated[Path | None, typer.Option(metavar="FILE", help="Write JUnit's XML there, too.", show_default=False)] = None,
    badge: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write a badge there, too: .svg, or .json for shields.io.", show_default=False)
    ] = None,
    reproduce: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="Print a script that shows this check without faultspace, and ask none.", show_default=False),
    ] = None,
    language: Annotated[Language, typer.Option(help="Of the script.")] = Language.python,
    export: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Write the checks as JSON for use without faultspace, and ask none.", show_default=False),
    ] = None,
    timeout: Annotated[
        float,
        typer.Option(metavar="SECONDS", parser=number(float, 0.1, 60, 1e7), help="How long a check, with --exec an answer, may take."),
    ] = 60.0,
    memory: Annotated[
        float, typer.Option(metavar="GIB", parser=number(float, 0.5, 4, 1e6), help="How much memory a check may take.")
    ] = 4.0,
    environment: Annotated[
        list[str] | None,
        typer.Option(
            "--env", metavar="NAME", help="It sees this variable of the environment, too; * is all; repeatable.", show_default=False
        ),
    ] = None,
    quiet: Annotated[bool, typer.Option("-q", "--quiet", help="Print a line a cause, and the count.")] = False,
    verbose: Annotated[int, typer.Option("-v", "--verbose", count=True, help="Print a row a slug, too; -vv: a row a check.")] = 0,
    json: Json = False,
) -> int:
    """Put an implementation through checks.

    The answers are known exactly; exit 1 if a must is not met. The adapter has some of: identify, residual, window_ranks, fault_dimension,
    fault_space, reconstruct, structure, count_faults, identified_fault_space. It runs in a process of
    its own: what hangs, crashes, forks or takes too much memory is told as that, and the next check goes on.
    """
    from . import auditing

    subject = auditing.Asked(adapter, command, peer, tuple(check or ()), seed, quick, timeout, memory, tuple(environment or ()))
    if peers:
        return auditing.list_peers(as_json=json)
    if listed:
        return auditing.list_checks(subject, as_json=json)
    if export is not None:
        return auditing.export(subject, export)
    if reproduce is not None:
        return auditing.reproduce(subject, reproduce, language.value)
    found = auditing.performed(subject, expected) if result is None else auditing.saved(result, subject, expected)
    return auditing.report(found, junit=junit, badge=badge, detail=-1 if quiet else verbose, as_json=json)
