"""This measures one cell of the ladder benchmark: one method on one system, in a process of its own with a limit on time and memory.

    Budget    wall seconds for the timed part and for what precedes it, address space in MB, how often a quick cell is repeated
    Cell      how it ended, its CPU seconds (the least of the repeats), its parts, the ranks it told, its peak memory
    measure   runs it; `read_lines` understands what a method writes

A cell that is stopped keeps the ranks it had told, so that they are compared too; its `seconds` are those that it had used in vain: a
lower bound. CPU time is what is measured, since the machine may be shared; the limit is on the wall clock, since the reader waits.
"""

from __future__ import annotations

import os
import selectors
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field, replace
from pathlib import Path

from benchmarks.ladder_methods import Method, System
from faultspace.base.processes import kill_session, session

ROOT = Path(__file__).resolve().parents[1]
BRIEF = 1.0  # CPU seconds below which a cell is repeated


@dataclass(frozen=True)
class Budget:
    """These are the limits of a cell."""

    seconds: float = 60.0
    setup: float = 120.0
    megabytes: int = 6000
    repeats: int = 3


@dataclass(frozen=True)
class Cell:
    """`outcome`: "finished", "limit", "memory", "failed", "not run"; `why` explains the last three; `ranks` maps s to rank [O_s T_s]."""

    outcome: str
    seconds: float = 0.0
    parts: dict[str, float] = field(default_factory=dict)
    ranks: dict[int, int] = field(default_factory=dict)
    peak_megabytes: float = 0.0
    why: str = ""


def measure(method: Method, system: System, limits: Budget) -> Cell:
    """Run the method on the system; a quick one runs again, keeping the quickest run and the largest memory."""
    best = _once(method, system, limits)
    for _ in range(limits.repeats - 1):
        if best.outcome != "finished" or best.seconds > BRIEF:
            break
        again = _once(method, system, limits)
        if again.outcome != "finished":  # a busy machine: the first run has answered, and that is what counts
            break
        if again.ranks != best.ranks:
            return replace(again, outcome="failed", why="two runs on the same system gave different ranks")
        quicker = min(best, again, key=lambda cell: cell.seconds)
        best = replace(quicker, peak_megabytes=max(best.peak_megabytes, again.peak_megabytes))
    return best


def _once(method: Method, system: System, limits: Budget) -> Cell:
    with tempfile.TemporaryDirectory() as name, tempfile.TemporaryFile() as errors:
        folder = Path(name)
        process = session(
            method.command(system, folder),
            address_space=limits.megabytes << 20,
            cwd=folder,
            env=_environment(),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=errors,
        )
        in_time = False
        try:
            lines, in_time = _listen(process, limits)
        finally:  # at the limit, and when the reader gives up: the process is in a session of its own and would go on
            if not in_time:
                kill_session(process.pid)
        _, status, usage = os.wait4(process.pid, 0)  # this child alone, which resource.getrusage could not tell from the others
        process.returncode = os.waitstatus_to_exitcode(status)
        assert process.stdout is not None
        process.stdout.close()
        errors.seek(0)
        complaint = errors.read().decode("utf-8", "replace").strip().splitlines()
    answer = read_lines(lines, system)
    unit = 1024 if sys.platform == "darwin" else 1
    cell = replace(answer, peak_megabytes=usage.ru_maxrss / unit / 1024)
    if not in_time:
        if cell.outcome == "setup":
            return replace(cell, outcome="failed", why=f"not ready after {limits.setup:g} s")
        used = usage.ru_utime + usage.ru_stime - cell.parts["ready"]
        return replace(cell, outcome="limit", seconds=max(used, 0.0), parts={})
    if process.returncode != 0 or cell.outcome != "finished":
        reason = complaint[-1][:100] if complaint else "no message"
        if any("memory" in line.lower() for line in complaint):  # MemoryError, "out of memory", "the PARI stack overflows ... memory"
            return replace(cell, outcome="memory", seconds=0.0, parts={}, why=reason)
        return replace(cell, outcome="failed", why=f"exit {process.returncode}: {reason}")
    return replace(cell, parts={name: value for name, value in cell.parts.items() if name != "ready"})


def _listen(process: subprocess.Popen[bytes], limits: Budget) -> tuple[list[str], bool]:
    """The lines that it writes, and whether it ended in time; the clock starts anew at the line `ready`."""
    assert process.stdout is not None
    received = b""
    deadline = time.monotonic() + limits.setup
    timed = False
    with selectors.DefaultSelector() as selector:
        selector.register(process.stdout, selectors.EVENT_READ)
        while True:
            left = deadline - time.monotonic()
            if left <= 0 or not selector.select(left):
                return received.decode().splitlines(), False
            piece = os.read(process.stdout.fileno(), 65536)
            if not piece:
                return received.decode().splitlines(), True
            received += piece
            if not timed and b"ready " in received:
                timed, deadline = True, time.monotonic() + limits.seconds


def read_lines(lines: list[str], system: System) -> Cell:
    """Return what the lines say. The outcome is "setup" before `ready`, then "running", then "finished"."""
    outcome, seconds = "setup", 0.0
    parts: dict[str, float] = {}
    ranks: dict[int, int] = {}
    for line in lines:
        match line.split():
            case ["ready", spent]:
                outcome, parts["ready"] = "running", float(spent)
            case ["rank", s, rank]:
                ranks[int(s)] = int(rank)
            case ["indices", *values]:
                ranks = ranks_from_indices([int(mu) for mu in values], len(system["C"]), len(system["A"]) + 1)
            case ["part", name, value]:
                parts[name] = float(value)
            case ["seconds", value]:
                outcome, seconds = "finished", float(value)
    if outcome == "finished" and sorted(ranks) != list(range(1, len(system["A"]) + 2)):
        outcome = "running"
    return Cell(outcome, seconds, parts, ranks)


def ranks_from_indices(indices: list[int], p: int, windows: int) -> dict[int, int]:
    """rank [O_s T_s] = s r + sum min(s, mu), r = p - their number."""
    r = p - len(indices)
    return {s: s * r + sum(min(s, mu) for mu in indices) for s in range(1, windows + 1)}


def _environment() -> dict[str, str]:
    """Return an environment with one thread everywhere, and the tree on Python's path."""
    path = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    return os.environ | {"PYTHONPATH": path, "OMP_NUM_THREADS": "1", "GC_MARKERS": "1", "GC_NPROCS": "1"}
