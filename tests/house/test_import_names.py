"""A room has one import name, faultspace.<room>, and its folder's own name is refused; in numeric a name is one module's alone."""

import importlib
import os
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

from .import_graph import house

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


def test_rooms_leave_the_finders_of_modules_in_order(root: Path) -> None:
    """What a room adds to them has all that Python asks of a finder: `importlib.invalidate_caches()` had ended with a TypeError."""
    run = python(root, "import importlib, faultspace.exact, faultspace.numeric, faultspace.proofs.trust; importlib.invalidate_caches()")
    assert run.returncode == 0, run.stderr


def test_no_two_modules_of_numeric_share_a_name_and_none_has_that_of_a_public_function() -> None:
    modules = [one.name.split(".")[2:] for one in house() if one.name.startswith("faultspace.numeric.") and ".audit" not in one.name]
    names = Counter(name[-1] for name in modules)
    assert len(names) > 100
    assert [name for name, times in names.items() if times > 1] == []
    assert names.keys() & set(importlib.import_module("faultspace.numeric").__all__) == set()
