"""A named adapter in a process of its own: it may hang, crash, print, fork or exhaust memory, and the audit goes on.

Auditee     has `functions`, what it offers; `perform` gives the result of one check, `explain` what is probably wrong
Isolated    the worker process of one adapter; `perform` gives the result of a check whatever becomes of the process

What is asked crosses to that process as data, and its answers are compared here: the truth is never where the adapter can look.
"""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from types import SimpleNamespace, TracebackType
from typing import Any, Self

from ....base.errors import InvalidData, shorten
from ....base.processes import STANDARD, Limits
from ..adapter import excused, known, not_promised
from ..diagnosing.explaining import explained
from ..records import Broken, Check, CheckResult, Function, Measurement, Refused, perform
from .programs import LOADING, Program
from .wire import packed, unpacked


class Auditee:
    """It answers checks; `functions` are those that it offers, `_apart` is why checks of a pattern were never promised."""

    functions: tuple[str, ...]
    _apart: dict[str, str]

    def perform(self, check: Check) -> CheckResult:
        """Return the result of one check; this never raises for what the subject does."""
        return replace(perform(check, self._function(check)), not_promised=excused(check, self._apart))

    def explain(self, check: Check) -> str:
        """Return what is probably wrong where the check fails; nothing where finding that out takes too long or breaks the subject."""
        return explained(check, self._function(check))

    def _function(self, check: Check) -> Function:
        raise NotImplementedError


class Isolated(Auditee):
    """This is the adapter `name` (see `adapter.load`). `functions`: what it offers. Raises InvalidData where it cannot be loaded."""

    def __init__(self, name: str, limits: Limits = STANDARD) -> None:
        # -P: what lies in the present folder must not stand in for a module of ours. The paths are the caller's, so that both see the same.
        paths = os.pathsep.join(path for path in sys.path if path)
        command = [sys.executable, "-P", "-m", "faultspace.numeric.audit.subjects.worker", name]
        self._program = Program(command, limits, more={"PYTHONPATH": paths})
        self._loaded, self._left = False, limits.seconds
        self._apart = {}
        try:
            self.functions = tuple(self._load())
        except Broken as failure:
            raise InvalidData(f"adapter {name}: it cannot be loaded ({failure}); importing it in Python shows why") from None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def close(self) -> None:
        """End the process and what it started; the next check starts another."""
        self._loaded = False
        self._program.close()

    def _function(self, check: Check) -> _Remote:
        """Return the function that a check asks, with the time that the check may take before it."""
        self._left = self._program.limits.seconds
        return _Remote(partial(self._ask, check.function))

    def _load(self) -> list[str]:
        line = self._program.ask(json.dumps({"load": True}).encode(), LOADING)
        try:
            answer = dict(json.loads(line))
        except (ValueError, TypeError, RecursionError):
            answer = {}
        if "invalid" in answer:
            self.close()
            raise InvalidData(str(answer["invalid"]))
        offered = answer.get("functions")
        if not known(offered):  # an adapter may change what is sent
            self.close()
            raise Broken(f"it says that it offers {shorten(offered)}, expected a list of functions")
        self._apart = not_promised(SimpleNamespace(NOT_PROMISED=answer.get("not_promised")))
        self._loaded = True
        return list(offered)

    def _ask(self, function: str, question: dict[str, Any]) -> dict[str, Any]:
        """Return the answer to one question of a check. What breaks the process ends the check: nothing of it is asked after that."""
        if self._left <= 0:
            raise Broken(f"no answer within {self._program.limits.seconds:g} s")
        try:
            if not self._loaded:
                self._load()
            begun = time.monotonic()
            line = json.dumps({"call": function, **question}).encode()
            answer = json.loads(self._program.ask(line, self._program.limits.seconds, self._left))
            self._left -= time.monotonic() - begun
            if "broken" in answer:
                raise Broken(str(answer["broken"]))
        except (Broken, InvalidData, ValueError, TypeError, RecursionError) as failure:  # after a crash it may be loaded again, or not
            self._left = 0.0
            self.close()
            raise Broken(str(failure)) from None
        if "refused" in answer:
            raise Refused(str(answer["refused"]))
        if "crashed" in answer:
            words = str(answer["crashed"])
            raise Broken(words) from (TypeError(words) if answer.get("cause") == "TypeError" else None)
        return dict(answer)


class _Remote:
    """A function of the adapter, called where that is."""

    def __init__(self, ask: Callable[[dict[str, Any]], dict[str, Any]]) -> None:
        self._ask = ask

    def __call__(self, *arguments: Any) -> Any:
        answer = self._ask({"arguments": [packed(one) for one in arguments]})
        try:
            return unpacked(answer["answer"])
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError, OverflowError, MemoryError) as error:
            raise Broken(f"the answer cannot be read: {type(error).__name__}: {error}") from None

    def inside(self, measure: Callable[..., Iterable[Measurement]], arguments: tuple[Any, ...]) -> list[Measurement]:
        """Return what `measure(arguments, function)` measures in the process of the function."""
        name = f"{measure.__module__}:{measure.__qualname__}"
        answer = self._ask({"inside": name, "arguments": [packed(one) for one in arguments]})
        try:
            return [Measurement(str(quantity), float(got), float(bound)) for quantity, got, bound in answer["measured"]]
        except (ValueError, TypeError, KeyError) as error:
            raise Broken(f"the answer cannot be read: {type(error).__name__}: {error}") from None
