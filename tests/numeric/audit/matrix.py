"""`python -m tests.numeric.audit.matrix --out FILE`: every mutant with the checks that catch it, as Markdown tables.

page        our mutants, and those whose writers had not seen the checks

Nothing is computed: the checks that our mutants fail are named beside them and asked by `test_mutants`; what catches the unseen ones
stands in `unseen/caught_by.json`, which `python -m tests.numeric.audit.unseen.table --first --keep` writes, and is asked by
`unseen/test_caught`.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping
from pathlib import Path

from faultspace.numeric.audit.adapter import FUNCTIONS, offered
from faultspace.numeric.audit.vectors.trouble import VERSION
from tests.numeric.audit.mutants import MUTANTS
from tests.numeric.audit.unseen.catalogue import ALL, RIGHT
from tests.numeric.audit.unseen.table import kept

HEAD = f"""# Mutants and what catches them

Made by `python -m tests.numeric.audit.matrix --out FILE`, with vectors of version {VERSION}.

## Ours

Our reference with one thing broken, and the checks that it must fail: `tests/numeric/audit/test_mutants.py` asks them all. Each kind of
trouble has one more mutant, in `tests/numeric/audit/test_trouble_mutants.py`.
"""
UNSEEN = """## Unseen

Whoever wrote these had not read the vectors or the checks. Beside each stands one check that it fails.
`python -m pytest -m mutants tests/numeric/audit/unseen/test_caught.py` asks each that check again, and all in turn where the mutant
remembers what it was asked before; some are asked daily.
"""


def page(caught_by: Mapping[str, str]) -> str:
    """The page has both tables."""
    return "\n".join([HEAD, *_ours(), UNSEEN, *_unseen(caught_by)]).rstrip() + "\n"


def _ours() -> Iterator[str]:
    yield from ("| mutant | of | what is wrong | fails |", "|---|---|---|---|")
    for one in MUTANTS:
        of = [name for name in FUNCTIONS if name in offered(one.adapter)]
        fails = ", ".join(f"`{slug}`" for slug in (one.caught_by, *one.also))
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
    parser.parse_args().out.write_text(page(kept()), "utf-8")


if __name__ == "__main__":
    main()
