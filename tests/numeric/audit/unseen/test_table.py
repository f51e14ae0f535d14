"""The command: limits hold, known results are not asked again, an escape is told and makes the exit code 1."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from tests.numeric.audit.unseen import table
from tests.numeric.audit.unseen.catalogue import ALL, BY_NAME, RIGHT


def test_a_mutant_that_takes_too_long_is_ended() -> None:
    assert table.outcome(ALL[0], 0.01, 30.0)["ended"] == "no end within 0.01 s"


def test_what_is_known_is_not_asked_again_and_an_escape_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    first, second = ALL[0], ALL[1]
    asked: list[str] = []

    def answer(one: object, seconds: float, check_seconds: float) -> dict[str, object]:
        asked.append(second.name)
        return {"wrong": "w", "checks": 7, "failed": 0, "slugs": {}, "first": None}

    monkeypatch.setattr(table, "ALL", (first, second))
    monkeypatch.setattr(table, "outcome", answer)
    file = tmp_path / "found.json"
    file.write_text(json.dumps({first.name: {"wrong": "v", "checks": 9, "failed": 2, "slugs": {"some-slug": 2}, "first": None}}), "utf-8")
    assert table.main(["--json", str(file)]) == 1
    assert asked == [second.name] and set(json.loads(file.read_text("utf-8"))) == {first.name, second.name}
    said = capsys.readouterr().out
    assert f"{first.name}: 2 of 9: some-slug" in said and f"{second.name}: ESCAPES 7 checks" in said
    assert "2 mutants: 1 caught, 1 escape, 0 right by RULES.md, 0 did not end" in said


def test_the_first_check_that_fails_is_enough_and_who_fails_none_is_audited_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    one = BY_NAME["structure-lists-zeros-inside"]
    monkeypatch.setattr(table, "kept", dict)
    found = table.first_of(one, 60.0, 30.0)
    assert found["failed"] == 1 < found["checks"] and list(found["slugs"]) == ["finite-zeros"]
    monkeypatch.setattr(table, "kept", lambda: {one.name: found["first"]["name"]})
    assert table.first_of(one, 60.0, 30.0)["checks"] == 1, "what is known to fail is asked first"
    assert table.still_caught(one)
    harmless = BY_NAME["structure-goes-through-the-coefficients"]
    monkeypatch.setattr(table, "kept", lambda: dict.fromkeys((one.name, harmless.name), "normal-rank[zeros-none]-structure"))
    assert not table.still_caught(one)
    assert table.still_caught(replace(one, remembers=True)), "of one that remembers, the others are asked in turn"
    monkeypatch.setattr(table, "outcome", lambda one, seconds, check_seconds: {"whole": one.name})
    assert table.first_of(harmless, 60.0, 30.0)["whole"]
    assert not table.still_caught(replace(harmless, remembers=True))


def test_what_fails_is_written_down_in_the_order_of_the_mutants(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = ALL[:2]
    file = tmp_path / "caught_by.json"
    monkeypatch.setattr(table, "ALL", (first, second))
    monkeypatch.setattr(table, "CAUGHT_BY", file)
    named = iter(("b[w]-identify", "a[v]-identify"))

    def answer(one: object, seconds: float, check_seconds: float) -> dict[str, object]:
        return {"wrong": "w", "checks": 7, "failed": 1, "slugs": {"a": 1}, "first": {"name": next(named)}}

    monkeypatch.setattr(table, "first_of", answer)
    assert table.main(["--first", "--keep", "--only", second.name]) == 0
    assert table.main(["--first", "--keep", "--only", first.name]) == 0
    assert list(json.loads(file.read_text("utf-8")).items()) == [(first.name, "a[v]-identify"), (second.name, "b[w]-identify")]


def test_who_is_right_is_a_mutant_that_there_is() -> None:
    assert set(RIGHT) <= set(BY_NAME)
    assert table.escapes({name: {"failed": 0} for name in RIGHT}) == []


def test_a_glob_without_a_mutant_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        table.main(["--only", "no-such-*"])
    assert "there is no such mutant" in capsys.readouterr().err
