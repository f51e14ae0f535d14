"""The ladder of window ranks, with certificate and check, against the exact rank of every window by the programs people have today.

    python benchmarks/ladder.py [--quick] [--limit SECONDS] [--markdown] [--json FILE]

One run measures every method on the same systems, one after the other, and fails (exit 1) when two methods disagree about a rank.
Tables on standard output, progress on standard error. What the columns mean: README.md beside this file.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # run from a clone, installed or not

from rich.console import Console

from benchmarks.ladder_cells import Budget, Cell, measure
from benchmarks.ladder_methods import METHODS, Method, System
from benchmarks.ladder_run import OURS, Run, SystemCells, disagreements, machine, to_json
from benchmarks.ladder_systems import FAMILIES, Family
from benchmarks.ladder_tables import notes, sheets
from benchmarks.sheets import markdown, show

SIZES = (4, 10, 20, 40, 80)
QUICK_SIZES = (4, 10, 20, 40)
QUICK_LIMIT, LIMIT = 10.0, 60.0
NAMES = [method.name for method in METHODS]


def main(arguments: list[str] | None = None) -> int:
    """Measure, print, and say whether all methods agree: 0 or 1."""
    options = _options(arguments)
    sizes = options.sizes or (QUICK_SIZES if options.quick else SIZES)
    limit = options.limit or (QUICK_LIMIT if options.quick else LIMIT)
    families = [family for family in FAMILIES if not options.families or str(family) in options.families]
    absent = {method.name: why for method in METHODS if (why := method.missing())}
    here = [method for method in METHODS if method.name not in absent and method.name in {OURS, *(options.methods or NAMES)}]
    if OURS in absent:
        print(f"ladder: {absent[OURS]}", file=sys.stderr)
        return 1
    limits = Budget(seconds=limit, megabytes=options.memory)
    records = []
    for family in families:
        beaten: dict[str, str] = {}
        for n in sizes:
            records.append(_record(family, n, here, limits, beaten))
    run = Run(machine(here), limits, absent, tuple(records))
    if options.markdown:
        print(markdown(sheets(run), notes(run)))
    else:
        show(sheets(run), notes(run), Console(markup=False, highlight=False, width=None if sys.stdout.isatty() else 160))
    if options.json:
        options.json.write_text(json.dumps(to_json(run), indent=1) + "\n", "utf-8")
    wrong = disagreements(run)
    for sentence in wrong:
        print(f"ladder: {sentence}", file=sys.stderr)
    return 1 if wrong else 0


def _record(family: Family, n: int, methods: list[Method], limits: Budget, beaten: dict[str, str]) -> SystemCells:
    """Every method on the system with n states, but those that a smaller system of the family has beaten: they are told in `beaten`."""
    system: System = family.specimen(n).to_json()
    cells: dict[str, Cell] = {}
    for method in methods:
        if method.name in beaten:
            cells[method.name] = Cell("not run", why=beaten[method.name])
            continue
        started = time.monotonic()
        cell = cells[method.name] = measure(method, system, limits)
        if cell.outcome != "finished":
            beaten[method.name] = f"{cell.outcome} at n = {n}"
        words = f"{cell.outcome}{': ' + cell.why if cell.why else ''}"
        print(f"{family}, n = {n}: {method.name} {words}, {cell.seconds:.3g} s of {time.monotonic() - started:.1f} s", file=sys.stderr)
    return SystemCells(family, n, *family.sizes(n), cells)


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="The ladder of window ranks against the exact rank of every window.")
    parser.add_argument("--quick", action="store_true", help=f"n up to {QUICK_SIZES[-1]}, {QUICK_LIMIT:g} s a cell")
    parser.add_argument("--limit", type=float, metavar="SECONDS", help=f"wall seconds a cell (default {LIMIT:g})")
    parser.add_argument("--memory", type=int, metavar="MB", default=Budget.megabytes, help="address space a cell (default %(default)s)")
    parser.add_argument("--sizes", type=int, nargs="+", metavar="N", help="numbers of states, ascending, at least 4")
    parser.add_argument("--families", nargs="+", choices=[str(f) for f in FAMILIES], metavar="FAMILY", help="such as 'planted tight'")
    parser.add_argument("--methods", nargs="+", choices=NAMES, metavar="METHOD", help="these beside ours, such as flint-once")
    parser.add_argument("--markdown", action="store_true", help="tables in Markdown")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write everything measured to this file")
    options = parser.parse_args(arguments)
    if options.sizes and (sorted(set(options.sizes)) != options.sizes or options.sizes[0] < 4):
        parser.error(f"--sizes: got {options.sizes}, expected ascending numbers of at least 4")
    if options.limit is not None and not options.limit > 0:
        parser.error(f"--limit: got {options.limit}, expected a positive number of seconds")
    return options


if __name__ == "__main__":
    sys.exit(main())
