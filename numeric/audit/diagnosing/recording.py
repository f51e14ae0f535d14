"""This keeps the calls that a check makes, so that they can be made again, put right, or written down.

Call       arguments and answer of one call
Recorder   a function that keeps its calls
"""

from __future__ import annotations

import copy
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..records import Function, Refused


@dataclass(frozen=True)
class Call:
    """`refused` is the reason of a refusal, None where there is an answer."""

    arguments: tuple[Any, ...]
    answer: Any
    refused: str | None = None


class Recorder:
    """It calls the function with copies of the arguments' values kept as they were before the call."""

    def __init__(self, function: Function) -> None:
        self._function = function
        self.calls: list[Call] = []

    def __call__(self, *arguments: Any) -> Any:
        kept = tuple(map(_as_given, arguments))
        try:
            answer = self._function(*arguments)
        except Refused as refusal:
            self.calls.append(Call(kept, None, str(refusal)))
            raise
        self.calls.append(Call(kept, _kept(answer)))
        return answer


def _as_given(argument: Any) -> Any:
    """Return a copy, read-only where the argument is: a copy forgets that."""
    found = copy.deepcopy(argument)
    if isinstance(argument, np.ndarray):
        found.flags.writeable = argument.flags.writeable
    return found


def _kept(answer: Any) -> Any:
    """Return a copy, where there can be one."""
    try:
        return copy.deepcopy(answer)
    except Exception:  # an answer may be anything, a generator for example
        return answer
