"""This is what people read of a scoreboard.

table          Markdown: a row a slug, a column an implementation; passed/asked
findings       Markdown: each implementation's failures, with version, vector, numbers, and the line and the script that show them again
found          which findings these are
write_pages    puts the table between README's two marks and writes FINDINGS.md
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path

from ....base.writing import write_text
from ..records import Demand
from .records import Audited, Board, Tally
from .reproducers import reproducers, write

BEGIN, END = "<!-- scoreboard -->", "<!-- end of scoreboard -->"
HEAD = """# What the audit found

Every failure below is that of a function, called through an adapter of [peers/](peers) as its documentation tells, on data whose
answer is known exactly; made by `python -m faultspace.numeric.audit.scoreboard --out numeric/audit`. A line shows the first vector that
failed; the command under it repeats that. What is wrong in a script rather than in a function, and what needs more words, stands at the
end, written by hand.
"""


def table(board: Board) -> str:
    """Return a row for each slug and function, in the order of our own audit, which offers every function."""
    rows = list(dict.fromkeys((one.slug, one.function) for audited in board.audited for one in audited.tallies))
    names = [audited.name for audited in board.audited]
    lines = ["| check | function | " + " | ".join(names) + " |", "|---" * (2 + len(names)) + "|"]
    for slug, function in rows:
        cells = [_cell(audited, slug, function) for audited in board.audited]
        lines.append(f"| {slug} | {function} | " + " | ".join(cells) + " |")
    totals = [f"{_passed(audited)}/{sum(one.asked for one in _musts(audited))}" for audited in board.audited]
    lines.append("| **passed of all musts** | | " + " | ".join(totals) + " |")
    lines.append("| version | | " + " | ".join(audited.version for audited in board.audited) + " |")
    lines.append("| vectors of version | | " + " | ".join(str(audited.vectors) for audited in board.audited) + " |")
    lines.append("| seconds | | " + " | ".join(f"{audited.seconds:.0f}" for audited in board.audited) + " |")
    return "\n".join(lines)


def _musts(audited: Audited) -> list[Tally]:
    return [one for one in audited.tallies if one.kind != Demand.FREE]


def _passed(audited: Audited) -> int:
    return sum(one.asked - one.failed for one in _musts(audited))


def _cell(audited: Audited, slug: str, function: str) -> str:
    found = next((one for one in audited.tallies if (one.slug, one.function) == (slug, function)), None)
    if found is None:
        return ""
    if found.kind == Demand.FREE:
        return "told"
    return f"**{found.asked - found.failed}/{found.asked}**" if found.failed else f"{found.asked}/{found.asked}"


def findings(board: Board, scripts: Mapping[tuple[str, str], str]) -> str:
    """Return one section for each implementation that fails; `scripts` has the path of the script by implementation and check."""
    parts = [HEAD]
    for audited in board.audited:
        failed = [one for one in audited.tallies if one.failed]
        if not failed:
            continue
        parts.append(
            f"## {audited.name}\n\n{audited.title}; {audited.version}; vectors of version {audited.vectors}. To have it: {audited.needs}.\n"
        )
        for first, *others in _alike(failed):
            count = f"{first.failed} of {first.asked}"
            parts.append(f"- **{first.slug}** of `{first.function}`: {count}. {_words(first)} Effect: {first.effect}.")
            if others:
                parts.append(f"  The same in {', '.join(f'{one.slug} ({one.failed} of {one.asked})' for one in others)}.")
            path = scripts.get((audited.name, _full_name(first)))
            link = f"; without faultspace: [{path.rpartition('/')[2]}]({path})" if path else ""
            parts.append(f"  `faultspace audit --peer {audited.name} --check '{_full_name(first)}'`{link}")
        parts.append("")
    by_hand = files("faultspace.numeric.audit").joinpath("peers/by_hand.md").read_text("utf-8")
    return "\n".join(parts) + "\n" + by_hand


def found(board: Board) -> list[tuple[str, str]]:
    """Return (implementation, full name of the check) of each finding, the first of those that are alike."""
    return [
        (audited.name, _full_name(first))
        for audited in board.audited
        for first, *_ in _alike([one for one in audited.tallies if one.failed])
    ]


def _full_name(one: Tally) -> str:
    return f"{one.slug}[{one.vector}]-{one.function}"


def _alike(failed: Sequence[Tally]) -> list[list[Tally]]:
    """Return failures of one function that begin at the same vector with the same quantity: one error seen in several views."""
    groups: dict[tuple[object, ...], list[Tally]] = {}
    for one in failed:
        key = (one.function, one.vector, one.verdict, one.quantity, one.quantity or one.detail)
        groups.setdefault(key if one.kind != Demand.MUST_REFUSE else (one.slug, one.function), []).append(one)
    return list(groups.values())


def _words(one: Tally) -> str:
    detail = f" {_short(one.detail)}." if one.detail else ""
    if one.got is None:
        return f"{one.verdict}:{detail}"
    return f"{one.verdict}: {one.quantity}: got {one.got}, bound {one.bound}.{detail}"


def _short(text: str) -> str:
    """The text becomes one line of at most 200 characters."""
    line = " ".join(text.split()).rstrip(".")
    return line if len(line) <= 200 else line[:197] + "..."


def write_pages(board: Board, folder: Path) -> None:
    """Write README.md between its marks, where it has them, FINDINGS.md, and a script for each finding."""
    readme = folder / "README.md"
    if readme.exists() and BEGIN in (text := readme.read_text("utf-8")):
        before, _, rest = text.partition(BEGIN)
        _, _, after = rest.partition(END)
        write_text(readme, f"{before}{BEGIN}\n{table(board)}\n{END}{after}")
    scripts = list(reproducers(found(board)))
    write(folder, scripts)
    write_text(folder / "FINDINGS.md", findings(board, {(one.peer, one.check): one.path for one in scripts}))
