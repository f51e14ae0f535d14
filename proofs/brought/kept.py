"""What a search of a large box went through is kept in a file, so that the same command goes on where it was stopped.

    Kept         the file: parts of boxes that were gone through, and in which nothing failed
    Sharing      how the parts of a large box are shared out: processes, a Dask cluster, and a file that keeps them
    WORTH_SHARING, SYSTEMS_A_PART    from how many systems on a box is cut into parts, and how large these are

A part is named by a digest of everything that it depends on: the questions, the box, the sizes, and which part it is. One in which
something fails is not kept, but gone through again, which takes as long as it took to find it. The file is lines of JSON; one that a stop
cut short, which can be the last alone, is left out.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...base.errors import InvalidInput, quote_path

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
    """The parts of a file, which is made where it is not there. Raises InvalidInput for a file that is not one of these."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.parts: dict[str, Mapping[str, Any]] = {}
        try:
            text = path.read_text("utf-8") if path.exists() else ""
            whole = text[: text.rfind("\n") + 1]
            for line in whole.splitlines():
                part = json.loads(line)
                if part["format"] != FORMAT or not _good(part):
                    raise ValueError("it has other lines")
                self.parts[str(part["part"])] = part
            if whole != text:
                path.write_text(whole, "utf-8")
            else:
                path.touch()
        except (OSError, ValueError, KeyError, TypeError) as error:
            reason = error.strerror if isinstance(error, OSError) else "it is no such file"
            raise InvalidInput(
                f"--resume: got {quote_path(str(path))}, expected a file that an earlier run kept its parts in, or a new name ({reason})"
            ) from None

    def note(self, name: str, **numbers: Any) -> None:
        """Write a part to the file at once."""
        line = {"format": FORMAT, "part": name, **numbers}
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(line, sort_keys=True) + "\n")
            file.flush()
            os.fsync(file.fileno())
        self.parts[name] = line


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
