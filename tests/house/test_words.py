"""The words of the glossary lead to it where a page uses them first; README says with links what the page of a run says without them.

prose       a page without what is no sentence: code, comments, headings, tables, and links that lead elsewhere
unlinked    the words whose first use on a page is no link to the glossary
"""

from __future__ import annotations

import re
from pathlib import Path

from faultspace.review.view.words import FORMS, first_use
from faultspace.review.view.words import place as slug

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
NO_PROSE = (*("house.md", "glossary.md", "api.md", "adversary.md", "claims.md", "decisions.md", "reproducing.md", "speed.md"),)
PAGES = [ROOT / "README.md", *(page for page in sorted(DOCS.rglob("*.md")) if page.name not in NO_PROSE)]


def prose(page: str) -> str:
    """The words stand where they stood, for what is left out is blank."""

    def blank(found: re.Match[str]) -> str:
        return re.sub(r"[^\n]", " ", found.group())

    for what in (
        r"^ *```.*?^ *```$",
        r"<!--.*?-->",
        r"^(?:---\n.*?\n---$|\+\+\+.*?\+\+\+$)",
        r"`[^`]+`",
        r"^ *#.*$",
        r"^ *\|.*$",
        r"!\[[^\]]*\]\([^)]*\)",
        r"\[[^\]]*\]\((?![^)]*glossary\.md#)[^)]*\)",
    ):
        page = re.sub(what, blank, page, flags=re.MULTILINE | re.DOTALL if ".*?" in what else re.MULTILINE)
    return page


def unlinked(page: str) -> list[tuple[str, int]]:
    """Return each such word with the place of its first use."""
    text, found = prose(page), []
    words = re.sub(r"\]\([^)]*\)", lambda target: " " * len(target.group()), text)
    for word in FORMS:
        use = first_use(word, words)
        if use and not re.match(rf"[^\[\]]*\]\([^)]*glossary\.md#{slug(word)}\)", text[use.end() :]):
            found.append((word, use.start()))
    return found


def test_the_first_use_of_a_word_leads_to_the_glossary() -> None:
    assert [(page.name, word) for page in PAGES for word, _ in unlinked(page.read_text("utf-8"))] == []


def test_the_words_are_those_of_the_glossary() -> None:
    titles = re.findall(r"^### (.+)$", (DOCS / "glossary.md").read_text("utf-8"), re.MULTILINE)
    assert list(FORMS) == titles


def test_a_first_use_without_a_link_is_noticed() -> None:
    linked = "The [lag](docs/glossary.md#lag) is 2, and the lag of it, too."
    assert unlinked(linked) == []
    for wrong in (
        "The lag is 2: [lag](docs/glossary.md#lag).",
        "The [lag](docs/glossary.md#zeta) is 2.",
        "The [lag](docs/concepts.md) is the lag.",
    ):
        assert [word for word, _ in unlinked(wrong)] == ["Lag"]
    assert unlinked("# The lag\n\n| lag |\n\n`lag`\n\n```sh\nlag\n```\n<!-- lag -->\n") == []


# What people read first: sentences that are understood at first reading, without the words that only we use.
FIRST = [ROOT / "README.md", *(DOCS / name for name in ("index.md", "review.md")), *sorted((DOCS / "start").glob("*.md"))]
FIRST += sorted((DOCS / "tutorials").glob("*.md"))
OURS = re.compile(r"\b(told|judged|rooms|as printed|as the paper has it|the like)\b", re.IGNORECASE)
LONGEST = 32  # words of a sentence, formulas left out


def hard(page: str) -> list[str]:
    """Return the sentences of a page that are long, or have a word of ours."""
    text = re.sub(r"\]\([^)]*\)", "]", prose(page))
    text = re.sub(r"\n\s*\n|\n\s*[-*] |\n\s*\d+\. |:\s*\n", ". ", text)
    sentences = [" ".join(one.split()) for one in re.split(r"(?<=[.!?])\s+|: ", text)]
    return [one for one in sentences if len(re.findall(r"[A-Za-z][A-Za-z'-]+", one)) > LONGEST or OURS.search(one)]


def test_what_people_read_first_is_short_and_in_their_words() -> None:
    assert [(page.name, one) for page in FIRST for one in hard(page.read_text("utf-8"))] == []
    assert len(hard("It is told.\n\n" + "some words " * 20 + "end.\n\nAll is well.")) == 2
