"""These are the sources of the theory: the files of Rocq below proofs/theory, one folder a topic.

    THEORY    the folder of the theory
    paths     file name -> where the file lies; file names are unique, whatever their folder
    sources   file name -> text
    beyond    the same of the files beside the theory that need more of MathComp than it does, in proofs/theory_beyond
    needs     file name -> the files of ours that it requires

A new file is found where it lies: nothing lists them. Rocq resolves `From faultspace Require Import Gap` to the one file Gap.v, in
whichever folder it is; so a file may be moved to another folder and no text changes.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib import resources
from importlib.resources.abc import Traversable
from itertools import pairwise

THEORY: Traversable = resources.files("faultspace.proofs").joinpath("theory")
BEYOND: Traversable = resources.files("faultspace.proofs").joinpath("theory_beyond")
REQUIRED = re.compile(r"From\s+faultspace\s+Require\s+(?:Import|Export)?([\s\w]*)\.")


def paths(theory: Traversable = THEORY) -> dict[str, str]:
    """Return file name -> its path below the theory, FOLDER/NAME.v, in the order of the names. Raises ValueError where two files share a
    name."""
    found = [(one.name, folder.name) for folder in theory.iterdir() if folder.is_dir() for one in folder.iterdir()]
    files = sorted((name, f"{folder}/{name}") for name, folder in found if name.endswith(".v"))
    names = [name for name, _ in files]
    twice = [name for name, following in pairwise(names) if name == following]
    if twice:
        raise ValueError(f"two files of the theory have one name: {twice[0]}")
    return dict(files)


def sources() -> dict[str, str]:
    """Return file name -> text, of all files of the theory."""
    return {name: THEORY.joinpath(path).read_text("utf-8") for name, path in paths().items()}


def beyond() -> dict[str, str]:
    """Return file name -> text, of the files that use the theory and what it does without; nothing of the theory needs them."""
    return {one.name: one.read_text("utf-8") for one in sorted(BEYOND.iterdir(), key=lambda one: one.name) if one.name.endswith(".v")}


def needs(texts: Mapping[str, str]) -> dict[str, set[str]]:
    """Return file name -> names of those of these files that it requires."""
    return {
        name: {f"{module}.v" for names in REQUIRED.findall(text) for module in names.split() if f"{module}.v" in texts}
        for name, text in texts.items()
    }
