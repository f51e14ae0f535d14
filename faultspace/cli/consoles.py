"""The two streams: answers on standard output, everything about how it is going on standard error.

answers        the console for tables: colours and the window's width on a terminal, plain and 140 wide or more elsewhere
print_json     one document on one line
working        a spinner on standard error for work that takes longer than two seconds
stages         a progress bar for work that tells its stage, how much is done and how much there is
"""

from __future__ import annotations

import json
import os
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.text import Text

from .failures import say

PIPED_WIDTH = 140
PATIENCE = 2.0


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


def print_json(document: object) -> None:
    """The document on one line of standard output."""
    sys.stdout.write(json.dumps(document) + "\n")
    sys.stdout.flush()


@contextmanager
def working(what: str) -> Iterator[None]:
    """While the body runs: after two seconds a spinner on a terminal, a single line elsewhere."""
    console = _progress_console()
    status = console.status(Text(f"{what} ..."))
    begin = status.start if console.is_terminal else lambda: say(f"{what} ...")
    timer = threading.Timer(PATIENCE, begin)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        timer.join()
        status.stop()


@contextmanager
def stages() -> Iterator[Callable[[str, int, int], None]]:
    """A function to call with (stage, done, total): a bar on a terminal, one line a stage elsewhere."""
    console = _progress_console()
    if not console.is_terminal:
        seen: set[str] = set()

        def tell(stage: str, done: int, total: int) -> None:
            if stage not in seen:
                seen.add(stage)
                say(f"{stage} ({done}/{total})")

        yield tell
        return
    columns = TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn()
    with Progress(*columns, console=console, transient=True) as progress:
        task = progress.add_task("starting", total=None)
        yield lambda stage, done, total: progress.update(task, description=stage, completed=done, total=total)


def _progress_console() -> Console:
    return Console(file=sys.stderr, markup=False, highlight=False, emoji=False)


def _columns() -> int:
    try:
        return int(os.environ.get("COLUMNS", ""))
    except ValueError:
        return 0
