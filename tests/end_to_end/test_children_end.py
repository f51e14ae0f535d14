"""What we start ends when we do, even if we are killed, and within the time that the kernel gives it."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

from faultspace.base.processes import allow_cpu, clean_environment, session
from faultspace.proofs.rocq.build import found
from tests.end_to_end.commands import ROOT, environment

SESSION = (
    "import sys; from faultspace.base.processes import session; session([sys.executable, '-c', 'import time; time.sleep(300)']).wait()"
)
COQC = "import sys; from pathlib import Path; from faultspace.proofs.rocq.build import _coqc; _coqc(Path(sys.argv[1]), (), 300.0)"
WORKERS = (
    "from faultspace.base.workers import unordered; import joblib, time\n"
    "with unordered(2) as parallel: list(parallel(joblib.delayed(time.sleep)(300) for _ in range(2)))"
)


def descendants_of(code: str, *arguments: str, name: str) -> tuple[subprocess.Popen[bytes], list[psutil.Process]]:
    """Start this code, and wait for a descendant whose command line has that name."""
    process = subprocess.Popen([sys.executable, "-c", code, *arguments], cwd=ROOT, env=environment())
    deadline = time.monotonic() + 120
    while time.monotonic() < deadline and process.poll() is None:
        children = psutil.Process(process.pid).children(recursive=True)
        try:
            if any(name in " ".join(child.cmdline()) for child in children):
                return process, children
        except psutil.Error:
            pass
        time.sleep(0.02)
    process.kill()
    pytest.fail(f"{name} never came")


@pytest.mark.skipif(sys.platform != "linux", reason="the kernel does it, where it is that of Linux")
@pytest.mark.parametrize("program", ["session", "coqc", "workers"])
def test_what_we_started_is_gone_when_we_are_killed(program: str, tmp_path: Path) -> None:
    if program == "coqc":
        if found() is None:
            pytest.skip("no coqc")
        endless = tmp_path / "endless.v"
        endless.write_text("Ltac loop := idtac; loop.\nGoal True.\nloop.\n")
        process, children = descendants_of(COQC, str(endless), name="endless.v")
    elif program == "session":
        process, children = descendants_of(SESSION, name="sleep(300)")
    else:
        process, children = descendants_of(WORKERS, name="loky")
    process.kill()
    process.wait()
    assert children and not psutil.wait_procs(children, timeout=20)[1]


@pytest.mark.skipif(sys.platform != "linux", reason="other kernels do not count for others")
def test_the_kernel_ends_what_computes_for_too_long(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.cpu_count", lambda: 1)
    with session([sys.executable, "-c", "while True: pass"]) as process:
        allow_cpu(process.pid, 0.5)
        allow_cpu(process.pid, 0.1)  # counted anew
        assert process.wait(60) == -signal.SIGXCPU
    allow_cpu(process.pid, 1.0)  # where it is gone nothing happens


def test_a_clean_environment_has_what_any_program_needs(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("SECRET_KEY", "PYTHONPATH", "LC_NUMERIC"):
        monkeypatch.setenv(name, "1")
    assert {"SECRET_KEY", "PYTHONPATH"}.isdisjoint(clean_environment()) and {"PATH", "LC_NUMERIC"} <= clean_environment().keys()
    assert clean_environment(("SECRET_KEY", "NOT_THERE")).keys() - clean_environment().keys() == {"SECRET_KEY"}
    assert "PYTHONPATH" in clean_environment(("*",))
