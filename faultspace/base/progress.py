"""How far a long task has come: who hears of it, and how it is shown on standard error, by the same code for every command.

Nothing is shown for two seconds. Then one line moves where standard error is a terminal; elsewhere there is a plain line, and another one
after ten seconds at the least and only where something has changed.

Progress     what every `on_progress` is: called with (stage, done, total)
silent       hears of progress and says nothing
working      gives a function to call with (stage, done, total, seconds left); total 0 says that nobody knows how much there is
evenly       the same function for work whose parts take equally long: it adds the time that is left
Tell         the type of that function
State        how far the work was when it was last reported
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from threading import Event, Thread
from typing import Protocol

from .messages import say
from .others_text import printable

Progress = Callable[[str, int, int], None]

PATIENCE = 2.0
EVERY = 10.0
FRAME = 0.1
BAR_WIDTH = 12
MOST_COUNTED = 10_000


def silent(stage: str, done: int, total: int) -> None:
    """Hears of progress and says nothing."""


class Tell(Protocol):
    """Hears how far the work is: `left` is in seconds, None where nobody can say."""

    def __call__(self, stage: str, done: int = 0, total: int = 0, left: float | None = None, /) -> None: ...


@dataclass(frozen=True)
class State:
    """What was reported last; `total` is 0 where it is not known."""

    stage: str
    done: int = 0
    total: int = 0
    left: float | None = None

    @property
    def amount(self) -> str:
        """Return how much of how much, in percent where the numbers are long, and the time that is left; empty where nothing is known."""
        if not self.total:
            return ""
        count = f"{self.done} of {self.total}" if self.total < MOST_COUNTED else f"{100 * self.done / self.total:.0f} %"
        return count if self.left is None else f"{count}, about {_duration(self.left)} left"

    @property
    def line(self) -> str:
        """Return the plain line."""
        return f"{self.stage} ({self.amount})" if self.amount else f"{self.stage} ..."


@contextmanager
def working(stage: str) -> Iterator[Tell]:
    """Show how far the body is, which begins with this stage. What the body reports is only noted; a thread of its own shows it."""
    now = State(stage)

    def tell(stage: str, done: int = 0, total: int = 0, left: float | None = None, /) -> None:
        nonlocal now
        now = State(stage, done, total, left)

    stopped = Event()
    show = _moving if sys.stderr.isatty() else _plain
    thread = Thread(target=show, args=(lambda: now, stopped), daemon=True)
    thread.start()
    try:
        yield tell
    finally:
        stopped.set()
        thread.join()


def evenly(tell: Tell) -> Progress:
    """Return `tell` with the seconds that are left of the stage, as long as its parts take what those before them took."""
    stage, begun, first = "", 0.0, 0

    def tell_of(current: str, done: int, total: int) -> None:
        nonlocal stage, begun, first
        if current != stage:
            stage, begun, first = current, time.monotonic(), done
        passed = time.monotonic() - begun
        known = done > first and total > 0 and passed > PATIENCE
        tell(current, done, total, passed * (total - done) / (done - first) if known else None)

    return tell_of


def _plain(now: Callable[[], State], stopped: Event) -> None:
    said = None
    pause = PATIENCE
    while not stopped.wait(pause):
        state, pause = now(), EVERY
        if state != said:
            said = state
            say(state.line)


def _moving(now: Callable[[], State], stopped: Event) -> None:
    begun = time.monotonic()
    if stopped.wait(PATIENCE):
        return
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn
    from rich.progress import Progress as Bar
    from rich.table import Column

    console = Console(file=sys.stderr, markup=False, highlight=False, emoji=False)
    if console.is_dumb_terminal:  # it cannot go back to the beginning of a line
        _plain(now, stopped)
        return
    short, long = Column(no_wrap=True), Column(no_wrap=True, overflow="ellipsis", ratio=1)
    columns = (
        TextColumn("{task.fields[elapsed]}", markup=False, table_column=short),
        BarColumn(BAR_WIDTH),
        TextColumn("{task.fields[amount]}", markup=False, table_column=Column(no_wrap=True)),
        TextColumn("{task.description}", markup=False, table_column=long),
    )
    with (
        suppress(OSError),  # nobody reads standard error any more
        Bar(*columns, console=console, transient=True, expand=True, redirect_stdout=False) as bar,
    ):
        task = bar.add_task("", total=None, elapsed="", amount="")
        while True:
            state = now()
            minutes, seconds = divmod(int(time.monotonic() - begun), 60)
            elapsed, total = f"{minutes}:{seconds:02}", state.total or None
            bar.update(task, description=printable(state.stage), completed=state.done, total=total, elapsed=elapsed, amount=state.amount)
            if stopped.wait(FRAME):
                return


def _duration(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 90 else f"{seconds / 60:.0f} min"
