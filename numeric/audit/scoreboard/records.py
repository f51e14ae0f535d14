"""The records of scoreboard.json: what was audited, with what result.

Board      all implementations that `python -m faultspace.numeric.audit.scoreboard --out DIR` has audited
Audited    one implementation: name, version, seconds, a Tally for every slug of a function that it offers
Tally      one slug and function: how many checks were asked and failed, the worst record
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from ....base.errors import InvalidData
from ..vectors.trouble import VERSION

FORMAT = "faultspace-audit-scoreboard/1"


@dataclass(frozen=True)
class Tally:
    """This says of the checks of one slug and function how many were asked, how many failed, and the first that failed (else the worst).

    Infinite numbers are strings.
    """

    slug: str
    function: str
    kind: str
    claim: str | None
    effect: str
    asked: int
    failed: int
    vector: str
    verdict: str
    quantity: str | None
    got: float | str | None
    bound: float | str | None
    detail: str


@dataclass(frozen=True)
class Audited:
    """This is one implementation. `title`: what it is; `seconds`: what the audit took; `vectors`: the version of those that were asked."""

    name: str
    title: str
    version: str
    needs: str
    seconds: float
    tallies: tuple[Tally, ...]
    vectors: int = VERSION


@dataclass(frozen=True)
class Board:
    """The board has all implementations, our own first."""

    audited: tuple[Audited, ...]

    def to_json(self) -> dict[str, Any]:
        """The document is JSON-ready."""
        return {"format": FORMAT, "audited": [asdict(one) for one in self.audited]}

    @staticmethod
    def from_json(data: Any) -> Board:
        """Return the board that `to_json` wrote. Raises InvalidData for another format."""
        if not isinstance(data, dict) or data.get("format") != FORMAT:
            raise InvalidData(f"got no scoreboard, expected the scoreboard.json of the format {FORMAT!r} that boards.py writes")
        return Board(tuple(Audited(**{**one, "tallies": tuple(Tally(**row) for row in one["tallies"])}) for one in data["audited"]))
