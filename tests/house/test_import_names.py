"""A room has one import name, faultspace.<room>, and its folder's own name is refused."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOMS = ("exact", "numeric", "proofs")


def python(root: Path, statement: str) -> subprocess.CompletedProcess[str]:
    """Return a fresh interpreter that looks for modules in the tree first."""
    source = f"import sys; sys.path.insert(0, {str(root)!r}); {statement}"
    return subprocess.run([sys.executable, "-c", source], cwd=root, capture_output=True, text=True)


def test_the_links_lead_to_the_rooms(root: Path) -> None:
    if not all((root / "faultspace" / room).is_symlink() for room in ROOMS):
        pytest.skip("this copy of the tree has no links: an archive, or a system without them")
    assert {room: os.readlink(root / "faultspace" / room) for room in ROOMS} == {room: f"../{room}" for room in ROOMS}


def test_the_full_name_works_and_the_plain_name_is_refused_in_one_line(root: Path) -> None:
    for room in ROOMS:
        run = python(root, f"import faultspace.{room}")
        assert run.returncode == 0, run.stderr
        run = python(root, f"import {room}")
        assert run.returncode != 0, room
        last = run.stderr.strip().splitlines()[-1]
        assert last.startswith("ImportError: ") and f"'import faultspace.{room}'" in last
