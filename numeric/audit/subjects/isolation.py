"""A named adapter in a process of its own: it may hang, crash, print, fork or exhaust memory, and the audit goes on.

Isolated    the worker process of one adapter; `perform` gives the result of a check whatever becomes of the process
"""

from __future__ import annotations

import json
import os
import sys
import time
from types import TracebackType
from typing import Any, Self

from ....base.errors import InvalidData
from ....base.processes import STANDARD, Limits
from ..records import Broken, Check, CheckResult, broken
from ..vectors.trouble import SEED
from .programs import LOADING, Program


class Isolated:
    """This is the adapter `name` (see `adapter.load`), asked vectors of this seed. `functions`: what it offers. Raises InvalidData where it
    cannot be loaded.
    """

    def __init__(self, name: str, limits: Limits = STANDARD, seed: int = SEED) -> None:
        self._name = name
        # -P: what lies in the present folder must not stand in for a module of ours. The paths are the caller's, so that both see the same.
        paths = os.pathsep.join(path for path in sys.path if path)
        command = [sys.executable, "-P", "-m", "faultspace.numeric.audit.subjects.worker", name, str(seed)]
        self._program = Program(command, limits, more={"PYTHONPATH": paths})
        self._loaded = False
        try:
            self.functions: tuple[str, ...] = tuple(self._load())
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

    def perform(self, check: Check) -> CheckResult:
        """This never raises for what the adapter does."""
        begun = time.perf_counter()
        try:
            if not self._loaded:
                self._load()
            begun = time.perf_counter()
            return CheckResult(**self._ask({"check": check.name, "function": check.function})["record"])
        except (Broken, InvalidData) as failure:  # after a crash it may be loaded again, or not
            self.close()
            return broken(check, failure, time.perf_counter() - begun)

    def explain(self, check: Check) -> str:
        """This is what is probably wrong where the check fails; nothing where finding that out takes too long or breaks the adapter."""
        try:
            if not self._loaded:
                self._load()
            return str(self._ask({"explain": check.name, "function": check.function})["explanation"])
        except (Broken, InvalidData):
            self.close()
            return ""

    def _load(self) -> list[str]:
        answer = self._ask({"load": True}, LOADING)
        if "invalid" in answer:
            self.close()
            raise InvalidData(str(answer["invalid"]))
        self._loaded = True
        return list(answer["functions"])

    def _ask(self, question: dict[str, Any], seconds: float | None = None) -> Any:
        answer = json.loads(self._program.ask(json.dumps(question).encode(), seconds))
        if "broken" in answer:
            raise Broken(answer["broken"])
        return answer
