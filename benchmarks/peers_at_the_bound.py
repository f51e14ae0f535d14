"""This sets the tools that people have today beside ours and the paper's way, on the same records: their errors over the Cramer-Rao bound.

    python benchmarks/peers_at_the_bound.py [--systems 30] [--seed 1] [--samples 1000] [--cells paper ..] [--tools NAME ..]
                                            [--parts models spaces] [--block-rows 10 20] [--jobs 1] [--limit SECONDS] [--json FILE]
                                            [--markdown]
    python benchmarks/peers_at_the_bound.py --pages

The records are those of `at_the_bound_cells.py`; every tool is told the true order. A tool with a window of block rows is run with each of
`--block-rows`, and the table shows the one that serves it best in that cell. Each tool is a process of its own, with a limit on the time of
an answer and on memory; a record without a model counts as an infinite error. FAULT_ID names a clone of github.com/ggleizer/fault_id.
Fault spaces, which packaged tools do not give, are those of the study's systems (`peers_at_the_bound_spaces.py`). What is not
asked for keeps its entry in FILE, where that has the same seed and number of systems.

`--pages` runs nothing: it makes the table of README.md and the picture docs/peers.svg from peers_at_the_bound.json again.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # run from a clone, installed or not

from rich.console import Console

from benchmarks.at_the_bound_cells import CELLS, Cell, Trial
from benchmarks.identification_cells import environment
from benchmarks.peers_at_the_bound_picture import picture
from benchmarks.peers_at_the_bound_results import INFINITE, CellResults, Comparison, Result, from_json, notes, sheets, to_json, updated
from benchmarks.peers_at_the_bound_spaces import WAYS, author, author_command
from benchmarks.peers_at_the_bound_spaces import measured as measured_spaces
from benchmarks.peers_at_the_bound_tools import AUTHOR, TOOLS, Tool
from benchmarks.sheets import markdown, show
from faultspace.base.errors import InvalidData
from faultspace.base.processes import Limits
from faultspace.numeric.audit.records import Broken, Refused
from faultspace.numeric.audit.subjects.subprocess_adapter import Exec
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.model.uncertainty import Uncertainty
from faultspace.numeric.study.information_bound import cramer_rao, relative_error

HERE = Path(__file__).resolve().parent
STORED, PAGE, PICTURE = HERE / "peers_at_the_bound.json", HERE / "README.md", HERE.parent / "docs" / "peers.svg"
BEGIN, END = "<!-- peers_at_the_bound.py --pages makes what stands here -->", "<!-- as far as here -->"
KINDS = sorted({cell.kind for cell in CELLS})
NAMES = list(dict.fromkeys([*(tool.name for tool in TOOLS), *WAYS]))
UNUSED = 10  # the window that the protocol's question names where the tool has none


def measured(tool: Tool, program: Exec, windows: Sequence[int], trials: Sequence[tuple[Trial, Uncertainty]]) -> list[Result]:
    """Run the tool on every record with each of its windows."""
    results = []
    for block_rows in windows if tool.windowed else (None,):
        errors, failures = [], Counter[str]()
        for trial, bound in trials:
            try:
                found = program.identify(trial.y, trial.u, trial.model.n, block_rows or UNUSED)  # type: ignore[attr-defined]
                error = relative_error(model_of(found, trial.model.p, trial.model.n_u), trial.model, bound)
                if not np.isfinite(error):
                    raise InvalidData("the answer of the model grows beyond all numbers")
                errors.append(error)
            except (Broken, Refused, InvalidData) as why:
                errors.append(INFINITE)
                failures[reason(str(why))] += 1
        results.append(Result(tool.name, block_rows, tuple(errors), dict(failures)))
    return results


def model_of(matrices: Sequence[object], p: int, n_u: int) -> StateSpaceModel:
    """Return the model of an answer, in which a matrix with one row or column may be a plain list. Raises InvalidData where it is none."""
    try:
        A, B, C, D = (np.asarray(matrix, dtype=float) for matrix in matrices)
        n = int(np.sqrt(A.size))
        shaped = A.reshape(n, n), B.reshape(n, n_u), C.reshape(p, n), D.reshape(p, n_u)
    except (TypeError, ValueError) as error:
        raise InvalidData(f"the answer is no model: {error}") from None
    return StateSpaceModel(*shaped)


def reason(words: str) -> str:
    """Return the words without the figures and the place, so that equal reasons count as one."""
    known = re.search(r"parameter number \d+ is invalid|no answer within \d+ s|held .* of memory", words)
    return known.group(0) if known else " ".join(words.split())[:100]


def compared(programs: Mapping[Tool, Exec], cell: Cell, samples: int, options: argparse.Namespace) -> CellResults:
    """Draw the records of a cell and run every tool on them, `options.jobs` processes at a time."""
    trials = []
    for number in range(options.systems):
        trial = cell.trial(options.seed, number, samples)
        trials.append((trial, cramer_rao(trial.model, trial.spectra, samples)))
    with ThreadPoolExecutor(options.jobs) as pool:
        results = pool.map(lambda tool: measured(tool, programs[tool], options.block_rows, trials), programs)
    return CellResults(cell.name, samples, tuple(result for each in results for result in each))


def run(options: argparse.Namespace) -> Iterator[Comparison]:
    """Run what is asked for, and yield what is known after every cell; the rest is that of the file, where it has the same records."""
    chosen = [tool for tool in TOOLS if tool.name in options.tools]
    versions = {tool.name: version for tool in chosen if (version := tool.version())}
    absent = tuple(tool.name for tool in chosen if tool.name not in versions)
    limits = Limits(options.limit, options.memory << 20)
    known = Comparison(options.seed, options.systems, {}, ())
    if options.json and options.json.exists():
        stored = from_json(json.loads(options.json.read_text("utf-8")))
        known = stored if (stored.seed, stored.systems) == (options.seed, options.systems) else known
    gone = tuple(name for name in dict.fromkeys([*known.absent, *absent]) if name not in {**known.versions, **versions})
    known = replace(known, versions={**known.versions, **versions}, absent=gone)
    cells = [(samples, cell) for samples in options.samples for cell in CELLS if cell.kind in options.cells]
    with ExitStack() as stack:
        if "models" in options.parts:
            programs = {tool: stack.enter_context(Exec(tool.command(), limits)) for tool in chosen if tool.name in versions}
            for samples, cell in cells:
                yield (known := replace(known, cells=updated(known.cells, compared(programs, cell, samples, options))))
        if "spaces" in options.parts:
            ways = {name: way for name, way in WAYS.items() if name in options.tools}
            if AUTHOR in versions:
                ways[AUTHOR] = author(stack.enter_context(Exec(author_command(), limits)))
            for samples, cell in ((samples, cell) for samples, cell in cells if cell.kind == "paper"):
                over, percent = measured_spaces(ways, cell, samples, options.seed, options.systems, options.block_rows)
                known = replace(known, spaces=updated(known.spaces, over), distances=updated(known.distances, percent))
                yield known


def pages(comparison: Comparison, page: str) -> str:
    """Return the page with the tables of the comparison between its two marks."""
    before, rest = page.split(BEGIN)
    _, after = rest.split(END, 1)
    return f"{before}{BEGIN}\n\n{markdown(sheets(comparison), notes(comparison))}\n\n{END}{after}"


def main() -> None:
    """Run what the arguments ask for, or make the pages again."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--systems", type=int, default=30, help="records a cell")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--samples", type=int, nargs="+", default=[1000])
    parser.add_argument("--cells", nargs="+", default=KINDS, choices=KINDS)
    parser.add_argument("--parts", nargs="+", default=["models", "spaces"], choices=["models", "spaces"], help="what is measured")
    parser.add_argument("--tools", nargs="+", default=NAMES, choices=NAMES, metavar="NAME")
    parser.add_argument("--block-rows", type=int, nargs="+", default=[10, 20], metavar="S", help="windows that each tool is given")
    parser.add_argument("--jobs", type=int, default=1, help="processes at a time")
    parser.add_argument("--limit", type=float, default=120.0, metavar="SECONDS", help="time of an answer (default %(default)g)")
    parser.add_argument("--memory", type=int, default=4096, metavar="MB", help="memory of a tool (default %(default)s)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write what was measured to this file, after every cell")
    parser.add_argument("--markdown", action="store_true", help="tables in Markdown")
    parser.add_argument("--pages", action="store_true", help="make README's table and the picture from the stored results, and end")
    options = parser.parse_args()
    if options.pages:
        stored = from_json(json.loads(STORED.read_text("utf-8")))
        PAGE.write_text(pages(stored, PAGE.read_text("utf-8")), "utf-8")
        PICTURE.write_text(picture(stored), "utf-8")
        return
    os.environ |= environment()
    for comparison in run(options):
        print(f"done: {len(comparison.cells)} cells of models, {len(comparison.spaces)} of fault spaces", file=sys.stderr)
        if options.json:
            options.json.write_text(json.dumps(to_json(comparison)) + "\n", "utf-8")
    if options.markdown:
        print(markdown(sheets(comparison), notes(comparison)))
    else:
        show(sheets(comparison), notes(comparison), Console(markup=False, highlight=False, width=None if sys.stdout.isatty() else 220))


if __name__ == "__main__":
    main()
