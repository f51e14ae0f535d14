"""Names of the places in a page, and links to them.

anchor      a name that an address can hold
Link        a text with the place it leads to
source      the keys such as [G25] of a text, as links to the section of sources
prose       Markdown of ours as HTML
"""

from __future__ import annotations

import re
from collections.abc import Container
from dataclasses import dataclass

from markdown_it import MarkdownIt
from markupsafe import Markup, escape

KEY = re.compile(r"\[([A-Z][A-Za-z]{0,3}[0-9]{2})\]")
RELATIVE = re.compile(r"\[([^\]]+)\]\((?!https?:|#)[^)]*\)")  # to a file of the tree, which a page that stands alone does not have
_MARKDOWN = MarkdownIt("commonmark", {"html": False})


@dataclass(frozen=True)
class Link:
    """`href` begins with # where it leads to a place in the page."""

    text: str
    href: str


def anchor(kind: str, name: str) -> str:
    """Return the name of a place."""
    return f"{kind}-{re.sub(r'[^A-Za-z0-9_.-]+', '-', name)}"


def cited(text: str, keys: Container[str]) -> Markup:
    """Return the text with those keys as links that have an entry among the sources."""

    def link(found: re.Match[str]) -> str:
        key = found.group(1)
        return f'<a href="#{anchor("source", key)}">[{key}]</a>' if key in keys else found.group()

    return Markup(KEY.sub(link, str(escape(text))))


def prose(text: str) -> Markup:
    """Return one paragraph without the paragraph's own tags; links into the tree are left as their words, CHANGELOG is the section here."""
    text = RELATIVE.sub(lambda found: "[CHANGELOG](#withdrawn)" if found.group(1) == "CHANGELOG" else found.group(1), text)
    return Markup(_MARKDOWN.renderInline(text))
