"""`faultspace monte-carlo`: the paper's study as published and as corrected, with the true and with an identified model.

run        the command's body
watching   progress on standard error with the time that remains
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

from ..base.errors import InvalidData, InvalidInput, quote_path
from ..numeric.study.studies import STUDIES, monte_carlo
from .consoles import answers, print_json
from .failures import ANSWERED, say
from .reading_files import prepare_folder
from .study_report import EXPLANATION, document, remarks, table, write

TELL_EVERY = 10.0

Tell = Callable[[str, int, int, float], None]


def run(*, systems: int, samples: int, jobs: int | None, cluster: str | None, seed: int, out: Path, as_json: bool) -> int:
    """All studies on the same systems, written into `out`. Raises InvalidInput for a folder that cannot be written into, and for jobs or
    a cluster that cannot be used."""
    prepare_folder(out)
    studies = []
    try:
        with watching() as tell:
            for name, plan in STUDIES.items():
                watch = _told(tell, name)
                studies.append(monte_carlo(plan, systems=systems, seed=seed, samples=samples, jobs=jobs, cluster=cluster, progress=watch))
    except InvalidData as error:
        raise InvalidInput(str(error)) from None
    written = write(studies, out)
    if as_json:
        print_json(document(studies))
    else:
        console = answers()
        for study in studies:
            console.print(table(study))
        for line in (EXPLANATION, *remarks(studies)):
            console.print(line, soft_wrap=True)
    say(f"{', '.join(written)} are in {quote_path(str(out))}")
    return ANSWERED


@contextmanager
def watching() -> Iterator[Tell]:
    """A function to call with (study, done, total, seconds left): a bar on a terminal, elsewhere a line at times."""
    console = Console(stderr=True, markup=False, highlight=False, emoji=False)
    if not console.is_terminal:
        last = time.monotonic()

        def tell(study: str, done: int, total: int, left: float) -> None:
            nonlocal last
            if time.monotonic() - last >= TELL_EVERY and done < total:
                last = time.monotonic()
                say(f"{study}: {done} of {total} systems, about {_duration(left)} left")

        yield tell
        return
    name, left = (TextColumn(text, markup=False) for text in ("{task.description}", "{task.fields[left]}"))
    with Progress(name, BarColumn(), MofNCompleteColumn(), left, console=console, transient=True) as progress:
        task = progress.add_task("starting", total=None, left="")

        def show(study: str, done: int, total: int, left: float) -> None:
            progress.update(task, description=study, completed=done, total=total, left=f"{_duration(left)} left")

        yield show


def _told(tell: Tell, name: str) -> Callable[[int, int, float], None]:
    return lambda done, total, left: tell(name, done, total, left)


def _duration(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 90 else f"{seconds / 60:.0f} min"
