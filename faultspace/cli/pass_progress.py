"""How far the passes over a long record have come: one bar on standard error with the time that is left, and nothing where that is no
terminal.

passes      a function to call with (stage, done, total); total 0: not known
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn


@contextmanager
def passes() -> Iterator[Callable[[str, int, int], None]]:
    """Each stage has a bar of its own, which takes the place of the one before: remaining times do not mix."""
    console = Console(file=sys.stderr, markup=False, highlight=False, emoji=False)
    if not console.is_terminal:
        yield lambda stage, done, total: None
        return
    columns = TextColumn("{task.description}", markup=False), BarColumn(), TaskProgressColumn(), TimeRemainingColumn()
    with Progress(*columns, console=console, transient=True) as progress:
        current, task = "starting", progress.add_task("starting", total=None)

        def tell(stage: str, done: int, total: int) -> None:
            nonlocal current, task
            if stage != current:
                progress.remove_task(task)
                current, task = stage, progress.add_task(stage, total=total or None)
            progress.update(task, completed=done)

        yield tell
