"""The README tells of the claims what the ledger expects and a run computes: its table is this one."""

from __future__ import annotations

from pathlib import Path

from faultspace.proofs.ledger import load

README = Path(__file__).parents[2] / "README.md"


def claims_table() -> list[str]:
    """The rows of the README's table of claims, from the ledger."""
    rows = ["| claim | verdict | read as | verdict on the reading |", "|---|---|---|---|"]
    for claim in load():
        for i, reading in enumerate(claim.readings):
            first = f"| **{claim.id}** | {claim.expected} " if i == 0 else "| | "
            mark = "ours: " if reading.repair else ""
            rows.append(f"{first}| {mark}{reading.statement} | {reading.expected} |")
    return rows


def test_the_table_of_claims_is_the_ledgers() -> None:
    lines = README.read_text(encoding="utf-8").splitlines()
    wanted = claims_table()
    start = lines.index(wanted[0]) if wanted[0] in lines else 0
    assert lines[start : start + len(wanted)] == wanted, "put this into the README:\n" + "\n".join(wanted)
