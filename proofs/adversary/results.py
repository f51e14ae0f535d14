"""This is the file of results: what attacked each statement, how near it came, and when; checked again where that is cheap.

    run_attacks    attacks run now, in parallel, as records for the file
    stored         the records of the package's file
    stale          whether an attack has no record, or one of other words
    checked_again  the records on one target as a run of `verify` shows them, each checked again
    write          records into a file
    refuting       whether a record tells of a counterexample

A record keeps the SHA-256 of the statement that it attacked: where the words have changed since, it is said to be out of date and
counts for nothing. Checked again: the quantity at the stored point, the exact decision at the point of a witness with its certificates,
the signs at both ends of a bracket. Floats of another machine may differ in the last digits: values are compared to a hundredth.

What the file tells of a search was done when the file was made: a run says "on record" of it. It looks whether the file has the SHA-256
that it tells, and searches again from their seeds, of which it tells what it did itself: what takes at most AGAIN seconds, and of the
others, where nothing was found, the first AGAIN seconds.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from fractions import Fraction
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

from ...base.progress import Progress
from ...base.tasks import ordered, processes
from ...base.writing import write_text
from ..evidence.attacks import Aim, Attack, Attacked, Trial
from ..trust.structure_certificates import Certificate, sha256
from .catalogue import attacks_on, catalogue, statement_of
from .engine import pursue, value_at
from .following import NOTHING

FORMAT = "faultspace-adversary/1"
FILE = "results.json"
COUNTEREXAMPLE, CHANGE, NONE = "counterexample", "change of sign", "none found"
NOT_AGAIN = "not found again: "
AGAIN = 1.0  # a search on record that took so many seconds of a processor is done again in every run
PATIENCE = 8  # and may take so many times as long, on a busy machine

AttackRecord = dict[str, Any]


def run_attacks(
    attacks: Sequence[Attack], *, seconds: float, seed: int, jobs: int = 1, progress: Progress | None = None
) -> Iterator[AttackRecord]:
    """Every attack runs for at most so many seconds; the records come in order. `progress(id, done, total)` is called after each."""
    places = {attack.id: place for place, attack in enumerate(catalogue())}
    stream = ordered(_run, [(places[attack.id], seconds, seed) for attack in attacks], count=processes(jobs))
    for done, record in enumerate(stream, 1):
        if progress is not None:
            progress(record["attack"], done, len(attacks))
        yield record


def write(records: Sequence[AttackRecord], path: Path) -> None:
    """Write the file, in the order of the catalogue."""
    order = {attack.id: place for place, attack in enumerate(catalogue())}
    kept = sorted((record for record in records if record["attack"] in order), key=lambda record: order[record["attack"]])
    file = {"format": FORMAT, "sha256": _digest_of(kept), "attacks": kept}
    write_text(path, json.dumps(file, indent=1, ensure_ascii=False) + "\n")


@cache
def stored() -> tuple[AttackRecord, ...]:
    """Return the records of the package's file; each has under "whole" whether the file has the SHA-256 that it tells."""
    file = json.loads(resources.files(__package__).joinpath(FILE).read_text(encoding="utf-8"))
    whole = file.get("sha256") == _digest_of(file["attacks"])
    return tuple({**record, "whole": whole} for record in file["attacks"])


def _digest_of(records: Sequence[AttackRecord]) -> str:
    return hashlib.sha256(json.dumps(records, sort_keys=True, ensure_ascii=False).encode()).hexdigest()


def refuting(record: AttackRecord) -> bool:
    """Return whether the record tells of a counterexample, or of a change of sign that proves one."""
    return bool(record["outcome"] != NONE)


def stale(attack: Attack, records: Sequence[AttackRecord]) -> bool:
    """Return whether the records have none of this attack on the statement as it is now."""
    digest = _digest(attack.target)
    return not any(record["attack"] == attack.id and record["statement_sha256"] == digest for record in records)


def checked_again(target: str, records: Sequence[AttackRecord] | None = None) -> tuple[Attacked, ...]:
    """Return the records on a target (None: of the package's file), each checked again."""
    known = {attack.id: attack for attack in attacks_on(target)}
    here = [record for record in (stored() if records is None else records) if record["target"] == target]
    return tuple(_attacked(record, known.get(record["attack"])) for record in here)


def certified(record: AttackRecord) -> AttackRecord:
    """Return the record with words and certificates of its counterexample as they are made now, which is decided again at the stored
    point; the record as it is where it has none, where its attack is gone, or where the point refutes nothing, which `checked_again` then
    says."""
    attack, witness = next((one for one in catalogue() if one.id == record["attack"]), None), record["witness"]
    if attack is None or witness is None:
        return record
    found = attack.decide(tuple(Fraction(x) for x in witness["point"]))
    if found is None:
        return record
    return {**record, "witness": {**witness, "words": found.words, "certificates": _named(found.certificates)}}


def words_of(record: AttackRecord) -> str:
    """Tell a record in a sentence or two."""
    tried = f"{record['starts']} starts, {record['evaluations']} values, {record['decided']} points decided exactly, "
    tried += f"{record['seconds']:.0f} s of one processor, {record['date']}"
    if record["outcome"] == COUNTEREXAMPLE:
        return f"A counterexample was found in {record['family']} ({tried}): {record['witness']['words']}"
    if record["outcome"] == CHANGE:
        return (
            f"A counterexample exists in {record['family']} ({tried}): {record['measured']} has opposite signs at two exact points, "
            f"{' and '.join(str(tuple(point)).replace(chr(39), '') for point in record['bracket'])}, and vanishes between them"
        )
    reach: dict[str, str] = {Aim.NONZERO: "the largest value is", Aim.STRATUM: "exact points of the zero set were decided; least value of"}
    sought = reach.get(record["aim"], "the least value is")
    near = f"{sought} {record['nearest']:.1e} ({record['measured']})"
    if record["aim"] == Aim.STRATUM:
        near = f"decided on the zero set of {record['measured']}"
    return f"No counterexample was found in {record['family']} ({tried}); {near}"


def _run(place: int, seconds: float, seed: int) -> AttackRecord:
    """Run the attack at this place of the catalogue."""
    return _record(pursue(catalogue()[place], seconds=seconds, seed=seed), seed)


def _record(trial: Trial, seed: int) -> AttackRecord:
    attack, witness, bracket = trial.attack, trial.witness, trial.bracket
    return {
        "attack": attack.id,
        "target": attack.target,
        "statement_sha256": _digest(attack.target),
        "family": attack.family.words,
        "aim": str(attack.aim),
        "measured": attack.measured,
        "seed": seed,
        "starts": trial.starts,
        "evaluations": trial.evaluations,
        "decided": trial.decided,
        "seconds": round(trial.seconds, 2),
        "date": datetime.now(UTC).date().isoformat(),
        "nearest": trial.nearest,
        "point": list(trial.point),
        "outcome": _outcome(witness, bracket),
        "witness": None
        if witness is None
        else {
            "words": witness.words,
            "point": [str(x) for x in witness.point],
            "certificates": _named(witness.certificates),
        },
        "bracket": None if bracket is None else [[str(x) for x in point] for point in bracket],
    }


def _outcome(witness: object, bracket: object) -> str:
    return COUNTEREXAMPLE if witness else CHANGE if bracket else NONE


def _named(certificates: Sequence[Certificate]) -> list[dict[str, str]]:
    return [{"kind": c["kind"], "sha256": sha256(c)} for c in certificates]


def _digest(target: str) -> str | None:
    statement = statement_of(target)
    return None if statement is None else hashlib.sha256(statement.encode()).hexdigest()


def _attacked(record: AttackRecord, attack: Attack | None) -> Attacked:
    name = record["attack"]
    if record["outcome"] != _outcome(record["witness"], record["bracket"]):
        return Attacked(name, "its record is not told", False, f"{NOT_AGAIN}its outcome is not that of the points stored")
    words = words_of(record) if "whole" not in record else f"On record: {words_of(record)}"
    if not record.get("whole", True):
        return Attacked(name, words, False, f"{NOT_AGAIN}{FILE} is not the file whose SHA-256 it tells")
    if record["statement_sha256"] != _digest(record["target"]):
        old = "out of date: the statement has changed since, so that the attack must run again"
        return Attacked(name, words, False, old, stale=True)
    if attack is None:
        return Attacked(name, words, False, "out of date: the attack is no longer in the catalogue", stale=True)
    trouble = _again(record, attack)
    trial = None if trouble else _searched_again(record, attack)
    if trial is not None:
        against = trial.witness is not None or trial.bracket is not None
        found = "a counterexample" if against else "no counterexample"
        did = f"the same search now: {trial.evaluations} values, {trial.decided} points decided exactly"
        words += f"; {'the beginning of it now' if _long(record) else did}, {found}"
        trouble = "the search found nothing, and finds something now" if against else None
    return Attacked(name, words, refuting(record) and trouble is None, f"{NOT_AGAIN}{trouble}" if trouble else None)


def _searched_again(record: AttackRecord, attack: Attack) -> Trial | None:
    """Return what a search on record comes to now, from its seed: that it took long is on record, too, so its beginning is done again."""
    if "whole" not in record or refuting(record):
        return None
    return pursue(attack, seconds=AGAIN if _long(record) else PATIENCE * AGAIN, seed=record["seed"])


def _long(record: AttackRecord) -> bool:
    return bool(record["seconds"] > AGAIN)


def _again(record: AttackRecord, attack: Attack) -> str | None:
    """Return what of a record is not found again; None where all of it is."""
    told = {"family": attack.family.words, "aim": attack.aim, "measured": attack.measured}
    if other := [name for name, words in told.items() if record[name] != words]:
        return f"another {other[0]} was stored than the attack has"
    if record["starts"] != attack.starts:
        return f"the attack has {attack.starts} starts, and {record['starts']} were stored"
    if len(record["point"]) != len(attack.family.box):
        return f"the attack has {len(attack.family.box)} parameters, and the stored point {len(record['point'])}"
    value, before = value_at(attack, record["point"]), record["nearest"]
    # Written so that what is no number fails.
    if not abs(value - before) <= 0.01 * max(value, before) and not max(before, value) <= NOTHING:
        return f"the value at the stored point is {value:.3e}, and {before:.3e} was stored"
    if record["witness"] is not None:
        witness = attack.decide(tuple(Fraction(x) for x in record["witness"]["point"]))
        if witness is None:
            return "the stored point is no counterexample"
        if _named(witness.certificates) != record["witness"]["certificates"]:
            return "the certificates of the counterexample are other ones than those stored"
        if witness.words != record["witness"]["words"]:
            return "the counterexample has other words than those stored"
    if record["bracket"] is not None:
        first, second = (tuple(Fraction(x) for x in point) for point in record["bracket"])
        if attack.exact is None or attack.aim != Aim.SIGN:
            return "the attack seeks no change of sign"
        if not all(low <= x <= high for point in (first, second) for x, (low, high) in zip(point, attack.family.box, strict=True)):
            return "a stored point is not in the family"
        if attack.exact(first) * attack.exact(second) >= 0:
            return "the signs at the two stored points agree"
    return None
