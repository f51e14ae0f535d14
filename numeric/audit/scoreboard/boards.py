"""This sets implementation against check: the audit of our reference and of every published package that is here, written as one JSON file.

    tallies       the results of one audit, summed up by slug and function
    audits        the entries of our reference and of these packages
    merged        new entries in place of old ones
    main          audits and writes board.json; what is not installed here keeps the entry that it has there

The records of the file are in `records`; `pages` makes README's table and FINDINGS.md of it, and the scripts beside them.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterable, Iterator, Sequence
from math import inf
from pathlib import Path
from typing import Any

from ....base.progress import Progress, evenly, working
from ....base.writing import write_text
from ..peers import PEERS
from ..peers import peer as peer_named
from ..records import CheckResult, Status, grouped
from ..running import audit
from .pages import write_pages, write_scripts
from .records import Audited, Board, Tally


def tallies(results: Iterable[CheckResult]) -> tuple[Tally, ...]:
    """There is one for each slug and function, in the order of the results, of what was promised."""
    found = []
    for group in grouped(one for one in results if one.verdict != Status.NOT_OFFERED and not one.not_promised):
        failed = [one for one in group if one.failed]
        worst = failed[0] if failed else max(group, key=lambda one: one.ratio or 0.0)
        numbers = [None if x is None else (str(x) if abs(x) == inf else float(f"{x:.2g}")) for x in (worst.got, worst.bound)]
        said: Any = (worst.vector, worst.verdict, worst.quantity, *numbers, worst.detail)
        found.append(Tally(worst.slug, worst.function, worst.kind, worst.effect, len(group), len(failed), *said))
    return tuple(found)


def audits(names: Sequence[str], seconds: float, on_progress: Progress, *, ours: bool = True) -> Iterator[Audited]:
    """Yield the entry of our reference, and of those of these packages that are here, as it is known; a check may take so many seconds."""

    def audited(name: str, title: str, version: str, needs: str, peer: str | None) -> Audited:
        begun = time.perf_counter()
        found = audit(peer=peer, seconds=seconds, on_progress=lambda check, done, total: on_progress(name, done, total))
        return Audited.of(name, title, version, needs, round(time.perf_counter() - begun, 1), tallies(found))

    if ours:
        yield audited("faultspace", "our own reference", "this one", "", None)
    for one in map(peer_named, names):
        version = one.version()
        if version is not None:
            yield audited(one.name, one.title, version, one.needs, one.name)


def merged(new: Board, old: Board) -> Board:
    """Return the new entries in place of old ones of their name; in the order of PEERS, our own first."""
    entries = {one.name: one for one in (*old.audited, *new.audited)}
    order = ["faultspace", *(one.name for one in PEERS)]
    return Board(tuple(entries[name] for name in order if name in entries))


def main(arguments: Sequence[str] | None = None) -> int:
    """Audit, write board.json and what is made of it, and return 0."""
    parser = argparse.ArgumentParser(prog="python -m faultspace.numeric.audit.scoreboard", description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="where board.json, README.md and FINDINGS.md are")
    parser.add_argument("--peer", action="append", metavar="NAME", help="only this package, beside our own; may be repeated")
    parser.add_argument("--own", action="store_true", help="our own reference alone, no package")
    parser.add_argument("--others", action="store_true", help="packages alone, and not our own reference")
    parser.add_argument("--timeout", type=float, default=60.0, metavar="SECONDS", help="of one check")
    parser.add_argument("--pages", action="store_true", help="audit nothing: make the pages from board.json, and the scripts, again")
    given = parser.parse_args(arguments)
    if given.own and (given.peer or given.others):
        parser.error("--own audits no package, and --peer and --others do")
    file: Path = given.out / "board.json"
    found = Board.read(file.read_text("utf-8")) if file.exists() else Board(())
    if not given.pages:
        names = [] if given.own else given.peer or [one.name for one in PEERS]
        given.out.mkdir(parents=True, exist_ok=True)
        with working("the audit of our own code") as tell:
            for one in audits(names, given.timeout, evenly(tell), ours=not given.others):
                found = merged(Board((one,)), found)
                write_text(file, found.text())  # what is known is kept, whatever comes then
    write_pages(found, given.out)
    write_scripts(given.out)
    return 0
