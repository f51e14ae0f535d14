"""The main job, whole: every verdict as expected, and the certificates of a run are those locked, accepted by the lone checker."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import faultspace.proofs
from faultspace.cli.claim_cards import card_lines
from faultspace.proofs.trust.structure_certificates import sha256
from faultspace.proofs.verdict.cards import Card, Wrong
from faultspace.proofs.verdict.ledger import load, sentences
from tests.oracle import truth

from .commands import command

ROOM = Path(faultspace.proofs.__file__).parent
HEADLINES = ROOM / "certificates"


@pytest.mark.slow  # `.ci/run` runs it every day
@pytest.mark.timeout(1500)
def test_verify_quick_is_as_expected_and_makes_the_certificates_of_the_tree(tmp_path: Path) -> None:
    run = command("verify", "--effort", "quick", "--jobs", "2", "--json", "--out", str(tmp_path), seconds=1400.0)
    assert run.code == 0, run.err[-2000:]
    report = run.json
    assert report["as_expected"]
    assert [claim["id"] for claim in report["claims"]] == [claim.id for claim in load()]
    assert all(reading["verdict"] != "ERROR" for claim in report["claims"] for reading in claim["readings"])
    made = {path.name: path.read_text("utf-8") for path in tmp_path.glob("*-*.json")}
    locked = (HEADLINES / "names.txt").read_text("utf-8").split()
    assert sorted(name.removesuffix(".json") for name in made) == locked, "make them again: python -m tests.house.certificates"
    assert all(name == f"{one['kind']}-{sha256(one)[:12]}.json" for name, text in made.items() if (one := json.loads(text)))
    kept = {path.name: path.read_text("utf-8") for path in HEADLINES.glob("*-*.json")}
    assert all(json.loads(made[name]) == json.loads(text) for name, text in kept.items())
    accepted_by_a_lone_checker([*map(str, sorted(tmp_path.glob("*-*.json")))], tmp_path)
    every_card_fits_and_says_its_numbers(report)
    refutations_are_smallest_and_true(report, [json.loads(text) for text in made.values()])


def every_card_fits_and_says_its_numbers(report: dict[str, Any]) -> None:
    """See that no card is longer than 24 lines of 100 columns, and that the numbers of some are those that can be found by hand."""
    cards = {claim["id"]: claim["card"] for claim in report["claims"]}
    for name, card in cards.items():
        shown = Card(**card | {"wrong": [Wrong(**one) for one in card["wrong"]]})
        lines = list(card_lines(shown, "readings that hold: 19 of 19"))
        assert len(lines) <= 24 and max(map(len, lines)) <= 100, name
        assert {one["reading"] for one in card["wrong"]} == set(sentences()[name].get("wrong", {})), name
    said = {name: " ".join(one["sentence"] for one in card["wrong"]) for name, card in cards.items()}
    # x(k+1) = u(k+1), so y(k) = u(k); x(k+1) = (1/2) x(k) + u(k) + u(k+1), so that B = 1 + 1/2, D = 1; x(1) = 1/2 - 1/2 = 0
    assert "D = 1 where 0 is true" in said["assumption-2"] and "B and D are 3/2 and 1 in the place of 1 and 0" in said["proposition-1"]
    assert "x(0) = -1 and v(0) = 1" in said["trajectory-recovered"] and "rank R5 = 7 and rank R6 = 8" in said["example-v"]
    # r(0) = 0 takes x(0) = v(0) = 0 in both; then r(1) = (-v(1), 0) in the first, and (-v(1), v(1)) in the second
    assert "the word (0, 0)', (-1, 0)'" in said["theorem-1"].lower()


def refutations_are_smallest_and_true(report: dict[str, Any], certificates: list[dict[str, Any]]) -> None:
    """See that the refutations of these claims come from a search, and that the oracle finds their statements true."""
    by_hash = {sha256(certificate): certificate for certificate in certificates}
    count = 0
    for claim in report["claims"]:
        if claim["id"] in ("theorem-3-ii", "problem-11", "theorem-2"):
            for reading in claim["readings"]:
                if reading["verdict"] == "REFUTED":
                    assert reading["certificates"] and "the smallest with" in reading["evidence"], reading["id"]
                    for one in reading["certificates"]:
                        certificate = by_hash[one["sha256"]]
                        assert truth(certificate["kind"], certificate["statement"]), one["sha256"]
                        count += 1
    assert count > 20


def test_the_certificates_of_the_tree_are_accepted_by_a_lone_checker(tmp_path: Path) -> None:
    files = sorted(map(str, HEADLINES.glob("*-*.json")))
    assert len(files) > 30
    accepted_by_a_lone_checker(files, tmp_path)


def accepted_by_a_lone_checker(files: list[str], tmp_path: Path) -> None:
    """See that the checker, copied into a folder of its own, accepts each of these files."""
    lone = tmp_path / "checker_limits.py"
    for name in ("checker.py", "checker_fields.py", "checker_structure.py", lone.name):
        shutil.copy(ROOM / "trust" / name, tmp_path / name)
    run = subprocess.run([sys.executable, "-I", "-O", str(lone), *files], capture_output=True, text=True, cwd=tmp_path, check=False)
    assert run.returncode == 0, run.stderr
    assert run.stdout.count(": verified:") == len(files)
