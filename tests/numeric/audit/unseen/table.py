"""Which check catches each mutant: `python -m tests.numeric.audit.unseen.table [--only GLOB]` asks, and writes `caught_by.json`.

Each mutant is asked in a copy of this process, the check that is known to fail first, then those that compare answers, refusals, manners,
and last those of long records, up to the first that fails. The exit code is 1 where a mutant escapes that RULES.md does not call right.

kept           mutant -> full name of a check that it failed when it was asked last
in_turn        the checks of a mutant's function, in that order
caught         the full name of the first of these checks that a mutant fails within so many seconds, or nothing
still_caught   whether the check that is known to catch a mutant does so now
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import signal
import sys
from collections.abc import Sequence
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

from faultspace.numeric.audit.checks.catalogue import chosen
from faultspace.numeric.audit.records import Check, Demand
from faultspace.numeric.audit.subjects.opening import InProcess
from faultspace.numeric.audit.upstream.exporting import MANNERS
from tests.numeric.audit.unseen.catalogue import ALL, RIGHT
from tests.numeric.audit.unseen.form import Unseen

CAUGHT_BY = Path(__file__).with_name("caught_by.json")
DEAR = ("memory-grows-with-N", "time-grows-with-N", "right-on-long-records")


def kept() -> dict[str, str]:
    """Return what CAUGHT_BY holds."""
    known: dict[str, str] = json.loads(CAUGHT_BY.read_text("utf-8"))
    return known


def in_turn(one: Unseen) -> list[Check]:
    """Return the checks of its function: the one that is known to fail, the others, those that take long."""
    known = kept().get(one.name)

    def place(check: Check) -> tuple[bool, int]:
        """What compares answers names the cause; a refusal, or manners, may be missed for another reason."""
        dear = 3 if check.slug in DEAR else 2 if check.slug in MANNERS else int(check.kind is Demand.MUST_REFUSE)
        return check.full_name != known, dear

    return sorted(chosen({one.function}), key=place)


def _asked(one: Unseen, checks: Sequence[Check], into: Any) -> None:
    """Send the name of the first that fails; the process leads a group, which can be ended with all that it has started."""
    os.setpgid(0, 0)
    subject = InProcess(one.adapter)
    into.send(next((check.full_name for check in checks if subject.perform(check).failed), ""))
    into.close()


def caught(one: Unseen, checks: Sequence[Check], seconds: float) -> str:
    """Return the full name of the first of the checks that a mutant fails; nothing where none does, or where it does not come to an end."""
    ours, theirs = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.get_context("fork").Process(target=_asked, args=(one, checks, theirs))
    process.start()
    theirs.close()
    try:
        return str(ours.recv()) if ours.poll(seconds) else ""
    except EOFError:
        return ""
    finally:
        process.join(5.0)
        if process.is_alive() and process.pid is not None:
            os.killpg(process.pid, signal.SIGKILL)
            process.join()


def still_caught(one: Unseen, seconds: float = 60.0) -> bool:
    """Say whether the check that is known to catch a mutant does so now."""
    return bool(caught(one, in_turn(one)[:1], seconds))


def main(arguments: Sequence[str] | None = None) -> int:
    """Print a line a mutant, write who catches it, and return the exit code."""
    asked = argparse.ArgumentParser(prog="python -m tests.numeric.audit.unseen.table", description="Which check catches each mutant.")
    asked.add_argument("--only", default="*", metavar="GLOB", help="the mutants whose slugs match")
    asked.add_argument("--seconds", type=float, default=600.0, help="for one mutant")
    options = asked.parse_args(arguments)
    selected = [one for one in ALL if fnmatch(one.name, options.only)]
    if not selected:
        asked.error(f"--only {options.only}: there is no such mutant; the first of {len(ALL)} is {ALL[0].name}")
    found = {one.name: caught(one, in_turn(one), options.seconds) for one in selected}
    for name, check in found.items():
        print(f"{name}: {check or RIGHT.get(name) or 'ESCAPES'}")
    known = {**kept(), **{name: check for name, check in found.items() if check}}
    CAUGHT_BY.write_text(json.dumps({one.name: known[one.name] for one in ALL if one.name in known}, indent=1) + "\n", "utf-8")
    return int(any(not check and name not in RIGHT for name, check in found.items()))


if __name__ == "__main__":
    sys.exit(main())
