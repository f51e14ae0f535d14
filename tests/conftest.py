"""Settings for every test.

ci          the profile in force: the same examples in every run, nothing remembered between runs
explore     fresh examples and no clock, for looking further: `pytest --hypothesis-profile=explore`

Where tests run in several processes, the Rocq theory is compiled before they start (once, then it is in the user's cache), so that no test
waits for another's compilation. The linear algebra library gets one thread a process: on small matrices threads mostly wait for each other.
"""

import contextlib
import os

import pytest
from hypothesis import settings

# Before numpy is loaded, and inherited by every process that a test starts.
for threads in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(threads, "1")
settings.register_profile("ci", derandomize=True, database=None, deadline=None)
settings.register_profile("explore", derandomize=False, database=None, deadline=None, max_examples=1000)
settings.load_profile("ci")


def pytest_sessionstart(session: pytest.Session) -> None:
    """In the process that starts the others."""
    if getattr(session.config.option, "numprocesses", None):
        from faultspace.proofs.rocq.build import BrokenTheory, NoRocq, compiled_theory

        with contextlib.suppress(BrokenTheory, NoRocq):  # the tests tell
            compiled_theory()
