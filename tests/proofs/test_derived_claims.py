"""What follows from Rocq's theorems is PROVED, and what only looks like a theorem is not; claims changed at random attack the rules."""

from __future__ import annotations

import random
import re
from collections.abc import Sequence
from dataclasses import replace

import pytest

from faultspace.base.errors import InvalidInput
from faultspace.base.progress import silent
from faultspace.packaged_examples import content
from faultspace.proofs.brought import deciding
from faultspace.proofs.brought import theorems as in_the_language
from faultspace.proofs.brought.claim_files import read_claims
from faultspace.proofs.brought.claiming import claim
from faultspace.proofs.brought.claims import Answered, make_claim
from faultspace.proofs.brought.deriving import Theorem, derived
from faultspace.proofs.brought.readings import decide_reading, readings
from faultspace.proofs.brought.theorems import proof_of, theorems
from faultspace.proofs.brought.trying import Question, search
from faultspace.proofs.evidence.corpus import CORPUS, examine
from faultspace.proofs.evidence.families import adversarial
from faultspace.proofs.language.certified import asked_by
from faultspace.proofs.language.grammar import read
from faultspace.proofs.language.vocabularies import SYSTEM
from faultspace.proofs.rocq.locks import held
from faultspace.proofs.rocq.sources import sources
from faultspace.proofs.verdict.ledger import IN_LANGUAGE, load
from faultspace.proofs.verdict.verdicts import Verdict
from faultspace.proofs.verdict.workbench import Workbench
from tests.thorough import THOROUGH, every


def proved(conclusion: str, *hypotheses: str) -> tuple[str, ...] | None:
    """Return the theorems by which the conclusion follows from the hypotheses."""
    found = proof_of([read(one) for one in hypotheses], read(conclusion))
    return None if found is None else tuple(found.theorems)


FOLLOWS = [
    ("lag <= n", (), ("lag_at_most_n",)),
    ("n + 1 > lag", (), ("lag_at_most_n",)),
    ("all(gap(s) == m for s in windows(n))", ("left_invertible",), ("proposition_3",)),
    ("all(m == rank_OT(k + 1) - rank_OT(k) for k in windows(n + 2, 2 * n + 9))", ("normal_rank == m", "observable"), ("proposition_3",)),
    ("implies(left_invertible, gap(3 * n) >= m)", (), ("proposition_3",)),
    ("all(gap(s) == m for s in windows(max(delay_known, n)))", ("left_invertible",), ("proposition_3",)),
    ("delay_known < inf", ("left_invertible",), ("left_invertible_delay",)),
    ("delay_known == inf", ("not left_invertible",), ("left_invertible_delay",)),
    ("least(t for t in windows(0) if m == rank_T(t + 1) - rank_T(t)) == delay_known", (), ("trajectory_delay",)),
    (
        "weakly_unobservable_dimension == 0",
        ("left_invertible", "finite_zeros == 0"),
        ("zero_states_direct", "zero_subspaces_exist", "zeros_exist"),
    ),
    ("zeta <= n", (), ("window_ranks_indices", "zeros_exist")),
    (
        "iff(left_invertible and finite_zeros == unobservable_dimension, delay_unknown < inf)",
        (),
        ("trajectory_no_finite_zeros", "delay_any_state_exists", "zeros_exist"),
    ),
    (
        "implies(rank(F.T @ C.T) == m and 0 == finite_zeros, zeta == m)",
        ("rank(G) == 0", "left_invertible"),
        ("zero_feedthrough", "zeros_exist"),
    ),
    ("rank(hstack(A, I(n + lag))) <= 2 * n + lag and min(lag, delay_known) <= n", (), ("lag_at_most_n",)),
    ("delay_unknown <= rank(hstack(A, F))", ("delay_unknown < inf",), ("delay_by_the_range", "delay_any_state_longer")),
    ("n + m >= delay_unknown + rank(C)", ("delay_unknown < inf",), ("delay_by_outputs", "delay_any_state_longer")),
    (
        "delay_known >= controllability_index + infinite_zeros - n",
        ("left_invertible",),
        ("delay_by_controllability", "left_invertible_delay", "zeros_exist"),
    ),
]
ONLY_LOOKS_SO = [
    ("delay_unknown <= rank(hstack(A, F)) - 1", ("delay_unknown < inf",)),
    ("delay_unknown <= n + m - rank(C) - 1", ("delay_unknown < inf",)),
    ("delay_known > controllability_index + infinite_zeros + uncontrollable_dimension - n", ("left_invertible",)),
    ("lag <= n - 1", ()),
    ("lag < n", ()),
    ("all(gap(s) == m for s in windows(n - 1))", ("left_invertible",)),
    ("all(gap(s) == m for s in windows(n))", ("observable",)),
    ("all(gap(s) == m for s in windows(n))", ("left_invertible or observable",)),
    ("all(gap(s) < m for s in windows(n))", ("left_invertible",)),
    ("any(gap(s) != m for s in windows(n))", ("left_invertible",)),
    ("delay_known < n", ("left_invertible",)),
    ("delay_known <= n", ()),
    ("delay_unknown <= n", ("left_invertible",)),
    ("delay_known < delay_known + 1", ()),  # not where it is inf
    ("delay_unknown + delay_known >= delay_known", ()),  # true, but inf is not calculated with
    ("finite_zeros == weakly_unobservable_dimension", ()),
    ("n_z == m + zeta", ("observable",)),
    ("all(solutions(s) == n_z for s in windows(n))", ()),
    ("iff(zeta == m, rank(C @ F) == m)", ("is_zero(G)", "left_invertible")),
    ("iff(zeta == m, rank(C @ F) == m and finite_zeros == 0)", ("left_invertible",)),
    ("rank(A @ F) == rank(F @ A)", ("lag <= n",)),
    ("all(s >= 0 for s in windows(0 - 1)) and lag <= n", ()),
    ("all(implies(s >= n, rank_OT(s + 1) >= rank_OT(s) + m) for s in windows(0))", ("observable",)),
    ("any(gap(s) == m for s in windows(n, n - 1))", ("left_invertible",)),
    ("least(s for s in windows(0) if rank_T(s + 1) == rank_T(s)) == delay_known", ()),
    ("max(lag, delay_known) <= n", ()),
    ("min(n, delay_known) == delay_known", ()),
    # what may be -inf is not calculated with, and a matrix that may have no size says nothing of its size
    ("lag <= n and 0 - min(0, 0 - delay_known) < inf", ()),
    ("lag <= n and 0 - min(0, delay_known * (lag - n - 1)) < inf", ()),
    ("lag <= n and max(0 - delay_known, 0 - inf) < 1 + max(0 - delay_known, 0 - inf)", ("max(0 - delay_known, 0 - inf) < inf",)),
    ("lag == n and (n >= 0 or rank(I(lag - n)) == 0)", ()),
    ("lag == n and (n >= 0 or rank(zeros(1, lag - n)) == 0)", ()),
]

WITHOUT_A_VALUE = [
    ("left_invertible or n <= 20", ("min(n, -delay_known) <= n",)),
    ("left_invertible or n <= 20", ("delay_known <= 5 - min(n, 0 - delay_known)",)),
    ("left_invertible or n <= 20", ("max(-delay_unknown, n - delay_known) <= n",)),
    ("left_invertible or n <= 20", ("implies(left_invertible, rank(zeros(n - delay_known, 1)) >= 0)",)),
    ("lag <= min(n, 40)", ("implies(lag <= 40, rank(I(40 - lag)) >= 0)",)),
    ("lag <= n and n >= m", ("n < m or is_zero(zeros(p, n - m))",)),
]


@pytest.mark.parametrize(("conclusion", "hypotheses", "names"), FOLLOWS[:: every()])
def test_what_follows_is_proved_by_its_theorem(conclusion: str, hypotheses: tuple[str, ...], names: tuple[str, ...]) -> None:
    assert proved(conclusion, *hypotheses) == names


@pytest.mark.parametrize(("conclusion", "hypotheses"), ONLY_LOOKS_SO[:: every()])
def test_what_only_looks_like_a_theorem_is_not_proved(conclusion: str, hypotheses: tuple[str, ...]) -> None:
    assert proved(conclusion, *hypotheses) is None


def test_what_has_no_value_or_is_minus_infinity_proves_nothing() -> None:
    """It makes nothing finite, and no side of a matrix a number of rows."""
    assert [one for one in WITHOUT_A_VALUE if proved(one[0], *one[1])] == []


@pytest.mark.searches
def test_a_claim_of_the_ledger_is_proved_just_where_rocq_has_proved_it() -> None:
    verdicts = {f"{one.id}--{reading.id}": reading.proved for one in load() for reading in one.readings}
    listed = [one for one in readings().values() if one.about == SYSTEM]  # the theorems in the language are about single systems
    chosen = listed[:: 1 if every() == 1 else 10]
    assert len(listed) == 31
    for one in chosen:
        found = proof_of([each.that for each in one.hypotheses], one.conclusion)
        assert (found is not None) == (verdicts[one.id] == "PROVED"), one.id


def test_the_theorems_hold_on_small_systems_over_every_field() -> None:
    """What is believed of Rocq's theorems, as it is written in our language, is tried like a claim of anybody's."""
    for field in ("Q", "GF(2)", "GF(3)"):
        box = make_claim(
            "x", {"conclusion": "n >= 0", "fields": [field], "box": {"n": [0, 2], "m": [0, 2], "p": [0, 2], "total": 4}}
        ).boxes[field]
        found = search(box, [Question(one.hypotheses, one.conclusion) for one in theorems()], most=10**9, jobs=1, progress=silent).found
        for theorem, one in zip(theorems(), found, strict=True):
            assert one.failing is None and one.met > 0, (theorem.names, one.failing)
            assert one.undefined is None or "of a list of" in one.undefined.message


def test_the_theorems_are_locked_ones_of_the_ledger_or_its_words() -> None:
    locks = held(sources()).theorems
    assert all(name in locks for one in theorems() for name in one.names)
    found = proof_of([], read("lag <= n"))
    assert found is not None and dict(found.theorems) == {"lag_at_most_n": locks["lag_at_most_n"].sha256}


def test_a_refutation_of_a_theorem_is_an_error_of_ours(monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = (Theorem(("lag_at_most_n",), (), read("lag <= n - 1")),)
    monkeypatch.setattr(in_the_language, "theorems", lambda: wrong)
    with pytest.raises(ArithmeticError, match=r"follows from lag_at_most_n .* and yet A="):
        claim("lag + 1 <= n", box={"total": 3})


def test_the_answer_names_the_theorems_and_hypotheses_that_they_do_without() -> None:
    answer = claim("all(gap(s) == m for s in windows(n))", hypotheses=["left_invertible", "observable"], box={"total": 4}).answers[0]
    assert answer.verdict == Answered.PROVED and answer.proof is not None and "proposition_3" in answer.summary()
    assert answer.to_json()["theorems"] == dict(answer.proof.theorems) != {}
    assert answer.dropped is not None
    needed, unneeded = answer.dropped
    assert needed.verdict == Answered.REFUTED and unneeded.verdict == Answered.PROVED
    assert unneeded.words.startswith("not needed: without it the claim follows from proposition_3")
    over_two = claim("lag <= n", fields=["GF(2)"], box={"total": 3}).answers[0]
    assert over_two.verdict == Answered.PROVED
    nobody = claim("lag <= n", hypotheses=["n == 2", "n == 1"], box={"total": 3}).answers[0]
    assert nobody.verdict == Answered.VACUOUS and nobody.proof is None
    assert claim(lambda s: s.lag <= s.n, box={"total": 3}).answers[0].verdict == Answered.NOT_REFUTED  # nobody reads Python's functions


def test_not_refuted_is_expected_of_what_is_proved_and_not_the_other_way_round() -> None:
    given = {"conclusion": "lag <= n", "box": {"total": 3}}
    for expected, good in (("NOT REFUTED", True), ("PROVED", True), ("REFUTED", False)):
        (answer,) = deciding.decide(make_claim("x", {**given, "expected": expected}), ablation=False, most=10**9, jobs=1, progress=silent)
        assert answer.as_expected == good
    true = make_claim("x", {"conclusion": "delay_unknown >= delay_known", "box": {"total": 3}, "expected": "PROVED"})
    assert not deciding.decide(true, ablation=False, most=10**9, jobs=1, progress=silent)[0].as_expected


# -- attacked ----------------------------------------------------------------------------------------------------------

QUANTITIES = [
    *(
        "n",
        "m",
        "p",
        "normal_rank",
        "lag",
        "zeta",
        "n_z",
        "finite_zeros",
        "infinite_zeros",
        "delay_known",
        "delay_unknown",
        "inf",
        "0",
        "1",
    ),
    *("observability_index", "unobservable_dimension", "weakly_unobservable_dimension", "strongly_reachable_dimension", "rank(C @ F)"),
    *("nullity(G)", "sum(left_minimal_indices)", "sum(right_minimal_indices)", "len(left_minimal_indices)", "max(lag, delay_known)"),
]
SIGNS = ("<=", ">=", "==", "!=", "<", ">")
CONDITIONS = [
    *("observable", "controllable", "minimal", "left_invertible", "right_invertible", "strongly_observable", "p > m", "p == m", "n >= 1"),
    *("is_zero(G)", "normal_rank == p", "delay_unknown < inf", "delay_known < inf", "m == 0", "delay_unknown == delay_known"),
    *("lag <= delay_known", "delay_known <= delay_unknown", "p > normal_rank"),
]


def changed(rng: random.Random, hypotheses: Sequence[str], conclusion: str) -> tuple[list[str], str]:
    """Return a claim that differs in some places from a true one."""
    given = list(hypotheses)
    for _ in range(rng.choice((1, 1, 2, 3))):
        places = list(re.finditer(rf"\b({'|'.join(one for one in QUANTITIES if one.isidentifier())})\b", conclusion))
        starts = list(re.finditer(r"windows\([^(),]+", conclusion))
        match rng.randrange(7):
            case 0 if given:
                given.pop(rng.randrange(len(given)))
            case 1:
                given.append(rng.choice(CONDITIONS))
            case 2:
                conclusion = re.sub(r"<=|>=|==|!=|<|>", lambda at: rng.choice(SIGNS) if rng.random() < 0.3 else at.group(), conclusion)
            case 3 if places:
                at = rng.choice(places)
                conclusion = conclusion[: at.start()] + rng.choice(QUANTITIES) + conclusion[at.end() :]
            case 4 if starts:
                at = rng.choice(starts)
                conclusion = conclusion[: at.end()] + rng.choice((" - 1", " + 1", " + lag", " - lag")) + conclusion[at.end() :]
            case 5:
                forms = ("implies({}, {})", "iff({}, {})", "({1}) or {0}", "not ({1})")
                conclusion = rng.choice(forms).format(rng.choice(CONDITIONS), conclusion)
            case 6 if places:
                at = rng.choice(places)
                conclusion = conclusion[: at.end()] + rng.choice((" + 1", " - 1")) + conclusion[at.end() :]
    return given, conclusion


def true_claims() -> list[tuple[list[str], str]]:
    listed = [one for name in ("ledger", "literature", "claims", "papers") for one in read_claims(content(f"example:{name}").decode())]
    found = [([each.that.text for each in one.hypotheses], one.conclusion.text) for one in listed]
    return found + 3 * [([each.text for each in one.hypotheses], one.conclusion.text) for one in theorems()]


def attack(seed: int, count: int) -> tuple[int, list[str]]:
    """Return how many of so many changed claims are derived, and those of them that a small system refutes."""
    rng, base, followed, wrong = random.Random(seed), true_claims(), 0, []
    for _ in range(count):
        hypotheses, conclusion = changed(rng, *rng.choice(base))
        box = {"n": [0, 2], "m": [0, 2], "p": [0, 2], "total": 4}
        try:
            one = make_claim("x", {"hypotheses": hypotheses, "conclusion": conclusion, "box": box})
        except InvalidInput:
            continue
        nodes = tuple(each.that for each in one.hypotheses)
        if derived(nodes, one.conclusion, theorems()) is None:
            continue
        followed += 1
        question = Question(nodes, one.conclusion)
        found = search(one.boxes["Q"], [question], most=10**9, jobs=1, progress=silent).found[0]
        known = deciding._on_known_cases(question, one.boxes["Q"]) if found.open else None
        failing = found.failing if known is None else known.failing
        if failing is not None:
            wrong.append(f"{hypotheses} {conclusion} on {failing}")
    return followed, wrong


@pytest.mark.slow
def test_many_changed_claims_that_are_derived_are_not_refuted() -> None:
    """Each takes a second of processor time or two, nearly all of it for seeing that nothing is derived; some quarter of them is."""
    followed, wrong = attack(seed=6, count=400 if THOROUGH else 80)
    assert not wrong and followed > (60 if THOROUGH else 12)


@pytest.mark.slow
def test_the_attack_notices_a_rule_that_is_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    """With a theorem that says a little too much, changed claims are derived that small systems refute."""
    wrong = tuple(
        replace(one, hypotheses=()) for one in theorems() if one.names[0] in ("theorem_2", "zero_states_direct", "problem_11_dimension")
    )
    monkeypatch.setattr("tests.proofs.test_derived_claims.theorems", lambda: wrong)
    assert attack(seed=7, count=100)[1]


# -- readings that verify decides from their texts ---------------------------------------------------------------------


def test_readings_are_decided_on_answers_of_certificates() -> None:
    bench = Workbench("quick", 1, silent)
    bench.put_answers(CORPUS, [examine(name, system) for name, system in list(adversarial())[::4]])
    for name, expected in (("proposition-3--n-alone", "CERTIFIED"), ("window-ranks--limit", "CERTIFIED")):
        found = decide_reading(bench, name)
        assert found.verdict == expected and found.accepted > 0 and found.certificates


def test_a_reading_that_fails_is_refuted_by_the_smallest_of_its_box() -> None:
    bench = Workbench("quick", 1, silent)
    bench.put_answers(CORPUS, [examine(name, system) for name, system in adversarial()])
    found = decide_reading(bench, "assumption-4--n-minus-1-known")
    assert (
        found.verdict == Verdict.REFUTED and "the smallest with 1 <= n <= 3" in found.evidence and found.accepted == len(found.certificates)
    )
    same = claim(
        "all(gap(s) == m for s in windows(max(delay_known, n - 1, 1)))", hypotheses=["observable", "left_invertible"], ablation=False
    ).answers[0]
    assert same.counterexample is not None and str(same.counterexample.system) in found.evidence


def test_every_text_that_verify_uses_can_be_decided_by_certificates() -> None:
    used = {reading.check.partition(".")[2] for one in load() for reading in one.readings if reading.check.startswith(f"{IN_LANGUAGE}.")}
    assert len(used) >= 25
    for name in used:
        assert asked_by(*readings()[name].nodes)
