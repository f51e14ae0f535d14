"""The reader of systems and the schema that ships beside it accept the same documents, drawn at random and changed in a few places.

The reader is what runs: its messages say what was got, what is needed and what to try, and it takes a tenth of the time. A schema cannot
say everything; what it leaves to the reader is in its description, and BESIDE has the reader's words for it.

BESIDE      what the reader says where the schema alone would accept
ODD         values that are put in the place of others
SYSTEMS     the reader and the schema, held together
"""

from __future__ import annotations

import copy
import json
import re
from dataclasses import replace
from importlib import resources
from random import Random
from typing import Any

import pytest
from hypothesis import example, given, settings

from faultspace.exact import read_system
from tests.exact.documents import Agreement
from tests.oracle.strategies import SEEDS, systems
from tests.thorough import examples

Json = Any
SCHEMA = json.loads(resources.files("faultspace.exact").joinpath("schemas", "system.schema.json").read_text("utf-8"))
BESIDE = re.compile(
    r"got shape \d+ x \d+, expected"
    r"|n \+ m \+ p: got \d+, at most 512"
    r"|nu: got \d+, at most 512"
    r"|is reducible over Q|the leading coefficient is 0|expected a prime below 2\^64"
    r"|got a list of \d+ coordinates|got \d+ entr(y|ies), expected \d+ as in the first row"
    r"|every matrix that shows this dimension is empty"
    r"|bits"
)
ODD: tuple[Json, ...] = (
    *(None, True, False, 0.5, -1, 0, 1, 2, 3, 512, 513, 10**30, 2**64),
    *("", "1", "1/2", "-3/4", "0/1", "1/0", "1/02", "01", "+1", "-0", " 1", "1 ", "1.5", "1e3", "Q", "R", "½", "١", "1/-2", "--1", "/1"),
    *([], {}, [[]], [["1"]], ["1"], ["1", "2"], [["1", "2"]], ["-2", "0", "1"], {"prime": 3}, {"prime": 4}, {"prime": "3"}, {"A": 1}),
    *({"minimal_polynomial": ["-2", "0", "1"]}, {"minimal_polynomial": ["1"]}, {"minimal_polynomial": ["1"] * 18}),
)
SYSTEMS = Agreement(read_system, SCHEMA, BESIDE, (*"AFCGBDnmp", "nu", "field", "H"), ODD)
ONE: Json = {"A": [["1"]], "F": [["1"]], "C": [["1"]], "G": [["1"]]}
INPUTS: Json = {"B": [["1"]], "D": [["1"]]}


@settings(max_examples=examples(400))
@given(systems(), SEEDS)
@example({**ONE, **INPUTS, "B": [[]], "D": [[]]}, 0)
@example({"A": [[]], "F": [[]], "C": [[]], "G": [[]], "n": 0, "m": 0, "p": 0, **INPUTS, "B": [], "D": []}, 0)
def test_they_agree(given: Json, seed: int) -> None:
    rng = Random(seed)
    document = given if rng.random() < 0.7 else {**given, "B": given["A"], "D": given["C"], "nu": len(given["A"])}
    SYSTEMS.check(document)
    for _ in range(3):
        document = SYSTEMS.changed(document, rng)
        SYSTEMS.check(document)


def test_the_changes_leave_and_make_all_cases() -> None:
    """Among changed documents are ones that both accept, that both refuse, and that the reader refuses by a rule besides the schema."""
    rng = Random(1)
    document: Json = {**ONE, **INPUTS, "field": {"minimal_polynomial": ["-2", "0", "1"]}}
    seen = {(SYSTEMS.complaint(one) is None, SYSTEMS.accepts(one)) for one in (SYSTEMS.changed(document, rng) for _ in range(300))}
    assert seen == {(True, True), (False, False), (False, True)}


@pytest.mark.parametrize("rule", ["additionalProperties", "dependentRequired", "required", "allOf"])
def test_a_schema_without_a_rule_is_noticed(rule: str) -> None:
    weaker = copy.deepcopy(SCHEMA)
    del weaker["$defs"]["system"][rule]
    weakened = replace(SYSTEMS, schema=weaker)
    rng = Random(2)
    with pytest.raises(AssertionError):
        for _ in range(400):
            weakened.check(weakened.changed({**ONE, **INPUTS}, rng))
