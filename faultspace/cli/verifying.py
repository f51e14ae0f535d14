"""Run `faultspace verify`, which decides every claim of the ledger anew, with the certificates that the verdicts rest on.

run             the command's body
nearest         the claim whose name is most like another one
"""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from pathlib import Path

from ..base.errors import InvalidInput, quote_path, shorten
from ..base.messages import say
from ..base.progress import working
from ..base.sheets import counted
from ..proofs.evidence.specimens import specimens
from ..proofs.rocq import recheck as rocq_recheck
from ..proofs.rocq.build import BrokenTheory, NoRocq, NotProved
from ..proofs.verdict.cards import with_cards
from ..proofs.verdict.ledger import load
from ..proofs.verdict.run_folder import write_run
from ..proofs.verdict.verdicts import Report
from ..proofs.verification import verify
from .claim_cards import print_card, print_sentences
from .consoles import answers, paragraph, print_json
from .failures import ANSWERED, NOT_AS_EXPECTED
from .reading_files import prepare_folder
from .verdict_tables import print_differences, print_machine, print_page, print_rest, print_summary


def run(
    claims: Sequence[str],
    *,
    effort: str,
    jobs: int,
    scheduler: str | None = None,
    out: Path | None,
    rocq: bool = False,
    recheck: bool,
    as_json: bool,
    verbose: bool = False,
    resume: Path | None = None,
) -> int:
    """Decide the claims (all when none is named), with `rocq` by theorems that are compiled first where they are not yet, with `recheck`
    whatever is there, on a cluster where there is one. What is decided is kept in the file `resume` as it comes, and not decided again.

    Raises InvalidInput for an unknown claim or a folder that cannot be written into, and to recheck without Rocq; InvalidData for a cluster
    that cannot be used.
    """
    known = [claim.id for claim in load()]
    for name in claims:
        if name not in known:
            expected = f"expected one of {', '.join(known)}"
            raise InvalidInput(f"--claim: got {shorten(name)}, {expected}; try: faultspace verify --claim {nearest(name)}")
    if out is not None:
        prepare_folder(out)
    if recheck and not _rechecked():
        return NOT_AS_EXPECTED
    with working("deciding the claims") as tell:
        checked = rocq or recheck
        report = verify(claims or None, effort=effort, jobs=jobs, scheduler=scheduler, resume=resume, rocq=checked, on_progress=tell)
    if out is not None:
        count = write_run(report, out, () if claims else specimens())
        say(f"{counted(count, 'certificate')} and verdicts.json are in {quote_path(str(out))}")
    if as_json:
        print_json(with_cards(report))
    else:
        _print(report, pages=bool(claims), verbose=verbose)
    return ANSWERED if report.as_expected else NOT_AS_EXPECTED


def nearest(name: str) -> str:
    """Return the claim of the ledger whose name is most like this one."""
    return difflib.get_close_matches(name, [claim.id for claim in load()], n=1, cutoff=0.0)[0]


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
    """Print what is not as expected, then a sentence for each claim, or the cards of those asked for, with `verbose` all of each claim, and
    always the summary line last."""
    console = answers()
    print_differences(console, report)
    if not pages and not verbose:
        print_sentences(console, report.claims)
    else:
        for claim in report.claims:
            print_card(console, claim)
            if verbose:
                print_page(console, claim, [row for row in report.hypotheses if row.claim == claim.claim.id])
    if report.corpus and verbose:
        paragraph(console, report.corpus, "systems: ")
    if not pages:
        print_rest(console, report)
    elif verbose:
        print_machine(console, report)
    print_summary(console, report)
