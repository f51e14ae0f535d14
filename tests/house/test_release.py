"""What makes a release refuses a step that ends or prints otherwise than it has to, and its archive depends on what it holds alone.

The page of the versions that were tried says so where the script that makes it has since been given more to try. The wheel holds what git
holds of the package, no file less and none more.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path, PurePosixPath
from types import ModuleType

import pytest

import faultspace

from .import_graph import ROOT
from .scripts import script

PROGRAMS = Path(sys.executable).parent
PYTHON = Path(sys.executable).name


@pytest.fixture(scope="module")
def release() -> ModuleType:
    """Return the script .ci/release as a module."""
    return script("release")


def test_a_step_that_does_as_it_has_to_is_measured(release: ModuleType, tmp_path: Path) -> None:
    (tmp_path / "a-1.txt").write_text("", "utf-8")
    held = "x = bytearray(80 << 20); import sys, time; time.sleep(0.6); print('found', *sys.argv[1:])"
    done = release.did(release.Step("one", f'{PYTHON} -c "{held}" *-*.txt', "found .*"), PROGRAMS, tmp_path)
    assert done.said == "found a-1.txt"
    assert done.clock > 0.5 and done.memory > 80 << 20


@pytest.mark.parametrize(("program", "says", "code"), [("print(2)", "1", 0), ("print(1)", "1", 3), ("raise SystemExit(3)", "1", 3)])
def test_a_step_that_does_otherwise_is_refused(release: ModuleType, tmp_path: Path, program: str, says: str, code: int) -> None:
    with pytest.raises(release.Failed, match="no line like"):
        release.did(release.Step("one", f'{PYTHON} -c "{program}"', says, code), PROGRAMS, tmp_path)


def test_an_archive_is_made_of_names_and_bytes_alone(release: ModuleType, tmp_path: Path) -> None:
    one, other = tmp_path / "one", tmp_path / "other"
    for folder, when in ((one, 1e9), (other, 1.5e9)):
        folder.mkdir()
        (folder / "a").write_bytes(b"text")
        os.utime(folder / "a", (when, when))
        release.archived({"kept": [folder / "a"]}, folder / "kept.zip")
    assert release.sums(one) == release.sums(other)
    assert re.fullmatch(r"[0-9a-f]{64}  a\n[0-9a-f]{64}  kept\.zip\n", release.sums(one))
    (other / "a").write_bytes(b"Text")
    release.archived({"kept": [other / "a"]}, other / "kept.zip")
    assert release.sums(one) != release.sums(other)


def test_the_page_has_the_steps(release: ModuleType) -> None:
    told = re.findall(r"^\| [^|]+ \| `([^`]+)` \|", release.PAGE.read_text("utf-8"), re.MULTILINE)
    assert told == [step.command for step in release.STEPS], "make it again: .ci/release"


@pytest.mark.searches
def test_the_pages_that_are_not_in_the_tree_are_made(release: ModuleType, tmp_path: Path) -> None:
    """What is made is whole, what has left is as git last had it, and a file that never was is refused."""
    known = subprocess.run(["git", "-C", str(ROOT), "rev-parse", "--is-shallow-repository"], capture_output=True, text=True)
    if known.stdout.strip() != "false":
        pytest.skip("the tree has not its history beside it")
    release.paged(Path(sys.executable), ROOT, tmp_path)
    made = {path.name: path.read_text("utf-8") for path in tmp_path.iterdir()}
    assert made.keys() == {"statements.md", "paper-to-proof.md", "history.md", "benchmarks-log.md"}
    assert not any((ROOT / path).exists() for path in release.LEFT.values())
    assert "## Withdrawn" in made["history.md"] and "4912943add64214edb89094ab45d40677b4ecc8b5d6c0dbc5a06f24618cec6aa" in made["history.md"]
    assert made["benchmarks-log.md"].startswith("# Benchmarks\n") and min(map(len, map(str.split, made.values()))) > 10_000
    with pytest.raises(release.Failed, match="git has no commit"):
        release.left("docs/never-was.md")


THEORY = ROOT / "proofs" / "theory"


def test_the_package_of_the_theory_has_the_version_and_licence_of_ours() -> None:
    told = dict(re.findall(r'^(\S+): "([^"]*)"$', (THEORY / "coq-faultspace.opam").read_text("utf-8"), re.MULTILINE))
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert (told["version"], told["license"]) == (faultspace.__version__, project["license"])


@pytest.mark.skipif(shutil.which("coq_makefile") is None, reason="coq_makefile is not installed (apt install coq)")
def test_the_package_of_the_theory_builds_every_file(tmp_path: Path) -> None:
    shutil.copytree(THEORY, tmp_path / "theory", ignore=shutil.ignore_patterns("*.vo*", "*.glob", ".*"))
    lines = re.findall(r'^  \["sh" "-c" "(.+)"\]$', (THEORY / "coq-faultspace.opam").read_text("utf-8"), re.MULTILINE)
    assert len(lines) == 1
    subprocess.run(["sh", "-c", lines[0]], cwd=tmp_path / "theory", check=True, capture_output=True, timeout=60)
    told = re.findall(r"\./([\w/]+\.v)\b", (tmp_path / "theory" / "Makefile.conf").read_text("utf-8"))
    assert {*told} == {path.relative_to(THEORY).as_posix() for path in THEORY.rglob("*.v")}


OLDER = "**This page is older than `.ci/versions`**"


@pytest.fixture(scope="module")
def versions() -> ModuleType:
    """Return the script .ci/versions as a module."""
    return script("versions")


def tells_all(versions: ModuleType, page: str) -> bool:
    """Tell whether each extra and each file of tests that the script now takes stands on the page, but in a sentence on its age."""
    told = "\n".join(part for part in page.split("\n\n") if not part.startswith(OLDER))
    return f"| {', '.join(versions.EXTRAS)} |" in told and all(file in told for file in versions.FAST)


def test_the_page_says_where_it_is_older_than_the_script(versions: ModuleType) -> None:
    page = (ROOT / ".ci" / "versions.md").read_text()
    assert tells_all(versions, page) != (OLDER in page)


def test_a_new_page_is_told_from_an_older_one(versions: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    one = versions.Found("3.11.7", "lowest", True, {"numpy": "2.3.0"}, "1 passed", (), True)
    page = versions.page([one], 1, f"the tests of {versions.FILES}")
    assert tells_all(versions, page)
    monkeypatch.setattr(versions, "EXTRAS", (*versions.EXTRAS, "another"))
    assert not tells_all(versions, page) and not tells_all(versions, f"{page}\n{OLDER}: | {', '.join(versions.EXTRAS)} |\n")


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
