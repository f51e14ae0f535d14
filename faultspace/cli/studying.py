"""Run `faultspace monte-carlo`, the paper's study as published and as corrected, with the true and with an identified model.

run        the command's body
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

from ..base.errors import InvalidInput, quote_path
from ..base.messages import say
from ..base.progress import evenly, working
from ..numeric.plant.report.folders import refuse
from ..numeric.study.keeping import Kept, Settings, keeping
from ..numeric.study.studies import STUDIES, Study, check_memory, monte_carlo
from .consoles import answers, paragraph, print_json, print_table
from .failures import ANSWERED, NOT_AS_EXPECTED
from .reading_files import prepare_folder
from .study_report import EXPLANATION, NAMES, document, remarks, table, write


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
