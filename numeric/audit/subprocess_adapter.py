"""An implementation in any language: a program that reads questions from standard input and writes answers to standard output, JSON lines.

Exec        starts the program, asks it what it offers, and has a function for each; `close` ends it
TIMEOUT     seconds an answer may take

The protocol is in PROTOCOL.md. A program that ends, hangs or prints what is no answer is told as broken and started again for the next
question.
"""

from __future__ import annotations

import json
import os
import selectors
import shlex
import signal
import subprocess
import tempfile
import time
from collections.abc import Sequence
from contextlib import suppress
from functools import partial
from types import TracebackType
from typing import Any, Self

import numpy as np

from ..input_checks import InvalidData
from .adapter import FUNCTIONS, Structure
from .records import Broken, Refused

TIMEOUT = 60.0
LONGEST_ANSWER = 64 << 20
ARGUMENTS = {
    "identify": ("y", "u", "order", "block_rows"),
    "residual": ("y", "u", "A", "B", "C", "D"),
    "window_ranks": ("r", "windows"),
    "fault_dimension": ("r",),
    "fault_space": ("r", "A", "C", "n_v"),
    "reconstruct": ("r", "A", "F", "C", "G", "x0"),
    "structure": ("A", "F", "C", "G"),
}
ANSWERS = {
    "identify": ("A", "B", "C", "D"),
    "residual": ("r",),
    "window_ranks": ("ranks",),
    "fault_dimension": ("n_v",),
    "fault_space": ("basis",),
    "reconstruct": ("v",),
    "structure": ("normal_rank", "finite_zeros", "infinite_zero_orders", "left_invertible"),
}


class Exec:
    """The program `command` (a shell-like string or a list) as an implementation. Raises InvalidData where it does not start or does not
    say what it offers.
    """

    def __init__(self, command: str | Sequence[str], *, timeout: float = TIMEOUT) -> None:
        self._command = shlex.split(command) if isinstance(command, str) else list(command)
        self._timeout = timeout
        self._process: subprocess.Popen[bytes] | None = None
        self._pending = b""
        try:
            offered = self._ask({"call": "functions"}).get("functions")
        except (Broken, Refused) as failure:
            raise InvalidData(f"the program {shlex.join(self._command)} does not speak the protocol: {failure}") from None
        if not isinstance(offered, list) or any(name not in FUNCTIONS for name in offered):
            self.close()
            raise InvalidData(f"the program offers {offered}: expected a list of some of {', '.join(FUNCTIONS)}")
        for name in offered:
            setattr(self, name, partial(self._call, name))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def close(self) -> None:
        """Ends the program and what it started; it may be asked again, and is then started anew."""
        process, self._process, self._pending = self._process, None, b""
        if process is None:
            return
        with suppress(OSError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        for stream in (process.stdin, process.stdout, process.stderr):
            if stream is not None:
                with suppress(OSError):
                    stream.close()

    def _call(self, name: str, *arguments: Any) -> Any:
        given = (one.tolist() if isinstance(one, np.ndarray) else one for one in arguments)
        answer = self._ask({"call": name, **dict(zip(ARGUMENTS[name], given, strict=True))})
        if "refused" in answer:
            raise Refused(str(answer["refused"]))
        missing = [key for key in ANSWERS[name] if key not in answer]
        if missing:
            raise Broken(f"the answer to {name} lacks {', '.join(missing)}")
        values = tuple(_numbers(answer[key]) for key in ANSWERS[name])
        if name == "structure":
            rank, zeros, orders, invertible = values
            return Structure(rank, [complex(*np.atleast_1d(z)) for z in zeros], np.atleast_1d(orders).tolist(), bool(invertible))
        return values if len(values) > 1 else values[0]

    def _ask(self, question: dict[str, Any]) -> dict[str, Any]:
        """One line out, one line in. NaN and infinities are written as the strings "NaN", "Infinity", "-Infinity"."""
        if self._process is None or self._process.poll() is not None:
            self.close()
            self._start()
        process = self._process
        assert process is not None and process.stdin is not None
        line = json.dumps(_finite(question), allow_nan=False).encode() + b"\n"
        try:
            answer = json.loads(self._exchange(process, line))
        except (UnicodeDecodeError, json.JSONDecodeError, RecursionError) as error:
            self.close()
            raise Broken(f"printed what is no JSON line: {error}") from None
        except Broken:
            self.close()
            raise
        if not isinstance(answer, dict):
            self.close()
            raise Broken("printed a line that is no JSON object")
        return answer

    def _start(self) -> None:
        try:
            self._errors = tempfile.TemporaryFile()  # noqa: SIM115
            self._process = subprocess.Popen(
                self._command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors, start_new_session=True
            )
        except OSError as error:
            raise InvalidData(f"the program {shlex.join(self._command)} cannot be started: {error.strerror or error}") from None
        for stream in (self._process.stdin, self._process.stdout):
            assert stream is not None
            os.set_blocking(stream.fileno(), False)

    def _exchange(self, process: subprocess.Popen[bytes], line: bytes) -> bytes:
        """Writes and reads at once, so that neither side waits for the other with a full pipe."""
        assert process.stdin is not None and process.stdout is not None
        deadline = time.monotonic() + self._timeout
        with selectors.DefaultSelector() as selector:
            selector.register(process.stdin, selectors.EVENT_WRITE)
            selector.register(process.stdout, selectors.EVENT_READ)
            while b"\n" not in self._pending:
                ready = selector.select(max(deadline - time.monotonic(), 0))
                if not ready:
                    raise Broken(f"no answer within {self._timeout:g} s")
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
                            raise Broken(f"ended without an answer{self._last_words()}")
                        self._pending += chunk
                if len(self._pending) > LONGEST_ANSWER:
                    raise Broken(f"printed more than {LONGEST_ANSWER} bytes without an end of line")
        answer, _, self._pending = self._pending.partition(b"\n")
        return answer

    def _last_words(self) -> str:
        self._errors.seek(max(self._errors.seek(0, os.SEEK_END) - 300, 0))
        words = " ".join(self._errors.read().decode(errors="replace").split())
        return f"; it said: {words}" if words else ""


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_finite(one) for one in value]
    if isinstance(value, float) and not np.isfinite(value):
        return "NaN" if value != value else ("Infinity" if value > 0 else "-Infinity")
    return value


def _numbers(value: Any) -> Any:
    """Nested lists with the three strings read as numbers; None as NaN, as some writers have it."""
    if isinstance(value, list):
        return [_numbers(one) for one in value]
    if value in ("NaN", "Infinity", "-Infinity"):
        return float(value)
    return float("nan") if value is None else value
