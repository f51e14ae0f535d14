"""The adversary finds what is false from nothing, loses it when its sign test is taken away, and its stored results are checked again."""

from __future__ import annotations

import json
import os
import re
import signal
import time
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from importlib import resources
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from faultspace.base.errors import InvalidData
from faultspace.exact.limits.moesp import limit
from faultspace.exact.limits.moments import covariances
from faultspace.proofs import verification
from faultspace.proofs.adversary import attacking, engine, following, results
from faultspace.proofs.adversary.attacking import Attacking, looked_at_again, of_reading, of_row
from faultspace.proofs.adversary.catalogue import catalogue, expected_of, statement_of
from faultspace.proofs.adversary.engine import pursue
from faultspace.proofs.adversary.float_limits import exact_experiment, float_limits
from faultspace.proofs.adversary.following import Trace
from faultspace.proofs.adversary.limit_attacks import led_family, open_family, shaped_family, shaped_input
from faultspace.proofs.adversary.results import AttackRecord, certified, checked_again, refuting, run_attacks, stored
from faultspace.proofs.adversary.rounding import rational_roots, solve_affine
from faultspace.proofs.evidence.attacks import Attack, Attacked, Floats
from faultspace.proofs.hypotheses.consistency import consistency
from faultspace.proofs.trust import checker
from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.verdicts import Outcome, ReadingResult, Verdict
from tests.thorough import THOROUGH, every

FILE = Path(results.__file__).with_name(results.FILE)

FALSE_REPAIR = "proposition-1.two-sided-range by a double pole"


def attack(name: str) -> Attack:
    return next(one for one in catalogue() if one.id == name)


@pytest.mark.parametrize("seed", [0, 1, 2][:: every()])
def test_the_false_repair_is_found_from_nothing(seed: int) -> None:
    started = time.process_time()
    trial = pursue(attack(FALSE_REPAIR), seconds=60, seed=seed)
    assert trial.witness is not None, trial
    assert time.process_time() - started < 20
    drawn = trial.attack.family.at(trial.witness.point)
    limits = limit(exact_experiment(drawn))
    assert limits.past_inputs.rank < limits.past_inputs.observability_rank == len(drawn.A)
    for certificate in trial.witness.certificates:
        checker.verify(certificate)


def test_without_its_sign_test_the_engine_does_not_find_it(monkeypatch: pytest.MonkeyPatch) -> None:
    def blind(trace: Trace) -> Iterator[Floats]:
        yield from ()

    monkeypatch.setattr(engine, "crossings", blind)
    trial = pursue(attack(FALSE_REPAIR), seconds=8 if THOROUGH else 2, seed=0)
    assert trial.witness is None and trial.bracket is None
    assert trial.evaluations > 100


@pytest.mark.slow
def test_where_no_zero_is_rational_two_exact_points_of_opposite_sign_prove_one() -> None:
    one = attack("proposition-1.two-sided-range by a double pole and a moving average")
    assert one.exact is not None
    trial = pursue(one, seconds=60, seed=0)
    assert trial.witness or trial.bracket
    if trial.bracket is not None:
        first, second = (one.exact(point) for point in trial.bracket)
        assert first * second < 0


def test_no_file_of_counterexamples_is_read() -> None:
    folder = Path(engine.__file__).parent
    sources = "".join(path.read_text("utf-8") for path in folder.glob("*.py"))
    assert "refuting_experiments" not in sources and "counterexamples/" not in sources


QUICK = (
    "proposition-1.white-a-c by a fault one sample ahead",
    "settle-1.for-every-system by n = 1, p = 2",
    "settle-1.a-c-wrong by n = 2, p = 2",
    "past-outputs.coloured-fault by all matrices free",
    "theorem-3-ii.every-p by D = 0",
    "theorem-2.finite-zeros-only by one state: det G",
    "assumption-4.excitation-at-s by a singular [X; V_(s+1)]",
    "bad-set.codimension-unobservable by a hidden state: det G",
)


@pytest.mark.parametrize("name", QUICK[:: every()])
def test_what_is_refuted_is_found_to_be(name: str) -> None:
    trial = pursue(attack(name), seconds=60, seed=3)
    assert trial.witness is not None, trial
    for certificate in trial.witness.certificates:
        checker.verify(certificate)


def test_every_target_is_in_the_ledger_and_no_attack_is_on_what_a_theorem_says() -> None:
    """An attack that found nothing is on a row, or on what no theorem says."""
    targets = {one.target for one in catalogue()}
    assert {target for target in targets if statement_of(target) is None} == set(), "an attack on what the ledger does not name"
    proved = {f"{claim.id}.{one.id}" for claim in load() for one in claim.readings if one.theorems}
    assert {record["attack"] for record in stored() if not refuting(record) and record["target"] in proved} == set()


@pytest.mark.searches
def test_the_file_of_results_is_whole_up_to_date_and_as_expected() -> None:
    schema = json.loads(resources.files("faultspace.proofs").joinpath("schemas/adversary.schema.json").read_text("utf-8"))
    jsonschema.Draft202012Validator(schema).validate(json.loads(FILE.read_text("utf-8")))
    stale = "python -m faultspace.proofs.adversary --stale --out proofs/adversary/results.json runs what is missing"
    assert [record["attack"] for record in stored()] == [one.id for one in catalogue()], stale
    again = "python -m faultspace.proofs.adversary --reading ID --out proofs/adversary/results.json runs an attack again"
    for target in dict.fromkeys(one.target for one in catalogue()):
        found = checked_again(target)
        assert [one.trouble for one in found if one.trouble] == [], f"{target}: {again}"
        assert any(one.refutes for one in found) == (expected_of(target) == "REFUTED"), target


def test_numbers_changed_in_the_file_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the digest as it was, whatever was changed; with a digest made anew, the starts that the attack has not."""
    quick = [one for one in stored() if one["outcome"] == results.NONE and one.get("starts") and one["seconds"] <= results.AGAIN]
    quickest = min(quick, key=lambda one: one["seconds"])
    target = quickest["target"]
    (first,) = checked_again(target, [quickest])
    assert first.words.startswith("On record: No counterexample was found") and first.words.endswith("no counterexample")
    assert first.trouble is None and re.search(r"now: \d+ values, \d+ points decided exactly", first.words)

    data = json.loads(FILE.read_text("utf-8"))
    for changes in ({"starts": 5000000}, {"evaluations": 10**9}, {"decided": 10**9}, {"seconds": 1e6}, {"date": "2030-01-01"}):
        forged = {**data, "attacks": [one | changes if one["attack"] == first.id else one for one in data["attacks"]]}
        for again in (False, True):
            if again:
                results.write(forged["attacks"], tmp_path / results.FILE)
            else:
                (tmp_path / results.FILE).write_text(json.dumps(forged), "utf-8")
            with monkeypatch.context() as patched:
                patched.setattr(resources, "files", lambda package: tmp_path)
                records = stored.__wrapped__()
            (found,) = checked_again(target, [record for record in records if record["attack"] == first.id])
            if not again:
                assert found.trouble == "not found again: results.json is not the file whose SHA-256 it tells"
            elif "starts" in changes:
                assert found.trouble == f"not found again: the attack has {attack(first.id).starts} starts, and 5000000 were stored"
            assert found.words.startswith("On record: "), "whatever else is forged is not told as done now"


def record_of(name: str) -> AttackRecord:
    return next(record for record in stored() if record["attack"] == name)


def test_a_record_that_was_tampered_with_is_noticed() -> None:
    record = record_of(FALSE_REPAIR)
    target = record["target"]
    assert [one.trouble for one in checked_again(target, [record])] == [None]
    other_words = record | {"statement_sha256": "0" * 64}
    nearer = record | {"nearest": record["nearest"] + 0.5}
    witness = record["witness"]
    moved = record | {"witness": witness | {"point": ["0", *witness["point"][1:]]}}
    renamed = record | {"witness": witness | {"certificates": [{"kind": "moesp-limit", "sha256": "0" * 64}]}}
    of_another_kind = record | {"witness": witness | {"certificates": [one | {"kind": "other"} for one in witness["certificates"]]}}
    forged = {
        "family": "all systems of any size", "measured": "everything", "aim": "x", "outcome": "proved for all systems", "point": [],
        "nearest": float("nan"), "witness": witness | {"words": "A = 0: everything fails"},
    }  # fmt: skip
    both = [["1/3"] * len(record["point"])] * 2
    outside = [["5"] * len(both[0])] * 2
    brackets = [record | {"outcome": results.CHANGE, "witness": None, "bracket": found} for found in (both, outside, None)]
    words = ("another family", "another measured", "another aim", "its outcome", "parameters", "value", "other words")
    spoilt_records = [
        (other_words, "out of date"), (nearer, "value"), (moved, "no counterexample"), (renamed, "certificates"),
        (of_another_kind, "certificates"),
        *((record | {name: said}, word) for (name, said), word in zip(forged.items(), words, strict=True)),
        *zip(brackets, ("signs", "not in the family", "its outcome"), strict=True),
    ]  # fmt: skip
    for spoilt, word in spoilt_records:
        (attacked,) = checked_again(target, [spoilt])
        assert attacked.trouble is not None and word in attacked.trouble
        assert not attacked.refutes


def test_a_counterexample_that_the_file_hides_is_found_whatever_time_it_tells() -> None:
    """A search that took long was not done again, and how long it took stands in the same file."""
    record = record_of("canonical-form.feedback by feedback: det of the first n rows of O_n")
    hidden = record | {"outcome": results.NONE, "witness": None, "bracket": None, "seconds": 9.0, "whole": True}
    (attacked,) = checked_again(record["target"], [hidden])
    assert attacked.trouble is not None and "finds something now" in attacked.trouble
    assert attacked.words.endswith("the beginning of it now, a counterexample")


def reading_result(target: str, verdict: Verdict) -> tuple[ReadingResult, str]:
    name, _, reading = target.partition(".")
    claim = next(claim for claim in load() if claim.id == name)
    return ReadingResult(next(one for one in claim.readings if one.id == reading), Outcome(verdict, "on systems"), 0.0), name


def test_what_holds_with_neither_a_locked_theorem_nor_an_attack_is_an_error() -> None:
    """It was as expected. A theorem counts where its statement is locked, and an attack where it is on the words as they are."""
    result, claim = reading_result("past-outputs.white-fault", Verdict.CERTIFIED)

    def decided(attacks: Attacking, verdict: Verdict = Verdict.CERTIFIED, **changed: object) -> Outcome:
        given = replace(result, reading=replace(result.reading, **changed), outcome=Outcome(verdict, "on systems"))  # type: ignore[arg-type]
        return of_reading(given, claim, attacks).outcome

    found_nothing = Attacked("one", "none found", False, None)
    assert decided(Attacking(())).verdict == Verdict.CERTIFIED, "its theorem is locked, and need not be compiled"
    for theorems in (), ("no_such_theorem",), (*result.reading.theorems, "no_such_theorem"):
        for verdict in Verdict.CERTIFIED, Verdict.IDENTITY:
            bare = decided(Attacking(()), verdict, theorems=theorems)
            assert bare.verdict == Verdict.ERROR and "no locked theorem says it, and no attack" in bare.evidence
        target = f"{claim}.{result.reading.id}"
        attacked = decided(Attacking((), {target: (found_nothing,)}), theorems=theorems)
        assert attacked.verdict == Verdict.CERTIFIED
        old = decided(Attacking((), {target: (replace(found_nothing, trouble="out of date", stale=True),)}), theorems=theorems)
        assert old.verdict == Verdict.ERROR
    assert decided(Attacking(()), Verdict.REFUTED, theorems=()).verdict == Verdict.REFUTED, "a counterexample stands by itself"


def test_verify_does_not_expect_what_rests_on_cases_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """A ledger that names no theorem has readings that nothing attacked: `verify` was content with them."""
    (claim,) = (one for one in load() if one.id == "example-v")
    bare = replace(claim, readings=tuple(replace(one, theorems=()) for one in claim.readings))
    monkeypatch.setattr(verification, "load", lambda: (bare,))
    (found,) = verification.verify(["example-v"], jobs=1).claims
    standing = [one for one in found.readings if one.reading.expected != "REFUTED"]
    assert standing and {one.outcome.verdict for one in standing} == {Verdict.ERROR} and not found.as_expected


def test_a_confirmed_counterexample_decides_a_reading_and_one_that_is_not_found_again_is_an_error() -> None:
    record = record_of(FALSE_REPAIR)
    result, claim = reading_result(record["target"], Verdict.CERTIFIED)
    decided = of_reading(result, claim, Attacking((record,)))
    assert decided.outcome.verdict == Verdict.REFUTED
    assert decided.to_json()["attacks"][0]["refutes"]
    spoilt = record | {"witness": record["witness"] | {"point": ["0", *record["witness"]["point"][1:]]}}
    assert of_reading(result, claim, Attacking((spoilt,))).outcome.verdict == Verdict.ERROR
    old = record | {"statement_sha256": "0" * 64}
    kept = of_reading(result, claim, Attacking((old,)))
    assert kept.outcome.verdict == Verdict.CERTIFIED
    assert kept.attacks[0].trouble is not None


def test_other_processes_check_the_records_again_as_this_one_does() -> None:
    """What a worker finds of a record that was tampered with comes back as it is, and a target without records is none of its tasks."""
    record = record_of(FALSE_REPAIR)
    spoilt = record | {"witness": record["witness"] | {"point": ["0", *record["witness"]["point"][1:]]}}
    for given in (record, spoilt):
        attacks = looked_at_again(Attacking((given,)), [record["target"], "theorem-1.sharp"], 2)
        assert attacks.again == {record["target"]: checked_again(record["target"], [given])}
        result, claim = reading_result(record["target"], Verdict.CERTIFIED)
        assert of_reading(result, claim, attacks) == of_reading(result, claim, Attacking((given,)))
    assert attacks.again[record["target"]][0].trouble is not None


def test_a_record_whose_check_ends_its_process_leaves_no_verdict(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(attacking, "checked_again", _dies)
    with pytest.raises(InvalidData, match=r"task 1 of 1 came to no end: the process that worked on it ended"):
        looked_at_again(Attacking(None), [record_of(FALSE_REPAIR)["target"]], 2)


def _dies(target: str, records: object) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def test_a_row_of_the_hypothesis_table_gives_way_too() -> None:
    record = record_of("without consistency: u white by a double pole")
    row = consistency().row(("u white",), Outcome(Verdict.CERTIFIED, "on experiments"))
    assert of_row(row, Attacking((record,))).verdict == Verdict.REFUTED
    assert of_row(replace(row, dropped=("u white", "past >= n")), Attacking((record,))).verdict == Verdict.CERTIFIED
    assert of_row(row, Attacking(())).verdict == Verdict.ERROR, "nothing attacked it, and no theorem says it"
    assert of_row(replace(row, implied="it follows"), Attacking(())).verdict == Verdict.CERTIFIED


def test_a_run_makes_the_records_that_are_stored_but_for_the_seconds() -> None:
    name = "theorem-2.finite-zeros-only by one state: det G"
    (made,) = run_attacks([attack(name)], seconds=60, seed=record_of(name)["seed"])
    varying = {"seconds", "date", "nearest", "point", "whole"}
    assert {k: v for k, v in made.items() if k not in varying} == {k: v for k, v in record_of(name).items() if k not in varying}
    assert refuting(made)


FAMILIES = (
    shaped_family(2, 2, 3, 3, 1),
    shaped_family(3, 2, 3, 2, 0, repeated=True),
    led_family(2, 2, (0, 1), reflections=2),
    led_family(1, 2, (1, 0, 2), taps=2),
    open_family(2, 1),
)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.words[:40])
def test_limits_in_floats_are_the_exact_ones(family: object) -> None:
    rng = np.random.default_rng(5)
    low, high = np.array(family.box).T  # type: ignore[attr-defined]
    for _ in range(3):
        point = [Fraction(x).limit_denominator(20) for x in rng.uniform(0.7 * low, 0.7 * high)]
        limits = limit(exact_experiment(family.at(point)))  # type: ignore[attr-defined]
        floats = float_limits(family.at([float(x) for x in point]))  # type: ignore[attr-defined]
        for exact, found in ((limits.past_inputs.matrix, floats.past_inputs), (limits.past_outputs.matrix, floats.past_outputs)):
            wanted = np.array([[int(x.p) / int(x.q) for x in row] for row in exact.elements()])
            np.testing.assert_allclose(found, wanted, atol=1e-9 * np.abs(wanted).max())


def test_an_input_has_the_reflection_coefficients_it_was_made_of() -> None:
    """They are found again by Levinson's recursion on its exact covariances."""
    wanted = [Fraction(1, 3), Fraction(-3, 4), Fraction(1, 2), Fraction(-1, 5)]
    made = shaped_input(wanted, [Fraction(1, 2), Fraction(-2, 3)], Fraction(4, 5))
    drawn = shaped_family(1, 1, 1, 1, 0).at([Fraction(0), Fraction(0)])
    drawn = replace(drawn, u_taps=[[[x, 0]] for x in made.numerator], u_den=made.denominator)
    known = covariances(exact_experiment(drawn))
    r = [known.sequence(known.process.u, known.process.u, k, k)[k][0, 0] for k in range(5)]
    predictor, found = [r[0] / r[0]], []
    for k in range(1, 5):
        error = sum(a * r[i] for i, a in enumerate(predictor))
        gain = -sum(a * r[k - i] for i, a in enumerate(predictor)) / error
        found.append(-gain)
        padded = [*predictor, predictor[0] * 0]
        predictor = [a + gain * b for a, b in zip(padded, padded[::-1], strict=True)]
    assert [Fraction(int(x.p), int(x.q)) for x in found] == wanted


def test_rational_roots_of_a_rational_function_are_found_exactly() -> None:
    def value(x: Fraction) -> Fraction:
        return (7 * x - 3) * (x * x - 2) / (x * x + 1)

    assert rational_roots(value, Fraction(0), Fraction(1)) == (Fraction(3, 7),)
    assert rational_roots(value, Fraction(1), Fraction(2)) == ()
    assert rational_roots(lambda x: x**40 - 2, Fraction(0), Fraction(2)) is None


def test_affine_equations_are_solved_near_the_point_and_others_refused() -> None:
    point = (Fraction(1), Fraction(2), Fraction(3))
    solved = solve_affine(lambda x: [x[0] * x[1] + x[2] - 1], point, (1, 2))
    assert solved == (Fraction(1), Fraction(0), Fraction(1))
    assert solve_affine(lambda x: [x[1] * x[1] - 1], point, (1,)) is None
    assert solve_affine(lambda x: [x[1] - x[1] + 1], point, (1,)) is None


def test_a_trace_remembers_signs_but_not_those_of_rounding() -> None:
    trace = Trace(lambda x: float(x[0]))
    for value in (0.5, -0.25, 1e-12):
        trace.number(np.array([value]))
    assert trace.nearest == 1e-12
    assert [len(trace.signs[side]) for side in (True, False)] == [1, 1]
    (zero,) = following.crossings(trace)
    assert abs(zero[0]) < 1e-9


def test_certificates_of_a_stored_counterexample_are_made_anew() -> None:
    """The point is decided again: where it refutes, its certificates come anew; where it does not, nothing is made up."""
    record = next(one for one in stored() if one["witness"] is not None and one["point"])
    witness = record["witness"]
    assert witness is not None
    old: AttackRecord = {**record, "witness": {**witness, "certificates": [{"kind": "window-ranks", "sha256": "0" * 64}]}}
    assert certified(old) == record
    elsewhere: AttackRecord = {**old, "witness": {**old["witness"], "point": ["1/7"] * len(witness["point"])}}
    assert certified(elsewhere) == elsewhere
    without: AttackRecord = {**record, "witness": None}
    assert certified(without) == without
