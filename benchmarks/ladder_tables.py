"""These are the tables of the ladder benchmark, as sheets.

ratio_table       n, kind, ours (made, checked, memory), and how many times slower every other method is
seconds_table     CPU seconds of every method
exponent_table    growth exponents
aim_table         what was hoped for
"""

from __future__ import annotations

from benchmarks.ladder_cells import BRIEF, Cell
from benchmarks.ladder_methods import METHODS
from benchmarks.ladder_run import OURS, Run, SystemCells, aims, disagreements, exponent, ratio
from benchmarks.sheets import Sheet


def ratio_table(run: Run) -> Sheet:
    """Return the table of our times, and of how many times slower the others are."""
    peers = [name for name in run.methods if name != OURS]
    head = ["system", "p, m", "n", "made s", "checked s", "MB", *peers]
    rows = []
    for record in run.records:
        ours = record.cells[OURS]
        rows.append(
            [
                str(record.family),
                f"{record.p}, {record.m}",
                str(record.n),
                *([_seconds(ours.parts["produce"]), _seconds(ours.parts["check"])] if ours.parts else [_outcome(ours), ""]),
                f"{ours.peak_megabytes:.0f}",
                *(_ratio(record, name) for name in peers),
            ]
        )
    return Sheet("ours in CPU seconds and peak memory, and how many times slower every other method is than both steps of ours", head, rows)


def seconds_table(run: Run) -> Sheet:
    """Return the table of CPU seconds, '> x' where the method was stopped after x."""
    rows = [[str(record.family), str(record.n), *(_outcome(record.cells[name]) for name in run.methods)] for record in run.records]
    return Sheet("CPU seconds", ["system", "n", *run.methods], rows)


def exponent_table(run: Run) -> Sheet:
    """The table has the growth exponents by family."""
    families = list(dict.fromkeys(record.family for record in run.records))
    rows = []
    for family in families:
        slopes = [exponent(run, family, name) for name in run.methods]
        rows.append(
            [str(family), *("-" if slope is None else f"{slope.value:.1f} ({slope.low:.1f} to {slope.high:.1f})" for slope in slopes)]
        )
    return Sheet(
        "growth exponents: slope of log time against log n, n >= 10, three finished cells or more, with 95 % intervals",
        ["system", *run.methods],
        rows,
    )


def aim_table(run: Run) -> Sheet:
    """The table has the aims, and what the run says of each."""
    said = {True: "met", False: "missed", None: "open"}
    return Sheet("aims", ["aim", "measured", ""], [[aim.words, aim.measured, said[aim.met]] for aim in aims(run)])


def sheets(run: Run) -> list[Sheet]:
    """These are all tables that have rows."""
    return [sheet for sheet in (ratio_table(run), seconds_table(run), exponent_table(run), aim_table(run)) if sheet.rows]


def notes(run: Run) -> list[str]:
    """Methods, machine, limits, what was absent, whether all agree."""
    lines = [f"{method.name}: {method.words} ({run.machine[method.name]})" for method in METHODS if method.name in run.machine]
    lines += [f"{name}: absent, {why}" for name, why in run.absent.items()]
    facts = ", ".join(f"{name} {value}" for name, value in run.machine.items() if name not in run.methods)
    lines.append(f"machine: {facts}, one thread a method")
    limits = run.limits
    lines.append(f"limits: {limits.seconds:g} s and {limits.megabytes} MB a cell")
    lines.append(f"cells below {BRIEF:g} s are the least of {limits.repeats} runs")
    compared = sum(len(cell.ranks) for record in run.records for name, cell in record.cells.items() if name != OURS)
    wrong = len(disagreements(run))
    lines.append(f"{compared} ranks compared with ours: " + (f"{wrong} disagreements or failures" if wrong else "all agree"))
    return lines


def _seconds(value: float) -> str:
    if value == 0:
        return "< 0.01"  # Singular's clock has ticks of 10 ms
    return f"{value:.2g}" if value < 10 else f"{value:.0f}"


def _outcome(cell: Cell) -> str:
    match cell.outcome:
        case "memory":
            return "> memory"
        case "finished":
            return _seconds(cell.seconds)
        case "limit":
            return f"> {_seconds(cell.seconds)}"
        case "not run":
            return f"not run: {cell.why}"
    return cell.outcome


def _ratio(record: SystemCells, method: str) -> str:
    found = ratio(record, method)
    if found is None:
        return _outcome(record.cells[method]) if record.cells[method].outcome != "finished" else "-"
    number = f"{found.value:.2g}" if found.value < 100 else f"{found.value:.0f}"
    return f"> {number}" if found.at_least else number
