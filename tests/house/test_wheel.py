"""The wheel holds what git holds of the package, no file less and none more."""

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path, PurePosixPath

import pytest

FOLDERS = ("exact", "numeric", "proofs")


@pytest.fixture(scope="module")
def wheel_files(root: Path, checkout: list[PurePosixPath], tmp_path_factory: pytest.TempPathFactory) -> set[str]:
    """Names in a wheel built from a copy, so that no earlier build's leftovers count and none are left behind."""
    copy, out = tmp_path_factory.mktemp("tree"), tmp_path_factory.mktemp("wheel")
    for name in checkout:
        (copy / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(root / name, copy / name, follow_symlinks=False)
    build = f"from setuptools import build_meta; build_meta.build_wheel({str(out)!r})"
    run = subprocess.run([sys.executable, "-c", build], cwd=copy, capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr
    (wheel,) = out.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        return {name for name in archive.namelist() if ".dist-info/" not in name}


def test_wheel_and_tree_hold_the_same_files(root: Path, checkout: list[PurePosixPath], wheel_files: set[str]) -> None:
    files = [name for name in checkout if not (root / name).is_symlink()]
    expected = {str(name) for name in files if name.parts[0] == "faultspace"}
    expected |= {f"faultspace/{name}" for name in files if name.parts[0] in FOLDERS}
    advice = "a folder of modules has an __init__.py; another file has its pattern in `package-data` of pyproject.toml"
    assert sorted(expected - wheel_files) == [], f"in the tree but not in the wheel: {advice}"
    assert sorted(wheel_files - expected) == [], "in the wheel but not in the tree"


def test_the_wheel_brings_every_room(wheel_files: set[str]) -> None:
    needed = {"faultspace/__init__.py", "faultspace/py.typed"} | {f"faultspace/{room}/__init__.py" for room in FOLDERS}
    assert sorted(needed - wheel_files) == []
