"""An implementation in any language is a program that reads questions from standard input and writes answers to standard output, as JSON.

Exec        starts the program, asks it what it offers, and has a function for each; `close` ends it

The protocol is in PROTOCOL.md. A program that ends, hangs or prints what is no answer is told as broken and started again for the next
question, before which it is asked anew what it offers: what an interpreter takes to start is no answer's time.
"""

from __future__ import annotations

import json
import shlex
from collections.abc import Sequence
from functools import partial
from types import TracebackType
from typing import Any, Self

import numpy as np

from ....base.errors import InvalidData, shorten
from ....base.processes import STANDARD, Limits
from ..adapter import ARGUMENTS, FUNCTIONS, ZeroStructure, known
from ..records import Broken, Refused
from .programs import LOADING, Program

OFFERS = {"call": "functions"}
ANSWERS = {
    "identify": ("A", "B", "C", "D"),
    "residual": ("r",),
    "window_ranks": ("ranks",),
    "fault_dimension": ("n_v",),
    "fault_space": ("basis",),
    "reconstruct": ("v",),
    "structure": ("normal_rank", "finite_zeros", "infinite_zero_orders", "left_invertible"),
    "count_faults": ("n_v",),
    "identified_fault_space": ("A", "C", "basis"),
}


class Exec:
    """This is the program `command` (a shell-like string or a list) as an implementation. Raises InvalidData where it does not start or
    does not say what it offers.
    """

    def __init__(self, command: str | Sequence[str], limits: Limits = STANDARD) -> None:
        try:
            words = shlex.split(command) if isinstance(command, str) else list(command)
        except ValueError as error:
            raise InvalidData(
                f"the program {command!r} cannot be split into words ({error}), expected a command as a shell takes it"
            ) from None
        if not words:
            raise InvalidData("got no program, expected a command such as 'octave-cli --quiet adapter.m'")
        self._program = Program(words, limits)
        try:
            answer = self._ask(OFFERS, LOADING)
            offered, self.NOT_PROMISED = answer.get("functions"), answer.get("not_promised", {})
        except (Broken, Refused) as failure:
            raise InvalidData(f"the program {self._program.command} does not speak the protocol: {failure}") from None
        if not known(offered):
            self.close()
            raise InvalidData(f"the program offers {shorten(offered)}, expected a list of some of {', '.join(FUNCTIONS)}")
        for name in offered:
            setattr(self, name, partial(self._call, name))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def close(self) -> None:
        """End the program and what it started; it may be asked again, and is then started anew."""
        self._program.close()

    def _call(self, name: str, *arguments: Any) -> Any:
        if not self._program.running:
            self._ask(OFFERS, LOADING)
        given = (one.tolist() if isinstance(one, np.ndarray) else one for one in arguments)
        answer = self._ask({"call": name, **dict(zip(ARGUMENTS[name], given, strict=True))})
        if "refused" in answer:
            raise Refused(str(answer["refused"]))
        missing = [key for key in ANSWERS[name] if key not in answer]
        if missing:
            raise Broken(f"the answer to {name} lacks {', '.join(missing)}")
        values = tuple(_numbers(answer[key]) for key in ANSWERS[name])
        if name == "structure":
            return _structure(*values)
        return values if len(values) > 1 else values[0]

    def _ask(self, question: dict[str, Any], seconds: float | None = None) -> dict[str, Any]:
        """Send one line and read one line, within so many seconds (None: the limit).

        NaN and infinities are written as the strings "NaN", "Infinity", "-Infinity".
        """
        line = json.dumps(_finite(question), allow_nan=False).encode()
        try:
            answer = json.loads(self._program.ask(line, seconds))
        except (UnicodeDecodeError, json.JSONDecodeError, RecursionError) as error:
            self.close()
            raise Broken(f"printed what is no JSON line: {error}") from None
        if not isinstance(answer, dict):
            self.close()
            raise Broken("printed a line that is no JSON object")
        return answer


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_finite(one) for one in value]
    if isinstance(value, float) and not np.isfinite(value):
        return "NaN" if value != value else ("Infinity" if value > 0 else "-Infinity")
    return value


def _numbers(value: Any) -> Any:
    """Return nested lists with the three strings read as numbers; None as NaN, as some writers have it."""
    if isinstance(value, list):
        return [_numbers(one) for one in value]
    if value in ("NaN", "Infinity", "-Infinity"):
        return float(value)
    if isinstance(value, str):
        raise Broken(f"the text {shorten(value)} stands where a number is due")
    return float("nan") if value is None else value


def _structure(rank: Any, zeros: Any, orders: Any, invertible: Any) -> ZeroStructure:
    try:
        found = [complex(*z) if isinstance(z, list) else complex(z) for z in (zeros if isinstance(zeros, list) else [zeros])]
        return ZeroStructure(rank, found, np.atleast_1d(orders).tolist(), bool(invertible))
    except (TypeError, ValueError) as error:
        raise Broken(f"the zeros are no list of numbers or pairs [re, im]: {error}") from None
