"""What is counted as accepted is what the checker decided: each certificate once, however many records, readings and rows rest on it."""

from __future__ import annotations

from typing import Any

import pytest

from faultspace.base.progress import silent
from faultspace.exact.algebra.fields import QQ
from faultspace.proofs.deciding import Check
from faultspace.proofs.evidence import alternatives
from faultspace.proofs.evidence.alternatives import ALTERNATIVES, PAIRS, examine_alternative, examine_pair
from faultspace.proofs.evidence.families import random_systems
from faultspace.proofs.trust import checker, structure_certificates
from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.verdicts import ClaimResult, ReadingResult, Report
from faultspace.proofs.verdict.workbench import Workbench


def test_a_certificate_on_which_several_rest_is_counted_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two readings, on pairs that share systems: their own counts, and that of the report, are of certificates that were decided."""
    decided: list[str] = []
    decide = checker.decide

    def counted(one: dict[str, Any], *rest: Any) -> Any:
        decided.append(structure_certificates.sha256(one))
        return decide(one, *rest)

    monkeypatch.setattr(checker, "decide", counted)
    for kept in (alternatives.ranked, alternatives.compared, alternatives.fault_space_basis):
        kept.cache_clear()
    systems = [one for one in random_systems(QQ, 12, seed=3) if one.n <= 3]
    bench = Workbench("quick", 1, silent)
    bench.put(ALTERNATIVES, [examine_alternative("itself", one, one) for one in systems for _ in range(3)])
    bench.put(PAIRS, [examine_pair("itself", one, one) for one in systems])
    claim = next(one for one in load() if one.id == "canonical-form")
    readings = [one for one in claim.readings if one.id in ("same-a-c",)]
    results = [ReadingResult(one, Check(one.check).done(bench), 0.0) for one in readings for _ in range(2)]
    report = Report("quick", (ClaimResult(claim, tuple(results)),), (), "", 0.0)
    assert report.decided() <= set(decided)
    assert results[0].outcome.accepted == len(report.decided()) == len(results[0].outcome.all_decided) > len(systems)
    assert results[0].outcome.accepted <= 3 * len(set(systems)) + len(results[0].outcome.certificates), "a sum over records has four each"
    assert results[0].to_json()["certificates_accepted"] == results[0].outcome.accepted
