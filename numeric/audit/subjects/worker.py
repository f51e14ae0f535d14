"""`python -m faultspace.numeric.audit.subjects.worker ADAPTER SEED`: checks of a named adapter in its own process, asked by JSON lines.

    {"load": true}                                 -> {"functions": [...]}, or {"invalid": why}
    {"check": slug[vector], "function": name}      -> {"record": {...}}
    {"explain": slug[vector], "function": name}    -> {"explanation": what is probably wrong}
    any of them                                    -> {"broken": why}

The lines go through copies of the standard streams that the adapter does not see; what it prints itself is dropped. A copy of the
process that comes back from a function, because the adapter forked, never answers: it leaves a mark and ends.
"""

from __future__ import annotations

import json
import mmap
import os
import sys
import time
from dataclasses import asdict
from pathlib import Path
from typing import Any

import psutil

from ....base.errors import InvalidData
from ..adapter import excused, guarded, load, not_promised
from ..checks.catalogue import all_checks
from ..diagnosing.explaining import explained
from ..records import Function, perform
from ..signatures import fitting
from ..vectors.trouble import SEED

PATIENCE = 1.0  # seconds that copies of this process have to come back


def main(name: str, seed: int = SEED) -> int:
    """This answers until standard input ends."""
    with os.fdopen(os.dup(0)) as questions, os.fdopen(os.dup(1), "w") as answers, open(os.devnull, "r+b") as nowhere:
        for taken in (0, 1):
            os.dup2(nowhere.fileno(), taken)
        # An adapter may import what lies in the present folder and beside it, as it could if it were run.
        sys.path[:0] = ["", *([str(Path(name.rpartition(":")[0] or name).parent)] if ".py" in name else [])]
        functions: dict[str, Function] = {}
        apart: dict[str, str] = {}
        checks = {(one.name, one.function): one for one in all_checks(seed)}
        for line in questions:
            question = json.loads(line)
            with _Copies() as copies:
                if "load" in question:
                    answer = _loaded(name, functions, apart)
                elif "explain" in question:
                    check = checks[question["explain"], question["function"]]
                    answer = {"explanation": explained(check, functions[check.function])}
                else:
                    check = checks[question["check"], question["function"]]
                    answer = {"record": asdict(perform(check, functions[check.function])) | {"not_promised": excused(check, apart)}}
                if copies.seen():
                    answer = {"broken": "forked: a copy of the process came back from the call"}
            answers.write(json.dumps(answer) + "\n")
            answers.flush()
    return 0


def _loaded(name: str, functions: dict[str, Function], apart: dict[str, str]) -> dict[str, Any]:
    """Fill `functions` with what the adapter offers, and `apart` with what it never promised."""
    try:
        found = load(name)
        functions |= {key: guarded(one) for key, one in fitting(found).items()}
        apart |= not_promised(found)
    except InvalidData as error:
        return {"invalid": str(error)}
    return {"functions": list(functions)}


class _Copies:
    """This tells whether a copy of this process came back to where it should not be; such a copy ends in `seen`."""

    def __enter__(self) -> _Copies:
        self._pid = os.getpid()
        self._before = {child.pid for child in psutil.Process().children()}
        self._mark = mmap.mmap(-1, 1)
        return self

    def __exit__(self, *error: object) -> None:
        self._mark.close()

    def seen(self) -> bool:
        """Wait a moment for the new copies of the process itself; in a copy this does not return."""
        if os.getpid() != self._pid:
            self._mark[0] = 1
            os._exit(0)
        mine = psutil.Process().cmdline()
        born = [child for child in psutil.Process().children() if child.pid not in self._before and _command(child) == mine]
        deadline = time.monotonic() + PATIENCE
        while born and not self._mark[0] and time.monotonic() < deadline:
            psutil.wait_procs(born, timeout=0.05)
            born = [child for child in born if child.is_running() and child.status() != psutil.STATUS_ZOMBIE]
        return bool(self._mark[0])


def _command(process: psutil.Process) -> list[str]:
    try:
        return list(process.cmdline())
    except psutil.Error:
        return []


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1], int(sys.argv[2])))
