"""`python -m tests.numeric.audit.matrix --out FILE`: every mutant with a check that catches it, as Markdown tables.

caught      mutant -> how many of the checks that the tests name for it fail, of how many
page        our mutants, those of the kinds of trouble, and those whose writers had not seen the checks

A minute of computing: our mutants are asked the checks that are named for them. What catches the unseen ones stands in
`unseen/caught_by.json`, which `python -m tests.numeric.audit.unseen.table --first --keep` writes; every one of these checks is asked by
`unseen/test_caught.py`.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import chdir
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory

from rich.progress import track

from faultspace.numeric.audit.adapter import FUNCTIONS, offered
from faultspace.numeric.audit.running import audit
from faultspace.numeric.audit.vectors.trouble import VERSION
from tests.numeric.audit.mutants import MUTANTS
from tests.numeric.audit.unseen.catalogue import ALL, RIGHT
from tests.numeric.audit.unseen.table import kept

Counts = Mapping[str, Sequence[tuple[str, int, int]]]
HEAD = f"""# Mutants and what catches them

Made by `python -m tests.numeric.audit.matrix --out numeric/audit/MUTANTS.md`, with vectors of version {VERSION}.

## Ours

Our reference with one thing broken: the checks that the tests name for it, and how many of their vectors fail. `python -m pytest
tests/numeric/audit/test_mutants.py` asks them all. Each kind of trouble has one more, in `tests/numeric/audit/test_trouble_mutants.py`.
The counts are those of one machine: at the edge of rounding a vector more or less fails on another.
"""
UNSEEN = """## Unseen

Whoever wrote these had not read the vectors or the checks. Beside each stands one check that it fails, the first that was found.
`python -m pytest -m slow tests/numeric/audit/unseen/test_caught.py` asks each that check again; a twelfth of them is asked daily.
"""


def caught(place: int) -> tuple[str, list[tuple[str, int, int]]]:
    """The counts are those of one mutant, which has a process of its own: some change what the next one would find."""
    one = MUTANTS[place]
    found = []
    for slug in (one.caught_by, *one.also):
        records = audit(one.adapter, only=[slug])
        found.append((slug, len(records.failed), len(records)))
    return one.name, found


def page(counts: Counts, caught_by: Mapping[str, str]) -> str:
    """The page has all tables."""
    return "\n".join([HEAD, *_ours(counts), UNSEEN, *_unseen(caught_by)]).rstrip() + "\n"


def _ours(counts: Counts) -> Iterator[str]:
    yield from ("| mutant | of | what is wrong | fails |", "|---|---|---|---|")
    for one in MUTANTS:
        of = [name for name in FUNCTIONS if name in offered(one.adapter)]
        fails = ", ".join(f"`{slug}` {failed} of {asked}" for slug, failed, asked in counts[one.name])
        yield f"| {one.name} | {of[0] if len(of) == 1 else f'{len(of)} functions'} | {one.wrong} | {fails} |"
    yield ""


def _unseen(caught_by: Mapping[str, str]) -> Iterator[str]:
    yield from ("| mutant | what is wrong | fails |", "|---|---|---|")
    for one in ALL:
        if one.name in RIGHT:
            fails = f"nothing, for it is right by RULES.md: {RIGHT[one.name]}"
        else:
            fails = f"`{caught_by[one.name]}`" if one.name in caught_by else "**nothing: it gets through**"
        yield f"| {one.name} | {one.wrong.replace('|', '&#124;')} | {fails} |"


def main() -> None:
    """This writes the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, required=True, metavar="FILE")
    parser.add_argument("--jobs", type=int, default=1, metavar="N")
    options = parser.parse_args()
    out: Path = options.out.resolve()
    with (
        ProcessPoolExecutor(options.jobs, get_context("spawn"), max_tasks_per_child=1) as pool,
        TemporaryDirectory() as folder,
        chdir(folder),
    ):
        asked = pool.map(caught, range(len(MUTANTS)))
        counts = dict(track(asked, "mutants", len(MUTANTS), disable=not sys.stderr.isatty()))
    out.write_text(page(counts, kept()), "utf-8")


if __name__ == "__main__":
    main()
