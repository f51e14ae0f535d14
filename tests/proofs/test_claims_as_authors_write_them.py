"""Claims as an author would write them, and get them wrong: what is answered, and what the message says."""

from __future__ import annotations

import time
from typing import Any

import pytest

import faultspace as fs
from faultspace.base.errors import InvalidInput
from tests.thorough import every

ZERO_TO_ONE = {"n": [0, 1], "m": [0, 1], "p": [0, 1], "total": 2}
REFUSED: list[tuple[str, str, str]] = [
    ("lag = n", "system", "; == compares"),
    ("lag <= 0.5", "system", "expected an integer; multiply the comparison by the denominators"),
    ("lag <= n / 2", "system", "expected one of + - * // % @; // rounds down"),
    ("lag <= n ** 2", "system", "power(A, k) is that of a matrix"),
    ("first.lag <= 1", "system", "got 'first.lag', a word of claims about a pair, expected one of those about a system"),
    ("inputs.lag <= 1", "pair", "a word of claims about a record, expected one of those about a pair"),
    ("lag <= 1", "pair", "expected first.lag or second.lag"),
    ("observable == controllable", "system", "iff(a, b) compares words"),
    ("A @ F == zeros(n, m)", "system", "is_zero(X - Y) compares matrices"),
    ("lag <= n <= left_minimal_indices", "system", "which is an integer <= a list of integers"),
    ("rank_O <= n", "system", "expected rank_O(s), s a number of samples"),
    ("not lag", "system", "which is an integer, expected true or false"),
    ("all(gap(n) == m for n in windows(3))", "system", "got n as the name of a window, which is taken"),
    ("all(gap(s) == m for s in range(3))", "system", "expected all(E for s in windows(a, b))"),
    ("all(all(gap(t) == gap(s) for t in windows(s)) for s in windows(n))", "system", "give windows an end"),
    ("all(rank_OT(s * 2) >= s for s in windows(0))", "system", "expected s, s + c or s - c"),
    ("all(rank_OT(s + s) >= s for s in windows(0))", "system", "expected s, s + c or s - c"),
    ("all(rank_OT(n - s) >= 0 for s in windows(0))", "system", "expected s, s + c or s - c"),
    (
        "gap(n - 2) == 0",
        "system",
        "got -1 as the number of samples in gap(n - 2), expected an integer >= 0; guard it with implies(CONDITION, ...)",
    ),
    ("delay_known - delay_unknown <= 0", "system", "of inf and inf"),
    ("n // (m - 1) <= n", "system", "guard it against a divisor 0"),
    ("rank(power(A, 100)) <= n", "system", "expected 0 to 64"),
]


@pytest.mark.parametrize(("text", "about", "words"), REFUSED)
def test_a_claim_that_is_wrong_is_refused_with_what_helps(text: str, about: str, words: str) -> None:
    with pytest.raises(InvalidInput) as error:
        fs.claim(text, about=about, box={"total": 3}, ablation=False)
    assert words in str(error.value) and "\n" not in str(error.value)


DECIDED: list[tuple[str, list[str], dict[str, Any], str]] = [
    ("False", ["n == 1", "n == 2"], {"total": 3}, "VACUOUS"),
    ("True", ["False"], {"total": 3}, "VACUOUS"),
    ("all(any(gap(t) == m for t in windows(s, s + n)) for s in windows(0, n))", ["left_invertible"], {"total": 3}, "NOT REFUTED"),
    ("least(s for s in windows(0) if gap(s) == 99) == inf", [], {"total": 3}, "NOT REFUTED"),
    ("delay_known <= n", [], {"total": 3}, "REFUTED"),
    ("rank_T(1) == rank(G) and rank_O(1) == rank(C) and rank_OT(1) == rank(hstack(C, G))", [], ZERO_TO_ONE, "NOT REFUTED"),
    ("solutions(0) == n + p and rank_OT(0) == 0", [], ZERO_TO_ONE, "NOT REFUTED"),
    ("stable", ["nilpotent(A)"], ZERO_TO_ONE, "NOT REFUTED"),
    ("implies(m == 0, left_invertible and delay_known == 0)", [], ZERO_TO_ONE, "NOT REFUTED"),
    ("implies(p == 0, n_z == n)", [], ZERO_TO_ONE, "PROVED"),
    ("lag <= n", [], {"n": [0, 0], "m": [0, 0], "p": [0, 0], "total": 0}, "PROVED"),
    ("lag < n", [], {"n": [0, 0], "m": [0, 0], "p": [0, 0], "total": 0}, "REFUTED"),
]


@pytest.mark.parametrize(("conclusion", "hypotheses", "box", "verdict"), DECIDED[:: every()])
def test_a_claim_is_answered(conclusion: str, hypotheses: list[str], box: dict[str, Any], verdict: str) -> None:
    assert fs.claim(conclusion, hypotheses=hypotheses, box=box, ablation=False).answers[0].verdict == verdict


@pytest.mark.parametrize("about", ["system", *(pytest.param(one, marks=pytest.mark.slow) for one in ("pair", "record"))])
def test_a_box_far_too_large_is_left_out_at_once(about: str) -> None:
    """There are 8! 2^8 ways to renumber eight states and change their signs: a minute and gigabytes, if they were listed."""
    started = time.process_time()
    box = {"n": [8, 8], "m": [0, 8], "p": [0, 0], "total": 16}
    found = fs.claim("False", hypotheses=["False"], about=about, box=box, ablation=False).answers[0]
    assert found.tried.systems == 0 and not found.tried.exhausted and time.process_time() - started < 20


def test_a_box_with_one_entry_and_many_states_has_one_system_of_each_size() -> None:
    found = fs.claim(
        "lag == 0 and n_z == n", box={"n": [8, 8], "m": [1, 1], "p": [0, 0], "total": 9, "entries": [0]}, ablation=False
    ).answers[0]
    assert found.tried.systems == 1 and found.tried.met == 1
