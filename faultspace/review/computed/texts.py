"""Texts of the tree that a page shows: what was withdrawn, out of CHANGELOG, the sources, out of BIBLIOGRAPHY, the words of the glossary.

withdrawn   the entries of CHANGELOG's section Withdrawn, None where the text is not at hand
sources     key -> entry of the bibliography
words       the words of the glossary with their symbols, meanings and sources
tree_text   a file of the clone; of an installed package its description, which is README, CHANGELOG, BIBLIOGRAPHY and the glossary
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, metadata
from pathlib import Path

SECTION = re.compile(r"^### Withdrawn\n(.*?)(?=^##)", re.DOTALL | re.MULTILINE)
ENTRY = re.compile(r"^- (.*?)(?=^- |\Z)", re.DOTALL | re.MULTILINE)
SOURCE = re.compile(r"^- \*\*\[(\w+)\]\*\* (.*?)(?=^- |^#|^$|\Z)", re.DOTALL | re.MULTILINE)
WORD = re.compile(r"^### (.+)\n\nSymbol: (.+?[^.])\. ([A-Z].+)\nSource: (.+?)\. Code: `.+`\.$", re.MULTILINE)


@dataclass(frozen=True)
class Word:
    """An entry of the glossary, each part as Markdown on one line."""

    name: str
    symbol: str
    meaning: str
    source: str


def withdrawn() -> list[str] | None:
    """Return each entry as Markdown on one line, in the order of the file."""
    found = [match.group(1) for match in SECTION.finditer(tree_text("CHANGELOG.md"))]
    return [" ".join(entry.split()) for text in found for entry in ENTRY.findall(text)] if found else None


def sources() -> dict[str, str]:
    """Return the entries as Markdown on one line, empty where the text is not at hand."""
    return {key: " ".join(text.split()) for key, text in SOURCE.findall(tree_text("BIBLIOGRAPHY.md"))}


def words() -> list[Word]:
    """Return the entries in the order of the file, none where the text is not at hand."""
    return [Word(*parts) for parts in WORD.findall(tree_text("docs/glossary.md"))]


def tree_text(name: str) -> str:
    """Return the text of this file of the clone, or all that the package brings; empty where neither is there."""
    path = Path(__file__).resolve().parents[3] / name
    if path.is_file():
        return path.read_text("utf-8")
    try:
        found = metadata("faultspace")
    except PackageNotFoundError:
        return ""
    return str(found.get_payload() or found.get("Description") or "")  # type: ignore[attr-defined]
