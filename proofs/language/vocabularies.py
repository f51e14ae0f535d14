"""The names that each kind of claim may use.

Vocabulary       systems by their names, quantities of the whole, matrices and what their rows and columns stand for
VOCABULARIES     what a claim can be about -> its vocabulary
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..quantities.choices import OF_A_CHOICE
from ..quantities.pairs import OF_A_PAIR, OF_ONE_A_AND_C
from ..quantities.records import OF_A_RECORD
from ..quantities.registry import Quantity, quantities

Sides = tuple[tuple[str, ...], tuple[str, ...]]
SYSTEM, PAIR, ONE_A_AND_C, CHOICE, RECORD = "system", "pair", "pair with the same (A, C)", "choice", "record"


@dataclass(frozen=True)
class Vocabulary:
    """`subjects` are the systems that a claim is about, "" where it is one; `own` are quantities of the subject as a whole.

    `sides` says of each matrix, (subject, name), what its rows and columns stand for: states "x", outputs "y", faults "v", and so on, with
    the number of the system where two have their own.
    """

    about: str
    subjects: tuple[str, ...]
    own: Mapping[str, Quantity]
    sides: Mapping[tuple[str, str], Sides]

    def names(self) -> list[str]:
        """Return every name that can stand alone, functions left out."""
        matrices = [name for subject, name in self.sides if not subject]
        return [*(quantities() if "" in self.subjects else ()), *matrices, *self.own, *filter(None, self.subjects)]

    def after(self, subject: str) -> list[str]:
        """Return every name that can stand behind the name of a system and a point."""
        return [*quantities(), *(name for one, name in self.sides if one == subject)]

    def counted(self, subject: str, name: str) -> tuple[str, ...] | None:
        """Return what n, m or p counts, as `sides` call it."""
        if name not in COUNTED or (subject, COUNTED[name][0]) not in self.sides:
            return None
        matrix, side = COUNTED[name]
        return self.sides[subject, matrix][side]


COUNTED = {"n": ("A", 0), "m": ("F", 1), "p": ("C", 0)}


def _of_a_system(subject: str, states: str, faults: str) -> dict[tuple[str, str], Sides]:
    x, v, y = (states,), (faults,), ("y",)
    return {(subject, "A"): (x, x), (subject, "F"): (x, v), (subject, "C"): (y, x), (subject, "G"): (y, v)}


_BOTH = _of_a_system("first", "x", "v1") | _of_a_system("second", "x", "v2") | {("", "A"): (("x",), ("x",)), ("", "C"): (("y",), ("x",))}
_CHOSEN = _of_a_system("", "x", "v") | _of_a_system("chosen", "x", "k") | {("", "P"): (("z",), ("k",))}
_DRIVEN = (
    _of_a_system("", "x", "v")
    | _of_a_system("inputs", "x", "u")
    | {("", "B"): (("x",), ("u",)), ("", "D"): (("y",), ("u",)), ("", "u"): (("t",), ("u",)), ("", "x0"): (("x",), ("1",))}
)
VOCABULARIES = {
    one.about: one
    for one in (
        Vocabulary(SYSTEM, ("",), {}, _of_a_system("", "x", "v")),
        Vocabulary(PAIR, ("first", "second"), OF_A_PAIR, _of_a_system("first", "x1", "v1") | _of_a_system("second", "x2", "v2")),
        Vocabulary(ONE_A_AND_C, ("first", "second"), OF_ONE_A_AND_C, _BOTH),
        Vocabulary(CHOICE, ("", "chosen"), OF_A_CHOICE, _CHOSEN),
        Vocabulary(RECORD, ("", "inputs"), OF_A_RECORD, _DRIVEN),
    )
}
ABOUT_A_SYSTEM = VOCABULARIES[SYSTEM]
