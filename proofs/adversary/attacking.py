"""What a run of `verify` does with the attacks: shows them beside the verdict, and lets a counterexample that is confirmed now decide.

    Attacking      records run now, or None: those of the package's file, and what was found of them again
    attacking      of an effort: "full" runs every attack on the chosen claims again
    looked_at_again    the same with every record on some targets checked again, by all processes
    of_reading     a reading's result with its attacks
    of_row         a row of the hypothesis table with its attacks

A reading that was CERTIFIED is REFUTED where a counterexample is confirmed. It is in ERROR where what the file tells is not found again,
and where it holds with nothing behind it but cases: neither a locked theorem, compiled on this machine or not, nor an attack on its words.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import TypeVar

from ...base.progress import Progress
from ...base.sheets import counted
from ...base.tasks import ordered, processes
from ..evidence.attacks import Attacked
from ..rocq.locks import kept
from ..verdict.verdicts import Outcome, ReadingResult, Row, Verdict
from .catalogue import WITHOUT, attacks_on, catalogue
from .results import AttackRecord, checked_again, run_attacks, stored

Found = TypeVar("Found", bound=Outcome)

SECONDS = 15.0
COMMAND = "python -m faultspace.proofs.adversary --stale --out proofs/adversary/results.json"


@dataclass(frozen=True)
class Attacking:
    """A run of `verify` rests on these records; None stands for those of the package's file. `again` has, by target, those that were
    checked again; the others are when they are asked for."""

    records: tuple[AttackRecord, ...] | None
    again: Mapping[str, tuple[Attacked, ...]] = field(default_factory=dict)

    def on(self, target: str) -> tuple[Attacked, ...]:
        """Return the records on a target, each checked again."""
        return self.again[target] if target in self.again else checked_again(target, self.records)


def attacking(
    claims: set[str],
    effort: str,
    jobs: int,
    progress: Progress,
    *,
    known: Callable[[str], AttackRecord | None] = lambda name: None,
    on_record: Callable[[AttackRecord], None] = lambda record: None,
) -> Attacking:
    """Return the attacks on these claims, and those on every row where all claims are meant; effort "full" runs them now, but for those of
    which there is a `known` record, and hands over each record as it comes."""
    if effort != "full":
        return Attacking(None)
    chosen = [attack for attack in catalogue() if attack.target.startswith(WITHOUT) or attack.target.partition(".")[0] in claims]

    def report(name: str, done: int, total: int) -> None:
        progress(f"attacking: {name}", done, total)

    records = {attack.id: record for attack in chosen if (record := known(attack.id)) is not None}
    waiting = [attack for attack in chosen if attack.id not in records]
    for record in run_attacks(waiting, seconds=SECONDS, seed=0, jobs=jobs, progress=report):
        on_record(record)
        records[record["attack"]] = record
    return Attacking(tuple(records[attack.id] for attack in chosen))


def looked_at_again(attacks: Attacking, targets: Sequence[str], jobs: int) -> Attacking:
    """Return the same with the records on these targets checked again, by so many processes."""
    records = stored() if attacks.records is None else attacks.records
    tasks = [(target, here) for target in targets if (here := tuple(one for one in records if one["target"] == target))]
    found = ordered(checked_again, tasks, count=processes(jobs))
    return replace(attacks, again={target: again for (target, _), again in zip(tasks, found, strict=True)})


def of_reading(result: ReadingResult, claim: str, attacks: Attacking) -> ReadingResult:
    """Return the result with its attacks; its verdict gives way to a counterexample."""
    target = f"{claim}.{result.reading.id}"
    found = attacks.on(target)
    return replace(result, attacks=found, outcome=_attacked(result.outcome, target, result.reading.theorems, found))


def of_row(row: Row, attacks: Attacking) -> Row:
    """Return the row with its attacks; the verdict of a row without a single hypothesis gives way to a counterexample."""
    if len(row.dropped) != 1:
        return row
    target = f"{WITHOUT}{row.ablation}: {row.dropped[0]}"
    found = attacks.on(target)
    # What is implied by the other hypotheses is met by every case that meets them: there is nothing to attack.
    return _attacked(replace(row, attacks=found), target, row.theorems, found, implied=row.implied is not None)


def _attacked(outcome: Found, target: str, theorems: Sequence[str], found: tuple[Attacked, ...], *, implied: bool = False) -> Found:
    """Return the outcome, or what it gives way to."""
    if outcome.verdict in (Verdict.REFUTED, Verdict.ERROR):
        return outcome
    words = _against(found) or (None if implied else _unfounded(target, theorems, found))
    if words is None:
        return outcome
    verdict = Verdict.REFUTED if any(one.refutes for one in found) else Verdict.ERROR
    return replace(outcome, verdict=verdict, evidence=f"{words}; {outcome.evidence}")


@cache
def _locked() -> frozenset[str]:
    """Return the names of the theorems whose statements are locked."""
    return frozenset(kept().theorems)


def _unfounded(target: str, theorems: Sequence[str], found: tuple[Attacked, ...]) -> str | None:
    """Say that nothing but cases stands behind what holds: no locked theorem, and no attack on its words as they are; None otherwise."""
    proved = theorems and _locked().issuperset(theorems)
    if proved or any(one.trouble is None for one in found):
        return None
    known = len(attacks_on(target))
    way = f"run {COMMAND}" if known else "name a theorem in the ledger, or attack it in proofs/adversary"
    return f"no locked theorem says it, and no attack on its words is on record ({counted(known, 'attack')} known); {way}"


def _against(found: tuple[Attacked, ...]) -> str | None:
    """Say what the attacks hold against the statement: a counterexample, or something stored that was not found again."""
    against = [(one, one.words) for one in found if one.refutes]
    against += [(one, one.trouble) for one in found if one.trouble is not None and not one.stale]
    return next((f"the adversary, {one.id}: {words}" for one, words in against), None)
