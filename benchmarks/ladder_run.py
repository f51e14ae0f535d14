"""This records what a run of the ladder benchmark has measured, and what follows from it.

SystemCells, Run  the cells of one system; all of them, with machine, limits and what was absent
ratio             seconds of a method over ours: a number, or a lower bound where it was stopped
exponent          least-squares slope of log seconds against log n over finished cells with n >= 10
aims              what was hoped for and what the run says about it
disagreements     ranks that differ between methods, and methods that failed
machine           cores, Python, versions
"""

from __future__ import annotations

import os
import platform
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from math import log
from typing import Any

from benchmarks.ladder_cells import Budget, Cell
from benchmarks.ladder_methods import Method
from benchmarks.ladder_systems import Family

OURS = "ours"
DIRECT = "flint"
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


def exponent(run: Run, family: Family, method: str) -> float | None:
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
    slope: float = sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points)
    return slope


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
    """Judge both families: n = 40, if planted, is 100 times faster than the direct rank of every window; n = 80 takes 5 s and 500 MB."""
    found = []
    for record in run.records:
        if record.n == 40 and record.family.kind != "dense" and DIRECT in record.cells:
            r = ratio(record, DIRECT)
            words = f"{record.family}, n = 40: 100 times faster than {DIRECT}"
            if r is None:
                found.append(Aim(words, "not measured", None))
            else:
                met = True if r.value >= 100 else None if r.at_least else False
                found.append(Aim(words, f"{'at least ' if r.at_least else ''}{r.value:.3g} times", met))
        if record.n == 80:
            ours = record.cells[OURS]
            met = ours.outcome == "finished" and ours.seconds < 5 and ours.peak_megabytes < 500
            measured = f"{ours.seconds:.3g} s, {ours.peak_megabytes:.0f} MB" if ours.outcome == "finished" else ours.outcome
            found.append(Aim(f"{record.family}, n = 80: made and checked in 5 s and 500 MB", measured, met))
    return found


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
        "exponents": {str(family): {name: exponent(run, family, name) for name in run.methods} for family in families},
        "aims": [asdict(aim) for aim in aims(run)],
        "disagreements": disagreements(run),
    }
