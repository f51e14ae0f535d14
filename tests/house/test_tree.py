"""These tests ask for what is true of every file: short modules, no path of anybody's machine, one version, no key without a source.

machine_paths       absolute paths of one machine that a text mentions
cited_keys          keys such as [V93] in the docstrings of a source
"""

import ast
import re
from pathlib import Path, PurePosixPath

import faultspace

LINES = 500
LINES_OF = {PurePosixPath("proofs/trust/checker.py"): 721}

# Each pattern has a class of one letter, so that this file does not contain what it looks for.
MACHINE_PATH = re.compile(r"(?<![\w.])(?:/[w]ork/|/[t]mp/[A-Za-z]|/[h]ome/\w|/[r]oot/|/[U]sers/\w|[C]:\\Users)")
KEY = re.compile(r"\[([A-Z][A-Za-z]{0,3}[0-9]{2})\]")


def machine_paths(text: str) -> list[str]:
    """Return the beginnings of the machine paths in a text."""
    return MACHINE_PATH.findall(text)


def cited_keys(source: str) -> set[str]:
    """Return the bibliography keys in the docstrings of a module, its functions and its classes."""
    if not KEY.search(source):
        return set()
    documented = (ast.Module, ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
    texts = (ast.get_docstring(node) or "" for node in ast.walk(ast.parse(source)) if isinstance(node, documented))
    return {key for text in texts for key in KEY.findall(text)}


def sources(root: Path, checkout: list[PurePosixPath]) -> dict[PurePosixPath, str]:
    """Return every Python file of the tree with its text."""
    return {name: (root / name).read_text("utf-8") for name in checkout if name.suffix == ".py"}


def test_no_module_is_long(root: Path, checkout: list[PurePosixPath]) -> None:
    lengths = {name: len(text.splitlines()) for name, text in sources(root, checkout).items()}
    assert lengths, "no Python file was seen"
    assert {str(name): length for name, length in lengths.items() if length > LINES_OF.get(name, LINES)} == {}


def test_no_file_names_a_path_of_one_machine(root: Path, checkout: list[PurePosixPath]) -> None:
    found = {}
    for name in checkout:
        if (root / name).is_symlink():
            continue
        text = (root / name).read_bytes().decode("utf-8", errors="replace")
        if paths := machine_paths(text):
            found[str(name)] = paths
    assert found == {}


def test_machine_paths_are_noticed_and_others_not() -> None:
    slash = "/"
    for path in ("work/x", "tmp/x", "home/me", "root/x", "Users/me"):
        assert machine_paths(f"see '{slash}{path}'"), path
    for path in ("../work/x", "net" + slash + "work/x", "a/tmp/x", slash + "usr/bin/env"):
        assert machine_paths(f"see '{path}'") == [], path


def test_every_cited_key_is_in_the_bibliography(root: Path, checkout: list[PurePosixPath]) -> None:
    known = set(re.findall(r"^- \*\*\[(\w+)\]\*\*", (root / "BIBLIOGRAPHY.md").read_text("utf-8"), flags=re.MULTILINE))
    assert known, "the bibliography was not read"
    cited = {str(name): cited_keys(text) for name, text in sources(root, checkout).items()}
    unknown = {name: sorted(keys - known) for name, keys in cited.items() if keys - known}
    assert unknown == {}
    read = "\n".join(text for name, text in sources(root, checkout).items() if name.suffix == ".py")
    assert [key for key in sorted(known) if not re.search(rf"[\[ ]{key}[\],]", read)] == [], "in the bibliography, and used by nothing"
    # The key in this file's own docstring: a reading that finds nothing anywhere would be seen here.
    assert cited["tests/house/test_tree.py"] == {"V93"}


def test_keys_are_read_from_docstrings_alone() -> None:
    source = '"""See [ZZ99]."""\n\ndef f():\n    """As [Q01]; [O_s T_s], x[T10 + 1] are none."""\n    return "[AB12]"'
    assert cited_keys(source) == {"ZZ99", "Q01"}


def test_the_citation_and_the_changelog_name_the_version(root: Path) -> None:
    citation = (root / "CITATION.cff").read_text("utf-8")
    assert re.findall(r"^version: (.+)$", citation, flags=re.MULTILINE) == [faultspace.__version__]
    assert faultspace.__version__ in (root / "CHANGELOG.md").read_text("utf-8")
