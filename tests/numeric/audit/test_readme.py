"""The examples of the audit's page are run: files that it shows are written, commands that it shows are given, and print what it shows.

examples    what stands in each mark of a page, with the block below it
"""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from tests.end_to_end.commands import call

PAGE = Path(__file__).resolve().parents[3] / "numeric" / "audit" / "README.md"
MARK = re.compile(r"<!-- example: (.*?) -->\n\n```(?:python|text)\n(.*?)```\n", re.S)


def examples(page: str) -> list[tuple[str, str]]:
    return [(mark, block.rstrip("\n")) for mark, block in MARK.findall(page)]


def test_the_page_shows_what_is_printed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    found = examples(PAGE.read_text("utf-8"))
    commands = [mark for mark, _ in found if mark.startswith("faultspace ")]
    assert len(found) >= 4 and len(commands) >= 2
    for mark, block in found:
        if mark in commands:
            assert call(*shlex.split(mark)[1:]).out.rstrip("\n") == block, mark
        else:
            (tmp_path / mark).write_text(block + "\n", "utf-8")


def test_every_option_is_on_the_page() -> None:
    told = re.findall(r"^  (?:-\w, )?(--[a-z-]+)", call("audit", "--help").out, re.M)
    page = PAGE.read_text("utf-8")
    assert len(told) > 12
    assert [one for one in told if one not in page and one not in ("--help", "--quiet", "--verbose")] == []
