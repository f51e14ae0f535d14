"""theorem-3 (i): every equivalent minimal pair is (Fhat P, Ghat P)."""

from __future__ import annotations

from ..verdict.verdicts import Outcome
from ..verdict.workbench import Workbench, certify_records
from .theorem_3_ii import show, words


def part_i(bench: Workbench) -> Outcome:
    """Every (F', G') with the same behaviour for the same (A, C) has its columns in Z."""
    records = [e for e in bench.alternatives if e.equal]
    return certify_records(records, [e for e in records if not e.in_space], words, show)
