"""This runs the command line, from outside and from inside.

Run             exit code, standard output and standard error
command         `python -m faultspace` in a process of its own
call            `faultspace.cli.command_line.main` in this process
validator       of the schema of that name
EXAMPLES        the folder of the packaged systems
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import re
import subprocess
import sys
from dataclasses import dataclass
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any
from unittest import mock

import jsonschema

from faultspace.base import progress
from faultspace.cli.command_line import main

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = resources.files("faultspace").joinpath("examples")
PROGRESS = re.compile(r"faultspace: .*( \.\.\.| \((\d+ of \d+|\d+ %)(, about .* left)?\))")
_SCHEMAS = {"certificate": "faultspace.proofs"}


@dataclass(frozen=True)
class Run:
    """This is what a run left behind."""

    code: int
    out: str
    err: str

    @property
    def json(self) -> Any:
        """This is standard output, which must be one JSON document."""
        return json.loads(self.out)


def environment(**changes: str) -> dict[str, str]:
    """Return the surroundings of `command`: the tree's own package, no colours asked for."""
    kept = {key: value for key, value in os.environ.items() if key not in ("FORCE_COLOR", "COLUMNS", "NO_COLOR")}
    return kept | {"PYTHONPATH": str(ROOT)} | changes


def command(*arguments: str, stdin: bytes = b"", cwd: Path | None = None, seconds: float = 400.0) -> Run:
    """Run the command in a process of its own, for so many seconds at most. What it tells of its progress, as it does on a busy machine, is
    left out of `err`."""
    line = [sys.executable, "-m", "faultspace", *arguments]
    run = subprocess.run(line, input=stdin, capture_output=True, cwd=cwd or ROOT, env=environment(), timeout=seconds)
    lines = run.stderr.decode().splitlines(keepends=True)
    return Run(run.returncode, run.stdout.decode(), "".join(line for line in lines if not PROGRESS.fullmatch(line.rstrip("\n"))))


def call(*arguments: str) -> Run:
    """A run in this process, which never tells how far it has come: on a busy machine it would."""
    out, err = io.StringIO(), io.StringIO()
    patient = mock.patch.object(progress, "PATIENCE", 3600.0)
    with patient, contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main(arguments)
    return Run(code, out.getvalue(), err.getvalue())


@cache
def validator(name: str, package: str | None = None) -> jsonschema.Draft202012Validator:
    """Return the validator of `NAME.schema.json` in the package. The schema is itself checked first, which takes longer than its use."""
    package = package or _SCHEMAS.get(name, "faultspace.exact")
    schema = json.loads(resources.files(package).joinpath("schemas", f"{name}.schema.json").read_text("utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def example(name: str) -> Any:
    """This is the document of a packaged system."""
    return json.loads(EXAMPLES.joinpath(f"{name}.json").read_text("utf-8"))
