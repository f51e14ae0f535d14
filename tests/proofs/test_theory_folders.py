"""The theory lies in folders of topics: they are small, import each other one way as the README says, and no import is idle."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from faultspace.proofs.rocq.sources import THEORY, needs, paths, sources

MOST_FILES = 14
Arrows = dict[str, set[str]]


def arrows(texts: Mapping[str, str], where: Mapping[str, str]) -> Arrows:
    """Returns folder -> the other folders that its files import from."""
    folder = {name: path.partition("/")[0] for name, path in where.items()}
    result: Arrows = {one: set() for one in folder.values()}
    for name, required in needs(texts).items():
        result[folder[name]] |= {folder[one] for one in required} - {folder[name]}
    return result


def stands_on(graph: Arrows) -> Arrows:
    """Returns folder -> those of the folders that it imports on which no other one of them stands, directly or by way of others."""
    below: Arrows = {}
    for one in TopologicalSorter(graph).static_order():
        below[one] = graph[one].union(*(below[other] for other in graph[one]))
    return {one: {other for other in imported if not any(other in below[third] for third in imported)} for one, imported in graph.items()}


def rows() -> list[tuple[str, set[str]]]:
    """Returns the README's table of folders: each with those that it says it stands on."""
    _, _, section = THEORY.joinpath("README.md").read_text("utf-8").partition("## The folders")
    found = re.findall(r"^\| `(\w+)` \| [^|]+ \|([^|]*)\|$", section, re.MULTILINE)
    return [(folder, {*re.findall(r"`(\w+)`", below)}) for folder, below in found]


def test_a_folder_holds_few_files_and_no_file_lies_outside() -> None:
    assert not [one.name for one in THEORY.iterdir() if one.name.endswith(".v")]
    held = Counter(path.partition("/")[0] for path in paths().values())
    assert {folder: files for folder, files in held.items() if files > MOST_FILES} == {}
    assert sum(held.values()) > 100


def test_folders_import_each_other_one_way() -> None:
    TopologicalSorter(arrows(sources(), paths())).prepare()


def test_an_import_the_other_way_is_noticed() -> None:
    texts = sources()
    upward = {**texts, "Gap.v": f"From faultspace Require Import Theorem3.\n{texts['Gap.v']}"}
    with pytest.raises(CycleError):
        TopologicalSorter(arrows(upward, paths())).prepare()


def test_the_readme_says_which_folder_stands_on_which() -> None:
    listed = rows()
    assert dict(listed) == stands_on(arrows(sources(), paths()))
    assert len(listed) == len(dict(listed))
    for k, (folder, below) in enumerate(listed):
        assert below <= {name for name, _ in listed[k + 1 :]}, f"the row of {folder} stands above those on which it stands"


def test_what_stands_in_between_is_not_told_twice() -> None:
    assert stands_on({"a": {"b", "c"}, "b": {"c"}, "c": set()}) == {"a": {"b"}, "b": {"c"}, "c": set()}


def test_a_new_file_is_found_where_it_lies(tmp_path: Path) -> None:
    for path in ("topic/Old.v", "another/New.v", "another/notes.txt", "Outside.v"):
        (tmp_path / path).parent.mkdir(exist_ok=True)
        (tmp_path / path).write_text("", "utf-8")
    assert paths(tmp_path) == {"New.v": "another/New.v", "Old.v": "topic/Old.v"}
    (tmp_path / "topic" / "New.v").write_text("", "utf-8")
    with pytest.raises(ValueError, match=r"one name: New\.v"):
        paths(tmp_path)


def used(theory: Path, name: str) -> set[str]:
    """Returns the files of ours whose names coqc met in this one, by the record that it keeps. Where MathComp has a lemma of `versions`,
    its own is met."""
    lines = (theory / name).with_suffix(".glob").read_text("utf-8")
    met = {*re.findall(r"^R\d+:\d+ mathcomp\.\S+ \S+ (\w+) ", lines, re.MULTILINE)}
    own = {f"{module}.v" for module in re.findall(r"^R\d+:\d+ faultspace\.(\w+) \S+ \S+ (?!lib$)", lines, re.MULTILINE)}
    return (own | {file for file, names in named_by_versions().items() if names & met}) - {name}


@cache
def named_by_versions() -> dict[str, set[str]]:
    """Returns the files of the folder `versions`, each with the lemmas that it has."""
    texts = sources()
    return {
        name: {*re.findall(r"^Lemma (\w+)", texts[name], re.MULTILINE)} for name, path in paths().items() if path.startswith("versions/")
    }


@pytest.mark.timeout(900)
def test_every_file_requires_what_it_uses_and_nothing_else(theory: Path) -> None:
    required = needs(sources())
    idle = {name: sorted(required[name] - used(theory, name)) for name in required}
    assert {name: files for name, files in idle.items() if files} == {}
    missing = {name: sorted(used(theory, name) - required[name]) for name in required}
    assert {name: files for name, files in missing.items() if files} == {}
