"""The audit's scoreboard as it comes with the package, counted for a page: of each implementation how much of what must hold it passes.

board    the object: implementations with their counts by function, and the causes that the first findings have
"""

from __future__ import annotations

import json
from collections import defaultdict
from importlib import resources
from typing import Any

from ...numeric.audit.records import Demand
from ...numeric.audit.scoreboard.records import Audited, Board

SHOWN = 5  # findings of an implementation that are shown in words


def board() -> dict[str, Any]:
    """Return the counts. They are of the command that made the file, `python -m faultspace.numeric.audit.scoreboard`, not of this run."""
    text = resources.files("faultspace.numeric.audit").joinpath("scoreboard.json").read_text("utf-8")
    return {"implementations": [_counted(one) for one in Board.from_json(json.loads(text)).audited]}


def _counted(one: Audited) -> dict[str, Any]:
    musts = [tally for tally in one.tallies if tally.kind != Demand.FREE]
    functions: dict[str, list[int]] = defaultdict(lambda: [0, 0])
    for tally in musts:
        functions[tally.function][0] += tally.asked - tally.failed
        functions[tally.function][1] += tally.asked
    failed = [tally for tally in musts if tally.failed]
    return {
        "name": one.name,
        "title": one.title,
        "version": one.version,
        "vectors": one.vectors,
        "passed": sum(tally.asked - tally.failed for tally in musts),
        "asked": sum(tally.asked for tally in musts),
        "functions": {name: {"passed": counts[0], "asked": counts[1]} for name, counts in functions.items()},
        "failed": len(failed),
        "findings": [
            {"slug": tally.slug, "function": tally.function, "effect": tally.effect, "verdict": tally.verdict} for tally in failed[:SHOWN]
        ],
    }
