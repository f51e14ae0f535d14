"""Implementation against check: what is installed against all checks, as board.json, and the pages that people read of it.

tallies          the results of one audit, summed up by slug and function
audits           the entries of our reference and of these packages;   merged: new entries in place of old ones
Board            board.json: an Audited for each implementation, with a Tally for every slug and function that fails
table, findings  Markdown: a row a function, a column an implementation; each implementation's failures
KEPT             (package, full name of a check): scripts that stand in the tree, one for each cause that is worth telling upstream
path, text       where a script stands, beside the pages, and what is in it, in the language of the package
write_pages, write_scripts    README's table and FINDINGS.md, and the scripts
main             `python -m faultspace.numeric.audit.scoreboard`: audits what is installed and writes all
"""

from __future__ import annotations

import argparse
import json
import re
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, fields
from math import inf
from pathlib import Path
from typing import Any

from ...base.errors import InvalidData
from ...base.progress import Progress, evenly, working
from ...base.writing import write_text
from .adapter import FUNCTIONS
from .peers import PEERS
from .peers import peer as peer_named
from .records import CheckResult, Demand, Status, grouped
from .running import audit
from .upstream.reproducing import script
from .vectors.trouble import VERSION

FORMAT = "faultspace-audit-board/1"


@dataclass(frozen=True)
class Tally:
    """This says of the checks of one slug and function how many were asked, how many failed, and the first that failed (else the worst).

    Infinite numbers are strings.
    """

    slug: str
    function: str
    kind: str
    effect: str
    asked: int
    failed: int
    vector: str
    verdict: str
    quantity: str | None
    got: float | str | None
    bound: float | str | None
    detail: str

    @property
    def name(self) -> str:
        """The full name of the check that is shown."""
        return f"{self.slug}[{self.vector}]-{self.function}"


@dataclass(frozen=True)
class Audited:
    """This is one implementation. `title`: what it is; `seconds`: what the audit took; `vectors`: the version of those that were asked;
    `counts`: function -> (passed, asked) of what must hold; `failed`: the tallies with a failure."""

    name: str
    title: str
    version: str
    needs: str
    seconds: float
    vectors: int
    counts: dict[str, tuple[int, int]]
    failed: tuple[Tally, ...]

    @staticmethod
    def of(name: str, title: str, version: str, needs: str, seconds: float, tallies: Iterable[Tally]) -> Audited:
        """Return the entry of an implementation that was asked the vectors of this version."""
        counts = dict[str, tuple[int, int]]()
        musts = [one for one in tallies if one.kind != Demand.FREE]
        for one in musts:
            passed, asked = counts.get(one.function, (0, 0))
            counts[one.function] = passed + one.asked - one.failed, asked + one.asked
        return Audited(name, title, version, needs, seconds, VERSION, counts, tuple(one for one in musts if one.failed))

    @property
    def total(self) -> tuple[int, int]:
        """How many checks of all functions passed, and how many were asked."""
        return sum(passed for passed, _ in self.counts.values()), sum(asked for _, asked in self.counts.values())


@dataclass(frozen=True)
class Board:
    """The board has all implementations, our own first."""

    audited: tuple[Audited, ...]

    def text(self) -> str:
        """Return the file, with one tally a line."""
        entries = []
        for one in self.audited:
            head = {field.name: getattr(one, field.name) for field in fields(one) if field.name != "failed"}
            rows = ",\n  ".join(json.dumps(asdict(tally)) for tally in one.failed)
            entries.append(f' {json.dumps(head)[:-1]}, "failed": [{rows}]}}')
        return f'{{"format": "{FORMAT}", "audited": [\n' + ",\n".join(entries) + "\n]}\n"

    @staticmethod
    def read(text: str) -> Board:
        """Return the board of a file. Raises InvalidData for another format."""
        data: Any = json.loads(text)
        if not isinstance(data, dict) or data.get("format") != FORMAT:
            raise InvalidData(f"got no board, expected the board.json of the format {FORMAT!r} that the scoreboard writes")
        return Board(tuple(Board._entry(one) for one in data["audited"]))

    @staticmethod
    def _entry(data: dict[str, Any]) -> Audited:
        counts = {name: (passed, asked) for name, (passed, asked) in data["counts"].items()}
        return Audited(**{**data, "counts": counts, "failed": tuple(Tally(**row) for row in data["failed"])})


# -- the pages -----------------------------------------------------------------------------------------------------------------------------

BEGIN, END = "<!-- scoreboard -->", "<!-- end of scoreboard -->"
VARIANTS = {"fault_id-threshold": "fault_id"}  # settings of which that alone is told in which they differ
HEAD = """# What the audit found

Failures of functions of published packages, called through the adapters of [peers/](peers) as their documentation tells, on data whose
answer is known exactly. `python -m faultspace.numeric.audit.scoreboard --out numeric/audit` makes this page, where they are installed.

Beside the name of a check stands how many of its vectors failed, then the first of them, what was off, and the bound.
`faultspace audit --peer NAME --check CHECK` repeats a finding; `--reproduce CHECK`, with `--language octave` or `julia` where the
package is in that, prints a script that shows it without faultspace. For some findings the script is in
[reproducers/](reproducers). What no check can see was [found by hand](peers/by_hand.md).
"""


def table(board: Board) -> str:
    """Return a row for each function, in the order of the adapter."""
    lines = ["| function | " + " | ".join(one.name for one in board.audited) + " |", "|---" * (1 + len(board.audited)) + "|"]
    for function in FUNCTIONS:
        lines.append(f"| {function} | " + " | ".join(_share(one.counts.get(function)) for one in board.audited) + " |")
    lines.append("| **all** | " + " | ".join(_share(one.total) for one in board.audited) + " |")
    lines.append("| version | " + " | ".join(one.version for one in board.audited) + " |")
    lines.append("| vectors of version | " + " | ".join(str(one.vectors) for one in board.audited) + " |")
    return "\n".join(lines)


def _share(count: tuple[int, int] | None) -> str:
    return "" if count is None else "{}/{}".format(*count)


def findings(board: Board) -> str:
    """Return one section for each implementation that fails."""
    known = {one.name: one for one in board.audited}
    parts = [HEAD]
    for audited in board.audited:
        if audited.failed:
            head = f"{audited.title}; {audited.version}; vectors of version {audited.vectors}."
            told = _of(audited, known.get(VARIANTS.get(audited.name, "")))
            parts += [f"## {audited.name}\n", head, *_opening(audited), "", *told, ""]
    return "\n".join(parts).rstrip() + "\n"


def _opening(audited: Audited) -> Iterator[str]:
    scripts = [path(name, check) for name, check in KEPT if name == audited.name]
    if scripts:
        yield "Scripts: " + ", ".join(f"[{one.rpartition('/')[2]}]({one})" for one in scripts) + "."
    if audited.name in VARIANTS:
        yield f"Told is what differs from {VARIANTS[audited.name]}."


def _of(audited: Audited, like: Audited | None) -> Iterator[str]:
    """Yield the failures of an implementation, without those that another one has alike."""
    same = {(one.slug, one.function): (one.failed, one.verdict) for one in like.failed} if like else {}
    told = [one for one in audited.failed if same.get((one.slug, one.function)) != (one.failed, one.verdict)]
    for function in FUNCTIONS:
        mine = [one for one in told if one.function == function]
        for first, *others in _alike([one for one in mine if one.kind != Demand.MUST_REFUSE]):
            also = f" Also {', '.join(map(_counted, others))}." if others else ""
            yield f"- `{function}`: **{_counted(first)}**: {_words(first)}.{also}"
        for verdict, says in ((Status.FAIL, "answers where a refusal is due"), (Status.BROKEN, "breaks where a refusal is due")):
            of = [one for one in mine if one.kind == Demand.MUST_REFUSE and one.verdict == verdict]
            if of:
                yield f"- `{function}` {says}: {', '.join(map(_counted, of))}."


def _counted(one: Tally) -> str:
    return f"{one.slug} {one.failed}/{one.asked}"


def _alike(failed: Sequence[Tally]) -> list[list[Tally]]:
    """Return failures of one function that begin at the same vector with the same quantity: one error seen in several views."""
    groups: dict[tuple[object, ...], list[Tally]] = {}
    for one in failed:
        groups.setdefault((one.vector, one.verdict, one.quantity, one.quantity or one.detail), []).append(one)
    return list(groups.values())


def _words(one: Tally) -> str:
    if one.verdict == Status.FAIL and one.got is not None:
        return f"{one.vector}, {one.quantity} off by {one.got}, bound {one.bound}"
    line = " ".join(one.detail.split()).rstrip(".")
    return f"{one.vector}, {one.verdict}: {line if len(line) <= 90 else line[:87] + '...'}"


def write_pages(board: Board, folder: Path) -> None:
    """Write README.md between its marks, where it has them, and FINDINGS.md."""
    readme = folder / "README.md"
    if readme.exists() and BEGIN in (text := readme.read_text("utf-8")):
        before, _, rest = text.partition(BEGIN)
        _, _, after = rest.partition(END)
        write_text(readme, f"{before}{BEGIN}\n{table(board)}\n{END}{after}")
    write_text(folder / "FINDINGS.md", findings(board))


ENDINGS = {"Python": "py", "Octave": "m", "Julia": "jl"}
KEPT = (
    ("ctrlsys", "exact-recovery[n2-u1-p1]-identify"),
    ("ctrlsys", "refuses-shapes[two-faults]-structure"),
    ("nfoursid", "memory-grows-with-N[N3000-N12000]-identify"),
    ("nfoursid", "other-units[n2-u1-p1]-identify"),
    ("sippy_unipi", "right-on-long-records[N12000]-identify"),
    ("python-control-alone", "finite-zeros[orders-one-and-three]-structure"),
    ("slycot", "normal-rank[six-by-six]-structure"),
    ("octave-control", "refuses-nan-model[two-faults]-structure"),
    ("matrix-pencils", "finite-zeros[zeros-outside]-structure"),
    ("fault_id", "fault-space-1e6[one-fault]-fault_space"),
)


def path(name: str, check: str) -> str:
    """Return the path of the script of a package's check, below the folder of the pages."""
    return f"reproducers/{name}/{re.sub('[^A-Za-z0-9_]+', '_', check).strip('_')}.{ENDINGS[peer_named(name).language]}"


def text(name: str, check: str) -> str:
    """Return the script of a package's check."""
    return script(check, FUNCTIONS, peer_named(name).language.lower(), peer=name)


def write_scripts(folder: Path) -> None:
    """Write the scripts of KEPT below the folder of the pages."""
    for name, check in KEPT:
        file = folder / path(name, check)
        file.parent.mkdir(parents=True, exist_ok=True)
        write_text(file, text(name, check))


# -- the audits ----------------------------------------------------------------------------------------------------------------------------


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


if __name__ == "__main__":
    raise SystemExit(main())
