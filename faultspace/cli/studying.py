"""Run `faultspace monte-carlo`, the paper's study as published and as corrected, with the true and with an identified model.

run        the command's body
document   what studies.json and --json hold; its schema is schemas/monte_carlo.schema.json
remarks    what a reader of the published figures should know, with this run's counts
table      a study's groups for the terminal
lines      the summary that a person reads, in Markdown
NAMES      the files that `write` makes: studies.json, cases.csv, summary.md and a figure for each study
write      these files into a folder, each whole or not at all, without touching a file of these names that no earlier run wrote
"""

from __future__ import annotations

import csv
import json
import tempfile
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from rich import box
from rich.table import Table

from ..base.errors import InvalidInput, quote_path
from ..base.messages import say
from ..base.progress import evenly, working
from ..base.sheets import counted
from ..base.writing import new_file, reason
from ..numeric.plant.report.folders import refuse, replace
from ..numeric.plant.report.result_pictures import drawn
from ..numeric.study.groups import QUANTILES, Group, by_phase, by_zeros
from ..numeric.study.keeping import TEMPORARY, Kept, Settings, keeping
from ..numeric.study.studies import STUDIES, Study, check_memory, monte_carlo
from ..numeric.study.study_cases import LIKELIHOOD
from .consoles import answers, paragraph, print_json, print_table
from .failures import ANSWERED, NOT_AS_EXPECTED
from .reading_files import prepare_folder

DOCUMENT, CASES, SUMMARY = "studies.json", "cases.csv", "summary.md"
NAMES = (DOCUMENT, CASES, SUMMARY, *(f"figure-{name}.png" for name in STUDIES))
FORMAT = "faultspace-monte-carlo/2"
ROUNDING = 1e-13
OTHER_QUANTILES = tuple(q for q in QUANTILES if q != 0.5)
HEADER = (
    "estimator",
    "systems",
    "median",
    "95 % interval",
    *(f"{100 * q:.0f} %" for q in OTHER_QUANTILES),
    "containment",
    "random",
    "right n_z",
    "remark",
)
LEFT = ("estimator", "remark")
METRICS = ("published", "containment", "two_sided")
EXPLANATION = (
    "median: with the interval that holds it with 95 % confidence; containment: median of the angles from [F; G] alone over their maximum; "
    "random: median error of a random subspace of dimension n_z; right n_z: cases with the true dimension, "
    "of which paper is told and the others are not"
)


def run(
    *, systems: int, samples: int, jobs: int | None, scheduler: str | None, seed: int, out: Path, resume: bool = False, as_json: bool
) -> int:
    """Run all studies on the same systems and write them into `out`, where each case is kept as it comes; `resume` goes on with what an
    unfinished run has kept. The code is that of an unexpected answer where a case failed.

    Raises InvalidInput for a folder that cannot be written into, for one that another run has, with a file of these names that no earlier
    run wrote, or with cases of an unfinished run that are not those asked for, and for jobs or a cluster that cannot be used."""
    check_memory(systems, samples, len(STUDIES))
    prepare_folder(out)
    refuse(out, NAMES)
    with keeping(out, Settings(seed, samples), resume=resume) as kept:
        try:
            studies = _studies(kept, systems=systems, samples=samples, jobs=jobs, scheduler=scheduler, seed=seed)
            written = write(studies, out)
        except InvalidInput as error:
            raise InvalidInput(f"{error}; {kept.hint}" if kept.hint else str(error)) from None
        except KeyboardInterrupt:
            if kept.hint:
                say(kept.hint)
            raise
        kept.finish()
    if as_json:
        print_json(document(studies))
    else:
        console = answers()
        for study in studies:
            print_table(console, table(study))
        for line in (EXPLANATION, *remarks(studies)):
            paragraph(console, line)
    say(f"{', '.join(written)} are in {quote_path(str(out))}")
    return NOT_AS_EXPECTED if any(study.failed for study in studies) else ANSWERED


def _studies(kept: Kept, *, systems: int, samples: int, jobs: int | None, scheduler: str | None, seed: int) -> list[Study]:
    studies = []
    with working("starting the study") as tell:
        for name, plan in STUDIES.items():
            study = monte_carlo(
                plan,
                systems=systems,
                seed=seed,
                samples=samples,
                jobs=jobs,
                cluster=scheduler,
                known=kept.cases.get(name),
                on_cases=partial(kept.add, name),
                on_progress=evenly(tell),
            )
            studies.append(study)
    return studies


def document(studies: Sequence[Study]) -> dict[str, Any]:
    """Return what studies.json and --json hold."""
    return {"format": FORMAT, "remarks": remarks(studies), "studies": [study.to_json() for study in studies]}


def remarks(studies: Sequence[Study]) -> list[str]:
    """Return what a reader of the published figures should know, with the counts of this run."""
    found = []
    for study in studies:
        name = study.plan.name
        vacuous = [case for case in study.cases if case.vacuous]
        if vacuous:
            first = vacuous[0]
            found.append(
                f"{name}: {len(vacuous)} of {len(study.cases)} cases are vacuous: rank R_{first.block_rows} = {first.rank} of "
                f"{first.rows} rows leaves no null row, so the answer is all of R^{first.n_z} and the error zero by construction"
            )
        if study.failed:
            first_failed = study.failed[0]
            failed = f"{counted(len(study.failed), 'case')} of {len(study.cases) + len(study.failed)} failed, and no table has them"
            found.append(f"{name}: {failed}; system {first_failed.index}, the first, because: {first_failed.reason}")
        if not study.cases:
            continue
        level = sum(case.decibels for case in study.cases) / len(study.cases)
        found.append(f"{name}: the noise lies {level:.1f} dB below the outputs' standard deviation (40 dB are stated)")
        if LIKELIHOOD in study.plan.estimators:
            right = sum(case.estimates[LIKELIHOOD].n_z == case.n_z for case in study.cases)
            found.append(f"{name}: likelihood counts the zeros itself and is right in {right} of {len(study.cases)} cases")
        failures = [found.failure for case in study.cases for found in case.estimates.values() if found.failure is not None]
        if failures:
            found.append(f"{name}: {len(failures)} estimates were refused, the first because: {failures[0]}")
    found.append("the published normaliser n_v pi/2 is sqrt(n_v) times too large: by it no error can exceed 71 %")
    return found


def table(study: Study) -> Table:
    """Return a table of the groups by zeros and by phase."""
    title = f"{study.plan.title}\nerror in percent: {study.plan.metric_text}"
    rows = Table(box=box.SIMPLE_HEAD, title=title, title_justify="left", pad_edge=False, padding=(0, 1, 0, 0))
    for heading in ("cases", *HEADER):
        rows.add_column(heading, justify="left" if heading in ("cases", *LEFT) else "right", no_wrap=True)
    for groups in (by_zeros(study), by_phase(study)):
        for group in groups:
            rows.add_row(group.label, *_cells(group))
        rows.add_section()
    return rows


def lines(studies: Sequence[Study]) -> Iterator[str]:
    """Yield the summary line by line."""
    first = studies[0]
    yield "# The Monte Carlo study"
    yield ""
    yield (
        f"{counted(len(first.cases) + len(first.failed), 'system')}, seed {first.seed}, "
        f"{counted(first.samples, 'sample')}; the same systems and faults in each study."
    )
    yield f"Errors in percent. {EXPLANATION[0].upper()}{EXPLANATION[1:]}."
    for study in studies:
        yield ""
        yield f"## {study.plan.title}"
        yield ""
        yield f"Error: {study.plan.metric_text}."
        yield ""
        yield f"| cases | {' | '.join(HEADER)} |"
        yield "|---|" + "".join("---|" if heading in LEFT else "---:|" for heading in HEADER)
        for group in (*by_zeros(study), *by_phase(study)):
            yield f"| {group.label} | {' | '.join(_cells(group))} |"
    yield ""
    yield "## Remarks"
    yield ""
    for remark in remarks(studies):
        yield f"- {remark}"


def write(studies: Sequence[Study], out: Path) -> list[str]:
    """Write the files into a folder in `out` first, then move them, and return their names. Files of NAMES that an earlier run wrote are
    replaced, or removed where this run has none. Raises InvalidInput where that fails, and, before anything is written, where `out` has a
    file of these names that no earlier run wrote, or that was changed since."""
    refuse(out, NAMES)
    try:
        with tempfile.TemporaryDirectory(prefix=f"{TEMPORARY}-", dir=out) as name:
            folder = Path(name)
            texts = {DOCUMENT: json.dumps(document(studies), indent=1), SUMMARY: "\n".join(lines(studies))}
            for file, text in texts.items():
                with new_file(folder / file, encoding="utf-8") as stream:
                    stream.write(f"{text}\n")
            _write_cases(studies, folder / CASES)
            _draw(studies, folder)
            written = replace(folder, out, NAMES)
    except OSError as error:
        raise InvalidInput(f"{quote_path(str(out))}: cannot be written into ({reason(error)}), expected a folder that can") from None
    return written


def _cells(group: Group) -> list[str]:
    """Return the row of a group under HEADER."""
    quantiles = dict(zip(QUANTILES, group.quantiles, strict=True)) if group.quantiles else {}
    interval = " .. ".join(_percent(end, digits=2) for end in group.interval) if group.interval else ""
    remark = [f"{group.vacuous} vacuous" if group.vacuous else "", f"{group.failed} refused" if group.failed else ""]
    return [
        group.estimator,
        str(group.cases),
        _percent(quantiles.get(0.5)),
        interval,
        *(_percent(quantiles.get(q), digits=2) for q in OTHER_QUANTILES),
        _percent(group.containment_median),
        _percent(group.random_median),
        str(group.right_dimension),
        ", ".join(filter(None, remark)),
    ]


def _percent(value: float | None, digits: int = 3) -> str:
    """Return the angle in percent; one at the level of rounding is shown as zero."""
    return "" if value is None else f"{100 * value:.{digits}g}" if value > ROUNDING else "0"


def _write_cases(studies: Sequence[Study], path: Path) -> None:
    """Write a row for each estimate of each case of each study, then one for each case that failed, with its index and the reason."""
    plain = ("index", "n_zeros", "minimum_phase", "distance_to_unit_circle", "decibels", "block_rows", "rows", "rank", "n_z", "vacuous")
    with new_file(path, encoding="utf-8", newline="") as stream:
        rows = csv.writer(stream, lineterminator="\n")
        found = ("estimator", "estimated_n_z", *METRICS, *(f"random_{metric}" for metric in METRICS), "failure")
        rows.writerow(("study", *plain, "zeros", *found))
        for study in studies:
            for case in study.cases:
                system = (study.plan.name, *(getattr(case, name) for name in plain), " ".join(map(repr, case.zeros)))
                random = [getattr(case.random, metric) for metric in METRICS]
                for name, estimate in case.estimates.items():
                    errors = [getattr(estimate.errors, metric) if estimate.errors else "" for metric in METRICS]
                    rows.writerow((*system, name, estimate.n_z, *errors, *random, estimate.failure or ""))
            for failed in study.failed:
                rows.writerow((study.plan.name, failed.index, *[""] * (len(plain) + len(found) - 1), failed.reason))


def _draw(studies: Sequence[Study], folder: Path) -> None:
    """Draw figure-NAME.png for each study, where matplotlib is there."""
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        say("no figures are drawn, since matplotlib is missing: pip install 'faultspace[plots]'")
        return
    from ..numeric.study.plots import study_figure

    for study in studies:
        if not study.cases:
            continue
        for remark in drawn(folder / f"figure-{study.plan.name}.png", partial(study_figure, study)):
            say(remark)
