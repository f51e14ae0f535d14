"""What a run of `verify` has decided is kept in a file, so that the same command goes on where it was stopped.

KeptAnswers    the answers of an earlier run, by task, the records of its attacks, and its words about the corpus; `keeping` has the file
made_by        on what they depend beside the task: these are another run's, and are not used, where it is anything else

An answer that is read has its certificates put before the checker once more. A check in ERROR is not kept, but tried again.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any, TypeVar

from ..base.kept_lines import KeptLines, keeping_lines
from .trust.checker import Malformed, Rejected
from .trust.structure_certificates import accept
from .verdict.verdicts import Outcome, Row, Verdict, versions

FORMAT = "faultspace-decided/1"
ROOMS = ("base", "exact", "proofs")
Found = TypeVar("Found", bound=Outcome)


class KeptAnswers:
    """The answers of runs with the same `made_by`; without a file there are none, and none is kept."""

    def __init__(self, effort: str, lines: KeptLines | None = None) -> None:
        self._lines, self._made_by = lines, {"effort": effort, **made_by()} if lines is not None else {}
        ours = [line for line in (lines.lines if lines is not None else []) if line["made_by"] == self._made_by]
        self._tasks: dict[str, Mapping[str, Any]] = {line["task"]: line for line in ours if "task" in line}
        self._attacks: dict[str, dict[str, Any]] = {line["attack"]: line["record"] for line in ours if "attack" in line}
        self.corpus = next((str(line["corpus"]) for line in reversed(ours) if "corpus" in line), "")

    @property
    def count(self) -> int:
        """Return how many answers and records of an earlier run there are."""
        return len(self._tasks) + len(self._attacks)

    def found(self, task: str) -> tuple[Any, float] | None:
        """Return what the task came to, an Outcome or a tuple of Rows, and the seconds that it took; None where it is to be done, as it is
        where a certificate does not stand."""
        line = self._tasks.get(task)
        if line is None:
            return None
        found = _read(line)
        try:
            for one in _several(found):
                for certificate in one.certificates:
                    accept(certificate)
        except (Malformed, Rejected):
            return None
        return found, float(line["seconds"])

    def attack(self, name: str) -> dict[str, Any] | None:
        """Return the record of an attack, None where it is to be run."""
        return self._attacks.get(name)

    def note(self, task: str, found: Any, seconds: float) -> None:
        """Keep what a task came to."""
        if self._lines is None:
            return
        kept = {"outcome": _entries(found)} if isinstance(found, Outcome) else {"rows": [_entries(row) for row in found]}
        if not any(one.verdict == Verdict.ERROR for one in _several(found)):
            self._note(task=task, seconds=seconds, **kept)

    def note_attack(self, record: Mapping[str, Any]) -> None:
        """Keep the record of an attack."""
        self._note(attack=record["attack"], record=record)

    def note_corpus(self, words: str) -> None:
        """Keep what there is to say of the corpus, which a run that goes on may not make."""
        if words and words != self.corpus:
            self.corpus = words
            self._note(corpus=words)

    def _note(self, **entries: Any) -> None:
        if self._lines is not None:
            self._lines.note(made_by=self._made_by, **entries)


@contextmanager
def keeping(path: Path | None, effort: str) -> Iterator[KeptAnswers]:
    """Yield the answers in a file, which is made where it is not there, and which no other run has meanwhile; none without a path.

    Raises InvalidInput for a file that is not one of these.
    """
    if path is None:
        yield KeptAnswers(effort)
        return
    with keeping_lines(path, FORMAT, _good, "--resume") as lines:
        yield KeptAnswers(effort, lines)


@cache
def made_by() -> dict[str, str]:
    """Return the versions of the libraries, and the SHA-256 of what stands in our files, which decide."""
    digest = hashlib.sha256()
    for room in ROOMS:
        folder = Path(str(import_module(f"faultspace.{room}").__file__)).parent
        for path in sorted(folder.rglob("*")):
            if path.suffix in (".py", ".toml", ".json", ".v") and "certificates" not in path.parts:
                digest.update(f"{room}/{path.relative_to(folder).as_posix()}\0".encode() + path.read_bytes())
    return {**versions(), "files": digest.hexdigest()}


def _good(line: Mapping[str, Any]) -> bool:
    if not isinstance(line["made_by"], dict):
        return False
    if "task" in line:
        _read(line)
        return isinstance(line["seconds"], float)
    return isinstance(line.get("record"), dict) or isinstance(line.get("corpus"), str)


def _several(found: Outcome | tuple[Row, ...]) -> Sequence[Outcome]:
    """Return what a task came to as a sequence."""
    return found if isinstance(found, tuple) else (found,)


def _read(line: Mapping[str, Any]) -> Outcome | tuple[Row, ...]:
    return _made(Outcome, line["outcome"]) if "outcome" in line else tuple(_made(Row, row) for row in line["rows"])


def _entries(one: Outcome) -> dict[str, Any]:
    return {**asdict(one), "decided": sorted(one.decided)}


def _made(kind: type[Found], entries: Mapping[str, Any]) -> Found:
    """Return the record of these entries; a line of an earlier version, which no run goes on with, has the number of its certificates."""
    several = {name: tuple(entries[name]) for name in ("dropped", "certificates", "theorems", "attacks") if name in entries}
    given = {name: value for name, value in entries.items() if name != "accepted"} | several
    return kind(**given | {"verdict": Verdict(entries["verdict"]), "decided": frozenset(entries.get("decided", ()))})
