"""The readers of systems and experiments accept the same documents as the schemas beside them: drawn ones, changed in a few places.

The readers are what runs: their messages say what was got, what is needed and what to try, and they take a tenth of the time. A schema
cannot say everything; what it leaves to the reader is in its description, and `beside` finds the reader's words for it.

Agreement       a reader, its schema, and what the schema leaves to the reader; `check` holds them together on a document
SYSTEMS         those of systems
EXPERIMENTS     those of experiments
WEAKER          rules without which a schema is noticed to be another one, by their places in it
"""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import reduce
from importlib import resources
from random import Random
from typing import Any

import jsonschema
import pytest
from hypothesis import example, given, settings

from faultspace.base.errors import InvalidInput
from faultspace.exact import read_experiment, read_system
from tests.oracle.strategies import SEEDS, systems
from tests.thorough import examples

Json = Any
SCHEMAS = resources.files("faultspace.exact").joinpath("schemas")
OF_SYSTEMS = (
    r"got shape \d+ x \d+, expected"
    r"|n \+ m \+ p: got \d+, at most 512"
    r"|nu: got \d+, at most 512"
    r"|is reducible over Q|the leading coefficient is 0|expected a prime below 2\^64"
    r"|got a list of \d+ coordinates|got \d+ entr(y|ies), expected \d+ as in the first row"
    r"|every matrix that shows this dimension is empty"
    r"|bits"
)
OF_EXPERIMENTS = (
    r"|got \d+ rows?, expected"
    r"|got matrices with \d+ columns?, expected"
    r"|got no input, expected one|got no output, expected one"
    r"|got eigenvalues on or outside the unit circle"
    r"|got an unstable denominator|den\[0\]: got"
    r"|identically zero"
    r"|got windows of|states of system and filters"
)
ODD: tuple[Json, ...] = (
    *(None, True, False, 0.5, -1, 0, 1, 2, 3, 512, 513, 10**30, 2**64),
    *("", "1", "1/2", "-3/4", "0/1", "1/0", "1/02", "01", "+1", "-0", " 1", "1 ", "1.5", "1e3", "Q", "R", "½", "١", "1/-2", "--1", "/1"),
    *([], {}, [[]], [["1"]], ["1"], ["1", "2"], [["1", "2"]], ["-2", "0", "1"], {"prime": 3}, {"prime": 4}, {"prime": "3"}, {"A": 1}),
    *({"minimal_polynomial": ["-2", "0", "1"]}, {"minimal_polynomial": ["1"]}, {"minimal_polynomial": ["1"] * 18}),
)
ODD_FILTERS: tuple[Json, ...] = (
    *([[["1"]]], [[["1"]], [["1/2"]]], [[["1", "0"]]], [[[]]], [["1"], ["0"]], 2048, 2049, 257),
    *({"num": [[["1"]]], "den": den} for den in (["1", "-1/2"], ["2"], ["1", "2"], [], ["1", "0"], ["1"] + ["0"] * 257)),
    *({"num": [[["1"]]]}, {"num": [], "den": ["1"]}, {"num": "1", "den": "1"}),
    *([[["1"]]] * 257, [[["0"]]] * 258),
)


@dataclass(frozen=True)
class Agreement:
    """`read` and `schema` accept the same documents, but for the reader's words that `beside` finds.

    `odd` are the values that are put in the place of others, and `keys` the names that they are put under.
    """

    read: Callable[[Json], object]
    schema: Json
    beside: re.Pattern[str]
    keys: tuple[str, ...]
    odd: tuple[Json, ...]

    def changed(self, document: Json, rng: Random) -> Json:
        """The result differs from the document in one place: a value is removed, repeated, replaced, or there is one more."""
        result = copy.deepcopy(document)
        container, key = rng.choice(places(result))
        kind = rng.randrange(4)
        if kind == 0:
            del container[key]
        elif kind == 1 and isinstance(container, list):
            container.insert(key, copy.deepcopy(container[key]))
        elif kind == 2:
            result[rng.choice(self.keys)] = copy.deepcopy(rng.choice(self.odd))
        else:
            container[key] = copy.deepcopy(rng.choice(self.odd))
        return result

    def complaint(self, document: Json) -> str | None:
        """Return what the reader says against the document, None where it reads it."""
        try:
            self.read(document)
        except InvalidInput as error:
            return str(error)
        return None

    def accepts(self, document: Json) -> bool:
        """Tell whether the document is one that the schema allows."""
        return bool(jsonschema.Draft202012Validator(self.schema).is_valid(document))

    def check(self, document: Json) -> None:
        """What is read agrees with the schema; what is not read breaks it too, or a rule that its description tells besides."""
        said = self.complaint(document)
        agrees = self.accepts(document)
        assert agrees or said is not None, document
        assert not agrees or said is None or self.beside.search(said), (said, document)


def places(document: Json) -> list[tuple[Json, Any]]:
    """Return all containers in the document, each with each of its keys or indices."""
    keys = list(document) if isinstance(document, dict) else list(range(len(document))) if isinstance(document, list) else []
    return [(document, key) for key in keys] + [place for key in keys for place in places(document[key])]


def schema(name: str) -> Json:
    return json.loads(SCHEMAS.joinpath(f"{name}.schema.json").read_text("utf-8"))


KEYS = (*"AFCGBDnmp", "nu", "field", "H")
SYSTEMS = Agreement(read_system, schema("system"), re.compile(OF_SYSTEMS), KEYS, ODD)
OWN = ("s", "past", "u_filter", "v_filter", "w_filter")
EXPERIMENTS = Agreement(read_experiment, schema("experiment"), re.compile(OF_SYSTEMS + OF_EXPERIMENTS), (*KEYS, *OWN), (*ODD, *ODD_FILTERS))
ONE: Json = {"A": [["1"]], "F": [["1"]], "C": [["1"]], "G": [["1"]]}
INPUTS: Json = {"B": [["1"]], "D": [["1"]]}


def experiment(rng: Random) -> Json:
    """Return an experiment: A is a strict triangle with small eigenvalues on its diagonal, u has a one at lag 0."""
    n, m = rng.randrange(3), rng.randrange(3)
    p, nu, noise = rng.randint(1, 2), rng.randint(1, 2), rng.randint(1, 2)

    def block(height: int, width: int) -> Json:
        return [[rng.choice(["0", "1", "-1/2", 2]) for _ in range(width)] for _ in range(height)]

    def signal(channels: int, noise: int) -> Json:
        matrices = [block(channels, noise) for _ in range(rng.randint(1, 3))]
        return matrices if rng.random() < 0.5 else {"num": matrices, "den": rng.choice([["1"], ["1", "1/3"], [1, "0", "1/2"]])}

    A = [[rng.choice(["0", "1/2", "-1/3"]) if i == j else rng.choice(["0", "1"]) if i < j else "0" for j in range(n)] for i in range(n)]
    sizes = {"n": n, "m": m, "p": p, "nu": nu}
    document = {"A": A, "B": block(n, nu), "C": block(p, n), "D": block(p, nu), "F": block(n, m), "G": block(p, m), **sizes}
    document |= {"s": rng.randint(1, 5), "past": rng.randint(1, 5), "u_filter": signal(nu, noise), "v_filter": signal(m, noise)}
    numerator = document["u_filter"] if isinstance(document["u_filter"], list) else document["u_filter"]["num"]
    numerator[0][0][0] = "1"
    if rng.random() < 0.5:
        document["w_filter"] = signal(p, rng.randint(1, 2))
    return document if rng.random() < 0.5 else {**document, "field": "Q"}


def agree(of: Agreement, document: Json, rng: Random) -> None:
    """Check the document, and what three changes make of it."""
    of.check(document)
    for _ in range(3):
        document = of.changed(document, rng)
        of.check(document)


@settings(max_examples=examples(400))
@given(systems(), SEEDS)
@example({**ONE, **INPUTS, "B": [[]], "D": [[]]}, 0)
@example({"A": [[]], "F": [[]], "C": [[]], "G": [[]], "n": 0, "m": 0, "p": 0, **INPUTS, "B": [], "D": []}, 0)
def test_they_agree_on_systems(given: Json, seed: int) -> None:
    rng = Random(seed)
    agree(SYSTEMS, given if rng.random() < 0.7 else {**given, "B": given["A"], "D": given["C"], "nu": len(given["A"])}, rng)


@settings(max_examples=examples(400))
@given(SEEDS)
def test_they_agree_on_experiments(seed: int) -> None:
    rng = Random(seed)
    document = experiment(rng)
    assert EXPERIMENTS.complaint(document) is None
    agree(EXPERIMENTS, document, rng)


def test_the_changes_leave_and_make_all_cases() -> None:
    """Among changed documents are ones that both accept, that both refuse, and that the reader refuses by a rule besides the schema."""
    system: Json = {**ONE, **INPUTS, "field": {"minimal_polynomial": ["-2", "0", "1"]}}
    sources: list[tuple[Agreement, Callable[[Random], Json]]] = [(SYSTEMS, lambda rng: system), (EXPERIMENTS, experiment)]
    for of, drawn in sources:
        rng = Random(1)
        changed = [of.changed(drawn(rng), rng) for _ in range(300)]
        assert {(of.complaint(one) is None, of.accepts(one)) for one in changed} == {(True, True), (False, False), (False, True)}


WEAKER: dict[str, tuple[Agreement, int, tuple[str, ...]]] = {
    "system": (
        SYSTEMS,
        1,
        ("$defs/system/additionalProperties", "$defs/system/dependentRequired", "$defs/system/required", "$defs/system/allOf"),
    ),
    "experiment": (EXPERIMENTS, 2, ("additionalProperties", "required", "then")),
    "parts": (EXPERIMENTS, 2, ("$defs/block_rows/minimum", "$defs/matrices/minItems", "$defs/matrices/maxItems", "$defs/rational/anyOf")),
}


@pytest.mark.parametrize("name, place", [(name, place) for name, (_, _, rules) in WEAKER.items() for place in rules])
def test_a_schema_without_a_rule_is_noticed(name: str, place: str) -> None:
    """Some of many documents, changed once or twice, tell the schema from what is read."""
    of, changes, _ = WEAKER[name]
    weaker = copy.deepcopy(of.schema)
    *path, rule = place.split("/")
    del reduce(lambda part, key: part[key], path, weaker)[rule]
    weakened, rng = replace(of, schema=weaker), Random(2)
    with pytest.raises(AssertionError):
        for _ in range(2000):
            document = {**ONE, **INPUTS} if of is SYSTEMS else experiment(rng)
            for _ in range(changes):
                document = weakened.changed(document, rng)
            weakened.check(document)
