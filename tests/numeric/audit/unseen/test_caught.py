"""An unseen mutant is wrong, as its witness says, and is caught today by the check that is known to catch it.

Some are asked daily, the others with the tests of tests.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import FUNCTIONS
from faultspace.numeric.audit.checks.catalogue import all_checks
from tests.numeric.audit import test_mutants
from tests.numeric.audit.unseen import table
from tests.numeric.audit.unseen.catalogue import ALL, BY_NAME, RIGHT
from tests.numeric.audit.unseen.form import Function, Unseen
from tests.numeric.audit.unseen.table import kept, still_caught

WRONG = [one for one in ALL if one.name not in RIGHT]
DAILY = 10


def _daily() -> set[str]:
    """Return every tenth, and one of each kind of check that `test_mutants` asks nobody about daily."""
    kinds = {"-".join(check.partition("[")[0].split("-")[:2]): name for name, check in reversed(kept().items())}
    return {one.name for one in ALL[::DAILY]} | {name for kind, name in kinds.items() if kind not in test_mutants.DAILY}


SLOW = ("count_faults", "identified_fault_space")


def remembering(function: Function) -> Function:
    """Return the function with a memory of its answers to the same numbers."""
    known: dict[Any, Any] = {}

    def call(*arguments: Any) -> Any:
        key = tuple(one.tobytes() if hasattr(one, "tobytes") else one for one in arguments)
        if key not in known:
            known[key] = function(*arguments)
        return known[key]

    return call


@pytest.fixture(scope="module", autouse=True)
def slow_answers_once() -> Iterator[None]:
    """The two functions that ask a whole record take a second each: equal questions are put to them once."""
    with pytest.MonkeyPatch.context() as patch:
        for name in SLOW:
            patch.setattr(reference, name, remembering(getattr(reference, name)))
        yield


def test_each_has_a_check_that_there_is_and_every_function_has_one() -> None:
    known = kept()
    assert list(known) == [one.name for one in WRONG] and len(ALL) == len(BY_NAME) and set(RIGHT) <= set(BY_NAME)
    functions = {one.full_name: one.function for one in all_checks()}
    assert {name: functions.get(check) for name, check in known.items()} == {one.name: one.function for one in WRONG}
    assert {one.function for one in ALL} == set(FUNCTIONS)
    assert [one.name for one in ALL if not (one.wrong.endswith(".") and one.where)] == []


@pytest.mark.parametrize("one", [pytest.param(one, id=one.name, marks=() if one.name in _daily() else pytest.mark.mutants) for one in ALL])
def test_it_is_wrong_and_is_caught(one: Unseen) -> None:
    assert one.witness(getattr(one.adapter, one.function)) > 1, "the mutant is right where it was thought to be wrong"
    assert one.witness(getattr(reference, one.function)) < 1, "the reference is wrong, too: the question is not a legitimate one"
    assert one.name in RIGHT or still_caught(one), f"{kept().get(one.name)} passes: {one.wrong}"


def test_who_is_right_is_not_caught_and_who_does_not_end_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    harmless = BY_NAME["structure-goes-through-the-coefficients"]
    monkeypatch.setattr(table, "kept", lambda: {harmless.name: "normal-rank[zeros-none]-structure"})
    assert table.in_turn(harmless)[0].full_name == kept_name(harmless) and not still_caught(harmless)
    endless = replace(harmless, make=lambda: _endless)
    assert not still_caught(endless, 0.5)


def kept_name(one: Unseen) -> str:
    return table.kept()[one.name]


def _endless(*arguments: Any) -> Any:
    while True:
        pass
