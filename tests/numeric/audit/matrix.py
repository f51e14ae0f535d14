"""`python -m tests.numeric.audit.matrix --out FILE [--jobs N]`: every mutant through every check of its functions, as Markdown tables.

matrix     (mutant, slug) -> (failed, asked)
page       one table a function: a row a mutant, a column a slug
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import chdir
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory

from rich.progress import track

from faultspace.numeric.audit.adapter import FUNCTIONS, offered
from faultspace.numeric.audit.checks.catalogue import all_checks
from faultspace.numeric.audit.records import Demand
from faultspace.numeric.audit.running import audit
from tests.numeric.audit.mutants import MUTANTS, Mutant

Counts = Mapping[tuple[str, str], tuple[int, int]]
HEAD = """# Mutants against checks

Our reference with one thing broken, put through the whole audit: how many of a check's vectors fail. Bold is the check that the tests name
for the mutant. Columns where nothing fails are left out. Made by `python -m tests.numeric.audit.matrix --out numeric/audit/MUTANTS.md`.

The counts are those of one machine. At the edge of rounding (`fault-space-other-units`, `fault-dimension-1e6`) a vector more or less fails
on another, and whether square-memory is seen in `time-grows-with-N` depends on the machine's load: no test relies on it.
"""


def counted(place: int) -> dict[tuple[str, str], tuple[int, int]]:
    """The counts are those of one mutant, which has a process of its own: some change what the next one would find."""
    mutant = MUTANTS[place]
    result: dict[tuple[str, str], tuple[int, int]] = {}
    for record in audit(mutant.adapter):
        failed, asked = result.get((mutant.name, record.slug), (0, 0))
        if record.kind != Demand.FREE:
            result[mutant.name, record.slug] = failed + record.failed, asked + 1
    return result


def page(mutants: Sequence[Mutant], counts: Counts) -> str:
    """The page has all tables."""
    parts = [HEAD]
    slugs = list(dict.fromkeys((one.function, one.slug) for one in all_checks()))
    for function in FUNCTIONS:
        rows = [one for one in mutants if function in offered(one.adapter)]
        columns = [slug for of, slug in slugs if of == function and any(counts.get((one.name, slug), (0, 0))[0] for one in rows)]
        parts.append(f"## {function}\n")
        parts.append("| mutant | what is wrong | " + " | ".join(columns) + " |")
        parts.append("|---" * (2 + len(columns)) + "|")
        for one in rows:
            cells = [_cell(counts.get((one.name, slug), (0, 0)), slug in (one.caught_by, *one.also)) for slug in columns]
            parts.append(f"| {one.name} | {one.wrong} | " + " | ".join(cells) + " |")
        parts.append("")
    return "\n".join(parts).rstrip() + "\n"


def _cell(count: tuple[int, int], named: bool) -> str:
    failed, asked = count
    cell = f"{failed}/{asked}" if failed else ""
    return f"**{cell}**" if named else cell


def main() -> None:
    """This writes the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, required=True, metavar="FILE")
    parser.add_argument("--jobs", type=int, default=1, metavar="N")
    options = parser.parse_args()
    out: Path = options.out.resolve()
    counts: dict[tuple[str, str], tuple[int, int]] = {}
    with (
        ProcessPoolExecutor(options.jobs, get_context("spawn"), max_tasks_per_child=1) as pool,
        TemporaryDirectory() as folder,
        chdir(folder),
    ):
        for found in track(pool.map(counted, range(len(MUTANTS))), "mutants", len(MUTANTS)):
            counts |= found
    out.write_text(page(MUTANTS, counts), "utf-8")


if __name__ == "__main__":
    main()
