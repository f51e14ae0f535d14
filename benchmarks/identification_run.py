"""This records what a run of the identification benchmark has measured, and what follows from it.

Run        settings with their cells, growth, rates, the study, machine, what is absent
aims       what was hoped for and what the run says about it
slopes     growth exponents by what grows
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from benchmarks.identification_bounds import Rates, bound, exponent, grown
from benchmarks.identification_cells import Cell
from benchmarks.identification_data import Setting
from benchmarks.identification_study import SYSTEMS, Comparison
from faultspace.base.processes import Limits

OURS = ("ours", "ours-moesp", "ours-gram", "ours-qr")
ROUTES = ("ours-gram", "ours-qr")
CHOLESKY = "ctrlsys-C"
FASTER, STUDY_FASTER, MEGABYTES, OVER_BOUND = 10.0, 20.0, 64.0, 4.0


@dataclass(frozen=True)
class Run:
    """This is a whole run: `cells[setting][method]`, `grown[what][method]` as pairs (setting, cell)."""

    machine: dict[str, str]
    limits: Limits
    versions: dict[str, str]
    absent: dict[str, str]
    cells: dict[Setting, dict[str, Cell]]
    growth: dict[str, dict[str, list[tuple[Setting, Cell]]]]
    rates: Rates
    study: Comparison | None


@dataclass(frozen=True)
class Aim:
    """`met` is None where the run does not tell."""

    words: str
    measured: str
    met: bool | None


def fastest_peer(cells: Mapping[str, Cell], models: set[str]) -> tuple[str, float] | None:
    """Return the quickest finished peer among `models`, with its seconds."""
    found = [(cell.seconds, name) for name, cell in cells.items() if name not in OURS and name in models and cell.outcome == "finished"]
    return (min(found)[1], min(found)[0]) if found else None


def aims(run: Run, models: set[str]) -> list[Aim]:
    """The aims in order: against the fastest peer, memory, the fast Cholesky, the flop bounds, the study. `models`: what gives a model."""
    found = []
    for setting, cells in run.cells.items():
        ours = cells["ours"]
        if setting.block_rows == 20:
            for words, name, against in (
                ("model", "ours", models),
                ("factor", "ours-gram", set(cells) - models),
            ):
                peer = fastest_peer(cells, against)
                if peer is not None and cells[name].outcome == "finished":
                    times = peer[1] / cells[name].seconds
                    text = f"{setting}: {words} {FASTER:g} times faster than the fastest peer"
                    measured = f"{times:.2g} times ({name} {cells[name].seconds:.3g} s, {peer[0]} {peer[1]:.3g} s)"
                    found.append(Aim(text, measured, times >= FASTER))
            used = [cell.megabytes for name in OURS if (cell := cells[name]).megabytes is not None]
            if used:
                most = max(used)
                found.append(Aim(f"{setting}: extra memory below {MEGABYTES:g} MB", f"{most:.1f} MB", most < MEGABYTES))
        if (setting.n_u, setting.p) == (1, 1) and cells[CHOLESKY].outcome == "finished":
            for name in ("ours-gram", "ours-moesp", "ours"):
                rival = "ctrlsys" if name == "ours" else CHOLESKY
                seconds, theirs = cells[name].seconds, cells[rival].seconds
                measured = f"{seconds / theirs:.2f} of its time ({seconds:.3g} s, {theirs:.3g} s)"
                found.append(Aim(f"{setting}: {name} no slower than {rival}", measured, seconds <= theirs))
        for route in ROUTES:
            if cells[route].outcome == "finished":
                least = bound(route, setting, run.rates)
                times = cells[route].seconds / least
                text = f"{setting}: {route} within {OVER_BOUND:g} times its flop bound"
                found.append(Aim(text, f"{times:.2g} times {least:.3g} s", times <= OVER_BOUND))
        if ours.outcome != "finished":
            found.append(Aim(f"{setting}: ours", ours.outcome, False))
    study = run.study
    if study is not None and study.author is not None:
        times = study.author / study.ours
        measured = f"{times:.2g} times ({study.ours:.2g} s, {study.author:.2g} s)"
        found.append(Aim(f"study of {SYSTEMS} systems {STUDY_FASTER:g} times faster than the author's", measured, times >= STUDY_FASTER))
    return found


def slopes(run: Run) -> dict[str, dict[str, float | None]]:
    """Return, for each quantity that grows, the exponent of each method's seconds."""
    return {
        what: {
            name: exponent([(grown(what, setting), cell.seconds) for setting, cell in pairs if cell.outcome == "finished"])
            for name, pairs in by.items()
        }
        for what, by in run.growth.items()
    }


def to_json(run: Run, models: set[str]) -> dict[str, Any]:
    """Return everything measured, and what was derived from it."""
    return {
        "machine": run.machine,
        "limits": {"seconds": run.limits.seconds, "megabytes": run.limits.memory >> 20},
        "versions": run.versions,
        "absent": run.absent,
        "rates": asdict(run.rates),
        "cells": [{"setting": asdict(s), "cells": {name: asdict(cell) for name, cell in by.items()}} for s, by in run.cells.items()],
        "growth": {
            what: {name: [{"setting": asdict(s), "cell": asdict(cell)} for s, cell in pairs] for name, pairs in by.items()}
            for what, by in run.growth.items()
        },
        "exponents": slopes(run),
        "study": None if run.study is None else asdict(run.study),
        "aims": [asdict(aim) for aim in aims(run, models)],
    }
