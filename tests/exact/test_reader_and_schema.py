"""The reader of systems and the schema that ships beside it accept the same documents, drawn at random and changed in a few places.

The reader is what runs: its messages say what was got, what is needed and what to try, and it takes a tenth of the time. A schema cannot
say everything; what it leaves to the reader is in its description, and BESIDE has the reader's words for it.

BESIDE      what the reader says where the schema alone would accept
ODD         values that are put in the place of others
changed     a document with one of its values removed, repeated or replaced
"""

from __future__ import annotations

import copy
import json
import re
from importlib import resources
from random import Random
from typing import Any

import jsonschema
import pytest
from hypothesis import example, given, settings

from faultspace.base.errors import InvalidInput
from faultspace.exact import read_system
from tests.oracle.strategies import SEEDS, systems
from tests.thorough import examples

Json = Any
SCHEMA = json.loads(resources.files("faultspace.exact").joinpath("schemas", "system.schema.json").read_text("utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
BESIDE = re.compile(
    r"got shape \d+ x \d+, expected"
    r"|n \+ m \+ p: got \d+, at most 512"
    r"|nu: got \d+, at most 512"
    r"|is reducible over Q|the leading coefficient is 0|expected a prime below 2\^64"
    r"|got a list of \d+ coordinates|got \d+ entries, expected \d+ as in the first row"
    r"|every matrix that shows this dimension is empty"
    r"|bits"
)
ODD: tuple[Json, ...] = (
    *(None, True, False, 0.5, -1, 0, 1, 2, 3, 512, 513, 10**30, 2**64),
    *("", "1", "1/2", "-3/4", "0/1", "1/0", "1/02", "01", "+1", "-0", " 1", "1 ", "1.5", "1e3", "Q", "R", "½", "١", "1/-2", "--1", "/1"),
    *([], {}, [[]], [["1"]], ["1"], ["1", "2"], [["1", "2"]], ["-2", "0", "1"], {"prime": 3}, {"prime": 4}, {"prime": "3"}, {"A": 1}),
    *({"minimal_polynomial": ["-2", "0", "1"]}, {"minimal_polynomial": ["1"]}, {"minimal_polynomial": ["1"] * 18}),
)
ONE: Json = {"A": [["1"]], "F": [["1"]], "C": [["1"]], "G": [["1"]]}
INPUTS: Json = {"B": [["1"]], "D": [["1"]]}


def places(document: Json) -> list[tuple[Json, Any]]:
    """These are all containers in the document, each with each of its keys or indices."""
    keys = list(document) if isinstance(document, dict) else list(range(len(document))) if isinstance(document, list) else []
    return [(document, key) for key in keys] + [place for key in keys for place in places(document[key])]


def changed(document: Json, rng: Random) -> Json:
    """The result differs from the document in one place: a value is removed, repeated, replaced, or there is one more."""
    result = copy.deepcopy(document)
    container, key = rng.choice(places(result))
    kind = rng.randrange(4)
    if kind == 0:
        del container[key]
    elif kind == 1 and isinstance(container, list):
        container.insert(key, copy.deepcopy(container[key]))
    elif kind == 2:
        result[rng.choice([*"AFCGBDnmp", "nu", "field", "H"])] = copy.deepcopy(rng.choice(ODD))
    else:
        container[key] = copy.deepcopy(rng.choice(ODD))
    return result


def complaint(document: Json) -> str | None:
    """The result is what the reader says against the document, None where it reads it."""
    try:
        read_system(document)
    except InvalidInput as error:
        return str(error)
    return None


def check(document: Json) -> None:
    """What is read agrees with the schema; what is not read breaks it too, or a rule that its description tells besides."""
    said = complaint(document)
    agrees = VALIDATOR.is_valid(document)
    assert agrees or said is not None, document
    assert not agrees or said is None or BESIDE.search(said), (said, document)


@settings(max_examples=examples(400))
@given(systems(), SEEDS)
@example({**ONE, **INPUTS, "B": [[]], "D": [[]]}, 0)
@example({"A": [[]], "F": [[]], "C": [[]], "G": [[]], "n": 0, "m": 0, "p": 0, **INPUTS, "B": [], "D": []}, 0)
def test_they_agree(given: Json, seed: int) -> None:
    rng = Random(seed)
    document = given if rng.random() < 0.7 else {**given, "B": given["A"], "D": given["C"], "nu": len(given["A"])}
    check(document)
    for _ in range(3):
        document = changed(document, rng)
        check(document)


def test_the_changes_leave_and_make_all_cases() -> None:
    """Among changed documents are ones that both accept, that both refuse, and that the reader refuses by a rule besides the schema."""
    rng = Random(1)
    document: Json = {**ONE, **INPUTS, "field": {"minimal_polynomial": ["-2", "0", "1"]}}
    seen = {(complaint(one) is None, VALIDATOR.is_valid(one)) for one in (changed(document, rng) for _ in range(300))}
    assert seen == {(True, True), (False, False), (False, True)}


@pytest.mark.parametrize("rule", ["additionalProperties", "dependentRequired", "required", "allOf"])
def test_a_schema_without_a_rule_is_noticed(rule: str, monkeypatch: pytest.MonkeyPatch) -> None:
    weaker = copy.deepcopy(SCHEMA)
    del weaker["$defs"]["system"][rule]
    monkeypatch.setitem(globals(), "VALIDATOR", jsonschema.Draft202012Validator(weaker))
    rng = Random(2)
    with pytest.raises(AssertionError):
        for _ in range(400):
            check(changed({**ONE, **INPUTS}, rng))
