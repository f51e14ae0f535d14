"""The main job: every claim of the ledger checked, each reading with a verdict computed now.

verify     the report of a run over all claims, or those named
"""

from __future__ import annotations

import os
import time
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from ..base.aside import aside
from ..base.errors import InvalidInput, shorten
from ..base.progress import Progress, silent
from ..base.sheets import counted
from ..base.tasks import shared
from .adversary.attacking import attacking, looked_at_again, of_reading, of_row
from .adversary.catalogue import WITHOUT
from .deciding import Check, Without, decided
from .hypotheses import ablations
from .kept_answers import keeping
from .rocq.build import BrokenTheory, NoRocq, NotProved, believed, found, kept_theory
from .rocq.locks import held
from .rocq.sources import sources
from .rocq.theorems import Theorems
from .rocq.theorems import check as machine_checked
from .verdict.ledger import Claim, load
from .verdict.verdicts import ClaimResult, ReadingResult, Report, Row, Verdict
from .verdict.workbench import Workbench

EFFORTS = ("quick", "full")
TRUSTED = "this trusts Rocq's kernel, MathComp, and files compiled before in your cache, which --recheck compiles anew"


def verify(
    claims: Sequence[str] | str | None = None,
    *,
    effort: str = "quick",
    jobs: int = -1,
    scheduler: str | None = None,
    resume: str | os.PathLike[str] | None = None,
    rocq: bool = False,
    on_progress: Progress | None = None,
) -> Report:
    """Decide every claim of the ledger, or those with the ids `claims`, now: each reading gets a verdict and the evidence it rests on.

    Most claims take seconds, or tens of them on a busy machine, because the systems and certificates that their readings rest on are made
    anew; the one of the example below needs less than a second. The claims are those of [G25].

    Parameters
    ----------
    claims : list of str, or str, optional
        Ids of claims; all claims where there is none.
    effort : {"quick", "full"}
    jobs : int
        A number of processes; -1: one for each core.
    scheduler : str, optional
        The address of a Dask scheduler, whose workers do the work then; they need this package in the same version.
    resume : str or path, optional
        A file in which each answer is kept as it comes, so that the same call goes on where it was stopped; certificates are checked again.
    rocq : bool
        Compile the theorems where they are not compiled yet, which takes minutes, so that Rocq can check them. Without it Rocq checks them
        where an earlier run has compiled them.
    on_progress : callable, optional
        Called as (stage, done, total), also from the thread that waits for Rocq.

    Returns
    -------
    Report
        It has `claims`, `hypotheses`, `as_expected` (whether every verdict is the one that the ledger expects), `certificates()`,
        `summary()` and `plot()`.

    Raises
    ------
    InvalidInput
        For an unknown claim or effort, an empty list, a number of processes that is neither -1 nor positive, and one beside a scheduler,
        and for a file that is not one of these.
    InvalidData
        For a cluster that cannot be used or is lost.

    Examples
    --------
    >>> import faultspace as fs
    >>> report = fs.verify(["example-v"], jobs=1)
    >>> print(report.title)
    1 claim decided: every verdict is the expected one
    >>> "window ranks [2, 4, 5, 6, 7, 8] for s = 1..6, left minimal indices [2]" in report.claims[0].readings[0].outcome.evidence
    True
    """
    if effort not in EFFORTS:
        raise InvalidInput(f"effort: got {shorten(effort)}, expected one of {', '.join(EFFORTS)}")
    if type(jobs) is not int or (jobs != -1 and jobs < 1):
        raise InvalidInput(f"jobs: got {shorten(jobs)}, expected an integer >= 1, or -1 for one process a core")
    if scheduler is not None and jobs != -1:
        raise InvalidInput(f"jobs: got {jobs} and a scheduler, expected one of them: the cluster decides how many work")
    ledger = {claim.id: claim for claim in load()}
    if isinstance(claims, str):
        claims = [claims]
    if claims is not None and (not isinstance(claims, Collection) or not claims):
        raise InvalidInput(f"claims: got {shorten(claims)}, expected a list of one id or more, or None for all claims")
    unknown = [name for name in claims or () if not isinstance(name, str) or name not in ledger]
    if unknown:
        raise InvalidInput(f"claim: got {shorten(unknown[0])}, expected one of {', '.join(ledger)}")
    chosen = [claim for claim in ledger.values() if claims is None or claim.id in claims]
    report = on_progress or (silent)
    started = time.perf_counter()
    bench = Workbench(effort, jobs, report)
    total = sum(len(claim.readings) for claim in chosen)
    experiments = [one for one in ablations() if one.claim in {claim.id for claim in chosen}]
    checks = dict.fromkeys(Check(reading.check) for claim in chosen for reading in claim.readings)  # several readings come down to one
    with shared(scheduler), keeping(None if resume is None else Path(resume), effort) as kept:
        if kept.count:
            report(f"{counted(kept.count, 'answer')} of an earlier run", 0, total)
        machine_part = aside(partial(_theorems, rocq=rocq), chosen, report)  # coqc is a process of its own, which works beside this one
        attacks = attacking({claim.id for claim in chosen}, effort, jobs, report, known=kept.attack, on_record=kept.note_attack)
        targets = [f"{claim.id}.{reading.id}" for claim in chosen for reading in claim.readings]
        targets += [f"{WITHOUT}{one.name}: {hypothesis}" for one in experiments for hypothesis in one.hypotheses]
        attacks = looked_at_again(attacks, targets, jobs)
        tasks: list[Check | Without] = [*checks, *(Without(one.name) for one in experiments)]
        answers = decided(bench, tasks, elsewhere=scheduler is not None, kept=kept)
        machine = machine_part.result()
    results: list[ClaimResult] = []
    for claim in chosen:
        readings = []
        for reading in claim.readings:
            report(f"{claim.id}: {reading.id}", len(results), len(chosen))
            check = Check(reading.check)
            seconds = answers[check].seconds if check in checks else 0.0  # of the first reading that comes down to it
            checks.pop(check, None)
            result = ReadingResult(reading, answers[check].found, seconds)
            readings.append(of_reading(_with_theorems(result, machine), claim.id, attacks))
        results.append(ClaimResult(claim, tuple(readings)))
    dropped = [row for one in experiments for row in answers[Without(one.name)].found]
    rows = tuple(of_row(_row_with_theorems(row, machine), attacks) for row in dropped)
    report("done", total, total)
    return Report(effort, tuple(results), rows, kept.corpus, time.perf_counter() - started, machine.message, machine.believed)


@dataclass(frozen=True)
class _Machine:
    """Rocq's part in a run: the theorems that it checked, or why it failed (None: it is not here), a message about it, and the locks of
    the theorems, which hold without it too. `believed`: by which programs and files it was checked. `locked`: whether statements and
    readings are those that were read.
    """

    theorems: Theorems | None
    failure: str | None
    message: str
    locks: Mapping[str, str] = field(default_factory=dict)
    believed: Mapping[str, str | None] | None = None
    locked: bool = True


def _theorems(claims: Sequence[Claim], report: Progress, *, rocq: bool = False) -> _Machine:
    """Return the theorems that these claims name."""
    names = {name for claim in claims for reading in claim.readings for name in reading.theorems}
    ids = {claim.id for claim in claims}
    names |= {name for one in ablations() if one.claim in ids and one.proof is not None for name in one.proof.theorems}
    try:
        held(sources())
    except NotProved as error:
        return _Machine(None, f"Rocq: {error}", f"failed: {error}", believed=_believed(), locked=False)
    if not names:
        return _Machine(None, None, "no theorem is named by these claims")
    try:
        if not rocq and found() is not None and kept_theory(sources()) is None:
            raise NoRocq("the theorems are not compiled here; --rocq compiles them, in minutes, and has Rocq check them")
        theorems = machine_checked(names, report)
    except NoRocq as error:
        message = f"{error}. Without it, readings that have a proof in proofs/theory rest on their certificates"
        return _Machine(None, None, message, {name: lock.sha256 for name, lock in held(sources()).theorems.items()})
    except (BrokenTheory, NotProved) as error:
        return _Machine(None, f"Rocq: {error}", f"failed: {error}", believed=_believed())
    message = (
        f"Rocq {theorems.version}: {counted(len(theorems.statements), 'theorem')}, all as "
        f"locked and closed under the global context; {TRUSTED}"
    )
    return _Machine(theorems, None, message, theorems.locks, _believed())


def _believed() -> Mapping[str, str | None] | None:
    try:
        return believed()
    except NoRocq:
        return None


def _with_theorems(result: ReadingResult, machine: _Machine) -> ReadingResult:
    """The verdict becomes PROVED where the theorems were checked and nothing else spoke against it."""
    names, outcome = result.reading.theorems, result.outcome
    if outcome.verdict == Verdict.ERROR or (machine.locked and not names):
        return result
    if machine.failure is not None:
        return replace(result, outcome=replace(outcome, verdict=Verdict.ERROR, evidence=machine.failure))
    locks = {name: machine.locks[name] for name in names if name in machine.locks}
    if machine.theorems is None:
        return replace(result, locks=locks)
    if (outcome.verdict == Verdict.REFUTED) != (result.reading.expected == Verdict.REFUTED):
        words = f"Rocq has proved {', '.join(names)}, and yet the systems say {outcome.verdict}: {outcome.evidence}"
        return replace(result, outcome=replace(outcome, verdict=Verdict.ERROR, evidence=words))
    words = f"Rocq, without axioms: {', '.join(names)}; and {outcome.evidence}"
    verdict = outcome.verdict if outcome.verdict == Verdict.REFUTED else Verdict.PROVED
    return replace(result, outcome=replace(outcome, verdict=verdict, evidence=words), machine_checked=True, locks=locks)


def _row_with_theorems(row: Row, machine: _Machine) -> Row:
    """The verdict becomes PROVED where theorems that do without what is dropped were checked, and no subject spoke against it."""
    if not row.theorems or row.verdict != Verdict.CERTIFIED:
        return row
    if machine.failure is not None:
        return replace(row, verdict=Verdict.ERROR, evidence=machine.failure)
    if machine.theorems is None:
        return row
    words = f"Rocq, without axioms: {', '.join(row.theorems)}; and {row.evidence}"
    return replace(row, verdict=Verdict.PROVED, evidence=words, machine_checked=True)
