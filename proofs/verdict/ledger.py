"""The ledger of claims, `ledger.toml`, as records: what is claimed, how it can be read, what verdict is expected.

    Claim       id, reference in the review, statement as printed, readings, expected verdict
    Reading     one precise statement; `repair` marks those that are ours and not the paper's; `check` names the function in claims/
    load        the claims of the ledger, in its order
    expected_without   for each ablation of `hypotheses`, the verdict expected when one of its hypotheses is dropped

The verdict itself is never in the ledger: it is computed by each run and compared with the expected one.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from importlib import resources
from typing import Any


@dataclass(frozen=True)
class Reading:
    """One way to read a claim, precise enough to be decided.

    `theorems` of theory/headlines say it for all systems; of a refuted reading they are its counterexample. `missing`: what a
    proof for all systems lacks, where the reading holds and has none. `part` names the part of the claim that it reads, if any. `check` is
    the function in claims/ that decides it, as "file.function".
    """

    id: str
    statement: str
    hypotheses: tuple[str, ...]
    expected: str
    repair: bool
    theorems: tuple[str, ...] = ()
    missing: str = ""
    part: str = ""
    check: str = ""

    @property
    def proved(self) -> str:
        """The verdict expected where Rocq has checked the theorems: what holds is PROVED, what is refuted stays so."""
        return "PROVED" if self.theorems and self.expected != "REFUTED" else self.expected


@dataclass(frozen=True)
class Claim:
    """A claim of the paper or of its review.

    The readings of a claim are alternatives, or those of each `part` are; where it is made `in_parts`, each that is not ours is a part of
    its own. Of every part one must hold.
    """

    id: str
    reference: str
    statement: str
    expected: str
    uses: tuple[str, ...]
    in_parts: bool
    readings: tuple[Reading, ...]


def load() -> tuple[Claim, ...]:
    """All claims of the ledger, in its order."""
    return tuple(_claim(name, entry) for name, entry in _contents()["claim"].items())


def expected_without() -> dict[str, dict[str, str]]:
    """{ablation: {hypothesis: verdict on the claim without it}}: REFUTED where it is needed."""
    return {name: {str(key): str(value) for key, value in entry.items()} for name, entry in _contents()["without"].items()}


def _contents() -> dict[str, Any]:
    return tomllib.loads(resources.files(__package__).joinpath("ledger.toml").read_text(encoding="utf-8"))


def _claim(name: str, entry: dict[str, object]) -> Claim:
    readings = entry["readings"]
    if not isinstance(readings, dict):
        raise ValueError(f"ledger: claim {name} has no readings")
    return Claim(
        id=name,
        reference=str(entry["reference"]),
        statement=str(entry["statement"]),
        expected=str(entry["expected"]),
        uses=tuple(entry.get("uses", ())),  # type: ignore[arg-type]
        in_parts=bool(entry.get("in_parts", False)),
        readings=tuple(
            Reading(
                id=key,
                statement=str(value["statement"]),
                hypotheses=tuple(value.get("hypotheses", ())),
                expected=str(value["expected"]),
                repair=bool(value.get("repair", False)),
                theorems=tuple(value.get("theorems", ())),
                missing=str(value.get("missing", "")),
                part=str(value.get("part", "")),
                check=str(value.get("check", f"{name}.{key}".replace("-", "_"))),
            )
            for key, value in readings.items()
        ),
    )
