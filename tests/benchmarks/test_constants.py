"""The command that judges constants: its sign test, its rule on answers made for the purpose, and the constants as the code has them."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from types import ModuleType

import pytest

from benchmarks.constants import FACTORS, Worth, sign_test, table, values, worths
from benchmarks.constants_questions import QUESTIONS, Answer, Ask, Constant, Question

RIGHT, OPEN, WRONG = Answer("right"), Answer("undecided"), Answer("wrong")


def test_the_sign_test_counts_the_ways() -> None:
    for pairs in range(7):
        for up in range(pairs + 1):
            ways = sum(sum(signs) >= up for signs in itertools.product((0, 1), repeat=pairs))
            assert sign_test(up, pairs - up) == pytest.approx(ways / 2**pairs)


def rule(value: float = 1.0) -> ModuleType:
    """A module with a constant, as the rules of the house are."""
    module = ModuleType("rule")
    module.__dict__["EDGE"] = value
    return module


def worth(usual: list[Answer], answers: list[Answer]) -> Worth:
    return Worth(Constant("EDGE", (rule(),)), 2.0, usual, answers)


def test_fewer_wrong_ones_are_better_whatever_becomes_of_the_right_ones() -> None:
    usual = [WRONG] * 12 + [RIGHT] * 12
    assert worth(usual, [OPEN] * 24).better(0.001)
    assert not worth(usual, [WRONG] * 12 + [OPEN] * 12).better(0.001)
    assert not worth([WRONG] * 3 + [RIGHT] * 21, [RIGHT] * 24).better(0.001)  # three are chance


def test_more_right_ones_are_better_unless_more_are_wrong() -> None:
    usual = [OPEN] * 40
    assert worth(usual, [RIGHT] * 20 + [OPEN] * 20).better(0.001)
    assert worth(usual, [RIGHT] * 20 + [WRONG] * 4 + [OPEN] * 16).better(0.001)  # four of four: a chance of .06
    assert not worth(usual, [RIGHT] * 20 + [WRONG] * 5 + [OPEN] * 15).better(0.001)


def test_smaller_errors_are_better_where_as_many_are_right() -> None:
    usual = [Answer("right", 1.0)] * 20
    smaller = [Answer("right", 0.9)] * 20
    assert worth(usual, smaller).better(0.001) and not worth(smaller, usual).better(0.001)
    assert not worth([*usual, *[RIGHT] * 5], [*smaller, *[OPEN] * 5]).better(0.001)


def test_a_constant_set_badly_is_found_and_one_set_well_is_left() -> None:
    """The rule says "right" of numbers in [EDGE, 2 EDGE]: all records are at 1.2, so .5 is bad and 1 is well set."""
    for value, verdict in ((0.5, "x 2 is better"), (1.0, "none is better")):
        module = rule(value)

        def ask(module: ModuleType = module) -> Answer:
            return RIGHT if module.EDGE <= 1.2 <= 2 * module.EDGE else OPEN

        def records(trial: int, seed: int, samples: int, ask: Ask = ask) -> Iterator[Ask]:
            yield ask

        question = Question("made", (Constant("EDGE", (module,)),), records)
        lines = list(table(question, worths(question, 15, [1, 2], 100, 1), 0.001, "records", False))
        assert lines[0].startswith("made: 30 records")
        assert verdict in lines[-1] and value == module.EDGE


def test_whole_numbers_stay_whole_and_each_value_comes_once() -> None:
    module = rule()
    module.__dict__["EDGE"] = 3
    assert [value for _, value in values(Constant("EDGE", (module,)))] == [2, 4, 6]
    assert [factor for factor, _ in values(Constant("EDGE", (rule(1.0),)))] == list(FACTORS)


@pytest.mark.parametrize("question", QUESTIONS.values(), ids=QUESTIONS)
def test_the_constants_are_where_the_question_looks(question: Question) -> None:
    for constant in question.constants:
        assert constant.value > 0
        assert {getattr(owner, constant.name) for owner in constant.owners} == {constant.value}


@pytest.mark.parametrize("name", ["order", "space"])
def test_a_question_is_asked_of_its_records(name: str) -> None:
    asked = [ask() for ask in QUESTIONS[name].records(0, 1, 400)]
    assert len(asked) >= 6 and {one.verdict for one in asked} <= {"right", "undecided", "wrong"}
