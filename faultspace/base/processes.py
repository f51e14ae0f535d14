"""This starts programs under limits, and ends them with all that they started.

Limits               seconds of an answer, bytes that a program and its children may hold; STANDARD: a minute, 4 GiB
session              a program started in a session of its own, so that it can be ended with what it started
kill_session         ends such a program and what is left in its session
family, resident     a process with its descendants, and the bytes that they hold
"""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import ceil
from typing import Any

import psutil


@dataclass(frozen=True)
class Limits:
    """Of one answer: the seconds it may take, the bytes of memory that the program and its children may hold meanwhile."""

    seconds: float = 60.0
    memory: int = 4 << 30


STANDARD = Limits()


def session(
    command: Sequence[str],
    *,
    address_space: int | None = None,
    data: int | None = None,
    cpu_seconds: float | None = None,
    **settings: Any,
) -> subprocess.Popen[bytes]:
    """The program started as the leader of a session; `settings` are those of Popen. Raises OSError where it does not start.

    `address_space` and `data`, in bytes, and `cpu_seconds` are limits that the kernel keeps, of each process: a watch like `resident` needs
    none. Of `data` is what a process may write to, of `address_space` also what it has only reserved.
    """

    def limited() -> None:
        import resource  # not on Windows

        if address_space is not None:
            resource.setrlimit(resource.RLIMIT_AS, (address_space,) * 2)
        if data is not None:
            resource.setrlimit(resource.RLIMIT_DATA, (data,) * 2)
        if cpu_seconds is not None:
            whole = ceil(cpu_seconds)
            resource.setrlimit(resource.RLIMIT_CPU, (whole, whole + 1))

    before = None if address_space is None and data is None and cpu_seconds is None else limited
    return subprocess.Popen(command, start_new_session=True, preexec_fn=before, **settings)


def kill_session(leader: int) -> None:
    """Kills what is left of the session that this process has led; where nothing is, nothing happens."""
    with suppress(OSError):
        os.killpg(leader, signal.SIGKILL)


def family(pid: int) -> list[psutil.Process]:
    """Return the process and its descendants; none where it is gone."""
    with suppress(psutil.Error):
        first = psutil.Process(pid)
        return [first, *first.children(recursive=True)]
    return []


def resident(processes: Iterable[psutil.Process]) -> int:
    """Return bytes that the processes hold (shared pages are counted once for each)."""
    total = 0
    for one in processes:
        with suppress(psutil.Error):
            total += int(one.memory_info().rss)
    return total
