"""A script for each finding, which shows it without faultspace.

Reproducer     whose finding it is, of which check, where the script stands, its text
reproducers    those of a board
write          into the folder of the pages; scripts of findings that are no more go
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from ....base.errors import InvalidData
from ....base.writing import write_text
from ..adapter import FUNCTIONS
from ..peers import PEERS
from ..upstream.reproducing import script

FOLDER = "reproducers"
ENDINGS = {"Python": "py", "Octave": "m", "Julia": "jl"}


@dataclass(frozen=True)
class Reproducer:
    """`path` is relative to the folder of the pages."""

    peer: str
    check: str
    path: str
    text: str


def reproducers(found: Sequence[tuple[str, str]]) -> Iterator[Reproducer]:
    """Yield one for each (peer, full name of a check) that there is a script of, in the language of the package. A check
    that is no more, as one of a board made by other vectors, has none, nor has one whose costs are measured in another language."""
    known = {one.name: one for one in PEERS}
    for name, check in found:
        if name not in known:
            continue
        language = known[name].language
        try:
            text = script(check, FUNCTIONS, language.lower(), peer=name)
        except InvalidData:
            continue
        file = re.sub(r"[^A-Za-z0-9_]+", "_", check).strip("_")
        yield Reproducer(name, check, f"{FOLDER}/{name}/{file}.{ENDINGS[language]}", text)


def write(folder: Path, scripts: Sequence[Reproducer]) -> None:
    """Write the scripts below the folder, and take away others that stand there."""
    wanted = {folder / one.path for one in scripts}
    for file in sorted((folder / FOLDER).glob("*/*.*")):
        if file not in wanted:
            file.unlink()
    for one in scripts:
        (folder / one.path).parent.mkdir(parents=True, exist_ok=True)
        write_text(folder / one.path, one.text)
