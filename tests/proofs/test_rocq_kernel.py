"""coqchk, Rocq's second checker, reads the compiled theory and MathComp below it again, apart from the compiler: no axiom anywhere."""

from __future__ import annotations

import shutil
import subprocess

import pytest

from faultspace.proofs import rocq_build

COQCHK = shutil.which("coqchk")


@pytest.mark.skipif(rocq_build.found() is None or COQCHK is None, reason=rocq_build.INSTALL)
@pytest.mark.timeout(1500)
def test_the_second_checker_finds_no_axiom() -> None:
    theory = rocq_build.compiled_theory()
    names = [f"faultspace.{one.stem}" for one in sorted(theory.glob("*.vo"))]
    assert "faultspace.Headlines" in names
    command = [str(COQCHK), "-silent", "-o", "-Q", str(theory), "faultspace", *names]
    told = subprocess.run(command, capture_output=True, text=True, check=False, timeout=1200)
    assert told.returncode == 0, told.stderr[-2000:]
    for heading in ("Axioms", "Constants/Inductives relying on type-in-type", "Constants/Inductives relying on unsafe (co)fixpoints"):
        assert f"* {heading}: <none>" in told.stdout, told.stdout[-2000:]
