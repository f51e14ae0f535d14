"""An unseen mutant is caught today, by the check that is known to catch it, or, where it remembers, by one asked after others.

All are asked in a slow test, one in thirty daily."""

from __future__ import annotations

import pytest

from faultspace.numeric.audit.checks.catalogue import all_checks
from tests.numeric.audit.unseen.catalogue import ALL, RIGHT
from tests.numeric.audit.unseen.form import Unseen
from tests.numeric.audit.unseen.table import kept, still_caught

WRONG = [one for one in ALL if one.name not in RIGHT]
DAILY = 30


def test_each_has_a_check_that_there_is() -> None:
    known = kept()
    assert list(known) == [one.name for one in WRONG]
    functions = {one.full_name: one.function for one in all_checks()}
    assert {name: functions.get(check) for name, check in known.items()} == {one.name: one.function for one in WRONG}


@pytest.mark.parametrize("one", WRONG[::DAILY], ids=lambda one: one.name)
def test_it_catches_the_mutant(one: Unseen) -> None:
    assert still_caught(one), f"{kept()[one.name]} passes: {one.wrong}"


@pytest.mark.slow
@pytest.mark.parametrize("one", [one for i, one in enumerate(WRONG) if i % DAILY], ids=lambda one: one.name)
def test_it_catches_the_others(one: Unseen) -> None:
    assert still_caught(one), f"{kept()[one.name]} passes: {one.wrong}"
