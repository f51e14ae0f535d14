"""This is what people read of a board.

table          Markdown: a row a function, a column an implementation; passed/asked
findings       Markdown: each implementation's failures, in as many words as they need
write_pages    puts the table between README's two marks and writes FINDINGS.md
KEPT           (package, full name of a check): scripts that stand in the tree, one for each cause that is worth telling upstream
path, text     where a script stands, beside the pages, and what is in it, in the language of the package
write_scripts  all of them into a folder
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from ....base.writing import write_text
from ..adapter import FUNCTIONS
from ..peers import peer
from ..records import Demand, Status
from ..upstream.reproducing import script
from .records import Audited, Board, Tally

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
    scripts = [path(peer, check) for peer, check in KEPT if peer == audited.name]
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
    return f"reproducers/{name}/{re.sub('[^A-Za-z0-9_]+', '_', check).strip('_')}.{ENDINGS[peer(name).language]}"


def text(name: str, check: str) -> str:
    """Return the script of a package's check."""
    return script(check, FUNCTIONS, peer(name).language.lower(), peer=name)


def write_scripts(folder: Path) -> None:
    """Write the scripts of KEPT below the folder of the pages."""
    for name, check in KEPT:
        file = folder / path(name, check)
        file.parent.mkdir(parents=True, exist_ok=True)
        write_text(file, text(name, check))
