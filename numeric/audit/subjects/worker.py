"""`python -m faultspace.numeric.audit.subjects.worker ADAPTER`: a named adapter in its own process, asked by JSON lines.

    {"load": true}                                        -> {"functions": [...], "not_promised": {...}}, or {"invalid": why}
    {"call": function, "arguments": [...]}                -> {"answer": ...}, or {"refused": why}, or {"crashed": why, "cause": type}
    {"inside": measure, "call": function, "arguments"}    -> {"measured": [[quantity, got, bound], ...]}, or as above
    any of them                                           -> {"broken": why}

Answers are compared where the audit runs: here are data alone, so that whatever an adapter looks at, no truth is among it. What a call
does to the process around it (`inside`: state, output, files, memory, time) can be seen here alone, and is told without a truth.

The lines go through copies of the standard streams that the adapter does not see; what it prints itself is dropped. A copy of the
process that comes back from a function, because the adapter forked, never answers: it leaves a mark and ends.
"""

from __future__ import annotations

import importlib
import json
import mmap
import os
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import psutil

from ....base.errors import InvalidData
from ....base.threads import one_thread
from ..adapter import fitting, guarded, load, not_promised
from ..records import Broken, Function, Refused
from .wire import packed, unpacked

PATIENCE = 1.0  # seconds that copies of this process have to come back


def main(name: str) -> int:
    """Answer until standard input ends."""
    with os.fdopen(os.dup(0)) as questions, os.fdopen(os.dup(1), "w") as answers, open(os.devnull, "r+b") as nowhere:
        for taken in (0, 1):
            os.dup2(nowhere.fileno(), taken)
        # An adapter may import what lies in the present folder and beside it, as it could if it were run.
        sys.path[:0] = ["", *([str(Path(name.rpartition(":")[0] or name).parent)] if ".py" in name else [])]
        functions: dict[str, Function] = {}
        for line in questions:
            question = json.loads(line)
            with _Copies() as copies:
                answer = _loaded(name, functions) if "load" in question else _answered(question, functions)
                if copies.seen():
                    answer = {"broken": "forked: a copy of the process came back from the call"}
            answers.write(json.dumps(answer) + "\n")
            answers.flush()
    return 0


def _loaded(name: str, functions: dict[str, Function]) -> dict[str, Any]:
    """Fill `functions` with what the adapter offers, and return their names with what it never promised."""
    try:
        found = load(name)
        functions |= {key: guarded(one) for key, one in fitting(found).items()}
        return {"functions": list(functions), "not_promised": not_promised(found)}
    except InvalidData as error:
        return {"invalid": str(error)}


@one_thread()
def _answered(question: dict[str, Any], functions: dict[str, Function]) -> dict[str, Any]:
    function, arguments = functions[question["call"]], unpacked(question["arguments"])
    try:
        with np.errstate(all="ignore"):  # around all, so that what the function itself sets is seen, and undone
            if "inside" not in question:
                return {"answer": packed(function(*arguments))}
            module, _, name = question["inside"].rpartition(":")
            measured = getattr(importlib.import_module(module), name)(arguments, function)
            return {"measured": [[one.quantity, one.got, one.bound] for one in measured]}
    except Refused as refusal:
        return {"refused": str(refusal)}
    except Broken as failure:
        return {"crashed": str(failure), "cause": type(failure.__cause__).__name__}
    except Exception as error:  # an answer may be anything
        return {"crashed": f"the answer cannot be read: {type(error).__name__}: {error}"}


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
    raise SystemExit(main(sys.argv[1]))
