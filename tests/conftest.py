"""These are the settings for every test.

ci          the profile in force: the same examples in every run, as many as `thorough` says, nothing remembered between runs
explore     fresh examples and no clock, for looking further: `pytest --hypothesis-profile=explore`

Where tests run in several processes, each begins with a stretch of them in the order of the files, so that what the tests of a file share
is made in one process, and takes half of what another has left when it has done its own. Tests marked `long` come first, so that no
process is left with one at the end. Where tests that start other programs are among them, the Rocq theory is compiled before they start
(once, then it is in the user's cache), so that no test waits for another's compilation. The linear algebra library gets one thread a
process: on small matrices threads mostly wait for each other.
A test marked `slow` has an hour where it names no other time, for what takes minutes takes many more on a busy machine. Bytecode is kept,
in the folders `__pycache__` that git ignores, even where PYTHONDONTWRITEBYTECODE asks for none: without it each process of tests compiles
all tests again, and each command that a test starts all modules of ours. While tests are collected, no garbage is: that is a fifth of the
time, for all that is made then stays, which is why the collector does not look at it afterwards either.
"""

import contextlib
import gc
import os
import subprocess
import sys
from collections.abc import Generator
from pathlib import Path
from typing import Any

import pytest
from filelock import FileLock
from hypothesis import settings

from tests.thorough import examples

# Before numpy is loaded, and inherited by every process that a test starts.
for threads in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(threads, "1")
sys.dont_write_bytecode = False
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
settings.register_profile("ci", derandomize=True, database=None, deadline=None, max_examples=examples(100))
settings.register_profile("explore", derandomize=False, database=None, deadline=None, max_examples=1000)
settings.load_profile("ci")
HOUR = 3600


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Collect tests while no garbage is collected, which is looked for afterwards among what is made from then on."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """The long tests first, all others in their order; slow ones have more time."""
    for item in items:
        if item.get_closest_marker("slow") and not item.get_closest_marker("timeout"):
            item.add_marker(pytest.mark.timeout(HOUR))
    items.sort(key=lambda item: item.get_closest_marker("long") is None)


@pytest.hookimpl(optionalhook=True, tryfirst=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Return the scheduler that steals, where `-n` alone was given; xdist's own otherwise."""
    from xdist.scheduler import WorkStealingScheduling

    return WorkStealingScheduling(config, log) if config.getvalue("dist") == "load" else None


def pytest_sessionstart(session: pytest.Session) -> None:
    """The theory is compiled once, in the process that starts the others, where a test may ask for it."""
    options = session.config.option
    if getattr(options, "numprocesses", None) and "not programs" not in options.markexpr:
        from faultspace.proofs.rocq.build import BrokenTheory, NoRocq, compiled_theory

        with contextlib.suppress(BrokenTheory, NoRocq):  # the tests tell
            compiled_theory()


@pytest.fixture(scope="session")
def certificates_of_a_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder into which a run of the main job wrote its certificates, one run for all processes of a session."""
    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "run"
    with FileLock(f"{folder}.lock"):
        if not folder.exists():
            command = [sys.executable, "-m", "faultspace", "verify", "--effort", "quick", "--jobs", "2"]
            subprocess.run([*command, "--out", str(folder)], check=True)
    return folder
