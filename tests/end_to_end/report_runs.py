"""A small run that pages are made of: one claim decided for real, others with real certificates and verdicts made up for the test.

small_run     writes its folder: example-v as `verify` decides it, a claim on pairs, a claim with a theorem
SMALL         as little beside it as there can be
spoil         changes the verdicts of such a folder
"""

from __future__ import annotations

import json
from collections.abc import Callable
from importlib import resources
from pathlib import Path
from typing import Any

import faultspace as fs
from faultspace.proofs.rocq.locks import kept
from faultspace.proofs.trust.structure_certificates import sha256
from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.run_folder import write_document, write_run
from faultspace.review.gathering import Sizes

SMALL = Sizes(runs=2, study=4, plans=("published", "corrected"), lengths=(100, 300), seeds=1, statements=1)
PAIR, PROVED = "theorem-1", "zero-feedthrough"


def small_run(folder: Path) -> Path:
    """Write the run and return its folder."""
    folder.mkdir(parents=True)
    write_run(fs.verify(["example-v"], jobs=1), folder)
    certificates = [_difference(), *_of_the_tree("window-ranks", 2)]
    for one in certificates:
        write_document(folder / f"{one['kind']}-{sha256(one)[:12]}.json", one)
    theorem = "zero_feedthrough_exactly_when"
    name = theorem if theorem in kept().theorems else min(kept().theorems)

    def add(verdicts: dict[str, Any]) -> None:
        verdicts["claims"] += [
            _claim(
                PAIR, {"n-samples": ("REFUTED", certificates, {}), "n-plus-1-samples": ("PROVED", (), {name: kept().theorems[name].sha256})}
            ),
            _claim(PROVED, {"fault-matrices": ("REFUTED", certificates[1:], {}), "exactly-when": ("CERTIFIED", (), {})}),
        ]
        verdicts["claims"][-1]["uses"] = [PAIR]
        verdicts["hypotheses"] = [
            _row(("observable",), "CERTIFIED"),
            _row(("s >= n",), "REFUTED"),
            _row(("observable", "s >= n"), "REFUTED"),
        ]

    spoil(folder, add)
    return folder


def spoil(folder: Path, change: Callable[[dict[str, Any]], None]) -> None:
    """Change the verdicts of a run in place."""
    verdicts = json.loads((folder / "verdicts.json").read_text("utf-8"))
    change(verdicts)
    write_document(folder / "verdicts.json", verdicts)


def _of_the_tree(kind: str, count: int) -> list[dict[str, Any]]:
    files = resources.files("faultspace.proofs").joinpath("certificates").iterdir()
    found = sorted((one for one in files if one.name.startswith(f"{kind}-")), key=lambda one: one.name)
    return [json.loads(one.read_text("utf-8")) for one in found[:count]]


def _difference() -> dict[str, Any]:
    """Return a certificate on two systems of which words tell them apart, the one of the most samples."""
    return max(_of_the_tree("behaviour-difference", 99), key=lambda one: int(one["statement"]["window"]))


def _claim(name: str, readings: dict[str, tuple[str, Any, dict[str, str]]]) -> dict[str, Any]:
    stated = next(claim for claim in load() if claim.id == name)
    by_id = {one.id: one for one in stated.readings}
    return {
        "id": name,
        "reference": stated.reference,
        "whose": stated.whose,
        "as_stated": stated.statement,
        "uses": [],
        "verdict": "AMENDED",
        "expected": "AMENDED",
        "as_expected": True,
        "rests_on": [],
        "card": {
            **{"id": name, "group": stated.group, "place": stated.reference, "said": stated.statement, "level": "AMENDED"},
            **{"verdict": f"A sentence on {name}.", "wrong": [], "instead": "", "why": ["made up for a test"]},
        },
        "readings": [
            {
                "reading": one,
                "ours": by_id[one].repair,
                "statement": by_id[one].statement,
                "hypotheses": list(by_id[one].hypotheses),
                "verdict": verdict,
                "expected": verdict,
                "as_expected": True,
                "theorems": list(locks),
                "locks": locks,
                "missing_for_a_proof": "a proof that nobody has written" if verdict == "CERTIFIED" else None,
                "evidence": "made up for a test",
                "certificates_accepted": len(certificates),
                "certificates": [{"kind": each["kind"], "sha256": sha256(each)} for each in certificates],
                "attacks": [],
                "seconds": 0.0,
            }
            for one, (verdict, certificates, locks) in readings.items()
        ],
    }


def _row(dropped: tuple[str, ...], verdict: str) -> dict[str, Any]:
    return {
        "experiment": "toy",
        "claim": PAIR,
        "conclusion": "the ranks are right",
        "dropped": list(dropped),
        "verdict": verdict,
        "needed": verdict == "REFUTED",
        "follows_from_the_others": None,
        "expected": verdict,
        "as_expected": True,
        "already_without": "s >= n" if len(dropped) == 2 else None,
        "theorems": [],
        "tried": 12,
        "lacking": 3,
        "evidence": "made up for a test",
        "certificates_accepted": 0,
        "certificates": [],
        "attacks": [],
    }
