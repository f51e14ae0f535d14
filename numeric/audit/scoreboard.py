"""Implementation against check: the audit of our reference and of every published package that is here, written as one JSON file.

    audit_peer    the records of one package; needs it installed
    tallies       the records of one implementation, summed up by slug and function
    merged        new entries in place of old ones
    main          audits and writes scoreboard.json; what is not installed here keeps the entry that it has there

The records of the file are in `scoreboard_records`; `scoreboard_pages` makes README's table and FINDINGS.md of it.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable, Iterable, Sequence
from math import inf
from pathlib import Path
from typing import Any

from ...base.errors import InvalidData
from .peers import PEERS, Peer, peer
from .programs import STANDARD, Limits
from .records import Record, Verdict, grouped
from .running import audit, audit_named
from .scoreboard_pages import write_pages
from .scoreboard_records import Audited, Board, Tally
from .subprocess_adapter import Exec

REFERENCE = "faultspace.numeric.audit.reference"


def audit_peer(
    one: Peer,
    *,
    limits: Limits = STANDARD,
    only: Sequence[str] = (),
    tell: Callable[[str, int, int], None] = lambda name, done, total: None,
) -> tuple[Record, ...]:
    """The records of a published package. Raises InvalidData, with what it needs, where it is not installed."""
    if one.version() is None:
        raise InvalidData(f"{one.name} is not installed here; needed is: {one.needs}")
    if one.adapter is not None:
        return audit_named(one.adapter, limits=limits, only=only, tell=tell)
    with Exec(one.command or (), limits) as program:
        return audit(program, only=only, tell=tell)


def tallies(records: Iterable[Record]) -> tuple[Tally, ...]:
    """One for each slug and function, in the order of the records."""
    result = []
    for group in grouped(record for record in records if record.verdict != Verdict.NOT_OFFERED):
        failed = [record for record in group if record.failed]
        shown = failed[0] if failed else max(group, key=lambda record: record.ratio or 0.0)
        numbers = [None if x is None else (str(x) if abs(x) == inf else float(f"{x:.2g}")) for x in (shown.got, shown.bound)]
        told: Any = (shown.vector, shown.verdict, shown.quantity, *numbers, shown.detail)
        result.append(Tally(shown.slug, shown.function, shown.kind, shown.claim, shown.effect, len(group), len(failed), *told))
    return tuple(result)


def board(names: Sequence[str], limits: Limits, tell: Callable[[str, int, int], None]) -> Board:
    """Our reference and these packages, those that are here."""

    def timed(name: str, title: str, version: str, needs: str, run: Callable[..., tuple[Record, ...]]) -> Audited:
        begun = time.perf_counter()
        records = run(tell=lambda check, done, total: tell(name, done, total))
        return Audited(name, title, version, needs, round(time.perf_counter() - begun, 1), tallies(records))

    result = [timed("faultspace", "our own reference", "this one", "", lambda tell: audit_named(REFERENCE, limits=limits, tell=tell))]
    for one in (peer(name) for name in names):
        version = one.version()
        if version is not None:
            result.append(timed(one.name, one.title, version, one.needs, lambda tell, one=one: audit_peer(one, limits=limits, tell=tell)))
    return Board(tuple(result))


def merged(new: Board, old: Board) -> Board:
    """The new entries in place of old ones of their name; in the order of PEERS, our own first."""
    entries = {one.name: one for one in (*old.audited, *new.audited)}
    order = ["faultspace", *(one.name for one in PEERS)]
    return Board(tuple(entries[name] for name in order if name in entries))


def main(arguments: Sequence[str] | None = None) -> int:
    """Audits, writes scoreboard.json; returns 0."""
    from rich.progress import Progress

    parser = argparse.ArgumentParser(prog="python -m faultspace.numeric.audit.scoreboard", description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="where scoreboard.json, README.md and FINDINGS.md are")
    parser.add_argument("--peer", action="append", metavar="NAME", help="only this package, beside our own; may be repeated")
    parser.add_argument("--timeout", type=float, default=60.0, metavar="SECONDS", help="of one check")
    parser.add_argument("--pages", action="store_true", help="audit nothing: make the pages from scoreboard.json again")
    given = parser.parse_args(arguments)
    file: Path = given.out / "scoreboard.json"
    found = Board.from_json(json.loads(file.read_text("utf-8"))) if file.exists() else Board(())
    if not given.pages:
        with Progress() as progress:
            bars: dict[str, Any] = {}

            def tell(name: str, done: int, total: int) -> None:
                if name not in bars:
                    bars[name] = progress.add_task(name, total=total)
                progress.update(bars[name], completed=done + 1)

            found = merged(board(given.peer or [one.name for one in PEERS], Limits(given.timeout), tell), found)
        given.out.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(found.to_json(), indent=1) + "\n", "utf-8")
    write_pages(found, given.out)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
