"""A folder of results is written without touching what anybody else put there.

MANIFEST     the hidden file of the folder that says which files an earlier run wrote, with the SHA-256 digests of their contents
refuse       the refusal where files of these names are not ours; nothing is written
replace      files of another folder take the places of ours, and those of ours that have no successor are removed

A file is ours where its name stands in the manifest and its content is what was written then: a file that has been edited since, or
that was put in its place, is its owner's. The manifest names the old and the new contents while files are moved, and the new ones alone
when that is done, so that a run that is interrupted leaves no file that the next one does not know. Files of other names, which another
command wrote there, stay in it as they are.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ....base.errors import InvalidInput, quote_path
from ....base.regular_files import open_own
from ....base.writing import NO_LINK, write_text

MANIFEST = ".faultspace-files.json"
FORMAT = "faultspace-files/1"
LARGEST = 1 << 20  # bytes of a manifest: it names some ten files

Digests = dict[str, list[str]]


def refuse(folder: Path, names: Sequence[str]) -> None:
    """Raise InvalidInput where `folder` has a file of one of these names that no earlier run wrote, or that was changed since."""
    known = _known(folder)
    for name in names:
        if os.path.lexists(folder / name) and not _ours(folder / name, known.get(name, [])):
            raise InvalidInput(
                f"{quote_path(str(folder))}: has {name}, which no earlier run wrote, or which was changed since; it is left as it is: name "
                "a new folder with --out, or move the file away"
            )


def replace(made: Path, folder: Path, names: Sequence[str]) -> list[str]:
    """Move the files of these names from the folder `made` into `folder`, and remove those of ours that `made` lacks; the names that were
    written. Raises InvalidInput, before anything is moved, where a file of these names is not ours."""
    refuse(folder, names)
    with _held(made) as at:
        written = [name for name in names if name in os.listdir(made if at is None else at)]
        before, new = _known(folder), {name: [_digest(made / name)] for name in written}
        after = {name: digests for name, digests in before.items() if name not in names} | new
        _note(folder, {name: before.get(name, []) + new.get(name, []) for name in before.keys() | new.keys()})
        for name in written:
            path = made / name if at is None else name
            descriptor = os.open(path, os.O_RDWR | NO_LINK, dir_fd=at)  # what takes the place of an older answer is on the disk first
            try:
                os.fsync(descriptor)
            finally:
                os.close(descriptor)
            os.replace(path, folder / name, src_dir_fd=at)
    for name in names:
        if name not in written:
            (folder / name).unlink(missing_ok=True)
    _note(folder, after)
    return written


@contextmanager
def _held(folder: Path) -> Iterator[int | None]:
    """Yield a descriptor of the folder, None where there are none of folders: what others put in its place meanwhile is not taken for it.
    Raises OSError for a link."""
    if os.open not in os.supports_dir_fd:
        yield None
        return
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | NO_LINK)
    try:
        yield descriptor
    finally:
        os.close(descriptor)


def _ours(path: Path, digests: Sequence[str]) -> bool:
    try:
        return bool(digests) and path.is_file() and not path.is_symlink() and _digest(path) in digests
    except OSError:
        return False


def _digest(path: Path) -> str:
    with open(path, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def _known(folder: Path) -> Digests:
    """Return the contents that are ours, by name; none where there is no manifest. Raises InvalidInput for a manifest of anybody else."""
    path = folder / MANIFEST
    if not os.path.lexists(path):
        return {}
    try:
        with open_own(path, "our own file") as stream:
            content: Any = json.loads(stream.read(LARGEST))
    except InvalidInput as error:
        raise InvalidInput(f"{quote_path(str(path))}: {error}: name a new folder") from None
    except (ValueError, RecursionError):
        content = None
    files = content.get("files") if isinstance(content, dict) and content.get("format") == FORMAT else None
    if not isinstance(files, dict) or not all(isinstance(digests, list) for digests in files.values()):
        raise InvalidInput(f'{quote_path(str(path))}: is not ours, expected "format": "{FORMAT}" with "files": name a new folder')
    return files


def _note(folder: Path, files: Mapping[str, Sequence[str]]) -> None:
    write_text(folder / MANIFEST, json.dumps({"format": FORMAT, "files": files}, indent=1) + "\n")
