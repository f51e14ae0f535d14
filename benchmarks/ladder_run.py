"""This records what a run of the ladder benchmark has measured, and what follows from it.

SystemCells, Run  the cells of one system; all of them, with machine, limits and what was absent
ratio             seconds of a method over ours: a number, or a lower bound where it was stopped
exponent          least-squares slope of log seconds against log n over finished cells with n >= 10, with its 95 % interval
aims              what was hoped for and what the run says about it
disagreements     ranks that differ between methods, and methods that failed
machine           cores, Python, versions
"""

from __future__ import annotations

import os
import platform
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from math import log, sqrt
from typing import Any

from scipy.stats import t

from benchmarks.ladder_cells import Budget, Cell
from benchmarks.ladder_methods import Method
from benchmarks.ladder_systems import Family

OURS = "ours"
DIRECT = "flint"
BOUNDS = {80: (5, 500), 160: (1, 200), 320: (8, 200)}  # seconds and megabytes by the number of states
FIRST_OF_SLOPE = 10  # below it starting costs are all there is


@dataclass(frozen=True)
class SystemCells:
    """This is one system and the cell of every method that is installed."""

    family: Family
    n: int
    p: int
    m: int
    cells: dict[str, Cell]


@dataclass(frozen=True)
class Run:
    """This is a whole run."""

    machine: dict[str, str]
    limits: Budget
    absent: dict[str, str]
    records: tuple[SystemCells, ...]

    @property
    def methods(self) -> list[str]:
        """These are the methods that were measured, ours first."""
        return list(self.records[0].cells) if self.records else []


@dataclass(frozen=True)
class Ratio:
    """This is how many times slower a method is than ours; `at_least` where the method was stopped."""

    value: float
    at_least: bool


@dataclass(frozen=True)
class Aim:
    """`met` is None where the run does not tell."""

    words: str
    measured: str
    met: bool | None


def ratio(record: SystemCells, method: str) -> Ratio | None:
    """None where the method did not run or was too quick for its clock, or ours did not finish."""
    ours, cell = record.cells[OURS], record.cells[method]
    if ours.outcome != "finished" or ours.seconds == 0 or cell.seconds == 0 or cell.outcome not in ("finished", "limit"):
        return None
    return Ratio(cell.seconds / ours.seconds, cell.outcome == "limit")


@dataclass(frozen=True)
class Slope:
    """This is a fitted slope, with the interval that Student's law gives for errors of log seconds that are alike and independent."""

    value: float
    low: float
    high: float


def exponent(run: Run, family: Family, method: str) -> Slope | None:
    """Return the slope of log seconds over log n; None with fewer than three finished cells from n = 10 on."""
    points = [
        (log(record.n), log(record.cells[method].seconds))
        for record in run.records
        if record.family == family and record.n >= FIRST_OF_SLOPE
        if record.cells[method].outcome == "finished" and record.cells[method].seconds > 0
    ]
    if len(points) < 3:
        return None
    x, y = (sum(values) / len(points) for values in zip(*points, strict=True))
    spread = sum((a - x) ** 2 for a, _ in points)
    slope = sum((a - x) * (b - y) for a, b in points) / spread
    rest = sum((b - y - slope * (a - x)) ** 2 for a, b in points)
    half = float(t.ppf(0.975, len(points) - 2)) * sqrt(rest / (len(points) - 2) / spread)
    return Slope(slope, slope - half, slope + half)


def disagreements(run: Run) -> list[str]:
    """One sentence for every window on which two methods differ and every method that failed; ranks of stopped methods count."""
    found = []
    for record in run.records:
        where = f"{record.family}, n = {record.n}"
        ours = record.cells[OURS].ranks
        for name, cell in record.cells.items():
            if cell.outcome == "failed":
                found.append(f"{where}: {name} failed: {cell.why}")
            for s, rank in cell.ranks.items():
                if s in ours and ours[s] != rank:
                    found.append(f"{where}: rank [O_{s} T_{s}] is {ours[s]} by {OURS}, {rank} by {name}")
    return found


def aims(run: Run) -> list[Aim]:
    """Judge every system: never slower than one elimination from n = 20 on, and so on (the words say it)."""
    found = []
    for record in run.records:
        where, ours = f"{record.family}, n = {record.n}", record.cells[OURS]
        if record.n == 40 and record.family.kind != "dense":
            found += _faster(record, DIRECT, 150)
        for method in ("flint-once", "pari", "m2-ker") if record.n >= 20 else ():
            found += _faster(record, method, 2 if record.n == 80 and method != "m2-ker" else 1)
        if record.n in BOUNDS:
            seconds, megabytes = BOUNDS[record.n]
            met = ours.outcome == "finished" and ours.seconds < seconds and ours.peak_megabytes < megabytes
            measured = f"{ours.seconds:.3g} s, {ours.peak_megabytes:.0f} MB" if ours.outcome == "finished" else ours.outcome
            found.append(Aim(f"{where}: made and checked in {seconds} s and {megabytes} MB", measured, met))
    return found


def _faster(record: SystemCells, method: str, times: int) -> list[Aim]:
    if method not in record.cells:
        return []
    r = ratio(record, method)
    words = f"{record.family}, n = {record.n}: {f'{times} times faster' if times > 1 else 'not slower'} than {method}"
    if r is None:
        return [Aim(words, "not measured", None)]
    met = True if r.value >= times else None if r.at_least else False
    return [Aim(words, f"{'at least ' if r.at_least else ''}{r.value:.3g} times", met)]


def machine(methods: Sequence[Method]) -> dict[str, str]:
    """Return what a reader must know to judge the times."""
    facts = {"cores": str(os.cpu_count()), "processor": platform.machine(), "system": platform.system()}
    facts["python"] = platform.python_version()
    if hasattr(os, "getloadavg"):
        facts["load"] = f"{os.getloadavg()[0]:.1f}"
    return facts | {method.name: method.version() for method in methods}


def to_json(run: Run) -> dict[str, Any]:
    """Return everything measured, and what was derived from it."""
    records = []
    for record in run.records:
        ratios = {name: asdict(r) for name in run.methods if name != OURS and (r := ratio(record, name)) is not None}
        records.append(asdict(record) | {"ratios": ratios})
    families = list(dict.fromkeys(record.family for record in run.records))
    return {
        "machine": run.machine,
        "limits": asdict(run.limits),
        "absent": run.absent,
        "records": records,
        "exponents": {
            str(family): {name: slope and asdict(slope) for name in run.methods for slope in [exponent(run, family, name)]}
            for family in families
        },
        "aims": [asdict(aim) for aim in aims(run)],
        "disagreements": disagreements(run),
    }
