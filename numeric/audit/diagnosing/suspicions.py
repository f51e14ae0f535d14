"""A suspicion says what may be wrong, and has a test: the check itself, asked once more with that put right.

Suspicion        words, and `confirmed`, which runs the test
Case             a failed check, the function, the calls made and what they measured
answer_changed   suspects the answer: put right, it passes
asked_otherwise  suspects how the function takes its arguments: asked otherwise, it passes
seen             what can be read from the answers: a relation that holds exactly, and that no right answer of the check has
holds            whether a check passes
SAME             how near two numbers are that are called equal
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..records import Check, Function, Measurement
from .recording import Call

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


def seen(words: str, relation: Callable[..., bool]) -> Suspicion:
    """Suspect by what every answer shows. `relation(answer, *arguments)` tells whether one does."""

    def confirmed(case: Case) -> bool:
        answered = [call for call in case.calls if call.answer is not None]
        try:
            return bool(answered) and all(relation(call.answer, *call.arguments) for call in answered)
        except NothingToChange:
            return False

    return Suspicion(words, confirmed)
