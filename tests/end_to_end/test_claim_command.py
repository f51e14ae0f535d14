"""`faultspace claim` as it is typed: verdicts, exit codes, JSON, certificates in a folder, parts explained, and bad files on one line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from faultspace.cli.command_line import main

CLAIMS = """
[claim.false]
hypotheses = ["left_invertible"]
conclusion = "delay_known <= n - nullity(G)"
box = { total = 4 }
%s
[claim.true]
conclusion = "lag <= n"
box = { total = 4 }
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "claims.toml"
    path.write_text(CLAIMS % "")
    return path


def test_verdicts_are_printed(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["claim", str(file)]) == 0
    out = capsys.readouterr().out
    assert "false: REFUTED" in out and "true: PROVED" in out and "follows from lag_at_most_n" in " ".join(out.split())
    assert "A=[[-1]], F=[[-1]], C=[[-1]], G=[[0]]" in out and "Traceback" not in out


def test_the_json_is_that_of_the_contract(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["claim", str(file), "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    wrong, right = answer["claims"]
    assert (wrong["id"], wrong["verdict"], right["id"], right["verdict"]) == ("false", "REFUTED", "true", "PROVED")
    assert {name: wrong["smallest"][name] for name in ("n", "m", "p")} == {"n": 1, "m": 1, "p": 1}
    assert wrong["smallest"]["system"]["G"] == [["0"]] and wrong["smallest"]["quantities"]["delay_known"] == 1
    assert right["smallest"] is None and right["tried"]["exhausted"] is True and list(right["theorems"]) == ["lag_at_most_n"]
    assert wrong["hypotheses"][0]["dropped"] == "left_invertible" and right["hypotheses"] == []
    assert len(wrong["certificates"]) == 3 and all(len(one) == 64 for one in wrong["certificates"])


def test_what_is_not_as_expected_is_exit_code_1(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file.write_text(CLAIMS % 'expected = "NOT REFUTED"')
    file.write_text('[claim.before]\nconclusion = "lag <= n"\nbox = { total = 3 }\n' + file.read_text())
    assert main(["claim", str(file), "--no-ablation"]) == 1
    said = capsys.readouterr()
    assert "false over Q: got REFUTED, expected NOT REFUTED" in said.err
    assert said.out.startswith("false: REFUTED, expected NOT REFUTED"), "it is the first thing seen"
    file.write_text(CLAIMS % 'expected = "REFUTED"')
    assert main(["claim", str(file), "--no-ablation"]) == 0


def test_certificates_are_written_and_checked(file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "certificates"
    assert main(["claim", str(file), "--out", str(out), "--no-ablation"]) == 0
    names = sorted(str(one) for one in out.iterdir())
    assert len(names) == 3 and main(["check", *names]) == 0
    assert "3 certificates" in capsys.readouterr().err


def test_parts_are_explained_on_a_system(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["claim", "example:claims", "--claim", "every-window", "--explain", "example:proposition-3"]) == 0
    out = capsys.readouterr().out
    assert "left_invertible = True" in out and "all(gap(s) == m for s in windows(n)) = True" in out
    assert main(["claim", "example:claims", "--claim", "one-window-too-early", "--explain", "example:proposition-3", "--json"]) == 0
    parts = json.loads(capsys.readouterr().out)["explained"]["one-window-too-early"]
    assert {"level": 1, "text": "gap(s) == m, s = 1", "value": "False"} in parts


def test_one_claim_of_a_file(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["claim", str(file), "--claim", "true"]) == 0
    assert "false" not in capsys.readouterr().out
    assert main(["claim", str(file), "--claim", "treu"]) == 2
    assert "the nearest is true" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[claim.x]\nconclusion = 'lagg <= n'", "claims.toml: line 2: claim.x.conclusion: column 1: got 'lagg'"),
        ("[claim.x]\nconclusion = 'left_minimal_indices[0] >= 0'", "guard it with len(left_minimal_indices)"),
        ("[claim.x]\nconclusion = 'n == 1'\nabout = 'recrod'", "the nearest is record"),
        ("[claim.x]\nconclusion = 'n == 1'\nbox = {n = [1, 1], total = 2}", "got an empty box"),
        ("", "got an empty file, expected TOML"),
        ("\xff", "UTF-8"),
        ('{"A": [[1]]}', "no TOML"),
    ],
)
def test_a_bad_file_is_told_on_one_line(text: str, words: str, file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file.write_bytes(text.encode("latin-1"))
    assert main(["claim", str(file)]) == 2
    told = capsys.readouterr()
    assert words in told.err and len(told.err.splitlines()) == 1 and told.out == ""


def test_a_file_that_is_not_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["claim", str(tmp_path / "none.toml")]) == 2
    assert "expected a TOML file" in capsys.readouterr().err
    assert main(["claim", "example:nothing"]) == 2
    assert "ledger" in capsys.readouterr().err


def test_a_system_is_no_file_of_claims_and_the_other_way_round(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["claim", "example:zeros"]) == 2
    assert main(["inspect", "example:claims"]) == 2
    assert "JSON" in capsys.readouterr().err
