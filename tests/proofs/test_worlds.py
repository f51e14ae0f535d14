"""Orbits over GF(2) without a list of all systems, against the list, Burnside's lemma and brute force; and worlds gone through in parts."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from faultspace.base import workers
from faultspace.base.errors import quote_path
from faultspace.proofs import worlds
from faultspace.proofs.brought import readings
from faultspace.proofs.brought.trying import search
from faultspace.proofs.evidence import orbits_by_stages as stages
from faultspace.proofs.evidence.corpus import Questions
from faultspace.proofs.evidence.exhaustive import orbits
from faultspace.proofs.evidence.orbits_by_stages import orbit_count, orbits_by_stages
from faultspace.proofs.trust.checker import Rejected
from faultspace.proofs.verdict.verdicts import Outcome
from faultspace.proofs.verdict.workbench import Show, Test, Workbench, certify
from faultspace.proofs.worlds import cost, covered, main, units

SMALL = [(0, 0, 0), (1, 1, 1), (2, 1, 1), (1, 2, 2), (2, 0, 2), (2, 2, 0), (0, 2, 2), (2, 2, 1), (3, 0, 0)]


@pytest.mark.parametrize(("n", "p", "m"), SMALL)
def test_orbits_are_those_of_the_list_of_all_systems(n: int, p: int, m: int) -> None:
    """The sizes are the same, and no two representatives lie in one orbit."""
    found, listed = list(orbits_by_stages(n, p, m)), orbits(2, n, p, m)
    assert sorted(one.size for one in found) == sorted(one.size for one in listed)
    assert len(found) == orbit_count(n, p, m)
    assert sum(one.size for one in found) == 2 ** ((n + p) * (n + m))


@pytest.mark.parametrize(("n", "p", "m"), [(1, 1, 1), (2, 1, 1), (1, 1, 2)])
def test_a_representative_stands_for_what_every_change_of_basis_makes_of_it(n: int, p: int, m: int) -> None:
    groups = [[np.array(g).reshape(k, k) for g in product((0, 1), repeat=k * k) if round(np.linalg.det(np.array(g).reshape(k, k))) % 2]
              for k in (n, p, m)]  # fmt: skip
    seen: set[bytes] = set()
    for one in orbits_by_stages(n, p, m):
        A, F, C, G = (np.array(part.to_json(), dtype=np.int64) for part in (one.system.A, one.system.F, one.system.C, one.system.G))
        images = set()
        for T, U, V in product(*groups):
            back = next(S for S in groups[0] if not ((S @ T + np.eye(n)) % 2).any())
            images.add(b"".join((part % 2).astype(np.int8).tobytes() for part in (T @ A @ back, T @ F @ V, U @ C @ back, U @ G @ V)))
        assert len(images) == one.size and not images & seen
        seen |= images
    assert len(seen) == 2 ** ((n + p) * (n + m))


def test_known_numbers() -> None:
    """There are 2, 6, 14 classes of similar matrices, and n = 3, p = 3, m = 2 has 14468 orbits in 2^30 systems."""
    assert [orbit_count(n, 0, 0) for n in range(4)] == [1, 2, 6, 14]
    assert orbit_count(3, 3, 2) == 14468
    assert all(len(stages._general_linear(k)) == size for k, size in ((0, 1), (1, 1), (2, 6), (3, 168)))
    with pytest.raises(ValueError, match="n \\+ m"):
        next(orbits_by_stages(4, 1, 3))


def lines_of(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


ARGUMENTS = ["--n", "1", "--p", "1", "--m", "1", "--jobs", "1"]


def test_a_world_is_gone_through_goes_on_where_it_stopped_and_says_what_it_covered(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "world.jsonl"
    assert main([*ARGUMENTS, "--part", "3", "--out", str(out)]) == 0
    part = lines_of(out)
    assert len(part) == len(list(units(1, 1, 1))[::3])
    out.write_text(out.read_text(encoding="utf-8") + '{"format": "faultspace-wor', encoding="utf-8")  # stopped in the middle of a line
    tried: list[worlds.Unit] = []
    real = worlds.examined

    def watched(unit: worlds.Unit) -> worlds.Found:
        tried.append(unit)
        return real(unit)

    monkeypatch.setattr(worlds, "examined", watched)
    assert main([*ARGUMENTS, "--out", str(out)]) == 0
    assert len(tried) == len(list(units(1, 1, 1))) - len(part)
    rows = [row.split() for row in capsys.readouterr().out.splitlines()]
    (row,) = (row for row in rows if row[:8] == ["1", "1", "1", "16", "16", "16", "4", "1"])
    assert int(row[8]) == sum(line["accepted"] for line in lines_of(out) if (line["n"], line["p"], line["m"]) == (1, 1, 1)) > 16
    whole = {(line["n"], line["p"], line["m"], line["pair"]): line for line in lines_of(out)}
    assert set(whole) == set(units(1, 1, 1)) and not any(line["failing"] for line in whole.values())
    assert sum(line["systems"] for line in whole.values()) == sum(2 ** ((n + p) * (n + m)) for n, p, m in product(range(2), repeat=3))
    tried.clear()
    assert main([*ARGUMENTS, "--out", str(out)]) == 0 and tried == []


def without_seconds(lines: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [{key: value for key, value in line.items() if key != "seconds"} for line in lines]


def test_a_cluster_finds_the_same_and_each_goes_on_where_the_other_stopped(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    alone, spread, both = (tmp_path / f"{name}.jsonl" for name in ("alone", "spread", "both"))
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        theirs = ["--scheduler", cluster.scheduler_address]
        assert main([*ARGUMENTS[:6], *theirs, "--out", str(spread)]) == 0
        assert main([*ARGUMENTS, "--part", "2", "--out", str(both)]) == 0
        assert main([*ARGUMENTS[:6], *theirs, "--out", str(both)]) == 0
    assert main([*ARGUMENTS, "--out", str(alone)]) == 0
    here = without_seconds(lines_of(alone))
    assert sorted(map(str, without_seconds(lines_of(spread)))) == sorted(map(str, here)) and len(here) == len(list(units(1, 1, 1)))
    assert sorted(map(str, without_seconds(lines_of(both)))) == sorted(map(str, here))


def test_without_a_scheduler_there_one_line_says_so_and_nothing_is_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr(workers, "PATIENCE", 1)
    with pytest.raises(SystemExit) as left:
        main([*ARGUMENTS[:6], "--scheduler", "tcp://127.0.0.1:9", "--out", str(tmp_path / "world.jsonl")])
    assert left.value.code == 2 and "no Dask scheduler answers" in capsys.readouterr().err
    assert not (tmp_path / "world.jsonl").exists()


def test_a_run_that_is_stopped_keeps_what_is_finished(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    out, real = tmp_path / "world.jsonl", worlds.examined
    stop_at = list(units(1, 1, 1))[4]

    def stopped(unit: worlds.Unit) -> worlds.Found:
        if unit == stop_at:
            raise KeyboardInterrupt
        return real(unit)

    monkeypatch.setattr(worlds, "examined", stopped)
    assert main([*ARGUMENTS, "--out", str(out)]) == 130
    said = capsys.readouterr()
    assert said.out == "" and "the same command goes on from there" in said.err and len(lines_of(out)) == 4
    monkeypatch.setattr(worlds, "examined", real)
    assert main([*ARGUMENTS, "--out", str(out)]) == 0
    units_of = [(line["n"], line["p"], line["m"], line["pair"]) for line in lines_of(out)]
    assert units_of == list(units(1, 1, 1))


def test_a_unit_that_stands_twice_in_the_file_counts_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As in a file that two runs wrote before they refused each other."""
    out = tmp_path / "world.jsonl"
    assert main([*ARGUMENTS, "--out", str(out)]) == 0
    before = capsys.readouterr().out
    out.write_text(out.read_text(encoding="utf-8") * 2, encoding="utf-8")
    assert main([*ARGUMENTS, "--out", str(out)]) == 0
    after = capsys.readouterr().out.splitlines()
    (told,) = (line for line in after if "by an earlier run" in line)  # the counts are no work of this one
    assert [line for line in after if line != told] == before.splitlines() and "1 of 2^" not in before
    count, _, units, *_ = told.split()
    assert count == units and told.endswith(f"as {quote_path(str(out))} tells it")


def test_what_all_of_it_takes_is_told_by_what_a_part_took() -> None:
    """An orbit of a row of which none was gone through yet is taken to be as slow as those of the slowest row."""
    dimensions = [(0, 1, 1), (1, 0, 0), (1, 1, 1)]
    assert [orbit_count(*one) for one in dimensions] == [2, 2, 16]
    line = {"p": 1, "m": 1, "pair": 0, "systems": 0, "accepted": 0, "failing": []}
    part = [line | {"n": 0, "orbits": 1, "seconds": 2.0}, line | {"n": 1, "orbits": 4, "seconds": 12.0}]
    words = cost(part, dimensions)
    assert words.startswith("5 of 20 orbits took 14 s of one processor, the longest unit 12 s; all of them would take about 58 s")
    whole = [line | {"n": 1, "p": 0, "m": 0, "orbits": 2, "seconds": 1.0}]
    assert cost(whole, dimensions[1:2]) == "2 of 2 orbits took 1 s of one processor, the longest unit 1 s"
    assert cost([line | {"n": 1, "orbits": 0, "seconds": 1.0}], dimensions) == cost([], dimensions) == "no orbit was gone through"


def test_what_fails_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """A reading without its hypotheses fails on a unit that has systems which lack them, and so does one with a refused certificate."""
    monkeypatch.setattr(worlds, "READINGS", ("language.assumption-4--lag",))

    def without(bench: Workbench, asks: Questions, applies: Test, holds: Test, show: Show) -> Outcome:
        return certify(bench, asks, lambda e: True, holds, show)

    monkeypatch.setattr(readings, "certify", without)
    monkeypatch.setattr(
        readings, "search", lambda box, asked, **given: search(replace(box, total=2), asked, **given)
    )  # nothing fails there
    assert main([*ARGUMENTS, "--out", str(tmp_path / "world.jsonl")]) == 1
    assert "language.assumption-4--lag: REFUTED, fails on" in capsys.readouterr().out

    def refused(origin: str, system: object, weight: int) -> object:
        raise Rejected("not so")

    monkeypatch.setattr(worlds, "examine", refused)
    found = worlds.examined((1, 1, 1, 0))
    assert found["failing"] == ["Rejected: not so"] and found["systems"] == 0


def test_bad_input_is_a_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    other = tmp_path / "other.json"
    other.write_text('{"format": "something"}\n', encoding="utf-8")
    lists, halves, folder = tmp_path / "lists.json", tmp_path / "halves.json", tmp_path / "folder"
    lists.write_text("[1, 2]\n", encoding="utf-8")
    halves.write_text('{"format": "faultspace-worlds/1", "n": 1, "p": 1, "m": 1}\n', encoding="utf-8")
    folder.mkdir()
    files = [["--out", str(path)] for path in (other, lists, halves, folder, folder / "missing" / "file.jsonl")]
    for wrong in (["--n", "-1"], ["--n", "5", "--m", "2"], ["--jobs", "1", "--scheduler", "tcp://nowhere:1"], *files):
        with pytest.raises(SystemExit) as left:
            main(["--out", str(tmp_path / "world.jsonl"), *wrong])
        assert left.value.code == 2
    assert other.read_text(encoding="utf-8") == '{"format": "something"}\n' and capsys.readouterr().out == ""


def test_the_table_says_how_much_of_a_part() -> None:
    line = {"n": 1, "p": 1, "m": 1, "pair": 0, "orbits": 4, "systems": 8, "accepted": 9, "failing": [], "seconds": 0.5}
    assert covered([line]).splitlines()[1].split() == ["1", "1", "1", "4", "16", "8", "4", "0.5", "9", "0.5"]
