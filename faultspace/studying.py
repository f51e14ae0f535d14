"""`faultspace monte-carlo`: the paper's study as published, as corrected, and with an identified model; tables, figures and all cases.

run        the command's body
lines      the summary that a person reads, in Markdown
write      studies.json, cases.csv, summary.md and a figure for each study into a folder, each whole or not at all
watching   progress on standard error with the time that remains
"""

from __future__ import annotations

import csv
import json
import os
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rich import box
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn
from rich.table import Table

from .consoles import answers, print_json
from .exact.input_rules import InvalidInput
from .failures import ANSWERED, printable, say
from .numeric.input_checks import InvalidData
from .numeric.monte_carlo import QUANTILES, STUDIES, Group, Study, by_phase, by_zeros
from .reading_files import prepare_folder

DOCUMENT, CASES, SUMMARY = "studies.json", "cases.csv", "summary.md"
TELL_EVERY = 10.0
ROUNDING = 1e-13
HEADER = ("systems", "median", *(f"{100 * q:.0f} %" for q in QUANTILES if q != 0.5), "random subspace", "remark")
METRICS = ("published", "containment", "two_sided")

Tell = Callable[[str, int, int, float], None]


def run(*, systems: int, jobs: int | None, seed: int, out: Path, as_json: bool) -> int:
    """All three studies on the same systems, written into `out`. Raises InvalidInput for a folder that cannot be written into."""
    prepare_folder(out)
    studies = []
    try:
        with watching() as tell:
            for name, study in STUDIES.items():
                studies.append(study(systems=systems, seed=seed, jobs=jobs, progress=_told(tell, name)))
    except InvalidData as error:
        raise InvalidInput(str(error)) from None
    written = write(studies, out)
    if as_json:
        print_json(document(studies))
    else:
        console = answers()
        for each in studies:
            console.print(_table(each))
        for line in remarks(studies):
            console.print(line, soft_wrap=True)
    say(f"{', '.join(written)} are in {printable(str(out))}")
    return ANSWERED


def document(studies: Sequence[Study]) -> dict[str, Any]:
    """What studies.json and --json hold."""
    return {"format": "faultspace-monte-carlo/1", "remarks": remarks(studies), "studies": [study.to_json() for study in studies]}


def remarks(studies: Sequence[Study]) -> list[str]:
    """What a reader of the published figures should know, with the counts of this run."""
    told = []
    for study in studies:
        vacuous = [case for case in study.cases if case.vacuous]
        if vacuous:
            first = vacuous[0]
            told.append(
                f"{study.name}: {len(vacuous)} of {len(study.cases)} cases are vacuous: rank R_{first.block_rows} = {first.rank} of "
                f"{first.rows} rows leaves no null row, so the answer is all of R^{first.n_z} and the error zero by construction"
            )
        level = sum(case.decibels for case in study.cases) / len(study.cases)
        told.append(f"{study.name}: the noise lies {level:.1f} dB below the outputs' standard deviation (40 dB are stated)")
        failed = [case for case in study.cases if case.failure is not None]
        if failed:
            told.append(f"{study.name}: {len(failed)} identifications were refused, the first because: {failed[0].failure}")
    told.append("the published normaliser n_v pi/2 is sqrt(n_v) times too large: by it no error can exceed 71 %")
    return told


def lines(studies: Sequence[Study]) -> Iterator[str]:
    """The summary, line by line."""
    yield "# The Monte Carlo study"
    yield ""
    first = studies[0]
    yield f"{len(first.cases)} systems, seed {first.seed}, {first.samples} samples; the same systems and faults in each study."
    yield "Errors in percent."
    for study in studies:
        yield ""
        yield f"## {study.title}"
        yield ""
        yield f"Error: {study.metric_text}."
        yield ""
        yield f"| cases | {' | '.join(HEADER)} |"
        yield f"|---|{'---:|' * (len(HEADER) - 1)}---|"
        for group in (*by_zeros(study), *by_phase(study)):
            yield f"| {group.label} | {' | '.join(_cells(group))} |"
    yield ""
    yield "## Remarks"
    yield ""
    for remark in remarks(studies):
        yield f"- {remark}"


def write(studies: Sequence[Study], out: Path) -> list[str]:
    """The files into the folder `out`, written beside it first; their names. Raises InvalidInput where that fails."""
    try:
        with tempfile.TemporaryDirectory(prefix=".unfinished-", dir=out) as name:
            folder = Path(name)
            (folder / DOCUMENT).write_text(json.dumps(document(studies), indent=1) + "\n", encoding="utf-8")
            _write_cases(studies, folder / CASES)
            (folder / SUMMARY).write_text("\n".join(lines(studies)) + "\n", encoding="utf-8")
            _draw(studies, folder)
            names = sorted(path.name for path in folder.iterdir())
            for each in names:
                os.replace(folder / each, out / each)
    except OSError as error:
        raise InvalidInput(f"{printable(str(out))}: cannot be written into ({error.strerror or error})") from None
    return names


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


def _table(study: Study) -> Table:
    table = Table(box=box.SIMPLE_HEAD, title=f"{study.title}\nerror in percent: {study.metric_text}", title_justify="left", pad_edge=False)
    table.add_column("cases")
    for heading in HEADER:
        table.add_column(heading, justify="left" if heading == "remark" else "right")
    for groups in (by_zeros(study), by_phase(study)):
        for group in groups:
            table.add_row(group.label, *_cells(group))
        table.add_section()
    return table


def _cells(group: Group) -> list[str]:
    """The row of a group under HEADER."""
    quantiles = dict(zip(QUANTILES, group.quantiles, strict=True)) if group.quantiles else {}
    values = [quantiles.get(q) for q in (0.5, *(q for q in QUANTILES if q != 0.5))]
    remark = [f"{group.vacuous} vacuous" if group.vacuous else "", f"{group.failed} refused" if group.failed else ""]
    return [str(group.cases), *(_percent(value) for value in (*values, group.random_median)), ", ".join(filter(None, remark))]


def _percent(value: float | None) -> str:
    """Angles at rounding level are zero."""
    return "" if value is None else f"{100 * value:.3g}" if value > ROUNDING else "0"


def _write_cases(studies: Sequence[Study], path: Path) -> None:
    """A row for each case of each study."""
    plain = ("index", "n_zeros", "minimum_phase", "distance_to_unit_circle", "decibels", "block_rows", "rows", "rank", "n_z", "vacuous")
    with open(path, "w", encoding="utf-8", newline="") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(("study", *plain, "zeros", *METRICS, *(f"random_{metric}" for metric in METRICS), "failure"))
        for study in studies:
            for case in study.cases:
                errors = [getattr(case.errors, metric) if case.errors else "" for metric in METRICS]
                random = [getattr(case.random, metric) for metric in METRICS]
                zeros = " ".join(map(repr, case.zeros))
                table.writerow((study.name, *(getattr(case, name) for name in plain), zeros, *errors, *random, case.failure or ""))


def _draw(studies: Sequence[Study], folder: Path) -> None:
    """figure-NAME.png for each study, where matplotlib is there."""
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        say("no figures: matplotlib is missing (pip install faultspace[plots])")
        return
    from .numeric.study_plots import study_figure

    for study in studies:
        study_figure(study).savefig(folder / f"figure-{study.name}.png", dpi=130)
