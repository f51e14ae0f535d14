"""The records that a page is made of: what `verify` wrote, and what the command has computed beside it. All of it is as JSON has it.

Run            the verdicts of a run, where it comes from, and its certificates by SHA-256
Records        a run with all that was computed beside it
read_run       the folder that `faultspace verify --out` has written
NEEDED         what must be written into verdicts.json, key by key: a file of an earlier version is refused, and not half shown
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..base.errors import InvalidInput, quote_path, shorten
from ..base.regular_files import open_regular
from ..proofs.trust.structure_certificates import sha256
from ..proofs.verdict.run_folder import ORIGIN, VERDICTS

AGAIN = "write the folder anew: faultspace verify --out DIR"
NEEDED = {
    "": ("effort", "corpus", "rocq", "seconds", "versions", "claims", "hypotheses"),
    "claims": ("id", "reference", "whose", "as_stated", "uses", "verdict", "expected", "rests_on", "readings", "card"),
    "card": ("id", "group", "verdict", "wrong", "instead", "why"),
    "readings": (
        *("reading", "ours", "statement", "hypotheses", "verdict", "expected", "theorems", "locks", "missing_for_a_proof", "evidence"),
        *("certificates_accepted", "certificates", "attacks", "seconds"),
    ),
    "hypotheses": (
        *("claim", "conclusion", "dropped", "verdict", "needed", "expected", "as_expected", "already_without", "follows_from_the_others"),
        *("tried", "lacking", "evidence", "certificates"),
    ),
    "origin": ("time", "commit", "changed", "checkers", "command"),
}


@dataclass(frozen=True)
class Run:
    """`verdicts` and `origin` are the documents of these names; `certificates` maps SHA-256 to certificate."""

    verdicts: Mapping[str, Any]
    origin: Mapping[str, Any]
    certificates: Mapping[str, Any]


@dataclass(frozen=True)
class Records:
    """`checked` has the checker's word on each certificate of the run, by SHA-256, given anew; the others are named as the modules of
    `computed` that made them."""

    run: Run
    checked: Mapping[str, Mapping[str, Any]]
    example: Mapping[str, Any]
    convergence: Mapping[str, Any]
    study: Mapping[str, Any]
    controls: Mapping[str, Any]


def read_run(folder: Path) -> Run:
    """Return what is in the folder. Raises InvalidInput where it is not one that `faultspace verify --out` has written."""
    verdicts, origin = _document(folder / VERDICTS), _document(folder / ORIGIN)
    where = quote_path(str(folder / VERDICTS))
    _has(verdicts, "", where)
    _has(origin, "origin", quote_path(str(folder / ORIGIN)))
    for claim in _all(verdicts, "claims", where):
        _all(claim, "readings", where)
        _has(claim["card"], "card", where)
    _all(verdicts, "hypotheses", where)
    found = [_document(path) for path in sorted(folder.glob("*-*.json"))]
    return Run(
        verdicts=verdicts,
        origin=origin,
        certificates={sha256(one): one for one in found if one.get("format") == "faultspace-certificate/1"},
    )


def _document(path: Path) -> dict[str, Any]:
    name = quote_path(str(path))
    if not path.exists():
        raise InvalidInput(f"{name}: is not there, expected what `faultspace verify --out DIR` writes")
    try:
        with open_regular(path, "a JSON file") as stream:
            found = json.loads(stream.read().decode("utf-8"))
    except InvalidInput as error:
        raise InvalidInput(f"{name}: {error}") from None
    except (OSError, ValueError, RecursionError) as error:
        raise InvalidInput(f"{name}: cannot be read as JSON ({error}); {AGAIN}") from None
    if not isinstance(found, dict):
        raise InvalidInput(f"{name}: got no object, expected what a run has written; {AGAIN}")
    return found


def _all(of: Any, what: str, where: str) -> list[Any]:
    found = of[what]
    if not isinstance(found, list):
        raise InvalidInput(f"{where}: got {shorten(found)} for {what}, expected a list; {AGAIN}")
    for one in found:
        _has(one, what, where)
    return found


def _has(found: Any, what: str, where: str) -> None:
    lacking = [key for key in NEEDED[what] if not isinstance(found, dict) or key not in found]
    if lacking:
        raise InvalidInput(f"{where}: key {lacking[0]!r} is missing{f' in {what}' if what else ''}; {AGAIN}")
