"""What is counted as accepted is what the checker decided: each certificate once, however many records, readings and rows rest on it."""

from __future__ import annotations

from typing import Any

import pytest

from faultspace.base.progress import silent
from faultspace.exact.algebra.fields import QQ
from faultspace.proofs.deciding import Check
from faultspace.proofs.deciding import decided as answers_to
from faultspace.proofs.evidence.alternatives import ALTERNATIVES, PAIRS, examine_alternative, examine_pair
from faultspace.proofs.evidence.families import random_systems
from faultspace.proofs.evidence.once_a_run import in_run
from faultspace.proofs.trust import checker, structure_certificates
from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.verdicts import ClaimResult, ReadingResult, Report
from faultspace.proofs.verdict.workbench import Workbench


def counting(monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """Return a set into which the checker's decisions go from now on, by the names of the certificates."""
    decided: set[str] = set()
    decide = checker.decide

    def counted(one: dict[str, Any], *rest: Any) -> Any:
        decided.add(structure_certificates.sha256(one))
        return decide(one, *rest)

    monkeypatch.setattr(checker, "decide", counted)
    return decided


def test_a_certificate_on_which_several_rest_is_counted_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two readings, on pairs that share systems: their own counts, and that of the report, are of certificates that were decided."""
    decided = counting(monkeypatch)
    in_run("one of its own")
    systems = [one for one in random_systems(QQ, 12, seed=3) if one.n <= 3]
    bench = Workbench("quick", 1, silent)
    bench.put(ALTERNATIVES, [examine_alternative("itself", one, one) for one in systems for _ in range(3)])
    bench.put(PAIRS, [examine_pair("itself", one, one) for one in systems])
    claim = next(one for one in load() if one.id == "canonical-form")
    readings = [one for one in claim.readings if one.id in ("same-a-c",)]
    results = [ReadingResult(one, Check(one.check).done(bench), 0.0) for one in readings for _ in range(2)]
    report = Report("quick", (ClaimResult(claim, tuple(results)),), (), "", 0.0)
    assert report.decided() <= decided
    assert results[0].outcome.accepted == len(report.decided()) == len(results[0].outcome.all_decided) > len(systems)
    assert results[0].outcome.accepted <= 3 * len(set(systems)) + len(results[0].outcome.certificates), "a sum over records has four each"
    assert results[0].to_json()["certificates_accepted"] == results[0].outcome.accepted


def test_a_second_run_of_the_same_process_counts_what_it_has_decided_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is kept of a system is kept for one run, though the processes that do the work outlive it."""
    checks = [Check("example_v.one_fault"), Check("zeros_of_pairs.number"), Check("canonical_form.popov_rows")]
    runs = []
    for _ in range(2):
        decided = counting(monkeypatch)
        found = answers_to(Workbench("quick", 1, silent), checks)
        runs.append(frozenset().union(*(found[one].found.all_decided for one in checks)))
        assert runs[-1] <= decided
    assert runs[0] == runs[1] and len(runs[0]) > 3000
