"""What the audit says of each mutant: the slugs that fail, or that it escapes.

    python -m tests.numeric.audit.unseen.table [--only GLOB] [--json FILE] [--seconds N] [--check-seconds N] [--first [--keep]]

Each mutant is audited in processes of its own: as an adapter given by name, each check within `--check-seconds`, all of them within
`--seconds`. With `--first` it is asked in a copy of this process, as an object is, up to the first check that it fails; one that
fails none there, or does not come to an end, is audited whole as without. The check that is known to fail (`caught_by.json`, which
`--keep` writes) is asked first, then those that compare answers, refusals, manners, and last those of long records. FILE is written
after each mutant, and what stands in it already is not asked again, so that a run can be stopped and taken up. The exit code is 1 where a
mutant escapes that RULES.md does not call right.

outcome     the slugs that fail, by how many checks, and one of the details; or what went wrong
first_of    the first check that fails alone
in_turn     the checks of a mutant's function, in the order in which they are asked for the first that fails
still_caught    whether the check that is known to catch a mutant does so now; of one that remembers, whether another does in turn
kept        mutant -> full name of a check that it failed when it was asked last
escapes     names of those that no check catches
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import signal
import sys
import time
from collections import Counter
from collections.abc import Callable, Sequence
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

from faultspace.numeric.audit.checks.catalogue import chosen
from faultspace.numeric.audit.records import Check, CheckResult, Demand
from faultspace.numeric.audit.running import audit
from faultspace.numeric.audit.subjects.opening import InProcess
from faultspace.numeric.audit.upstream.recipes import MANNERS
from tests.numeric.audit.unseen.catalogue import ALL, BY_NAME, RIGHT
from tests.numeric.audit.unseen.form import Unseen

CAUGHT_BY = Path(__file__).with_name("caught_by.json")
DEAR = ("memory-grows-with-N", "time-grows-with-N", "right-on-long-records")
SHOWN = 4  # slugs of one mutant in a line


def kept() -> dict[str, str]:
    """Return what CAUGHT_BY holds."""
    known: dict[str, str] = json.loads(CAUGHT_BY.read_text("utf-8")) if CAUGHT_BY.exists() else {}
    return known


def in_turn(name: str) -> list[Check]:
    """Return the checks of the function of that mutant: the one that is known to fail, the others, those that take long."""
    known = kept().get(name)

    def place(one: Check) -> tuple[bool, int]:
        """What compares answers names the cause; a refusal, or manners, may be missed for another reason."""
        return one.full_name != known, 3 if one.slug in DEAR else 2 if one.slug in MANNERS else int(one.kind is Demand.MUST_REFUSE)

    return sorted(chosen({BY_NAME[name].function}), key=place)


def _told(one: CheckResult) -> tuple[str, str, str, str]:
    return one.full_name, one.slug, str(one.verdict), one.detail


def _audited(name: str, check_seconds: float, into: Any) -> None:
    """Audit one mutant and send what fails; the process leads a group, which can be ended with all that it has started."""
    os.setpgid(0, 0)
    found = audit(f"tests.numeric.audit.unseen.catalogue:adapters.{name}", seconds=check_seconds)
    failed = [_told(one) for one in found.failed]
    into.send((len(found), failed))
    into.close()


def _up_to_the_first(name: str, _: float, into: Any) -> None:
    """Ask one mutant in this process until a check fails, and send that."""
    os.setpgid(0, 0)
    subject = InProcess(BY_NAME[name].adapter)
    results = []
    for check in in_turn(name):
        results.append(subject.perform(check))
        if results[-1].failed:
            break
    into.send((len(results), [_told(one) for one in results[-1:] if one.failed]))
    into.close()


def first_of(one: Unseen, seconds: float, check_seconds: float) -> dict[str, Any]:
    """Return the first check that a mutant fails in a copy of this process; where there is none, or no end, what the whole audit says."""
    found = _asked(_up_to_the_first, one, seconds, check_seconds)
    return found if found.get("failed") else outcome(one, seconds, check_seconds)


def _the_known(name: str, _: float, into: Any) -> None:
    """Ask one mutant in this process the check that is known to catch it."""
    os.setpgid(0, 0)
    result = InProcess(BY_NAME[name].adapter).perform(in_turn(name)[0])
    into.send((1, [_told(result)] if result.failed else []))
    into.close()


def _the_known_apart(name: str, check_seconds: float, into: Any) -> None:
    """Ask the same of a process of its own, which is ended where no answer comes, and whose growth is seen."""
    os.setpgid(0, 0)
    found = audit(f"tests.numeric.audit.unseen.catalogue:adapters.{name}", only=[kept()[name]], seconds=check_seconds)
    into.send((len(found), [_told(one) for one in found.failed]))
    into.close()


def still_caught(one: Unseen, seconds: float = 300.0, check_seconds: float = 30.0) -> bool:
    """Say whether the check that is known to catch a mutant does so now; or, of one that remembers what it was asked before, whether one
    does that comes after others."""
    ways = ((_the_known, 20.0), (_the_known_apart, seconds))
    alone = any(_asked(way, one, limit, check_seconds).get("failed") for way, limit in ways)
    return alone or (one.remembers and bool(first_of(one, seconds, check_seconds).get("failed")))


def outcome(one: Unseen, seconds: float, check_seconds: float) -> dict[str, Any]:
    """Return what the audit says of a mutant within so many seconds."""
    return _asked(_audited, one, seconds, check_seconds)


def _asked(way: Callable[[str, float, Any], None], one: Unseen, seconds: float, check_seconds: float) -> dict[str, Any]:
    ours, theirs = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.get_context("fork").Process(target=way, args=(one.name, check_seconds, theirs))
    begun = time.perf_counter()
    process.start()
    theirs.close()
    told: dict[str, Any] = {"function": one.function, "wrong": one.wrong, "where": one.where}
    try:
        if not ours.poll(seconds):
            return told | {"ended": f"no end within {seconds:g} s"}
        checks, failed = ours.recv()
    except EOFError:
        return told | {"ended": "the audit itself ended without an answer"}
    finally:
        if process.is_alive():
            process.join(5.0)
        if process.is_alive() and process.pid is not None:
            os.killpg(process.pid, signal.SIGKILL)
        process.join()
        told["seconds"] = round(time.perf_counter() - begun, 1)
    slugs = Counter(slug for _, slug, _, _ in failed)
    first = {"name": failed[0][0], "verdict": failed[0][2], "detail": failed[0][3]} if failed else None
    return told | {"checks": checks, "failed": len(failed), "slugs": dict(slugs.most_common()), "first": first}


def escapes(found: dict[str, dict[str, Any]]) -> list[str]:
    """Return the slugs of the mutants that pass every check, and that RULES.md does not call right."""
    return [name for name, one in found.items() if "ended" not in one and not one["failed"] and name not in RIGHT]


def _line(name: str, one: dict[str, Any]) -> str:
    if "ended" in one:
        return str(one["ended"])
    if not one["failed"]:
        return f"ESCAPES {one['checks']} checks" + (f": right, for {RIGHT[name]}" if name in RIGHT else "")
    slugs = list(one["slugs"])
    more = f", and {len(slugs) - SHOWN} more" if len(slugs) > SHOWN else ""
    return f"{one['failed']} of {one['checks']}: {', '.join(slugs[:SHOWN])}{more}"


def _write(file: Path | None, found: dict[str, dict[str, Any]]) -> None:
    if file is None:
        return
    part = file.with_name(file.name + ".part")
    part.write_text(json.dumps(found, indent=1) + "\n", "utf-8")
    part.replace(file)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print a line a mutant, then who escapes; return the exit code."""
    asked = argparse.ArgumentParser(
        prog="python -m tests.numeric.audit.unseen.table", description="What the audit says of each unseen mutant."
    )
    asked.add_argument("--only", default="*", metavar="GLOB", help="the mutants whose slugs match")
    asked.add_argument("--json", type=Path, metavar="FILE", help="where the results go, and where those that are known come from")
    asked.add_argument("--seconds", type=float, default=600.0, help="for one mutant in all")
    asked.add_argument("--check-seconds", type=float, default=30.0, help="for one check of it")
    asked.add_argument("--first", action="store_true", help="stop at the first check that a mutant fails")
    asked.add_argument("--keep", action="store_true", help=f"write the checks that fail to {CAUGHT_BY.name}")
    options = asked.parse_args(arguments)
    way = first_of if options.first else outcome
    chosen = [one for one in ALL if fnmatch(one.name, options.only)]
    if not chosen:
        asked.error(f"--only {options.only}: there is no such mutant; the first of {len(ALL)} is {ALL[0].name}")
    known = json.loads(options.json.read_text("utf-8")) if options.json and options.json.exists() else {}
    for number, one in enumerate(chosen, 1):
        if one.name not in known:
            known[one.name] = way(one, options.seconds, options.check_seconds)
            _write(options.json, known)
        print(f"[{number}/{len(chosen)}] {one.name}: {_line(one.name, known[one.name])}", flush=True)
    asked_for = {one.name: known[one.name] for one in chosen}
    if options.keep:
        caught_by = kept() | {name: one["first"]["name"] for name, one in asked_for.items() if one.get("first")}
        caught_by = {one.name: caught_by[one.name] for one in ALL if one.name in caught_by}
        CAUGHT_BY.write_text(json.dumps(caught_by, indent=1) + "\n", "utf-8")
    left = escapes(asked_for)
    ended = [name for name, one in asked_for.items() if "ended" in one]
    right = sum(not one.get("failed") and "ended" not in one for one in asked_for.values()) - len(left)
    caught = len(chosen) - len(left) - len(ended) - right
    print(f"{len(chosen)} mutants: {caught} caught, {len(left)} escape, {right} right by RULES.md, {len(ended)} did not end")
    for name in left:
        print(f"  {name}: {asked_for[name]['wrong']}")
    return int(bool(left or ended))


if __name__ == "__main__":
    sys.exit(main())
