"""Reports: failures folded, expected failures from a file, patterns, JUnit, badges, versions, and signatures seen before anything runs."""

from __future__ import annotations

import hashlib
import json
import re
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from faultspace.base.errors import InvalidData
from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import ARGUMENTS, fitting
from faultspace.numeric.audit.checks.catalogue import all_checks, chosen
from faultspace.numeric.audit.expectations import ExpectedFailure, expected_in
from faultspace.numeric.audit.outcome import Audit
from faultspace.numeric.audit.records import CheckResult, Demand, Named, Severity, Sides, Status, first_difference, named, patterned, plain
from faultspace.numeric.audit.reports import causes as folding
from faultspace.numeric.audit.reports.causes import beside, lines_of
from faultspace.numeric.audit.reports.machines import endpoint, junit_xml, svg
from faultspace.numeric.audit.reports.versions import versions
from faultspace.numeric.audit.running import parametrize_with_checks
from tests.end_to_end.commands import call

FIELDS = st.text(st.characters(codec="utf-8"), max_size=20)


def result(slug: str, vector: str, verdict: str = "fail", function: str = "identify", **more: Any) -> CheckResult:
    """A result of a check that must hold."""
    given = {"claim": "proposition-1", "kind": str(Demand.MUST_HOLD), "detail": "", **more}
    claim, kind, detail = (given.pop(name) for name in ("claim", "kind", "detail"))
    asked = (slug, function, vector, claim, "the model is wrong", str(Severity.SILENT), kind, verdict)
    return CheckResult(*asked, "poles", 2.0, 1.0, 2.0, detail, 0.5, **given)


# -- folds -------------------------------------------------------------------------------------------------------------------------


def test_views_of_a_vector_are_one_cause_and_so_are_repeats_of_an_exception() -> None:
    views = [result(slug, "two-faults") for slug in ("exact-recovery", "exact-recovery-1e-12", "other-units")]
    crashes = [result("exact-recovery", f"v{k}", "broken", detail=f"crashed with IndexError: index {k}") for k in range(5)]
    other = result("exact-recovery", "v9", "broken", detail="crashed with KeyError: 'A'")
    found = folding.causes([*views, *crashes, other])
    assert [one.title for one in found] == [
        "identify: fail: exact-recovery[two-faults] x 3 views",
        "identify: broken: exact-recovery[v0], and 4 checks of 4 other vectors",
        "identify: broken: exact-recovery[v9]",
    ]


def test_one_explanation_is_one_cause_whatever_the_vectors_but_not_whatever_the_function() -> None:
    same = [result("a", f"v{k}", explanation="D is ignored.") for k in range(3)]
    other = result("a", "v0", function="residual", explanation="D is ignored.")
    found = folding.causes([*same, other, result("a", "w")])
    assert [(one.first.function, len(one.results), one.explanation) for one in found] == [
        ("identify", 3, "D is ignored."),
        ("residual", 1, "D is ignored."),
        ("identify", 1, ""),
    ]


def test_many_failures_of_one_slug_that_nothing_explains_are_one_entry_with_all_names() -> None:
    many, few = [result("a", f"v{k}") for k in range(5)], [result("b", f"w{k}") for k in range(3)]
    found = folding.causes([*many, *few])
    assert [one.title for one in found][:2] == ["identify: fail: a[v0], and 4 checks of 4 other vectors", "identify: fail: b[w0]"]
    assert "all of: v0, v1, v2, v3, v4" in list(lines_of(found[0], "mine.py")) and len(found) == 4


VERDICTS = st.sampled_from([str(one) for one in Status])
RESULTS = st.lists(
    st.builds(
        result,
        st.sampled_from("abc"),
        st.sampled_from("uvw"),
        VERDICTS,
        st.sampled_from(["identify", "residual"]),
        kind=st.sampled_from([str(one) for one in Demand]),
        detail=st.sampled_from(["", "index 1", "index 2", "no"]),
        explanation=st.sampled_from(["", "D is ignored."]),
    ),
    max_size=30,
)


@given(RESULTS)
def test_every_failure_is_in_one_cause_and_nothing_green_is(results: list[CheckResult]) -> None:
    found = folding.causes(results)
    together = [one for cause in found for one in cause.results]
    assert sorted(map(id, together)) == sorted(map(id, folding.told(results)))
    assert {id(one) for one in results if one.failed} <= set(map(id, together))
    assert not any(one.verdict == Status.PASS for one in together)
    assert all(len({one.function for one in cause.results}) == 1 for cause in found)
    assert len(Audit("x", tuple(results)).causes) == len(found)


@given(RESULTS)
def test_a_tally_counts_every_verdict_that_there_is(results: list[CheckResult]) -> None:
    for tally in Audit("x", tuple(results)).functions:
        mine = [one for one in results if one.function == tally.function]
        assert tally.checks == len(mine) and tally.failed == sum(one.failed for one in mine)
        assert sum(tally.verdicts.values()) + tally.free == len(mine)
        assert set(tally.verdicts) <= {one.verdict for one in mine}


def test_the_answer_stands_beside_the_truth_where_it_is_furthest_off() -> None:
    one = result("a", "v", answer=[[1.0, 2.0], [3.0, 4.0]], truth=[[1.0, 2.0], [3.0, 5.0]], place=(1, 1))
    assert beside(one) == "answered[1, 1] 4, true[1, 1] 5"
    signal = result("a", "v", answer=[[0.0]] * 9, truth=[[0.0]] * 5 + [[1.0]] * 4, sample=5)
    assert beside(signal) == "answered[5] [0], true[5] [1]"
    (cause,) = folding.causes([signal])
    assert "begins to differ at sample 5 of 0 to 8" in list(lines_of(cause, "mine.py"))
    assert beside(result("a", "v", answer=3, truth=2)) == "answered 3, true 2"
    long = result("a", "v", answer=[[0.5] * 6] * 4, truth=[[0.5] * 3] * 4)
    assert beside(long) == "answered 4 x 6 numbers, true 4 x 3 numbers (--json has both)"


@given(st.integers(0, 29), st.integers(1, 3), st.floats(1e-6, 1e6))
def test_the_first_sample_that_differs_is_found(sample: int, channels: int, size: float) -> None:
    truth = np.arange(30.0 * channels).reshape(30, channels)
    answer = truth.copy()
    answer[sample:, channels - 1] += size
    assert first_difference(Sides("signal", answer.tolist(), truth.tolist(), size / 2)) == sample
    assert first_difference(Sides("signal", truth.tolist(), truth.tolist(), 0.0)) is None
    # A row of the kernel with d = 2: what it sees of a sample is known when the sample is.
    row = [[0.0] * channels, [0.0] * channels, [1.0] * channels]
    found = first_difference(Sides("residual", answer.tolist(), truth.tolist(), size / 2, {"kernel_row": row}))
    assert found == max(sample, 2)


@given(
    st.recursive(
        st.floats() | st.complex_numbers() | st.integers() | st.fractions(), lambda parts: st.lists(parts, max_size=4), max_leaves=9
    )
)
def test_what_is_plain_is_strict_json(value: Any) -> None:
    json.dumps(plain(value), allow_nan=False)


# -- names -------------------------------------------------------------------------------------------------------------------------


@given(st.text("ab-[]*?", max_size=6), st.text("ab-[]", max_size=6))
def test_a_pattern_fits_as_its_obvious_twin_says(pattern: str, name: str) -> None:
    def fits(pattern: str, name: str) -> bool:
        if not pattern:
            return not name
        if pattern[0] == "*":
            return any(fits(pattern[1:], name[k:]) for k in range(len(name) + 1))
        return bool(name) and pattern[0] in ("?", name[0]) and fits(pattern[1:], name[1:])

    one = Named(name, "f", "v")
    assert named(one, pattern) == any(fits(pattern, known) for known in one.names)


def test_brackets_are_no_pattern() -> None:
    assert not patterned("fault-space[one-fault]") and patterned("fault-*[one-fault]")
    names = {one.full_name for one in chosen(["fault_space"], ["fault-space-1e*[one-fault]"])}
    assert names == {f"fault-space-{power}[one-fault]-fault_space" for power in ("1e-12", "1e-6", "1e6")}
    with pytest.raises(InvalidData, match=r"none of that name.*--list.*fault-space"):
        chosen(["fault_space"], ["fault-spaces"])


def test_the_list_has_every_check_and_asks_none() -> None:
    listed = call("audit", "--list")
    assert (listed.code, listed.err) == (0, "")
    assert listed.out.splitlines() == [one.full_name for one in all_checks()]
    assert [one["check"] for one in call("audit", "--list", "--check", "*nan*", "--json").json] == [
        name for name in listed.out.splitlines() if "nan" in name
    ]


# -- expected failures -------------------------------------------------------------------------------------------------------------


def test_a_file_of_expected_failures(tmp_path: Path) -> None:
    file = tmp_path / "known.txt"
    file.write_text(
        "# what we know\n\nfault-dimension*[one-fault]: counts to two, issue 12: open\n  refuses-nan-residual : later\n", "utf-8"
    )
    assert expected_in(file) == (
        ExpectedFailure("fault-dimension*[one-fault]", "counts to two, issue 12: open"),
        ExpectedFailure("refuses-nan-residual", "later"),
    )
    mine = tmp_path / "mine.py"
    mine.write_text("def fault_dimension(r):\n    return 2\n", "utf-8")
    only = ("--check", "fault-dimension-1e*[one-fault]", "--check", "fault-dimension-1e6[two-faults]")
    run = call("audit", str(mine), *only, "--expected-failures", str(file))
    assert run.code == 0 and "0 failed, 3 as expected" in run.out
    mine.write_text("def fault_dimension(r):\n    return 1 if abs(r).max() < 1e-3 else 2\n", "utf-8")
    run = call("audit", str(mine), *only, "--expected-failures", str(file), "-q")
    assert run.code == 1 and "unexpected pass: fault-dimension-1e-12[one-fault]" in run.out, "an unexpected pass is red"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("fault-dimension\n", "line 1: got 'fault-dimension'"),
        ("# a\nfault-dimension:\n", "line 2: "),
        (": why\n", "line 1: "),
        ("a: b\na: c\n", "for the second time"),
        ("no-such-check: why\n", "none of that name"),
    ],
)
def test_a_file_that_says_too_little_is_refused_with_its_line(tmp_path: Path, text: str, words: str) -> None:
    file = tmp_path / "known.txt"
    file.write_text(text, "utf-8")
    run = call("audit", "--check", "fault-dimension[one-fault]", "--expected-failures", str(file))
    assert run.code == 2 and run.out == "" and words in run.err and "Traceback" not in run.err
    missing = call("audit", "--expected-failures", str(tmp_path / "none"))
    assert missing.code == 2 and "cannot be read" in missing.err


def test_pytest_takes_expected_failures_as_strict_xfail(tmp_path: Path) -> None:
    import subprocess
    import sys

    (tmp_path / "test_mine.py").write_text(
        "from types import SimpleNamespace\n"
        "from faultspace.numeric.audit.running import ExpectedFailure, parametrize_with_checks\n"
        "def count(r):\n"
        "    if len(r) == 45: raise IndexError('45')\n"
        "    return 2\n"
        "known = [ExpectedFailure(n, 'no') for n in ('fault-dimension*[one-fault]', 'fault-dimension-1e6[two-faults]')]\n"
        "@parametrize_with_checks(SimpleNamespace(fault_dimension=count), expected=known)\n"
        "def test_mine(check):\n    check()\n",
        "utf-8",
    )
    chosen_ones = "fault-dimension-1e6 or (fault-dimension-split-data and one-fault)"
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-rA", "-k", chosen_ones, str(tmp_path / "test_mine.py")]
    ran = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert ran.returncode == 1
    assert "XFAIL test_mine.py::test_mine[fault-dimension-1e6[one-fault]-fault_dimension]" in ran.stdout
    assert "[XPASS(strict)] no" in ran.stdout and "FAILED test_mine.py::test_mine[fault-dimension-1e6[two-faults]" in ran.stdout
    assert "FAILED test_mine.py::test_mine[fault-dimension-split-data[one-fault]" in ran.stdout, "a crash is never expected"


def test_the_pytest_face_says_what_the_command_says() -> None:
    decorated: Any = parametrize_with_checks(SimpleNamespace(fault_dimension=lambda r: 3))
    cases = {case.id: case.values[0] for case in decorated.args[1]}
    with pytest.raises(AssertionError, match=r"answered 3, true 2(?s:.*)probably: There are as many faults as outputs"):
        cases["fault-dimension[two-faults]-fault_dimension"]()


# -- files for machines ------------------------------------------------------------------------------------------------------------


@given(RESULTS, FIELDS)
def test_junit_is_xml_with_every_result_and_its_counts(results: list[CheckResult], adapter: str) -> None:
    suite = ElementTree.fromstring(junit_xml(adapter, results).encode())[0]
    cases = suite.findall("testcase")
    assert [(one.get("classname"), one.get("name")) for one in cases] == [(one.function, one.name) for one in results]
    red = sum(one.find("failure") is not None or one.find("error") is not None for one in cases)
    assert red == int(suite.get("failures", "")) + int(suite.get("errors", "")) == sum(one.failed for one in results)
    assert int(suite.get("errors", "")) == sum(one.failed and one.verdict == Status.BROKEN for one in results)
    assert int(suite.get("skipped", "")) == sum(one.find("skipped") is not None for one in cases)


@given(st.text(st.characters(exclude_categories=()), max_size=30))
def test_junit_takes_whatever_a_program_says_before_it_dies(said: str) -> None:
    ElementTree.fromstring(junit_xml("x", [result("a", "v", "broken", detail=said)]).encode("utf-8", errors="strict"))


@given(RESULTS)
def test_a_badge_is_green_where_nothing_failed(results: list[CheckResult]) -> None:
    picture, made = svg(results), endpoint(results)
    ElementTree.fromstring(picture)
    red = any(one.failed for one in results)
    assert made["isError"] == red and made["color"] in picture and made["message"] in picture
    musts = [one for one in results if one.kind != Demand.FREE and one.verdict != Status.NOT_OFFERED]
    counts = f"{sum(one.verdict == Status.PASS for one in musts)} of {len(musts)} passed"
    assert made["message"] == (counts if musts else "nothing asked")


def test_json_has_versions_answers_and_truths_and_comes_back(tmp_path: Path) -> None:
    only = ("--check", "fault-dimension[*]", "--check", "fault-signal[two-faults]")
    printed = call("audit", *only, "--json")
    found = printed.json
    assert set(found["versions"]) == {"faultspace", "vectors", "python", "numpy", "scipy", "blas", "platform"}
    data = Path(__file__).resolve().parents[3] / "numeric" / "audit" / "vectors" / "data"
    digest = hashlib.sha256(b"".join(one.name.encode() + b"\0" + one.read_bytes() + b"\0" for one in sorted(data.glob("*.json"))))
    assert found["versions"]["vectors"]["sha256"] == digest.hexdigest() == versions()["vectors"]["sha256"]
    assert all(one["answer"] is not None and one["truth"] is not None for one in found["records"])
    (signal,) = (one for one in found["records"] if one["slug"] == "fault-signal")
    assert np.allclose(signal["answer"], signal["truth"], rtol=1e-6) and signal["answer"] != signal["truth"]
    file = tmp_path / "result.json"
    file.write_text(printed.out, "utf-8")
    again = Audit.from_json(found)
    assert again.to_json() == {**found, "versions": again.to_json()["versions"]}
    for name in ("badge.svg", "badge.json"):
        shown = call("audit", "--from", str(file), "--badge", str(tmp_path / name), "--junit", str(tmp_path / "junit.xml"))
        assert shown.code == 0 and shown.out.endswith("0 failed\n")
    assert (
        json.loads((tmp_path / "badge.json").read_text("utf-8"))["message"] == f"{len(found['records'])} of {len(found['records'])} passed"
    )
    assert len(ElementTree.parse(tmp_path / "junit.xml").findall(".//testcase")) == len(found["records"])
    bad = call("audit", "--from", str(file), "--badge", str(tmp_path / "badge.png"))
    assert bad.code == 2 and "--badge: got" in bad.err
    some = call("audit", "--from", str(file), "--check", "*[two-faults]", "-q")
    assert (some.code, some.out) == (0, "2 checks of fault_dimension, reconstruct: 0 failed\n")
    none = call("audit", "--from", str(file), "--check", "order-of-calls*")
    assert none.code == 2 and "no result of that name" in none.err
    marked = tmp_path / "known.txt"
    marked.write_text("fault-signal[two-faults]: it passes\n", "utf-8")
    red = call("audit", "--from", str(file), "--expected-failures", str(marked), "-q")
    assert red.code == 1 and "unexpected pass" in red.out, "what is expected is looked at in what was printed before, too"
    for option in (("mine.py",), ("--seed", "3"), ("--quick",), ("--peer", "slycot")):
        other = call("audit", *option, "--from", str(file))
        assert other.code == 2 and other.out == "" and "--from reports what was asked before" in other.err


def test_a_function_in_place_of_a_check_is_told_how_to_ask_for_it() -> None:
    run = call("audit", "--check", "structure")
    assert run.code == 2 and "all that ask it are '*-structure'" in run.err


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", '{"format": "faultspace-audit-result/1"}', '{"format": "faultspace-audit-result/1", "adapter": "x", "records": [{}]}'],
)
def test_a_saved_result_that_is_none_is_refused(tmp_path: Path, text: str) -> None:
    file = tmp_path / "result.json"
    file.write_text(text, "utf-8")
    run = call("audit", "--from", str(file))
    assert run.code == 2 and run.out == "" and "--json" in run.err


# -- signatures --------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "source",
    [
        "def identify(y, u, order):\n    pass\n",
        "def identify(y, u, order, block_rows, *, method):\n    pass\n",
        "def identify(y, u, n, s, more):\n    pass\n",
    ],
)
def test_wrong_parameters_are_told_in_one_line_before_anything_runs(tmp_path: Path, source: str) -> None:
    mine = tmp_path / "mine.py"
    mine.write_text(source, "utf-8")
    run = call("audit", str(mine))
    assert (run.code, run.out) == (2, "") and len(run.err.strip().splitlines()) == 1
    assert "identify(y, u, order, block_rows)" in run.err and "4 arguments" in run.err


def test_what_takes_the_arguments_is_taken() -> None:
    def exact(y: Any, u: Any, order: Any, block_rows: Any) -> None: ...
    def loose(*arguments: Any) -> None: ...
    def more(y: Any, u: Any, n: Any, s: Any, method: str = "a") -> None: ...

    for function in (exact, loose, more):
        assert fitting(SimpleNamespace(identify=function)) == {"identify": function}
    assert set(fitting(reference)) == set(ARGUMENTS)
    assert fitting(SimpleNamespace(fault_dimension=max)) == {"fault_dimension": max}, "what does not tell its arguments is tried"


# -- the command -------------------------------------------------------------------------------------------------------------------


def test_a_report_of_no_failure_is_a_few_lines_and_a_report_of_one_error_is_a_few_more(tmp_path: Path) -> None:
    fine = call("audit", "--check", "fault-dimension*[*faults]")
    assert fine.code == 0 and len(fine.out.splitlines()) <= 5
    mine = tmp_path / "mine.py"
    mine.write_text("def fault_dimension(r):\n    return r.shape[1]\n", "utf-8")
    run = call("audit", str(mine), "--check", "fault-dimension*[*fault]", "--check", "fault-dimension*[*faults]")
    lines = run.out.splitlines()
    assert run.code == 1 and len(lines) <= 15
    assert lines[0].startswith("! fault_dimension: fail: fault-dimension[one-fault] x ")
    assert any(line.strip() == "answered 3, true 1" for line in lines)
    assert any(line.startswith("    probably: There are as many faults as outputs") for line in lines)
    assert re.search(r"again: faultspace audit .*mine.py --check 'fault-dimension\[one-fault\]-fault_dimension'", run.out)
    quiet = call("audit", str(mine), "--check", "fault-dimension*[*fault]", "-q").out.splitlines()
    assert len(quiet) == 2 and quiet[0].startswith("! ") and quiet[1].endswith("failed")
