"""A Dask cluster whose processes can be killed one by one."""

from __future__ import annotations

import subprocess
import sys
from typing import Any

import pytest

from tests.end_to_end.commands import ROOT, environment


class Cluster:
    """A scheduler and workers of their own, which can be killed."""

    def __init__(self, workers: int = 2) -> None:
        distributed: Any = pytest.importorskip("distributed")
        with distributed.LocalCluster(n_workers=0, dashboard_address=None) as other:
            port = other.scheduler_address.rpartition(":")[2]  # free in a moment
        self.address = f"tcp://127.0.0.1:{port}"
        line = [sys.executable, "-m"]
        settings: Any = {"cwd": ROOT, "env": environment(), "stderr": subprocess.DEVNULL}
        scheduler = [*line, "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", port, "--no-dashboard"]
        worker = [*line, "distributed.cli.dask_worker", self.address, "--nthreads", "1", "--no-dashboard"]
        self.processes = [subprocess.Popen(each, **settings) for each in (scheduler, *[worker] * workers)]

    def __enter__(self) -> Cluster:
        return self

    def __exit__(self, *_: object) -> None:
        for process in reversed(self.processes):
            process.terminate()
        for process in self.processes:
            process.wait(30)
