"""Run `faultspace verify`, which decides every claim of the ledger anew, with the certificates that the verdicts rest on."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..base.errors import InvalidInput, quote_path, shorten
from ..base.messages import say
from ..base.progress import working
from ..base.sheets import counted
from ..proofs.evidence.specimens import specimens
from ..proofs.rocq import recheck as rocq_recheck
from ..proofs.rocq.build import BrokenTheory, NoRocq, NotProved
from ..proofs.verdict.ledger import load
from ..proofs.verdict.run_folder import write_run
from ..proofs.verdict.verdicts import Report
from ..proofs.verification import verify
from .consoles import answers, paragraph, print_json
from .failures import ANSWERED, NOT_AS_EXPECTED
from .reading_files import prepare_folder
from .verdict_tables import print_differences, print_lines, print_machine, print_page, print_summary


def run(
    claims: Sequence[str],
    *,
    effort: str,
    jobs: int,
    scheduler: str | None = None,
    out: Path | None,
    recheck: bool,
    as_json: bool,
    verbose: bool = False,
    resume: Path | None = None,
) -> int:
    """Decide the claims (all when none is named), with `recheck` by theorems that are compiled anew, on a cluster where there is one. What
    is decided is kept in the file `resume` as it comes, and not decided again.

    Raises InvalidInput for an unknown claim or a folder that cannot be written into, and to recheck without Rocq; InvalidData for a cluster
    that cannot be used.
    """
    known = [claim.id for claim in load()]
    for name in claims:
        if name not in known:
            raise InvalidInput(f"--claim: got {shorten(name)}, expected one of {', '.join(known)}")
    if out is not None:
        prepare_folder(out)
    if recheck and not _rechecked():
        return NOT_AS_EXPECTED
    with working("deciding the claims") as tell:
        report = verify(claims or None, effort=effort, jobs=jobs, scheduler=scheduler, resume=resume, on_progress=tell)
    if out is not None:
        count = write_run(report, out, () if claims else specimens())
        say(f"{counted(count, 'certificate')} and verdicts.json are in {quote_path(str(out))}")
    if as_json:
        print_json(report.to_json())
    else:
        _print(report, pages=bool(claims), verbose=verbose)
    return ANSWERED if report.as_expected else NOT_AS_EXPECTED


def _rechecked() -> bool:
    """Return whether the theory, compiled anew, is accepted, and say so. Raises InvalidInput where there is no Rocq."""
    try:
        with working("compiling the Rocq theory anew") as tell:
            outcome = rocq_recheck.recheck(tell)
        say(f"the Rocq theory was {outcome}")
    except NoRocq as error:
        raise InvalidInput(f"--recheck: {error}") from None
    except (BrokenTheory, NotProved) as error:
        say(f"the Rocq theory, compiled anew, is not accepted: {error}")
        return False
    return True


def _print(report: Report, *, pages: bool, verbose: bool) -> None:
    """Print what is not as expected, then pages, a line for each claim, or both, and always the summary line last."""
    console = answers()
    print_differences(console, report)
    if pages or verbose:
        for claim in report.claims:
            print_page(console, claim, [row for row in report.hypotheses if row.claim == claim.claim.id])
        if report.corpus:
            paragraph(console, report.corpus, "systems: ")
    if pages:
        print_machine(console, report)
    else:
        print_lines(console, report)
    print_summary(console, report)
