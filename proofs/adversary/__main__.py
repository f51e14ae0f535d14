"""`python -m faultspace.proofs.adversary`: runs the attacks and says how they ended; with --out, writes the file of results.

Exit code 0: every attack ended as the ledger expects of its target; 1: one did not, or was not found to refute what is false.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path

from .catalogue import catalogue, expected_of
from .results import AttackRecord, certified, refuting, run_attacks, stale, words_of, write


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the attacks that the arguments choose, print how each ended, and return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m faultspace.proofs.adversary", description="Attacks on what is not proved in general.")
    parser.add_argument("--reading", metavar="ID", action="append", help="only attacks on this target, as claim.reading; may be repeated")
    parser.add_argument("--stale", action="store_true", help="only attacks that the file of --out has no record of, or one of other words")
    parser.add_argument("--seconds", type=float, default=15.0, help="the most that one attack may take of one processor (15)")
    parser.add_argument("--seed", type=int, default=0, help="of the starts (0)")
    parser.add_argument("--jobs", type=int, default=1, help="how many attacks run at a time (1)")
    parser.add_argument("--out", type=Path, metavar="FILE", help="a file of results: attacks that do not run now keep their records in it")
    parser.add_argument(
        "--certify",
        action="store_true",
        help="no attack: counterexamples of the file of --out are decided again, with certificates made anew",
    )
    given = parser.parse_args(arguments)
    if given.certify:
        if given.out is None or not given.out.exists():
            parser.error("--certify: needs --out FILE, a file of results that is there")
        before = _kept(given.out, set())
        after = [certified(record) for record in before]
        write(after, given.out)
        print(f"{sum(new != old for new, old in zip(after, before, strict=True))} of {len(before)} records have other certificates now")
        return 0
    targets = sorted({attack.target for attack in catalogue()})
    for name in given.reading or ():
        if name not in targets:
            parser.error(f"--reading: got {name!r}, expected one of {', '.join(targets)}")
    chosen = [attack for attack in catalogue() if given.reading is None or attack.target in given.reading]
    if given.stale:
        before = [] if given.out is None else _kept(given.out, set())
        chosen = [attack for attack in chosen if stale(attack, before)]
    records: list[AttackRecord] = []
    for record in run_attacks(chosen, seconds=given.seconds, seed=given.seed, jobs=given.jobs, progress=_progress):
        records.append(record)
        print(f"{record['attack']}\n  {words_of(record)}", flush=True)
        if given.out is not None:  # at once: a run that is stopped keeps what it has found
            write([*_kept(given.out, {one["attack"] for one in records}), *records], given.out)
    return _exit_code(records)


def _progress(name: str, done: int, total: int) -> None:
    print(f"{done}/{total} {name}", file=sys.stderr)


def _kept(path: Path, again: set[str]) -> list[AttackRecord]:
    """Return the records of the file that did not run now."""
    if not path.exists():
        return []
    return [record for record in json.loads(path.read_text(encoding="utf-8"))["attacks"] if record["attack"] not in again]


def _exit_code(records: Sequence[AttackRecord]) -> int:
    """Return 0 where what is false, by the ledger, is refuted by one of its attacks, and what stands by none; else 1."""
    surprises = []
    for target in dict.fromkeys(record["target"] for record in records):
        found = any(refuting(record) for record in records if record["target"] == target)
        expected = expected_of(target)
        if expected is not None and found != (expected == "REFUTED"):
            what = "a counterexample" if found else "no counterexample"
            surprises.append(f"{target}: the ledger expects {expected}, and {what} was found")
    for line in surprises:
        print(f"NOT as expected: {line}")
    return 1 if surprises else 0


if __name__ == "__main__":
    sys.exit(main())
