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


@pytest.mark.parametrize("room", ROOMS)
def test_the_link_leads_to_the_room(root: Path, room: str) -> None:
    if not (root / "faultspace" / room).is_symlink():
        pytest.skip("this copy of the tree has no links: an archive, or a system without them")
    assert os.readlink(root / "faultspace" / room) == f"../{room}"


@pytest.mark.parametrize("room", ROOMS)
def test_the_full_name_works(root: Path, room: str) -> None:
    run = python(root, f"import faultspace.{room}")
    assert run.returncode == 0, run.stderr


@pytest.mark.parametrize("room", ROOMS)
def test_the_plain_name_is_refused_in_one_line(root: Path, room: str) -> None:
    run = python(root, f"import {room}")
    assert run.returncode != 0
    last = run.stderr.strip().splitlines()[-1]
    assert last.startswith("ImportError: ") and f"'import faultspace.{room}'" in last
