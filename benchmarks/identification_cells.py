"""This measures one cell of the identification benchmark: one method on one record, in a process with a limit on time and memory.

    CELL      the limits of a cell: CPU seconds of the whole process, bytes of address space
    Cell      how it ended, seconds (the least of the repeats), peak memory above imports and data, errors of the model if it gave one
    environment, python_command   what a cell runs in and by
    measure   runs a command in a folder with a record and reads the one line that it writes: RESULT and a JSON object

Seconds are CPU seconds, since machines are shared (every cell has one thread), and so is the limit, start and reading included; the wall
clock stops a cell only after PATIENCE times as much.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from benchmarks.identification_data import Setting, errors
from faultspace.base.errors import InvalidData
from faultspace.base.processes import Limits, kill_session, session
from faultspace.numeric.method.model.models import StateSpaceModel

ROOT = Path(__file__).resolve().parents[1]
RESULT = "RESULT "
PATIENCE = 10.0
CELL = Limits(seconds=60.0, memory=8000 << 20)
OUT_OF_MEMORY = ("memory", "cannot allocate", "bad_alloc", "unable to allocate")


@dataclass(frozen=True)
class Cell:
    """`outcome`: "finished", "limit", "memory", "failed", "not run", "not installed"; `why` explains; megabytes None where unknown."""

    outcome: str
    seconds: float = 0.0
    megabytes: float | None = None
    eigenvalue_error: float | None = None
    markov_error: float | None = None
    why: str = ""
    changed: bool = False


def measure(command: list[str], setting: Setting, folder: Path, limits: Limits) -> Cell:
    """Run the command on the record in `folder`, stopped at the limit."""
    process = session(
        command,
        address_space=limits.memory,
        cpu_seconds=limits.seconds,
        cwd=folder,
        env=environment(),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    try:
        out, complaint = process.communicate(timeout=PATIENCE * limits.seconds)
    except subprocess.TimeoutExpired:
        kill_session(process.pid)
        process.communicate()
        return Cell("limit", seconds=0.0, why=f"not done after {PATIENCE * limits.seconds:g} s of wall time")
    except BaseException:  # the reader gives up: the process is in a session of its own and would go on
        kill_session(process.pid)
        raise
    if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return Cell("limit", seconds=limits.seconds)
    lines = [line for line in out.decode("utf-8", "replace").splitlines() if line.startswith(RESULT)]
    if not lines:
        said = [line for line in complaint.decode("utf-8", "replace").splitlines() if line.strip()]
        if any(word in line.lower() for word in OUT_OF_MEMORY for line in said):
            return Cell("memory", why=f"more than {limits.memory >> 20} MB")
        # Octave's message is the first of its lines that say so, Python's is the last line.
        complaint_line = next((line for line in said if line.startswith("error")), said[-1] if said else "no message")
        return Cell("failed", why=f"exit {process.returncode}: {complaint_line.strip()[:120]}")
    return cell_of(json.loads(lines[-1][len(RESULT) :]), setting)


def cell_of(answer: dict[str, object], setting: Setting) -> Cell:
    """Return the cell that a method tells: seconds, megabytes, whether y or u was written to, and A, B, C, D where it gives a model."""
    seconds, megabytes = answer["seconds"], answer.get("megabytes")
    assert isinstance(seconds, float | int) and (megabytes is None or isinstance(megabytes, float | int))
    changed = bool(answer.get("changed"))
    if "A" not in answer:
        return Cell("finished", seconds, megabytes, changed=changed)
    try:
        model = StateSpaceModel(*(answer[name] for name in "ABCD"))  # type: ignore[arg-type]
    except InvalidData as error:
        return Cell("failed", seconds, megabytes, why=f"no model: {error}"[:120], changed=changed)
    return Cell("finished", seconds, megabytes, *errors(model, setting.n_u, setting.p), changed=changed)


def environment() -> dict[str, str]:
    """Return an environment with one thread everywhere, no display, and the tree on Python's path."""
    path = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    threads = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}
    return os.environ | threads | {"PYTHONPATH": path, "MPLBACKEND": "Agg"}


def python_command(name: str, *arguments: str) -> list[str]:
    """Return the command that runs a Python method of this benchmark."""
    return [sys.executable, "-m", "benchmarks.identification_methods", name, *arguments]
