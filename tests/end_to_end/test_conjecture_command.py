"""`faultspace conjecture` and `faultspace claim --sharpen` as they are typed: bounds, JSON, certificates, the page, bad options."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

import pytest

import faultspace as fs
from faultspace.cli.command_line import main
from faultspace.proofs.brought import sparse_systems, tables
from faultspace.proofs.brought.known_cases import known_cases
from faultspace.proofs.language.vocabularies import SYSTEM
from tests.thorough import every

PAGE = Path(__file__).parents[2] / "docs/your-claims.md"
SMALL = ["--box", "total=3"]
EACH = every(4)
CLAIM = """
[claim.delay-bound]
hypotheses = ["left_invertible", "nullity(G) >= 1"]
conclusion = "delay_known <= n - nullity(G)"
box = { n = [1, 2], m = [1, 1], p = [1, 1] }

[claim.no-bound]
conclusion = "observable"
box = { total = 3 }
"""


@pytest.fixture(autouse=True)
def few_outside(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is asked here has enough in fewer systems outside the box, which take most of the time."""
    monkeypatch.setattr(tables, "MOST_SUMS", 300)
    monkeypatch.setattr(tables, "MOST_MET", 100)
    monkeypatch.setattr(tables, "known_cases", lambda box: known_cases(box)[::EACH])
    monkeypatch.setattr(sparse_systems, "BATCHES", 1)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "claims.toml"
    path.write_text(CLAIM)
    return path


def test_bounds_are_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["conjecture", "lag", "--by", "n", "--by", "zeta", *SMALL]) == 0
    out = capsys.readouterr().out
    assert "lag <= n - zeta" in out and "lag <= n - zeta - 1: refuted by A=[[-1]]" in out and "Traceback" not in out
    assert "holds" not in out and "proved" not in out and "that nothing that was tried refutes" in out


def test_the_json_is_alone_on_standard_output(capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--under", "left_invertible", "--by", "infinite_zeros", "--field", "GF(2)", "--terms", "1", "--constant", "0"]
    assert main(["conjecture", "delay_known", *options, *SMALL, "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert [one["bound"] for one in answer["above"]] == ["delay_known <= infinite_zeros"]
    assert answer["hypotheses"] == ["left_invertible"] and answer["grammar"]["above"].startswith("sums of at most 1 quantity with")
    assert answer["grammar"]["below"].endswith("and no constant")
    assert answer["above"][0]["sharper"][0]["smallest"]["in_box"] is True


def test_a_claim_is_sharpened(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["claim", str(file), "--sharpen", "delay-bound", "--json"]) == 0
    (answer,) = json.loads(capsys.readouterr().out)["sharpened"]
    assert answer["own"]["bound"] == "delay_known <= n - nullity(G) + 1" and answer["counterexample"]["G"] == [["0"]]
    assert answer["own"]["known"][0].startswith("literature: inverse-bound")


def test_certificates_are_written_and_checked(file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "certificates"
    assert main(["conjecture", "lag", "--by", "n", *SMALL, "--out", str(out)]) == 0
    names = sorted(str(one) for one in out.iterdir())
    assert names and main(["check", *names]) == 0
    assert "; check each with: faultspace check FILE" in capsys.readouterr().err


@pytest.mark.slow
def test_the_examples_of_the_page_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(tables, "known_cases", lambda box: known_cases(box) if box.about == SYSTEM else ())  # the others take seconds
    (tmp_path / "claims.toml").write_text(CLAIM)
    listed = [shlex.split(line.partition("  ")[0]) for line in re.findall(r"^faultspace (.*)$", PAGE.read_text("utf-8"), re.MULTILINE)]
    asked = [one for one in listed if one[0] == "conjecture" or "--sharpen" in one]
    assert len(asked) >= 5
    for one in asked:
        small = [*SMALL, "--json"] if one[0] == "conjecture" and "--box" not in one else ["--json"]
        assert main([*one, *small]) == 0, one
        answer = json.loads(capsys.readouterr().out)
        assert (answer["above"] or answer["below"] or answer["equal"]) if one[0] == "conjecture" else answer["sharpened"][0]["own"], one


def test_what_the_page_says_was_found_is_not_refuted_in_a_small_box() -> None:
    block = PAGE.read_text("utf-8").partition("### What was found")[2].partition("```text\n")[2].partition("```")[0]
    listed = [line.split(" | ") for line in block.splitlines()]
    assert len(listed) == 8
    for hypothesis, bound in listed[:: every()]:
        answer = fs.claim(bound, hypotheses=[hypothesis], box={"total": 4}, ablation=False).answers[0]
        assert answer.counterexample is None, bound


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["lagg"], "the nearest is lag"),
        (["lag", "--under", "observabl"], "the nearest is observable"),
        (["lag", "--by", "zetta"], "the nearest is zeta"),
        (["lag", "--box", "n3"], "--box: got 'n3', expected such as n=1:3"),
        (["lag", "--box", "n=1:b"], "--box: got 'n=1:b', expected whole numbers"),
        (["lag", "--box", "total=3", "--box", "total=4"], "each key once"),
        (["lag", "--box", "totl=3"], "the nearest is total"),
        (["lag", "--box", "entries=1,x"], "box.entries: got 'x'"),
        (["lag", "--field", "GF(4)"], "prime"),
        (["lag", "--terms", "9"], "terms: got 9, expected an integer from 1 to 3"),
        (["lag", "--terms", "two"], "got 'two', expected a whole number"),
        (["delay_known", *SMALL], 'the hypothesis "delay_known < inf" makes it so'),
    ],
)
def test_what_is_wrong_is_told_on_one_line(options: list[str], words: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["conjecture", *options]) == 2
    told = capsys.readouterr()
    assert words in told.err and told.out == ""
    assert len([one for one in told.err.splitlines() if not one.endswith("...")]) == 1  # but for lines of progress


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--sharpen", "delay-boun"], "--sharpen: got delay-boun, which is no claim of the file; the nearest is delay-bound"),
        (["--sharpen", "no-bound"], "claim.no-bound.conclusion: got 'observable', expected a bound to sharpen"),
        (["--sharpen", "delay-bound", "--claim", "no-bound"], "expected --sharpen ID alone"),
    ],
)
def test_what_cannot_be_sharpened_is_told(options: list[str], words: str, file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["claim", str(file), *options]) == 2
    assert words in capsys.readouterr().err
