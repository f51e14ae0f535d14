"""From a run to the records of a page: its certificates before the checker once more, and all that is computed beside it.

gather   the Records
Sizes    how much is computed; the standard takes some half a minute of one processor
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..base.progress import Progress, silent
from ..numeric.study.studies import STUDIES
from ..proofs.checking import check
from ..proofs.trust.checker import Malformed, Rejected
from .computed.controls import FALSE, controls
from .computed.convergence import LENGTHS, SEEDS, convergence
from .computed.study import RUNS, SYSTEMS, example, study
from .records import Records, Run


@dataclass(frozen=True)
class Sizes:
    """`runs` are records of the example, `study` systems of each of the `plans`, `lengths` and `seeds` records beside the limits,
    `statements` those that are false."""

    runs: int = RUNS
    study: int = SYSTEMS
    plans: tuple[str, ...] = tuple(STUDIES)
    lengths: tuple[int, ...] = LENGTHS
    seeds: int = SEEDS
    statements: int = len(FALSE)


STANDARD = Sizes()


def gather(run: Run, sizes: Sizes = STANDARD, *, on_progress: Progress = silent) -> Records:
    """Return everything that a page is made of; what is random has seeds of its own, so that equal runs give equal records."""
    on_progress("computing the paper's example", 0, 0)
    ours = example(sizes.runs)
    return Records(
        run=run,
        checked=_checked(run.certificates, on_progress),
        example=ours,
        convergence=convergence(sizes.lengths, sizes.seeds, on_progress=on_progress),
        study=study(sizes.study, plans=sizes.plans, on_progress=on_progress),
        controls=controls(run.certificates, sizes.statements, on_progress=on_progress),
    )


def _checked(certificates: Mapping[str, Mapping[str, Any]], on_progress: Progress) -> dict[str, dict[str, Any]]:
    found = {}
    for done, (digest, certificate) in enumerate(certificates.items()):
        on_progress("checking certificates", done, len(certificates))
        try:
            said = check(certificate)
            found[digest] = {"accepted": True, "words": said.statement, "assumes": said.assumes}
        except (Rejected, Malformed) as error:
            found[digest] = {"accepted": False, "words": str(error), "assumes": []}
    return found
