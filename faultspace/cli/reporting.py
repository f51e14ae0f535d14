"""Run `faultspace report`, which makes the page that a reviewer reads, prints it and shows it where that is asked for.

run     the command's body
PDF     the file beside the page
"""

from __future__ import annotations

import time
from pathlib import Path

from rich.text import Text

from ..base.errors import quote_path
from ..base.messages import say
from ..base.progress import working
from ..review.printing import browser, print_page
from ..review.reporting import report
from ..review.serving import serving
from .consoles import answers, paragraph, print_json
from .failures import ANSWERED, NOT_AS_EXPECTED, Terminated

PDF = "report.pdf"


def run(folder: Path | None, out: Path, *, effort: str, jobs: int | None, pdf: bool, serve: bool, as_json: bool) -> int:
    """Make the page. The exit code is that of a verdict which is not as expected, where there is one.

    Raises InvalidInput where an extra or a Chromium is missing, before anything is computed, and for folders that are none."""
    if pdf:
        browser()
    with working("making the page") as tell:
        page = report(folder, out=out, effort=effort, jobs=jobs or -1, on_progress=tell)
        if pdf:
            tell("printing the page", 0, 0)
            print_page(page.path, page.path.with_name(PDF))
    if as_json:
        print_json(page.to_json() | {"pdf": str(page.path.with_name(PDF)) if pdf else None})
    else:
        console = answers()
        for one in page.alarms:
            paragraph(console, Text(f"{one.of}: {one.words}", style="bold red"), "! ")
        paragraph(console, page.title)
        if pdf:
            paragraph(console, f"{quote_path(str(page.path.with_name(PDF)))}: the same, printed")
    if serve:
        _serve(page.path)
    return ANSWERED if page.as_expected else NOT_AS_EXPECTED


def _serve(path: Path) -> None:
    """Show the page until somebody interrupts; that is how it is meant to end, so it is no failure."""
    with serving(path.read_text("utf-8")) as address:
        say(f"the page is at {address} on this machine alone; interrupt (Ctrl-C) to end")
        try:
            while True:
                time.sleep(3600)
        except Terminated:
            raise
        except KeyboardInterrupt:
            return
