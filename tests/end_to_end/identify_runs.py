"""Runs of `faultspace identify`, shared by the tests of what it answers and of what it reads.

CHANNELS        options that name the packaged record's channels
identified      a run in this process into a folder
refused         asserts one line of complaint and exit code 2
small_csv       a text as a file
valid           a document that the schema of that name in the package accepts
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from faultspace import example_data as made
from tests.end_to_end.commands import Run, call, validator

CHANNELS = ("--inputs", ",".join(made.INPUTS), "--outputs", ",".join(made.OUTPUTS))


def small_csv(folder: Path, text: str, name: str = "data.csv") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def identified(path: Path, out: Path, *options: str, channels: tuple[str, ...] = CHANNELS) -> Run:
    """Run with the packaged record's channels unless others are given."""
    return call("identify", str(path), *channels, "--out", str(out), *options)


def refused(run: Run, *parts: str) -> None:
    """Assert one line on standard error with these parts, nothing on standard output, and exit code 2."""
    assert (run.code, run.out) == (2, ""), run
    (line,) = run.err.strip().splitlines()
    assert line.startswith("faultspace: "), run.err
    for part in parts:
        assert part in line, line


def valid(name: str, document: Any) -> Any:
    """Return the document, which the schema NAME.schema.json accepts."""
    validator(name, "faultspace.numeric").validate(document)
    return document
