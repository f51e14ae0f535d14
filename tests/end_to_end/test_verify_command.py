"""`faultspace verify`: one claim for real; then the table, the exit code and the files with a report made here in place of a run.

report       a Report about two claims, one of them with an unexpected verdict on request
pretended    puts it in the place of the run
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import json
import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from functools import partial
from pathlib import Path

import pytest

from faultspace.cli import verdict_tables, verifying
from faultspace.cli.command_line import main
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import read_system
from faultspace.proofs.evidence.attacks import Attacked
from faultspace.proofs.evidence.specimens import specimens
from faultspace.proofs.trust.structure_certificates import sha256, window_ranks
from faultspace.proofs.verdict.cards import with_cards
from faultspace.proofs.verdict.ledger import Claim, Reading
from faultspace.proofs.verdict.verdicts import ClaimResult, Outcome, ReadingResult, Report, Row, Verdict
from tests.end_to_end.commands import ROOT, call, command, example, validator

ONE = Reading("as-printed", "rank [O_s T_s] = n + s m for every system and every s", ("left-invertible", "s >= n"), "REFUTED", False)
TWO = Reading("with-zeros", "rank [O_s T_s] = n + s m - zeta for s >= lag", ("left-invertible",), "CERTIFIED", True)
CLAIMS = (
    Claim("claim-a", "Theorem 2", "the rank, as stated", "AMENDED", (), False, (ONE, TWO)),
    Claim("claim-b", "(11)", "the space", "CERTIFIED", (), False, (TWO,)),
)
CERTIFICATE = window_ranks(kernel_representation(read_system(example("paper")).residual))
SHORT = sha256(CERTIFICATE)[:12]
A, FIVE = frozenset("a"), frozenset("abcde")  # certificates that were decided
TOY = partial(Row, ablation="toy", claim="claim-a", conclusion="the rank is right")
ROWS = (
    TOY(Verdict.REFUTED, "A=[[0]]", (CERTIFICATE,), A, dropped=("s >= n",), ledger="REFUTED"),
    TOY(Verdict.CERTIFIED, "all 12 tried", (), FIVE, dropped=("observable",), ledger="CERTIFIED"),
    TOY(Verdict.REFUTED, "already", (CERTIFICATE,), A, dropped=("s >= n", "observable"), already="s >= n"),
)


def report(claims: Sequence[str] | None, second: Verdict) -> Report:
    """The first claim is AMENDED, as expected; the second has this verdict, CERTIFIED is expected."""

    def result(reading: Reading, verdict: Verdict) -> ReadingResult:
        return ReadingResult(reading, Outcome(verdict, f"evidence for {reading.id}", (CERTIFICATE,), frozenset("abc")), 1.25)

    first = ClaimResult(CLAIMS[0], (result(ONE, Verdict.REFUTED), result(TWO, Verdict.CERTIFIED)))
    results = (first, ClaimResult(CLAIMS[1], (result(TWO, second),)))
    return Report("quick", tuple(r for r in results if claims is None or r.claim.id in claims), ROWS, "12 systems", 3.5)


@pytest.fixture
def pretended(monkeypatch: pytest.MonkeyPatch) -> Callable[[Verdict], list[dict[str, object]]]:
    """Call it with the verdict on the second claim; it returns the list that the calls of the run are noted in."""

    def pretend(second: Verdict) -> list[dict[str, object]]:
        calls: list[dict[str, object]] = []

        def verify(
            claims: Sequence[str] | None,
            *,
            effort: str,
            jobs: int | None,
            on_progress: Callable[[str, int, int], None],
            scheduler: str | None = None,
            resume: Path | None = None,
            rocq: bool = False,
        ) -> Report:
            calls.append({"claims": claims, "effort": effort, "jobs": jobs, "rocq": rocq})
            on_progress("systems", 0, 12)
            on_progress("systems", 12, 12)
            on_progress("claim-a: as-printed", 0, 3)
            return report(claims, second)

        monkeypatch.setattr(verifying, "load", lambda: CLAIMS)
        monkeypatch.setattr(verifying, "verify", verify)
        return calls

    return pretend


Pretend = Callable[[Verdict], list[dict[str, object]]]


def test_a_claim_is_verified_and_its_certificates_are_accepted(tmp_path: Path) -> None:
    run = command("verify", "--effort", "quick", "--claim", "example-v", "--jobs", "1", "--json", "--out", str(tmp_path))
    assert run.code == 0
    (claim,) = run.json["claims"]
    assert (claim["id"], claim["as_expected"]) == ("example-v", True)
    named = {c["sha256"] for reading in claim["readings"] for c in reading["certificates"]}
    files = [path for path in tmp_path.iterdir() if path.name not in ("verdicts.json", "origin.json")]
    for path in files:
        certificate = json.loads(path.read_text("utf-8"))
        validator("certificate").validate(certificate)
        assert path.name == f"{certificate['kind']}-{sha256(certificate)[:12]}.json"
    results = call("check", *map(str, files), "--json").json
    assert {result["sha256"] for result in results} == named
    assert all(result["result"] == "verified" for result in results)


@pytest.mark.parametrize(("verdict", "code"), [(Verdict.CERTIFIED, 0), (Verdict.REFUTED, 1), (Verdict.ERROR, 1)])
def test_exit_0_if_every_verdict_is_the_expected_one(pretended: Pretend, verdict: Verdict, code: int) -> None:
    calls = pretended(verdict)
    run = call("verify", "--effort", "quick", "--jobs", "2", "--json")
    assert run.code == code
    assert calls == [{"claims": None, "effort": "quick", "jobs": 2, "rocq": False}]
    assert run.json == with_cards(report(None, verdict))
    assert run.err == ""


def test_an_unexpected_verdict_is_seen(pretended: Pretend) -> None:
    pretended(Verdict.REFUTED)
    for options in ((), ("--claim", "claim-b"), ("--verbose",)):
        lines = call("verify", *options).out.splitlines()
        assert lines[:2] == [
            "! claim-b: REFUTED (expected CERTIFIED)",
            "! claim-b, with-zeros: REFUTED (expected CERTIFIED); evidence for with-zeros",
        ], "it is the first thing seen"
        assert lines[-1].startswith("NOT as expected: claim-b; ")
    rows = [line for line in call("verify").out.splitlines()[2:] if line.startswith("  claim-")]
    assert rows[0] == "  claim-b: NOT as expected: with-zeros is REFUTED, CERTIFIED expected.", "it is the first of its group"


def test_a_claim_is_told_in_full(pretended: Pretend) -> None:
    calls = pretended(Verdict.CERTIFIED)
    run = call("verify", "--claim", "claim-a", "-v")
    assert (run.code, calls[0]["claims"]) == (0, ["claim-a"])
    for text in (CLAIMS[0].statement, ONE.statement, TWO.statement, "left-invertible; s >= n", "evidence for with-zeros"):
        assert text in run.out
    assert sha256(CERTIFICATE) in run.out
    assert "claim-b" not in run.out
    page = [" ".join(line.split()) for line in run.out.splitlines()]
    assert "which hypotheses are needed for: the rank is right" in page
    assert "without s >= n: REFUTED, needed" in page and "evidence: A=[[0]]" in page
    assert "without observable: CERTIFIED, not seen to be needed" in page
    assert page[-1].startswith("as expected: the claim; 2 readings")
    assert "As stated: 0 of 1 readings stand." in page and "without left-invertible" not in run.out, "what follows is in the JSON only"
    everything = call("verify", "--verbose").out.splitlines()
    end = page.index("systems: 12 systems")
    assert everything[:end] == run.out.splitlines()[:end], "of all claims the same pages, one after the other"
    assert any(line.startswith("claim-b") and "CERTIFIED" in line for line in everything)


def test_an_unknown_claim_is_told_before_the_run(pretended: Pretend) -> None:
    calls = pretended(Verdict.CERTIFIED)
    run = call("verify", "--claim", "claim-c")
    assert (run.code, run.out, calls) == (2, "", [])
    assert run.err == "faultspace: --claim: got 'claim-c', expected one of claim-a, claim-b; try: faultspace verify --claim claim-b\n"


def test_certificates_and_verdicts_are_written_whole(pretended: Pretend, tmp_path: Path) -> None:
    pretended(Verdict.CERTIFIED)
    out = tmp_path / "not yet" / "there"
    run = call("verify", "--out", str(out), "--json")
    assert run.code == 0 and run.json["as_expected"]
    name = f"window-ranks-{SHORT}.json"
    beside = {f"{one['kind']}-{sha256(one)[:12]}.json" for one in specimens()}
    assert {path.name for path in out.iterdir()} == {name, "verdicts.json", "origin.json"} | beside
    written = json.loads((out / name).read_text("utf-8"))
    assert written == CERTIFICATE
    validator("certificate").validate(written)
    assert call("check", str(out / name)).code == 0
    assert json.loads((out / "verdicts.json").read_text("utf-8")) == run.json
    origin = json.loads((out / "origin.json").read_text("utf-8"))
    assert origin["command"] == "faultspace verify --effort quick --claim claim-a --claim claim-b" and datetime.fromisoformat(
        origin["time"]
    ) <= datetime.now(UTC)
    (first, *_) = origin["checkers"]
    assert first["sha256"] == hashlib.sha256((ROOT / "proofs" / "trust" / first["file"]).read_bytes()).hexdigest()


def test_nothing_is_written_without_being_asked_for(pretended: Pretend, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pretended(Verdict.CERTIFIED)
    monkeypatch.chdir(tmp_path)
    assert call("verify").code == 0
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_written_into_is_told_before_the_run(pretended: Pretend, tmp_path: Path) -> None:
    calls = pretended(Verdict.CERTIFIED)
    (tmp_path / "file").write_text("")
    run = call("verify", "--out", str(tmp_path / "file"))
    assert (run.code, run.out, run.err.count("\n"), calls) == (2, "", 1, [])
    assert "cannot be written into" in run.err


def test_a_hypothesis_with_another_verdict_is_not_as_expected(pretended: Pretend, monkeypatch: pytest.MonkeyPatch) -> None:
    pretended(Verdict.CERTIFIED)
    monkeypatch.setattr(sys.modules[__name__], "ROWS", (replace(ROWS[0], verdict=Verdict.CERTIFIED), *ROWS[1:]))
    answer = call("verify")
    assert answer.code == 1 and "claim-a without s >= n" in answer.out


def test_by_itself_it_prints_a_line_for_each_claim_and_few_others(pretended: Pretend) -> None:
    pretended(Verdict.CERTIFIED)
    out = call("verify").out
    lines = [" ".join(line.split()) for line in out.splitlines()]
    amended, certified = (f"claim-{name}: {verdict.meaning}." for name, verdict in (("a", Verdict.AMENDED), ("b", Verdict.CERTIFIED)))
    assert lines[:3] == ["Claims of the paper, as its review states them", amended, certified]
    assert "Hypotheses: 2 dropped alone: 1 needed (a counterexample without it), 1 without which no counterexample was found; " in out
    assert "1 pair: 0 needed only together." in out and "Searches: none is stored on these claims." in lines
    assert "Machine-checked: not asked" in lines
    assert len(lines) == 3 + 5 and lines[-1].startswith("as expected: all 2 claims; 3 readings")
    assert "\x1b" not in out


def test_the_verdict_of_the_adversary_is_told_in_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    made = report(None, Verdict.CERTIFIED)
    attacked = (Attacked("one", "a counterexample", True, None), Attacked("two", "none found", False, "out of date"))
    (first, second), claim = made.claims[0].readings, made.claims[0]
    attacked_claim = replace(claim, readings=(replace(first, attacks=attacked), replace(second, attacks=attacked[:1])))
    words = verdict_tables.attack_words(replace(made, claims=(attacked_claim, made.claims[1])))
    assert words == (
        "3 stored searches were repeated: 2 confirm a counterexample, 1 against a verdict other than REFUTED; 1 found nothing; "
        "1 are out of date or were not found again."
    )


class Window(io.StringIO):
    """It says that it is a terminal."""

    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize("options", [(), ("-v",), ("--claim", "claim-a")], ids=" ".join)
@pytest.mark.parametrize("width", [60, 80, 140, 200])
def test_a_terminal_of_any_width_shows_everything(
    pretended: Pretend, monkeypatch: pytest.MonkeyPatch, width: int, options: tuple[str, ...]
) -> None:
    pretended(Verdict.REFUTED)
    for name, value in (("TERM", "xterm"), ("COLUMNS", str(width)), ("NO_COLOR", "1")):
        monkeypatch.setenv(name, value)
    window = Window()
    with contextlib.redirect_stdout(window):
        code = main(["verify", *options])
    printed = re.sub(r"\x1b\[[0-9;?]*m", "", window.getvalue())
    assert code == (0 if "--claim" in options else 1)
    assert max(map(len, printed.splitlines())) <= width and "…" not in printed
    together = re.sub(r"[\s─]", "", printed)
    wanted = ["claim-a", "certificates accepted"]
    if options != ("--claim", "claim-a"):
        wanted += ["claim-b", "NOT as expected: claim-b", "claim-b: REFUTED (expected CERTIFIED)"]
    else:
        wanted += ["AMENDED", CLAIMS[0].statement, "readings that hold: 1 of 2"]
    if options == ("-v",):
        wanted += [SHORT, "needed", "observable"]
        wanted += ["evidence for with-zeros", "left-invertible; s >= n"]
    assert [text for text in wanted if "".join(text.split()) not in together] == []
