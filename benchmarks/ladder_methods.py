"""These are the methods of the ladder benchmark. Each is a program of its own that reads one system and writes lines:

    ready C          what is not timed is done (start, reading, building the windows); C CPU seconds were spent on it
    rank S R         rank [O_S T_S] = R, as soon as it is known
    indices MU ...   instead of ranks: the left minimal indices, from which they follow
    part NAME X      X CPU seconds of the time went into NAME
    seconds X        CPU seconds from `ready` on

    Method        name, what it does, whether it can run here, its version, the command that runs it on a system
    METHODS       ours first

`python -m benchmarks.ladder_methods NAME FILE` runs a Python method in this process; Macaulay2 and Singular get a script.
"""

from __future__ import annotations

import gc
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from benchmarks.ladder_scripts import macaulay2_kernel, macaulay2_ranks, singular_ranks
from benchmarks.ladder_systems import Rows

System = dict[str, Rows]
Windows = list[Rows]


@dataclass(frozen=True)
class Method:
    """A way to the ranks of all windows. `needs` is a distribution (Python methods) or a program, whose text `script` writes."""

    name: str
    words: str
    needs: str
    script: Callable[[System], str] | None = None
    arguments: tuple[str, ...] = ()

    def missing(self) -> str | None:
        """It says why the method cannot run here; None means that it can."""
        if self.script is not None:
            return None if shutil.which(self.needs) else f"the program {self.needs} is not installed"
        try:
            version(self.needs)
        except PackageNotFoundError:
            return f"the Python package {self.needs} is not installed"
        return None

    def version(self) -> str:
        """It names the package or program and its version."""
        if self.script is None:
            return f"{self.needs} {version(self.needs)}"
        run = subprocess.run([self.needs, "--version"], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        found = re.search(r"\d+(\.\d+)+", run.stdout)
        return f"{self.needs} {found.group() if found else '?'}"

    def command(self, system: System, folder: Path) -> list[str]:
        """Return the command line, after what it reads has been written into the folder."""
        if self.script is None:
            file = folder / "system.json"
            file.write_text(json.dumps(system), "utf-8")
            return [sys.executable, "-m", "benchmarks.ladder_methods", self.name, str(file)]
        file = folder / "script"
        file.write_text(self.script(system), "utf-8")
        return [self.needs, *self.arguments, str(file)]


KERNEL_WORDS = "mingens ker of the homogenised pencil over QQ: the left minimal indices, no window, no certificate"
METHODS = (
    Method("ours", "kernel rows, certificate as JSON, and the checker's verdict on it", "python-flint"),
    Method("flint", "fmpz_mat.rank of every window", "python-flint"),
    Method("flint-once", "fmpz_mat.rref of the transposed largest window, once: its pivots are the ranks of all", "python-flint"),
    Method("sympy", "DomainMatrix.rank of every window", "sympy"),
    Method("pari", "matrank of every window, through cypari", "cypari"),
    Method("m2", "Macaulay2: rank of every window over QQ", "M2", macaulay2_ranks, ("--script",)),
    Method("m2-ker", f"Macaulay2: {KERNEL_WORDS}", "M2", macaulay2_kernel, ("--script",)),
    Method("singular", "Singular: rank of every window over QQ", "Singular", singular_ranks, ("-q",)),
)


def run_ours(system: System) -> None:
    """Produce the certificate as a file, then load and verify the file: what two people who do not trust each other would do."""
    from faultspace.exact.system.systems import read_system
    from faultspace.proofs.trust import checker
    from faultspace.proofs.trust.structure_certificates import window_ranks_of

    handle, name = tempfile.mkstemp(suffix=".json")
    try:
        with open(handle, "w", encoding="utf-8") as file:
            start = _ready()
            file.write(json.dumps(window_ranks_of(read_system(system).residual)))
        produced = time.process_time()
        certificate = checker.load(name)
        checker.verify(certificate, [system])
        checked = time.process_time()
    finally:
        os.unlink(name)
    # the statement is read back from the file: these are the ranks that the checker has accepted
    _tell("indices", *certificate["statement"]["left_minimal_indices"])
    _tell("part", "produce", produced - start)
    _tell("part", "check", checked - produced)
    _tell("seconds", checked - start)


def run_flint(system: System) -> None:
    """The rank is that of fmpz_mat.rank."""
    from flint import fmpz_mat

    _rank_each([fmpz_mat(window) for window in windows(system)], lambda window: int(window.rank()))


def run_flint_once(system: System) -> None:
    """The windows are the leading blocks of the largest, zeros beside them: one echelon form of its transpose has them all."""
    from flint import fmpz_mat

    largest = fmpz_mat(largest_window(system)).transpose()
    p, n = len(system["C"]), len(system["A"])
    start = _ready()
    echelon, _, size = largest.rref()
    table = echelon.tolist()
    pivots, column = [], 0
    for i in range(size):
        while table[i][column] == 0:
            column += 1
        pivots.append(column)
    for s in range(1, n + 2):
        _tell("rank", s, sum(1 for pivot in pivots if pivot < p * s))
    _tell("seconds", time.process_time() - start)


def run_sympy(system: System) -> None:
    """DomainMatrix over ZZ, with the ground types that sympy picks by itself."""
    from sympy import ZZ
    from sympy.polys.matrices import DomainMatrix

    built = [DomainMatrix([[ZZ(x) for x in row] for row in window], (len(window), len(window[0])), ZZ) for window in windows(system)]
    _rank_each(built, lambda window: int(window.rank()))


def run_pari(system: System) -> None:
    """The rank is that of matrank, on a stack of 2 GB."""
    from cypari import pari

    pari.allocatemem(2**31, silent=True)
    built = [pari.matrix(len(window), len(window[0]), [x for row in window for x in row]) for window in windows(system)]
    _rank_each(built, lambda window: int(window.matrank()))


RUNNERS: dict[str, Callable[[System], None]] = {
    "ours": run_ours,
    "flint": run_flint,
    "flint-once": run_flint_once,
    "sympy": run_sympy,
    "pari": run_pari,
}


def largest_window(system: System) -> Rows:
    """This is [O_s T_s] for s = n + 1, in integers."""
    from faultspace.exact.system.systems import read_system
    from faultspace.exact.system.windows import window_matrix

    built = window_matrix(read_system(system).residual, len(system["A"]) + 1)
    return [[int(x) for x in row] for row in built.flint.numer_denom()[0].tolist()]


def windows(system: System) -> Windows:
    """These are [O_s T_s] for s = 1..n + 1."""
    largest = largest_window(system)
    n, p, m = len(system["A"]), len(system["C"]), len(system["F"][0])
    return [[row[: n + m * s] for row in largest[: p * s]] for s in range(1, n + 2)]


def _rank_each(built: list[Any], rank: Callable[[Any], int]) -> None:
    start = _ready()
    for s, window in enumerate(built, 1):
        _tell("rank", s, rank(window))
    _tell("seconds", time.process_time() - start)


def _ready() -> float:
    gc.collect()  # what starting has left is not collected in the time of any method
    start = time.process_time()
    _tell("ready", start)
    return start


def _tell(*words: object) -> None:
    print(*words, flush=True)


if __name__ == "__main__":
    RUNNERS[sys.argv[1]](json.loads(Path(sys.argv[2]).read_text("utf-8")))
