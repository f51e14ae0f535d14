"""Where the verdicts of a run come from: what somebody needs who wants to repeat it, or to know what was trusted.

Origin     when the run ended, the commit of the tree, the digests of the checkers, the command that repeats it
origin     that of a report of this process
checkers   the files of the checker, each with its SHA-256 and its number of lines
"""

from __future__ import annotations

import hashlib
import subprocess
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from importlib import resources
from pathlib import Path
from typing import Any

from .ledger import load
from .verdicts import Report

CHECKERS = ("checker.py", "checker_fields.py", "checker_structure.py", "checker_limits.py")
PATIENCE = 20  # seconds that git may take, which needs less than one


@dataclass(frozen=True)
class Origin:
    """`time` is in UTC; `commit` is None where the package lies in no clone, and `changed` says whether files of the clone differ from it.
    `checkers` has the name, the SHA-256 and the lines of each file of the checker; `command` repeats the run."""

    time: str
    commit: str | None
    changed: bool
    checkers: tuple[dict[str, Any], ...]
    command: str

    def to_json(self) -> dict[str, Any]:
        """Return the object that origin.json holds."""
        return asdict(self) | {"checkers": list(self.checkers)}


def origin(report: Report) -> Origin:
    """Return the origin of a report that was made by this process just now."""
    commit, changed = _commit()
    names = [one.claim.id for one in report.claims]
    some = "" if names == [claim.id for claim in load()] else "".join(f" --claim {name}" for name in names)
    command = f"faultspace verify --effort {report.effort}{some}"
    return Origin(datetime.now(UTC).isoformat(timespec="seconds"), commit, changed, checkers(), command)


def checkers() -> tuple[dict[str, Any], ...]:
    """Return the name, the SHA-256 and the number of lines of each file of the checker, in the order in which they are read."""
    folder = resources.files("faultspace.proofs.trust")
    found = [(name, folder.joinpath(name).read_bytes()) for name in CHECKERS]
    return tuple({"file": name, "sha256": hashlib.sha256(data).hexdigest(), "lines": data.count(b"\n")} for name, data in found)


def _commit() -> tuple[str | None, bool]:
    """Return the commit of the clone that this file lies in, and whether its files differ from that; None where git knows of none."""
    root = Path(__file__).resolve().parents[2]
    if not (root / ".git").exists():  # a package that lies within somebody else's clone is not of it
        return None, False
    try:
        commit = _git(root, "rev-parse", "HEAD")
        return commit, bool(_git(root, "status", "--porcelain", "--untracked-files=no"))
    except (OSError, subprocess.SubprocessError):
        return None, False


def _git(root: Path, *arguments: str) -> str:
    done = subprocess.run(["git", "-C", str(root), *arguments], capture_output=True, text=True, timeout=PATIENCE, check=True)
    return done.stdout.strip()
