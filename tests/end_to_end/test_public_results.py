"""What the public functions return reads the same as what the commands print, and they refuse what they cannot take."""

from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest
import sympy

import faultspace as fs
from faultspace.base.sheets import Shown
from faultspace.exact import PrimeField, ResidualSystem, read_system
from faultspace.proofs import Malformed, Rejected, Report, Unprovable, Verdict
from faultspace.proofs.verdict.ledger import load, sentences
from faultspace.proofs.verdict.verdicts import ClaimResult, Outcome, ReadingResult
from tests.end_to_end.commands import call


def example(name: str) -> Any:
    """This is the dict of an example's file."""
    return json.loads(files("faultspace").joinpath("examples", f"{name}.json").read_text("utf-8"))


FAULT: dict[str, Any] = {"A": [["1/2"]], "F": [[1]], "C": [[1]], "G": [[0]]}
OTHER: dict[str, Any] = {"A": [["1/3"]], "F": [[1]], "C": [[1]], "G": [[1]]}


@pytest.mark.parametrize("name", ["paper", "zeros", "theorem-3"])
def test_the_summary_of_a_structure_is_what_inspect_prints(name: str) -> None:
    printed = call("inspect", f"example:{name}").out
    found = fs.analyze(read_system(example(name)))
    assert found.summary().splitlines()[1:] == printed.rstrip("\n").splitlines()[1:]


def test_the_summary_of_limits_is_what_limit_prints() -> None:
    printed = call("limit", "example:fault-leads-input").out
    found = fs.limit(example("fault-leads-input"))
    assert found.summary().splitlines()[1:] == printed.rstrip("\n").splitlines()[1:]
    assert printed.splitlines()[0].endswith(found.title)


@pytest.mark.parametrize("names", [("theorem-1-first", "theorem-1-second"), ("zeros", "same-behaviour")])
def test_the_summary_of_a_comparison_is_what_compare_prints(names: tuple[str, str]) -> None:
    printed = call("compare", *(f"example:{name}" for name in names)).out
    found = fs.compare(*(read_system(example(name)) for name in names))
    for place, name in zip(("the first system", "the second system"), names, strict=True):
        printed = printed.replace(f"example:{name}", place)
    assert found.summary().splitlines() == printed.splitlines()
    assert call("compare", *(f"example:{name}" for name in names), "--word", "--json").json == found.to_json()


class Counts:
    """This is an implementation that always counts two faults."""

    def fault_dimension(self, r: object) -> int:
        return 2


def test_the_summary_of_an_audit_has_the_numbers_and_the_failures_that_the_command_prints(tmp_path: Path) -> None:
    only = ["fault-dimension[one-fault]", "fault-dimension[two-faults]"]
    mine = tmp_path / "mine.py"
    mine.write_text("def fault_dimension(r):\n    return 2\n", "utf-8")
    printed = call("audit", str(mine), *(part for name in only for part in ("--check", name))).out.splitlines()
    found = fs.audit(str(mine), only=only)
    title, *rest = found.summary().splitlines()
    words = " ".join(rest).split()
    place = words.index("failed")
    counts, failure = words[:place], " ".join(words[place + 1 :])
    assert title == printed[-1] == "2 checks of fault_dimension: 1 failed"
    assert counts == ["fault_dimension", "2", "checks:", "1", "pass,", "1", "fail,", "0", "free,", "largest", "ratio", "inf"]
    (row,) = (line.split() for line in printed if line.startswith("! fault_dimension "))
    assert row == ["!", "fault_dimension", "2", "1", "1", "0", "inf"]
    entry = [line.strip().removeprefix("! ") for line in printed[: printed.index("")]]
    assert failure.split() == "; ".join(entry).split() and str(mine) in failure
    assert [one.failed for one in found] == [True, False] and found.failed == (found[0],) == found[:1] and len(found) == 2
    assert [one.verdict for one in fs.audit(Counts(), only=only)] == [one.verdict for one in found]


def results() -> dict[str, Shown]:
    """There is one of each result."""
    system = fs.System(**FAULT)
    first = load()[0]
    decided = ClaimResult(first, tuple(ReadingResult(one, Outcome(Verdict(one.expected), "as stated"), 0.5) for one in first.readings))
    return {
        "Structure": fs.analyze(system),
        "Comparison": fs.compare(system, fs.System(**OTHER)),
        "PopulationLimits": fs.limit(example("fault-leads-input")),
        "Checked": fs.check(fs.certify(system, "window-ranks")),
        "Report": Report("quick", (), (), "", 0.0),
        "Audit": fs.audit(Counts(), only=["fault-dimension[one-fault]", "fault-dimension[two-faults]", "fault-dimension[delayed]"]),
        "Claim": load()[0],
        "Reading": load()[0].readings[0],
        "ReadingResult": decided.readings[0],
        "ClaimResult": decided,
    }


KINDS = ("Structure", "Comparison", "PopulationLimits", "Checked", "Report", "Audit", "Claim", "Reading", "ReadingResult", "ClaimResult")


@pytest.mark.parametrize("name", KINDS)
def test_a_result_shows_itself(name: str) -> None:
    result = results()[name]
    assert repr(result) == f"<{name}: {result.title}>" and len(repr(result)) < 140
    assert result.summary().startswith(result.title)
    html = result._repr_html_()
    assert html.startswith("<table>") and html.endswith("</table>") and html.count("<tr>") == len(list(result.sheet()))
    assert json.loads(json.dumps(result.to_json()))  # type: ignore[attr-defined]


def test_a_report_draws_a_line_for_each_claim() -> None:
    decided = results()["ClaimResult"]
    assert isinstance(decided, ClaimResult)
    axes = Report("quick", (decided, decided), (), "", 0.0).plot()
    texts = [text.get_text() for text in axes.texts]
    assert texts.count(decided.claim.id) == 2 and texts.count(sentences()[decided.claim.id]["verdict"]) == 2 * decided.as_expected
    assert Report("quick", (decided,), (), "", 0.0).plot(axes) is axes
    assert Report("quick", (), (), "", 0.0).plot().texts


def test_every_verdict_has_a_meaning() -> None:
    assert len({verdict.meaning for verdict in Verdict}) == len(Verdict)
    assert json.dumps(Verdict.PROVED) == '"PROVED"' and Verdict("PROVED") is Verdict.PROVED


def test_html_is_escaped() -> None:
    class Odd(Shown):
        title = "<b>"

        def sheet(self) -> list[tuple[str, str]]:
            return [("<script>", "a < b")]

    assert "<script>" not in Odd()._repr_html_() and "<b>" not in Odd()._repr_html_() and "a &lt; b" in Odd()._repr_html_()


def test_a_system_from_all_that_is_exact() -> None:
    wanted = ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]])
    for half in ("1/2", Fraction(1, 2), sympy.Rational(1, 2)):
        assert fs.System([[half]], [[1]], [[1]], [[0]]) == wanted
    assert fs.System(sympy.Matrix([[sympy.Rational(1, 2)]]), [[1]], [[1]], [[0]]) == wanted
    assert fs.System([[1]], [[1]], [[1]], [[0]], field={"prime": 3}) == fs.System([[1]], [[1]], [[1]], [[0]], field=PrimeField(3))
    both = fs.System(**FAULT, B=[[1, 2]], D=[[0, 0]])
    assert both == read_system({**FAULT, "B": [[1, 2]], "D": [[0, 0]]}) and both.residual == wanted


REFUSED: dict[str, Callable[[], object]] = {
    "a float": lambda: fs.System([[0.5]], [[1]], [[1]], [[0]]),
    "B without D": lambda: fs.System(**FAULT, B=[[1]]),
    "B of another height": lambda: fs.System(**FAULT, B=[[1], [1]], D=[[0]]),
    "shapes": lambda: fs.System([[1, 2]], [[1]], [[1]], [[0]]),
    "a field that is none": lambda: fs.System([[1]], [[1]], [[1]], [[0]], field="R"),
    "no system to analyze": lambda: fs.analyze(FAULT),  # type: ignore[arg-type]
    "no system to compare": lambda: fs.compare(fs.System(**FAULT), None),  # type: ignore[arg-type]
    "different fields": lambda: fs.compare(fs.System(**FAULT), fs.System([[1]], [[1]], [[1]], [[0]], field={"prime": 3})),
    "no experiment": lambda: fs.limit(7),  # type: ignore[arg-type]
    "half an experiment": lambda: fs.limit(FAULT),
    "an unknown kind": lambda: fs.certify(fs.System(**FAULT), "beauty"),
    "an option too many": lambda: fs.certify(fs.System(**FAULT), "schur-stable", window=2),
    "an option too few": lambda: fs.certify(fs.System(**FAULT), "inversion-delay"),
    "an unknown matrix": lambda: fs.certify(fs.System(**FAULT), "matrix-rank", matrix="hankel"),
    "a matrix without its window": lambda: fs.certify(fs.System(**FAULT), "matrix-rank", matrix="toeplitz"),
    "a window that is none": lambda: fs.certify(fs.System(**FAULT), "window-equality", other=fs.System(**FAULT), window=None),
    "a system for an experiment": lambda: fs.certify(fs.System(**FAULT), "moesp-limit", instruments="past-inputs"),
    "an experiment for a system": lambda: fs.certify(example("fault-leads-input"), "schur-stable"),
    "stability over a prime field": lambda: fs.certify(fs.System([[1]], [[1]], [[1]], [[0]], field={"prime": 3}), "schur-stable"),
    "an unknown plan": lambda: fs.monte_carlo("beautified", systems=4),
}


@pytest.mark.parametrize("what", list(REFUSED))
def test_it_is_refused_in_one_line(what: str) -> None:
    with pytest.raises(fs.errors.InvalidInput) as caught:
        REFUSED[what]()
    assert "\n" not in str(caught.value) and len(str(caught.value)) > 10


def test_the_kinds_are_named() -> None:
    with pytest.raises(fs.errors.InvalidInput, match="window-ranks"):
        fs.certify(fs.System(**FAULT), "beauty")


def test_what_is_not_so_is_not_certified() -> None:
    system, silent = fs.System(**FAULT), fs.System([["1/2"]], [[0]], [[1]], [[0]])
    for kind, about, options in (
        ("not-left-invertible", system, {}),
        ("left-invertible", silent, {}),
        ("behaviour-equality", system, {"other": silent}),
        ("schur-stable", fs.System([[1]], [[1]], [[1]], [[0]]), {}),
    ):
        with pytest.raises(Unprovable):
            fs.certify(about, kind, **options)


def test_the_checker_decides() -> None:
    system = fs.System(**FAULT)
    certificate = fs.certify(system, "inversion-delay", initial_state="known")
    assert fs.check(certificate, [system]).assumes == []
    with pytest.raises(Rejected):
        fs.check(certificate, [fs.System(**OTHER)])
    forged = fs.certify(system, "schur-stable")
    forged["statement"]["system"]["A"] = [["2"]]
    with pytest.raises(Rejected):
        fs.check(forged)
    with pytest.raises(Malformed):
        fs.check({})
