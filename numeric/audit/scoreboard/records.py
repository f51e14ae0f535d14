"""The records of board.json: what was audited, with what result.

Board      all implementations that `python -m faultspace.numeric.audit.scoreboard --out DIR` has audited
Audited    one implementation: name, version, seconds, how much of what must hold passes, a Tally for every slug and function that fails
Tally      one slug and function: how many checks were asked and failed, the worst record
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass, fields
from typing import Any

from ....base.errors import InvalidData
from ..records import Demand
from ..vectors.trouble import VERSION

FORMAT = "faultspace-audit-board/1"


@dataclass(frozen=True)
class Tally:
    """This says of the checks of one slug and function how many were asked, how many failed, and the first that failed (else the worst).

    Infinite numbers are strings.
    """

    slug: str
    function: str
    kind: str
    effect: str
    asked: int
    failed: int
    vector: str
    verdict: str
    quantity: str | None
    got: float | str | None
    bound: float | str | None
    detail: str

    @property
    def name(self) -> str:
        """The full name of the check that is shown."""
        return f"{self.slug}[{self.vector}]-{self.function}"


@dataclass(frozen=True)
class Audited:
    """This is one implementation. `title`: what it is; `seconds`: what the audit took; `vectors`: the version of those that were asked;
    `counts`: function -> (passed, asked) of what must hold; `failed`: the tallies with a failure."""

    name: str
    title: str
    version: str
    needs: str
    seconds: float
    vectors: int
    counts: dict[str, tuple[int, int]]
    failed: tuple[Tally, ...]

    @staticmethod
    def of(name: str, title: str, version: str, needs: str, seconds: float, tallies: Iterable[Tally]) -> Audited:
        """Return the entry of an implementation that was asked the vectors of this version."""
        counts = dict[str, tuple[int, int]]()
        musts = [one for one in tallies if one.kind != Demand.FREE]
        for one in musts:
            passed, asked = counts.get(one.function, (0, 0))
            counts[one.function] = passed + one.asked - one.failed, asked + one.asked
        return Audited(name, title, version, needs, seconds, VERSION, counts, tuple(one for one in musts if one.failed))

    @property
    def total(self) -> tuple[int, int]:
        """How many checks of all functions passed, and how many were asked."""
        return sum(passed for passed, _ in self.counts.values()), sum(asked for _, asked in self.counts.values())


@dataclass(frozen=True)
class Board:
    """The board has all implementations, our own first."""

    audited: tuple[Audited, ...]

    def text(self) -> str:
        """Return the file, with one tally a line."""
        entries = []
        for one in self.audited:
            head = {field.name: getattr(one, field.name) for field in fields(one) if field.name != "failed"}
            rows = ",\n  ".join(json.dumps(asdict(tally)) for tally in one.failed)
            entries.append(f' {json.dumps(head)[:-1]}, "failed": [{rows}]}}')
        return f'{{"format": "{FORMAT}", "audited": [\n' + ",\n".join(entries) + "\n]}\n"

    @staticmethod
    def read(text: str) -> Board:
        """Return the board of a file. Raises InvalidData for another format."""
        data: Any = json.loads(text)
        if not isinstance(data, dict) or data.get("format") != FORMAT:
            raise InvalidData(f"got no board, expected the board.json of the format {FORMAT!r} that boards.py writes")
        return Board(tuple(Board._entry(one) for one in data["audited"]))

    @staticmethod
    def _entry(data: dict[str, Any]) -> Audited:
        counts = {name: (passed, asked) for name, (passed, asked) in data["counts"].items()}
        return Audited(**{**data, "counts": counts, "failed": tuple(Tally(**row) for row in data["failed"])})
