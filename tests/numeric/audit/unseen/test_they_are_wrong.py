"""Each mutant is wrong: its witness says so, and says nothing of the reference."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import FUNCTIONS
from tests.numeric.audit.unseen.catalogue import ALL, BY_NAME
from tests.numeric.audit.unseen.form import Function, Unseen
from tests.numeric.audit.unseen.manners_witnesses import ends

AT_LEAST = 170  # what was asked for, a few to be found equivalent among them
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


def test_there_are_enough_with_a_slug_each_and_of_every_function() -> None:
    assert len(ALL) == len(BY_NAME) >= AT_LEAST
    assert {one.function for one in ALL} == set(FUNCTIONS)


def test_each_says_what_is_wrong_and_where() -> None:
    assert [one.name for one in ALL if not (one.wrong.endswith(".") and one.where)] == []
    assert len({one.wrong for one in ALL}) > 0.95 * len(ALL)


@pytest.mark.parametrize("one", ALL, ids=lambda one: one.name)
def test_the_witness_shows_the_mistake_and_no_other(one: Unseen) -> None:
    assert one.witness(getattr(one.adapter, one.function)) > 1, "the mutant is right where it was thought to be wrong"
    assert one.witness(getattr(reference, one.function)) < 1, "the reference is wrong, too: the question is not a legitimate one"


def test_a_question_that_an_alarm_ends_leaves_the_handling_of_errors_of_numpy() -> None:
    """An alarm that comes while numpy enters `errstate` has the process say ever after that singular values do not converge."""

    def endless(_: Any) -> None:
        np.seterr(invalid="raise")
        while True:
            np.linalg.svd(np.eye(2))

    before = np.geterr()
    assert ends(np.eye(2))(endless) > 1
    assert np.geterr() == before
