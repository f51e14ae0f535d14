"""The pages of docs/ tell of the claims what the ledger expects and a run computes; every link of the pages leads somewhere."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

from faultspace.proofs.verdict.verdicts import Verdict

DOCS = Path(__file__).parents[2] / "docs"
README_LINES = 120
PAGES = [*sorted(DOCS.glob("*.md")), DOCS.parent / "README.md", DOCS.parent / "CONTRIBUTING.md"]


@pytest.fixture(scope="module")
def make() -> ModuleType:
    """Return docs/make.py, which is no module of the package."""
    spec = importlib.util.spec_from_file_location("make_docs", DOCS / "make.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("page", ["adversary.md", "claims.md", "hypotheses.md", "paper-to-proof.md", "your-claims.md"])
def test_the_tables_are_the_ledgers(make: ModuleType, page: str) -> None:
    text = (DOCS / page).read_text("utf-8")
    assert make.filled(text, make.TABLES[page]()) == text, "make it again: python docs/make.py"
    assert make.filled(text, ["| another |"]) != text


def test_the_picture_has_every_claim_and_every_reading(make: ModuleType) -> None:
    picture = (DOCS / "claims.svg").read_text("utf-8")
    claims = make.load()
    texts = re.findall(r">([^<>\s][^<>]*)</text>", picture)
    assert [claim.id for claim in claims] == [text for text in texts if text in {claim.id for claim in claims}]
    letters = [text for text in texts if len(text) == 1]
    readings = [one for claim in claims for repair in (False, True) for one in claim.readings if one.repair == repair]
    assert letters == [one.proved[0] for one in readings], "make it again: python docs/make.py"


def test_the_verdicts_are_explained_in_their_own_words() -> None:
    rows = dict(re.findall(r"^\| ([A-Z]+) \| ([^|]+) \|", (DOCS / "claims.md").read_text("utf-8"), re.MULTILINE))
    assert rows == {verdict.value: verdict.meaning for verdict in Verdict}, "write it in the table of docs/claims.md too, by hand"


def links(page: Path) -> list[str]:
    """The relative links of a page, without what stands behind a #."""
    found = re.findall(r"\]\(([^)#\s]+)[^)]*\)", page.read_text("utf-8"))
    return [link for link in found if "://" not in link]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_link_leads_somewhere(page: Path) -> None:
    broken = [link for link in links(page) if not (page.parent / link).exists()]
    assert broken == []


def sections(page: Path) -> set[str]:
    """The names of the sections of a page, as links call them."""
    return {
        re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
        for title in re.findall(r"^#+ (.+)$", page.read_text("utf-8"), re.MULTILINE)
    }


@pytest.mark.parametrize("page", [*PAGES, DOCS.parent / "benchmarks" / "README.md"], ids=lambda page: f"{page.parent.name}-{page.name}")
def test_every_link_to_a_section_finds_it(page: Path) -> None:
    """A page that has lost its sections is so noticed by those that speak of them."""
    found = re.findall(r"\]\(([\w./-]*)#([\w-]+)\)", page.read_text("utf-8"))
    assert [(link, name) for link, name in found if name not in sections(page.parent / link if link else page)] == []


def files_named(text: str) -> list[str]:
    """The files and folders of the tree that a page names as code, with a slash in them; patterns and commands are none."""
    return [name for name in re.findall(r"`([\w./-]+)`", text) if "/" in name and not re.search(r"[A-Z]{4}_", name)]


def test_contributing_names_files_that_exist() -> None:
    root = DOCS.parent
    named = files_named((root / "CONTRIBUTING.md").read_text("utf-8"))
    assert len(named) > 30
    assert [name for name in named if not (root / name).exists()] == []
    assert files_named("`numeric/no_such_file.py` `verify` `numeric/audit/peers/NAME_adapter.py`") == ["numeric/no_such_file.py"]


def test_the_readme_is_short() -> None:
    assert len((DOCS.parent / "README.md").read_text("utf-8").splitlines()) < README_LINES
