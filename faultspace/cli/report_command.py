"""Declare the command `faultspace report`; its work is in `reporting.py`, imported when the command is asked for."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .option_types import Effort, Json, jobs_number


def report(
    run: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="A folder that `faultspace verify --out` has written.", show_default="decide the claims now"),
    ] = None,
    out: Annotated[Path, typer.Option(metavar="DIR", help="Write the page there.")] = Path("faultspace-report"),
    effort: Annotated[Effort, typer.Option(help="Of the run, where the claims are decided now.")] = Effort.quick,
    jobs: Annotated[
        int | None, typer.Option(metavar="K", parser=jobs_number, help="Processes at a time.", show_default="all cores")
    ] = None,
    pdf: Annotated[bool, typer.Option("--pdf", help="Print the page into report.pdf, too; needs a Chromium.")] = False,
    serve: Annotated[bool, typer.Option("--serve", help="Show the page at a local address until you interrupt it.")] = False,
    json: Json = False,
) -> int:
    """Make the page that a reviewer reads.

    One file with everything: the claims as stated and as checked, counterexamples, limits, a small study, what must be believed, what was
    wrong. It fetches nothing. Without --run the claims and the statements of the literature are decided first, which takes minutes. Exit 0
    if everything is as expected, else 1: then the page begins with what is not. Needs the extra: pip install 'faultspace[report]'.
    """
    from . import reporting

    return reporting.run(run, out, effort=effort.value, jobs=jobs, pdf=pdf, serve=serve, as_json=json)
