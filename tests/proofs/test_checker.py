"""What the checker accepts, and every reason it has for refusing.

REJECTED, MALFORMED     name -> (part of the reason, a certificate spoiled accordingly); every reason in the source is met here
reasons                 the reasons in the source
"""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from faultspace.exact.algebra.fields import PrimeField
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.evidence.specimens import specimens
from faultspace.proofs.trust import checker, checker_fields, checker_limits, checker_structure
from faultspace.proofs.trust import structure_certificates as make
from tests.oracle import truth
from tests.proofs.examples import (
    COLUMN,
    CUBED,
    DATA,
    DELAY,
    DIFFERENCE,
    EISENSTEIN,
    EQUAL,
    FIELDS,
    FINITE,
    FLAT,
    FLAT_RANKS,
    GONE,
    HUGE,
    LEADING,
    LINE,
    NORMAL,
    NULL,
    OPEN,
    OUTPUTS,
    PAIR,
    PROJECTED,
    RANKS,
    ROOTED,
    SAME,
    SEVEN_B,
    SEVEN_D,
    SPACE,
    SQRT2,
    STABLE,
    WINDOW,
    ZERO,
    Certificate,
    K,
    S,
    base,
    certificates,
    experiment,
    limit_certificates,
    seen,
    spoiled,
    written,
)
from tests.proofs.hint_cases import MALFORMED_HINTS, REJECTED_HINTS

SOURCES = [Path(module.__file__ or "") for module in (checker, checker_fields, checker_structure, checker_limits)]


@pytest.mark.parametrize("name", FIELDS)
def test_every_kind_is_accepted(name: str) -> None:
    kinds = set()
    for certificate in certificates(FIELDS[name]):
        before = copy.deepcopy(certificate)
        found = checker.verify(certificate)
        assert certificate == before
        assert "assuming" not in found.statement and found.assumes == []
        kinds.add(certificate["kind"])
    over_numbers, over_rationals = {"schur-stable"}, {"moesp-limit", "input-limit"}
    elsewhere = over_rationals if name != "Q" else set()
    assert kinds == set(checker.KINDS) - (elsewhere | over_numbers if isinstance(FIELDS[name], PrimeField) else elsewhere)


def test_the_statement_in_words_tells_statement_and_system() -> None:
    words = checker.verify(written(make.matrix_rank("window", seen(), window=2))).statement
    for part in ("window matrix", "rank 3", "window = 2", "A=[[0]], F=[[1]], C=[[1],[0]], G=[[0],[1]]"):
        assert part in words
    nothing = ResidualSystem.of([], [], [], [], field=PrimeField(2), n=0, m=0, p=0)
    assert "A=[], F=[], C=[], G=[]) (n=0, m=0, p=0) over {prime:2}" in checker.verify(base("left-invertible", system=nothing)).statement


def test_the_specimens_are_true_and_of_kinds_that_no_headline_shows_over_these_fields() -> None:
    for certificate in map(written, specimens()):
        assert checker.verify(certificate).assumes == []
        assert truth(certificate["kind"], certificate["statement"])
    assert {c["kind"] for c in specimens()} >= {"schur-stable", "behaviour-inclusion", "left-invertible-line"}


M = "witness.minors"
E = "statement.experiment"
# Modulo 101 the input is zero; the output is.
DEAF, BLIND = ([*limit_certificates(experiment(**changes))] for changes in ({"u_filter": [[[0]], [[101]]]}, {"C": [[101]]}))
# The minor of these rows is a^2 - 2 b^2: without a zero over Q, and with two over Q(sqrt 2).
OVER_AN_EXTENSION = spoiled(
    PAIR,
    ("statement.first", ResidualSystem.of([], [], [[], []], [[1, 0], [0, 1]], n=0, m=2, p=2).to_json()),
    ("statement.second", ResidualSystem.of([], [], [[], []], [[0, 2], [1, 0]], n=0, m=2, p=2).to_json()),
    (M, [{"point": 0, "rows": [0, 1]}]),
)
# Bad at (0 : 1). At q = 0 the column of the state is zero, and with it every minor, though some rows look like a, and some like b.
ZERO_MINORS = spoiled(
    PAIR,
    ("statement.first", ResidualSystem.of([[0]], [[0]], [[0], [0]], [[1], [0]]).to_json()),
    ("statement.second", ResidualSystem.of([[0]], [[1]], [[0], [0]], [[0], [0]]).to_json()),
    (M, [{"point": 1, "rows": [0, 1]}, {"point": 0, "rows": [0, 2]}, {"point": 0, "rows": [0, 1]}]),
)
REJECTED: dict[str, tuple[str, Certificate]] = {
    "not a prime": ("4 is not a prime", spoiled(RANKS, ("witness.prime", 4))),
    "prime 0": ("0 is not a prime", spoiled(RANKS, ("witness.prime", 0))),
    "strong pseudoprime to nine bases": ("is not a prime", spoiled(RANKS, ("witness.prime", 3825123056546413051))),
    "Carmichael number": ("is not a prime", spoiled(RANKS, ("witness.prime", 561))),
    "prime in a denominator": ("the prime divides a denominator", spoiled(RANKS, ("witness.prime", 3), (f"{S}.A.0.0", "1/3"))),
    "prime in the lead of f": ("divides a denominator or the leading", spoiled(CUBED, ("witness.prime", 2), ("witness.root", 1))),
    "prime in a denominator of f": (
        "divides a denominator or the leading",
        spoiled(ROOTED, (f"{S}.field.minimal_polynomial", ["-2/7", "0", "1/7"]), ("witness.prime", 7), ("witness.root", 3)),
    ),
    "no root": ("is not a simple root", spoiled(ROOTED, ("witness.root", lambda root: root + 1))),
    "double root": ("is not a simple root", spoiled(ROOTED, ("witness.prime", 2), ("witness.root", 0))),
    "f reducible modulo": ("f is reducible modulo 7", spoiled(ROOTED, ("witness.irreducible", {"modulo": 7}))),
    "f a square modulo": ("f is reducible modulo 2", spoiled(ROOTED, ("witness.irreducible", {"modulo": 2}))),
    "irreducible modulo 1": ("1 is not a prime", spoiled(ROOTED, ("witness.irreducible", {"modulo": 1}))),
    "Eisenstein elsewhere": ("Eisenstein's criterion", spoiled(ROOTED, ("witness.irreducible", {"eisenstein": {"prime": 2, "shift": 1}}))),
    "Eisenstein at 0": ("Eisenstein's criterion", spoiled(ROOTED, ("witness.irreducible", {"eisenstein": {"prime": 0, "shift": 0}}))),
    "Eisenstein at 4": ("Eisenstein's criterion", spoiled(ROOTED, ("witness.irreducible", {"eisenstein": {"prime": 4, "shift": "0"}}))),
    "Eisenstein, square divides": (
        "Eisenstein's criterion",
        spoiled(ROOTED, (f"{S}.field.minimal_polynomial", ["-4", "0", "1"]), ("witness.root", 2), ("witness.irreducible", EISENSTEIN)),
    ),
    "pivot out of range": ("a pivot is out of range", spoiled(RANKS, (f"{K}.0.pivot", 2))),
    "zero at the pivot": ("triangular", spoiled(RANKS, (f"{K}.0.pivot", 1))),
    "row twice": ("triangular", spoiled(RANKS, (K, lambda rows: rows * 2))),
    "lead zero": ("triangular", spoiled(RANKS, (f"{K}.0.coefficients", lambda rows: [*rows, ["0", "0"]]))),
    "nonzero below": ("triangular", spoiled(FLAT_RANKS, (f"{K}.1.coefficients.0", ["1", "1"]))),
    "degrees descend": (
        "do not ascend",
        spoiled(FLAT_RANKS, (f"{K}.0.coefficients", lambda rows: [["0", "0"], *rows])),
    ),
    "row beyond the window": ("not below the window", spoiled(SAME, ("statement.window", 1))),
    "row kills no fault": ("does not annihilate", spoiled(RANKS, (f"{K}.0.coefficients.0.1", "0"))),
    "row kills no state": ("does not annihilate", spoiled(RANKS, (f"{K}.0.coefficients.0.0", "1"))),
    "a row is missing": ("the bounds do not meet at sample 1: 2 above", spoiled(EQUAL, (K, []))),
    "unlucky prime": (
        "the bounds do not meet",
        spoiled(base("window-ranks", system=ResidualSystem.of([[0]], [[1]], [[5], [0]], [[0], [1]])), ("witness.prime", 5)),
    ),
    "equality with more": (
        "does not annihilate",
        spoiled(EQUAL, ("statement.second.G", [["1"], ["1"]])),
    ),
    "equality with less": ("the bounds do not meet", spoiled(EQUAL, ("statement.first.F", [[0]]), ("statement.first.G", [[0], [0]]))),
    **REJECTED_HINTS,
    "other indices": ("not the degrees", spoiled(RANKS, ("statement.left_minimal_indices", [0]))),
    "other rank": ("p minus the number of rows", spoiled(RANKS, ("statement.normal_rank", 2))),
    "other window ranks": ("window_ranks do not follow", spoiled(RANKS, ("statement.window_ranks.1", 4))),
    "not left-invertible": ("below the number of faults", {**NULL, "kind": "left-invertible", "witness": {"prime": 101}}),
    "null vector zero": ("the null vector is zero", spoiled(NULL, ("witness", {"state": [["0"]], "fault": [["0", "0"]]}))),
    "null vector wrong": ("(qI - A) x(q) = F v(q) fails", spoiled(NULL, ("witness", {"state": [["0"]], "fault": [["1", "0"]]}))),
    "null vector unfinished": (
        "(qI - A) x(q) = F v(q) fails",
        spoiled(NULL, (f"{S}.C", [[0], [0]]), (f"{S}.G", [[0, 0], [0, 0]]), ("witness", {"state": [[-1]], "fault": [[1, 0]]})),
    ),
    "null vector seen": ("C x(q) + G v(q) = 0 fails", spoiled(NULL, (f"{S}.G", [["0", "1"], ["0", "0"]]))),
    "delay above n": ("the delay is above n", spoiled(DELAY, ("statement.delay", 3))),
    "inverse wrong": ("left inverse", spoiled(DELAY, ("witness.inverse.0.2", "2"))),
    "inverse for known states only": (
        "left inverse",
        spoiled(base("inversion-delay", known=True, system=ZERO), ("statement.initial_state", "unknown")),
    ),
    "word starts with 0": ("v(0) of the ambiguous word", spoiled(DELAY, ("witness.word.v.0.0", "0"))),
    "word from elsewhere": ("x(0) of the ambiguous word", spoiled(DELAY, ("witness.word.x0.0", "1"))),
    "word is heard": ("the output of the ambiguous word", spoiled(OPEN, ("witness.word.x0.0", "1"))),
    "word satisfies": ("the word satisfies the row", spoiled(DIFFERENCE, ("witness.x0", ["0"]), ("witness.v", [["0"], ["0"]]))),
    "difference row": ("does not annihilate", spoiled(DIFFERENCE, ("witness.row.0.0", "1"))),
    "basis not echelon": ("not in row echelon form", spoiled(SPACE, ("statement.basis", [["0", "0", "0"]]))),
    "basis twice": ("not in row echelon form", spoiled(SPACE, ("statement.basis", lambda rows: rows * 2))),
    "basis not reduced": ("not in reduced row echelon form", spoiled(SPACE, ("statement.basis.0", ["2", "0", "2"]))),
    "basis not reduced above": ("not in reduced row echelon form", spoiled(SPACE, ("statement.basis", [["1", "1", "0"], ["0", "1", "0"]]))),
    "basis no solution": ("does not solve problem (11)", spoiled(SPACE, ("statement.basis.0.2", "2"))),
    "basis too small": ("more solutions than the basis spans", spoiled(SPACE, ("statement.basis", []))),
    "basis at an earlier window": ("not below the window", spoiled(SPACE, ("statement.window", 1))),
    "first column seen": ("the first block column is not annihilated", spoiled(COLUMN, ("statement.column", ["1", "0", "0"]))),
    "all columns": ("every block column is annihilated", spoiled(COLUMN, ("statement.column", ["1", "0", "1"]))),
    "window 0": ("every block column is annihilated", spoiled(COLUMN, ("statement.window", 0), (K, []))),
    "left null missing": ("the number of left null rows", spoiled(WINDOW, ("witness.left_null", []))),
    "rank too large": ("the number of left null rows", spoiled(WINDOW, ("statement.rank", 4))),
    "left null wrong": ("does not vanish on the matrix", spoiled(WINDOW, ("witness.left_null.0.row.0", "1"))),
    "left null not triangular": ("triangular", spoiled(WINDOW, ("witness.left_null", lambda rows: rows * 2))),
    "left null pivot": ("a pivot is out of range", spoiled(WINDOW, ("witness.left_null.0.pivot", 4))),
    "rank drops": (
        "the rank modulo the prime is smaller",
        spoiled(base("matrix-rank", system=seen(gain=5), name="reachability"), ("witness.prime", 5)),
    ),
    "columns x(0), ..., x(N) with window 0": (
        "does not vanish",
        spoiled(
            DATA,
            ("statement", lambda s: {**s, "window": 0, "rank": 0, "x0": ["0"], "v": [["1"]]}),
            ("witness.left_null", [{"pivot": 0, "row": [1]}]),
        ),
    ),
    "line, a minor missing": ("may have a common zero", spoiled(PAIR, (f"{M}.1", GONE))),
    "line, no minors": ("may have a common zero", spoiled(PAIR, (M, []))),
    "line, a minor twice": ("may have a common zero", spoiled(PAIR, (f"{M}.1", PAIR["witness"]["minors"][0]))),
    "line, unlucky prime": (
        "may have a common zero",
        spoiled(PAIR, ("statement.first.F", [["101"]]), ("statement.first.G", [["0"], ["101"]]), ("witness.prime", 101)),
    ),
    "line that is bad at (1 : 0)": (
        "may have a common zero",
        spoiled(PAIR, ("statement.first.F", [[0]]), ("statement.first.G", [[0], [0]])),
    ),
    "line that is bad at (0 : 1)": (
        "may have a common zero",
        spoiled(PAIR, ("statement.second.F", [[0]]), ("statement.second.G", [[0], [0]])),
    ),
    "line that is bad at (1 : 1)": (
        "may have a common zero",
        spoiled(PAIR, ("statement.second.F", [[-1]]), ("statement.second.G", [[0], [-1]])),
    ),
    "line that is bad over an extension": ("may have a common zero", OVER_AN_EXTENSION),
    "line with minors that are zero": ("may have a common zero", ZERO_MINORS),
    "on the circle": ("not inside the unit circle", spoiled(STABLE, (f"{S}.A", [[1]]))),
    "outside the circle": ("not inside the unit circle", spoiled(STABLE, (f"{S}.A", [["-3/2"]]))),
    "outside in another embedding": (
        "not inside the unit circle",
        spoiled(STABLE, (S, ResidualSystem.of([[[1, -1]]], [[1]], [[1]], [[1]], field=SQRT2).to_json())),
    ),
    "covariance wrong": ("does not solve the Lyapunov equation", spoiled(LEADING, ("witness.covariance.0.0", "7/5"))),
    "covariance of the outputs wrong": ("does not solve the Lyapunov equation", spoiled(OUTPUTS, ("witness.covariance.0.0", "7/5"))),
    "errors wrong": ("does not solve the Lyapunov equation", spoiled(NORMAL, ("witness.errors.1.0", "7/5"))),
    "another fault filter": ("does not solve the Lyapunov equation", spoiled(LEADING, (f"{E}.v_filter.0.0.0", "2"))),
    "unstable system of an experiment": ("not inside the unit circle", spoiled(PROJECTED, (f"{E}.A.0.0", "-1"))),
    "unstable filter": ("v_filter: the denominator is not stable", spoiled(LEADING, (f"{E}.v_filter", {"num": [[[1]]], "den": [1, -1]}))),
    "input zero modulo the prime": ("the covariance of the inputs may be singular", spoiled(DEAF[0], ("witness.prime", 101))),
    "input zero modulo the prime, regression": ("the covariance of the inputs may be singular", spoiled(DEAF[2], ("witness.prime", 101))),
    "output zero modulo the prime": ("the observability matrix may lose rank", spoiled(BLIND[2], ("witness.prime", 101))),
    "limit rank too large": ("the number of left null rows", spoiled(LEADING, ("statement.limit_rank", 2))),
    "joint row wrong": ("does not vanish on the matrix", spoiled(LEADING, ("witness.joint.0.row.0", "17"))),
    "series wrong": ("the series does not solve its equation", spoiled(NORMAL, ("witness.series.0.0", "7"))),
    "B wrong": ("the error is correlated with the past inputs", SEVEN_B),
    "D wrong": ("the error is correlated with the present input", SEVEN_D),
    "response wrong": ("the response is not that of the future inputs", spoiled(PROJECTED, ("witness.response.0.0", "7"))),
    "inverse of O_s wrong": ("the inverse does not project", spoiled(PROJECTED, ("witness.inverse.0.0", "7"))),
    "normal equations wrong": ("the normal equations fail", spoiled(PROJECTED, ("statement.B.0.0", "7"))),
    "left multiplier": ("left is not unimodular", spoiled(FINITE, ("witness.left_inverse.0.0", ["7"]))),
    "right multiplier": ("right is not unimodular", spoiled(FINITE, ("witness.right.0.0", ["7"]))),
    "diagonal wrong": ("do not give the diagonal", spoiled(FINITE, ("witness.diagonal.0", ["7"]))),
    "orders": ("other orders", spoiled(base("infinite-zeros", system=LINE), ("statement.infinite_zero_orders", [1]))),
    "polynomial doubled": ("not monic", spoiled(FINITE, ("statement.invariant_zero_polynomial", ["-2", "2"]))),
    "polynomial with zeros": ("not monic", spoiled(FINITE, ("statement.invariant_zero_polynomial", ["-1", "1", "0"]))),
    "polynomial empty": ("not monic", spoiled(FINITE, ("statement.invariant_zero_polynomial", []))),
    "polynomial wrong": ("the product of the diagonal", spoiled(FINITE, ("statement.invariant_zero_polynomial", ["1", "1"]))),
    "normal rank of the pencil": ("n plus the normal rank", spoiled(FINITE, ("statement.normal_rank", 0))),
    "too much work": (
        "units of work",
        spoiled(WINDOW, (S, {"A": [["1" * 30]], "F": [[3]], "C": [[1]], "G": [[1]]}), ("statement.window", 900), ("witness.left_null", [])),
    ),
}  # fmt: skip

MALFORMED: dict[str, tuple[str, Any]] = {
    "a list": ("certificate: expected an object", []),
    "a number": ("certificate: expected an object", 7),
    "null": ("certificate: expected an object", None),
    "key missing": ("certificate: expected an object", spoiled(RANKS, ("witness", GONE))),
    "key unknown": ("certificate: expected an object", {**RANKS, "comment": ""}),
    "other format": ("expected faultspace-certificate/1", {**RANKS, "format": "faultspace-certificate/2"}),
    "kind unknown": ("kind: unknown", {**RANKS, "kind": "window_ranks"}),
    "kind a list": ("kind: unknown", {**RANKS, "kind": ["window-ranks"]}),
    "statement key": ("statement: expected an object", spoiled(RANKS, ("statement.window", 1))),
    "witness key": ("witness: expected an object", spoiled(RANKS, ("witness.hint", 1))),
    "statement null": ("statement: expected an object", {**RANKS, "statement": None}),
    "system key": ("system: expected an object", spoiled(RANKS, (f"{S}.E", []))),
    "system missing a matrix": ("system: expected an object", spoiled(RANKS, (f"{S}.G", GONE))),
    "B alone": ("B and D go together", spoiled(RANKS, (f"{S}.B", [["1"]]))),
    "nu alone": ("B and D go together", spoiled(RANKS, (f"{S}.nu", 1))),
    "B of another shape": ("expected a list of 1 to 1 items", spoiled(RANKS, (f"{S}.B", [[1]]), (f"{S}.D", [[1, 2], [1, 2]]))),
    "float": ("expected a rational", spoiled(RANKS, (f"{S}.A.0.0", 0.5))),
    "true": ("expected a rational", spoiled(RANKS, (f"{S}.A.0.0", True))),
    "true for an index": ("expected an integer in", spoiled(RANKS, ("statement.normal_rank", True))),
    "string for an index": ("expected an integer in", spoiled(RANKS, ("statement.normal_rank", "1"))),
    "negative index": ("expected an integer in", spoiled(RANKS, (f"{K}.0.pivot", -1))),
    "zero denominator": ("expected a rational", spoiled(RANKS, (f"{S}.A.0.0", "1/0"))),
    "plus sign": ("expected a rational", spoiled(RANKS, (f"{S}.A.0.0", "+1"))),
    "space": ("expected a rational", spoiled(RANKS, (f"{S}.A.0.0", "1 "))),
    "newline": ("expected a rational", spoiled(RANKS, (f"{S}.A.0.0", "1\n"))),
    "other digits": ("expected a rational", spoiled(RANKS, (f"{S}.A.0.0", "\u0661"))),
    "surrogate": ("expected a rational", spoiled(RANKS, (f"{S}.A.0.0", "\ud800"))),
    "negative denominator": ("expected a rational", spoiled(RANKS, (f"{S}.A.0.0", "1/-2"))),
    "too many digits": ("expected a rational", spoiled(RANKS, (f"{S}.A.0.0", HUGE))),
    "too many bits": ("more than 65536 bits", spoiled(RANKS, (f"{S}.A.0.0", 2**65536))),
    "list over Q": ("expected a rational", spoiled(RANKS, (f"{S}.A.0.0", ["1"]))),
    "list too short over Q(a)": ("expected a list of 3 to 3", spoiled(CUBED, (f"{S}.A.0.0", ["1", "0"]))),
    "list in a list over Q(a)": ("expected a rational", spoiled(CUBED, (f"{S}.A.0.0", [["1", "0", "0"], "0", "0"]))),
    "fraction in a kernel row": ("expected an integer", spoiled(RANKS, (f"{K}.0.coefficients.0.0", "1/2"))),
    "whole fraction in a kernel row": ("expected an integer", spoiled(RANKS, (f"{K}.0.coefficients.0.0", "2/1"))),
    "whole fraction in a list": ("expected an integer", spoiled(CUBED, (f"{K}.0.coefficients.0.0", ["2/1", 0, 0]))),
    "fraction over a prime field": ("expected an integer", spoiled(base("window-ranks", PrimeField(3)), (f"{S}.A.0.0", "1/2"))),
    "row too long": ("expected a list of 1 to 1", spoiled(RANKS, (f"{S}.A.0", ["1", "1"]))),
    "row too short": ("expected a list of 2 to 2", spoiled(RANKS, (f"{K}.0.coefficients.1", ["1"]))),
    **MALFORMED_HINTS,
    "no coefficients": ("expected a list of 1 to 4096", spoiled(RANKS, (f"{K}.0.coefficients", []))),
    "kernel null": ("expected a list of", spoiled(RANKS, (K, None))),
    "kernel row with a key": ("expected an object", spoiled(RANKS, (f"{K}.0.degree", 1))),
    "zero dimension untold": ("with a zero dimension n, m, p are required", spoiled(base("window-ranks", system=FLAT), (f"{S}.m", GONE))),
    "dimension disagrees": ("expected a list of 2 to 2", spoiled(RANKS, (f"{S}.n", 2))),
    "dimension null": ("n: expected an integer", spoiled(RANKS, (f"{S}.n", None))),
    "too large": ("n + m + p is above 512", spoiled(RANKS, (S, {"A": [], "F": [], "C": [], "G": [], "n": 0, "m": 400, "p": 400}))),
    "field null": ("field: expected Q", spoiled(RANKS, (f"{S}.field", None))),
    "field unknown": ("field: expected Q", spoiled(RANKS, (f"{S}.field", "R"))),
    "field of two kinds": ("field: expected an object", spoiled(RANKS, (f"{S}.field", {"prime": 2, "minimal_polynomial": [0, 1]}))),
    "field composite": ("field.prime: not a prime", spoiled(RANKS, (f"{S}.field", {"prime": 341550071728321}), ("witness.prime", GONE))),
    "field too large": ("field.prime: expected an integer", spoiled(RANKS, (f"{S}.field", {"prime": 2**64 + 13}))),
    "field of degree 0": ("expected a list of 2 to 17", spoiled(CUBED, (f"{S}.field", {"minimal_polynomial": ["1"]}))),
    "field of degree 17": ("expected a list of 2 to 17", spoiled(CUBED, (f"{S}.field", {"minimal_polynomial": ["1"] * 18}))),
    "leading coefficient 0": ("the leading coefficient is zero", spoiled(CUBED, (f"{S}.field", {"minimal_polynomial": ["1", "0"]}))),
    "no prime": ("witness: a prime over Q", spoiled(RANKS, ("witness.prime", GONE))),
    "no root": ("witness: a prime over Q", spoiled(CUBED, ("witness.root", GONE))),
    "root over Q": ("witness: a prime over Q", spoiled(RANKS, ("witness.root", 0))),
    "prime over a prime field": ("witness: a prime over Q", spoiled(base("window-ranks", PrimeField(3)), ("witness.prime", 3))),
    "prime too large": ("expected an integer in", spoiled(RANKS, ("witness.prime", 2**64 + 13))),
    "root too large": ("witness.root: expected an integer", spoiled(ROOTED, ("witness.root", lambda root: root + 2**61 - 1))),
    "irreducible over Q": ("irreducible: expected modulo", spoiled(RANKS, ("witness.irreducible", {"modulo": 2}))),
    "irreducible twice": ("irreducible: expected modulo", spoiled(ROOTED, ("witness.irreducible", {"modulo": 3, **EISENSTEIN}))),
    "irreducible how": ("irreducible: expected an object", spoiled(ROOTED, ("witness.irreducible", {"trust": "me"}))),
    "irreducible null": ("irreducible: expected an object", spoiled(ROOTED, ("witness.irreducible", None))),
    "Eisenstein without shift": ("eisenstein: expected an object", spoiled(ROOTED, ("witness.irreducible", {"eisenstein": {"prime": 2}}))),
    "Eisenstein by half": ("expected an integer", spoiled(ROOTED, ("witness.irreducible", {"eisenstein": {"prime": 2, "shift": "1/2"}}))),
    "line of two A": ("differ in A, C", spoiled(PAIR, ("statement.second.A", [[1]]))),
    "line of two C": ("differ in A, C", spoiled(PAIR, ("statement.second.C", [[1], [1]]))),
    "line of two m": ("differ in A, C", spoiled(PAIR, ("statement.second.F", [[0, 0]]), ("statement.second.G", [[1, 0], [0, 0]]))),
    "line of two n": ("differ in A, C", spoiled(PAIR, ("statement.second", FLAT.to_json()))),
    "rows descend": ("rows: they do not ascend", spoiled(PAIR, (f"{M}.0.rows", [1, 0]))),
    "a row twice": ("rows: they do not ascend", spoiled(PAIR, (f"{M}.0.rows", [1, 1]))),
    "row out of range": ("rows: expected an integer in 0..2", spoiled(PAIR, (f"{M}.0.rows", [0, 3]))),
    "too few rows": ("rows: expected a list of 2 to 2", spoiled(PAIR, (f"{M}.0.rows", [0]))),
    "point above the prime": ("point: expected an integer in 0..100", spoiled(PAIR, ("witness.prime", 101), (f"{M}.0.point", 101))),
    "minor with a key": ("minor: expected an object", spoiled(PAIR, (f"{M}.0.value", 1))),
    "line without a prime": ("witness: a prime over Q", spoiled(PAIR, ("witness.prime", GONE))),
    "stable over a prime field": ("a finite one has no unit circle", spoiled(STABLE, (f"{S}.field", {"prime": 5}))),
    "experiment over a prime field": (
        "over Q only, and with an input",
        spoiled(LEADING, (f"{E}.field", {"prime": 5}), (f"{E}.A", [[1]]), (f"{E}.G", [[1]])),
    ),
    "experiment over Q(a)": ("over Q only, and with an input", spoiled(LEADING, (f"{E}.field", {"minimal_polynomial": ["-2", "0", "1"]}))),
    "experiment without inputs": (
        "over Q only, and with an input",
        spoiled(LEADING, (E, lambda e: {**e, "B": [[]], "D": [[]], "n": 1, "m": 1, "p": 1, "nu": 0})),
    ),
    "experiment without B": ("experiment: expected an object", spoiled(LEADING, (f"{E}.B", GONE))),
    "experiment without a filter": ("experiment: expected an object", spoiled(LEADING, (f"{E}.v_filter", GONE))),
    "experiment with a key": ("experiment: expected an object", spoiled(LEADING, (f"{E}.seed", 1))),
    "experiment null": ("experiment: expected an object", spoiled(LEADING, (E, None))),
    "no future": ("one block row at least", spoiled(LEADING, (f"{E}.s", 0))),
    "no past": ("one block row at least", spoiled(LEADING, (f"{E}.past", 0))),
    "past too long": ("past: expected an integer in 0..4096", spoiled(LEADING, (f"{E}.past", 4097))),
    "filter empty": ("u_filter: expected a list of 1 to 512", spoiled(LEADING, (f"{E}.u_filter", []))),
    "filter with a key": ("u_filter: expected an object", spoiled(LEADING, (f"{E}.u_filter", {"num": [[[1]]], "den": [1], "lag": 1}))),
    "filter of a number": ("u_filter: expected a list", spoiled(LEADING, (f"{E}.u_filter", 1))),
    "filter with rows missing": ("v_filter: expected a list of 1 to 1", spoiled(LEADING, (f"{E}.v_filter.0", []))),
    "filters of two noises": ("v_filter[0]: expected a list of 1 to 1", spoiled(LEADING, (f"{E}.v_filter.0.0", ["1", "1"]))),
    "filter with a long lag": ("u_filter[0]: expected a list of 1 to 1", spoiled(LEADING, (f"{E}.u_filter.1.0", ["1", "1"]))),
    "denominator empty": ("u_filter: expected a list of 1 to 512", spoiled(LEADING, (f"{E}.u_filter", {"num": [[[1]]], "den": []}))),
    "denominator of 2": ("the denominator does not begin with 1", spoiled(LEADING, (f"{E}.u_filter", {"num": [[[1]]], "den": [2, 1]}))),
    "instruments unknown": ("instruments: past-inputs or past-inputs-and-outputs", spoiled(LEADING, ("statement.instruments", "past"))),
    "instruments more": ("covariance[0]: expected a list of 4", spoiled(LEADING, ("statement.instruments", "past-inputs-and-outputs"))),
    "regression unknown": ("regression: true-AC or moesp", spoiled(NORMAL, ("statement.regression", "true-ac"))),
    "regression other": ("witness: errors and series, or", spoiled(NORMAL, ("statement.regression", "moesp"))),
    "regression without its series": ("witness: errors and series, or", spoiled(NORMAL, ("witness.series", GONE))),
    "limit without a prime": ("witness: expected an object", spoiled(LEADING, ("witness.prime", GONE))),
    "initial state": ("initial_state: expected known or unknown", spoiled(DELAY, ("statement.initial_state", "free"))),
    "delay as a string": ("delay: expected an integer", spoiled(DELAY, ("statement.delay", "2"))),
    "inverse missing": ("no inverse with null", spoiled(DELAY, ("witness.inverse", GONE))),
    "inverse with null": ("no inverse with null", spoiled(DELAY, ("statement.delay", None))),
    "word with delay 0": ("no word with 0", spoiled(DELAY, ("statement.delay", 0))),
    "word of another length": ("v: expected a list of 2 to 2", spoiled(DELAY, ("witness.word.v", lambda v: v[:1]))),
    "window null": ("window: expected an integer", spoiled(SAME, ("statement.window", None))),
    "window too large": ("window: expected an integer in 0..4096", spoiled(SAME, ("statement.window", 4097))),
    "difference on no samples": ("row: expected a list of 1 to 0", spoiled(DIFFERENCE, ("statement.window", 0))),
    "outputs differ in number": ("differ in field or number of outputs", spoiled(SAME, ("statement.second", ZERO.to_json()))),
    "fields differ": ("differ in field or number of outputs", spoiled(SAME, ("statement.second", seen(SQRT2).to_json()))),
    "basis too large": ("basis: expected a list of 0 to 3", spoiled(SPACE, ("statement.basis", [["0"] * 3] * 4))),
    "column too long": ("column: expected a list of 3 to 3", spoiled(COLUMN, ("statement.column", ["0"] * 4))),
    "matrix unknown": ("matrix: unknown name", spoiled(WINDOW, ("statement.matrix", "hankel"))),
    "matrix a list": ("matrix: unknown name", spoiled(WINDOW, ("statement.matrix", ["window"]))),
    "window with observability": ("statement: expected an object", spoiled(WINDOW, ("statement.matrix", "observability"))),
    "window above the samples": ("more than there are samples", spoiled(DATA, ("statement.window", 5))),
    "too many left null rows": ("row: expected a list of 0 to", spoiled(WINDOW, ("witness.left_null", lambda rows: rows * 600))),
    "diagonal too long": ("diagonal: expected a list of 2 to 2", spoiled(FINITE, ("witness.diagonal", [["1"]] * 3))),
    "polynomial matrix": ("left: expected a list of 2 to 2", spoiled(FINITE, ("witness.left", [[["1"]]]))),
    "null and faults unequal": ("fault: expected a list of 1 to 1", spoiled(NULL, ("witness", {"state": [["0"]], "fault": []}))),
}  # fmt: skip


@pytest.mark.parametrize("name", REJECTED)
def test_what_is_well_formed_and_wrong_is_rejected(name: str) -> None:
    reason, certificate = REJECTED[name]
    with pytest.raises(checker.Rejected) as caught:
        checker.verify(certificate)
    assert reason in str(caught.value)


@pytest.mark.parametrize("name", MALFORMED)
def test_what_is_not_of_the_format_is_malformed(name: str) -> None:
    reason, certificate = MALFORMED[name]
    with pytest.raises(checker.Malformed) as caught:
        checker.verify(certificate)
    assert reason in str(caught.value)


def test_without_its_pivots_an_unlucky_prime_would_prove_something_false(monkeypatch: pytest.MonkeyPatch) -> None:
    # C is zero modulo 5: the bounds meet there with a row that is zero, and annihilates whatever there is.
    system = ResidualSystem.of([[0]], [[1]], [[5], [0]], [[0], [1]]).to_json()
    statement = {"system": system, "normal_rank": 1, "left_minimal_indices": [0]}
    certificate = {**RANKS, "statement": statement, "witness": {"prime": 5, "kernel": [{"pivot": 0, "coefficients": [["0", "0"]]}]}}
    assert not truth("window-ranks", statement)
    with pytest.raises(checker.Rejected, match="triangular"):
        checker.verify(certificate)
    strict = checker.require
    monkeypatch.setattr(checker, "require", lambda condition, reason, *error: strict(condition or "triangular" in reason, reason, *error))
    checker.verify(certificate)


def reasons(name: str) -> Iterator[str]:
    """Yield the fixed parts of every reason in the sources that a call of this name gives, by itself or of the core."""
    for node in (node for source in SOURCES for node in ast.walk(ast.parse(source.read_text("utf-8")))):
        if isinstance(node, ast.Call) and ast.unparse(node.func) in (name, f"core.{name}"):
            reason = node.args[1]
            parts = reason.values if isinstance(reason, ast.JoinedStr) else [reason]
            texts = [part.value for part in parts if isinstance(part, ast.Constant) and isinstance(part.value, str)]
            if texts:
                yield max(texts, key=len)


ELSEWHERE = {"a key stands twice", " bytes", "the statement is not about "}
ELSEWHERE |= {"is a directory", "is no regular file, but a pipe or a device", "more than ", "a number: expected an integer"}
ELSEWHERE |= {"a number: more digits than a number may have", " bytes of memory"}
ELSEWHERE |= {"witness: without a point it is for checker_fields.py, which is another file"}


@pytest.mark.parametrize(("call", "cases"), [("require", REJECTED), ("expect", MALFORMED)])
def test_every_reason_in_the_source_is_met(call: str, cases: dict[str, tuple[str, Any]]) -> None:
    given = []
    for _, certificate in cases.values():
        with pytest.raises((checker.Rejected, checker.Malformed)) as caught:
            checker.verify(certificate)
        given.append(str(caught.value))
    found = set(reasons(call))
    assert len(found) > 10
    assert {reason for reason in found - ELSEWHERE if not any(reason in text for text in given)} == set()


def test_more_memory_than_there_may_be_is_rejected_before_it_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    certificate = spoiled(WINDOW, (f"{S}.A.0.0", "123456789" * 10), ("statement.window", 40))
    monkeypatch.setattr(checker, "MAX_MEMORY", 10**6)
    with pytest.raises(checker.Rejected, match="more than 1000000 bytes of memory"):
        checker.verify(certificate)
    assert checker._meter.get().held < 10**6


def test_matrices_give_back_the_memory_they_held() -> None:
    system = {"A": [], "F": [], "C": [[]] * 60, "G": [[f"{100 * i + j}/7" for j in range(60)] for i in range(60)], "n": 0, "m": 60, "p": 60}
    meter = checker.begin()
    read = checker_structure.System(system)
    assert meter.held > 10**5 and read.m == 60
    del read
    assert meter.held < 10**4


def test_work_is_counted_for_each_certificate_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    checker.verify(RANKS)
    monkeypatch.setattr(checker, "MAX_WORK", checker._meter.get().work + 1)
    for _ in range(3):
        checker.verify(RANKS)
    monkeypatch.setattr(checker, "MAX_WORK", checker._meter.get().work - 1)
    with pytest.raises(checker.Rejected, match="units of work"):
        checker.verify(RANKS)
