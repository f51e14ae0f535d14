"""A suspicion says what may be wrong, and has a test: the check itself, asked once more with that put right.

Suspicion        words, and `confirmed`, which runs the test
Case             a failed check, the function, the calls made and what they measured
answer_changed   suspects the answer: put right, it passes
asked_otherwise  suspects how the function takes its arguments: asked otherwise, it passes
seen             what can be read from the answers: a relation that holds exactly, and that no right answer of the check has
misled_by_sizes  suspects a threshold, or units, where a record brought to size one gets the right answer
holds            whether a check passes
SAME             how near two numbers are that are called equal
sizes, to_one    the root mean square of each channel, of the largest: brought to size one, a record is out of an absolute threshold's reach
Call, Recorder   arguments and answer of one call;   a function that keeps its calls, to be made again, put right, or written down
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....base.arrays import Array
from ..records import Check, Function, Measurement, Refused, Sides

SAME = 1e-6
"""Of the size of an answer: two numbers nearer than that are taken for the same where no bound is at hand. It is far above rounding and far
below what any of the errors suspected changes."""
NothingToChange = TypeError, ValueError, IndexError, ArithmeticError, np.linalg.LinAlgError
"""What a change raises that does not apply to an answer, of whatever shape and kind that is."""


@dataclass(frozen=True)
class Case:
    """`measured` is what the check measured before it ended; `calls` are those that it made."""

    check: Check
    function: Function
    calls: Sequence[Call]
    measured: Sequence[Measurement]

    def sides(self, of: str) -> Sides | None:
        """Return the first answer of that kind beside the truth."""
        return next((one.sides for one in self.measured if one.sides is not None and one.sides.of == of), None)


@dataclass(frozen=True)
class Suspicion:
    """The words are a sentence; `confirmed` tells whether the test of a case bears them out."""

    words: str
    confirmed: Callable[[Case], bool]


def holds(check: Check, function: Function) -> bool:
    """This tells whether the check passes by an answer; whatever goes wrong, it does not, and a refusal bears nothing out."""
    try:
        with np.errstate(all="ignore"):
            measured = list(check.measure(function))
    except Exception:  # an answer changed on suspicion may be anything
        return False
    return any(one.sides for one in measured) and all(one.ratio <= 1 for one in measured)


def answer_changed(words: str, change: Callable[..., Any]) -> Suspicion:
    """Suspect the answer. `change(answer, *arguments)` puts it right, and gives None where the suspicion does not apply."""

    def confirmed(case: Case) -> bool:
        answers = iter(case.calls)

        def replayed(*arguments: Any) -> Any:
            call = next(answers)
            changed = None if call.answer is None else change(call.answer, *call.arguments)
            if changed is None:
                raise ValueError("the suspicion does not apply")
            return changed

        return holds(case.check, replayed)

    return Suspicion(words, confirmed)


def asked_otherwise(words: str, ask: Callable[..., Any]) -> Suspicion:
    """Suspect how arguments are taken. `ask(function, *arguments)` asks so that the suspected error does no harm, and gives the answer to
    the first question.
    """

    def confirmed(case: Case) -> bool:
        return holds(case.check, lambda *arguments: ask(case.function, *arguments))

    return Suspicion(words, confirmed)


def misled_by_sizes(whole: Callable[..., Any], each: Callable[..., Any] | None = None, channel: str = "channel") -> tuple[Suspicion, ...]:
    """Suspect an absolute threshold, which `whole(function, *arguments)` does not reach, and unlike units, which `each` makes alike."""
    words = "A threshold is absolute: with the whole record brought to size one first, the function passes."
    units = f"Channels in unlike units mislead it: with each {channel} brought to size one first, the function passes."
    return tuple(asked_otherwise(said, ask) for said, ask in ((words, whole), (units, each)) if ask is not None)


def seen(words: str, relation: Callable[..., bool]) -> Suspicion:
    """Suspect by what every answer shows. `relation(answer, *arguments)` tells whether one does."""

    def confirmed(case: Case) -> bool:
        answered = [call for call in case.calls if call.answer is not None]
        try:
            return bool(answered) and all(relation(call.answer, *call.arguments) for call in answered)
        except NothingToChange:
            return False

    return Suspicion(words, confirmed)


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


def sizes(signal: Array) -> Array:
    """There is a number for each channel of the signal (N, p)."""
    largest = np.max(np.abs(signal), axis=0, initial=0.0)
    largest[~(largest > 0)] = 1.0
    found: Array = largest * np.sqrt(np.mean((signal / largest) ** 2, axis=0))
    return found


def to_one(signal: Array) -> float:
    """Return one number for all channels: the root mean square of the largest."""
    return float(np.max(sizes(signal), initial=0.0)) or 1.0
