"""The truth of statements is tested: true ones and false neighbours of every kind, planted structure, malformed ones."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from random import Random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.thorough import examples

from . import first_difference, limits, premise_holds, truth
from .families import SQRT2, Q, adversarial, paper_example, shift_register, system
from .fields import Element, Field, PrimeField
from .linear import Matrix, matrix
from .quantities import is_left_invertible
from .statements import KINDS
from .strategies import planted_systems, system_pairs, systems
from .structured import Structure
from .systems import parse_system, write_system

FEW = settings(max_examples=examples(40), deadline=None)
RATIONALS = st.fractions(-2, 2, max_denominator=6)
NAMED = adversarial(Q)
PAPER = paper_example()
SEEN = NAMED["a0-fault-and-state-seen"]
DOUBLED = NAMED["a0-fault-and-doubled-state-seen"]
TWICE = NAMED["not-left-invertible-same-column-twice"]
UNSEEN = NAMED["unobservable"]
LINE = NAMED["delay-line-3"]
NOTHING = NAMED["nothing"]
BLIND = NAMED["no-output"]
# The same system with one fault less: nothing is left but its free motion.
QUIET = system(Q, [[0]], [[]], [[1], [0]], [[], []], n=1, p=2, m=0)
# [F; 0] and [0; C F], where F = (1, a, a^2).
PAPER_BASIS: list[list[Any]] = [[1, ["0", "1", "0"], ["0", "0", "1"], 0, 0], [0, 0, 0, 1, ["0", "1", "0"]]]
ALL_OF_K3 = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
WALK = {"x0": [1], "v": [["1"], ["0"], ["1"], ["1"]], "system": SEEN}


def moved(a: list[list[Any]], field: Any = Q) -> Any:
    """The result is a system of that A and nothing else."""
    n = len(a)
    return {"A": a, "F": [[]] * n, "C": [], "G": [], "n": n, "m": 0, "p": 0, "field": field}


def diagonal(field: Field, size: int, x: Element) -> Matrix:
    """The result is x times the identity."""
    return matrix(field, size, size, [[x if i == j else field.zero for j in range(size)] for i in range(size)])


def static(g: list[list[int]], field: Any = Q) -> Any:
    """The system is r = G v."""
    return system(field, [], [], [[]] * len(g), g, n=0, p=len(g), m=len(g[0]))


def fed(f: list[list[int]], g: list[list[int]], a: int = 0) -> Any:
    """The system is x+ = a x + F v, r = (x, 0) + G v."""
    return system(Q, [[a]], f, [[1], [0]], g, n=1, p=2, m=len(f[0]))


def driven(**changes: Any) -> dict[str, Any]:
    """The experiment is x+ = x / 2 + u + v, y = x + v with v(k) = u(k+1) white, two samples of either side."""
    data = {"A": [["1/2"]], "B": [[1]], "C": [[1]], "D": [[0]], "F": [[1]], "G": [[1]], "s": 2, "past": 2}
    return {**data, "u_filter": [[[0]], [[1]]], "v_filter": [[[1]]], **changes}


def ranks(limit: int, seen: int, joint: int, instruments: str = "past-inputs", **changes: Any) -> dict[str, Any]:
    """The result is the statement of a moesp-limit."""
    stated = {"instruments": instruments, "limit_rank": limit, "observability_rank": seen, "joint_rank": joint}
    return {"experiment": driven(**changes), **stated}


def inputs(regression: str, b: object, d: object, **changes: Any) -> dict[str, Any]:
    """The result is the statement of an input-limit for one input, state and output."""
    return {"experiment": driven(**changes), "regression": regression, "B": [[b]], "D": [[d]]}


NOT_LED: dict[str, Any] = {"u_filter": [[[1]]], "v_filter": [[[0]], [[1]]]}  # v(k) = u(k-1)
ALONE: dict[str, Any] = {"u_filter": [[["1", "0"]], [["1/2", "0"]]], "v_filter": [[["0", "1"]]]}  # v independent of u
LASTING: dict[str, Any] = {"v_filter": {"num": [[["0", "1"]]], "den": ["1", "-1/2"]}}
NOISY: dict[str, Any] = {"w_filter": {"num": [[["1"]], [["2"]]], "den": ["1", "-1/3"]}}

CASES: list[tuple[str, dict[str, Any], bool]] = [
    ("window-ranks", {"system": PAPER, "normal_rank": 1, "left_minimal_indices": [2]}, True),
    ("window-ranks", {"system": PAPER, "normal_rank": 1, "left_minimal_indices": [3]}, False),
    ("window-ranks", {"system": PAPER, "normal_rank": 2, "left_minimal_indices": []}, False),
    ("window-ranks", {"system": PAPER, "normal_rank": 1, "left_minimal_indices": [0, 2]}, False),
    ("window-ranks", {"system": PAPER, "normal_rank": 1, "left_minimal_indices": [1000]}, False),
    # On windows of less than a thousand samples the index stands in for the rank.
    ("window-ranks", {"system": UNSEEN, "normal_rank": 0, "left_minimal_indices": [1000]}, False),
    ("window-ranks", {"system": BLIND, "normal_rank": 0, "left_minimal_indices": []}, True),
    ("window-ranks", {"system": NOTHING, "normal_rank": 0, "left_minimal_indices": [], "window_ranks": [0] * 9}, True),
    ("left-invertible", {"system": PAPER}, True),
    ("left-invertible", {"system": TWICE}, False),
    ("left-invertible", {"system": QUIET}, True),
    # r = (a v, b v); (a + b, a - b), where a = b is bad modulo 2; nothing at (1 : -1), (0 : 1), (1 : 0).
    ("left-invertible-line", {"first": static([[1], [0]]), "second": static([[0], [1]])}, True),
    ("left-invertible-line", {"first": static([[1], [1]]), "second": static([[1], [-1]])}, True),
    ("left-invertible-line", {"first": static([[1], [1]], {"prime": 2}), "second": static([[1], [-1]], {"prime": 2})}, False),
    ("left-invertible-line", {"first": static([[1], [0]]), "second": static([[1], [0]])}, False),
    ("left-invertible-line", {"first": static([[1], [0]]), "second": static([[0], [0]])}, False),
    ("left-invertible-line", {"first": static([[0], [0]]), "second": static([[1], [0]])}, False),
    # a^2 - 2 b^2 has zeros over an extension, no minors but a^2, a b, b^2 have.
    ("left-invertible-line", {"first": static([[1, 0], [0, 1]]), "second": static([[0, 2], [1, 0]])}, False),
    (
        "left-invertible-line",
        {"first": static([[1, 0], [0, 1], [0, 0]]), "second": static([[0, 0], [1, 0], [0, 1]])},
        True,
    ),
    # x+ = (a + b) v seen beside a v; x+ = (a + 2 b) v; x+ = x + (a - b) v seen on top of b v.
    ("left-invertible-line", {"first": fed([[1]], [[0], [1]]), "second": fed([[1]], [[0], [0]])}, True),
    ("left-invertible-line", {"first": fed([[1]], [[0], [0]]), "second": fed([[2]], [[0], [0]])}, False),
    ("left-invertible-line", {"first": fed([[1]], [[0], [0]], 1), "second": fed([[-1]], [[1], [0]], 1)}, True),
    ("left-invertible-line", {"first": QUIET, "second": QUIET}, True),
    ("left-invertible-line", {"first": UNSEEN, "second": UNSEEN}, False),
    ("left-invertible-line", {"first": NOTHING, "second": NOTHING}, True),
    ("left-invertible-line", {"first": BLIND, "second": BLIND}, False),
    ("schur-stable", {"system": NOTHING}, True),
    ("schur-stable", {"system": LINE}, True),
    ("schur-stable", {"system": UNSEEN}, False),
    ("schur-stable", {"system": moved([["-1"]])}, False),
    ("schur-stable", {"system": moved([["999/1000"]])}, True),
    ("schur-stable", {"system": moved([["1/2", 0], [0, "-1001/1000"]])}, False),
    ("schur-stable", {"system": moved([["3/5", "-4/5"], ["4/5", "3/5"]])}, False),
    ("schur-stable", {"system": moved([["3/5", "-3/4"], ["3/4", "3/5"]])}, True),
    ("schur-stable", {"system": moved([[0, 1, 0], [0, 0, 1], ["-1/2", 0, 0]])}, True),
    ("schur-stable", {"system": moved([[0, 1, 0], [0, 0, 1], [-1, 0, 0]])}, False),
    # 1/2 sqrt 2 and its conjugate are inside; 1 - sqrt 2 is, and its conjugate 1 + sqrt 2 is not.
    ("schur-stable", {"system": moved([[["0", "1/2"]]], SQRT2)}, True),
    ("schur-stable", {"system": moved([[["1", "-1"]]], SQRT2)}, False),
    # v(k) = u(k+1): y sees B + A F, D + C F beside a v that u does not explain; from v(k) = u(k-1) a second rank.
    ("moesp-limit", ranks(1, 1, 1), True),
    ("moesp-limit", ranks(1, 1, 2), False),
    ("moesp-limit", ranks(2, 1, 2, **NOT_LED), True),
    ("moesp-limit", ranks(1, 1, 1, **NOT_LED), False),
    ("moesp-limit", ranks(1, 1, 1, **ALONE), True),
    # White v is in Yp and not in Yf, but by the state; coloured v is in both.
    ("moesp-limit", ranks(1, 1, 1, "past-inputs-and-outputs", **ALONE), True),
    ("moesp-limit", ranks(2, 1, 2, "past-inputs-and-outputs", **{**ALONE, **LASTING}), True),
    ("moesp-limit", ranks(1, 1, 1, **{**ALONE, **LASTING}), True),
    # So is w.
    ("moesp-limit", ranks(1, 1, 1, "past-inputs-and-outputs", w_filter=[[["3"]]]), True),
    ("moesp-limit", ranks(2, 1, 2, "past-inputs-and-outputs", **NOISY), True),
    ("moesp-limit", ranks(1, 1, 1, **NOISY), True),
    # B + A F = 0: nothing of the state is seen, although (A, B) is controllable.
    ("moesp-limit", ranks(0, 1, 1, B=[["-1/2"]]), True),
    ("moesp-limit", ranks(1, 1, 1, B=[["-1/2"]]), False),
    # Unstable, and an input that is its own past.
    ("moesp-limit", ranks(1, 1, 1, A=[[1]]), False),
    ("moesp-limit", ranks(0, 1, 1, u_filter=[[[0]]]), False),
    ("moesp-limit", ranks(1, 1, 1, v_filter={"num": [[[1]]], "den": [1, -1]}), False),
    ("input-limit", inputs("true-AC", "3/2", 1), True),
    ("input-limit", inputs("true-AC", 1, 0), False),
    # v(k) = u(k+1) in y(k) is right of the diagonal, where no T_s(B, D) has anything.
    ("input-limit", inputs("moesp", "3/2", 1, G=[[0]]), True),
    ("input-limit", inputs("moesp", "3/2", 1), False),
    ("input-limit", inputs("moesp", 1, 0), False),
    ("input-limit", inputs("true-AC", 1, 0, **ALONE, **NOISY), True),
    ("input-limit", inputs("moesp", 1, 0, **ALONE, **NOISY), True),
    # y(k) = x(k) + u(k-1): beside x, G(q) = b / (q - 1/2) makes q^-1 of b = 1 and of what follows nothing.
    ("input-limit", inputs("true-AC", "7/4", 0, **NOT_LED, F=[[0]]), True),
    ("input-limit", inputs("true-AC", 2, 0, **NOT_LED, F=[[0]]), False),
    # One sample sees no B; nor does C = 0, nor a u that is zero.
    ("input-limit", inputs("moesp", "3/2", 1, s=1), False),
    ("input-limit", inputs("true-AC", "3/2", 1, s=1), True),
    ("input-limit", inputs("true-AC", 1, 1, C=[[0]]), False),
    ("input-limit", inputs("true-AC", 1, 0, u_filter=[[[0]]]), False),
    ("input-limit", inputs("moesp", 1, 0, u_filter=[[[0]]]), False),
    ("input-limit", inputs("true-AC", 1, 0, A=[["-3/2"]]), False),
    ("not-left-invertible", {"system": BLIND}, True),
    ("not-left-invertible", {"system": UNSEEN}, False),
    ("inversion-delay", {"system": LINE, "initial_state": "known", "delay": 3}, True),
    ("inversion-delay", {"system": LINE, "initial_state": "unknown", "delay": 3}, True),
    ("inversion-delay", {"system": LINE, "initial_state": "known", "delay": 2}, False),
    ("inversion-delay", {"system": LINE, "initial_state": "known", "delay": 4}, False),
    ("inversion-delay", {"system": LINE, "initial_state": "known", "delay": None}, False),
    ("inversion-delay", {"system": TWICE, "initial_state": "known", "delay": None}, True),
    ("inversion-delay", {"system": QUIET, "initial_state": "unknown", "delay": 0}, True),
    ("behaviour-inclusion", {"inner": QUIET, "outer": SEEN}, True),
    ("behaviour-inclusion", {"inner": SEEN, "outer": QUIET}, False),
    ("behaviour-inclusion", {"inner": SEEN, "outer": DOUBLED}, False),
    ("behaviour-equality", {"first": SEEN, "second": SEEN}, True),
    ("behaviour-equality", {"first": SEEN, "second": QUIET}, False),
    ("behaviour-equality", {"first": QUIET, "second": SEEN}, False),
    ("window-equality", {"first": SEEN, "second": DOUBLED, "window": 0}, True),
    ("window-equality", {"first": SEEN, "second": DOUBLED, "window": 1}, True),
    ("window-equality", {"first": SEEN, "second": DOUBLED, "window": 2}, False),
    ("window-equality", {"first": SEEN, "second": DOUBLED, "window": 4096}, False),
    ("behaviour-difference", {"first": SEEN, "second": DOUBLED, "window": 1}, False),
    ("behaviour-difference", {"first": SEEN, "second": DOUBLED, "window": 2}, True),
    ("behaviour-difference", {"first": QUIET, "second": SEEN, "window": 5}, False),
    ("behaviour-difference", {"first": SEEN, "second": QUIET, "window": 1}, True),
    ("fault-space", {"system": SEEN, "window": 1, "basis": ALL_OF_K3}, True),
    ("fault-space", {"system": SEEN, "window": 2, "basis": [[1, 0, 1]]}, True),
    ("fault-space", {"system": SEEN, "window": None, "basis": [[1, 0, 1]]}, True),
    ("fault-space", {"system": SEEN, "window": None, "basis": [[2, 0, 2]]}, False),
    ("fault-space", {"system": SEEN, "window": None, "basis": []}, False),
    ("fault-space", {"system": SEEN, "window": None, "basis": [[1, 0, 1], [0, 0, 0]]}, False),
    ("fault-space", {"system": SEEN, "window": 2, "basis": ALL_OF_K3}, False),
    ("fault-space", {"system": NOTHING, "window": None, "basis": []}, True),
    ("fault-space", {"system": NOTHING, "window": None, "basis": [[]]}, False),
    ("fault-space", {"system": BLIND, "window": None, "basis": [["1"]]}, True),
    ("first-column-only", {"system": SEEN, "window": 2, "column": [0, 1, 0]}, True),
    ("first-column-only", {"system": SEEN, "window": 1, "column": [0, 1, 0]}, False),
    ("first-column-only", {"system": SEEN, "window": 2, "column": [1, 0, 1]}, False),
    ("first-column-only", {"system": SEEN, "window": 2, "column": [1, 0, 0]}, False),
    ("first-column-only", {"system": SEEN, "window": 0, "column": [0, 1, 0]}, False),
    ("matrix-rank", {"matrix": "observability", "system": UNSEEN, "rank": 0}, True),
    ("matrix-rank", {"matrix": "observability", "system": PAPER, "rank": 3}, True),
    ("matrix-rank", {"matrix": "reachability", "system": PAPER, "rank": 1}, True),
    ("matrix-rank", {"matrix": "reachability", "system": LINE, "rank": 1}, False),
    ("matrix-rank", {"matrix": "toeplitz", "system": LINE, "window": 5, "rank": 2}, True),
    ("matrix-rank", {"matrix": "window", "system": LINE, "window": 5, "rank": 5}, True),
    ("matrix-rank", {"matrix": "window", "system": PAPER, "window": 3, "rank": 6}, False),
    ("matrix-rank", {"matrix": "excitation", "rank": 3, "window": 2, **WALK}, True),
    ("matrix-rank", {"matrix": "residual-hankel", "rank": 3, "window": 2, **WALK}, True),
    ("matrix-rank", {"matrix": "residual-hankel", "rank": 0, "window": 9, **WALK}, True),
    ("finite-zeros", {"system": UNSEEN, "normal_rank": 1, "invariant_zero_polynomial": [-1, 1]}, True),
    ("finite-zeros", {"system": UNSEEN, "normal_rank": 1, "invariant_zero_polynomial": [-2, 2]}, False),
    ("finite-zeros", {"system": UNSEEN, "normal_rank": 0, "invariant_zero_polynomial": [-1, 1]}, False),
    ("finite-zeros", {"system": UNSEEN, "normal_rank": 1, "invariant_zero_polynomial": []}, False),
    ("finite-zeros", {"system": PAPER, "normal_rank": 1, "invariant_zero_polynomial": [["1", 0, 0]]}, True),
    ("finite-zeros", {"system": NOTHING, "normal_rank": 0, "invariant_zero_polynomial": [1]}, True),
    ("infinite-zeros", {"system": PAPER, "infinite_zero_orders": [1]}, True),
    ("infinite-zeros", {"system": LINE, "infinite_zero_orders": [3]}, True),
    ("infinite-zeros", {"system": LINE, "infinite_zero_orders": [0, 3]}, False),
    ("infinite-zeros", {"system": UNSEEN, "infinite_zero_orders": [0]}, True),
    ("infinite-zeros", {"system": UNSEEN, "infinite_zero_orders": []}, False),
]

MALFORMED: list[tuple[str, Any]] = [
    ("no-such-kind", {"system": SEEN}),
    ("left-invertible", None),
    ("left-invertible", {}),
    ("left-invertible", {"system": SEEN, "window": 2}),
    ("left-invertible", {"system": {**SEEN, "n": 2}}),
    ("window-ranks", {"system": PAPER, "normal_rank": -1, "left_minimal_indices": []}),
    ("window-ranks", {"system": PAPER, "normal_rank": 1, "left_minimal_indices": [2, 1]}),
    ("window-ranks", {"system": PAPER, "normal_rank": 1, "left_minimal_indices": 2}),
    ("window-ranks", {"system": PAPER, "normal_rank": 1, "left_minimal_indices": [2], "window_ranks": ["2"]}),
    ("left-invertible-line", {"first": SEEN}),
    ("left-invertible-line", {"first": SEEN, "second": SEEN, "window": 1}),
    ("left-invertible-line", {"first": SEEN, "second": QUIET}),
    ("left-invertible-line", {"first": SEEN, "second": {**SEEN, "A": [[1]]}}),
    ("left-invertible-line", {"first": SEEN, "second": {**SEEN, "C": [[1], [1]]}}),
    ("schur-stable", {"system": shift_register({"prime": 2}, 1)}),
    ("schur-stable", {"system": SEEN, "radius": 1}),
    ("moesp-limit", ranks(1, 1, -1)),
    ("moesp-limit", ranks(1, 1, 1, "past-outputs")),
    ("moesp-limit", ranks(1, 1, 1, s=0)),
    ("moesp-limit", ranks(1, 1, 1, past=4097)),
    ("moesp-limit", ranks(1, 1, 1, seed=1)),
    ("moesp-limit", ranks(1, 1, 1, field=SQRT2)),
    ("moesp-limit", ranks(1, 1, 1, field={"prime": 3}, A=[[0]])),
    ("moesp-limit", ranks(1, 1, 1, u_filter=[])),
    ("moesp-limit", ranks(1, 1, 1, v_filter=[[[1, 1]]])),
    ("moesp-limit", ranks(1, 1, 1, v_filter={"num": [[[1]]], "den": [2]})),
    ("moesp-limit", ranks(1, 1, 1, B=[[]], D=[[]], n=1, m=1, p=1, nu=0)),
    ("input-limit", inputs("least squares", 1, 0)),
    ("input-limit", {**inputs("moesp", 1, 0), "B": [[1, 1]]}),
    ("inversion-delay", {"system": LINE, "initial_state": "free", "delay": 3}),
    ("inversion-delay", {"system": LINE, "initial_state": "known"}),
    ("inversion-delay", {"system": LINE, "initial_state": "known", "delay": "3"}),
    ("behaviour-inclusion", {"inner": SEEN, "outer": UNSEEN}),
    ("behaviour-equality", {"first": SEEN, "second": shift_register({"prime": 2}, 1)}),
    ("behaviour-equality", {"first": SEEN, "second": SEEN, "window": 1}),
    ("window-equality", {"first": SEEN, "second": SEEN}),
    ("window-equality", {"first": SEEN, "second": SEEN, "window": 4097}),
    ("behaviour-difference", {"first": SEEN, "second": SEEN, "window": True}),
    ("fault-space", {"system": SEEN, "window": 1, "basis": [[1, 0]]}),
    ("fault-space", {"system": SEEN, "window": -1, "basis": []}),
    ("fault-space", {"system": SEEN, "basis": []}),
    ("first-column-only", {"system": SEEN, "window": 2, "column": [0, 1]}),
    ("matrix-rank", {"matrix": "hankel", "system": SEEN, "rank": 1}),
    ("matrix-rank", {"matrix": ["window"], "system": SEEN, "rank": 1}),
    ("matrix-rank", {"matrix": "window", "system": SEEN, "rank": 1}),
    ("matrix-rank", {"matrix": "observability", "system": SEEN, "rank": 1, "window": 1}),
    ("matrix-rank", {"matrix": "excitation", "rank": 3, "window": 2, **WALK, "v": [["1", "1"]]}),
    ("finite-zeros", {"system": SEEN, "normal_rank": 1, "invariant_zero_polynomial": "1"}),
    ("finite-zeros", {"system": SEEN, "normal_rank": 1, "invariant_zero_polynomial": ["q"]}),
    ("infinite-zeros", {"system": SEEN, "infinite_zero_orders": [1, 0]}),
]


def test_known_truths() -> None:
    wrong = [one for one in CASES if truth(*one[:2]) is not one[2] or not premise_holds(*one[:2])]
    assert wrong == []


@pytest.mark.parametrize("window, holds", [(None, True), (3, True), (9, True), (2, False), (1, False)])
def test_the_basis_of_the_example(window: int | None, holds: bool) -> None:
    def claimed(basis: list[list[Any]]) -> bool:
        return truth("fault-space", {"system": PAPER, "window": window, "basis": basis})

    assert claimed(PAPER_BASIS) == holds
    first, second = PAPER_BASIS
    # The same span in other bases, part of it, and another span.
    assert not claimed([second, first])
    assert not claimed([[1, *first[1:3], 1, second[4]], second])
    assert not claimed([first])
    assert not claimed([first, [0, 0, 0, 1, ["0", "1", "1"]]])


def test_every_kind_has_a_true_and_a_false_case() -> None:
    for kind in KINDS:
        assert {expected for k, _, expected in CASES if k == kind} >= {True, False}


def test_malformed_statements() -> None:
    for kind, statement in MALFORMED:
        with pytest.raises(ValueError):
            pytest.fail(f"{kind} of {statement} is {truth(kind, statement)}")


def test_the_premise_is_that_the_polynomial_is_irreducible() -> None:
    over = {"field": {"minimal_polynomial": ["-1", "0", "1"]}}
    assert not premise_holds("left-invertible", {"system": {**SEEN, **over}})
    assert premise_holds("left-invertible", {"system": {**SEEN, "field": SQRT2}})


@FEW
@given(planted_systems())
def test_statements_about_planted_structure(case: tuple[Any, Structure]) -> None:
    json, structure = case
    field = parse_system(json).field
    r, left, infinite = structure.normal_rank, list(structure.left), list(structure.infinite)
    zeros = [field.write(c) for c in structure.zero_polynomial(field)]
    ranks = [s * r + sum(min(s, eta) for eta in left) for s in range(1, structure.n + 6)]
    about = {"system": json}
    indices = {**about, "normal_rank": r, "left_minimal_indices": left}
    assert truth("window-ranks", {**indices, "window_ranks": ranks})
    assert not truth("window-ranks", {**indices, "window_ranks": [*ranks, ranks[-1] + r + 1]})
    assert not truth("window-ranks", {**indices, "normal_rank": r + 1})
    assert truth("infinite-zeros", {**about, "infinite_zero_orders": infinite})
    assert not truth("infinite-zeros", {**about, "infinite_zero_orders": [*infinite, structure.n + 1]})
    assert truth("finite-zeros", {**about, "normal_rank": r, "invariant_zero_polynomial": zeros})
    assert not truth("finite-zeros", {**about, "normal_rank": r, "invariant_zero_polynomial": ["0", *zeros]})
    assert truth("left-invertible", about) == (r == structure.m) != truth("not-left-invertible", about)
    delay = max(infinite, default=0) if r == structure.m else None
    assert truth("inversion-delay", {**about, "initial_state": "known", "delay": delay})


@FEW
@given(systems())
def test_a_line_is_good_when_its_systems_are(json: Any) -> None:
    """Half of the faults stand against the other half, each (a : b) by itself; with one fault over GF(p), all of them decide."""
    whole = parse_system(json)
    field, k = whole.field, whole.m // 2
    halves = [replace(whole, F=whole.F.columns(i, i + k), G=whole.G.columns(i, i + k)) for i in (0, k)]
    combined = []
    for a, b in [(0, 1), *((1, b) for b in range(-2, 3))]:
        scaled = [diagonal(field, k, field.integer(c)) for c in (a, b)]
        F, G = ((getattr(halves[0], name) @ scaled[0]) + (getattr(halves[1], name) @ scaled[1]) for name in "FG")
        combined.append(is_left_invertible(replace(whole, F=F, G=G)))
    claimed = truth("left-invertible-line", {"first": write_system(halves[0]), "second": write_system(halves[1])})
    assert all(combined) or not claimed
    if k == 0 or (k == 1 and isinstance(field, PrimeField)):
        assert claimed == all(combined)


@given(st.lists(RATIONALS, max_size=3), st.lists(st.tuples(RATIONALS, RATIONALS), max_size=1))
def test_stability_by_construction(real: list[Fraction], pairs: list[tuple[Fraction, Fraction]]) -> None:
    """Blocks (x) and (x, -y; y, x), with something above the diagonal: eigenvalues of modulus |x| and sqrt(x^2 + y^2)."""
    n = len(real) + 2 * len(pairs)
    a = [[str(int(i < j and (i, j) != (0, 1))) for j in range(n)] for i in range(n)]
    for i, (x, y) in enumerate(pairs):
        for (row, column), value in zip(((0, 0), (0, 1), (1, 0), (1, 1)), (x, -y, y, x), strict=True):
            a[2 * i + row][2 * i + column] = str(value)
    for i, x in enumerate(real, start=2 * len(pairs)):
        a[i][i] = str(x)
    inside = all(abs(x) < 1 for x in real) and all(x * x + y * y < 1 for x, y in pairs)
    assert truth("schur-stable", {"system": moved(a)}) == inside


@FEW
@given(system_pairs())
def test_statements_about_pairs(pair: tuple[Any, Any]) -> None:
    both = {"first": pair[0], "second": pair[1]}
    swapped = {"first": pair[1], "second": pair[0]}
    difference = first_difference(*pair)
    assert truth("behaviour-equality", both) == (difference is None) == truth("behaviour-equality", swapped)
    inclusions = [truth("behaviour-inclusion", {"inner": b["first"], "outer": b["second"]}) for b in (both, swapped)]
    assert all(inclusions) == (difference is None)
    if difference is not None:
        assert truth("window-equality", {**both, "window": difference - 1})
        assert not truth("window-equality", {**both, "window": difference})
        found = [truth("behaviour-difference", {**b, "window": difference}) for b in (both, swapped)]
        assert any(found) and not any(found and kept for found, kept in zip(found, inclusions, strict=True))
        assert not truth("behaviour-difference", {**both, "window": difference - 1})


@FEW
@given(systems(), st.integers(0, 2**32))
def test_ranks_are_what_elimination_finds(json: Any, seed: int) -> None:
    """Exactly one rank is true of each matrix."""
    rng = Random(seed)
    n, p, m = json["n"], json["p"], json["m"]
    walk = {"x0": ["1"] * n, "v": [[rng.randint(-1, 1) for _ in range(m)] for _ in range(4)]}
    statements: list[dict[str, Any]] = [
        {"matrix": "observability"},
        {"matrix": "reachability"},
        {"matrix": "toeplitz", "window": 2},
        {"matrix": "window", "window": 2},
        {"matrix": "residual-hankel", "window": 2, **walk},
        {"matrix": "excitation", "window": 2, **walk},
    ]
    largest = n + 2 * (m + p)
    for about in statements:
        truths = [truth("matrix-rank", {**about, "system": json, "rank": k}) for k in range(largest + 1)]
        assert truths.count(True) == 1


@FEW
@given(st.integers(0, 2**32), st.booleans())
def test_covariances_are_sums_of_impulse_responses(seed: int, rational: bool) -> None:
    """With A nilpotent and no denominators the sums are finite; else they are summed until they have converged."""
    rng = Random(seed)

    def table(height: int, width: int) -> list[list[str]]:
        return [[rng.choice(["0", "1", "-1", "1/2"]) for _ in range(width)] for _ in range(height)]

    shapes = {"B": (2, 1), "C": (1, 2), "D": (1, 1), "F": (2, 1), "G": (1, 1)}
    json = driven(A=[["0", "1"], ["0", "1/3" if rational else "0"]], **{name: table(*shape) for name, shape in shapes.items()})
    json["u_filter"], json["v_filter"] = [table(1, 2) for _ in range(3)], [table(1, 2) for _ in range(2)]
    den = [Fraction(1)]
    if rational:
        den += [Fraction(1, 2), Fraction(-1, 4)]
        json["v_filter"] = {"num": json["v_filter"], "den": [str(d) for d in den]}
    e = limits.parse_experiment(json)
    length = 150 if rational else 8
    answers: dict[str, list[list[Fraction]]] = {"u": [], "y": []}  # the responses to an impulse of e_0 or of e_1 at time 0, by hand
    for channel in range(2):
        u = [b.rows[0][channel] for b in e.u.numerator] + [Fraction(0)] * length
        v = list[Fraction]()
        for k in range(length):
            forced = e.v.numerator[k].rows[0][channel] if k < len(e.v.numerator) else Fraction(0)
            v.append(forced - sum((d * v[k - j] for j, d in enumerate(den) if 1 <= j <= k), Fraction(0)))
        x, y = [Fraction(0), Fraction(0)], list[Fraction]()
        for k in range(length):
            y.append(sum((c * s for c, s in zip(e.system.C.rows[0], x, strict=True)), e.D.rows[0][0] * u[k] + e.system.G.rows[0][0] * v[k]))
            moved = [sum((a * s for a, s in zip(row, x, strict=True)), Fraction(0)) for row in e.system.A.rows]
            x = [m + e.B.rows[i][0] * u[k] + e.system.F.rows[i][0] * v[k] for i, m in enumerate(moved)]
        answers["u"].append(u[:length])
        answers["y"].append(y)
    assert limits.is_stationary(e)
    process, signals = limits.process(e)
    for a, b in (("u", "u"), ("y", "u"), ("u", "y"), ("y", "y")):
        for lag in (-3, -1, 0, 1, 2, 4):
            pairs = [(k + lag, k) for k in range(length) if 0 <= k + lag < length]
            summed = sum((answers[a][c][i] * answers[b][c][k] for c in range(2) for i, k in pairs), Fraction(0))
            found = process.covariance(signals[a], signals[b], lag).rows[0][0]
            assert abs(found - summed) < Fraction(1, 10**20) if rational else found == summed


@FEW
@given(st.integers(0, 2**32))
def test_regressions_are_right_about_an_independent_fault(seed: int) -> None:
    """Whatever u, A, B, C, D: with v independent of u both regressions find B and D, and L has the columns of O_s."""
    rng = Random(seed)
    pick = rng.choice
    values = ["1", "-1", "1/2", "2"]
    json = driven(A=[[pick(["0", "1/2", "-1/3"])]], B=[[pick(values)]], C=[[pick(values)]], D=[[pick(values)]], F=[[pick(values)]], **ALONE)
    about = {"experiment": json, "B": json["B"], "D": json["D"]}
    for regression in ("true-AC", "moesp"):
        assert truth("input-limit", {**about, "regression": regression})
        assert not truth("input-limit", {**about, "regression": regression, "D": [["7"]]})
    assert truth("moesp-limit", {**ranks(1, 1, 1), "experiment": json})
