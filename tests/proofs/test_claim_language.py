"""The language of claims: what it says, what it refuses and how, and what is asked of every window, against looking far ahead."""

from __future__ import annotations

import random
from math import inf
from time import process_time
from typing import Any

import numpy as np
import pytest

from faultspace.base.errors import InvalidInput
from faultspace.exact import ResidualSystem
from faultspace.exact.algebra.fields import PrimeField
from faultspace.proofs.boxes.box import Box
from faultspace.proofs.brought.claim_files import read_claims
from faultspace.proofs.language.by_batches import Table, UndefinedAt, true_of
from faultspace.proofs.language.evaluating import Exactly, evaluate
from faultspace.proofs.language.grammar import read
from faultspace.proofs.language.invariance import invariant
from faultspace.proofs.language.nodes import LONGEST, Undefined
from faultspace.proofs.quantities.registry import Kind, Subject

LATE = ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 0], [0, 0]], [[0], [1]])  # lag 2, left minimal indices [2]
SQUARE = ResidualSystem.of([["1/2"]], [["-3/2"]], [[1]], [[1]])  # a zero at 2, no left minimal index


def value(text: str, system: ResidualSystem = LATE, kind: Kind = Kind.WORD) -> Any:
    return evaluate(read(text, kind), Exactly({"": Subject(system)}))


TRUE = [
    "n == 2 and m == 1 and p == 2",
    "1 < n <= 2 != m",
    "not (n == 1 or m == 2)",
    "implies(n == 1, left_minimal_indices[9] == 0)",
    "iff(left_invertible, normal_rank == m)",
    "left_minimal_indices == left_minimal_indices and left_minimal_indices != right_minimal_indices",
    "len(left_minimal_indices) == 1 and left_minimal_indices[0] == 2 and left_minimal_indices[-1] == lag",
    "sum(left_minimal_indices) + sum(right_minimal_indices) + zeta == n",
    "max(lag, 7) == 7 and min(left_minimal_indices) == 2 and abs(-3) == 3",
    "7 // 2 == 3 and 7 % 2 == 1 and -n == 0 - 2 and 2 * n - 1 == 3",
    "delay_known < inf and inf >= n",
    "rank(A) == 1 and nullity(A) == 1 and rows(C) == 2 and columns(F) == 1",
    "is_zero(A @ A) and nilpotent(A) and schur_stable(A) and is_zero(power(A, 2)) and not is_zero(power(A, 0))",
    "rank(hstack(F, A @ F)) == 2 and rank(vstack(C, C @ A)) == 2 and rank(A.T @ A - I(n)) == 1",
    "is_zero(zeros(n, p)) and is_zero(A - A) and not is_zero(-A) and is_zero(F + zeros(2, 1) - F)",
    "all(gap(s) == m for s in windows(2, 6)) and not all(gap(s) == m for s in windows(1, 6))",
    "all(gap(s) == m for s in windows(3, 2)) and not any(gap(s) == m for s in windows(3, 2))",
    "any(rank_OT(s) == 5 for s in windows(0, 4))",
    "least(s for s in windows(0, 9) if gap(s) == m) == 2 and least(s for s in windows(0, 9) if gap(s) == 9) == inf",
    "all(any(rank_OT(t) >= rank_OT(s) for t in windows(s, 2 * s)) for s in windows(1, 4))",
    "True and not False",
]


@pytest.mark.parametrize("text", TRUE)
def test_what_is_true_is_true_and_its_opposite_is_not(text: str) -> None:
    assert value(text) is True
    assert value(f"not ({text})") is False


REFUSED = [
    ("lagg <= n", "column 1", "nearest is lag"),
    ("n <= obserable", "column 6", "nearest is observable"),
    ("rankOT(3) == 1", "column 1", "nearest is rank_OT"),
    ("lag", "an integer", "true or false"),
    ("n and m", "an integer", "true or false"),
    ("observable <= n", "true or false <= an integer", "iff"),
    ("A == C", "a matrix == a matrix", "is_zero"),
    ("A + n == 1", "an integer", "a matrix"),
    ("A * A == 1", "a matrix", "an integer"),
    ("left_minimal_indices <= n", "a list of integers <= an integer", "two integers"),
    ("left_minimal_indices < left_minimal_indices", "a list of integers < a list of integers", "== of two lists"),
    ("n + ", "column", "expression"),
    ("n if m else p", "no words for", ""),
    ("[1, 2][0] == 1", "no words for", ""),
    ("(lambda: 1)() == 1", "no words for", ""),
    ("__import__('os')", "no name of the language", ""),
    ("A.__class__ == 1", ".T of a matrix", ""),
    ("A.T.T.shape == 1", ".T of a matrix", ""),
    ("'n' == 1", "no words for", ""),
    ("1.5 <= n", "expected an integer", ""),
    ("n / m <= 1", "// rounds down", ""),
    ("n ** m <= 1", "power(A, k) is that of a matrix", ""),
    ("n in left_minimal_indices", "expected one of <", ""),
    ("rank_OT <= 1", "rank_OT(s)", ""),
    ("lag(3) == 1", "lag is no function", ""),
    ("rank_OT(1, 2) == 1", "2 arguments", "one number"),
    ("rank(A, F) == 1", "2 arguments", "expected 1"),
    ("rank(n) == 1", "an integer", "a matrix"),
    ("sum(n) == 1", "expected a list", ""),
    ("rank(X=A) == 1", "no words for", ""),
    ("all(n == 1 for n in windows(0))", "which is taken", ""),
    ("all(s == 1 for s in range(3))", "all(E for s in windows(a, b))", ""),
    ("all(s == 1 for s in windows(0) if s > 1)", "all(E for s in windows(a, b))", ""),
    ("least(n for s in windows(0) if n > 1) == 1", "least(s for s in windows(a, b) if E)", ""),
    ("all(s + t == 1 for s in windows(0, 1) for t in windows(0, 1))", "all(E for s in windows(a, b))", ""),
    ("all([gap(s) == 1 for s in windows(0, 1)])", "all(E for s in windows(a, b))", ""),
    ("s == 1", "no name", ""),
    ("99999999 == n", "integers up to", ""),
    ("n" + " + n" * 450 + " == 1", "parts", ""),
    ("(" * 60 + "n" + ")" * 60 + " == " + "-" * 60 + "n", "levels", ""),
    ("(" * 900 + "n == 1" + ")" * 900, "expression", ""),
    ("n == 1 " + " " * LONGEST, "characters", ""),
    # every s: it may stand in functions with a window, sums, differences, comparisons alone
    ("all(rank(power(A, s)) == 1 for s in windows(1))", "asks for every s >= a", "give windows an end"),
    ("all(s // 2 == 1 for s in windows(1))", "give windows an end", ""),
    ("all(s * s == 1 for s in windows(1))", "give windows an end", ""),
    ("all(abs(gap(s)) == 1 for s in windows(1))", "give windows an end", ""),
    ("all(max(s, 1) == 1 for s in windows(1))", "give windows an end", ""),
    ("all(left_minimal_indices[s] == 1 for s in windows(1))", "give windows an end", ""),
    ("all(rank_OT(2 * s) == 1 for s in windows(1))", "s + c or s - c", ""),
    ("all(rank_OT(n - s) == 1 for s in windows(1))", "s + c or s - c", ""),
    ("all(rank_OT(s + s) == 1 for s in windows(1))", "s + c or s - c", ""),
    ("all(any(gap(t) == 1 for t in windows(0, s)) for s in windows(1))", "give windows an end", ""),
    ("all(any(gap(t) + gap(s) == 1 for t in windows(0, 3)) for s in windows(1))", "give windows an end", ""),
]


@pytest.mark.parametrize(("text", "words", "more"), REFUSED)
def test_what_is_refused_is_told_in_words(text: str, words: str, more: str) -> None:
    with pytest.raises(InvalidInput) as error:
        read(text)
    assert words in str(error.value) and more in str(error.value)
    assert "\n" not in str(error.value) and len(str(error.value)) < 500


WITHOUT_VALUE = [
    ("left_minimal_indices[1] == 0", "guard it with len(left_minimal_indices), as in implies(len(left_minimal_indices) > 1, ...)"),
    ("right_minimal_indices[0] == 0", "list of 0"),
    ("max(right_minimal_indices) == 0", "empty list"),
    ("n // (m - 1) == 0", "divisor 0"),
    ("n % 0 == 0", "divisor 0"),
    ("inf - inf == 0", "guard"),
    ("0 * inf == 0", "guard"),
    ("inf // 2 == 0", "guard"),
    ("rank_OT(n - 3) == 0", "number of samples"),
    ("rank_OT(inf) == 0", "number of samples"),
    ("rank(A + C @ A @ A.T + F) == 0", "shapes that agree"),
    ("nilpotent(F) ", "square"),
    ("is_zero(power(F, 2))", "square"),
    ("is_zero(I(0 - 1))", "size"),
    ("is_zero(power(A, 1000))", "exponent"),
    ("left_minimal_indices[-3] == 0", "as in implies(len(left_minimal_indices) > 2, ...)"),
    ("left_minimal_indices[inf] == 0", "got the index inf in left_minimal_indices[inf], expected a finite one"),
    ("all(gap(s) == 1 for s in windows(0, inf))", "guard it with implies(CONDITION, ...), or leave the end out"),
    ("all(gap(s) == 1 for s in windows(0, 999999))", "at most"),
    ("all(gap(s) == 1 for s in windows(0 - 1))", "number of samples"),
    ("1000000 * 1000000 * 1000000 * 1000000 == 1", "2^62"),
]


@pytest.mark.parametrize(("text", "words"), WITHOUT_VALUE)
def test_what_has_no_value_says_why(text: str, words: str) -> None:
    with pytest.raises(Undefined) as error:
        value(text)
    assert words in str(error.value)
    assert value(f"implies(n == 1, {text})") is True  # and is guarded against


UNBOUNDED = [
    "all(gap(s) == m for s in windows(n))",
    "all(gap(s) == m for s in windows(0))",
    "all(rank_OT(s) == n + m * s - zeta for s in windows(n))",
    "all(rank_OT(s + 1) - rank_OT(s) == gap(s) for s in windows(0))",
    "all(rank_OT(s) >= rank_T(s) + 1 for s in windows(1))",
    "any(rank_T(s) >= 37 for s in windows(0))",
    "all(rank_T(s) != 9 for s in windows(0))",
    "any(rank_OT(s) == 2 * s - 5 for s in windows(1))",
    "all(rank_OT(s) - rank_T(s) <= n - s + 20 for s in windows(0))",
    "all(implies(rank_OT(s) >= 8, solutions(s) == n_z) for s in windows(0))",
    "all(solutions(s + 1) == n_z for s in windows(n))",
    "any(gap(s) != m and solutions(s) > n_z for s in windows(3))",
    "least(s for s in windows(0) if rank_OT(s) >= 23) >= 12",
    "least(s for s in windows(0) if rank_OT(s) - 2 * s <= 0 - 9 or rank_T(s) - s == 4) == 11",
    "all(iff(3 * rank_O(s) - s > 1, s < 5) for s in windows(1))",
    "all(rank_OT(s - 4) <= rank_OT(s) for s in windows(4))",
    "all(10 <= rank_OT(s) < 3 * s + 2 for s in windows(6))",
    "least(s for s in windows(2) if s >= 40) == 40",
    "any(solutions(s) == n_z for s in windows(0))",  # it changes at n + 1 at the latest, and where the lag is n no earlier
    "any(solutions(s - 4) == n_z for s in windows(4))",
    "least(s for s in windows(7) if solutions(s - 7) < n + p) == lag + 8",
    "any(rank_T(s - 3) > 0 for s in windows(3))",
    "implies(not left_invertible, all((2 * s - 45) * delay_known <= 3 for s in windows(0)))",  # its sign changes, and inf stays inf
    "implies(not left_invertible, least(s for s in windows(0) if delay_known * (2 * s - 15) + rank_T(s) >= 3) == 8)",
    "any(s != 40 and (s - 40) * delay_unknown > 30 for s in windows(n))",
    "any(rank_T(n + s - 3 - n) > 0 and rank_OT(2 + (s + 1)) != 4 for s in windows(3))",
    "least(s for s in windows(7) if solutions(1 + s - (n + 8) + n) < n + p) == lag + 8",
    "all(implies(len(left_minimal_indices) > 0, rank_OT(s) >= left_minimal_indices[0] or s < 9) for s in windows(0))",
]
FAR = 80


def bounded(text: str) -> str:
    """Return the text with an end of each window, far away."""
    before, found, after = text.partition("windows(")
    start, closing, rest = after.partition(")")
    return before + found + start + f", {FAR}" + closing + rest


@pytest.mark.parametrize("text", UNBOUNDED)
def test_every_window_is_decided_as_looking_far_ahead_does(text: str) -> None:
    rng = random.Random(18)
    systems = [LATE, SQUARE]
    for _ in range(25):
        n, m, p = rng.randint(0, 3), rng.randint(0, 2), rng.randint(0, 2)
        parts = ([[rng.randint(-1, 1) for _ in range(b)] for _ in range(a)] for a, b in ((n, n), (n, m), (p, n), (p, m)))
        systems.append(ResidualSystem.of(*parts, n=n, m=m, p=p))
    for system in systems:
        assert value(text, system) == value(bounded(text), system), str(system)


def test_the_places_of_change_are_looked_at_and_not_beyond() -> None:
    """A change at a million samples is found without going there step by step."""
    assert value("least(s for s in windows(0) if rank_T(s) >= 1000000) == 1000000")
    assert value("all(rank_T(s) != 999999 for s in windows(0))") is False
    assert value("all(rank_T(s) * 2 != 999999 for s in windows(0))") is True


def test_a_window_inside_another_is_decided_for_each() -> None:
    assert value("all(all(rank_OT(t) >= rank_T(t) + s - 3 for t in windows(2)) for s in windows(0, 3))") is True
    assert value("all(all(rank_OT(t) >= rank_T(t) + s - 3 for t in windows(2)) for s in windows(0, 9))") is False


BATCHED = [
    *(
        text
        for text in TRUE
        if "[9]" not in text and "left_minimal_indices[0]" not in text and "min(left" not in text and "2, 1" not in text
    ),
    *UNBOUNDED[:-1],
    "minimum_phase",
    "implies(stable, strongly_detectable or not left_invertible)",
    "schur_stable(A - I(n)) or schur_stable(A)",
    "rank(hstack(F, A @ F)) + rank(vstack(C, C @ A)) >= n or nilpotent(A)",
    "is_zero(power(A, n)) or rank(A - I(n)) == 0",
    "strongly_reachable_dimension + weakly_unobservable_dimension >= n",
    "delay_unknown <= delay_known + unobservable_dimension",
    "rank(power(A, min(lag, 3))) >= 1",
    "rank(G.T @ G) == rank(G)",
]


@pytest.mark.parametrize("text", BATCHED)
@pytest.mark.parametrize("prime", [None, 3])
def test_many_systems_at_once_are_decided_as_one_by_one(text: str, prime: int | None) -> None:
    if prime and any(word in text for word in ("stable", "phase", "detectable")):
        pytest.skip("a finite field has no unit circle")
    box = Box(prime=prime)
    node, table = read(text), Table()
    rng = np.random.default_rng(5)
    for sizes in ((1, 1, 1), (1, 2, 1), (2, 1, 2)):
        table, stretch = Table(), next(box.stretches(sizes, reduced=False))
        rows = np.sort(rng.choice(len(stretch.batch), 12, replace=False))
        exact = []
        for i in rows:
            try:
                exact.append(evaluate(node, Exactly({"": Subject(stretch.batch.system(int(i)))})))
            except Undefined:
                exact.append(None)
        try:
            assert true_of(node, stretch.batch, rows, table).tolist() == exact
        except UndefinedAt as error:
            assert exact[rows.tolist().index(error.index)] is None


def test_changes_of_numbers_and_signs_are_followed_through_matrices() -> None:
    for text in ("rank(A) == 1", "rank(C @ F) == m", "rank(hstack(A - I(n), F)) == n", "is_zero(zeros(p, n) @ F + C @ A @ F)", "lag == n"):
        assert invariant(read(text)), text
    for text in ("rank(F @ C) == 1", "rank(A + F @ C) == 1", "rank(A - I(2)) == 1", "nilpotent(G)", "rank(G @ G) == 1", "is_zero(F + C.T)"):
        assert not invariant(read(text)), text


def test_over_a_prime_field_matrices_are_reduced() -> None:
    over_2 = ResidualSystem.of([[1, 1], [1, 1]], [[1], [1]], [[1, 1]], [[0]], field=PrimeField(2))
    assert value("is_zero(A @ A) and rank(A - I(n)) == 2 and is_zero(A + A)", over_2)


def test_infinity_is_a_number_that_compares() -> None:
    assert value("delay_known", ResidualSystem.of([[0]], [[0]], [[1]], [[0]]), Kind.INTEGER) == inf
    assert value("delay_known >= 10 and delay_known == inf and delay_known + 1 == inf", ResidualSystem.of([[0]], [[0]], [[1]], [[0]]))


@pytest.mark.parametrize("text", ["\uff4e >= 1", "lag <= \uff11", "\U0001d427 >= 1", "n \u2265 1", "n >= 1\u200b", "n\u00a0>= 1 or \u043f"])
def test_letters_that_look_alike_are_not_those_of_the_language(text: str) -> None:
    with pytest.raises(InvalidInput, match=r"column [0-9]+: got .*, expected letters, digits and signs of ASCII"):
        read(text)


def test_a_key_of_many_parts_is_refused_at_once() -> None:
    begun = process_time()
    dotted = ".".join(["a"] * 20_000)
    for text in (f"{dotted} = 1", f"[{dotted}]", f"a = {{{dotted} = 1}}", " . ".join(["'a'"] * 20_000) + " = 1", "x" * 10**6):
        with pytest.raises(InvalidInput):
            read_claims(text)
    assert process_time() - begun < 2.0
    text = "a.b." * 30
    (claim,) = read_claims(f'# {text}\n[claim.one]\nstatement = \'{text}\'\nsource = """\n{text}"""\nconclusion = \'lag <= n\'\n')
    assert claim.statement == text
