"""Identification from long faulty records: ours beside the programs people have today, in one run on the same data.

    python benchmarks/identification.py [--quick] [--fault-id DIR] [--limit SECONDS] [--markdown] [--json FILE]

Every cell is a process of its own. Tables on standard output, progress on standard error; exit 1 where one of ours fails. What the columns
mean: README.md beside this file.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # run from a clone, installed or not

from rich.console import Console

from benchmarks.identification_bounds import best, growth, measure_rates
from benchmarks.identification_cells import CELL, Cell, measure
from benchmarks.identification_data import Setting, write
from benchmarks.identification_methods import METHODS, Method
from benchmarks.identification_run import OURS, Run, to_json
from benchmarks.identification_study import compare
from benchmarks.identification_tables import MODELS, notes, sheets
from benchmarks.sheets import markdown, show
from faultspace.base.processes import Limits

NOISE = 0.01  # of the input's effect: 40 dB down
GROWING = ("ours", "ours-gram", "ours-qr")


def settings(samples: int) -> tuple[Setting, ...]:
    """Return settings by cost, the last with sensor noise: without it one fault in three outputs makes the whole data Gram singular."""
    shapes = ((1, 1, 10, 0.0), (2, 3, 10, 0.0), (2, 3, 20, 0.0), (2, 3, 20, NOISE))
    return tuple(Setting(n_u, p, s, samples, noise) for n_u, p, s, noise in shapes)


def main(arguments: list[str] | None = None) -> int:
    """Measure, print, and say whether ours have worked: 0 or 1."""
    options = _options(arguments)
    limits = Limits(options.limit, options.memory << 20)
    absent = {method.name: why for method in METHODS if (why := method.missing(options.fault_id))}
    absent |= {name: "left out" for name in options.without}
    here = [method for method in METHODS if method.name not in absent]
    rates = measure_rates()
    cells: dict[Setting, dict[str, Cell]] = {}
    beaten: dict[str, str] = {}
    for setting in settings(100_000 if options.quick else 1_000_000):
        cells[setting] = _measured(setting, here, options.fault_id, limits, beaten)
        # A peer stopped on one record is not tried on larger ones; sensor noise, the last, may change the way it takes.
        rates = best(rates, measure_rates())
    study = compare(options.fault_id)
    growing = [method for method in here if method.name in GROWING]
    grown = {}
    for what, ladder in growth(options.quick).items():
        rows = [(setting, _measured(setting, growing, None, limits, {})) for setting in ladder]
        grown[what] = {method.name: [(setting, by[method.name]) for setting, by in rows] for method in growing}
    rates = best(rates, measure_rates())
    run = Run(_machine(), limits, {method.name: method.version() for method in here}, absent, cells, grown, rates, study)
    if options.json:
        options.json.write_text(json.dumps(to_json(run, MODELS), indent=1) + "\n", "utf-8")
    if options.markdown:
        print(markdown(sheets(run), notes(run)))
    else:
        show(sheets(run), notes(run), Console(markup=False, highlight=False, width=None if sys.stdout.isatty() else 200))
    failed = [(setting, name) for setting, by in cells.items() for name in OURS if by[name].outcome != "finished"]
    for setting, name in failed:
        print(f"identification: {setting}: {name} {cells[setting][name].outcome}: {cells[setting][name].why}", file=sys.stderr)
    return 1 if failed else 0


def _measured(
    setting: Setting, methods: Iterable[Method], fault_id: Path | None, limits: Limits, beaten: dict[str, str]
) -> dict[str, Cell]:
    """Every method on the record, but those that an easier one has beaten: they are told in `beaten`."""
    cells: dict[str, Cell] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write(setting, folder)
        for method in methods:
            if method.name in beaten:
                cells[method.name] = Cell("not run", why=beaten[method.name])
                continue
            cell = cells[method.name] = measure(method.command(setting, fault_id), setting, folder, limits)
            if cell.outcome in ("limit", "memory"):
                beaten[method.name] = f"{cell.outcome} at {setting}"
            words = f"{cell.outcome}{': ' + cell.why if cell.why else ''}, {cell.seconds:.3g} s"
            print(f"{setting}: {method.name} {words}", file=sys.stderr)
    return cells


def _machine() -> dict[str, str]:
    facts = {"cores": str(os.cpu_count()), "processor": platform.machine(), "system": platform.system()}
    facts["python"] = platform.python_version()
    if hasattr(os, "getloadavg"):
        facts["load"] = f"{os.getloadavg()[0]:.1f}"
    return facts


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Identification from long faulty records, ours beside the programs people have today.")
    parser.add_argument("--quick", action="store_true", help="N = 1e5 in place of 1e6")
    parser.add_argument("--fault-id", type=Path, metavar="DIR", help="a clone of github.com/ggleizer/fault_id, run under Octave")
    parser.add_argument("--limit", type=float, metavar="SECONDS", default=CELL.seconds, help="CPU time a process (default %(default)g)")
    parser.add_argument("--memory", type=int, metavar="MB", default=CELL.memory >> 20, help="address space a process (default %(default)s)")
    names = [method.name for method in METHODS]
    parser.add_argument("--without", nargs="+", default=[], choices=names, metavar="METHOD", help="peers to leave out")
    parser.add_argument("--markdown", action="store_true", help="tables in Markdown")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write everything measured to this file")
    options = parser.parse_args(arguments)
    if left_out := sorted(set(options.without) & set(OURS)):
        parser.error(f"--without: got {', '.join(left_out)}, expected peers: ours are what they are compared with")
    if not options.limit > 0:
        parser.error(f"--limit: got {options.limit}, expected a positive number of seconds")
    if options.fault_id is not None and not (options.fault_id / "pi_moesp.m").is_file():
        parser.error(f"--fault-id: {options.fault_id} has no pi_moesp.m: expected a clone of github.com/ggleizer/fault_id")
    return options


if __name__ == "__main__":
    sys.exit(main())
