"""The ledger names what there is: a function for every reading, a reading for every function, verdicts from the closed list."""

from __future__ import annotations

import ast
from importlib import import_module
from pathlib import Path

import faultspace.proofs.claims
from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.verdicts import Verdict

ROOM = Path(faultspace.proofs.claims.__file__).parent


def checks(module: str) -> set[str]:
    """The public functions of a claim's file that take a Workbench."""
    tree = ast.parse((ROOM / f"{module}.py").read_text(encoding="utf-8"))
    return {f.name for f in tree.body if isinstance(f, ast.FunctionDef) and [a.arg for a in f.args.args] == ["bench"] and f.name[0] != "_"}


def test_every_reading_has_its_function_and_every_function_its_reading() -> None:
    for claim in load():
        assert checks(claim.module) == {reading.id.replace("-", "_") for reading in claim.readings}, claim.id
        for reading in claim.readings:
            assert callable(getattr(import_module(f"faultspace.proofs.claims.{claim.module}"), reading.id.replace("-", "_")))


def test_every_claim_file_is_in_the_ledger() -> None:
    files = {path.stem for path in ROOM.glob("*.py")} - {"__init__", "common"}
    assert files == {claim.module for claim in load()}


def test_expected_verdicts_are_of_the_closed_list() -> None:
    for claim in load():
        assert claim.expected in set(Verdict)
        assert all(reading.expected in set(Verdict) and reading.expected != "AMENDED" for reading in claim.readings)


def test_used_claims_exist() -> None:
    names = {claim.id for claim in load()}
    assert all(set(claim.uses) <= names for claim in load())


def test_the_claims_of_the_review_are_there() -> None:
    names = {claim.id for claim in load()}
    assert {"theorem-1", "theorem-2", "assumption-4", "proposition-3", "problem-11", "theorem-3-i", "theorem-3-ii"} <= names
    assert {"settle-2", "objection-3", "example-v"} <= names
