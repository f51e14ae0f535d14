"""The audit's own behaviour: the reference passes without one expected failure, faces agree, refusals and crashes are told apart."""

from __future__ import annotations

import tomllib
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from faultspace.base.errors import InvalidData
from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import FUNCTIONS, guarded, load
from faultspace.numeric.audit.checks.catalogue import all_checks, quick_checks
from faultspace.numeric.audit.checks.refusals import same_output_twice
from faultspace.numeric.audit.making.kinds_of_trouble import KINDS
from faultspace.numeric.audit.records import CheckResult, Demand, Measurement, message, perform
from faultspace.numeric.audit.reports.machines import endpoint
from faultspace.numeric.audit.running import ExpectedFailure, audit, parametrize_with_checks
from faultspace.numeric.audit.vectors.rationals import floats
from faultspace.numeric.audit.vectors.shipped_vectors import shipped
from tests.thorough import every

# Noisy records take a second each; that their units do not matter is asked daily of the same functions in `test_rows.py`.
DECORATED: Any = parametrize_with_checks(reference)
ASKED = [
    pytest.param(*case.values, id=case.id, marks=pytest.mark.slow if "noisy-other-units" in str(case.id) else ())
    for case in DECORATED.args[1]
]


@pytest.mark.parametrize("check", ASKED[:: every()])
def test_the_reference_passes_every_check(check: Any) -> None:
    record: CheckResult = check()
    if record.ratio is not None:
        print(f"{record.name}: got {record.got:.2g}, bound {record.bound:.2g}, ratio {record.ratio:.2g}")


def test_every_function_has_checks_that_hold_and_that_refuse() -> None:
    checks = list(all_checks())
    assert {one.function for one in checks} == set(FUNCTIONS)
    assert {one.function for one in checks if one.kind is Demand.MUST_REFUSE} == set(FUNCTIONS)
    named = [(one.name, one.function) for one in checks]
    assert len(named) == len(set(named))


def _model_of(vector: Any, states: int = 0) -> Any:
    """Return the exact model, with so many states more, which nothing drives and no output shows."""
    A, B, C, D = (floats(one) for one in (vector.A, vector.B, vector.C, vector.D))
    return np.pad(A, (0, states)), np.pad(B, ((0, states), (0, 0))), np.pad(C, ((0, 0), (0, states))), D


def test_who_is_right_where_a_refusal_would_do_is_not_accused() -> None:
    """Published packages were: their models were right to 3e-15, or their columns all that there are."""
    model = next(one for one in shipped("identification") if one.slug == "n3-u2-p2")
    faulty = next(one for one in shipped("faults") if one.slug == "two-faults")
    exact, everything = _model_of(model), np.eye(faulty.system.n + faulty.system.p)
    asked = {(one.slug, one.function, one.vector): one for one in all_checks()}
    for slug, function, vector, answer in (
        ("refuses-window-at-the-lag", "identify", "same-output-twice", _model_of(same_output_twice())),
        ("refuses-impossible-order", "identify", "n3-u2-p2", _model_of(model, 6)),
        ("refuses-nan-output", "identify", "n3-u2-p2", exact),
        ("refuses-no-number", "identify", "n3-u2-p2-y-infinity-in-the-corner", exact),
        ("refuses-no-number", "identify", "n3-u2-p2-u-nan", exact),
        ("refuses-too-many-faults", "fault_space", "two-faults", floats(faulty.space)),
        ("refuses-pure-noise", "fault_space", "two-faults", everything),
    ):
        check = asked[slug, function, vector]
        wrong = tuple(-one for one in answer) if function == "identify" else answer[:, :1]
        verdicts = [perform(check, guarded(lambda *arguments, found=found: found)).verdict for found in (answer, None, wrong)]
        assert verdicts == ["pass", "pass", "fail"], (slug, verdicts)


def test_every_claim_is_in_the_ledger() -> None:
    ledger = tomllib.loads((Path(__file__).resolve().parents[3] / "proofs" / "verdict" / "ledger.toml").read_text("utf-8"))
    known = set(ledger["claim"])
    named = {one.claim for one in all_checks()} - {None}
    assert len(named) >= 6 and named <= known


def test_only_what_is_there_is_tested() -> None:
    records = audit(SimpleNamespace(window_ranks=reference.window_ranks))
    assert {record.function for record in records} == {"window_ranks"} and not any(record.failed for record in records)
    with pytest.raises(InvalidData, match="none of the functions"):
        audit(SimpleNamespace(identity=1))


def _raises(error: BaseException) -> Any:
    def function(*arguments: Any) -> Any:
        raise error

    return function


@pytest.mark.parametrize(
    ("function", "verdict"),
    [
        (_raises(ValueError("no")), "refused"),
        (_raises(np.linalg.LinAlgError("singular")), "refused"),
        (lambda r: None, "refused"),
        (_raises(IndexError("out of range")), "broken"),
        (_raises(MemoryError()), "broken"),
        (_raises(TypeError("of ours")), "broken"),
        (_raises(SystemExit(0)), "broken"),
        (lambda r: "many", "broken"),
        (lambda r: float("nan"), "fail"),
        (lambda r: 2, "fail"),
        (lambda r: 1, "pass"),
    ],
)
def test_verdicts(function: Any, verdict: str) -> None:
    (record,) = audit(SimpleNamespace(fault_dimension=function), only=["fault-dimension[one-fault]"])
    assert record.verdict == verdict
    assert record.failed == (verdict != "pass")


def test_a_crash_on_data_to_be_refused_is_no_refusal() -> None:
    (record,) = audit(SimpleNamespace(fault_dimension=_raises(IndexError("x"))), only=["refuses-nan-residual"])
    assert record.verdict == "broken" and record.failed


@pytest.mark.parametrize("answer", [3, (1, 2, 3, 4), ([[1.0]], [[1.0]], [[1.0]], [[np.nan]]), (np.eye(3),) * 4, "four"])
def test_what_is_no_model_is_broken(answer: Any) -> None:
    (record,) = audit(SimpleNamespace(identify=lambda *_: answer), only=["exact-recovery[n2-u1-p1]"])
    assert record.verdict == "broken" and record.detail


def test_a_failure_is_told_with_the_line_that_shows_it_again() -> None:
    (record,) = audit(SimpleNamespace(fault_dimension=lambda r: 3), only=["fault-dimension[one-fault]"])
    words = message(record, "mine.py")
    for part in ("fault-dimension[one-fault]", "got 2", "bound 0", "ratio inf", "a wrong number of faults"):
        assert part in words
    assert words.endswith("faultspace audit mine.py --check 'fault-dimension[one-fault]-fault_dimension'")
    assert record.to_json()["ratio"] == "inf"


def test_an_expected_failure_passes_and_turns_red_when_it_passes() -> None:
    mark = ExpectedFailure("fault-dimension[one-fault]", "counts to two")
    (record,) = audit(SimpleNamespace(fault_dimension=lambda r: 2), only=[mark.name], expected=[mark])
    assert not record.failed and "counts to two" in record.detail
    (record,) = audit(reference, only=[mark.name], expected=[mark])
    assert record.failed and "take the mark away" in record.detail
    (one, other) = audit(
        SimpleNamespace(window_ranks=_raises(ValueError("no")), fault_dimension=_raises(ValueError("no"))),
        only=["refuses-nan-residual"],
        expected=[ExpectedFailure("refuses-nan-residual[two-faults]-fault_dimension", "of one function alone")],
    )
    assert (one.function, one.failed) == ("window_ranks", False) and (other.function, other.failed) == ("fault_dimension", True)
    (record,) = audit(SimpleNamespace(fault_dimension=_raises(IndexError("x"))), only=[mark.name], expected=[mark])
    assert record.failed and record.verdict == "broken"
    with pytest.raises(InvalidData, match="needs a reason"):
        ExpectedFailure("fault-dimension", " ")
    with pytest.raises(InvalidData, match="none of that name"):
        audit(reference, expected=[ExpectedFailure("no-such-check", "why")])


def test_the_pytest_face_is_red_where_the_records_are() -> None:
    decorated: Any = parametrize_with_checks(SimpleNamespace(fault_dimension=lambda r: 2))
    cases = {case.id: case.values[0] for case in decorated.args[1]}
    with pytest.raises(AssertionError, match=r"fault-dimension\[one-fault\](?s:.*)answered 2, true 1"):
        cases["fault-dimension[one-fault]-fault_dimension"]()
    cases["fault-dimension[two-faults]-fault_dimension"]()


def test_a_ratio_is_never_hidden() -> None:
    assert Measurement("x", 0.0, 0.0).ratio == 0 and Measurement("x", 1e-300, 0.0).ratio == np.inf
    assert Measurement("x", float("nan"), 1.0).ratio == np.inf and Measurement("x", 1.0, 2.0).ratio == 0.5


def test_adapters_by_name(tmp_path: Path) -> None:
    file = tmp_path / "mine.py"
    file.write_text("class Mine:\n    def fault_dimension(self, r):\n        return 1\n\ndef fault_dimension(r):\n    return 2\n", "utf-8")
    assert load(f"{file}:Mine").fault_dimension(None) == 1  # type: ignore[attr-defined]
    assert load(str(file)).fault_dimension(None) == 2  # type: ignore[attr-defined]
    assert load("faultspace.numeric.audit.reference") is reference
    broken = tmp_path / "broken.py"
    broken.write_text("1 / 0\n", "utf-8")
    for name in (f"{file}:Yours", str(tmp_path / "none.py"), "no.such.module:x", str(broken)):
        with pytest.raises(InvalidData, match="adapter"):
            load(name)


def _off_by(ratio: float, **changes: Any) -> CheckResult:
    """Return the result of a check whose only measurement is so many bounds off."""
    (check,) = (one for one in all_checks() if one.full_name == "fault-space[one-fault]-fault_space")
    return perform(replace(check, measure=lambda function: [Measurement("angle", ratio, 1.0)], **changes), len)


@pytest.mark.parametrize(
    ("ratio", "changes", "verdict", "failed"),
    [
        (1.0, {}, "pass", False),
        (1.1, {}, "near", False),
        (9.9, {}, "near", False),
        (10.0, {}, "fail", True),
        (1.1, {"nearness": 1.0}, "fail", True),
    ],
)
def test_a_miss_by_less_than_ten_bounds_of_rounding_is_near(ratio: float, changes: Any, verdict: str, failed: bool) -> None:
    record = _off_by(ratio, **changes)
    assert (record.verdict, record.failed) == (verdict, failed)


def test_what_is_no_bound_of_rounding_knows_nothing_near() -> None:
    """The bias of a method, an exponent of growth, a level under noise and an answer given twice are on one side or on the other."""
    strict = {one.slug for one in all_checks() if one.nearness == 1}
    assert strict == {
        "consistent-under-coloured-fault",
        "memory-grows-with-N",
        "time-grows-with-N",
        "right-on-long-records",
        "space-of-record-noisy",
        "space-of-record-noisy-other-units",
        "earlier-answers-stay",
        "forgets-the-records",
        "one-argument-changed",
        "same-beginning",
    }


def test_what_was_never_promised_is_counted_apart(tmp_path: Path) -> None:
    text = "NOT_PROMISED = {'fault-dimension/two-*': 'one fault only'}\ndef fault_dimension(r):\n    return 1\n"
    mine = tmp_path / "mine.py"
    mine.write_text(text, "utf-8")
    only = ["fault-dimension[two-faults]", "fault-dimension[bad-units]"]
    for adapter_ in (str(mine), load(str(mine))):
        here, other = told = audit(adapter_, only=only)
        assert (here.verdict, here.failed, here.not_promised) == ("fail", False, "one fault only")
        assert (other.verdict, other.failed, other.not_promised) == ("fail", True, "")
        assert told.title.endswith(": 1 failed, 1 not met that it never promised")
        nothing_passed = endpoint([here])
        assert nothing_passed["message"] == "0 of 1 passed" and nothing_passed["color"] == endpoint([other])["color"]
    with pytest.raises(InvalidData, match="NOT_PROMISED"):
        audit(SimpleNamespace(fault_dimension=len, NOT_PROMISED={"*": " "}))


def test_the_quick_set_has_every_question_once_and_every_kind_of_trouble() -> None:
    whole, part = list(all_checks()), list(quick_checks(all_checks()))
    owed = [one for one in whole if one.kind != Demand.FREE]  # what is free fails nobody
    assert {(one.slug, one.function) for one in owed} == {(one.slug, one.function) for one in part}
    assert {kind.slug for kind in KINDS} <= {one.vector for one in part} and len(part) < 0.7 * len(whole)


def test_a_seed_is_a_natural_number() -> None:
    for seed in (-1, 1.5, True):
        with pytest.raises(InvalidData, match="seed"):
            audit(reference, seed=seed)  # type: ignore[arg-type]
