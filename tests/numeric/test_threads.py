"""BLAS has one thread in what the package computes: results are the same bytes wherever it runs, and others get theirs back.

SHOWN       a record whose matrices are so large that a second thread splits their sums at other places
"""

from __future__ import annotations

import importlib
import inspect
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from threading import Event, Thread
from typing import Any

import numpy as np
import pytest
import scipy.linalg  # noqa: F401  # its BLAS is another than numpy's
from threadpoolctl import ThreadpoolController, threadpool_limits

from faultspace.base.errors import InvalidData
from faultspace.base.threads import one_thread
from faultspace.numeric import StateSpaceModel, count_faults, fault_dimension, pi_moesp
from faultspace.numeric.plant.monitor import monitoring
from faultspace.numeric.plant.report.result_files import of_monitor
from faultspace.numeric.study.studies import done_by

NUMERIC: Any = importlib.import_module("faultspace.numeric")
# They read and hold data, and multiply no matrices.
WITHOUT_BLAS = {"read_record", "read_stretches", "record_from"}
SHOWN = """
import numpy as np
from faultspace.numeric import StateSpaceModel
draw = np.random.default_rng(3)
plant = StateSpaceModel(np.diag([-0.8, -0.3, 0.1, 0.5, 0.9]), *(draw.standard_normal(shape) for shape in ((5, 4), (6, 5), (6, 4))))
u = draw.standard_normal((3000, 4))
y = plant.simulate(u) + 0.1 * draw.standard_normal((3000, 6))
"""
ANSWERS = f"""
{SHOWN}
import hashlib, json, sys
from dataclasses import asdict
import faultspace as fs
from faultspace.numeric import arx_reduction, fault_dimension
from faultspace.numeric.study.study_cases import identified_case
from faultspace.numeric.study.runs import study_run
from faultspace.numeric.study.random_systems import study_system
from faultspace.numeric.study.studies import done_by

run = study_run(study_system(2, np.random.SeedSequence(5)), 7, level=0.01, samples=300)
answers = [fs.identify(run.y, run.u, order=5).to_json()]
answers += [arx_reduction(y, u, order=5).to_json(), fault_dimension(y[:, :4], u=u).to_json()]
tasks = [(index, seed, 301) for index, seed in enumerate(np.random.SeedSequence(1).spawn(2))]
answers += [[asdict(case) for _, case in sorted(done_by(identified_case, tasks, worth=2, jobs=int(sys.argv[1])), key=lambda each: each[0])]]
print(*(hashlib.sha256(json.dumps(answer).encode()).hexdigest() for answer in answers))
"""


def threads() -> list[int]:
    """Return how many threads each BLAS has."""
    return [library["num_threads"] for library in ThreadpoolController().select(user_api="blas").info()]


@contextmanager
def two_threads() -> Iterator[None]:
    """Every BLAS has two threads, as it has where nobody says otherwise."""
    libraries = ThreadpoolController().select(user_api="blas")
    if not libraries.lib_controllers or max(os.cpu_count() or 1, 1) < 2:
        pytest.skip("no BLAS that can have two threads")
    with libraries.limit(limits=2):
        assert set(threads()) == {2}
        yield


def with_threads(number: int, jobs: int) -> list[str]:
    """Return the digests of an identification and of the study's cases, in so many processes, under this many threads."""
    names = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
    environment = os.environ | dict.fromkeys(names, str(number))
    command = [sys.executable, "-c", ANSWERS, str(jobs)]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout.split()


@pytest.mark.slow
def test_answers_are_the_same_bytes_whatever_the_threads_and_the_jobs() -> None:
    assert with_threads(1, 1) == with_threads(2, 2)


@pytest.mark.slow
def test_without_the_limit_they_are_not() -> None:
    """The record of the test above would show it."""
    made: dict[str, Any] = {}
    exec(SHOWN, made)
    with threadpool_limits(1):
        held = fault_dimension(made["y"][:, :4], u=made["u"]).to_json()
    with two_threads():
        assert fault_dimension(made["y"][:, :4], u=made["u"]).to_json() == held
        free = inspect.unwrap(fault_dimension)(made["y"][:, :4], u=made["u"]).to_json()
    if free == held:
        pytest.skip("this BLAS sums in the same order with two threads")


def test_there_is_one_thread_within_and_what_was_there_before_comes_back() -> None:
    with two_threads():
        with one_thread():
            assert set(threads()) == {1}
            with one_thread():
                assert set(threads()) == {1}
            assert set(threads()) == {1}
        assert set(threads()) == {2}


def test_the_threads_come_back_where_an_error_is_raised() -> None:
    with two_threads():
        with pytest.raises(ValueError), ExitStack() as entered:
            entered.enter_context(one_thread())
            raise ValueError
        assert set(threads()) == {2}


def test_who_leaves_first_takes_the_thread_from_nobody() -> None:
    inside, leave = Event(), Event()

    def first() -> None:
        with one_thread():
            inside.set()
            leave.wait(10)

    with two_threads():
        other = Thread(target=first)
        other.start()
        assert inside.wait(10)
        with one_thread():
            leave.set()
            other.join()
            assert set(threads()) == {1}
        assert set(threads()) == {2}


def test_the_limit_of_another_thread_is_no_hindrance() -> None:
    inside, leave = Event(), Event()

    def other() -> None:
        with threadpool_limits(2):
            inside.set()
            leave.wait(10)

    holder = Thread(target=other)
    holder.start()
    assert inside.wait(10)
    before = threads()
    with one_thread():
        assert set(threads()) == {1}
    assert threads() == before
    leave.set()
    holder.join()


def test_a_call_computes_with_one_thread() -> None:
    seen: list[set[int]] = []

    def pieces() -> Iterator[tuple[Any, Any]]:
        seen.append(set(threads()))
        u = np.random.default_rng(1).standard_normal((300, 1))
        yield StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]]).simulate(u), u

    class Source:
        def __iter__(self) -> Iterator[tuple[Any, Any]]:
            return pieces()

    with two_threads():
        pi_moesp(Source(), block_rows=5)
        assert set(threads()) == {2}
    assert seen and all(one == {1} for one in seen)


def test_what_a_monitor_needs_is_learnt_with_one_thread_where_an_answer_is_written(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[set[int]] = []

    def plant(found: object) -> Any:
        seen.append(set(threads()))
        raise InvalidData("seen")

    monkeypatch.setattr(monitoring, "_plant", plant)
    answer: Any = None
    with two_threads():
        assert of_monitor(answer)[0] is None
    assert seen == [{1}]


@pytest.mark.parametrize("name", sorted(set(NUMERIC.__all__) - WITHOUT_BLAS))
def test_every_public_function_holds_the_threads(name: str) -> None:
    function: Callable[..., Any] = getattr(NUMERIC, name)
    if inspect.isfunction(function):
        assert "one_thread" in inspect.getsource(inspect.unwrap(function)).partition("def ")[0]


def test_a_function_keeps_its_name_and_arguments() -> None:
    assert count_faults.__name__ == "count_faults"
    assert list(inspect.signature(count_faults).parameters)[:3] == ["y", "u", "order"]


def test_work_is_handed_out_with_one_thread() -> None:
    with two_threads():
        assert list(done_by(_threads_of_a_task, [()], worth=1, jobs=1)) == [(0, [1])]


@one_thread()
def _threads_of_a_task() -> list[int]:
    return sorted(set(threads()))
