"""This is a program that is asked by lines and answers by lines, under a limit of time and a limit of memory.

Program     starts it with the first question; `ask` sends one line and gives the next one back; `close` ends it and all that it started

What the program does wrong raises Broken with the words for it: hangs, ends, takes too much memory, talks out of turn, starts too many
processes, leaves some behind. It is killed then, and started again with the next question.

Time and memory are looked at at every GLANCE, whether or not the program writes meanwhile. Behind that stands a limit of the kernel on the
data of each process, BACKSTOP times the memory allowed, for what grows faster than anyone looks, and one on the processor time of the
program, for where we are stopped ourselves. Of our environment it sees what `clean_environment` keeps. What a program starts carries a
mark in its environment, by which it is found wherever it went: into another session, to another parent. Processes that are there after the
first answer belong to the program; what comes later must be gone PATIENCE after the answer.
"""

from __future__ import annotations

import os
import selectors
import shlex
import subprocess
import tempfile
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from secrets import token_hex
from signal import Signals

import psutil

from ....base.errors import InvalidData, shorten
from ....base.processes import Limits, allow_cpu, clean_environment, family, kill_session, resident, session
from ..records import Broken

LOADING = 120.0  # seconds for an interpreter and its imports, before the first answer, whatever an answer may take
LONGEST_ANSWER = 64 << 20
GLANCE = 0.05  # seconds between two looks at the memory: what grows by gigabytes a second is seen in time
BACKSTOP = 4  # times the memory allowed: reserved is more than held, and the words for too much are those of a look
CROWD = 200  # processes: no method needs as many, and a program that forks without end has them at once
PATIENCE = 1.0  # seconds that what was started for an answer has to end after it
MARK = "FAULTSPACE_AUDITED"
HELPER = "multiprocessing.resource_tracker"  # Python's own, which lives as long as the program


class Program:
    """It runs `command`, from the first question on, in a clean environment with these `more` variables. Raises InvalidData where it does
    not start."""

    def __init__(self, command: Sequence[str], limits: Limits, more: Mapping[str, str] | None = None) -> None:
        self.command = shlex.join(command)
        self.limits = limits
        self._arguments = list(command)
        self._mark = token_hex(16)
        self._environment = {**clean_environment(limits.passed), **(more or {}), MARK: self._mark}
        self._strangers = set(psutil.pids())
        self._own: set[psutil.Process] | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self._pending = b""
        self._family: set[psutil.Process] = set()

    @property
    def running(self) -> bool:
        """Whether it is there, so that the next question does not start it."""
        return self._process is not None and self._process.poll() is None

    def ask(self, line: bytes, seconds: float | None = None, left: float | None = None) -> bytes:
        """Return the line that answers `line` within so many seconds (None: the limit), of which so many are left (None: all); neither
        ends with a line feed. Raises Broken."""
        if not self.running:
            self.close()
            self._start()
        try:
            allowed = self.limits.seconds if seconds is None else seconds
            return self._exchange(line + b"\n", allowed, allowed if left is None else left)
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """End the program and what it started; it may be asked again, and is then started anew."""
        process, self._process, self._pending = self._process, None, b""
        if process is None:
            return
        # Those in other sessions too: as seen at the last glances, whatever their parents did meanwhile.
        started, self._family, self._own = self._family | set(family(process.pid)) | self._marked(), set(), None
        kill_session(process.pid)
        for one in started:
            with suppress(psutil.Error):
                one.kill()
        process.wait()
        for stream in (process.stdin, process.stdout, self._errors):
            if stream is not None:
                with suppress(OSError):
                    stream.close()

    def _start(self) -> None:
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115
        try:
            self._process = session(
                self._arguments,
                data=BACKSTOP * self.limits.memory,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self._errors,
                env=self._environment,
            )
        except OSError as error:
            self._errors.close()
            raise InvalidData(
                f"the program {self.command} cannot be started ({error.strerror or error}), expected a command that can be run here"
            ) from None
        for stream in (self._process.stdin, self._process.stdout):
            assert stream is not None
            os.set_blocking(stream.fileno(), False)

    def _exchange(self, line: bytes, seconds: float, left: float) -> bytes:
        """Writes and reads at once, so that neither side waits for the other with a full pipe."""
        process = self._process
        assert process is not None and process.stdin is not None and process.stdout is not None
        allow_cpu(process.pid, left)
        deadline, glance = time.monotonic() + left, time.monotonic() + GLANCE
        with selectors.DefaultSelector() as selector:
            selector.register(process.stdout, selectors.EVENT_READ)
            if self._pending or selector.select(0):
                raise Broken("printed a line that nobody asked for, after its last answer")
            selector.register(process.stdin, selectors.EVENT_WRITE)
            heard, whole = bytearray(), False
            while not whole:
                if time.monotonic() > deadline:
                    raise Broken(f"no answer within {seconds:g} s")
                ready = selector.select(min(GLANCE, max(deadline - time.monotonic(), 0)))
                if time.monotonic() >= glance:
                    self._glance(process)
                    glance = time.monotonic() + GLANCE
                for key, _ in ready:
                    if key.fileobj is process.stdin:
                        try:
                            line = line[os.write(process.stdin.fileno(), line) :]
                        except BrokenPipeError:
                            line = b""
                        if not line:
                            selector.unregister(process.stdin)
                    else:
                        chunk = os.read(process.stdout.fileno(), 1 << 16)
                        if not chunk:
                            raise Broken(f"ended without an answer{self._last_words(process)}")
                        heard += chunk
                        whole = b"\n" in chunk  # looked for in what is new: an answer may be long
                if len(heard) > LONGEST_ANSWER:
                    raise Broken(f"printed more than {LONGEST_ANSWER} bytes without an end of line")
        answer, _, self._pending = bytes(heard).partition(b"\n")
        self._see_who_stays()
        return answer

    def _marked(self) -> set[psutil.Process]:
        """Return the processes that carry the mark, wherever they are.

        Those that come while others are looked at are looked at, too, until there are no new ones: of a chain, in which each process starts
        the next one and ends, one is always met. Who was there before the program, or carried no mark once, is not looked at again. One
        that is becoming another program has no environment for a moment, and is looked at again for as long as a glance.
        """
        found, met, deadline = set[psutil.Process](), set[int](), time.monotonic() + GLANCE
        while born := set(psutil.pids()) - self._strangers - met:
            for number in born:
                try:
                    one = psutil.Process(number)
                    environment = one.environ()
                    becoming = not environment and time.monotonic() < deadline and _of_a_user(one)
                except (psutil.Error, OSError):
                    self._strangers.add(number)
                    continue
                if environment.get(MARK) == self._mark:
                    found.add(one)
                if environment and one not in found:
                    self._strangers.add(number)
                elif not becoming:
                    met.add(number)
        return found

    def _see_who_stays(self) -> None:
        """Raises Broken for processes that were started for an answer and outlive it."""
        if self._own is None:
            self._own = self._marked()
            return
        deadline = time.monotonic() + PATIENCE
        # One that was met and has ended since may have been followed by another: it counts until nobody is met.
        while left := self._outside(self._own):
            if time.monotonic() > deadline:
                self._family |= left
                raise Broken(f"left {len(left)} process{'' if len(left) == 1 else 'es'} behind: {_words(next(iter(left)))}")
            time.sleep(GLANCE)

    def _outside(self, own: set[psutil.Process]) -> set[psutil.Process]:
        """Return those that are met now, or live on of those seen before, without the program's own."""
        return {one for one in self._marked() - own if not _helps(one)} | {one for one in self._family - own if _lives(one)}

    def _glance(self, process: subprocess.Popen[bytes]) -> None:
        """Raises Broken for too much memory or too much on standard error."""
        self._family |= set(family(process.pid))
        if (crowd := sum(one.is_running() for one in self._family)) > CROWD:
            raise Broken(f"started {crowd} processes, {CROWD} are allowed")
        if (held := resident(one for one in self._family if one.is_running())) > self.limits.memory:
            raise Broken(f"held {held / 2**30:.1f} GiB of memory, {self.limits.memory / 2**30:.2g} GiB are allowed")
        if os.fstat(self._errors.fileno()).st_size > LONGEST_ANSWER:
            raise Broken(f"wrote more than {LONGEST_ANSWER} bytes to standard error")

    def _last_words(self, process: subprocess.Popen[bytes]) -> str:
        with suppress(subprocess.TimeoutExpired):
            process.wait(1.0)
        self._errors.seek(max(self._errors.seek(0, os.SEEK_END) - 300, 0))
        words = " ".join(self._errors.read().decode(errors="replace").split())
        how = ""
        if process.returncode is not None and process.returncode < 0:
            known = {one.value: one.name for one in Signals}
            how = f" ({known.get(-process.returncode, f'signal {-process.returncode}')})"
        return how + (f"; it said: {words}" if words else "")


def _of_a_user(process: psutil.Process) -> bool:
    """Say whether it is no zombie and no thread of the kernel, which have no environment at all."""
    return process.status() != psutil.STATUS_ZOMBIE and 2 not in (process.pid, process.ppid())


def _lives(process: psutil.Process) -> bool:
    """Say whether it runs, and is neither a zombie nor a helper of Python's own."""
    with suppress(psutil.Error):
        return process.is_running() and process.status() != psutil.STATUS_ZOMBIE and not _helps(process)
    return False


def _helps(process: psutil.Process) -> bool:
    """Say whether it is a helper of Python's own."""
    return HELPER in _words(process)


def _words(process: psutil.Process) -> str:
    with suppress(psutil.Error):
        return shorten(shlex.join(process.cmdline()) or process.name())
    return "ended meanwhile"
