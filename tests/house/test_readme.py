"""The README tells of the claims what the ledger expects and a run computes: its table is this one."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from faultspace.proofs.hypotheses import experiments
from faultspace.proofs.ledger import expected_without, load
from faultspace.proofs.verdicts import Verdict, of_readings

README = Path(__file__).parents[2] / "README.md"


def claims_table() -> list[str]:
    """The rows of the README's table of claims, from the ledger."""
    rows = ["| claim | verdict | read as | verdict on the reading |", "|---|---|---|---|"]
    for claim in load():
        proved = of_readings([(one, Verdict(one.proved)) for one in claim.readings], in_parts=claim.in_parts)
        for i, reading in enumerate(claim.readings):
            first = f"| **{claim.id}** | {proved} " if i == 0 else "| | "
            mark = "ours: " if reading.repair else ""
            rows.append(f"{first}| {mark}{reading.statement} | {reading.proved} |")
    return rows


def hypotheses_table() -> list[str]:
    """The rows of the README's table of hypotheses, from the ledger and from what the experiments say is proved."""
    heads = "claim", "conclusion", "needed", "not needed, PROVED", "no counterexample found", "follows from the others"
    rows = [f"| {' | '.join(heads)} |", "|---" * len(heads) + "|"]
    expected = expected_without()
    for experiment in experiments():
        cells: dict[str, list[str]] = {"REFUTED": [], "PROVED": [], "CERTIFIED": [], "IMPLIED": []}
        for name, entry in expected[experiment.name].items():
            proved = entry == "CERTIFIED" and experiment.theorems_without((name,))
            cells["PROVED" if proved else entry].append(name)
        rows.append(f"| {experiment.claim} | {experiment.conclusion} | {' | '.join('; '.join(names) for names in cells.values())} |")
    return rows


@pytest.mark.parametrize("table", [claims_table, hypotheses_table])
def test_the_tables_are_the_ledgers(table: Callable[[], list[str]]) -> None:
    lines = README.read_text(encoding="utf-8").splitlines()
    wanted = table()
    start = lines.index(wanted[0]) if wanted[0] in lines else 0
    assert lines[start : start + len(wanted)] == wanted, "put this into the README:\n" + "\n".join(wanted)
