"""What long records and long studies take: memory and time of one pass over a record, and how a study grows with cores and a cluster.

    record      a record of --size bytes is generated into a file, mapped, and identified in one pass, beside a pass that only reads it
    study       --systems of the study as published and as corrected, by one process, by two, and by a local Dask cluster of two workers,
                as Dask starts it and with the settings CALM

`python benchmarks/beyond_one_machine.py record --size 20e9 --folder DIR` needs so much room in DIR, and `study --systems 2000` the extra
`cluster`. Both print what they measured, a line each. Each measurement is a process of its own; the peak of memory is what the operating
system says of it (VmHWM), mapped pages that are held included. The file is generated in pieces of one seed, which repeat with a shift of
phase, so that making it takes less time than using it; its pages are given up before each pass as far as the system lets us, and the line
says whether it fits into memory, where a pass may have been served from there.
"""

from __future__ import annotations

import argparse
import mmap
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import psutil
from numpy.typing import NDArray

from faultspace import example_data as made
from faultspace.base.threads import one_thread
from faultspace.numeric.method.model.compression import compress_chunks
from faultspace.numeric.method.model.past_inputs import pi_moesp_from_compression
from faultspace.numeric.study.groups import Plan
from faultspace.numeric.study.studies import CORRECTED, PUBLISHED, monte_carlo

Array = NDArray[np.float64]
PIECE = 1 << 16  # samples read at once
PERIOD = 1 << 20  # samples that are simulated
ROWS = 10  # block rows
# By default a scheduler and each worker of Dask look at themselves every 20 ms, and at the stacks of their threads every 10 ms.
CALM = {"distributed.admin.tick.interval": "1s", "distributed.admin.tick.cycle": "5s", "distributed.worker.profile.enabled": False}
N_U, P = len(made.INPUTS), len(made.OUTPUTS)


class Mapped:
    """The pieces (y, u) of a file of rows [u, y], whose pages are given back when they have been used."""

    def __init__(self, path: Path) -> None:
        self._rows = np.load(path, mmap_mode="r")

    def __iter__(self) -> Iterator[tuple[Array, Array]]:
        held: Any = self._rows
        while not isinstance(held, mmap.mmap):
            held = held.base
        for first in range(0, len(self._rows), PIECE):
            rows = self._rows[first : first + PIECE]
            yield rows[:, N_U:], rows[:, :N_U]
            held.madvise(mmap.MADV_DONTNEED)


def generate(path: Path, size: float) -> int:
    """Write a record of about so many bytes; return its samples. The input goes on from piece to piece, and so does the state."""
    samples = int(size) // (8 * (N_U + P))
    record = made.faulty_record(min(PERIOD, samples))
    rows = np.hstack([record.u, record.y])
    out = np.lib.format.open_memmap(path, mode="w+", dtype=np.float64, shape=(samples, N_U + P))
    for number, first in enumerate(range(0, samples, len(rows))):
        part = np.roll(rows, 7919 * number, axis=0)[: samples - first]
        out[first : first + len(part)] = part
    out.flush()
    return samples


@one_thread()
def one_pass(path: Path) -> str:
    """Identify from one pass by correlations; say the order and the poles."""
    found = pi_moesp_from_compression(compress_chunks(Mapped(path), block_rows=ROWS, route="gram"), order=3)
    return "poles " + ", ".join(f"{pole:.4f}" for pole in np.sort_complex(np.linalg.eigvals(found.A)))


def reading(path: Path) -> str:
    """Add all numbers up, which is the least that reading them takes."""
    return f"sum {sum(float(y.sum()) + float(u.sum()) for y, u in Mapped(path)):.6g}"


def drop(path: Path) -> None:
    """Ask the system to forget the pages of a file."""
    if hasattr(os, "posix_fadvise"):
        with open(path, "rb") as stream:
            os.fsync(stream.fileno())
            os.posix_fadvise(stream.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)


def peak() -> int:
    """Return the most bytes that this process has held; `ru_maxrss` would count what its parent held, too."""
    line = next(line for line in Path("/proc/self/status").read_text("utf-8").splitlines() if line.startswith("VmHWM"))
    return int(line.split()[1]) << 10


def measured(name: str, path: Path) -> tuple[float, float, int, str]:
    """Return the seconds of the clock and of the processor, the peak in bytes, and what a pass said, in a process of its own."""
    drop(path)
    done = subprocess.run([sys.executable, __file__, "--pass", name, str(path)], capture_output=True, text=True, check=True)
    clock, cpu, most, said = done.stdout.strip().split("\t")
    return float(clock), float(cpu), int(most), said


def record(size: float, folder: Path) -> None:
    """Measure one pass over a record of this size."""
    path = folder / "faultspace-long-record.npy"
    try:
        samples = generate(path, size)
        fits = "fits" if path.stat().st_size < psutil.virtual_memory().total else "does not fit"
        print(f"{path.stat().st_size / 1e9:.2f} GB, {samples} samples, {N_U} inputs, {P} outputs; it {fits} into memory")
        clocks = {}
        for name in PASSES:
            clock, cpu, most, said = measured(name, path)
            clocks[name] = clock
            print(f"{name}: {clock:.1f} s, {cpu:.1f} CPU s, {path.stat().st_size / 1e9 / clock:.2f} GB/s, peak {most / 1e6:.0f} MB, {said}")
        print(f"identifying takes {clocks['identifying'] / clocks['reading']:.2f} times what reading alone takes")
    finally:
        path.unlink(missing_ok=True)


PASSES: dict[str, Callable[[Path], str]] = {"reading": reading, "identifying": one_pass}


def study(systems: int, samples: int, *, cluster: bool) -> None:
    """Measure the study with one process, with two, and on a local cluster."""
    for plan in (PUBLISHED, CORRECTED):
        clocks = {}
        for jobs in (1, 2):
            clocks[f"{jobs} processes"] = _timed(
                lambda plan=plan, jobs=jobs: monte_carlo(plan, systems=systems, samples=samples, jobs=jobs)
            )
        if cluster:
            clocks["cluster of 2"] = on_cluster(plan, systems, samples, {})
            clocks["calm cluster of 2"] = on_cluster(plan, systems, samples, CALM)
        for name, clock in clocks.items():
            hours = clock * 1e5 / systems / 3600
            print(
                f"{plan.name}: {systems} systems, {name}: {clock:.1f} s, {1000 * clock / systems:.2f} ms a system, 1e5 in {hours:.2f} hours"
            )
        print(f"{plan.name}: two processes are {clocks['1 processes'] / clocks['2 processes']:.2f} times as fast as one")
        if cluster:
            for name in ("cluster of 2", "calm cluster of 2"):
                print(f"{plan.name}: the {name} takes {clocks[name] / clocks['2 processes']:.2f} times what two processes take")


def on_cluster(plan: Plan, systems: int, samples: int, settings: dict[str, Any]) -> float:
    """Return the seconds that a local cluster of two workers takes, started with these settings of Dask."""
    dask: Any = import_module("dask")
    distributed: Any = import_module("distributed")
    with (
        dask.config.set(settings),
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as local,
    ):
        address = local.scheduler_address
        monte_carlo(plan, systems=8, samples=samples, cluster=address)  # the workers load us
        print(f"a cluster that has nothing to do takes {idle_share():.3f} of a core, with {len(settings) or 'no'} settings of ours")
        return _timed(lambda: monte_carlo(plan, systems=systems, samples=samples, cluster=address))


def idle_share(seconds: float = 10.0) -> float:
    """Return how much of a core this process and its children take while it sleeps."""

    def used() -> float:
        me = psutil.Process()
        return sum(sum(one.cpu_times()[:2]) for one in (me, *me.children(recursive=True)))

    time.sleep(2)  # what has just been done is cleared up
    before = used()
    time.sleep(seconds)
    return (used() - before) / seconds


def _timed(work: Callable[[], object]) -> float:
    begun = time.perf_counter()
    work()
    return time.perf_counter() - begun


def main() -> None:
    """Measure what the arguments choose."""
    if sys.argv[1:2] == ["--pass"]:
        begun, used = time.perf_counter(), time.process_time()
        said = PASSES[sys.argv[2]](Path(sys.argv[3]))
        print(f"{time.perf_counter() - begun}\t{time.process_time() - used}\t{peak()}\t{said}")
        return
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    what = parser.add_subparsers(dest="what", required=True)
    of_record = what.add_parser("record", help="one pass over a long record")
    of_record.add_argument("--size", type=float, default=1e9, help="bytes (1e9)")
    of_record.add_argument("--folder", type=Path, default=Path(), help="where the file is made for the while (here)")
    of_study = what.add_parser("study", help="the study on one process, two, and a cluster")
    of_study.add_argument("--systems", type=int, default=2000, help="systems of each plan (2000)")
    of_study.add_argument("--samples", type=int, default=1001, help="of each record (1001)")
    of_study.add_argument("--no-cluster", action="store_true", help="without the local cluster")
    given = parser.parse_args()
    if given.what == "record":
        record(given.size, given.folder)
    else:
        study(given.systems, given.samples, cluster=not given.no_cluster)


if __name__ == "__main__":
    main()
