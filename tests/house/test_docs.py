"""The pages of docs/ tell of the claims what the ledger expects and a run computes; every link of the pages leads somewhere."""

from __future__ import annotations

import html
import os
import re
from pathlib import Path

from docs.tools.pages import PAGES as MADE
from docs.tools.tables import TABLES, filled
from faultspace.proofs.verdict.ledger import load, sentences
from faultspace.proofs.verdict.picture import GROUPS, MEANINGS, TITLE
from faultspace.proofs.verdict.verdicts import Verdict

DOCS = Path(__file__).parents[2] / "docs"
README_LINES = 120
PAGES = [*sorted(DOCS.glob("*.md")), DOCS.parent / "README.md", DOCS.parent / "CONTRIBUTING.md"]


def test_the_tables_are_the_ledgers() -> None:
    for page, rows in TABLES.items():
        text = (DOCS / page).read_text("utf-8")
        assert filled(text, rows()) == text, f"make {page} again: python docs/make.py"
        assert filled(text, ["| another |"]) != text


def test_the_picture_has_every_claim_with_its_sentence() -> None:
    picture = (DOCS / "claims.svg").read_text("utf-8")
    texts = [html.unescape(text) for text in re.findall(r">([^<>\s][^<>]*)</text>", picture)]
    claims = [claim for group in GROUPS for claim in load() if claim.group == group]
    assert [claim.id for claim in claims] == [text for text in texts if text in {claim.id for claim in claims}]
    others = {TITLE, *GROUPS.values(), *MEANINGS.values()}
    said = [text for text in texts if " " in text and text not in others]
    assert said == [sentences()[claim.id]["verdict"] for claim in claims], "make it again: python docs/make.py"


def test_the_verdicts_are_explained_in_their_own_words() -> None:
    rows = dict(re.findall(r"^\| ([A-Z]+) \| ([^|]+) \|", (DOCS / "claims.md").read_text("utf-8"), re.MULTILINE))
    assert rows == {verdict.value: verdict.meaning for verdict in Verdict}, "write it in the table of docs/claims.md too, by hand"


def links(text: str) -> list[str]:
    """The relative links of a page, without what stands behind a #."""
    return [link for link in re.findall(r"\]\(([^)#\s]+)[^)]*\)", text) if "://" not in link]


def test_every_link_leads_somewhere() -> None:
    """Those of the pages that a command makes, too, where the site has them: in build/pages."""
    made = {DOCS.parent / "build" / "pages" / name: text() for name, text in MADE.items()}
    texts = made | {page: page.read_text("utf-8") for page in PAGES}
    found = [(page.name, Path(os.path.normpath(page.parent / link))) for page, text in texts.items() for link in links(text)]
    assert len(found) > 300
    assert [(name, link) for name, link in found if not link.exists() and link not in made] == []


def sections(page: Path) -> set[str]:
    """The names of the sections of a page, as links call them."""
    return {
        re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
        for title in re.findall(r"^#+ (.+)$", page.read_text("utf-8"), re.MULTILINE)
    }


def test_every_link_to_a_section_finds_it() -> None:
    """A page that has lost its sections is so noticed by those that speak of them."""
    for page in [*PAGES, DOCS.parent / "benchmarks" / "README.md"]:
        found = re.findall(r"\]\(([\w./-]*)#([\w-]+)\)", page.read_text("utf-8"))
        assert [(link, name) for link, name in found if name not in sections(page.parent / link if link else page)] == [], page.name


def files_named(text: str) -> list[str]:
    """The files and folders of the tree that a page names as code, with a slash in them; patterns and commands are none."""
    return [name for name in re.findall(r"`([\w./-]+)`", text) if "/" in name and not re.search(r"[A-Z]{4}_", name)]


def test_contributing_names_files_that_exist() -> None:
    root = DOCS.parent
    named = [name for page in ("CONTRIBUTING.md", "docs/extending.md") for name in files_named((root / page).read_text("utf-8"))]
    assert len(named) > 30
    assert [name for name in named if not (root / name).exists()] == []
    assert files_named("`numeric/no_such_file.py` `verify` `numeric/audit/peers/NAME_adapter.py`") == ["numeric/no_such_file.py"]


def test_the_readme_is_short() -> None:
    assert len((DOCS.parent / "README.md").read_text("utf-8").splitlines()) < README_LINES
