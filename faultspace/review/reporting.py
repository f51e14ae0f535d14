"""The page of a run, made: what `fs.report` is, and what `faultspace report` calls.

report      makes it, of a folder that `verify` has written or of a run of its own
Page        where it is, and what is not as expected
PAGE, RUN   the page, and the folder of a run of its own, in the folder that is asked for
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..base.errors import InvalidInput, quote_path, shorten
from ..base.progress import Progress, silent
from ..base.sheets import Shown, counted
from ..base.writing import reason, write_text
from ..proofs.evidence.specimens import specimens
from ..proofs.verdict.run_folder import write_run
from ..proofs.verification import EFFORTS, verify
from .gathering import STANDARD, Sizes, gather
from .page import jinja, render
from .records import read_run

if TYPE_CHECKING:
    from .view.alarms import Alarm

FOLDER, PAGE, RUN = "faultspace-report", "report.html", "run"


@dataclass(frozen=True, repr=False)
class Page(Shown):
    """A page of a run: its `path`, and the tuple `alarms` with what is not as expected, which the page shows before anything else.

    Each alarm has `of`, `words` and the place `href` in the page. Source: [G25] for the claims that it shows. Raises nothing.

    >>> from pathlib import Path
    >>> from faultspace.review.reporting import Page
    >>> Page(Path("report.html"), ()).title
    'report.html: every verdict is the expected one'
    """

    path: Path
    alarms: tuple[Alarm, ...]

    @property
    def as_expected(self) -> bool:
        """This says whether nothing is unexpected."""
        return not self.alarms

    @property
    def title(self) -> str:
        """This names the page and says whether all is as expected."""
        wrong = counted(len(self.alarms), "thing is", "things are")
        return f"{quote_path(str(self.path))}: {f'{wrong} NOT as expected' if self.alarms else 'every verdict is the expected one'}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield what is not as expected, as (name, value) pairs."""
        yield from ((one.of, one.words) for one in self.alarms)

    def to_json(self) -> dict[str, Any]:
        """Return what `faultspace report --json` prints."""
        alarms = [{"of": one.of, "words": one.words} for one in self.alarms]
        return {"page": str(self.path), "as_expected": self.as_expected, "alarms": alarms}


def report(
    run: str | os.PathLike[str] | None = None,
    *,
    out: str | os.PathLike[str] = FOLDER,
    effort: str = "quick",
    jobs: int = -1,
    on_progress: Progress | None = None,
) -> Page:
    """Make the page that a reviewer reads: one file that holds everything and fetches nothing.

    What stands beside the verdicts is computed in half a minute: the example, the limits, a small study, negative controls. It needs
    the extra "report". The claims are those of [G25].

    Parameters
    ----------
    run : path, optional
        A folder that `faultspace verify --out` has written; None has one made first and kept in the folder `run` of `out`, which takes
        minutes.
    out : path
        The folder in which the page is report.html.
    effort : str
        "quick" or "full", of a run that is made.
    jobs : int
        The number of processes, -1 for one for each core.
    on_progress : callable, optional

    Returns
    -------
    Page

    Raises
    ------
    InvalidInput
        Where Jinja2 is missing, for a folder that no run has written, for one that cannot be written into, and for an unknown effort.

    Examples
    --------
    >>> import faultspace as fs
    >>> fs.report("no-such-folder")
    Traceback (most recent call last):
      ...
    faultspace.base.errors.InvalidInput: no-such-folder/verdicts.json: is not there, expected what `faultspace verify --out DIR` writes
    """
    return made(run, Path(out), effort, jobs, on_progress or silent)


def made(run: str | os.PathLike[str] | None, out: Path, effort: str, jobs: int, on_progress: Progress, sizes: Sizes = STANDARD) -> Page:
    """Return the page of a run with so much computed beside it."""
    jinja()
    from .view.alarms import alarms  # what draws needs the extra
    from .view.claims import claims

    if effort not in EFFORTS:
        raise InvalidInput(f"effort: got {shorten(effort)}, expected one of {', '.join(EFFORTS)}")
    if run is not None:
        read = read_run(Path(run))
    _prepare(out)
    if run is None:
        read = read_run(_decided(out / RUN, effort, jobs, on_progress))
    records = gather(read, sizes, on_progress=on_progress)
    on_progress("writing the page", 0, 0)
    write_text(out / PAGE, render(records))
    return Page(out / PAGE, tuple(alarms(claims(records, ()), records)))


def _decided(folder: Path, effort: str, jobs: int, on_progress: Progress) -> Path:
    """Return the folder with a new run."""
    _prepare(folder)
    if any(folder.iterdir()):
        name = quote_path(str(folder))
        raise InvalidInput(f"{name}: got files, expected an empty folder or none; if they are a run, its page is made by --run {name}")
    write_run(verify(effort=effort, jobs=jobs, on_progress=on_progress), folder, specimens())  # kept, should the rest be broken off
    return folder


def _prepare(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InvalidInput(f"{quote_path(str(folder))}: cannot be made ({reason(error)}), expected a folder to write into") from None
