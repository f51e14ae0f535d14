"""Who does the work makes no difference: one process, several, a Dask cluster; and what is said where they cannot be had."""

from __future__ import annotations

import sys
from dataclasses import asdict, replace

import numpy as np
import pytest

from faultspace.base.errors import InvalidData
from faultspace.numeric.study import workers as study_workers
from faultspace.numeric.study.groups import Plan
from faultspace.numeric.study.studies import CORRECTED, PUBLISHED, Study, monte_carlo
from faultspace.numeric.study.workers import in_order


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
    # As published, systems are taken in stacks: neither the stacks nor the processes show.
    published = (
        monte_carlo(replace(PUBLISHED, stack=k, worth=4), systems=14, seed=4, jobs=jobs, samples=300) for k, jobs in ((4, 2), (9, 1))
    )
    assert next(published).cases == next(published).cases
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


def test_without_a_scheduler_there_one_line_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr(study_workers, "PATIENCE", 1)
    for address in ("tcp://127.0.0.1:9", "nonsense://", "127.0.0.1:notaport"):
        with pytest.raises(InvalidData, match="no Dask scheduler answers"):
            monte_carlo(PUBLISHED, systems=2, samples=100, cluster=address)


def test_without_workers_there_one_line_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(study_workers, "PATIENCE", 2)
    with (
        distributed.LocalCluster(n_workers=0, dashboard_address=None) as cluster,
        pytest.raises(InvalidData, match="has no worker"),
    ):
        monte_carlo(PUBLISHED, systems=2, samples=100, cluster=cluster.scheduler_address)


def test_without_distributed_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InvalidData, match=r"faultspace\[cluster\]"):
        monte_carlo(PUBLISHED, systems=2, samples=100, cluster="tcp://127.0.0.1:8786")


def test_results_come_in_the_order_of_the_tasks_and_are_counted() -> None:
    heard: list[tuple[str, int, int]] = []
    assert in_order(squared, [(k,) for k in range(5)], worth=1, jobs=1, progress=lambda *each: heard.append(each)) == [0, 1, 4, 9, 16]
    assert heard == [("tasks", k, 5) for k in range(6)]


def test_a_cluster_and_a_number_of_processes_are_refused_together() -> None:
    with pytest.raises(InvalidData, match="leave one of them out"):
        monte_carlo(PUBLISHED, systems=2, jobs=2, cluster="tcp://127.0.0.1:8786")
