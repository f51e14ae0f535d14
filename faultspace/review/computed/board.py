"""The audit's scoreboard as it comes with the package, counted for a page: of each implementation how much of what must hold it passes.

board    the object: implementations with their counts by function, and the causes that the first findings have
"""

from __future__ import annotations

from importlib import resources
from typing import Any

from ...numeric.audit.scoreboard.records import Audited, Board

SHOWN = 5  # findings of an implementation that are shown in words


def board() -> dict[str, Any]:
    """Return the counts. They are of the command that made the file, `python -m faultspace.numeric.audit.scoreboard`, not of this run."""
    text = resources.files("faultspace.numeric.audit").joinpath("board.json").read_text("utf-8")
    return {"implementations": [_counted(one) for one in Board.read(text).audited]}


def _counted(one: Audited) -> dict[str, Any]:
    passed, asked = one.total
    return {
        "name": one.name,
        "title": one.title,
        "version": one.version,
        "vectors": one.vectors,
        "passed": passed,
        "asked": asked,
        "functions": {name: {"passed": counts[0], "asked": counts[1]} for name, counts in one.counts.items()},
        "failed": len(one.failed),
        "findings": [
            {"slug": found.slug, "function": found.function, "effect": found.effect, "verdict": found.verdict}
            for found in one.failed[:SHOWN]
        ],
    }
