"""The cases of a study that is under way stand in a file of its folder: whatever stops it, what was done is not done again.

keeping    the context in which a run has the folder for itself, and its Kept
Kept       the cases so far, by plan and index; `add` appends more, `finish` removes the file
Settings   what the cases depend on beside plan and index
UNFINISHED the name of the file: a line of JSON that tells the settings, then one for each case
TEMPORARY  so begin the names of files and folders that a run makes for a moment, which the next one removes

A stack of cases is appended at once, and a line that lacks its end, because the run was killed while it wrote, does not count. A case is
read back to the last bit. Cases that failed stand there too, but are tried again. What the operating system has been handed survives the
death of our process, but not a loss of power.
"""

from __future__ import annotations

import json
import os
import platform
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from filelock import Timeout

from ...base.errors import InvalidInput, in_file, quote_path, shorten
from ...base.kept_lines import append, cut, lock_of
from ...base.regular_files import open_own
from ...base.sheets import counted
from ...base.writing import reason, write_text
from .study_cases import Case, Errors, Estimate, Failed

UNFINISHED, TEMPORARY = "unfinished-cases.jsonl", ".unfinished-monte-carlo"
LONGEST = 1 << 22  # bytes of a line
LOCK = ".faultspace-lock"
FORMAT = "faultspace-unfinished-study/1"


@dataclass(frozen=True)
class Settings:
    """The seed of the study and the samples of a record; `made_by` has what else may show in the last digits, by name."""

    seed: int
    samples: int
    made_by: dict[str, str] = field(default_factory=lambda: made_by())


def made_by() -> dict[str, str]:
    """Return the versions of the libraries and the kind of processor, by name."""
    return {"numpy": np.__version__, "scipy": scipy.__version__, "machine": platform.machine()}


class Kept:
    """The cases so far are `cases[plan][index]`; there is a file of them from the first `add` on."""

    def __init__(self, path: Path, settings: Settings, cases: dict[str, dict[int, Case]]) -> None:
        self.path, self.cases = path, cases
        self._settings = settings

    @property
    def count(self) -> int:
        """Return how many cases there are."""
        return sum(map(len, self.cases.values()))

    @property
    def hint(self) -> str:
        """Return what a stopped run says of the cases; empty where there are none."""
        if not self.count:
            return ""
        are = "stays" if self.count == 1 else "stay"
        return f"{counted(self.count, 'case')} {are} in {quote_path(str(self.path))}, and the same command with --resume goes on"

    def add(self, plan: str, cases: Sequence[Case | Failed]) -> None:
        """Append these cases to the file, all of them or none. Raises InvalidInput where that cannot be."""
        lines = "".join(json.dumps({"plan": plan, ("case" if isinstance(one, Case) else "failed"): asdict(one)}) + "\n" for one in cases)
        if not os.path.lexists(self.path):  # there is never a file without its first line
            write_text(self.path, json.dumps({"format": FORMAT} | asdict(self._settings)) + "\n")
        append(self.path, lines.encode())
        self.cases.setdefault(plan, {}).update((one.index, one) for one in cases if isinstance(one, Case))

    def finish(self) -> None:
        """Remove the file: the cases stand elsewhere now."""
        self.path.unlink(missing_ok=True)


@contextmanager
def keeping(folder: Path, settings: Settings, *, resume: bool) -> Iterator[Kept]:
    """Lock the folder against other runs, remove what a dead one left half done, and yield the Kept, which with `resume` has the cases of
    an unfinished run; where there is none, none.

    Raises InvalidInput where another run has the folder; without `resume` where an unfinished run has cases there, and with it where these
    have other settings; and where a file of that name is not ours or cannot be read.
    """
    name = quote_path(str(folder))
    try:
        lock = lock_of(folder / LOCK)
        lock.acquire()
    except Timeout:
        raise InvalidInput(f"{name}: another run works in this folder; wait for its end, or name another one") from None
    except OSError as error:
        raise InvalidInput(
            f"{quote_path(str(folder))}: cannot be locked ({reason(error)}), expected a folder that can be written into"
        ) from None
    try:
        path = folder / UNFINISHED
        kept = Kept(path, settings, _read(path, settings) if os.path.lexists(path) else {})
        if kept.count and not resume:
            raise InvalidInput(
                f"{name}: has {counted(kept.count, 'case')} of a run that did not come to its end; --resume goes on with it, or remove "
                f"{UNFINISHED}"
            )
        for left in folder.glob(TEMPORARY + "*"):
            shutil.rmtree(left) if left.is_dir() and not left.is_symlink() else left.unlink()
        yield kept
    finally:
        lock.release()


def _read(path: Path, settings: Settings) -> dict[str, dict[int, Case]]:
    """Return the cases in the file, by plan and index, and cut off a last line that lacks its end. Raises InvalidInput."""
    name = quote_path(str(path))
    try:
        with in_file(str(path)):
            opened = open_own(path, "a file of cases")
        with opened as stream:
            _same(stream.readline(LONGEST), settings, name)
            cases: dict[str, dict[int, Case]] = {}
            whole = stream.tell()
            for line in iter(lambda: stream.readline(LONGEST), b""):
                try:
                    one = json.loads(line) if line.endswith(b"\n") else None
                    if not isinstance(one, dict):
                        break
                    if "case" in one:
                        case = _case(one["case"])
                        cases.setdefault(str(one["plan"]), {})[case.index] = case
                except (ValueError, KeyError, TypeError, AttributeError, RecursionError):  # a loss of power may leave such lines at the end
                    break
                whole += len(line)
            size = os.fstat(stream.fileno()).st_size
        if whole < size:
            cut(path, whole)
    except OSError as error:
        raise InvalidInput(f"{name}: cannot be read and written ({reason(error)}): name a new folder") from None
    return cases


def _same(first: bytes, settings: Settings, name: str) -> None:
    """Raise InvalidInput unless the first line is that of a file with these settings."""
    try:
        found = json.loads(first)
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, dict) or found.pop("format", None) != FORMAT:
        raise InvalidInput(f"{name}: is not ours, expected a first line with the format {FORMAT}; move the file away, or name a new folder")
    for key, wanted in asdict(settings).items():
        if found.get(key) != wanted:
            raise InvalidInput(
                f"{name}: an unfinished run with {key} {shorten(found.get(key))}, but {shorten(wanted)} is asked for, which would not go "
                "together; ask for the same, or name a new folder"
            )


def _case(entries: dict[str, Any]) -> Case:
    """Return the case whose `asdict` was written as JSON."""
    estimates = {
        name: Estimate(**(each | {"errors": None if each["errors"] is None else Errors(**each["errors"])}))
        for name, each in entries["estimates"].items()
    }
    return Case(**(entries | {"zeros": tuple(entries["zeros"]), "estimates": estimates, "random": Errors(**entries["random"])}))
