"""These are fixtures of the tests of commands.

record        the packaged record
browser       a Chromium without a window; without playwright or a Chromium the tests that look at pages are skipped, and say so
csv_file      the same as a table
rendered      a test that asks for it has its pictures rendered; of all others they are drawn, and a line of words is written as the file
"""

from __future__ import annotations

import importlib.util
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from faultspace import example_data as made
from faultspace.review import printing
from tests.end_to_end.identify_runs import small_csv


@pytest.fixture(scope="session")
def record() -> made.FaultyRecord:
    return made.faulty_record()


@pytest.fixture
def csv_file(tmp_path: Path, record: made.FaultyRecord) -> Path:
    return small_csv(tmp_path, made.csv_text(record), made.FILE_NAME)


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    found = next((path for name in printing.NAMES if (path := shutil.which(name)) is not None), None)
    if found is None:
        pytest.skip("no Chromium is here to look at the page with")
    sync = pytest.importorskip("playwright.sync_api")
    with sync.sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=found, args=["--no-sandbox"])
        yield started
        started.close()


@pytest.fixture
def rendered() -> None:
    """Matplotlib renders the pictures of this test, which takes two thirds of the time of `identify`."""


@pytest.fixture(autouse=True)
def _not_rendered(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    if "rendered" in request.fixturenames or importlib.util.find_spec("matplotlib") is None:
        return

    def savefig(figure: object, file: Any, **options: Any) -> None:
        file.write(b"not rendered")

    monkeypatch.setattr("matplotlib.figure.Figure.savefig", savefig)
