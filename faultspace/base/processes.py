"""This starts programs under limits, and ends them with all that they started.

Limits               seconds of an answer, bytes that a program and its children may hold, variables that it sees; STANDARD: a minute, 4 GiB
clean_environment    the variables that any program needs, and those that are passed on by name
session              a program started in a session of its own, so that it can be ended with what it started
kill_session         ends such a program and what is left in its session
allow_cpu            lets the kernel end a process that takes more than so many seconds on all cores from now on
family, resident     a process with its descendants, and the bytes that they hold
ending_with_us       what a program that is started calls before it begins, so that it ends when we end, however that is
end_with_parent      the same for a process of Python, which calls it itself
"""

from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from math import ceil
from threading import Thread
from typing import Any

import psutil

_PR_SET_PDEATHSIG = 1  # of linux/prctl.h
# Seconds between two looks of a child at its parent.
GLANCE = 0.5


@dataclass(frozen=True)
class Limits:
    """Of one answer: the seconds it may take, the bytes of memory that the program and its children may hold meanwhile. `passed` names the
    variables of our environment that the program sees beside those of a clean one; "*" is all of them."""

    seconds: float = 60.0
    memory: int = 4 << 30
    passed: tuple[str, ...] = ()


STANDARD = Limits()
# Where programs and files are, who and in which language asks; what else there is belongs to our caller: keys, settings, paths of modules.
_NEEDED = ("PATH", "HOME", "USER", "LOGNAME", "SHELL", "LANG", "LANGUAGE", "TZ", "TERM", "TMPDIR", "TEMP", "TMP", "SYSTEMROOT")
_NEEDED_KINDS = ("LC_", "XDG_")


def clean_environment(passed: Sequence[str] = ()) -> dict[str, str]:
    """Return the variables of our environment that any program needs, with those of these names, which need not be there; "*" is all."""
    if "*" in passed:
        return dict(os.environ)
    return {name: value for name, value in os.environ.items() if name in (*_NEEDED, *passed) or name.startswith(_NEEDED_KINDS)}


def session(
    command: Sequence[str], *, address_space: int | None = None, data: int | None = None, cpu_seconds: float | None = None, **settings: Any
) -> subprocess.Popen[bytes]:
    """The program started as the leader of a session; `settings` are those of Popen. Raises OSError where it does not start.

    `address_space` and `data`, in bytes, and `cpu_seconds` are limits that the kernel keeps, of each process: a watch like `resident` needs
    none. Of `data` is what a process may write to, of `address_space` also what it has only reserved. On Linux the program is killed
    when the thread that started it ends, and so with our process, also where that is killed itself.
    """
    ended_with_us = ending_with_us()

    def limited() -> None:
        import resource  # not on Windows

        if ended_with_us is not None:
            ended_with_us()
        if address_space is not None:
            resource.setrlimit(resource.RLIMIT_AS, (address_space,) * 2)
        if data is not None:
            resource.setrlimit(resource.RLIMIT_DATA, (data,) * 2)
        if cpu_seconds is not None:
            whole = ceil(cpu_seconds)
            resource.setrlimit(resource.RLIMIT_CPU, (whole, whole + 1))

    before = ended_with_us if address_space is None and data is None and cpu_seconds is None else limited
    return subprocess.Popen(command, start_new_session=True, preexec_fn=before, **settings)


def kill_session(leader: int) -> None:
    """Kills what is left of the session that this process has led; where nothing is, nothing happens."""
    with suppress(OSError):
        os.killpg(leader, signal.SIGKILL)


def allow_cpu(pid: int, seconds: float) -> None:
    """Let the kernel end this process where it computes for longer than `seconds` on all cores of the machine, counted from now; a later
    call counts anew. It does nothing where the system knows no such limit, or the process is gone."""
    with suppress(psutil.Error, OSError, AttributeError, ValueError):
        process = psutil.Process(pid)
        taken = sum(process.cpu_times()[:2])
        hard = process.rlimit(psutil.RLIMIT_CPU)[1]
        process.rlimit(psutil.RLIMIT_CPU, (ceil(taken + seconds * (os.cpu_count() or 1)) + 1, hard))


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


def ending_with_us() -> Callable[[], None] | None:
    """Return the `preexec_fn` of a program that the kernel is to kill when the thread that starts it ends; None where there is no Linux.

    The thread has to wait for the program therefore, or to be the main one."""
    control, parent = _prctl(), os.getpid()
    if control is None:
        return None

    def ended_with_us() -> None:
        control(_PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
        if os.getppid() != parent:  # which ended before it could be asked for
            os._exit(1)

    return ended_with_us


@cache
def _prctl() -> Callable[..., int] | None:
    """Return the system call, looked up before any fork: a child of a process with threads had better not load anything."""
    if sys.platform != "linux":
        return None
    try:
        return ctypes.CDLL(None, use_errno=True).prctl
    except (OSError, AttributeError):
        return None


def end_with_parent(parent: int) -> None:
    """Let this process end as soon as its parent, the process of that number, has, even if it was killed: a thread looks twice a second who
    the parent is. The number is the parent's own word, for it may be gone before we look for the first time."""

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(GLANCE)
        os._exit(1)

    # Not by PR_SET_PDEATHSIG: joblib starts its processes from threads which end before they do.
    Thread(target=watch, daemon=True, name="end_with_parent").start()
