"""These are the tables of the identification benchmark, as sheets.

time_table      seconds and extra memory of every method in every setting
error_table     eigenvalue and Markov-parameter errors of the models
growth_table    fitted exponents
aim_table       what was hoped for
"""

from __future__ import annotations

from benchmarks.identification_bounds import bound
from benchmarks.identification_cells import Cell
from benchmarks.identification_methods import BRIEF, METHODS, REPEATS
from benchmarks.identification_run import Run, aims, slopes
from benchmarks.sheets import Sheet

MODELS = {method.name for method in METHODS if method.gives == "model"}


def time_table(run: Run) -> Sheet:
    """One row a method, those not installed too; the bounds below."""
    rows = []
    for method in METHODS:
        cells = (
            ["left out" if run.absent[method.name] == "left out" else "not installed"] * len(run.cells)
            if method.name in run.absent
            else [_time(by[method.name]) for by in run.cells.values()]
        )
        rows.append([method.name, method.gives, method.instruments, *cells])
    for name, words in (("ours-gram", "displacement"), ("ours-qr", "QR"), ("plain Gram", "plain Gram")):
        rows.append([f"flop bound: {words}", "", "", *(f"{bound(name, setting, run.rates):.2g} s" for setting in run.cells)])
    return Sheet("CPU seconds / extra MB", ["method", "gives", "instruments", *map(str, run.cells)], rows)


def error_table(run: Run) -> Sheet:
    """There is one row for each method that gives a model."""
    rows = [
        [method.name, method.instruments, *(_errors(by[method.name]) for by in run.cells.values())]
        for method in METHODS
        if method.name in MODELS and method.name not in run.absent
    ]
    return Sheet("eigenvalue error / relative error of 20 Markov parameters", ["method", "instruments", *map(str, run.cells)], rows)


def growth_table(run: Run) -> Sheet:
    """Exponents of seconds, and the seconds they are fitted to."""
    rows = []
    for what, by in slopes(run).items():
        for name, slope in by.items():
            pairs = run.growth[what][name]
            times = ", ".join(f"{cell.seconds:.2g}" if cell.outcome == "finished" else cell.outcome for _, cell in pairs)
            memory = ", ".join("-" if cell.megabytes is None else f"{cell.megabytes:.1f}" for _, cell in pairs)
            rows.append([what, f"{pairs[0][0]} to {pairs[-1][0]}", name, "-" if slope is None else f"{slope:.2f}", times, memory])
    return Sheet("growth", ["grows", "settings", "method", "exponent", "seconds", "extra MB"], rows)


def aim_table(run: Run) -> Sheet:
    """The table has the aims, and what the run says of each."""
    said = {True: "met", False: "missed", None: "open"}
    return Sheet("aims", ["aim", "measured", ""], [[aim.words, aim.measured, said[aim.met]] for aim in aims(run, MODELS)])


def sheets(run: Run) -> list[Sheet]:
    """These are all tables that have rows."""
    return [sheet for sheet in (time_table(run), error_table(run), growth_table(run), aim_table(run)) if sheet.rows]


def notes(run: Run) -> list[str]:
    """Methods, machine, limits, what was absent, who writes to the caller's data, the study."""
    lines = [f"{method.name}: {method.words} ({run.versions[method.name]})" for method in METHODS if method.name in run.versions]
    lines += [f"{name}: absent, {why}" for name, why in run.absent.items()]
    lines.append("machine: " + ", ".join(f"{name} {value}" for name, value in run.machine.items()))
    lines.append(f"one thread a process: dgemm {run.rates.dgemm / 1e9:.0f}, dsyrk {run.rates.dsyrk / 1e9:.0f} Gflop a second")
    lines.append(f"limits: {run.limits.seconds:g} s and {run.limits.memory >> 20} MB of address space a cell")
    lines.append(f"calls below {BRIEF:g} s are the least of up to {REPEATS}")
    for setting, by in run.cells.items():
        lines += [f"{setting}: {name} {cell.outcome}: {cell.why}" for name, cell in by.items() if cell.why]
    writers = sorted({name for by in run.cells.values() for name, cell in by.items() if cell.changed})
    if writers:
        lines.append(f"the caller's y or u were overwritten by: {', '.join(writers)}")
    study = run.study
    if study is not None:
        theirs = study.why if study.author is None else f"the author's {study.author:.2g} s (median error {study.author_error:.2g} %)"
        lines.append(f"study, CPU seconds of one process: ours {study.ours:.2g} s (median error {study.error:.2g} %); {theirs}")
    return lines


def _time(cell: Cell) -> str:
    match cell.outcome:
        case "finished":
            seconds = f"{cell.seconds:.2g}" if cell.seconds < 10 else f"{cell.seconds:.0f}"
            return f"{seconds} s" + ("" if cell.megabytes is None else f" / {cell.megabytes:.0f}")
        case "limit":
            return f"> {cell.seconds:.0f} s" if cell.seconds else "limit"
        case "memory":
            return "> memory"
    return cell.outcome


def _errors(cell: Cell) -> str:
    if cell.eigenvalue_error is None or cell.markov_error is None:
        return "-"
    return f"{cell.eigenvalue_error:.2g} / {cell.markov_error:.2g}"
