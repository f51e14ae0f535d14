"""Readings of the ledger that the language of claims can say, decided from their texts: `verify` takes their verdicts from here.

    readings          the readings of `example:ledger`, by "CLAIM--READING"
    decide_reading    the outcome of one of them, for `verify`

The text of a reading is evaluated on every system of the corpus, and what it reads there are answers of certificates that the checker has
accepted. Where a system fails, the smallest one is sought in the reading's box, as `faultspace claim` seeks it, over Q and with its
certificates.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from importlib import resources

from ...base.progress import silent
from ...exact.system.systems import ResidualSystem
from ..language.certified import Certified, asked_by
from ..language.evaluating import evaluate
from ..language.nodes import reads
from ..quantities.registry import Subject, quantities
from ..trust.structure_certificates import Certificate, sha256
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, certify, counterexample
from .claim_files import read_claims
from .claims import Claim
from .deciding import certified
from .trying import Question, search

FILE = "ledger.toml"
MOST = 10**9


@cache
def readings() -> dict[str, Claim]:
    """Return the claims of the file, by their names."""
    text = resources.files("faultspace").joinpath("examples", FILE).read_text("utf-8")  # data of the front door, as for known_bounds
    return {one.id: one for one in read_claims(text)}


def decide_reading(bench: Workbench, name: str) -> Outcome:
    """Return what becomes of the reading with this name: CERTIFIED, or REFUTED by the smallest system of its box, or of the corpus."""
    claim = readings()[name]
    *hypotheses, conclusion = claim.nodes
    found = certify(
        bench,
        asked_by(*claim.nodes),
        lambda e: all(evaluate(one, Certified(e)) for one in hypotheses),
        lambda e: bool(evaluate(conclusion, Certified(e))),
        lambda system: shown(claim, system),
    )
    if found.verdict != Verdict.REFUTED:
        return found
    box = claim.boxes["Q"]
    failing = search(box, [Question(tuple(hypotheses), conclusion)], most=MOST, jobs=1, progress=silent).found[0].failing
    if failing is None:
        return found
    smallest = certified(claim, failing, smallest=True)
    if smallest.computed:
        return Outcome(Verdict.ERROR, f"{failing} fails, and no certificate bears its {smallest.computed[0]}")
    return counterexample(str(failing), box, smallest.certificates)


def shown(claim: Claim, system: ResidualSystem) -> Iterator[Certificate]:
    """Yield certificates of everything that the claim names, about one system that shows it; of windows those of n + 1 samples."""
    subject, seen = Subject(system), set[str]()
    for _, name in sorted(reads(*claim.nodes)):
        quantity = quantities()[name]
        if quantity.certificates is None:
            continue
        for one in quantity.certificates(subject, system.n + 1) if quantity.windowed else quantity.certificates(subject):
            if (digest := sha256(one)) not in seen:
                seen.add(digest)
                yield one
