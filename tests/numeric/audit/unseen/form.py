"""What an unseen mutant is: one function of the reference with a plausible mistake, and a witness that the mistake is one.

Whoever wrote these mutants had not read the vectors, the checks, or the mutants written beside them. No mutant names a check: `table`
computes which ones it fails.

Unseen      slug, what is wrong, on which inputs, the function, `make` (the broken function, anew), the witness
Mutants     those of one function: `broken` decorates a broken function
careful     a broken function with the refusals of the reference, so that its mistake is its only one
Witness     the error of a function's answer to a legitimate question beside what rounding may make of it: above one it is wrong
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from types import SimpleNamespace
from typing import Any

Function = Callable[..., Any]
Witness = Callable[[Function], float]


def careful(right: Function) -> Callable[[Function], Function]:
    """Decorate a broken function that has code of its own: what `right` refuses by an exception, it refuses."""

    def kept(function: Function) -> Function:
        @wraps(function)
        def call(*arguments: Any) -> Any:
            right(*arguments)
            return function(*arguments)

        return call

    return kept


@dataclass(frozen=True)
class Unseen:
    """This is a broken function and what shows that it is broken."""

    name: str
    wrong: str
    where: str
    function: str
    make: Callable[[], Function]
    witness: Witness

    @property
    def adapter(self) -> SimpleNamespace:
        """An implementation that offers the broken function alone."""
        return SimpleNamespace(**{self.function: self.make()})


class Mutants:
    """These are the mutants of `function`; the slug of each is from the name of its function, and what is wrong from its docstring."""

    def __init__(self, function: str) -> None:
        self.function = function
        self.all: list[Unseen] = []

    def broken(self, where: str, witness: Witness) -> Callable[[Function], Function]:
        """Decorate a broken function."""

        def kept(function: Function) -> Function:
            slug = f"{self.function}-{function.__name__}".replace("_", "-")
            wrong = " ".join((function.__doc__ or "").split())
            self.all.append(Unseen(slug, wrong, where, self.function, lambda: function, witness))
            return function

        return kept
