"""This keeps what the comparison at the bound has measured, as a file, and shows it as tables.

    Result       the errors over the bound of one tool with one window on the records of one cell, and why it failed where it did
    CellResults  all results of one cell and length of the records
    Comparison   all of it, with seed, versions, and the tools that were absent
    updated      cells with new results of some tools
    to_json, from_json
    summary      median with its bootstrap interval, and the 90 % quantile
    sheets       a table for each length: a row a tool, a column a cell

The error of a model is |first 20 Markov parameters - true ones|_F over the root of the trace of their Cramer-Rao bound; that of a fault
space is told in `peers_at_the_bound_spaces.py`. A record on which a tool fails has an infinite error, in medians and quantiles too.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from benchmarks.sheets import Sheet

FORMAT = "faultspace-peers-at-the-bound/1"
DRAWS = 2000
INFINITE = float("inf")


@dataclass(frozen=True)
class Result:
    """`errors` has a number for each record, infinite where the tool has failed; `failures` counts the reasons. A tool without a window
    has `block_rows` None.
    """

    tool: str
    block_rows: int | None
    errors: tuple[float, ...]
    failures: Mapping[str, int]

    @property
    def failed(self) -> int:
        """Return the number of records on which the tool has failed."""
        return sum(self.failures.values())

    @property
    def median(self) -> float:
        """Return the median error."""
        return float(np.median(self.errors))


@dataclass(frozen=True)
class CellResults:
    """All tools are given the same records of a cell, `samples` long."""

    cell: str
    samples: int
    results: tuple[Result, ...]

    def best(self, tool: str) -> Result | None:
        """Return the result of the tool with the window that serves it best here, which nobody knows beforehand."""
        found = [result for result in self.results if result.tool == tool]
        return min(found, key=lambda result: (result.median, result.failed), default=None)


@dataclass(frozen=True)
class Comparison:
    """`versions` has what each tool was called in, `absent` names the tools that were not there. `cells` are of models; `spaces` are of
    fault spaces, over their bound, and `distances` are the same in percent of the largest distance.
    """

    seed: int
    systems: int
    versions: Mapping[str, str]
    absent: tuple[str, ...]
    cells: tuple[CellResults, ...] = ()
    spaces: tuple[CellResults, ...] = ()
    distances: tuple[CellResults, ...] = ()

    @property
    def tools(self) -> list[str]:
        """Return the names of the tools that identify models, in the order in which they stand in the cells."""
        return names(self.cells)


PARTS = ("cells", "spaces", "distances")


def names(cells: Sequence[CellResults]) -> list[str]:
    """Return the names of the tools that stand in these cells."""
    return list(dict.fromkeys(result.tool for cell in cells for result in cell.results))


def updated(known: tuple[CellResults, ...], new: CellResults) -> tuple[CellResults, ...]:
    """Return the cells with the new results; tools that are not among them keep theirs."""
    place = next((i for i, cell in enumerate(known) if (cell.cell, cell.samples) == (new.cell, new.samples)), None)
    if place is None:
        return (*known, new)
    again, order = names([new]), names([known[place], new])
    kept = [result for result in known[place].results if result.tool not in again]
    whole = replace(new, results=tuple(sorted([*kept, *new.results], key=lambda result: order.index(result.tool))))
    return (*known[:place], whole, *known[place + 1 :])


def to_json(comparison: Comparison) -> dict[str, Any]:
    """Return the document; an infinite error is null, others have five digits."""
    document = {"format": FORMAT, **asdict(comparison)}
    for result in (result for part in PARTS for cell in document[part] for result in cell["results"]):
        result["errors"] = [None if error == INFINITE else float(f"{error:.5g}") for error in result["errors"]]
    return document


def from_json(document: Mapping[str, Any]) -> Comparison:
    """Return the comparison that `to_json` wrote. Raises ValueError for another format."""
    if document.get("format") != FORMAT:
        raise ValueError(f"got the format {document.get('format')!r}, expected {FORMAT!r}")
    parts = {
        part: tuple(CellResults(cell["cell"], cell["samples"], tuple(map(_result, cell["results"]))) for cell in document[part])
        for part in PARTS
    }
    return Comparison(document["seed"], document["systems"], document["versions"], tuple(document["absent"]), **parts)


def _result(entry: Mapping[str, Any]) -> Result:
    errors = tuple(INFINITE if error is None else float(error) for error in entry["errors"])
    return Result(entry["tool"], entry["block_rows"], errors, entry["failures"])


def summary(errors: Sequence[float]) -> str:
    """Return the median with its 95 % bootstrap interval, and the 90 % quantile."""
    values = np.array(errors)
    medians = np.median(np.random.default_rng(0).choice(values, (DRAWS, len(values))), axis=1)
    # Without interpolation: errors may be infinite.
    low, high = np.quantile(medians, (0.025, 0.975), method="nearest")
    return f"{_short(float(np.median(values)))} [{_short(low)}, {_short(high)}] {_short(quantile(values, 0.9))}"


def quantile(errors: Sequence[float] | np.ndarray[Any, Any], share: float) -> float:
    """Return a quantile that is one of the errors."""
    return float(np.quantile(np.array(errors), share, method="nearest"))


def _short(value: float) -> str:
    if value == INFINITE:
        return "fails"
    return f"{value:.2f}" if value < 10 else f"{value:.1f}" if value < 100 else f"{value:.0f}"


def sheets(comparison: Comparison) -> list[Sheet]:
    """Return a table of models for each length of the records, and the tables of fault spaces."""
    shown = f"median [95 % interval] 90 % quantile (window), failures of {comparison.systems}"
    titles = {"cells": "model, error / bound", "spaces": "fault space, error / bound", "distances": "fault space, error in %"}
    tables = []
    for part, title in titles.items():
        for samples in dict.fromkeys(cell.samples for cell in getattr(comparison, part)):
            cells = [cell for cell in getattr(comparison, part) if cell.samples == samples]
            rows = [[tool, *(_entry(cell.best(tool)) for cell in cells)] for tool in names(cells)]
            tables.append(Sheet(f"{title}, N = {samples}: {shown}", ["tool", *(cell.cell for cell in cells)], rows))
    return tables


def _entry(result: Result | None) -> str:
    if result is None:
        return "not run"
    window = "" if result.block_rows is None else f" ({result.block_rows})"
    failures = f", fails {result.failed}" if result.failed else ""
    if result.failed == len(result.errors):
        return f"fails {result.failed}"
    return f"{summary(result.errors)}{window}{failures}"


def notes(comparison: Comparison) -> list[str]:
    """Return what stands below the tables: seed, versions, absent tools, why tools have failed."""
    lines = [f"seed {comparison.seed}; versions: {', '.join(dict.fromkeys(comparison.versions.values()))}"]
    lines += [f"{name}: absent" for name in comparison.absent]
    reasons: dict[tuple[str, str], int] = {}
    for cell in (*comparison.cells, *comparison.spaces):
        for result in cell.results:
            for why, count in result.failures.items():
                reasons[result.tool, why] = reasons.get((result.tool, why), 0) + count
    return [*lines, *(f"{tool} fails {count} times, all windows: {why}" for (tool, why), count in reasons.items())]
