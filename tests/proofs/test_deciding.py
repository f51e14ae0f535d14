"""Tasks in rounds: what they ask for is made once and read by other processes; what fails there is an error of those who ask."""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from faultspace.base.errors import InvalidInput
from faultspace.base.progress import silent
from faultspace.proofs import deciding
from faultspace.proofs.deciding import Check, decided
from faultspace.proofs.evidence.material import Carried, Folder, Material, Packed, Shelf, Wanted
from faultspace.proofs.trust.checker import Rejected
from faultspace.proofs.verdict.verdicts import ClaimResult, Report
from faultspace.proofs.verdict.workbench import Workbench
from faultspace.proofs.verification import verify


def three(bench: Any) -> Iterator[int]:
    return iter(range(3))


def twice(item: int) -> list[int]:
    return [item, 10 * item]


def refused(item: int) -> list[int]:
    if item == 2:
        raise Rejected("two is not accepted")
    return [item]


def without_items(bench: Any) -> Iterator[int]:
    raise ArithmeticError("no items")


def no_items(bench: Any) -> list[int]:
    return []


TWICE = Material("twice", "counting", three, twice, 2)
REFUSED = Material("refused", "counting", three, refused, 1)
NOTHING = Material("nothing", "counting", without_items, twice, 1)


# Two processes start slowly; daily the main job decides everything in two (end_to_end/test_main_job.py), and one keeps errors here.
@pytest.mark.parametrize("jobs", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_material_is_in_order_and_an_error_is_kept_for_who_asks(jobs: int, tmp_path: Path) -> None:
    bench = Workbench("quick", jobs, silent)
    bench.make([TWICE, REFUSED, NOTHING], Folder(tmp_path))
    for reader in (bench, Workbench("quick", 1, silent, Folder(tmp_path))):
        assert reader.material(TWICE) == (0, 0, 1, 10, 2, 20)
        with pytest.raises(Rejected, match="two is not accepted"):
            reader.material(REFUSED)
        with pytest.raises(ArithmeticError, match="no items"):
            reader.material(NOTHING)


def test_kinds_made_together_are_loaded_together_by_who_asks_and_not_by_who_makes(tmp_path: Path) -> None:
    """What was put there before stays; kinds of no items are there, and empty."""
    alike, none = Material("alike", "counting", three, twice, 2), Material("none", "counting", no_items, twice, 2)
    maker, reader = Workbench("quick", 1, silent), Workbench("quick", 1, silent, Folder(tmp_path))
    maker.make([TWICE, alike, none], Folder(tmp_path))
    assert not maker._made
    assert reader.material(none) == () and list(reader._made) == ["none"]
    first = reader.material(TWICE)
    assert set(reader._made) == {"twice", "alike", "none"} and reader.material(TWICE) is first == reader.material(alike)
    maker.put(alike, [5])
    assert maker.material(TWICE) == first and maker.material(alike) == (5,)


def test_what_is_not_on_the_shelf_is_wanted_all_at_once(tmp_path: Path) -> None:
    shelf = Folder(tmp_path)
    reader = Workbench("quick", 1, silent, shelf)
    shelf.put(Packed((TWICE.name,), (pickle.dumps([[1, 2]]),)))
    with pytest.raises(Wanted) as raised:
        reader.need(REFUSED, TWICE, NOTHING)
    assert raised.value.kinds == (REFUSED, NOTHING)
    with pytest.raises(Wanted):
        reader.material(REFUSED)
    reader.need(TWICE)
    Workbench("quick", 1, silent).need(REFUSED)  # made where it is asked for


@pytest.mark.slow  # the main job finds in two processes what the certificates of the tree, and the ledger, say
def test_processes_decide_as_one_does() -> None:
    tasks = [Check("example_v.one_fault"), Check("bad_set.codimension_unobservable"), Check("nowhere.at_all")]
    alone, together = (decided(Workbench("quick", jobs, silent), tasks) for jobs in (1, 2))
    assert {task: answer.found for task, answer in alone.items()} == {task: answer.found for task, answer in together.items()}
    assert "No module named" in together[tasks[2]].found.evidence


@pytest.mark.parametrize("carried", [False, True])
def test_a_task_that_asks_is_tried_again_when_that_is_there(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, carried: bool) -> None:
    """Each round makes what the one before asked for; a task that asks for nothing is done once."""
    shelf: Shelf = Carried() if carried else Folder(tmp_path)
    monkeypatch.setattr(deciding, "ordered", lambda call, tasks, count: (call(*each[:-1], each[-1].value) for each in tasks))
    tried: list[str] = []

    class Asking:
        def done(self, bench: Workbench) -> object:
            tried.append("asking")
            return bench.material(TWICE) + bench.material(Material("later", "counting", three, twice, 2))

    class Free:
        def done(self, bench: Workbench) -> str:
            tried.append("free")
            return "done"

    tasks: Any = [Asking(), Free()]
    answers = deciding._in_rounds(Workbench("quick", 1, silent), tasks, shelf)
    assert tried == ["asking", "free", "asking", "asking"]
    assert [answers[task].found for task in tasks] == [(0, 0, 1, 10, 2, 20) * 2, "done"]


def test_what_is_carried_is_what_was_asked_for_and_is_sent_once() -> None:
    shelf = Carried()
    one, two = Packed(("one",), (b"1",)), Packed(("two", "three"), (b"2",))
    shelf.put(one)
    shelf.put(two)
    part = shelf.part(["two"])
    assert part.run == shelf.run and "one" not in part and part["two"] is shelf["three"] is two
    assert shelf.part({"two"}) is part and shelf.part([]) is not part
    sent = pickle.loads(pickle.dumps(part))
    assert sent.run == shelf.run and sent["two"] == two


def test_another_run_in_the_same_process_finds_nothing_of_the_one_before() -> None:
    """A Dask worker outlives a run."""
    runs = [Carried(), Carried()]
    benches = [deciding._bench("quick", shelf) for shelf in (runs[0], runs[0], runs[1])]
    assert benches[0] is benches[1] is not benches[2] and benches[2].shelf is runs[1]


@pytest.mark.slow  # a cluster takes seconds to start
def test_a_cluster_decides_as_one_process_does() -> None:
    """Material goes along with the tasks, to workers with two threads each."""
    distributed = pytest.importorskip("distributed")
    alone = verify(["settle-1", "bad-set"], jobs=1)
    with distributed.LocalCluster(n_workers=1, threads_per_worker=2, processes=True, dashboard_address=None) as cluster:
        spread = verify(["settle-1", "bad-set"], scheduler=cluster.scheduler_address)
    assert [claim.readings for claim in without_seconds(spread)] == [claim.readings for claim in without_seconds(alone)]
    assert spread.hypotheses == alone.hypotheses


def without_seconds(report: Report) -> list[ClaimResult]:
    return [replace(claim, readings=tuple(replace(one, seconds=0.0) for one in claim.readings)) for claim in report.claims]


def test_a_scheduler_excludes_a_number_of_processes() -> None:
    with pytest.raises(InvalidInput, match="the cluster decides how many work"):
        verify(["example-v"], jobs=2, scheduler="tcp://127.0.0.1:9")
