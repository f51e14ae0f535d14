"""This times the 100-system study of the paper, by the author's program under Octave and by ours: CPU seconds and median errors.

The author's text is taken from the clone that the user names, sections 1 to 4 of montecarlo.mlx (systems, data, estimates, errors; the
plots are left out), and run as it stands, with two functions that Octave lacks put beside it: `tzero` calls the control package's
`zero`, and `svds(M, k, "smallest")` is the end of a full `svd`. Ours are the same steps: the study with the published settings.

Comparison      CPU seconds of both, each in one process with one thread, and the median errors
compare         runs both, in turns; None of the author's where there is no clone or no Octave
"""

from __future__ import annotations

import json
import subprocess
import tempfile
import time
import zipfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from benchmarks.identification_cells import RESULT, environment, python_command
from benchmarks.identification_octave import octave_command, octave_missing

SYSTEMS = 100
SECTIONS = 4
REPEATS = 3
LIMIT = 300.0
SHIMS = {
    "tzero.m": "function z = tzero (system, varargin)\n  z = zero (system);\nend\n",
    "svds.m": """function [U, S, V] = svds (M, k, varargin)
  [U, S, V] = svd (M, "econ");
  U = U(:, end-k+1:end); S = S(end-k+1:end, end-k+1:end); V = V(:, end-k+1:end);
end
""",
}


@dataclass(frozen=True)
class Comparison:
    """CPU seconds without start and imports, the least of REPEATS; errors in percent; `why` the author's are absent."""

    ours: float
    error: float
    author: float | None = None
    author_error: float | None = None
    why: str = ""


def sections(notebook: Path) -> list[str]:
    """These are the code cells of a MATLAB live script."""
    with zipfile.ZipFile(notebook) as archive:
        root = ElementTree.fromstring(archive.read("matlab/document.xml"))
    space = "{http://schemas.openxmlformats.org/wordprocessingml/2006/main}"
    found = []
    for paragraph in root.iter(space + "p"):
        style = paragraph.find(f"{space}pPr/{space}pStyle")
        if style is not None and style.get(space + "val") == "code":
            found.append("".join(text.text or "" for text in paragraph.iter(space + "t")))
    return found


def author_study(fault_id: Path) -> str:
    """Return the program that times sections 1 to 4 and tells the median error."""
    code = [text.replace("close all;", "") for text in sections(fault_id / "montecarlo.mlx")[:SECTIONS]]
    folders = f'addpath ("{fault_id}"); addpath ("{fault_id / "Monte Carlo"}"); addpath (pwd);'
    head = f"pkg load control; warning off; {folders}\nbegun = cputime ();\n"
    tail = 'printf ("RESULT {\\"seconds\\": %.6g, \\"error\\": %.6g}\\n", cputime () - begun, 100 * median ([scenario.error]));\n'
    return head + "\n".join(code) + "\n" + tail


def study_here() -> dict[str, Any]:
    """Return what our side takes, in this process: the study once to warm up, then on as many systems as the author's."""
    import numpy as np

    from faultspace.numeric.study.studies import PUBLISHED, monte_carlo

    monte_carlo(PUBLISHED, systems=8, jobs=1)
    start = time.process_time()
    study = monte_carlo(PUBLISHED, systems=SYSTEMS, jobs=1)
    seconds = time.process_time() - start
    errors = [error for case in study.cases if (error := study.error(case)) is not None]
    return {"seconds": seconds, "error": 100 * float(np.median(errors))}


def compare(fault_id: Path | None) -> Comparison:
    """Both sides are measured, one after the other, so that both have seen the same machine."""
    why = "no clone of ggleizer/fault_id given (--fault-id)" if fault_id is None else octave_missing()
    ours: list[dict[str, Any]] = []
    theirs: list[dict[str, Any]] = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for _ in range(REPEATS):
            ours.append(_answer(python_command("study"), Path.cwd()))
            if fault_id is None or why is not None:
                continue
            for file, text in (SHIMS | {"study.m": author_study(fault_id.resolve())}).items():
                (folder / file).write_text(text, "utf-8")
            try:
                theirs.append(_answer(octave_command("source study.m"), folder))
            except (RuntimeError, subprocess.TimeoutExpired) as error:
                why = str(error)[:120]
    found = Comparison(min(run["seconds"] for run in ours), ours[0]["error"], why=why or "")
    return found if why is not None else replace(found, author=min(run["seconds"] for run in theirs), author_error=theirs[0]["error"])


def _answer(command: list[str], folder: Path) -> dict[str, Any]:
    done = subprocess.run(
        command, cwd=folder, env=environment(), capture_output=True, check=False, text=True, timeout=LIMIT, stdin=subprocess.DEVNULL
    )
    lines = [line for line in done.stdout.splitlines() if line.startswith(RESULT)]
    if not lines:
        said = [line for line in done.stderr.splitlines() if "error" in line.lower()] or ["no message"]
        raise RuntimeError(f"exit {done.returncode}: {said[0]}")
    answer: dict[str, Any] = json.loads(lines[-1][len(RESULT) :])
    return answer
