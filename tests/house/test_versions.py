"""The page of the versions that were tried says so where the script that makes it has since been given more to try."""

from __future__ import annotations

from types import ModuleType

import pytest

from .import_graph import ROOT
from .scripts import script

OLDER = "**This page is older than `.ci/versions`**"


@pytest.fixture(scope="module")
def versions() -> ModuleType:
    """Return the script .ci/versions as a module."""
    return script("versions")


def tells_all(versions: ModuleType, page: str) -> bool:
    """Tell whether each extra and each file of tests that the script now takes stands on the page, but in a sentence on its age."""
    told = "\n".join(part for part in page.split("\n\n") if not part.startswith(OLDER))
    return f"| {', '.join(versions.EXTRAS)} |" in told and all(file in told for file in versions.FAST)


def test_the_page_says_where_it_is_older_than_the_script(versions: ModuleType) -> None:
    page = (ROOT / ".ci" / "versions.md").read_text()
    assert tells_all(versions, page) != (OLDER in page)


def test_a_new_page_is_told_from_an_older_one(versions: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    one = versions.Found("3.11.7", "lowest", True, {"numpy": "2.3.0"}, "1 passed", (), True)
    page = versions.page([one], 1, f"the tests of {versions.FILES}")
    assert tells_all(versions, page)
    monkeypatch.setattr(versions, "EXTRAS", (*versions.EXTRAS, "another"))
    assert not tells_all(versions, page) and not tells_all(versions, f"{page}\n{OLDER}: | {', '.join(versions.EXTRAS)} |\n")
