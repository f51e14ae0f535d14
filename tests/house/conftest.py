"""This is the tree as the tests of the house see it.

root        the folder of pyproject.toml
checkout    the files that a commit of the tree would hold, links included, relative to root
"""

import subprocess
from pathlib import Path, PurePosixPath

import pytest


@pytest.fixture(scope="session")
def root() -> Path:
    """The root is the folder of pyproject.toml."""
    return Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def checkout(root: Path) -> list[PurePosixPath]:
    """The files git holds or would hold; skips where git does not know this tree (an unpacked archive)."""
    # Files not yet added count too (minus the ignored ones): a module is forgotten before its first commit or never.
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    try:
        listing = subprocess.run(command, cwd=root, capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError) as problem:
        pytest.skip(f"not a git checkout: {problem}")
    names = sorted(set(filter(None, listing.split("\0"))))
    # An archive unpacked inside somebody else's repository is no checkout either.
    if "pyproject.toml" not in names:
        pytest.skip("not a git checkout: git does not list pyproject.toml")
    return [PurePosixPath(name) for name in names if (root / name).is_symlink() or (root / name).exists()]
