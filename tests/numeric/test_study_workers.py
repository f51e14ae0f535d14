"""Who does the work makes no difference: one process, several, a Dask cluster; and what is said where they cannot be had."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest

from faultspace.base import workers as base_workers
from faultspace.base.errors import InvalidData
from faultspace.base.tasks import Died, as_they_come
from faultspace.numeric.study.groups import Plan
from faultspace.numeric.study.studies import CORRECTED, PUBLISHED, Study, done_by, monte_carlo
from faultspace.numeric.study.study_cases import Case, published_case


def squared(number: int) -> int:
    return number * number


def assert_same(one: Study, two: Study) -> None:
    """Two studies are equal up to rounding, as the workers of a cluster may have other processors."""
    for first, second in zip(one.cases, two.cases, strict=True):
        assert first.zeros == second.zeros
        assert [estimate.n_z for estimate in first.estimates.values()] == [estimate.n_z for estimate in second.estimates.values()]
        for name, estimate in first.estimates.items():
            other = second.estimates[name]
            assert estimate.errors is not None and other.errors is not None
            assert np.allclose(list(asdict(estimate.errors).values()), list(asdict(other.errors).values()), rtol=1e-5, atol=1e-8)


def test_cases_do_not_depend_on_the_number_of_workers_nor_on_how_many_follow() -> None:
    plan = Plan(**{**vars(CORRECTED), "worth": 1})
    alone, together = (monte_carlo(plan, systems=6, seed=4, jobs=jobs, samples=300) for jobs in (1, 2))
    assert alone.cases == together.cases
    shorter = monte_carlo(plan, systems=5, seed=4, jobs=1, samples=300)
    assert shorter.cases == alone.cases[:5]
    assert monte_carlo(plan, systems=5, seed=5, jobs=1, samples=300).cases != shorter.cases


def test_a_cluster_gives_the_same_cases_and_only_its_scheduler_counts() -> None:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        seen: list[int] = []
        address = cluster.scheduler_address
        spread = monte_carlo(CORRECTED, systems=6, seed=4, samples=300, cluster=address, on_progress=lambda *each: seen.append(each[1]))
    assert seen == [0, 1, 2, 3, 4, 5, 6]
    assert_same(monte_carlo(CORRECTED, systems=6, seed=4, samples=300, jobs=1), spread)


@pytest.mark.slow
def test_a_worker_of_a_cluster_that_is_killed_is_replaced_and_a_lost_scheduler_is_one_line(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    tasks = [(k, tmp_path / "once") for k in range(3, 20)]
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        found = dict(done_by(killed, tasks, worth=1, cluster=cluster.scheduler_address))
    assert found == {k - 3: k * k for k in range(3, 20)}
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = str(free.getsockname()[1])
    address, line = f"tcp://127.0.0.1:{port}", [sys.executable, "-m"]
    scheduler = subprocess.Popen([*line, "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", port, "--no-dashboard"])
    worker = subprocess.Popen([*line, "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"])
    try:
        came = 0
        with pytest.raises(InvalidData, match=f"the scheduler at {address} was lost"):
            for _ in done_by(squared, [(k,) for k in range(10**5)], worth=1, cluster=address):
                came += 1
                if came == 5:
                    scheduler.kill()
        assert came >= 5
    finally:
        for process in (scheduler, worker):
            process.kill()
            process.wait()


def test_a_worker_that_is_gone_while_much_is_under_way_is_no_error(monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed")
    threads = iter([{"many": 4}])
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None) as cluster:
        monkeypatch.setattr(distributed.Client, "nthreads", lambda self: next(threads, {"few": 1}))
        found = dict(as_they_come(squared, [(k,) for k in range(30)], count=1, cluster=cluster.scheduler_address))
    assert found == {k: k * k for k in range(30)}


def test_without_a_scheduler_there_one_line_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr(base_workers, "PATIENCE", 1)
    for address in ("tcp://127.0.0.1:9", "nonsense://", "127.0.0.1:notaport"):
        with pytest.raises(InvalidData, match="no Dask scheduler answers"):
            monte_carlo(PUBLISHED, systems=2, samples=100, cluster=address)


def test_without_workers_there_one_line_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(base_workers, "PATIENCE", 2)
    with (
        distributed.LocalCluster(n_workers=0, dashboard_address=None) as cluster,
        pytest.raises(InvalidData, match="has no worker"),
    ):
        monte_carlo(PUBLISHED, systems=2, samples=100, cluster=cluster.scheduler_address)


def test_without_distributed_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InvalidData, match=r"faultspace\[cluster\]"):
        monte_carlo(PUBLISHED, systems=2, samples=100, cluster="tcp://127.0.0.1:8786")


def test_each_task_has_one_result_whatever_the_number_of_processes() -> None:
    for jobs in (1, 2):
        found = list(done_by(squared, [(k,) for k in range(9)], worth=1, jobs=jobs))
        assert sorted(found) == [(k, k * k) for k in range(9)]
    assert list(done_by(squared, [], worth=1, jobs=2)) == []


def killed(number: int, once: Path) -> int:
    """Two kills always; three kills its process once."""
    if number == 2 or (number == 3 and not once.exists()):
        once.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return squared(number)


def test_a_process_that_is_killed_is_replaced_and_its_tasks_are_done_again(tmp_path: Path) -> None:
    found = dict(done_by(killed, [(k, tmp_path / "once") for k in range(3, 12)], worth=1, jobs=2))
    assert found == {k - 3: k * k for k in range(3, 12)}


@pytest.mark.slow
def test_a_task_that_always_kills_its_process_is_given_up_and_the_others_are_done(tmp_path: Path) -> None:
    found = dict(done_by(killed, [(k, tmp_path / "once") for k in range(12)], worth=1, jobs=2))
    died = found.pop(2)
    assert isinstance(died, Died) and "ended, 2 times" in died.reason
    assert found == {k: k * k for k in range(12) if k != 2}


@pytest.mark.slow
def test_of_tasks_that_a_cluster_does_together_only_the_one_that_kills_is_given_up(tmp_path: Path) -> None:
    """Quick tasks go to a worker together; of those that were killed together each is then tried alone."""
    distributed = pytest.importorskip("distributed")
    (tmp_path / "once").touch()
    tasks = [(k, tmp_path / "once") for k in (*range(3, 60), 2, *range(60, 90))]
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        found = dict(as_they_come(killed, tasks, count=1, cluster=cluster.scheduler_address))
    died = found.pop(57)
    assert isinstance(died, Died)
    assert found == {number: k * k for number, (k, _) in enumerate(tasks) if k != 2}


def kills(index: int, seed: np.random.SeedSequence, samples: int) -> Case:
    if index == 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return published_case(index, seed, samples)


@pytest.mark.slow
def test_only_a_case_that_kills_its_process_fails() -> None:
    study = monte_carlo(replace(PUBLISHED, case=kills, worth=1), systems=6, seed=4, jobs=2, samples=30)
    assert [each.index for each in study.failed] == [2]
    whole = monte_carlo(PUBLISHED, systems=6, seed=4, jobs=1, samples=30).cases
    assert study.cases == whole[:2] + whole[3:]


def test_what_is_known_is_not_done_again() -> None:
    came: list[int] = []
    whole = monte_carlo(PUBLISHED, systems=8, seed=4, jobs=1, samples=300)
    known = {case.index: case for case in whole.cases[1:7:2]} | {100: whole.cases[0]}
    rest = monte_carlo(
        PUBLISHED, systems=8, seed=4, jobs=1, samples=300, known=known, on_cases=lambda cases: came.extend(each.index for each in cases)
    )
    assert came == [0, 2, 4, 6, 7]
    assert rest.cases == whole.cases and rest.to_json() == whole.to_json()


def test_a_cluster_and_a_number_of_processes_are_refused_together() -> None:
    with pytest.raises(InvalidData, match="leave one of them out"):
        monte_carlo(PUBLISHED, systems=2, jobs=2, cluster="tcp://127.0.0.1:8786")
