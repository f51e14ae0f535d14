"""This keeps what a benchmark has measured, a line a case, so that a run that was stopped goes on where it was.

    Cases      the file: which cases are there, and one more at its end
    interval   of a probability, from so many hits of so many [CP34]

A case has a key, by which its random numbers are drawn, so that it is the same case in every run. The first line of the file has the
SHA-256 of the Python files of the room that was measured: a file that another version has begun is not gone on with.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

import scipy

import faultspace.numeric

FORMAT = "faultspace-cases/1"


def version() -> str:
    """Return the SHA-256 of the Python files of `numeric`, but those of the audit, by their names."""
    room = Path(faultspace.numeric.__file__ or "").parent
    total = hashlib.sha256()
    for path in sorted(room.rglob("*.py")):
        name = path.relative_to(room).as_posix()
        if not name.startswith("audit/"):
            total.update(f"{name}\0".encode() + path.read_bytes())
    return total.hexdigest()


class Cases:
    """These are the cases of a file, by their keys."""

    def __init__(self, path: Path) -> None:
        """Read what is there; a last line that was cut short is left out, and written anew when its case comes."""
        self.path = path
        self.found: dict[str, dict[str, Any]] = {}
        lines = path.read_text(encoding="utf-8").split("\n") if path.exists() else []
        self.head = json.loads(lines[0]) if len(lines) > 1 else {"format": FORMAT, "version": version()}
        if self.head.get("format") != FORMAT:
            raise SystemExit(f"{path}: not a file of cases: name another one")
        for line in lines[1:-1]:
            case = json.loads(line)
            self.found[case["key"]] = case
        self.whole = "".join(f"{line}\n" for line in lines[:-1])

    def begin(self) -> None:
        """Make the file ready for more cases. Raises SystemExit where another version of the code has begun it."""
        if self.head["version"] != version():
            raise SystemExit(f"{self.path}: begun by another version of the code: name another file, or show this one with --table")
        self.path.write_text(self.whole or json.dumps(self.head) + "\n", encoding="utf-8")

    def add(self, key: str, values: dict[str, Any]) -> None:
        """Write a case at the end of the file."""
        self.found[key] = {"key": key, **values}
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(self.found[key]) + "\n")


def interval(hits: int, trials: int) -> tuple[float, float]:
    """Return the interval of 95 % of a probability."""
    low = float(scipy.special.betaincinv(hits, trials - hits + 1, 0.025)) if hits else 0.0
    high = float(scipy.special.betaincinv(hits + 1, trials - hits, 0.975)) if hits < trials else 1.0
    return low, high
