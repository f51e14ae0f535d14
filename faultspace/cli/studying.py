"""Run `faultspace monte-carlo`, the paper's study as published and as corrected, with the true and with an identified model.

run        the command's body
"""

from __future__ import annotations

from pathlib import Path

from ..base.errors import quote_path
from ..base.messages import say
from ..base.progress import evenly, working
from ..numeric.report.folders import refuse
from ..numeric.study.studies import STUDIES, monte_carlo
from .consoles import answers, paragraph, print_json, print_table
from .failures import ANSWERED
from .reading_files import prepare_folder
from .study_report import EXPLANATION, NAMES, document, remarks, table, write


def run(*, systems: int, samples: int, jobs: int | None, cluster: str | None, seed: int, out: Path, as_json: bool) -> int:
    """Run all studies on the same systems and write them into `out`.

    Raises InvalidInput for a folder that cannot be written into, for one with a file of these names that no earlier run wrote, and for
    jobs or a cluster that cannot be used."""
    prepare_folder(out)
    refuse(out, NAMES)
    studies = []
    with working("starting") as tell:
        for plan in STUDIES.values():
            watch = evenly(tell)
            studies.append(monte_carlo(plan, systems=systems, seed=seed, samples=samples, jobs=jobs, cluster=cluster, on_progress=watch))
    written = write(studies, out)
    if as_json:
        print_json(document(studies))
    else:
        console = answers()
        for study in studies:
            print_table(console, table(study))
        for line in (EXPLANATION, *remarks(studies)):
            paragraph(console, line)
    say(f"{', '.join(written)} are in {quote_path(str(out))}")
    return ANSWERED
