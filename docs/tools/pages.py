"""The pages that a command makes and the tree does not hold: from the paper to the proofs, and the statements with their locks.

PAGES     file name -> the function that makes its text
write     all of them into a folder, which is build/pages for the site
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from faultspace.proofs.rocq.locks import kept
from faultspace.proofs.verdict.ledger import load

from . import paper_to_proof
from .statements import page


def statements() -> str:
    """Return the page of the statements, of the ledger and the locks of the tree."""
    return page(kept(), load())


PAGES: dict[str, Callable[[], str]] = {"paper-to-proof.md": paper_to_proof.page, "statements.md": statements}


def write(folder: Path) -> None:
    """Make every page and write it into the folder, which is made where it is not there."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, made in PAGES.items():
        (folder / name).write_text(made(), "utf-8")
