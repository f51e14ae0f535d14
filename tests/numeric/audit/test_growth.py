"""Peak memory and CPU time are measured where they are spent: here, and in programs that were started."""

from __future__ import annotations

import subprocess
import sys
import time
from functools import partial

import numpy as np
import pytest

from faultspace.numeric.audit.checks.growth import BOUND, MEMORY_FLOOR, TIME_FLOOR, exponent, footprint, timed


def _spin(seconds: float) -> None:
    begun = time.process_time()
    while time.process_time() - begun < seconds:
        pass


def test_memory_that_was_given_back_is_seen() -> None:
    def work() -> None:
        held = np.ones(8_000_000)
        time.sleep(0.05)
        del held

    assert 60e6 < footprint(work) < 100e6
    assert footprint(lambda: time.sleep(0.02)) < 10e6


def test_time_is_that_of_the_processor() -> None:
    assert timed(lambda: time.sleep(0.3)) < 0.15
    assert 0.2 < timed(lambda: _spin(0.3)) < 0.5


def test_children_count() -> None:
    work = "import time; x = bytearray(80_000_000); t = time.process_time()\nwhile time.process_time() - t < 0.4: pass"
    ran = partial(subprocess.run, [sys.executable, "-c", work], check=True)
    assert footprint(ran) > 70e6 and timed(ran) > 0.35


@pytest.mark.parametrize(
    ("power", "beyond"),
    [(1, False), (2, True), (3, True)],
)
def test_powers_are_told_apart(power: int, beyond: bool) -> None:
    lengths = (2000, 8000)
    costs = float(2000**power), float(8000**power)
    for floor in (MEMORY_FLOOR, TIME_FLOOR):
        seen = exponent((costs[0] / costs[1] * 10 * floor, 10 * floor), lengths, floor)
        assert (seen > BOUND) == beyond
    assert exponent((0.0, 0.9 * TIME_FLOOR), lengths, TIME_FLOOR) == 0
    # A small cost that cannot be seen is taken for the floor's share: what grows in proportion is never blamed for it.
    assert exponent((0.0, 1.5 * MEMORY_FLOOR), lengths, MEMORY_FLOOR) < BOUND
