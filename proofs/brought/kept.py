"""What a search of a large box went through is kept in a file, so that the same command goes on where it was stopped.

    Kept         the file: parts of boxes that were gone through, and in which nothing failed; keeping has it open
    Sharing      how the parts of a large box are shared out: processes, a Dask cluster, and a file that keeps them
    WORTH_SHARING, SYSTEMS_A_PART    from how many systems on a box is cut into parts, and how large these are

A part is named by a digest of everything that it depends on: the questions, the box, the sizes, and which part it is. One in which
something fails is not kept, but gone through again, which takes as long as it took to find it.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...base.kept_lines import KeptLines, keeping_lines

FORMAT = "faultspace-searched/1"
WORTH_SHARING = 10**6
SYSTEMS_A_PART, MOST_PARTS = 2 * 10**7, 64
NUMBERS = ("systems", "looked_at")


@dataclass(frozen=True)
class Sharing:
    """`jobs` processes of this machine, or the workers of the Dask scheduler at `cluster`; `kept` has the parts that are done."""

    jobs: int = 1
    cluster: str | None = None
    kept: Kept | None = None

    def parts(self, count: int) -> int:
        """Return into how many parts so many systems are cut; the answers do not depend on who goes through them."""
        alone = self.jobs == 1 and self.cluster is None and self.kept is None
        return 1 if alone or count < WORTH_SHARING else max(2, min(MOST_PARTS, count // SYSTEMS_A_PART))


class Kept:
    """The parts of a file, by name."""

    def __init__(self, lines: KeptLines) -> None:
        self._lines = lines
        self.parts: dict[str, Mapping[str, Any]] = {str(part["part"]): part for part in lines.lines}

    def note(self, name: str, **numbers: Any) -> None:
        """Write a part to the file at once. Raises InvalidInput where that cannot be."""
        self._lines.note(part=name, **numbers)
        self.parts[name] = self._lines.lines[-1]


@contextmanager
def keeping(path: Path | None) -> Iterator[Kept | None]:
    """Yield the parts of a file, which is made where it is not there, and which no other run has meanwhile; None for no file.

    Raises InvalidInput for a file that is not one of these.
    """
    if path is None:
        yield None
        return
    with keeping_lines(path, FORMAT, _good, "--resume") as lines:
        yield Kept(lines)


def _good(part: Mapping[str, Any]) -> bool:
    counts = [part[name] for name in NUMBERS] + list(part["met"])
    return type(part["whole"]) is bool and all(type(one) is int and one >= 0 for one in counts)


def name_of(*what: Any) -> str:
    """Return the name of a part that depends on all of this."""
    return hashlib.sha256(json.dumps(what, sort_keys=True, default=str).encode()).hexdigest()


def texts(questions: Sequence[Any]) -> list[list[str]] | None:
    """Return what the questions say; None where one is a predicate of Python, which no text tells."""
    nodes = [[*one.hypotheses, one.conclusion] for one in questions]
    if any(node.op == "python" for each in nodes for node in each):
        return None
    return [[node.text for node in each] for each in nodes]
