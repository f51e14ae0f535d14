"""Numbers of systems and samples that memory does not hold are refused at once, by bounds that are measured here."""

from __future__ import annotations

import pickle
import subprocess
import sys
import time
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from faultspace.base.errors import InvalidData
from faultspace.numeric.study import studies
from faultspace.numeric.study.studies import CASE_BYTES, CORRECTED_IDENTIFIED, PUBLISHED, SAMPLE_BYTES, STUDIES, monte_carlo
from tests.end_to_end.commands import call
from tests.end_to_end.test_bad_input import refused

PEAK = (
    "import sys; from faultspace.numeric.study.studies import monte_carlo\n"
    "def peak(): return next(int(line.split()[1]) << 10 for line in open('/proc/self/status') if line.startswith('VmHWM'))\n"
    "name, systems, samples = sys.argv[1], *map(int, sys.argv[2:])\n"
    "monte_carlo(name, systems=1, samples=100, jobs=1)\n"
    "before = peak(); monte_carlo(name, systems=systems, samples=samples, jobs=1); print(peak() - before)"
)


@pytest.mark.parametrize("option", ["--systems", "--samples"])
def test_more_than_memory_holds_is_refused_at_once(option: str, tmp_path: Path) -> None:
    begun = time.monotonic()
    refused(call("monte-carlo", option, "1000000000000", "--out", str(tmp_path / "out")), option.strip("-"), "GB of memory", "at most")
    assert time.monotonic() - begun < 5 and not (tmp_path / "out").exists()


def test_what_is_refused_follows_the_memory_there_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        "faultspace.numeric.study.studies.psutil.virtual_memory", lambda: type("Memory", (), {"available": 100 * SAMPLE_BYTES})
    )
    monte_carlo(PUBLISHED, systems=4, samples=100, jobs=1)
    with pytest.raises(InvalidData, match="ask for 100 at most"):
        monte_carlo(PUBLISHED, systems=4, samples=101, jobs=1)
    with pytest.raises(InvalidData, match="with another seed"):
        monte_carlo(PUBLISHED, systems=100 * SAMPLE_BYTES // CASE_BYTES + 1, samples=50, jobs=1)


def test_a_case_takes_less_than_its_bound() -> None:
    for name in STUDIES:
        cases = monte_carlo(name, systems=1, samples=200, jobs=1).cases
        packed = [pickle.dumps(case) for case in cases]
        tracemalloc.start()
        try:
            held = [pickle.loads(packed[0]) for _ in range(400)]
            size = tracemalloc.get_traced_memory()[0] / len(held)
        finally:
            tracemalloc.stop()
        assert held[0] == cases[0]
        assert len(packed[0]) < size < CASE_BYTES


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="the peak of a process is told by the kernel of Linux")
@pytest.mark.parametrize(("name", "systems", "samples"), [(CORRECTED_IDENTIFIED.name, 2, 30_000), (PUBLISHED.name, 100, 10_000)])
def test_a_record_takes_less_than_its_bound(name: str, systems: int, samples: int) -> None:
    done = subprocess.run([sys.executable, "-c", PEAK, name, str(systems), str(samples)], capture_output=True, text=True, check=True)
    assert int(done.stdout) < samples * SAMPLE_BYTES


def test_seeds_are_those_that_numpy_spawns() -> None:
    cases = studies._Cases(PUBLISHED, 7, 100, indices := [1, 4, 5, 9, 11])
    spawned = np.random.SeedSequence(7).spawn(12)
    assert len(cases) == 5
    for number, wanted in enumerate(indices):
        _, index, seed, samples = cases[number]
        assert (index, samples) == (wanted, 100)
        assert np.array_equal(seed.generate_state(4), spawned[index].generate_state(4))
        assert np.array_equal(seed.spawn(2)[1].generate_state(4), spawned[index].spawn(2)[1].generate_state(4))
