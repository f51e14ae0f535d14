"""The reader of experiments and the schema that ships beside it accept the same documents, drawn at random and changed in a few places.

As for systems (`test_reader_and_schema.py`), a schema cannot say everything: what it leaves to the reader is in its description, and BESIDE
has the reader's words for it.

BESIDE          what the reader says where the schema alone would accept
ODD             values that are put in the place of others, beside those of systems
experiment      a document that both accept, from a seed
EXPERIMENTS     the reader and the schema, held together
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
from hypothesis import given, settings

from faultspace.exact import read_experiment
from tests.exact import test_reader_and_schema as of_systems
from tests.exact.documents import Agreement
from tests.oracle.strategies import SEEDS
from tests.thorough import examples

Json = Any
SCHEMA = json.loads(resources.files("faultspace.exact").joinpath("schemas", "experiment.schema.json").read_text("utf-8"))
BESIDE = re.compile(
    of_systems.BESIDE.pattern + r"|got \d+ rows?, expected"
    r"|got matrices with \d+ columns?, expected"
    r"|got no input, expected one|got no output, expected one"
    r"|got eigenvalues on or outside the unit circle"
    r"|got an unstable denominator|den\[0\]: got"
    r"|identically zero"
    r"|got windows of|states of system and filters"
)
ODD: tuple[Json, ...] = (
    *of_systems.ODD,
    *([[["1"]]], [[["1"]], [["1/2"]]], [[["1", "0"]]], [[[]]], [["1"], ["0"]], 2048, 2049, 257),
    *(
        {"num": [[["1"]]], "den": ["1", "-1/2"]},
        {"num": [[["1"]]], "den": ["2"]},
        {"num": [[["1"]]], "den": ["1", "2"]},
        {"num": [[["1"]]]},
    ),
    *({"num": [], "den": ["1"]}, {"num": [[["1"]]], "den": []}, {"num": [[["1"]]], "den": ["1", "0"]}, {"num": "1", "den": "1"}),
    *([[["1"]]] * 257, [[["0"]]] * 258, {"num": [[["1"]]], "den": ["1"] + ["0"] * 257}),
)
KEYS = (*"AFCGBDnmp", "nu", "field", "s", "past", "u_filter", "v_filter", "w_filter", "H")
EXPERIMENTS = Agreement(read_experiment, SCHEMA, BESIDE, KEYS, ODD)


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


@settings(max_examples=examples(400))
@given(SEEDS)
def test_they_agree(seed: int) -> None:
    rng = Random(seed)
    document = experiment(rng)
    assert EXPERIMENTS.complaint(document) is None
    EXPERIMENTS.check(document)
    for _ in range(3):
        document = EXPERIMENTS.changed(document, rng)
        EXPERIMENTS.check(document)


def test_the_changes_leave_and_make_all_cases() -> None:
    """Among changed documents are ones that both accept, that both refuse, and that the reader refuses by a rule besides the schema."""
    rng = Random(1)
    seen = {
        (EXPERIMENTS.complaint(one) is None, EXPERIMENTS.accepts(one))
        for one in (EXPERIMENTS.changed(experiment(rng), rng) for _ in range(300))
    }
    assert seen == {(True, True), (False, False), (False, True)}


@pytest.mark.parametrize("rule", ["additionalProperties", "required", "then"])
def test_a_schema_without_a_rule_is_noticed(rule: str) -> None:
    weaker = copy.deepcopy(SCHEMA)
    del weaker[rule]
    tell_apart(weaker)


@pytest.mark.parametrize(
    "part, rule", [("block_rows", "minimum"), ("matrices", "minItems"), ("matrices", "maxItems"), ("rational", "anyOf")]
)
def test_a_part_of_the_schema_without_a_rule_is_noticed(part: str, rule: str) -> None:
    weaker = copy.deepcopy(SCHEMA)
    del weaker["$defs"][part][rule]
    tell_apart(weaker)


def tell_apart(schema: Json) -> None:
    """Some of many changed documents tell the schema from what is read."""
    weakened = replace(EXPERIMENTS, schema=schema)
    rng = Random(2)
    with pytest.raises(AssertionError):
        for _ in range(2000):
            weakened.check(weakened.changed(weakened.changed(experiment(rng), rng), rng))
