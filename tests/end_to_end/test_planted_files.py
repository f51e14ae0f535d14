"""A folder that somebody else has prepared: no link is followed, nothing waits for a pipe, and files are as private as the mask says."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

import pytest

from faultspace.base import kept_lines
from faultspace.base.errors import InvalidInput
from faultspace.base.kept_lines import append, keeping_lines
from faultspace.base.writing import new_file, whole_file, write_text
from faultspace.numeric.plant.report import folders
from faultspace.numeric.study import keeping as study_keeping
from faultspace.numeric.study.keeping import LOCK, UNFINISHED, Settings, keeping
from tests.end_to_end.commands import ROOT

pytestmark = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="links and pipes of POSIX")
PRECIOUS = "precious\n"


def manifest(folder: Path) -> None:
    made = folder / "made"
    made.mkdir()
    (made / "model.json").write_text("{}")
    folders.replace(made, folder, ["model.json"])


def kept(folder: Path) -> None:
    with keeping_lines(folder / "kept", "a/1", lambda _: True, "--resume") as lines:
        lines.note(a=1)


def study(folder: Path) -> None:
    with keeping(folder, Settings(1, 10), resume=True) as cases:
        cases.add("published", [])


WRITERS: dict[str, tuple[Callable[[Path], None], tuple[str, ...]]] = {
    "a text": (lambda folder: write_text(folder / "text", "new"), ("text",)),
    "a manifest": (manifest, (folders.MANIFEST, f"{folders.MANIFEST}.unfinished", "model.json")),
    "answers kept": (kept, ("kept", ".kept.lock")),
    "a study": (study, (UNFINISHED, LOCK, ".unfinished-monte-carlo")),
}
PLANTED = [(writer, name) for writer, (_, names) in WRITERS.items() for name in names]


@pytest.mark.parametrize("kind", ["link", "dangling link", "hard link", "pipe", "link to a device"])
@pytest.mark.parametrize(("writer", "name"), PLANTED)
def test_what_is_planted_leads_nowhere(writer: str, name: str, kind: str, tmp_path: Path) -> None:
    victim, folder = tmp_path / "victim", tmp_path / "folder"
    folder.mkdir()
    victim.write_text(PRECIOUS)
    if kind == "pipe":
        os.mkfifo(folder / name)
    elif kind == "hard link":
        os.link(victim, folder / name)
    else:
        target = {"link": victim, "dangling link": tmp_path / "not there"}.get(kind, Path(os.devnull))
        (folder / name).symlink_to(target)
    try:
        WRITERS[writer][0](folder)
    except InvalidInput as error:
        assert name.removesuffix(".lock").lstrip(".") in str(error) or str(folder) in str(error)
    assert victim.read_text() == PRECIOUS and not (tmp_path / "not there").exists()
    assert stat.S_ISCHR(os.stat(os.devnull).st_mode)
    assert not [one for one in folder.iterdir() if one.name.startswith(".unfinished-") and one.name != name]


def test_a_link_in_the_place_of_our_own_folder_brings_nothing_of_others(tmp_path: Path) -> None:
    (tmp_path / "others").mkdir()
    (tmp_path / "others" / "model.json").write_text(PRECIOUS)
    (tmp_path / "made").symlink_to(tmp_path / "others")
    with pytest.raises(OSError):
        folders.replace(tmp_path / "made", tmp_path, ["model.json"])
    assert (tmp_path / "others" / "model.json").read_text() == PRECIOUS and not (tmp_path / "model.json").exists()


def test_a_link_that_comes_after_reading_is_not_cut(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    victim = tmp_path / "victim"
    victim.write_text(PRECIOUS)
    for module, name, writer in ((kept_lines, "kept", kept), (study_keeping, UNFINISHED, study)):
        folder = tmp_path / writer.__name__
        folder.mkdir()
        writer(folder)
        with open(folder / name, "ab") as stream:
            stream.write(b'{"fo')

        @contextmanager
        def swapping(path: Path, expected: str) -> Iterator[IO[bytes]]:
            with open(path, "rb") as stream:
                yield stream
                path.unlink()
                path.symlink_to(victim)

        monkeypatch.setattr(module, "open_own", swapping)
        with pytest.raises(InvalidInput):
            writer(folder)
        assert victim.read_text() == PRECIOUS, name


@pytest.mark.parametrize(("mask", "mode"), [(0o077, 0o600), (0o027, 0o640), (0o022, 0o644)])
def test_a_file_is_as_private_as_the_mask_says(mask: int, mode: int, tmp_path: Path) -> None:
    before = os.umask(mask)
    try:
        write_text(tmp_path / "text", "new")
        with new_file(tmp_path / "new"):
            pass
        kept(tmp_path)
    finally:
        os.umask(before)
    for name in ("text", "new", "kept"):
        assert stat.S_IMODE((tmp_path / name).stat().st_mode) == mode, name


def test_a_body_that_fails_leaves_what_was_there(tmp_path: Path) -> None:
    path = tmp_path / "text"
    write_text(path, PRECIOUS)
    with pytest.raises(KeyError), whole_file(path) as stream:
        stream.write(b"half")
        raise KeyError
    assert path.read_text() == PRECIOUS and [one.name for one in tmp_path.iterdir()] == ["text"]
    with pytest.raises(InvalidInput, match="cannot be written"):
        append(tmp_path / "nowhere", b"x")


def test_nothing_but_one_file_opens_for_writing() -> None:
    """What stands below writes into folders that it made itself, with names that nobody can know, or into those of the developer."""
    own = ("base/writing.py", "rocq/build.py", "evidence/material.py", "data/files.py", "cli/command_line.py")
    opens = (
        ".write_text(",
        ".write_bytes(",
        'open(path, "w',
        '.open("w',
        '.open("a',
        "savefig(folder",
        "savemat(path",
        "NamedTemporaryFile(",
    )
    for room in ("faultspace/base", "faultspace/cli", "faultspace/review", "numeric", "exact", "proofs"):
        for file in (ROOT / room).rglob("*.py"):
            text = "\n".join(line for line in file.read_text("utf-8").splitlines() if ">>>" not in line)
            found = [one for one in opens if one in text]
            assert not found or file.as_posix().endswith(own), (file.relative_to(ROOT), found)
