"""Why a number of faults is what it is: codes with numbers decide, and words are made of them last."""

from __future__ import annotations

import json
from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest

import faultspace as fs
from faultspace.numeric import StateSpaceModel
from faultspace.numeric.plant.steps.findings import Answer, Because, Count, CountedBy, Reason
from faultspace.numeric.plant.steps.words import _CLAUSES, said

PLANT = StateSpaceModel([[0.7, 0.2], [-0.1, 0.5]], [[1.0], [0.5]], [[1.0, 0.0], [0.3, 1.0]], [[0.0], [0.0]])
NUMBERS: dict[str, Any] = {
    **{"n_v": 1, "counted": None, "possible": [0, 1], "outputs": ["a{b}"], "sizes": [1.0], "constant_hidden_by": "means", "p": 3},
    **{"independent": 2, "deviations": 5.0, "news": 1, "laws": 2, "rows": [{"kind": "k", "channel": "{c}", "experiment": 2, "told": "t"}]},
    **{"kind": "k", "channel": "{c}", "experiment": None},
}


def test_every_code_has_words_that_go_on_from_those_before() -> None:
    assert set(_CLAUSES) == set(Because)
    sentences = {code: said([Reason(Because.RANKS, said="BEFORE"), Reason(code, NUMBERS, "OWN")]) for code in Because}
    assert len(set(sentences.values())) == len(Because) - 2  # a way of counting says what its own record says
    assert {code for code, words in sentences.items() if "BEFORE" not in words} == {
        *(Because.EXPLAINED, Because.RANKS, Because.LAWS, Because.AGAINST_HEALTHY, Because.UNEQUAL_NUMBERS)
    }
    assert "a{b}" in sentences[Because.SPIKES] and "{c} in experiment 2: t" in sentences[Because.CHANGED]


def test_a_count_left_open_keeps_its_reasons() -> None:
    count = Count(1, (), CountedBy.LAWS, (Reason(Because.LAWS),))
    left = count.but(Reason(Because.MEAN_OPEN), (0, 1))
    assert (left.n_v, left.possible, left.by) == (None, (0, 1), None) and left.because[0].code == Because.LAWS
    assert count.also(Reason(Because.MEAN_STAYED)).n_v == 1 and left.but(Reason(Because.SPIKES)).possible == (0, 1)


@pytest.mark.parametrize(
    ("options", "codes", "by"),
    [
        ({"healthy": 300}, ["against_healthy", "unlike_healthy", "mean_moved"], None),
        ({"n_v": 1, "healthy": 300}, ["against_healthy", "unlike_healthy", "mean_moved", "given"], "given"),
        ({"healthy": 300, "noise": 0.0}, ["ranks", "unexplained"], None),
    ],
)
def test_the_codes_of_a_constant_fault(options: dict[str, Any], codes: list[str], by: str | None) -> None:
    draw, noise = np.random.default_rng(1), options.pop("noise", 0.02)
    u, v = draw.standard_normal((900, 1)), np.repeat([0.0, 0.5], [300, 600])[:, None]
    y = PLANT.simulate(u) + v * [[1.0, 0.3]] + noise * draw.standard_normal((900, 2))
    found = fs.identify(y, u, order=2, **options)
    document = found.to_json()
    told = [one["code"] for one in document["n_v_because"]]
    assert [code for code in told if code != "changed"] == codes and document["n_v_from"] == by
    assert document["n_v_reason"] == said(found.because) and json.dumps(document["n_v_because"])
    if "mean_moved" in codes:
        assert document["n_v_because"][codes.index("mean_moved")]["outputs"] == ["y1", "y2"]


def test_an_answer_is_complete_when_it_is_made() -> None:
    assert [one.name for one in fields(Answer) if one.default is not one.default_factory] == []
    found = fs.identify(PLANT.simulate(u := np.random.default_rng(1).standard_normal((400, 1))), u)
    assert [reason.code for reason in found.because] == [Because.EXPLAINED] and found.counted_by == "model"
    assert replace(found, n_v=None, possible=(1, 2)).at_least == 1


def test_laws_are_explained_where_they_are_spoken_of_and_not_for_rows_of_the_table_of_changes() -> None:
    draw = np.random.default_rng(21)
    u = draw.standard_normal((300, 1))
    y = PLANT.simulate(u) + 0.01 * draw.standard_normal((300, 2))
    y[290:] += draw.standard_normal((10, 2)) * [3.0, 2.0] + 2.0
    few = fs.identify(y, u, healthy=290)
    assert few.count is None and " more)" in few.reason and "law, or row" not in few.summary()
    assert "law, or row" in fs.identify(y[:290], u[:290]).summary()
