"""The ledger of claims, `ledger.toml`, as records: what is claimed, how it can be read, what verdict is expected.

    Claim       id, reference in the review, statement, readings, expected verdict
    Reading     one precise statement; `repair` marks those that are ours, no way to read the words; `check` names the function in claims/,
                or the text in the language of claims (IN_LANGUAGE)
    load        the claims of the ledger, in its order
    sentences   what the cards of the claims say
    expected_without   for each ablation of `hypotheses`, the verdict expected when one of its hypotheses is dropped

The verdict itself is never in the ledger: it is computed by each run and compared with the expected one.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, fields
from functools import lru_cache
from importlib import resources
from typing import Any

from ...base.sheets import Shown

FILE, CARDS = "ledger.toml", "cards.toml"
IN_LANGUAGE = "language"
OURS = "ours"  # with it the reference of a claim begins that neither the paper nor its review has


@dataclass(frozen=True, repr=False)
class Reading(Shown):
    """One way to read a claim, precise enough to be decided; the ledger states it, and a run of `verify` decides it.

    `id` names it within its claim. `statement` and `hypotheses` are in words. `expected` is the verdict that a run is compared with, a
    string of the closed list of `Verdict`; `repair` says that the reading is ours: it repairs or
    sharpens the words, or takes them too far, and is no way to read them.
    `theorems` of theory/headlines say it for all systems; of a refuted reading they are its counterexample. `missing`: what a
    proof for all systems lacks, where the reading holds and has none. `part` names the part of the claim that it reads, if any. `check` is
    the function in claims/ that decides it, as "claim.reading", or "language.NAME" where a text of the language of claims does. The
    statements are those of [G25] and of its review, or ours.

    Raises nothing.

    >>> from faultspace.proofs.verdict.ledger import load
    >>> reading = load()[0].readings[0]
    >>> reading
    <Reading: one-sided, REFUTED is expected>
    >>> reading.hypotheses
    ('u white', 'l >= 0')
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

    @property
    def title(self) -> str:
        """Its name and the verdict that the ledger expects where there is Rocq."""
        return f"{self.id}, {self.proved} is expected"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield what the ledger says of it, as (name, value) pairs."""
        yield "statement", self.statement
        yield "hypotheses", "; ".join(self.hypotheses) or "none"
        yield "whose", "ours" if self.repair else "a reading of the words as stated"
        if self.theorems:
            yield "theorems in Rocq", ", ".join(self.theorems)
        if self.missing:
            yield "a proof lacks", self.missing
        yield "decided by", self.check

    def to_json(self) -> dict[str, Any]:
        """Return an object with the fields of the record."""
        return asdict(self)


@dataclass(frozen=True, repr=False)
class Claim(Shown):
    """A claim of the paper, of its review or of ours, with the ways to read it; the ledger states it, and `verify` decides it.

    `id` is what `verify` takes, `reference` says where the claim stands, `statement` gives it in its words, and `uses` names the claims
    that it rests on. `readings` is a tuple, and the number of its `Reading` is at least one; `expected` is the verdict on the whole, with
    which a run is compared.

    The readings of a claim are alternatives, or those of each `part` are; where it is made `in_parts`, each that is not ours is a part of
    its own. Of every part one must hold. The claims are those of [G25] and of its public review.

    Raises nothing.

    >>> from faultspace.proofs.verdict.ledger import load
    >>> claim = load()[0]
    >>> claim
    <Claim: assumption-2 (review, major comment 1; [G25] Assumption 2)>
    >>> [reading.id for reading in claim.readings]
    ['one-sided', 'without-lag-zero', 'two-sided']
    """

    id: str
    reference: str
    statement: str
    expected: str
    uses: tuple[str, ...]
    in_parts: bool
    readings: tuple[Reading, ...]

    @property
    def title(self) -> str:
        """Its name, and where it stands."""
        return f"{self.id} ({self.reference})"

    @property
    def whose(self) -> str:
        """This says who states it so: the review, whose words are all that was at hand of the paper, or we."""
        return "as we state it" if self.reference.startswith(OURS) else "as the review states it"

    @property
    def group(self) -> str:
        """This says whose claim it is: of the paper, as its review states it, of the review, or ours."""
        if self.reference.startswith(OURS):
            return "ours"
        return "review" if self.id.startswith(("settle-", "objection-")) else "paper"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield the statement, whose words these are, and the readings, as (name, value) pairs."""
        yield self.whose, self.statement
        yield "verdict that the ledger expects", self.expected
        yield "readings", ""
        yield from ((reading.id, f"{reading.statement} {reading.proved} is expected.") for reading in self.readings)

    def to_json(self) -> dict[str, Any]:
        """Return an object with the fields of the record, the readings as objects."""
        return asdict(self)


def load() -> tuple[Claim, ...]:
    """All claims of the ledger, in its order."""
    return _claims(_text())


def expected_without() -> dict[str, dict[str, str]]:
    """A dict {ablation: {hypothesis: verdict on the claim without it}}; the verdict is REFUTED where the hypothesis is needed."""
    return {name: {str(key): str(value) for key, value in entry.items()} for name, entry in _contents()["without"].items()}


@lru_cache(maxsize=1)
def sentences() -> Mapping[str, Any]:
    """Return what the card of each claim says in sentences: `verdict`, `instead`, and `wrong` of some readings."""
    found: Mapping[str, Any] = tomllib.loads(resources.files(__package__).joinpath(CARDS).read_text("utf-8"))["card"]
    return found


def _contents() -> dict[str, Any]:
    return _parsed(_text())


def _text() -> str:
    return resources.files(__package__).joinpath(FILE).read_text(encoding="utf-8")


@lru_cache(maxsize=1)  # a run asks for them with every attack
def _claims(text: str) -> tuple[Claim, ...]:
    return tuple(_claim(name, entry) for name, entry in _parsed(text)["claim"].items())


@lru_cache(maxsize=1)  # and for the rest with every ablation
def _parsed(text: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"proofs/verdict/{FILE}: {error}") from None


def _known(entry: Mapping[str, object], where: str, record: type, *more: str) -> None:
    """Raise ValueError for a key of the ledger that no field of the record has the name of, and for one that lacks."""
    names = [one.name for one in fields(record) if one.name != "id"]
    unknown = [key for key in entry if key not in names]
    lacking = [name for name in ("statement", "expected", *more) if name not in entry]
    if unknown or lacking:
        what = f"unknown key {unknown[0]!r}, expected {', '.join(names)}" if unknown else f"key {lacking[0]!r} is missing"
        raise ValueError(f"proofs/verdict/{FILE}: {where}: {what}")


def _claim(name: str, entry: dict[str, object]) -> Claim:
    _known(entry, f"claim.{name}", Claim, "reference", "readings")
    readings = entry["readings"]
    if not isinstance(readings, dict):
        raise ValueError(f"proofs/verdict/{FILE}: claim.{name} has no readings")
    for key, value in readings.items():
        _known(value, f"claim.{name}.readings.{key}", Reading)
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
